# A panel for each periodic bed.
names = "0 15 failure"
array titles[3] = ["{/:Italic θ} = 0°", "{/:Italic θ} = 15°", "before failure"]
set xlabel "{/:Italic ℓ} / {/:Italic D}"
set ylabel "{/:Italic p_o}"
set xrange [0:*]
set yrange [0:1]
set arrow 1 from graph 0, first 0.6 to graph 1, first 0.6 nohead linestyle 103
panel_top = 0.5
set multiplot
do for [g = 1:groups] {
  eval panel(g, groups, 1, 1)
  set label 1 label(g) at graph 0, graph 1 offset 0, character 0.6 font fitted(label(g), 7, width - panel_left - 0.1)
  plot for [a = 1:3] data(g) using "l":(bar_from("p_o_" . word(names, a))):(0):(bar_length("p_o_" . word(names, a))) with vectors nohead linetype a dashtype solid linewidth 1 notitle, \
    for [a = 1:3] data(g) using "l":(column("p_o_" . word(names, a))) with linespoints linetype a title titles[a]
  unset key
}
unset multiplot
