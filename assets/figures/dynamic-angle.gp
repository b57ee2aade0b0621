# Above, the angle at rest over each of the angles it is compared with; below, one run over time, if there is a flow.
upper = flow ? 1 : 0.55 / 0.3
set multiplot
titles = "'{/:Italic θ_c}  (deg)' '{/:Italic θ_d} ({/:Italic l_c} max)  (deg)' '{/:Italic θ_d} (percolation)  (deg)' '{/:Italic θ_d} (dilation)  (deg)'"
last = word(factors, words(factors))
first_of = sprintf("theta_c lc_jump_%s percolation_%s dilation_volume", word(factors, 1), word(factors, 1))
second_of = sprintf("theta_c lc_jump_%s percolation_%s dilation_centre", last, last)
array filled[8] = [7, 5, 9, 13, 11, 15, 7, 5]
array open[8] = [6, 4, 8, 12, 10, 14, 6, 4]

set xrange [0:theta_end]
set yrange [lowest:highest]
set xtics 5
set mxtics 5
set ytics 2
set mytics 2
set tmargin at screen 1 - 0.1 * upper
set bmargin at screen 1 - 0.44 * upper
do for [panel = 1:4] {
  set lmargin at screen 0.065 + (panel - 1) * 0.235
  set rmargin at screen 0.065 + (panel - 1) * 0.235 + 0.215
  set xlabel word(titles, panel) offset 0, 0.4
  if (panel == 1) {
    set ylabel "{/:Italic θ_r}  (deg)" offset 1.2, 0
    set key at screen 0.5, screen 0.99 center top horizontal Left reverse maxrows 2
  } else {
    unset ylabel
    unset key
    set format y ""
  }
  set label 1 sprintf("(%s)", "abcd"[panel:panel]) at graph 0.05, graph 0.93 left
  one = word(first_of, panel)
  two = word(second_of, panel)
  low(name) = panel == 1 ? column(name) : column(name . "_low")
  high(name) = panel == 1 ? column(name) : column(name . "_high")
  plot sample [lowest:highest] x with lines linestyle 103 notitle, \
    for [g = 1:groups] data(g) using (column(one)):"theta_r":(low(one)):(high(one)) \
      with xerrorbars linetype g dashtype solid linewidth 1 pointtype filled[int((g - 1) % 8) + 1] pointsize 0.4 title label(g), \
    for [g = 1:groups] data(g) using (column(two)):"theta_r":(low(two)):(high(two)) \
      with xerrorbars linetype g dashtype solid linewidth 1 pointtype open[int((g - 1) % 8) + 1] pointsize 0.55 notitle
}

if (flow) {
  unset key
  set format y "%g"
  set lmargin at screen 0.065
  set rmargin at screen 0.93
  set tmargin at screen 0.44
  set bmargin at screen 0.1
  set xrange [*:*] noextend
  set xtics autofreq
  set yrange [*:*]
  set ytics nomirror autofreq textcolor rgb "#000000"
  set y2range [0:*]
  set y2tics textcolor rgb "#1f4e79"
  set xlabel "time since failure (s)"
  set ylabel "{/:Italic θ}  (deg)"
  set y2label "surface velocity / ({/:Italic gD})^{1/2}" offset -1, 0 textcolor rgb "#1f4e79"
  set label 1 "(e)" at graph 0.985, graph 0.93 right
  plot figure . "-trace.csv" using "time":"velocity" axes x1y2 with lines linecolor rgb "#1f4e79" dashtype solid linewidth 1 notitle, \
    figure . "-trace.csv" using "time":"theta" axes x1y1 with lines linecolor rgb "#000000" dashtype solid linewidth 2 notitle
}
unset multiplot
