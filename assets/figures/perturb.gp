# The threshold over the distance to theta_c, as a velocity and as an energy. A bar is a bracket, its point the
# middle on the scale of the axis. One symbol for each seed, as long as there are
# symbols for all; triangles are states with one end only. Lines join what follows
# without a gap. Bars are vectors: those of gnuplot blank what lies around them. The first
# point, which nobody sees, gives the axis a range where no state has a threshold.
file = figure . ".csv"
set logscale y
set format y "10^{%T}"
set xrange [0:*]
set xlabel "{/:Italic θ_c} − {/:Italic θ}  (deg)"
set key at screen 0.5, screen 0.99 center top vertical Left reverse maxrows 2 samplen 1 width 1

both(low, high) = low > 0 && high > 0     # false where one of them is NaN or 0
middle(low, high) = both(column(low), column(high)) ? sqrt(column(low) * column(high)) : NaN
none(name) = stringcolumn(name) eq "NaN"
is_of(s) = column("seed") == word(seeds, s) + 0
many = words(seeds) > 8
type(s) = many ? 1 : s
shade(s) = many ? "#60000000" : colour(s)
size = many ? 0.25 : 0.45 * symbol
entry(s) = many ? sprintf("%d beds", words(seeds)) : "seed " . word(seeds, s)
x(s) = is_of(s) ? column("distance") : NaN

# The angles theta_d, as distances; the labels on the outer sides of the lines.
side = theta_d_lc > theta_d_dilation ? 1.2 : -1.2
if (theta_d_lc > 0) { set arrow 1 from first theta_d_lc, graph 0 to first theta_d_lc, graph 1 nohead linestyle 102; \
  set label 1 "{/:Italic θ_d} ({/:Italic l_c})" at first theta_d_lc, graph 0.03 left rotate by 90 offset character side, 0 }
if (theta_d_dilation > 0) { set arrow 2 from first theta_d_dilation, graph 0 to first theta_d_dilation, graph 1 nohead linestyle 103; \
  set label 2 "{/:Italic θ_d} (dilation)" at first theta_d_dilation, graph 0.03 left rotate by 90 offset character -side, 0 }

set multiplot layout 1, 2 margins screen 0.09, 0.985, 0.16, 0.86 spacing screen 0.115
do for [panel = 1:2] {
  quantity = word("v energy", panel)
  low = quantity . "_without"
  high = quantity . "_with"
  if (panel == 1) { set ylabel "{/:Italic v} / ({/:Italic gD})^{1/2}" } else { set ylabel "{/:Italic E} / {/:Italic mgD}"; unset key }
  plot file every ::0::0 using (0):(1) with points pointtype -1 notitle, \
       for [s = 1:words(seeds)] file using (x(s)):(none(high) ? column(low) : NaN) with points linetype type(s) linecolor rgb shade(s) linewidth 1 pointtype 8 pointsize 0.6 notitle, \
       for [s = 1:words(seeds)] file using (x(s)):(column(low) == 0 && !none(high) ? column(high) : NaN) with points linetype type(s) linecolor rgb shade(s) pointtype 10 pointsize 0.6 notitle, \
       for [s = 1:words(seeds)] file using (x(s)):(middle(low, high)) with lines linetype type(s) linecolor rgb shade(s) linewidth 0.7 notitle, \
       for [s = 1:words(seeds)] file using (x(s)):(both(column(low), column(high)) ? column(low) : NaN):(0):(column(high) - column(low)) \
         with vectors nohead linetype type(s) linecolor rgb shade(s) dashtype solid linewidth 1 notitle, \
       for [s = 1:words(seeds)] file using (x(s)):(middle(low, high)) with points linetype type(s) linecolor rgb shade(s) pointsize size notitle, \
       for [s = 1:(many ? 1 : words(seeds))] NaN with points linetype type(s) linecolor rgb shade(s) pointsize size title entry(s)
}
unset multiplot
