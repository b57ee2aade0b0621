# Two charts of rows: the difference from the paper in units of the tolerance. The symbols of a row are below each other;
# filled ones agree. A value beyond +-limit is an arrow at the edge with its number.
limit = 6.0
array full[4] = [7, 5, 9, 13]
array open[4] = [6, 4, 8, 12]
names = "packing chain"
said(name, what, k) = value(sprintf("%s_%s_%d", name, what, k))
# Widths of the texts left and right of a chart, cm; their letters are small enough for a third of the chart each.
stacked = width < 12
chart_room = stacked ? width : 0.5 * width
array left_cm[2]
array right_cm[2]
row_points = 7
do for [panel = 1:2] {
  name = word(names, panel)
  left_cm[panel] = 0.3
  right_cm[panel] = text_cm("paper", row_points)
  do for [r = 1:value(name . "_rows")] {
    left_cm[panel] = larger(left_cm[panel], text_cm(said(name, "row", r), row_points))
    right_cm[panel] = larger(right_cm[panel], text_cm(said(name, "paper", r), row_points))
  }
  do for [s = 1:value(name . "_series")] {
    entry = add_point(sprintf("pointtype %d pointsize %g linecolor rgb '%s'", full[int((s - 1) % 4) + 1], 0.5 * symbol, colour(s)), said(name, "label", s) . " " . letter(panel))
  }
}
chart_height = larger(packing_rows, chain_rows) * 0.42 + 1.5
height = stacked ? chart_height * 2 : chart_height
eval open_page
do for [panel = 1:2] {
  name = word(names, panel)
  rows = value(name . "_rows")
  if (rows == 0) { continue }  # nothing to compare
  series = value(name . "_series")
  file = figure . "-" . name . ".csv"
  from = stacked ? 0 : (panel - 1) * chart_room
  cut = left_cm[panel] + right_cm[panel] > 0.65 * chart_room ? 0.65 * chart_room / (left_cm[panel] + right_cm[panel]) : 1
  top = height - key_height - (stacked ? (panel - 1) * chart_height : 0)
  eval place_at(panel, from + left_cm[panel] * cut + 0.2, from + chart_room - right_cm[panel] * cut - 0.2, top - chart_height + 1.0, top - 0.45)
  x_from = -limit - 0.5
  x_to = limit + 0.5
  y_from = rows + 0.5
  y_to = 0.5
  x_title = "(ours − paper) / tolerance"
  unset arrow
  unset label
  eval axes
  unset ytics
  row_font = sprintf(",%g", row_points * cut)
  do for [r = 1:rows] {
    set label 200 + r said(name, "row", r) at screen (panel_at - 0.1) / width, first r right font row_font
    set label 400 + r said(name, "paper", r) at screen (panel_at + panel_width + 0.1) / width, first r left textcolor rgb "#555555" font row_font
    if (r < rows) { set arrow from graph 0, first r + 0.5 to graph 1, first r + 0.5 nohead linecolor rgb "#dddddd" linewidth 0.7 back }
  }
  set object 1 rectangle from first -1, graph 0 to first 1, graph 1 behind fillcolor rgb "#e4e4e4" fillstyle solid noborder
  set arrow from first 0, graph 0 to first 0, graph 1 nohead linecolor rgb "#555555" linewidth 1 back
  set label 100 letter(panel) at screen (panel_at - 0.1) / width, screen (top - 0.25) / height right font row_font
  set label 101 "paper" at screen (panel_at + panel_width + 0.1) / width, screen (top - 0.25) / height left textcolor rgb "#555555" font row_font
  dodge(s) = (s - 0.5 * (series + 1)) * 0.27
  here(s, a) = column("series") == s && column("agrees") == a && abs(column("score")) <= limit ? column("score") : NaN
  beyond(s, side) = column("series") == s && side * column("score") > limit ? side * (limit + 0.25) : NaN
  absent(s) = column("series") == s && stringcolumn("ours") eq "NaN" ? limit + 0.25 : NaN
  plot for [s = 1:series] file using (here(s, 1)):(column("row") + dodge(s)) with points pointtype full[int((s - 1) % 4) + 1] pointsize 0.5 * symbol linecolor rgb colour(s), \
    for [s = 1:series] file using (here(s, 0)):(column("row") + dodge(s)) with points pointtype open[int((s - 1) % 4) + 1] pointsize 0.5 * symbol linecolor rgb colour(s), \
    for [s = 1:series] for [side = -1:1:2] file using (beyond(s, side) - side * 0.5):(column("row") + dodge(s)):(side * 0.6):(0) \
      with vectors head filled size screen 0.006, 25 linecolor rgb colour(s) dashtype solid linewidth 1.2, \
    for [s = 1:series] file using (absent(s)):(column("row") + dodge(s)) with points pointtype 2 pointsize 0.45 * symbol linecolor rgb colour(s)
  eval seen
  set tics
}
eval close_page
