data = figure . ".csv"
states = "start repose"
left(panel) = sprintf("set lmargin at screen %g; set rmargin at screen %g", (panel - 1) / 3.0 + 1.35 / width, panel / 3.0 - 0.2 / width)
set tmargin at screen 1 - 0.55 / height
set bmargin at screen 1.2 / height
set multiplot

eval left(1)
set label 1 "(a)" at graph 0, graph 1.06 left
set xlabel "birth, {/:Italic f} / ⟨{/:Italic f} ⟩"
set ylabel "death" offset 1.2
set key inside top left vertical Left reverse samplen 1
plot [0:*] [0:*] x with lines linestyle 103 notitle, \
  for [s = 1:2] figure . "-" . word(states, s) . ".csv" using "birth":"death" with points pointtype s == 1 ? 6 : 7 pointsize 0.25 * symbol linecolor rgb s == 1 ? "#808080" : "#000000" title "{/:Italic θ} = " . value("theta_" . word(states, s)) . "°"

set xlabel "{/:Italic θ} (deg)"
set arrow 1 from first theta_c, graph 0 to first theta_c, graph 1 nohead linestyle 103
set xrange [0 : 1.1 * theta_c]
eval left(2)
set label 1 "(b)"
set ylabel "total persistence per grain" offset 1.2
set key inside bottom left
plot [] [0:*] \
  data using "theta":"components" with linespoints linestyle 1 pointsize 0.3 * symbol title "components", \
  data using "theta":"loops" with linespoints linestyle 2 pointsize 0.3 * symbol title "loops"

eval left(3)
set label 1 "(c)"
set ylabel "10^3 change from frame to frame" offset 0.6
set key inside top left
thousand(name) = 1e3 * column(name)
plot [] [0:*] \
  data using "theta":(thousand("components_change")) with linespoints linestyle 1 pointsize 0.3 * symbol title "components", \
  data using "theta":(thousand("loops_change")) with linespoints linestyle 2 pointsize 0.3 * symbol title "loops"
unset multiplot
