# Above, the angle at rest over each angle with which it is compared; below, one run over time, if it has a flow.
grid_below = flow ? 4.6 : 0
eval grid(4, 4, 2, 4.4)
array filled[8] = [7, 5, 9, 13, 11, 15, 7, 5]
do for [g = 1:groups] { entry = add_entry(sprintf("linetype %d dashtype solid linewidth 1", g), sprintf("linetype %d pointtype %d", g, filled[int((g - 1) % 8) + 1]), "", label(g)) }
entry = add_line("linestyle 103", "{/:Italic θ_r} = abscissa")
if (flow) {
  entry = add_line("linecolor rgb \"#000000\" dashtype solid linewidth 2", "{/:Italic θ} (e)")
  entry = add_line("linecolor rgb \"#1f4e79\" dashtype solid linewidth 1", "surface velocity (e)")
}
eval open_page
array titles[4] = ["{/:Italic θ_c} (°)", "{/:Italic θ_d} ({/:Italic l_c} max) (°)", "{/:Italic θ_d} (percolation) (°)", "{/:Italic θ_d} (dilation) (°)"]
last = word(factors, words(factors))
first_of = sprintf("theta_c lc_jump_%s percolation_%s dilation_volume", word(factors, 1), word(factors, 1))
second_of = sprintf("theta_c lc_jump_%s percolation_%s dilation_centre", last, last)
array open[8] = [6, 4, 8, 12, 10, 14, 6, 4]
do for [panel = 1:4] {
  eval place(panel)
  x_from = 0
  x_to = theta_end
  y_from = lowest
  y_to = highest
  x_title = titles[panel]
  if (first_in_row(panel)) { y_title = "{/:Italic θ_r} (°)" } else { y_bare = 1 }
  eval axes
  set label 1 letter(panel) at graph 0.05, graph 0.93 left
  one = word(first_of, panel)
  two = word(second_of, panel)
  low(name) = panel == 1 ? column(name) : column(name . "_low")
  high(name) = panel == 1 ? column(name) : column(name . "_high")
  plot sample [lowest:highest] x with lines linestyle 103, \
    for [g = 1:groups] data(g) using (column(one)):"theta_r":(low(one)):(high(one)) \
      with xerrorbars linetype g dashtype solid linewidth 1 pointtype filled[int((g - 1) % 8) + 1] pointsize 0.4, \
    for [g = 1:groups] data(g) using (column(two)):"theta_r":(low(two)):(high(two)) \
      with xerrorbars linetype g dashtype solid linewidth 1 pointtype open[int((g - 1) % 8) + 1] pointsize 0.55
  eval seen
}
if (flow) {
  # Two quantities over one axis: the velocity is scaled to the axis of the angle, with its numbers at the right.
  trace = figure . "-trace.csv"
  set xrange [*:*]
  set yrange [*:*]
  stats trace using "velocity" name "v" nooutput
  stats trace using "theta" name "angle" nooutput
  v_step = nice(larger(v_max, 1e-12) / 4)
  v_top = v_step * ceil(v_max / v_step + 1e-6)
  v_top = v_top > 0 ? v_top : 1
  v_power = common_power(0, v_top)
  v_room = text_cm(number(v_top, v_step, v_power), tick_points) + 0.75
  eval place_at(5, title_room + tick_room + number_gap, width - v_room, 1.0, grid_below - 0.3)
  y_from = low_end(angle_min, angle_max)
  y_to = high_end(angle_min, angle_max)
  x_title = "time since failure (s)"
  y_title = "{/:Italic θ} (°)"
  eval axes
  set ytics nomirror
  eval "set y2range [0:v_top]; set y2tics (" . tick_list(0, last_tick(v_top, v_step), v_step, v_power) . ") textcolor rgb '#1f4e79'"
  v_title = with_power("surface velocity / ({/:Italic gD})^{1/2}", v_power)
  set label 2 v_title at screen (width - 0.25) / width, graph 0.5 center rotate by 90 textcolor rgb "#1f4e79" font fitted(v_title, title_points, panel_height + 0.8)
  set label 1 letter(5) at graph 0.985, graph 0.92 right
  plot trace using "time":"velocity" axes x1y2 with lines linecolor rgb "#1f4e79" dashtype solid linewidth 1, \
    trace using "time":"theta" axes x1y1 with lines linecolor rgb "#000000" dashtype solid linewidth 2
  eval seen
}
eval close_page
