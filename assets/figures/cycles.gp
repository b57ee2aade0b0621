# Above, the tilt over time and loops over the tilt, each cycle in its own colour; below, what is left of each cycle.
loops = figure . ".csv"
ends = figure . "-ends.csv"
bar_height = 0.75  # cm, of the scale of colours and the key above the panels
set palette defined (0 "#a8cbe6", 0.5 "#3b7ab0", 1 "#0b2545")
set cbrange [1 : (cycles > 1 ? cycles : 2)]
unset key
unset colorbox
set style fill solid 1 noborder  # of the scale of colours
panel_left = 1.45
panel_top = 0.55
panel_bottom = 0.95
set tics font ",7"
key_height = bar_height
names = "theta volume_strain coordination critical " . (has_overload ? "overloaded" : "stress_ratio") . " anisotropy"
array title[9]
title[1] = "(a) {/:Italic θ} in °"
title[2] = "(b) Volume strain, %"
title[3] = "(c) Coordination number {/:Italic z}"
title[4] = "(d) Critical contacts {/:Italic ν}"
title[5] = has_overload ? "(e) Overloaded fraction {/:Italic p_o}" : "(e) Stress ratio {/:Italic Γ}"
title[6] = "(f) Anisotropy of the contacts"
title[7] = "(g) Volume strain, %"
title[8] = "(h) Coordination number {/:Italic z}"
title[9] = "(i) Critical contacts {/:Italic ν}"

set multiplot
do for [k = 1:6] {
  eval panel((k - 1) / 3 + 1, 3, (k - 1) % 3 + 1, 3)
  name = word(names, k)
  factor = name eq "volume_strain" ? 100 : 1
  set label 1 title[k] at graph 0, graph 1.09 left font ",7"
  set xlabel (k == 1 ? "time since the tilt began (s)" : "{/:Italic θ} in °") offset 0, 0.6 font ",7"
  set xrange [*:*] noextend
  if (k == 1 && cycles > 1) {
    set colorbox horizontal user origin screen 0.35, screen 1 - 0.42 / height size screen 0.3, screen 0.2 / height
    set cbtics 1, (cycles > 12 ? ceil(cycles / 10.0) : 1) font ",7" offset 0, 0.5 scale 0
    set label 2 "cycle" at screen 0.34, screen 1 - 0.3 / height right font ",7"
  } else {
    unset colorbox
    unset label 2
  }
  plot loops using (column(k == 1 ? "time" : "theta")):(factor * column(name)):"cycle" \
    with lines linecolor palette dashtype solid linewidth 1.2
}
unset colorbox
set xrange [-0.5 : closed + 0.5]
set xtics 0, (closed > 12 ? ceil(closed / 10.0) : 1)
do for [k = 7:9] {
  eval panel(3, 3, k - 6, 3)
  name = word(names, k - 5)
  factor = name eq "volume_strain" ? 100 : 1
  set label 1 title[k] at graph 0, graph 1.09 left font ",7"
  set xlabel "cycle" offset 0, 0.6 font ",7"
  if (k == 7) {
    set key at screen 1 - 0.3 / width, screen 1 - 0.05 / height top right vertical maxrows 2 width 0 font ",7"
  } else {
    unset key
  }
  scale = factor
  plot ends using "cycle":(bar_from(name . "_end")):(0):(bar_length(name . "_end")) \
      with vectors nohead linecolor rgb ink[2] dashtype solid linewidth 1 notitle, \
    ends using (column("cycle") + 0.15):(bar_from(name . "_top")):(0):(bar_length(name . "_top")) \
      with vectors nohead linecolor rgb ink[3] dashtype solid linewidth 1 notitle, \
    ends using "cycle":(factor * column(name . "_end")) with linespoints linecolor rgb ink[2] dashtype solid linewidth 1 \
      pointtype 7 pointsize 0.4 * symbol title "end of the cycle", \
    ends using (column("cycle") + 0.15):(factor * column(name . "_top")) with linespoints linecolor rgb ink[3] dashtype (6,3) linewidth 1 \
      pointtype 6 pointsize 0.5 * symbol title "highest tilt"
}
unset multiplot
