# Two strains, and theta_d by each estimator, all over the same axis.
set xlabel "{/:Italic θ} (deg)"
set xrange [-0.5 : 1.04 * (theta_max > 15 ? theta_max : 15)]
set multiplot
panel_left = 1.8
scale = 1000
do for [row = 1:2] {
  eval panel(row, 3, 1, 1)
  ordinate = word("volume_strain centre_of_mass_strain", row)
  set ytics value("step_" . ordinate)
  set ylabel "{/:Italic ε_" . "Vy"[row:row] . "}  (10^{−3})" offset 0.5, 0
  set label 1 sprintf("(%s)", "ab"[row:row]) at graph 0.03, graph 0.9
  plot @curves, 0 with lines linestyle 103 notitle
  unset key
}
eval panel(3, 3, 1, 1)
scale = 1
unset ylabel
set label 1 "(c)"
set yrange [0.4 : estimators + 0.6]
set ytics ("" 0) scale 0
eval sprintf('set ytics font ",%g"', estimators > 6 ? 42.0 / estimators : 7)
do for [e = 1:estimators] { set ytics add (value(sprintf("estimator_%d", e)) e) }
set arrow 1 from 15, graph 0 to 15, graph 1 nohead linestyle 103
row_of(g) = column("estimator") + 0.2 * (0.5 * (groups + 1) - g)
plot for [g = 1:groups] value(sprintf("theta_d_%d", g)) using (bar_from("theta_d")):(row_of(g)):(bar_length("theta_d")):(0) with vectors nohead linetype g dashtype solid linewidth 1, \
  for [g = 1:groups] value(sprintf("theta_d_%d", g)) using "theta_d":(row_of(g)) with points linetype g
unset multiplot
