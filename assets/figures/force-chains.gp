# Widths in ten classes of half the mean force: gray up to the mean, black above. The widest is about a third of a grain wide,
# so that chains stay separate. Lengths are in cm.
class(force) = (c = ceil(2 * force), c < 1 ? 1 : c > 10 ? 10 : c)
map_cm = smaller(map_height * width, asked_height > 4 ? asked_height - 2.1 : 1.2 * width)
cm = map_cm / map_height / (bed_length + 2 * margin)  # length of 1 D
widest_line = smaller(0.36 * cm, 0.2) / 0.0176
do for [c = 1:10] {
  eval sprintf('set style arrow %d nohead linecolor rgb "%s" linewidth %g', c, c <= 2 ? "#999999" : "#000000", 0.1 * c * widest_line)
}
said_angle = "{/:Italic θ} = " . theta . "°"
bed_cm = cm * bed_length
left = 0.5 * (width - bed_cm)
gravity_at = bar_end(left, bed_cm) + 0.7
said_end = gravity_at + 0.6 + text_cm(said_angle, 8)
force_from = width - 0.25 - 6 * 1.15
two_lines = said_end + 1.4 > force_from
legend_cm = two_lines ? 2.1 : 1.3
height = map_cm + legend_cm
eval open_page
unset border
unset tics
eval place_at(0, left - margin * cm, left + bed_cm + margin * cm, legend_cm, height)
eval bed_edges
y0 = two_lines ? legend_cm - 0.5 : 0.65
eval gravity(gravity_at, y0, tilt)
set arrow 2 from screen left / width, screen y0 / height to screen (left + bar_cm(bed_cm)) / width, screen y0 / height heads size screen 0.09 / width, 90 linewidth 1
set label 1 sprintf(bar_text, scale_bar(bed_length)) at screen (left + bar_cm(bed_cm) + 0.15) / width, screen y0 / height left
set label 2 said_angle at screen (gravity_at + 0.6) / width, screen y0 / height left
set label 4 "{/:Italic f} / ⟨{/:Italic f} ⟩" at screen (force_from - 0.15) / width, screen 0.65 / height right
do for [k = 1:6] {
  c = word("1 2 4 6 8 10", k) + 0
  x = force_from + 1.15 * (k - 1)
  set arrow 10 + k from screen (x + 0.1) / width, screen 0.8 / height to screen (x + 0.9) / width, screen 0.8 / height arrowstyle c
  set label 10 + k sprintf("%s%g", c == 10 ? "> " : "≤ ", c == 10 ? 4.5 : 0.5 * c) at screen (x + 0.5) / width, screen 0.35 / height center font ",7"
}
plot [-margin:bed_length + margin] [bed_bottom - margin:bed_top] \
  figure . "-surface.csv" using "x":"y" with lines linecolor rgb "#000000" linewidth 0.75, \
  figure . "-contacts.csv" using "x1":"y1":(column("x2") - column("x1")):(column("y2") - column("y1")):(class(column("force"))) with vectors arrowstyle variable
eval close_page
