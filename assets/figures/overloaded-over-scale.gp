# A panel for each periodic bed.
eval grid(groups, 1, 1, 0.7 * width)
do for [a = 1:words(shown)] { entry = add_curve(sprintf("linetype %d", a), value(sprintf("said_%d", a))) }
entry = add_line("linestyle 103", "paper, {/:Italic p_o} at {/:Italic θ_c}")
eval open_headed
do for [g = 1:groups] {
  eval place_headed(g)
  x_from = 0
  y_from = 0
  y_to = 1
  x_title = "{/:Italic ℓ} / {/:Italic D}"
  y_title = "{/:Italic p_o}"
  eval axes
  set arrow 1 from graph 0, first 0.6 to graph 1, first 0.6 nohead linestyle 103
  plot for [a = 1:words(shown)] data(g) using "l":(bar_from("p_o_" . word(shown, a))):(0):(bar_length("p_o_" . word(shown, a))) with vectors nohead linetype a dashtype solid linewidth 1, \
    for [a = 1:words(shown)] data(g) using "l":(column("p_o_" . word(shown, a))) with linespoints linetype a
  eval seen
}
eval close_page
