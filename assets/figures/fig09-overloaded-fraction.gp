# A panel for each threshold.
eval grid(thresholds, 2, 1, width > 12 ? 6.5 : 5)
eval key_of_curves
entry = add_point("linestyle 101", "paper")
eval open_page
do for [t = 1:thresholds] {
  eval place(t)
  x_from = 0
  x_to = 1.04 * (theta_max > 21 ? theta_max : 21)
  y_from = 0
  y_to = 1
  x_title = "{/:Italic θ} (°)"
  y_title = "{/:Italic p_o}"
  eval axes
  ordinate = "p_o_" . value(sprintf("factor_%d", t))
  set label 1 letter(t) . " " . value(sprintf("threshold_%d", t)) at graph 0.03, graph 0.93
  plot @curves, figure . "-paper.csv" using "theta":"p_o" with points linestyle 101
  eval seen
}
eval close_page
