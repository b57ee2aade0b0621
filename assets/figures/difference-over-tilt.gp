# The difference in a panel for each quantity, over tilt.
set xlabel "{/:Italic θ} (deg)" offset 0, 0.3
set xrange [0 : 1.04 * theta_max]
file = figure . ".csv"
difference(name, times) = column(name) + times * column(name . "_error")
panel_top = 0.6
panel_bottom = 0.95
panel_left = 1.25
set tics font ",7"
set multiplot
do for [k = 1:panels] {
  eval panel((k - 1) / 3 + 1, rows, (k - 1) % 3 + 1, 3)
  name = value(sprintf("quantity_%d", k))
  heading = sprintf("(%s) ", "abcdefghijklmnopqrstuvwxyz"[k:k]) . value(sprintf("title_%d", k))
  set label 1 heading at graph 0, graph 1.09 left font fitted(heading, 6, width / 3 - panel_left)
  plot file using "theta":(difference(name, -2)):(difference(name, 2)) with filledcurves linetype 2 fillstyle transparent solid 0.13 noborder notitle, \
    file using "theta":(difference(name, -1)):(difference(name, 1)) with filledcurves linetype 2 fillstyle transparent solid 0.4 noborder notitle, \
    0 with lines linestyle 103 notitle, \
    file using "theta":(column(name)) with lines linetype 2 dashtype solid title label, \
    keyentry with boxes linecolor rgb ink[2] fillstyle transparent solid 0.4 noborder title "± its standard error", \
    keyentry with boxes linecolor rgb ink[2] fillstyle transparent solid 0.13 noborder title "± twice that"
  unset key
}
unset multiplot
