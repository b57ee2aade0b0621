# Panels from top to bottom, with angle and gravity on their left; the gray scale below. All lengths are in cm.
rows = words(tilts)
row_height = (height - legend_height) / rows
panel_height = row_height - text_height
panel_width = width - label_width
if (panel_width > panel_height * aspect) { panel_width = panel_height * aspect } else { panel_height = panel_width / aspect }
place(x, y, w, h) = sprintf("set lmargin at screen %g; set rmargin at screen %g; set bmargin at screen %g; set tmargin at screen %g", \
  x / width, (x + w) / width, y / height, (y + h) / height)
left = 0.5 * (width - label_width - panel_width)
x0 = left + label_width

set multiplot
unset border
unset tics
unset key
if (walls) {
  set arrow 2 from graph 0, graph 0 to graph 0, graph 1 nohead linewidth 2
  set arrow 3 from graph 1, graph 0 to graph 1, graph 1 nohead linewidth 2
}
do for [i = 1:rows] {
  y0 = height - (i - 1) * row_height - panel_height
  theta = word(tilts, i)
  set label 1 sprintf("(%s)", "abcdefgh"[i:i]) at screen (left + 0.15) / width, screen (y0 + panel_height - 0.25) / height left
  set label 2 "{/:Italic θ} = " . theta . "°" at screen (left + 0.15) / width, screen (y0 + panel_height - 0.65) / height left
  # Gravity, 0.8 cm long.
  xg = left + 0.75
  yg = y0 + 0.5 * panel_height - 0.35
  set arrow 1 from screen (xg - 0.4 * sin(theta * rad)) / width, screen (yg + 0.4 * cos(theta * rad)) / height \
    to screen (xg + 0.4 * sin(theta * rad)) / width, screen (yg - 0.4 * cos(theta * rad)) / height \
    head filled size screen 0.012, 18 linewidth 1
  set label 3 "{/:Bold g}" at screen (xg - 0.2) / width, screen yg / height right
  eval place(x0, y0, panel_width, panel_height)
  plot [*:*] [*:*] sprintf("%s-panel%d.png", figure, i) binary filetype=png with rgbimage
}
unset label
unset arrow

# The scale bar, 10 D, shorter in a short bed.
bar_diameters = scale_bar(bed_length)
bar = 1.0 * bar_diameters / bed_length * panel_width
set arrow 1 from screen x0 / width, screen (legend_height - 0.45) / height to screen (x0 + bar) / width, screen (legend_height - 0.45) / height \
  heads size screen 0.005, 90 linewidth 1
set label 1 sprintf("%d {/:Italic D}", bar_diameters) at screen (x0 + bar + 0.15) / width, screen (legend_height - 0.45) / height left

# The gray scale.
scale = 0.5 * panel_width < 6 ? 0.5 * panel_width : 6
eval place(x0 + panel_width - scale - 0.9, legend_height - 0.65, scale, 0.35)
set label 2 "{/:Italic γ} = {/:Italic q}/{/:Italic p}" at graph -0.03, graph 0.5 right
set border 31 linewidth 1
set xtics out nomirror scale 0.5 offset 0, 0.35 \
  (sprintf("%.2f", white_below) white_below, sprintf("Γ_c = %.2f", gamma_c) gamma_c, sprintf("2 Γ_c = %.2f", 2 * gamma_c) 2 * gamma_c)
set palette gray negative
unset colorbox
set cbrange [white_below:2 * gamma_c]
set samples 256, 2
set isosamples 256, 2
set urange [white_below:2 * gamma_c]
set vrange [0:1]
set datafile separator whitespace nocolumnheaders
plot [white_below:2 * gamma_c] [0:1] "++" using 1:2:1 with image
unset multiplot
