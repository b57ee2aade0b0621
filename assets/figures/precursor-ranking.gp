# A row for each measure, the best first: its contrast, and the error of the distance that it tells.
scale = 1
file = figure . ".csv"
set multiplot
do for [panel = 1:2] {
  left = panel == 1 ? 0.36 : 0.70
  set lmargin at screen left
  set rmargin at screen left + 0.28
  set tmargin at screen 1 - 0.95 / height
  set bmargin at screen 0.95 / height
  set yrange [rows + 0.5:0.5]
  unset ytics
  unset label
  unset arrow
  unset object
  if (tilt_row <= rows) { set object 1 rectangle from graph 0, first tilt_row - 0.5 to graph 1, first tilt_row + 0.5 behind fillcolor rgb "#e4e4e4" fillstyle solid noborder }
  do for [r = 1:rows] {
    if (panel == 1) { set label value(sprintf("row_%d", r)) at graph -0.03, first r right font ",6.5" }
    if (r < rows) { set arrow from graph 0, first r + 0.5 to graph 1, first r + 0.5 nohead linecolor rgb "#dddddd" linewidth 0.7 back }
  }
  set label sprintf("(%s)", "ab"[panel:panel]) at graph -0.03, graph 1 right offset 0, 0.7
  set key at screen left + 0.14, screen 1 - 0.08 / height center top vertical maxrows 1 Left reverse samplen 1 width panel == 1 ? -5 : -1 font ",6.5"
  here(name) = column("rank") <= rows ? column(name) : NaN
  if (panel == 1) {
    set arrow from first 0, graph 0 to first 0, graph 1 nohead linecolor rgb "#555555" linewidth 1 back
    set xrange [*:*]
    set xlabel "change / deviation of the beds" offset 0, 0.4
    plot file using (here("contrast_3")):(column("rank")) with points pointtype 6 pointsize 0.45 * symbol linecolor rgb "#999999" title "3", \
      file using (here("contrast_2")):(column("rank")) with points pointtype 7 pointsize 0.45 * symbol linecolor rgb colour(2) title "2", \
      file using (here("contrast_1")):(column("rank")) with points pointtype 7 pointsize 0.55 * symbol linecolor rgb "#000000" title "1 deg before θ_c"
  } else {
    set xrange [0:1.08 * nothing]
    set arrow from first tilt, graph 0 to first tilt, graph 1 nohead linestyle 103 back
    set arrow from first nothing, graph 0 to first nothing, graph 1 nohead linestyle 102 back
    set xlabel "error of {/:Italic θ_c} − {/:Italic θ} (deg)" offset 0, 0.4
    plot file using (bar_from("error")):(here("rank") - 0.14):(bar_length("error")):(0) with vectors nohead linecolor rgb "#000000" dashtype solid linewidth 1 notitle, \
      file using (bar_from("with_tilt")):(here("rank") + 0.14):(bar_length("with_tilt")):(0) with vectors nohead linecolor rgb colour(3) dashtype solid linewidth 1 notitle, \
      file using (here("error")):(column("rank") - 0.14) with points pointtype 7 pointsize 0.45 * symbol linecolor rgb "#000000" title "alone", \
      file using (here("with_tilt")):(column("rank") + 0.14) with points pointtype 6 pointsize 0.45 * symbol linecolor rgb colour(3) title "with the tilt"
  }
}
unset multiplot
