
# An arrow 0.45 cm long, given by its middle, and its name.
gravity(x, y, tilt) = sprintf("set arrow 1 from screen %g, screen %g to screen %g, screen %g head filled size screen %g, 18 linewidth 1; ", \
  (x - 0.22 * sin(tilt)) / width, (y + 0.22 * cos(tilt)) / height, (x + 0.22 * sin(tilt)) / width, (y - 0.22 * cos(tilt)) / height, 0.16 / width) . \
  sprintf("set label 3 '{/:Bold g}' at screen %g, screen %g left font ',%g'", (x + 0.2) / width, y / height, map_points)
map_points = 7

# A scale bar from (x, y), in a picture with the given length of the bed in cm, and the end of its text.
bar_cm(bed_cm) = 1.0 * scale_bar(bed_length) / bed_length * bed_cm
bar_text = '%d {/:Italic D}'
bar_end(x, bed_cm) = x + bar_cm(bed_cm) + 0.15 + text_cm(sprintf(bar_text, scale_bar(bed_length)), 8)
draw_bar(x, y, bed_cm) = sprintf("set arrow 1 from screen %g, screen %g to screen %g, screen %g heads size screen %g, 90 linewidth 1; ", \
  x / width, y / height, (x + bar_cm(bed_cm)) / width, y / height, 0.09 / width) . \
  sprintf("set label 1 '" . bar_text . "' at screen %g, screen %g left", scale_bar(bed_length), (x + bar_cm(bed_cm) + 0.15) / width, y / height)

# The gray scale of gamma from (x, y): white below white_below, black from 2 Gamma_c.
gray_ticks(cm) = sprintf("'%.2f' %g, ", white_below, white_below) . \
  ((gamma_c - white_below) / (2 * gamma_c - white_below) * cm > text_cm("0.00Γ_c = 0.00", 7) / 2 + 0.3 && \
  gamma_c / (2 * gamma_c - white_below) * cm > text_cm("2 Γ_c = 0.00Γ_c = 0.00", 7) / 2 + 0.3 ? sprintf("'Γ_c = %.2f' %g, ", gamma_c, gamma_c) : "") . \
  sprintf("'2 Γ_c = %.2f' %g", 2 * gamma_c, 2 * gamma_c)
draw_gray_scale = 'set border 31 linewidth 1; eval "set xtics (" . gray_ticks(panel_width) . ") out nomirror scale 0.5 offset 0, 0.35 font \",7\""; unset ytics; \
  set palette gray negative; unset colorbox; set cbrange [white_below:2 * gamma_c]; set samples 256, 2; set isosamples 256, 2; \
  set urange [white_below:2 * gamma_c]; set vrange [0:1]; set datafile separator whitespace nocolumnheaders; \
  plot [white_below:2 * gamma_c] [0:1] "++" using 1:2:1 with image; set datafile separator comma columnheaders'
