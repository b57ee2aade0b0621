# Above, the critical contacts of one bed, if its run is available; below, their number and their clusters.
map_cm = smaller(map_height * width, width)  # a deep bed is drawn narrower
grid_above = map_height > 0 ? map_cm + 0.6 : 0
symbols = 0
eval grid(3, 3, 1, width > 12 ? 5 : 4)
eval key_of_curves
if (map_height > 0) {
  entry = add_line("linecolor rgb \"#000000\" linewidth 2", "critical contacts")
  entry = add_line("linecolor rgb \"#bbbbbb\" linewidth 1", "other contacts")
}
eval open_page
if (map_height > 0) {
  map_width = map_cm / map_height
  eval place_at(0, 0.5 * (width - map_width), 0.5 * (width + map_width), height - key_height - map_cm, height - key_height)
  set style arrow 1 nohead linecolor rgb "#bbbbbb" linewidth 0.5
  set style arrow 2 nohead linecolor rgb "#000000" linewidth 2
  unset border
  unset tics
  eval bed_edges
  set label 1 "(a)  {/:Italic θ} = " . theta . "°" at screen 0.35 / width, screen (panel_from - 0.3) / height left
  plot [-margin:bed_length + margin] [bed_bottom - margin:bed_top] \
    figure . "-surface.csv" using "x":"y" with lines linecolor rgb "#000000" linewidth 0.75, \
    for [kind = 0:1] figure . "-contacts.csv" using \
      (column("critical") == kind ? column("x1") : NaN):"y1":(column("x2") - column("x1")):(column("y2") - column("y1")) \
      with vectors arrowstyle (kind + 1)
  unset arrow
  unset label 1
  set border 31 linewidth 1
  set tics
}
array titles[3] = ["critical share of the contacts", "contacts in the largest cluster", "correlation length / {/:Italic D}"]
do for [k = 1:3] {
  eval place(k)
  x_from = 0
  x_to = 1.04 * theta_max
  y_from = 0
  x_title = "{/:Italic θ} (°)"
  y_title = titles[k]
  eval axes
  set label 2 sprintf("(%s)", letters[k:k]) at graph 0.04, graph 0.93 left
  ordinate = word("share largest correlation_length", k)
  plot @curves
  eval seen
}
eval close_page
