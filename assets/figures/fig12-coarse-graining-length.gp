# Mean above, largest below; a column of panels for each threshold, with the range of the first: its lengths are largest.
set xlabel "{/:Italic θ} (deg)"
set xrange [0 : 1.04 * (theta_max > 21 ? theta_max : 21)]
set multiplot
do for [row = 1:2] {
  length = word("mean max", row)
  set ylabel "{/:Italic ℓ_c}^{" . length . "} / {/:Italic D}"
  set yrange [0:*]
  do for [t = 1:thresholds] {
    eval panel(row, 2, t, thresholds)
    ordinate = length . "_" . value(sprintf("factor_%d", t))
    set label 1 sprintf("(%s) ", "ab"[row:row]) . value(sprintf("threshold_%d", t)) at graph 0.03, graph 0.93
    if (row == 2) {
      set yrange [0 : 1.2 * cut]
      set ytics 10
    }
    plot @curves, figure . "-paper.csv" using "theta":(column(length)) with points linestyle 101 title "paper", \
      row == 2 ? cut : NaN with lines linestyle 103 title "cut"
    unset key
    set yrange [0:GPVAL_Y_MAX]
  }
}
unset multiplot
