# Two rows of two panels: distributions of sizes and of waiting angles, then sizes and changes of volume over the tilt.
panel_top = 0.3
panel_left = 1.55
sizes(g) = value(sprintf("sizes_%d", g))
waits(g) = value(sprintf("waits_%d", g))
set xrange [*:*] noextend
set yrange [*:*]
set tics font ",7"
set multiplot

eval panel(1, 2, 1, 2)
set logscale xy
set format "10^{%T}"
set xlabel "energy released {/:Italic E} ({/:Italic mgD})" offset 0, 0.3
set ylabel "share with {/:Italic E} or more" offset 0.8, 0
set xrange [energy_from:energy_to]
# Room below the curves for what their laws are.
set yrange [0.7 / events_most * 10 ** (-0.16 * groups) : 1.5]
do for [g = 1:groups] {
  set label g value(sprintf("size_law_%d", g)) at graph 0.04, graph 0.06 + 0.075 * (groups - g) left font ",6.5" textcolor rgb colour(g)
}
set label 100 "(a)" at graph 0.95, graph 0.92 right
plot for [g = 1:groups] sizes(g) using "energy":"share" with points linetype g pointsize 0.35 * symbol notitle, \
  for [g = 1:groups] sizes(g) using "energy":"power_law" with lines linetype g dashtype solid linewidth 1.5 notitle, \
  for [g = 1:groups] NaN with linespoints linetype g title label(g)
unset key

eval panel(1, 2, 2, 2)
set label 100 "(b)"
set xlabel "waiting angle (deg)" offset 0, 0.3
set xrange [waiting_from:waiting_to]
set ylabel "share with as long or longer"
do for [g = 1:groups] { set label g value(sprintf("wait_law_%d", g)) }
plot for [g = 1:groups] waits(g) using "waiting":"share" with points linetype g pointsize 0.35 * symbol notitle, \
  for [g = 1:groups] waits(g) using "waiting":"power_law" with lines linetype g dashtype solid linewidth 1.5 notitle, \
  for [g = 1:groups] waits(g) using "waiting":"exponential_law" with lines linetype g dashtype (2,3) linewidth 1 notitle
do for [g = 1:groups] { unset label g }

eval panel(2, 2, 1, 2)
unset logscale x
set format x "%g"
set yrange [energy_from:energy_to]
set xrange [0:1.03 * theta_max]
set xlabel "{/:Italic θ} (deg)" offset 0, 0.3
set ylabel "{/:Italic E} ({/:Italic mgD})"
set label 100 "(c)" at graph 0.05, graph 0.92 left
plot for [g = 1:groups] data(g) using "theta":(column("energy") > 0 ? column("energy") : NaN) with points linetype g linewidth 1 pointsize 0.4 * symbol notitle

# Linear within some 1e-6, logarithmic beyond.
eval panel(2, 2, 2, 2)
unset logscale y
set format y "%g"
set yrange [-largest_change : largest_change]
set nonlinear y via asinh(y / 2.0) inverse 2.0 * sinh(y)
set ytics ("−10^4" -1e4, "−1000" -1e3, "−100" -100, "−10" -10, "0" 0, "10" 10, "100" 100, "1000" 1e3, "10^4" 1e4)
unset mytics
set ylabel "{/:Italic Δy/y} (10^{−6})" offset 1.2, 0
set label 100 "(d)"
set label 101 "dilates" at graph 0.05, graph 0.8 left font ",6.5" textcolor rgb "#707070"
set label 102 "compacts" at graph 0.05, graph 0.06 left font ",6.5" textcolor rgb "#707070"
plot 0 with lines linestyle 103 notitle, \
  for [g = 1:groups] data(g) using "theta":"centre_of_mass_strain" with points linetype g linewidth 1 pointsize 0.4 * symbol notitle
unset multiplot
