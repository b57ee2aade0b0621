
# The key is above all panels, in as many columns as its longest text allows; longer texts take several lines, and the page
# grows accordingly. An entry has the line and the point of its sample ("" for none), or the fill of a box, and its text.
most_entries = 1000
array key_line[most_entries]
array key_point[most_entries]
array key_box[most_entries]
array key_text[most_entries]
entries = 0
key_points = 7
add_entry(line, point, box, text) = (entries = entries + 1, key_line[entries] = line, key_point[entries] = point, key_box[entries] = box, key_text[entries] = text, entries)
add_line(style, text) = add_entry(style, "", "", text)
add_point(style, text) = add_entry("", style, "", text)
add_curve(style, text) = add_entry(style, style, "", text)
add_box(style, text) = add_entry("", "", style, text)
key_height = 0
key_sample = 1.0   # cm
key_gap = 0.5
key_row = 0.34
key_left = 0.3
key_entry_cm(k) = key_sample + 0.15 + text_cm(key_text[k], key_points) + key_gap
array key_x[most_entries]
array key_y[most_entries]
array key_lines[8 * most_entries]
array key_first[most_entries + 1]
# Position of each entry (cm, from the upper left): one row, or columns of equal width.
lay_out_key = 'key_room = width - 2 * key_left; together = 0.0; widest = 0.0; \
  do for [k = 1:entries] { together = together + key_entry_cm(k); widest = larger(widest, key_entry_cm(k)) }; \
  key_columns = int((key_room + key_gap) / widest); key_columns = key_columns < 1 ? 1 : key_columns > entries ? entries : key_columns; \
  key_in_column = ceil(1.0 * entries / key_columns); \
  key_columns = ceil(1.0 * entries / key_in_column); \
  break_cm = key_columns > 1 ? width : key_room - key_sample - 0.15; break_points = key_points; \
  along = key_left; down = 0; deepest = 0; all_lines = 0; \
  do for [k = 1:entries] { \
    if (together - key_gap <= key_room) { key_x[k] = along; key_y[k] = 0; along = along + key_entry_cm(k); down = 0 } else { \
      if ((k - 1) % key_in_column == 0) { down = 0 }; \
      key_x[k] = key_left + int((k - 1) / key_in_column) * widest; key_y[k] = down }; \
    text_to_break = key_text[k]; eval break_text; key_first[k] = all_lines + 1; \
    do for [l = 1:text_lines] { if (all_lines < 8 * most_entries) { all_lines = all_lines + 1; key_lines[all_lines] = broken[l] } }; \
    down = down + text_lines; deepest = larger(deepest, down) }; \
  key_first[entries + 1] = all_lines + 1; key_height = 0.15 + key_row * deepest; height = height + key_height'
draw_key = 'unset border; unset tics; unset key; set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen 0; set tmargin at screen 1; \
  do for [k = 1:entries] { \
    x = key_x[k]; y = height - 0.1 - key_row * (key_y[k] + 0.5); \
    if (strlen(key_line[k]) > 0) { eval sprintf("set arrow from first %g, first %g to first %g, first %g nohead %s", x, y, x + key_sample, y, key_line[k]) }; \
    if (strlen(key_point[k]) > 0) { eval sprintf("set label \"\" at first %g, first %g point %s", x + 0.5 * key_sample, y, key_point[k]) }; \
    if (strlen(key_box[k]) > 0) { eval sprintf("set object rectangle from first %g, first %g to first %g, first %g %s", x, y - 0.1, x + key_sample, y + 0.1, key_box[k]) }; \
    do for [l = key_first[k]:key_first[k + 1] - 1] { set label key_lines[l] at first (x + key_sample + 0.15), first (y - key_row * (l - key_first[k])) left font sprintf(",%g", key_points) } }; \
  plot [0:width] [0:height] NaN notitle; \
  unset arrow; unset label; unset object; set autoscale; set border 31 linewidth 1; set tics in scale 0.6,0.3'

# Opens the page after its grid and its key are known.
open_page = 'if (entries > 0) { eval lay_out_key }; \
  if (asked_height > 0 && stretches) { height = larger(asked_height, key_height + grid_above + grid_below + least_row_cm * panel_rows) }; eval set_terminal; set multiplot; if (entries > 0) { eval draw_key }; unset key; eval sprintf("set tics font \",%g\"", tick_points)'
close_page = 'unset multiplot'

# The same if each panel g has the name of group g above it, on as many lines as it needs: place_headed instead of place.
set_heads = 'heads = 1; break_points = heading_points; break_cm = width - title_room - tick_room - larger(panel_right, 0.05 + x_overhang) - 0.15; \
  array head[groups]; \
  do for [g = 1:groups] { text_to_break = label(g); eval break_text; heads = larger(heads, text_lines); head[g] = broken[1]; \
    do for [l = 2:text_lines] { head[g] = head[g] . "\n" . broken[l] } }'
open_headed = 'eval set_heads; height = height + groups * 0.3 * (heads - 1); eval open_page; panel_top = 0.3 + 0.3 * heads'
place_headed(g) = place(g) . sprintf('; set label 94 head[%d] at screen panel_at / width, screen (panel_from + panel_height + panel_top - 0.2) / height left font ",%g"', g, heading_points)
