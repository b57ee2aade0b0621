# A rose for each state, in `states` and `tilts`. A normal and its opposite are the same direction, so each
# wedge is drawn twice. Lengths are densities. The outline consists of arcs and of steps between bins.
data = figure . ".csv"
largest = 0
array force[words(states)]
do for [s = 1:words(states)] {
  stats data using (column("density_" . word(states, s))) name "stats_plain" nooutput
  stats data using (last_force = column("by_force_" . word(states, s))) name "stats_force" nooutput
  force[s] = last_force
  largest = larger(largest, 1.02 * larger(stats_plain_max, stats_force_max))
}
half = 1.25 * largest
eval grid(words(states), 2, 1, width > 12 ? 8.2 : 7.6)
entry = add_box("fillcolor rgb \"#bbbbbb\" fillstyle solid 1 noborder", "contacts")
entry = add_line("linetype 1 linewidth 2", "weighted by force")
entry = add_line("linetype 1 dashtype solid linewidth 0.75", "all directions alike")
least_row_cm = 6
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
do for [s = 1:words(states)] {
  state = word(states, s)
  eval place(s)
  do for [k = 0:5] {
    set arrow k + 1 from 0, 0 to 1.07 * largest * cos(60 * k * rad), 1.07 * largest * sin(60 * k * rad) nohead linestyle 103 front
    set label k + 1 sprintf("%d°", 60 * k % 180) at 1.15 * largest * cos(60 * k * rad), 1.15 * largest * sin(60 * k * rad) center
  }
  set object 1 circle at 0, 0 size 1 / pi front fillstyle empty border rgb "#000000" linewidth 0.75
  set label 10 letter(s) . "  {/:Italic θ} = " . word(tilts, s) . "°" at screen (panel_at + 0.1) / width, screen (panel_from + panel_height - 0.35) / height left
  before = force[s]
  plot for [turn = 0:1] data using (0):(0):(column("density_" . state)):(column("direction_from") + 180 * turn):(column("direction_to") + 180 * turn) \
      with circles linetype 1 linewidth 0.5 fillstyle solid 1 border rgb "#bbbbbb" fillcolor rgb "#bbbbbb", \
    for [turn = 0:1] data using (0):(0):(column("by_force_" . state)):(column("direction_from") + 180 * turn):(column("direction_to") + 180 * turn) \
      with circles linetype 1 linewidth 2 fillstyle empty border rgb "#000000", \
    for [turn = 0:1] data using (a = (column("direction_from") + 180 * turn) * rad, r = before, before = column("by_force_" . state), r * cos(a)): \
      (r * sin(a)):((before - r) * cos(a)):((before - r) * sin(a)) with vectors nohead linetype 1 linewidth 2
}
eval close_page
