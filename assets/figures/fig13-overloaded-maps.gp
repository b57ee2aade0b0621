# A column of panels for each threshold, with angle and gravity on their left. All lengths are in cm.
rows = words(tilts)
columns = words(factors)
row_height = (height - legend_height) / rows
panel_height = row_height - text_height
column_width = (width - label_width + column_gap) / columns
panel_width = column_width - column_gap
if (panel_width > panel_height * aspect) { panel_width = panel_height * aspect; column_width = panel_width + column_gap } else { panel_height = panel_width / aspect }
place(x, y, w, h) = sprintf("set lmargin at screen %g; set rmargin at screen %g; set bmargin at screen %g; set tmargin at screen %g", \
  x / width, (x + w) / width, y / height, (y + h) / height)
factor(f) = word(factors, f) eq "1" ? "" : word(factors, f) . " "
top = height - 0.5 * legend_height
left = 0.5 * (width - label_width - columns * column_width + column_gap)

set multiplot
unset border
unset tics
unset key
if (walls) {
  set arrow 2 from graph 0, graph 0 to graph 0, graph 1 nohead linewidth 2
  set arrow 3 from graph 1, graph 0 to graph 1, graph 1 nohead linewidth 2
}
do for [i = 1:rows] {
  y0 = top - (i - 1) * row_height - text_height - panel_height
  theta = word(tilts, i)
  set label 1 sprintf("(%s)", "abcdefgh"[i:i]) at screen (left + 0.15) / width, screen (y0 + panel_height - 0.2) / height left
  set label 2 "{/:Italic θ} = " . theta . "°" at screen (left + 0.15) / width, screen (y0 + panel_height - 0.6) / height left
  # Gravity, 0.6 cm long.
  xg = left + 0.75
  yg = y0 + 0.5 * panel_height - 0.45
  set arrow 1 from screen (xg - 0.3 * sin(theta * rad)) / width, screen (yg + 0.3 * cos(theta * rad)) / height \
    to screen (xg + 0.3 * sin(theta * rad)) / width, screen (yg - 0.3 * cos(theta * rad)) / height \
    head filled size screen 0.009, 18 linewidth 1
  set label 3 "{/:Bold g}" at screen (xg - 0.2) / width, screen yg / height right
  do for [f = 1:columns] {
    x0 = left + label_width + (f - 1) * column_width
    p_o = sprintf("{/:Italic p}_o = %.3f", value(sprintf("p_o_%d_%d", f, i)))
    set label 4 p_o at screen (x0 + panel_width) / width, screen (y0 + panel_height + 0.2) / height right
    if (i == 1) {
      set label 5 sprintf("{/:Italic γ} ≥ %sΓ_c = %s", factor(f), word(thresholds, f)) at screen (x0 + 0.5 * panel_width) / width, screen (top + 0.25) / height center
    }
    eval place(x0, y0, panel_width, panel_height)
    plot [*:*] [*:*] sprintf("%s-panel%d-%d.png", figure, f, i) binary filetype=png with rgbimage
  }
  unset label 5
}
unset label
unset arrow

# The scale bar, 10 D, shorter in a short bed.
x0 = left + label_width
bar_diameters = scale_bar(bed_length)
bar = 1.0 * bar_diameters / bed_length * panel_width
set arrow 1 from screen x0 / width, screen 0.3 / height to screen (x0 + bar) / width, screen 0.3 / height \
  heads size screen 0.005, 90 linewidth 1
set label 1 sprintf("%d {/:Italic D}", bar_diameters) at screen (x0 + bar + 0.15) / width, screen 0.3 / height left
eval place(x0, 0, panel_width, 0.3)
plot [0:1] [0:1] NaN notitle
unset multiplot
