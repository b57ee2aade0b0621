# A row for each measure, the best first: its contrast, and the error of the distance that it tells.
scale = 1
file = figure . ".csv"
names_cm = 0.0
name_points = 6.5
do for [r = 1:rows] { names_cm = larger(names_cm, text_cm(value(sprintf("row_%d", r)), name_points)) }
if (names_cm > 0.5 * width) { name_points = name_points * 0.5 * width / names_cm; names_cm = 0.5 * width }
stacked = width < 12
chart_height = 1.2 + 0.36 * rows
height = stacked ? 2 * chart_height : chart_height
entry = add_point("pointtype 7 pointsize 0.55 * symbol linecolor rgb \"#000000\"", "1 deg before {/:Italic θ_c} (a)")
entry = add_point("pointtype 7 pointsize 0.45 * symbol linecolor rgb ink[2]", "2 deg (a)")
entry = add_point("pointtype 6 pointsize 0.45 * symbol linecolor rgb \"#999999\"", "3 deg (a)")
entry = add_point("pointtype 7 pointsize 0.45 * symbol linecolor rgb \"#000000\"", "alone (b)")
entry = add_point("pointtype 6 pointsize 0.45 * symbol linecolor rgb ink[3]", "with the tilt (b)")
entry = add_line("linestyle 103", "who knows the tilt alone (b)")
entry = add_line("linestyle 102", "who knows nothing (b)")
eval open_page
chart_from = names_cm + 0.25
chart_cm = stacked ? width - chart_from - x_overhang - 0.1 : 0.5 * (width - chart_from - x_overhang - 0.5)
do for [panel = 1:2] {
  chart_left = chart_from + (stacked ? 0 : (panel - 1) * (chart_cm + 0.5))
  chart_top = height - key_height - 0.1 - (stacked ? (panel - 1) * chart_height : 0)
  eval place_at(panel, chart_left, chart_left + chart_cm, chart_top + 1.1 - chart_height, chart_top)
  y_from = rows + 0.5
  y_to = 0.5
  if (panel == 2) { x_from = 0; x_to = 1.08 * nothing }
  x_title = panel == 1 ? "change / deviation of the beds" : "error of {/:Italic θ_c} − {/:Italic θ} (deg)"
  unset label
  unset arrow
  unset object
  eval axes
  unset ytics
  if (tilt_row <= rows) { set object 1 rectangle from graph 0, first tilt_row - 0.5 to graph 1, first tilt_row + 0.5 behind fillcolor rgb "#e4e4e4" fillstyle solid noborder }
  do for [r = 1:rows] {
    if (panel == 1 || stacked) { set label 200 + r value(sprintf("row_%d", r)) at screen (panel_at - 0.1) / width, first r right font sprintf(",%g", name_points) }
    if (r < rows) { set arrow from graph 0, first r + 0.5 to graph 1, first r + 0.5 nohead linecolor rgb "#dddddd" linewidth 0.7 back }
  }
  here(name) = column("rank") <= rows ? column(name) : NaN
  set label 100 letter(panel) at graph 0.97, screen (panel_from + 0.3) / height right
  if (panel == 1) {
    set arrow from first 0, graph 0 to first 0, graph 1 nohead linecolor rgb "#555555" linewidth 1 back
    plot file using (here("contrast_3")):(column("rank")) with points pointtype 6 pointsize 0.45 * symbol linecolor rgb "#999999", \
      file using (here("contrast_2")):(column("rank")) with points pointtype 7 pointsize 0.45 * symbol linecolor rgb colour(2), \
      file using (here("contrast_1")):(column("rank")) with points pointtype 7 pointsize 0.55 * symbol linecolor rgb "#000000", \
      file using (0):(column("rank")) every ::0::0 with points pointtype -1
  } else {
    set arrow from first tilt, graph 0 to first tilt, graph 1 nohead linestyle 103 back
    set arrow from first nothing, graph 0 to first nothing, graph 1 nohead linestyle 102 back
    plot file using (bar_from("error")):(here("rank") - 0.14):(bar_length("error")):(0) with vectors nohead linecolor rgb "#000000" dashtype solid linewidth 1, \
      file using (bar_from("with_tilt")):(here("rank") + 0.14):(bar_length("with_tilt")):(0) with vectors nohead linecolor rgb colour(3) dashtype solid linewidth 1, \
      file using (here("error")):(column("rank") - 0.14) with points pointtype 7 pointsize 0.45 * symbol linecolor rgb "#000000", \
      file using (here("with_tilt")):(column("rank") + 0.14) with points pointtype 6 pointsize 0.45 * symbol linecolor rgb colour(3)
  }
  eval seen
  set tics
}
eval close_page
