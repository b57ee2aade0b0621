# A panel for each measure, up to the failure of each run, which is at the right.
set xlabel "{/:Italic θ_c} − {/:Italic θ} (deg)" offset 0, 0.3
set xrange [1.04 * theta_max : 0]
abscissa = 'column("angle_left")'
panel_top = 0.6
panel_bottom = 0.95
panel_left = 1.15
set tics font ",7"
set multiplot
do for [k = 1:panels] {
  eval panel((k - 1) / 3 + 1, rows, (k - 1) % 3 + 1, 3)
  ordinate = value(sprintf("quantity_%d", k))
  heading = sprintf("(%s) ", "abcdefghijklmnopqrstuvwxyz"[k:k]) . value(sprintf("title_%d", k))
  set label 1 heading at graph 0, graph 1.09 left font fitted(heading, 6, width / 3 - panel_left)
  plot @curves
  unset key
}
unset multiplot
