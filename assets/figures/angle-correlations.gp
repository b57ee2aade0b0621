# A triangle of panels: the angle of the row over that of the column, and above each the coefficient of each group.
size = angles - 1
left = 1.5
below = 1.2
cell_width = (width - left - 0.25) / size
cell_height = (height - key_height - below) / size
gap = 0.25
above = 0.12 + 0.28 * lines
set tics font ",6.5"
set multiplot
do for [second = 2:angles] {
  do for [first = 1:second - 1] {
    set lmargin at screen (left + (first - 1) * cell_width + gap) / width
    set rmargin at screen (left + first * cell_width) / width
    set tmargin at screen 1 - (key_height + (second - 2) * cell_height + above) / height
    set bmargin at screen 1 - (key_height + (second - 1) * cell_height) / height
    horizontal = value(sprintf("angle_%d", first))
    vertical = value(sprintf("angle_%d", second))
    set xrange [value(sprintf("low_%d", first)):value(sprintf("high_%d", first))]
    set yrange [value(sprintf("low_%d", second)):value(sprintf("high_%d", second))]
    set xtics value(sprintf("step_%d", first))
    set ytics value(sprintf("step_%d", second))
    if (second == angles) { set xlabel value(sprintf("title_%d", first)) . "  (deg)" font ",7" offset 0, 0.3; set format x "%g" } else { unset xlabel; set format x "" }
    if (first == 1) { set ylabel value(sprintf("title_%d", second)) . "  (deg)" font ",7" offset 0.5, 0; set format y "%g" } else { unset ylabel; set format y "" }
    do for [g = 1:groups] {
      set label g value(sprintf("r_%d_%d_%d", first, second, g)) at graph 0, graph 1 + (0.15 + 0.28 * (lines - value(sprintf("line_%d", g)))) / (cell_height - above) left font ",6.5" textcolor rgb colour(g)
    }
    plot for [g = 1:groups] data(g) using (column(horizontal)):(column(vertical)) with points linetype g linewidth 1 pointsize 0.3 * symbol notitle, \
      for [g = 1:groups] NaN with points linetype g linewidth 1 pointsize 0.45 * symbol title label(g)
    unset key
  }
}
unset multiplot
