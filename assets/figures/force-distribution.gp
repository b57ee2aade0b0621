data = figure . ".csv"
states = "start repose"
positive(name) = column(name) > 0 ? column(name) : NaN
set xlabel "{/:Italic f} / ⟨{/:Italic f} ⟩"
set ylabel "{/:Italic P}({/:Italic f} / ⟨{/:Italic f} ⟩)"
set logscale y
set format y "10^{%T}"
set key inside bottom left vertical Left reverse
set xrange [0:10]
set multiplot
do for [panel = 1:2] {
  set lmargin at screen 0.5 * (panel - 1) + 1.6 / width
  set rmargin at screen 0.5 * panel - 0.3 / width
  set tmargin at screen 1 - 0.25 / height
  set bmargin at screen 1.2 / height
  set label 1 sprintf("(%s)", "ab"[panel:panel]) at graph 0.92, graph 0.93
  plot [] [1e-4:10] \
    for [s = 1:2] data using (sqrt(column("force_from") * column("force_to"))):(positive("density_" . word(states, s))):(column("density_" . word(states, s) . "_error")) with yerrorlines linetype s notitle, \
    for [s = 1:2] data using (sqrt(column("force_from") * column("force_to"))):(positive("density_" . word(states, s))) with linespoints linetype s title "{/:Italic θ} = " . value("theta_" . word(states, s)) . "°"
  set logscale x
  set format x "10^{%T}"
  set xrange [1e-3:20]
}
unset multiplot
