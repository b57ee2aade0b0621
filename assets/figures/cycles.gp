# Above, the tilt over time and loops over the tilt, with a colour for each cycle; below, the residual change after each cycle.
loops = figure . ".csv"
ends = figure . "-ends.csv"
panel_top = 0.62
panel_bottom = 0.95
title_room = 0
grid_above = 0.7  # cm, for the colour scale
eval grid(9, 3, 2, width > 12 ? 4.6 : 3.7)
entry = add_entry("linecolor rgb ink[2] dashtype solid linewidth 1", "pointtype 7 pointsize 0.4 * symbol linecolor rgb ink[2]", "", "end of the cycle (g, h, i)")
entry = add_entry("linecolor rgb ink[3] dashtype (6,3) linewidth 1", "pointtype 6 pointsize 0.5 * symbol linecolor rgb ink[3]", "", "highest tilt (g, h, i)")
eval open_page
set palette defined (0 "#a8cbe6", 0.5 "#3b7ab0", 1 "#0b2545")
set cbrange [1 : (cycles > 1 ? cycles : 2)]
unset colorbox
set style fill solid 1 noborder  # for the colour scale
names = "theta volume_strain coordination critical " . (has_overload ? "overloaded" : "stress_ratio") . " anisotropy volume_strain coordination critical"
array titles[9]
titles[1] = "{/:Italic θ} (°)"
titles[2] = "Volume strain (%)"
titles[3] = "Coordination number {/:Italic z}"
titles[4] = "Critical contacts {/:Italic ν}"
titles[5] = has_overload ? "Overloaded fraction {/:Italic p_o}" : "Stress ratio {/:Italic Γ}"
titles[6] = "Anisotropy of the contacts"
titles[7] = titles[2]
titles[8] = titles[3]
titles[9] = titles[4]
do for [k = 1:6] {
  eval place(k)
  name = word(names, k)
  factor = name eq "volume_strain" ? 100 : 1
  heading = letter(k) . " " . titles[k]
  x_title = k == 1 ? "time since the tilt began (s)" : "{/:Italic θ} (°)"
  eval axes
  if (k == 1 && cycles > 1) {
    bar = smaller(6, 0.5 * width)
    eval sprintf("set colorbox horizontal user origin screen %g, screen %g size screen %g, screen %g", 0.5 * (width - bar) / width, (height - key_height - 0.3) / height, bar / width, 0.2 / height)
    set cbtics 1, (cycles > 12 ? nice(cycles / 8.0) : 1) font ",7" offset 0, 0.5 scale 0
    set label 2 "cycle" at screen (0.5 * (width - bar) - 0.25) / width, screen (height - key_height - 0.2) / height right font ",7"
  } else {
    unset colorbox
    unset label 2
  }
  plot loops using (column(k == 1 ? "time" : "theta")):(factor * column(name)):"cycle" \
    with lines linecolor palette dashtype solid linewidth 1.2
  eval seen
}
unset colorbox
do for [k = 7:9] {
  eval place(k)
  name = word(names, k)
  factor = name eq "volume_strain" ? 100 : 1
  heading = letter(k) . " " . titles[k]
  x_from = -0.5
  x_to = closed + 0.5
  x_title = "cycle"
  eval axes
  scale = factor
  plot ends using "cycle":(bar_from(name . "_end")):(0):(bar_length(name . "_end")) \
      with vectors nohead linecolor rgb ink[2] dashtype solid linewidth 1, \
    ends using (column("cycle") + 0.15):(bar_from(name . "_top")):(0):(bar_length(name . "_top")) \
      with vectors nohead linecolor rgb ink[3] dashtype solid linewidth 1, \
    ends using "cycle":(factor * column(name . "_end")) with linespoints linecolor rgb ink[2] dashtype solid linewidth 1 \
      pointtype 7 pointsize 0.4 * symbol, \
    ends using (column("cycle") + 0.15):(factor * column(name . "_top")) with linespoints linecolor rgb ink[3] dashtype (6,3) linewidth 1 \
      pointtype 6 pointsize 0.5 * symbol
  eval seen
}
eval close_page
