# A panel for each angle: its histogram, the mean of each group as a line, and what there is to say of it above.
panel_top = 0.28 + 0.32 * groups
panel_bottom = 1.05
panel_left = 1.5
set tics font ",7"
set xrange [*:*] noextend
set yrange [0:*]
set offsets 0, 0, graph 0.2, 0
middle = '0.5 * (column("from") + column("to"))'
set multiplot
do for [k = 1:panels] {
  eval panel((k - 1) / 3 + 1, rows, (k - 1) % 3 + 1, 3)
  set xlabel value(sprintf("title_%d", k)) . "  (deg)" offset 0, 0.3
  if (k % 3 == 1) { set ylabel "share of the runs" offset 0.6, 0 } else { unset ylabel }
  set label 100 sprintf("(%s)", "abcdefghijkl"[k:k]) at graph 0.04, graph 0.92 left
  panel_cm = (height - key_height) / rows - panel_top - panel_bottom
  do for [g = 1:groups] {
    set label g value(sprintf("summary_%d_%d", k, g)) at graph -0.12, graph 1 + (0.25 + 0.32 * (groups - g)) / panel_cm left font ",6" textcolor rgb colour(g)
    mean = value(sprintf("mean_%d_%d", k, g))
    unset arrow g
    if (mean == mean) { set arrow g from first mean, graph 0 to first mean, graph 1 nohead linetype g linewidth 1 front }
  }
  file = value(sprintf("bins_%d", k))
  plot for [g = 1:groups] file using (@middle):(column(sprintf("share_%d", g))):(column("to") - column("from")) with boxes linetype g fillstyle transparent solid 0.2 noborder notitle, \
    for [g = 1:groups] file using (@middle):(column(sprintf("share_%d", g))) with histeps linetype g dashtype solid linewidth 1.2 notitle, \
    for [g = 1:groups] NaN with lines linetype g title label(g)
  unset key
}
unset multiplot
