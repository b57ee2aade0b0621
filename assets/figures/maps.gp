
# Pictures of a bed in a grid: groups of `in_group` of them, `map_groups` in number, each group below a strip of text, each picture
# with room for `map_need` of text. As many groups beside each other as make the pictures largest on a page no higher than
# `highest`. Lengths in cm.
map_gap = 0.25
map_cm(beside) = smaller((width - map_gap) / (beside * in_group) - map_gap, aspect * ((highest - below) / ceil(1.0 * map_groups / beside) - strip))
lay_out_maps = 'highest = asked_height > 0 ? asked_height : width > 12 ? 1.25 * width : 2.4 * width; beside = 1; \
  do for [n = 2:map_groups] { if (n * in_group * map_need <= width && map_cm(n) > 1.02 * map_cm(beside)) { beside = n } }; \
  map_width = map_cm(beside); map_height = map_width / aspect; map_rows = int((map_groups + beside - 1) / beside); \
  map_pitch = larger(map_width + map_gap, smaller(map_need, (width - map_gap) / (beside * in_group))); \
  height = below + map_rows * (strip + map_height); \
  maps_from = 0.5 * (width - beside * in_group * map_pitch + map_gap)'
map_left(i, f) = maps_from + ((i - 1) % beside * in_group + f - 1) * map_pitch
map_base(i) = height - ((i - 1) / beside + 1) * (strip + map_height)
place_map(i, f) = place_at(0, map_left(i, f), map_left(i, f) + map_width, map_base(i), map_base(i) + map_height)
# In the strip above picture (i, 1): letter, angle, and the direction of gravity.
said_of_map(i, theta) = sprintf("set label 1 '%s {/:Italic θ} = %s°' at screen %g, screen %g left font ',%g'; ", letter(i), theta, map_left(i, 1) / width, (map_base(i) + map_height + strip - 0.27) / height, map_points) . \
  gravity(map_left(i, 1) + text_cm(sprintf("%s θ = %s°", letter(i), theta), map_points) + 0.45, map_base(i) + map_height + strip - 0.27, theta * rad)
# An arrow 0.45 cm long with its middle there, and its name.
gravity(x, y, tilt) = sprintf("set arrow 1 from screen %g, screen %g to screen %g, screen %g head filled size screen %g, 18 linewidth 1; ", \
  (x - 0.22 * sin(tilt)) / width, (y + 0.22 * cos(tilt)) / height, (x + 0.22 * sin(tilt)) / width, (y - 0.22 * cos(tilt)) / height, 0.16 / width) . \
  sprintf("set label 3 '{/:Bold g}' at screen %g, screen %g left font ',%g'", (x + 0.2) / width, y / height, map_points)
map_points = 7

# A scale bar from (x, y), in a picture where the bed is so many cm long, and where its text ends.
bar_cm(bed_cm) = 1.0 * scale_bar(bed_length) / bed_length * bed_cm
bar_text = '%d {/:Italic D}'
bar_end(x, bed_cm) = x + bar_cm(bed_cm) + 0.15 + text_cm(sprintf(bar_text, scale_bar(bed_length)), 8)
draw_bar(x, y, bed_cm) = sprintf("set arrow 1 from screen %g, screen %g to screen %g, screen %g heads size screen %g, 90 linewidth 1; ", \
  x / width, y / height, (x + bar_cm(bed_cm)) / width, y / height, 0.09 / width) . \
  sprintf("set label 1 '" . bar_text . "' at screen %g, screen %g left", scale_bar(bed_length), (x + bar_cm(bed_cm) + 0.15) / width, y / height)

# The gray scale of gamma: white below white_below, black from 2 Gamma_c on; from (x, y) on.
gray_ticks(cm) = sprintf("'%.2f' %g, ", white_below, white_below) . \
  ((gamma_c - white_below) / (2 * gamma_c - white_below) * cm > text_cm("0.00Γ_c = 0.00", 7) / 2 + 0.3 && \
  gamma_c / (2 * gamma_c - white_below) * cm > text_cm("2 Γ_c = 0.00Γ_c = 0.00", 7) / 2 + 0.3 ? sprintf("'Γ_c = %.2f' %g, ", gamma_c, gamma_c) : "") . \
  sprintf("'2 Γ_c = %.2f' %g", 2 * gamma_c, 2 * gamma_c)
draw_gray_scale = 'set border 31 linewidth 1; eval "set xtics (" . gray_ticks(panel_width) . ") out nomirror scale 0.5 offset 0, 0.35 font \",7\""; unset ytics; \
  set palette gray negative; unset colorbox; set cbrange [white_below:2 * gamma_c]; set samples 256, 2; set isosamples 256, 2; \
  set urange [white_below:2 * gamma_c]; set vrange [0:1]; set datafile separator whitespace nocolumnheaders; \
  plot [white_below:2 * gamma_c] [0:1] "++" using 1:2:1 with image; set datafile separator comma columnheaders'
