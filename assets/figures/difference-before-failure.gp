# The difference, in a panel for each quantity, up to the failure of each run at the right.
file = figure . ".csv"
difference(name, times) = column(name) + times * column(name . "_error")
eval grid(panels, 3, 2, width > 12 ? 4.2 : 3.7)
entry = add_line("linetype 2 dashtype solid", label)
entry = add_box("fillcolor rgb ink[2] fillstyle transparent solid 0.4 noborder", "± its standard error")
entry = add_box("fillcolor rgb ink[2] fillstyle transparent solid 0.13 noborder", "± twice that")
eval open_page
panel_top = 0.62
title_room = 0
do for [k = 1:panels] {
  eval place(k)
  x_from = 1.04 * theta_max
  x_to = 0
  x_title = "{/:Italic θ_c} − {/:Italic θ} (°)"
  heading = letter(k) . " " . value(sprintf("title_%d", k))
  eval axes
  name = value(sprintf("quantity_%d", k))
  plot file using "angle_left":(difference(name, -2)):(difference(name, 2)) with filledcurves linetype 2 fillstyle transparent solid 0.13 noborder, \
    file using "angle_left":(difference(name, -1)):(difference(name, 1)) with filledcurves linetype 2 fillstyle transparent solid 0.4 noborder, \
    0 with lines linestyle 104, \
    file using "angle_left":(column(name)) with lines linetype 2 dashtype solid
  eval seen
}
eval close_page
