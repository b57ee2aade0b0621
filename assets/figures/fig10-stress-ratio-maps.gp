# A picture for each tilt, with angle and gravity above it; the scale bar and the gray scale below.
map_groups = words(tilts)
in_group = 1
strip = 0.6
map_need = text_cm("(a) θ = 00.0°", 7) + 1.2
scale_cm = smaller(6, 0.45 * width)
below = 1.2
eval lay_out_maps
scale_from = width - 0.9 - scale_cm
two_lines = bar_end(maps_from, map_width) + 1.3 > scale_from
if (two_lines) { below = 1.8; eval lay_out_maps }
eval open_page
unset border
unset tics
if (walls) {
  set arrow 2 from graph 0, graph 0 to graph 0, graph 1 nohead linewidth 2
  set arrow 3 from graph 1, graph 0 to graph 1, graph 1 nohead linewidth 2
}
do for [i = 1:map_groups] {
  eval place_map(i, 1)
  eval said_of_map(i, word(tilts, i))
  if (pass > 0) { plot [*:*] [*:*] sprintf("%s-panel%d.png", figure, i) binary filetype=png with rgbimage }
}
unset label
unset arrow
eval draw_bar(maps_from, two_lines ? 1.5 : 0.75, map_width)
eval place_at(0, scale_from, scale_from + scale_cm, 0.55, 0.9)
set label 2 "{/:Italic γ} = {/:Italic q}/{/:Italic p}" at screen (scale_from - 0.12) / width, graph 0.5 right
eval draw_gray_scale
eval close_page
