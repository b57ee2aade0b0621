data = figure . ".csv"
states = "start repose"
eval grid(3, 3, 1, width > 12 ? 5.9 : 4.6)
do for [s = 1:2] {
  entry = add_point(sprintf("pointtype %d linecolor rgb '%s' pointsize 0.4 * symbol", s == 1 ? 6 : 7, s == 1 ? "#808080" : "#000000"), "{/:Italic θ} = " . value("theta_" . word(states, s)) . "° (a)")
}
entry = add_entry("linetype 1", "linetype 1 pointsize 0.3 * symbol", "", "components (b, c)")
entry = add_entry("linetype 2", "linetype 2 pointsize 0.3 * symbol", "", "loops (b, c)")
entry = add_line("linestyle 103", "death at birth (a); {/:Italic θ_c} (b, c)")
eval open_page
set label 1 letter(1) at graph 0.04, graph 0.93 left
eval place(1)
x_from = 0
y_from = 0
x_title = "birth, {/:Italic f} / ⟨{/:Italic f} ⟩"
y_title = "death, {/:Italic f} / ⟨{/:Italic f} ⟩"
eval axes
plot x with lines linestyle 103, \
  for [s = 1:2] figure . "-" . word(states, s) . ".csv" using "birth":"death" with points pointtype s == 1 ? 6 : 7 pointsize 0.25 * symbol linecolor rgb s == 1 ? "#808080" : "#000000"
eval seen
set arrow 1 from first theta_c, graph 0 to first theta_c, graph 1 nohead linestyle 103
do for [panel = 2:3] {
  eval place(panel)
  x_from = 0
  x_to = 1.1 * theta_c
  y_from = 0
  x_title = "{/:Italic θ} (°)"
  y_title = panel == 2 ? "total persistence per grain" : "change from frame to frame"
  eval axes
  set label 1 letter(panel)
  name(what) = panel == 2 ? what : what . "_change"
  plot data using "theta":(column(name("components"))) with linespoints linetype 1 pointsize 0.3 * symbol, \
    data using "theta":(column(name("loops"))) with linespoints linetype 2 pointsize 0.3 * symbol
  eval seen
}
eval close_page
