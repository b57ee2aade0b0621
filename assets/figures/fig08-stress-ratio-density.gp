# A panel for each periodic bed.
eval grid(groups, 1, 1, 0.7 * width)
do for [a = 1:words(shown)] { entry = add_curve(sprintf("linetype %d", a), value(sprintf("said_%d", a))) }
entry = add_line("linestyle 102", "Γ_c and 2 Γ_c")
eval open_headed
do for [g = 1:groups] {
  eval place_headed(g)
  x_from = 0
  x_to = 1
  y_from = 0
  x_title = "{/:Italic γ}"
  y_title = "{/:Italic P}({/:Italic γ})"
  eval axes
  do for [f = 1:2] {
    unset arrow f
    unset label f
    threshold = f * value(sprintf("gamma_c_%d", g))
    if (threshold > 1) { continue }
    set arrow f from threshold, graph 0 to threshold, graph 1 nohead linestyle 102
    name = f == 1 ? "Γ_c" : "2 Γ_c"
    if (threshold < 0.85) { set label f name at threshold, graph 0.93 left offset character 0.4, 0 }
    else { set label f name at threshold, graph 0.93 right offset character -0.4, 0 }
  }
  bands = value(sprintf("several_%d", g)) ? words(shown) : 0
  plot for [a = 1:bands] data(g) using "gamma":(band_low("density_" . word(shown, a), "_error")):(band_high("density_" . word(shown, a), "_error")) with filledcurves linetype a fillstyle transparent solid 0.3 noborder, \
       for [a = 1:words(shown)] data(g) using "gamma":(column("density_" . word(shown, a))) with linespoints linetype a pointinterval 3
  eval seen
}
eval close_page
