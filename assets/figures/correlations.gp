data = figure . ".csv"
names = "force gamma stress"
array titles[3] = ["normal forces", "{/:Italic γ} of grains", "mean stress of grains"]
set multiplot
set xlabel "{/:Italic r} / {/:Italic D}"
set ylabel "correlation"
set key inside top right vertical Right noreverse
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead linestyle 103
do for [s = 1:2] {
  state = word("start repose", s)
  set lmargin at screen 0.5 * (s - 1) + 1.6 / width
  set rmargin at screen 0.5 * s - 0.3 / width
  set tmargin at screen 1 - 0.25 / height
  set bmargin at screen 1.2 / height
  set label 1 sprintf("(%s)  {/:Italic θ} = %s°", "ab"[s:s], value("theta_" . state)) at graph 0.04, graph 0.05
  plot [0:*] [*:0.6] for [k = 1:3] data using "r":(column(word(names, k) . "_" . state)):(column(word(names, k) . "_" . state . "_error")) with yerrorlines linetype k notitle, \
    for [k = 1:3] data using "r":(column(word(names, k) . "_" . state)) with linespoints linetype k title titles[k]
}
unset multiplot
