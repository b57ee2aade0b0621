# A panel for each threshold.
set xlabel "{/:Italic θ} (deg)"
set ylabel "{/:Italic p_o}"
set xrange [0 : 1.04 * (theta_max > 21 ? theta_max : 21)]
set yrange [0:1]
set multiplot
do for [t = 1:thresholds] {
  eval panel(1, 1, t, thresholds)
  ordinate = "p_o_" . value(sprintf("factor_%d", t))
  set label 1 sprintf("(%s) ", "abcd"[t:t]) . value(sprintf("threshold_%d", t)) at graph 0.03, graph 0.93
  plot @curves, figure . "-paper.csv" using "theta":"p_o" with points linestyle 101 title "paper"
  unset key
}
unset multiplot
