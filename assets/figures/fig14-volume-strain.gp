# Two strains, and theta_d by each estimator, over the same axis.
eval grid(3, 1, 1, height / 3)
eval key_of_curves
entry = add_line("linestyle 103", "paper, {/:Italic θ_d} = 15°")
eval open_page
estimator_points = estimators > 6 ? 42.0 / estimators : 7
do for [e = 1:estimators] { tick_room = larger(tick_room, text_cm(value(sprintf("estimator_%d", e)), estimator_points)) }
do for [row = 1:3] {
  eval place(row)
  x_from = theta_max > 15 ? -0.02 * theta_max : -0.3
  x_to = 1.04 * (theta_max > 15 ? theta_max : 15)
  x_title = "{/:Italic θ} (°)"
  set label 1 letter(row) at graph 0.03, graph 0.9
  if (row < 3) {
    y_title = "{/:Italic ε_" . "Vy"[row:row] . "}"
    eval axes
    ordinate = word("volume_strain centre_of_mass_strain", row)
    plot 0 with lines linestyle 104, @curves
  } else {
    y_from = 0.4
    y_to = estimators + 0.6
    eval axes
    set ytics ("" 0) scale 0
    eval sprintf('set ytics font ",%g"', estimator_points)
    do for [e = 1:estimators] { set ytics add (value(sprintf("estimator_%d", e)) e) }
    set arrow 1 from 15, graph 0 to 15, graph 1 nohead linestyle 103
    row_of(g) = column("estimator") + 0.2 * (0.5 * (groups + 1) - g)
    plot for [g = 1:groups] value(sprintf("theta_d_%d", g)) using (bar_from("theta_d")):(row_of(g)):(bar_length("theta_d")):(0) with vectors nohead linetype g dashtype solid linewidth 1, \
      for [g = 1:groups] value(sprintf("theta_d_%d", g)) using "theta_d":(row_of(g)) with points linetype g
  }
  eval seen
}
eval close_page
