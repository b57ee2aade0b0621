# A panel for each periodic bed.
set xlabel "{/:Italic γ}"
set ylabel "{/:Italic P}({/:Italic γ})"
set xrange [0:1]
set yrange [0:*]
panel_top = 0.5
set multiplot
do for [g = 1:groups] {
  eval panel(g, groups, 1, 1)
  do for [f = 1:2] {
    unset arrow f
    unset label f
    threshold = f * value(sprintf("gamma_c_%d", g))
    if (threshold > 1) { continue }
    set arrow f from threshold, graph 0 to threshold, graph 1 nohead linestyle 102
    name = f == 1 ? "Γ_c" : "2 Γ_c"
    if (threshold < 0.85) { set label f name at threshold, graph 0.93 left offset character 0.4, 0 }
    else { set label f name at threshold, graph 0.93 right offset character -0.4, 0 }
  }
  set label 3 label(g) at graph 0, graph 1 offset 0, character 0.6 font fitted(label(g), 7, width - panel_left - 0.1)
  bands = value(sprintf("several_%d", g)) ? words(angles) : 0
  plot for [a = 1:bands] data(g) using "gamma":(band_low("density_" . word(angles, a), "_error")):(band_high("density_" . word(angles, a), "_error")) with filledcurves linetype a fillstyle transparent solid 0.3 noborder notitle, \
       for [a = 1:words(angles)] data(g) using "gamma":(column("density_" . word(angles, a))) with linespoints linetype a pointinterval 3 title "{/:Italic θ} = " . word(angles, a) . "°"
  unset key
}
unset multiplot
