# A plot of the window: its curves, laws thin, and what stands behind them, pale.
set xlabel x_title offset 0, 0.3
set ylabel y_title
set autoscale xfix
if (logarithmic) { set logscale y; set format y "10^{%T}" }
if (falling) { set xrange [*:*] reverse }
if (exists("x_low")) { eval falling ? "set xrange [x_high:x_low]" : "set xrange [x_low:x_high]" }
if (exists("theta_c_at")) { set arrow from first theta_c_at, graph 0 to first theta_c_at, graph 1 nohead linestyle 103 }
set label note at graph 0.03, graph 0.95 font ",7"
of_behind(k) = value(sprintf("behind_file_%d", k))
mean_of(k) = int(value(sprintf("behind_column_%d", k)))
# A single run has no deviation.
spread_of(k) = column(mean_of(k) + 1) == column(mean_of(k) + 1) ? column(mean_of(k) + 1) : 0
ink_of(k) = colour(value(sprintf("behind_curve_%d", k)))
of_curve(k) = value(sprintf("file_%d", k))
column_of(k) = int(value(sprintf("column_%d", k)))
measured = 'for [k = 1:plotted] of_curve(k) using 1:(column(column_of(k))) with lines linecolor rgb colour(k) dashtype solid ' . \
  'linewidth (value(sprintf("law_%d", k)) ? 0.7 : 2) title (plotted > 1 ? value(sprintf("title_%d", k)) : "")'
behind = 'for [k = 1:behinds] of_behind(k) using 1:(column(mean_of(k)) - spread_of(k)):(column(mean_of(k)) + spread_of(k)) ' . \
  'with filledcurves fillcolor rgb ink_of(k) fillstyle transparent solid 0.15 notitle, ' . \
  'for [k = 1:behinds] of_behind(k) using 1:(column(mean_of(k))) with lines linecolor rgb ink_of(k) linewidth 1 dashtype (4,3) ' . \
  'title (k == 1 ? behind_title : "")'
if (behinds > 0) { plot @behind, @measured } else { plot @measured }
