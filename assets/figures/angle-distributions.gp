# A panel for each angle: its histogram, the mean of each group as a line, and a remark above.
panel_top = 0.3 + 0.32 * groups
middle = '0.5 * (column("from") + column("to"))'
eval grid(panels, 3, 2, 3.4 + panel_top)
do for [g = 1:groups] { entry = add_line(sprintf("linetype %d", g), label(g)) }
eval open_page
do for [k = 1:panels] {
  eval place(k)
  y_from = 0
  x_title = value(sprintf("title_%d", k)) . " (°)"
  if (first_in_row(k)) { y_title = "share of the runs" }
  eval axes
  set label 100 letter(k) at graph 0.04, graph 0.92 left
  do for [g = 1:groups] {
    summary = value(sprintf("summary_%d_%d", k, g))
    set label g summary at screen (panel_at - tick_room) / width, screen (panel_from + panel_height + 0.32 + 0.32 * (groups - g)) / height left font fitted(summary, 6, panel_width + tick_room) textcolor rgb colour(g)
    mean = value(sprintf("mean_%d_%d", k, g))
    unset arrow g
    if (mean == mean) { set arrow g from first mean, graph 0 to first mean, graph 1 nohead linetype g linewidth 1 front }
  }
  file = value(sprintf("bins_%d", k))
  plot for [g = 1:groups] file using (@middle):(column(sprintf("share_%d", g))):(column("to") - column("from")) with boxes linetype g fillstyle transparent solid 0.2 noborder, \
    for [g = 1:groups] file using (@middle):(column(sprintf("share_%d", g))) with histeps linetype g dashtype solid linewidth 1.2
  eval seen
}
eval close_page
