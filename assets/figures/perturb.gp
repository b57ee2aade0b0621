# The threshold over the distance to theta_c, as a velocity and as an energy. A bar is a bracket, its point the
# middle on the scale of the axis. Each seed has its own symbol if the symbols suffice.
# Triangles are states with one end only. Lines join consecutive states.
# Bars are vectors, because error bars of gnuplot blank their surroundings. The first
# point is invisible and gives the axis a range if no state has a threshold.
file = figure . ".csv"
both(low, high) = low > 0 && high > 0     # false if one of them is NaN or 0
middle(low, high) = both(column(low), column(high)) ? sqrt(column(low) * column(high)) : NaN
none(name) = stringcolumn(name) eq "NaN"
is_of(s) = column("seed") == word(seeds, s) + 0
many = words(seeds) > 8
type(s) = many ? 1 : s
shade(s) = many ? "#60000000" : colour(s)
size = many ? 0.25 : 0.45 * symbol
entry_of(s) = many ? sprintf("%d beds", words(seeds)) : "seed " . word(seeds, s)
x(s) = is_of(s) ? column("distance") : NaN

eval grid(2, 2, 1, width > 12 ? 6.2 : 5.2)
do for [s = 1:(many ? 1 : words(seeds))] {
  style = sprintf("linetype %d linecolor rgb '%s'", type(s), shade(s))
  entry = add_entry(style . " linewidth 0.7", style . sprintf(" pointsize %g", size), "", entry_of(s))
}
entry = add_point("pointtype 8 pointsize 0.6 linecolor rgb '#60000000'", "no avalanche")
entry = add_point("pointtype 10 pointsize 0.6 linecolor rgb '#60000000'", "weakest push suffices")
if (theta_d_lc > 0) { entry = add_line("linestyle 102", "{/:Italic θ_d} ({/:Italic l_c})") }
if (theta_d_dilation > 0) { entry = add_line("linestyle 103", "{/:Italic θ_d} (dilation)") }
eval open_page
if (theta_d_lc > 0) { set arrow 1 from first theta_d_lc, graph 0 to first theta_d_lc, graph 1 nohead linestyle 102 }
if (theta_d_dilation > 0) { set arrow 2 from first theta_d_dilation, graph 0 to first theta_d_dilation, graph 1 nohead linestyle 103 }
do for [panel = 1:2] {
  quantity = word("v energy", panel)
  low = quantity . "_without"
  high = quantity . "_with"
  eval place(panel)
  x_from = 0
  y_log = 1
  x_title = "{/:Italic θ_c} − {/:Italic θ} (°)"
  y_title = panel == 1 ? "{/:Italic v} / ({/:Italic gD})^{1/2}" : "{/:Italic E} / {/:Italic mgD}"
  eval axes
  set label 1 letter(panel) at graph 0.96, graph 0.07 right
  plot file every ::0::0 using (0):(1) with points pointtype -1, \
       for [s = 1:words(seeds)] file using (x(s)):(none(high) ? column(low) : NaN) with points linetype type(s) linecolor rgb shade(s) linewidth 1 pointtype 8 pointsize 0.6, \
       for [s = 1:words(seeds)] file using (x(s)):(column(low) == 0 && !none(high) ? column(high) : NaN) with points linetype type(s) linecolor rgb shade(s) pointtype 10 pointsize 0.6, \
       for [s = 1:words(seeds)] file using (x(s)):(middle(low, high)) with lines linetype type(s) linecolor rgb shade(s) linewidth 0.7, \
       for [s = 1:words(seeds)] file using (x(s)):(both(column(low), column(high)) ? column(low) : NaN):(0):(column(high) - column(low)) \
         with vectors nohead linetype type(s) linecolor rgb shade(s) dashtype solid linewidth 1, \
       for [s = 1:words(seeds)] file using (x(s)):(middle(low, high)) with points linetype type(s) linecolor rgb shade(s) pointsize size
  eval seen
}
eval close_page
