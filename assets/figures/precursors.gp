# A panel for each measure, up to the failure of each run at the right.
abscissa = 'column("angle_left")'
symbols = 0
eval grid(panels, 3, 2, width > 12 ? 4.2 : 3.7)
eval key_of_curves
eval open_page
panel_top = 0.62
title_room = 0
do for [k = 1:panels] {
  eval place(k)
  x_from = 1.04 * theta_max
  x_to = 0
  y_top = exists(sprintf("top_%d", k)) ? value(sprintf("top_%d", k)) : NaN
  x_title = "{/:Italic θ_c} − {/:Italic θ} (°)"
  heading = letter(k) . " " . value(sprintf("title_%d", k))
  eval axes
  ordinate = value(sprintf("quantity_%d", k))
  plot @curves
  eval seen
}
eval close_page
