# Two charts of rows: the difference from the paper in units of the tolerance. Symbols of a row stand below each other;
# full ones agree. Beyond +-limit an arrow stands at the edge, its number beside it.
limit = 6.0
array full[4] = [7, 5, 9, 13]
array open[4] = [6, 4, 8, 12]
names = "packing chain"
entry(name, what, k) = value(sprintf("%s_%s_%d", name, what, k))

set multiplot
do for [panel = 1:2] {
  name = word(names, panel)
  rows = value(name . "_rows")
  if (rows == 0) { continue }  # nothing of it can be compared yet
  series = value(name . "_series")
  file = figure . "-" . name . ".csv"
  left = panel == 1 ? 0.265 : 0.735
  set lmargin at screen left
  set rmargin at screen left + 0.195
  set tmargin at screen 1 - (1.95 / height)
  set bmargin at screen 1.0 / height
  set xrange [-limit - 0.5:limit + 0.5]
  set yrange [rows + 0.5:0.5]
  set xtics -limit, 2, limit
  unset mxtics
  unset ytics
  unset arrow
  unset label
  do for [r = 1:rows] {
    set label entry(name, "row", r) at graph -0.03, first r right
    set label entry(name, "paper", r) at graph 1.03, first r left textcolor rgb "#555555"
    if (r < rows) { set arrow from graph 0, first r + 0.5 to graph 1, first r + 0.5 nohead linecolor rgb "#dddddd" linewidth 0.7 back }
  }
  set object 1 rectangle from first -1, graph 0 to first 1, graph 1 behind fillcolor rgb "#e4e4e4" fillstyle solid noborder
  set arrow from first 0, graph 0 to first 0, graph 1 nohead linecolor rgb "#555555" linewidth 1 back
  set label sprintf("(%s)", "ab"[panel:panel]) at graph -0.03, graph 1 right offset 0, 0.7
  set label "paper" at graph 1.03, graph 1 left offset 0, 0.7 textcolor rgb "#555555"
  set xlabel "(ours − paper) / tolerance" offset 0, 0.4
  set key at screen left + 0.1, screen 1 - 0.15 / height center top vertical maxrows 3 Left reverse samplen 1 noautotitle
  dodge(s) = (s - 0.5 * (series + 1)) * 0.27
  here(s, a) = column("series") == s && column("agrees") == a && abs(column("score")) <= limit ? column("score") : NaN
  beyond(s, side) = column("series") == s && side * column("score") > limit ? side * (limit + 0.25) : NaN
  absent(s) = column("series") == s && stringcolumn("ours") eq "NaN" ? limit + 0.25 : NaN
  plot for [s = 1:series] file using (here(s, 1)):(column("row") + dodge(s)) with points pointtype full[s] pointsize 0.5 * symbol linecolor rgb colour(s), \
    for [s = 1:series] file using (here(s, 0)):(column("row") + dodge(s)) with points pointtype open[s] pointsize 0.5 * symbol linecolor rgb colour(s), \
    for [s = 1:series] for [side = -1:1:2] file using (beyond(s, side) - side * 0.5):(column("row") + dodge(s)):(side * 0.6):(0) \
      with vectors head filled size screen 0.006, 25 linecolor rgb colour(s) dashtype solid linewidth 1.2, \
    for [s = 1:series] file using (absent(s)):(column("row") + dodge(s)) with points pointtype 2 pointsize 0.45 * symbol linecolor rgb colour(s), \
    for [s = 1:series] NaN with points pointtype full[s] pointsize 0.5 * symbol linecolor rgb colour(s) title entry(name, "label", s)
}
unset multiplot
