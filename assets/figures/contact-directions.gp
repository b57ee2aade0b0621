# Two roses, at the start of the tilt and right before failure. A normal and its opposite are one direction: each
# wedge is drawn twice. Lengths are densities. The outline has arcs, and steps from the bin before to each.
data = figure . ".csv"
states = "start repose"
stats data using "density_start" name "number0" nooutput
stats data using "density_repose" name "number1" nooutput
stats data using (force_start = column("by_force_start")) name "force0" nooutput
stats data using (force_repose = column("by_force_repose")) name "force1" nooutput
largest = 1.02 * larger(larger(number0_max, number1_max), larger(force0_max, force1_max))
half = 1.25 * largest
eval grid(2, 2, 1, width > 12 ? 8.2 : 7.6)
entry = add_box("fillcolor rgb \"#bbbbbb\" fillstyle solid 1 noborder", "contacts")
entry = add_line("linetype 1 linewidth 2", "weighted by force")
entry = add_line("linetype 1 dashtype solid linewidth 0.75", "all directions alike")
eval open_page
set style circle nowedge
unset border
unset tics
set size ratio -1
set xrange [-half:half]
set yrange [-half:half]
title_room = 0
tick_room = 0
panel_top = 0
panel_bottom = 0
do for [s = 1:2] {
  state = word(states, s)
  eval place(s)
  do for [k = 0:5] {
    set arrow k + 1 from 0, 0 to 1.07 * largest * cos(60 * k * rad), 1.07 * largest * sin(60 * k * rad) nohead linestyle 103 front
    set label k + 1 sprintf("%d°", 60 * k % 180) at 1.15 * largest * cos(60 * k * rad), 1.15 * largest * sin(60 * k * rad) center
  }
  set object 1 circle at 0, 0 size 1 / pi front fillstyle empty border rgb "#000000" linewidth 0.75
  set label 10 letter(s) . "  {/:Italic θ} = " . value("theta_" . state) . "°" at screen (panel_at + 0.1) / width, screen (panel_from + panel_height - 0.35) / height left
  before = value("force_" . state)
  plot for [turn = 0:1] data using (0):(0):(column("density_" . state)):(column("direction_from") + 180 * turn):(column("direction_to") + 180 * turn) \
      with circles linetype 1 linewidth 0.5 fillstyle solid 1 border rgb "#bbbbbb" fillcolor rgb "#bbbbbb", \
    for [turn = 0:1] data using (0):(0):(column("by_force_" . state)):(column("direction_from") + 180 * turn):(column("direction_to") + 180 * turn) \
      with circles linetype 1 linewidth 2 fillstyle empty border rgb "#000000", \
    for [turn = 0:1] data using (a = (column("direction_from") + 180 * turn) * rad, r = before, before = column("by_force_" . state), r * cos(a)): \
      (r * sin(a)):((before - r) * cos(a)):((before - r) * sin(a)) with vectors nohead linetype 1 linewidth 2
}
eval close_page
