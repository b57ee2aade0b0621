# For each tilt, with angle and gravity above, a picture for each threshold, with its share of overloaded grains.
map_groups = words(tilts)
in_group = words(factors)
factor(f) = word(factors, f) eq "1" ? "" : word(factors, f) . " "
strip = 1.35
threshold_text(f) = sprintf("{/:Italic γ} ≥ %sΓ_c = %s", factor(f), word(thresholds, f))
map_need = text_cm("(a) θ = 00.0°", 7) + 1.2
do for [f = 1:in_group] { map_need = larger(map_need, text_cm(threshold_text(f), 7) + 0.3) }
below = 0.8
eval lay_out_maps
eval open_page
unset border
unset tics
if (walls) {
  set arrow 2 from graph 0, graph 0 to graph 0, graph 1 nohead linewidth 2
  set arrow 3 from graph 1, graph 0 to graph 1, graph 1 nohead linewidth 2
}
do for [i = 1:map_groups] {
  eval said_of_map(i, word(tilts, i))
  do for [f = 1:in_group] {
    eval place_map(i, f)
    set label 4 threshold_text(f) at screen panel_at / width, screen (panel_from + panel_height + 0.57) / height left font fitted(threshold_text(f), 7, map_pitch - 0.2)
    set label 5 sprintf("{/:Italic p}_o = %.3f", value(sprintf("p_o_%d_%d", f, i))) at screen panel_at / width, screen (panel_from + panel_height + 0.22) / height left font ",7"
    if (pass > 0) { plot [*:*] [*:*] sprintf("%s-panel%d-%d.png", figure, f, i) binary filetype=png with rgbimage }
    unset label 1
    unset label 3
    unset arrow 1
  }
}
unset label
unset arrow
eval draw_bar(maps_from, 0.4, map_width)
eval place_at(0, 0, width, 0, 0.3)
plot [0:1] [0:1] NaN
eval close_page
