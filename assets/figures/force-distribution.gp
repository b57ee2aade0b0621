data = figure . ".csv"
positive(name) = column(name) > 0 ? column(name) : NaN
eval grid(2, 2, 1, width > 12 ? 7 : 5.5)
do for [s = 1:words(states)] { entry = add_curve(sprintf("linetype %d", s), "{/:Italic θ} = " . word(tilts, s) . "°") }
eval open_page
do for [panel = 1:2] {
  eval place(panel)
  x_from = panel == 1 ? 0 : 1e-3
  x_to = panel == 1 ? 10 : 20
  x_log = panel == 2
  y_from = 1e-4
  y_to = 10
  y_log = 1
  x_title = "{/:Italic f} / ⟨{/:Italic f} ⟩"
  y_title = "{/:Italic P}({/:Italic f} / ⟨{/:Italic f} ⟩)"
  eval axes
  set label 1 letter(panel) at graph 0.96, graph 0.93 right
  plot for [s = 1:words(states)] data using (sqrt(column("force_from") * column("force_to"))):(positive("density_" . word(states, s))):(column("density_" . word(states, s) . "_error")) with yerrorlines linetype s, \
    for [s = 1:words(states)] data using (sqrt(column("force_from") * column("force_to"))):(positive("density_" . word(states, s))) with linespoints linetype s
  eval seen
}
eval close_page
