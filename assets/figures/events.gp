# Distributions of sizes and of waiting angles, then sizes and changes of volume over the tilt.
sizes(g) = value(sprintf("sizes_%d", g))
waits(g) = value(sprintf("waits_%d", g))
eval grid(4, 2, 1, width > 12 ? 5.6 : 5)
do for [g = 1:groups] { entry = add_curve(sprintf("linetype %d", g), label(g)) }
entry = add_line("linecolor rgb \"#000000\" dashtype solid linewidth 1.5", "power law (a, b)")
entry = add_line("linecolor rgb \"#000000\" dashtype (2,3) linewidth 1", "exponential law (b)")
eval open_page
do for [k = 1:4] {
  eval place(k)
  law = k == 1 ? "size_law_%d" : "wait_law_%d"
  do for [g = 1:groups] { unset label g }
  if (k < 3) {
    x_log = 1
    x_from = k == 1 ? energy_from : waiting_from
    x_to = k == 1 ? energy_to : waiting_to
    x_title = k == 1 ? "energy released {/:Italic E} / ({/:Italic mgD})" : "waiting angle (°)"
    y_log = 1
    # Room below the curves for the formulas of their laws.
    y_from = 0.7 / events_most * 10 ** (-0.16 * groups)
    y_to = 1.5
    y_title = k == 1 ? "share with {/:Italic E} or more" : "share with as long or longer"
  } else {
    x_from = 0
    x_to = 1.03 * theta_max
    x_title = "{/:Italic θ} (°)"
    y_log = k == 3
    y_plain = k == 4
    y_from = k == 3 ? energy_from : -largest_change
    y_to = k == 3 ? energy_to : largest_change
    y_title = k == 3 ? "{/:Italic E} / ({/:Italic mgD})" : "{/:Italic Δy/y} (10^{−6})"
  }
  eval axes
  if (k < 3) {
    do for [g = 1:groups] {
      said = value(sprintf(law, g))
      set label g said at graph 0.04, graph 0.06 + 0.075 * (groups - g) left font fitted(said, 6.5, 0.92 * panel_width) textcolor rgb colour(g)
    }
  }
  eval sprintf("set label 100 '%s' at graph %g, graph 0.92 %s", letter(k), k < 3 ? 0.95 : 0.05, k < 3 ? "right" : "left")
  if (k == 1) {
    plot for [g = 1:groups] sizes(g) using "energy":"share" with points linetype g pointsize 0.35 * symbol, \
      for [g = 1:groups] sizes(g) using "energy":"power_law" with lines linetype g dashtype solid linewidth 1.5
  }
  if (k == 2) {
    plot for [g = 1:groups] waits(g) using "waiting":"share" with points linetype g pointsize 0.35 * symbol, \
      for [g = 1:groups] waits(g) using "waiting":"power_law" with lines linetype g dashtype solid linewidth 1.5, \
      for [g = 1:groups] waits(g) using "waiting":"exponential_law" with lines linetype g dashtype (2,3) linewidth 1
  }
  if (k == 3) {
    plot for [g = 1:groups] data(g) using "theta":(column("energy") > 0 ? column("energy") : NaN) with points linetype g linewidth 1 pointsize 0.4 * symbol
  }
  if (k == 4) {
    # Linear within about 1e-6, logarithmic beyond; numbers at powers of ten, as many as fit.
    set nonlinear y via asinh(y / 2.0) inverse 2.0 * sinh(y)
    top_power = floor(log10(largest_change) + 1e-9)
    every_power = larger(1, ceil((top_power + 1) * 0.5 / (0.5 * panel_height)))
    set ytics ("0" 0)
    do for [n = top_power:0:-every_power] {
      if (asinh(0.5 * 10.0 ** n) / asinh(0.5 * largest_change) * 0.5 * panel_height > 0.36) { set ytics add (power_text(n) 10.0 ** n, "−" . power_text(n) -10.0 ** n) }
    }
    set label 101 "dilates" at graph 0.05, graph 0.8 left font ",6.5" textcolor rgb "#707070"
    set label 102 "compacts" at graph 0.05, graph 0.06 left font ",6.5" textcolor rgb "#707070"
    plot 0 with lines linestyle 104, \
      for [g = 1:groups] data(g) using "theta":"centre_of_mass_strain" with points linetype g linewidth 1 pointsize 0.4 * symbol
  }
  eval seen
}
eval close_page
