# Widths in ten classes of half the mean force: gray up to the mean, black above it. Lengths of the legend are in cm.
class(force) = (c = ceil(2 * force), c < 1 ? 1 : c > 10 ? 10 : c)
scale = 0.45 * 200 / (bed_length < 40 ? 40 : bed_length) * width / 17.8  # of short beds as far as the legend has room
do for [c = 1:10] {
  eval sprintf('set style arrow %d nohead linecolor rgb "%s" linewidth %g', c, c <= 2 ? "#999999" : "#000000", scale * c)
}
set lmargin at screen 0
set rmargin at screen 1
set tmargin at screen 1
set bmargin at screen 1 - map_height * width / height
unset border
unset tics
unset key
cm = width / (bed_length + 2 * margin)  # of 1 D

# Edges of the bed.
do for [side = 0:1] {
  x = side * bed_length
  if (periodic) { set arrow from x, bed_bottom to x, bed_top nohead linestyle 102 } else { set arrow from x, bed_bottom to x, bed_top nohead linewidth 2 }
}
set arrow from 0, bed_bottom to bed_length, bed_bottom nohead linewidth 1

# Scale bar, shorter in a short bed, gravity (0.8 cm long), widths.
bar_diameters = scale_bar(bed_length)
bar = bar_diameters * cm
x0 = margin * cm
y0 = 0.65
set arrow from screen x0 / width, screen y0 / height to screen (x0 + bar) / width, screen y0 / height heads size screen 0.005, 90 linewidth 1
set label sprintf("%d {/:Italic D}", bar_diameters) at screen (x0 + bar + 0.15) / width, screen y0 / height left
xg = x0 + bar + 2.2
set label "{/:Bold g}" at screen (xg - 0.35) / width, screen y0 / height right
set arrow from screen (xg - 0.4 * sin(tilt)) / width, screen (y0 + 0.4 * cos(tilt)) / height \
  to screen (xg + 0.4 * sin(tilt)) / width, screen (y0 - 0.4 * cos(tilt)) / height head filled size screen 0.012, 18 linewidth 1
set label "{/:Italic θ} = " . theta . "°" at screen (xg + 0.6) / width, screen y0 / height left
set label "{/:Italic f} / ⟨{/:Italic f} ⟩" at screen (width - x0 - 7.2) / width, screen y0 / height right
do for [k = 1:6] {
  c = word("1 2 4 6 8 10", k) + 0
  x = width - x0 - 7.0 + 1.2 * (k - 1)
  set arrow from screen x / width, screen (y0 + 0.15) / height to screen (x + 0.8) / width, screen (y0 + 0.15) / height arrowstyle c
  set label sprintf("%s%g", c == 10 ? ">" : "≤ ", c == 10 ? 4.5 : 0.5 * c) at screen (x + 0.4) / width, screen (y0 - 0.25) / height center
}

plot [-margin:bed_length + margin] [bed_bottom - margin:bed_top] \
  figure . "-surface.csv" using "x":"y" with lines linecolor rgb "#000000" linewidth 0.75, \
  figure . "-contacts.csv" using "x1":"y1":(column("x2") - column("x1")):(column("y2") - column("y1")):(class(column("force"))) with vectors arrowstyle variable
