# Mean above, largest below; a column of panels for each threshold, with the range of the first: its lengths are largest.
# A bed's cut has its colour, or is gray where all have one.
cut(g) = value(sprintf("cut_%d", g))
one_cut = 1
do for [g = 2:groups] { if (cut(g) != cut(1)) { one_cut = 0 } }
cut_colour(g) = one_cut ? "#999999" : colour(g)
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
      set yrange [0 : 1.2 * top]
      set ytics 10
    }
    plot @curves, figure . "-paper.csv" using "theta":(column(length)) with points linestyle 101 title "paper", \
      for [g = 1:(one_cut ? 1 : groups)] row == 2 ? cut(g) : NaN with lines linestyle 103 linecolor rgb cut_colour(g) title (g == 1 ? "cut" : "")
    unset key
    set yrange [0:GPVAL_Y_MAX]
  }
}
unset multiplot
