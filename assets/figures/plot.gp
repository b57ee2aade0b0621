# A plot of the window: its curves, thin lines for laws, and a pale background.
eval grid(1, 1, 1, height)
of_behind(k) = value(sprintf("behind_file_%d", k))
mean_of(k) = int(value(sprintf("behind_column_%d", k)))
# A single run has no deviation.
spread_of(k) = column(mean_of(k) + 1) == column(mean_of(k) + 1) ? column(mean_of(k) + 1) : 0
ink_of(k) = colour(value(sprintf("behind_curve_%d", k)))
of_curve(k) = value(sprintf("file_%d", k))
column_of(k) = int(value(sprintf("column_%d", k)))
style_of(k) = sprintf("linecolor rgb '%s' dashtype solid linewidth %g", colour(k), value(sprintf("law_%d", k)) ? 0.7 : 2)
if (plotted > 1) { do for [k = 1:plotted] { entry = add_line(style_of(k), value(sprintf("title_%d", k))) } }
if (behinds > 0) { entry = add_line(sprintf("linecolor rgb '%s' linewidth 1 dashtype (4,3)", ink_of(1)), behind_title) }
if (exists("theta_c_at")) { entry = add_line("linestyle 103", "{/:Italic θ_c}") }
if (strlen(note) > 0) { entry = add_entry("", "", "", note) }
eval open_page
eval place(1)
y_log = logarithmic
x_title = x_title_of_plot
y_title = y_title_of_plot
if (exists("x_low")) { x_from = falling ? x_high : x_low; x_to = falling ? x_low : x_high } \
else { if (pass > 0) { x_from = falling ? x_most[1] : x_least[1]; x_to = falling ? x_least[1] : x_most[1] } }
eval axes
if (exists("theta_c_at")) { set arrow from first theta_c_at, graph 0 to first theta_c_at, graph 1 nohead linestyle 103 }
measured = 'for [k = 1:plotted] of_curve(k) using 1:(column(column_of(k))) with lines linecolor rgb colour(k) dashtype solid ' . \
  'linewidth (value(sprintf("law_%d", k)) ? 0.7 : 2)'
behind = 'for [k = 1:behinds] of_behind(k) using 1:(column(mean_of(k)) - spread_of(k)):(column(mean_of(k)) + spread_of(k)) ' . \
  'with filledcurves fillcolor rgb ink_of(k) fillstyle transparent solid 0.15, ' . \
  'for [k = 1:behinds] of_behind(k) using 1:(column(mean_of(k))) with lines linecolor rgb ink_of(k) linewidth 1 dashtype (4,3)'
if (behinds > 0) { plot @behind, @measured } else { plot @measured }
eval seen
eval close_page
