# The grain and its neighbourhoods, with circles every 2 D; on the right (in one column: below), gamma_l over l. Dashes show l_c of each threshold.
half = 0.5 * shown + 1.2
factor(f) = word(factors, f) eq "1" ? "" : word(factors, f) . " "
array circle_dash[4] = ["solid", "(5,3)", "(2,2)", "(6,2,2,2)"]
do for [f = 1:4] { eval sprintf('set style line %d linecolor rgb "#000000" linewidth 2 dashtype %s', f, circle_dash[f]) }
ring(tag, radius, ink, paper, dash) = \
  sprintf('set object %d circle at 0, 0 size %g front fillstyle empty border rgb "#ffffff" linewidth %g; ', tag, radius, paper) . \
  sprintf('set object %d circle at 0, 0 size %g front fillstyle empty border rgb "#000000" linewidth %g dashtype %s', tag + 1, radius, ink, dash)
side = width > 12 ? 0.42 * width : width - 1.2  # cm
height = width > 12 ? side + 1.2 : side + 6.7
do for [f = 1:words(factors)] { entry = add_line(sprintf("linestyle %d", f), sprintf("{/:Italic ℓ}_c = %.2f {/:Italic D} at %sΓ_c", word(lengths, f) + 0.0, factor(f))) }
entry = add_line("linestyle 103", "thresholds")
eval open_page
unset border
unset tics
eval place_at(0, width > 12 ? 0.1 : 0.6, (width > 12 ? 0.1 : 0.6) + side, height - key_height - side, height - key_height)
set size ratio -1
do for [k = 1:int(shown / 2)] { eval ring(10 * k, k, 1, 2.5, "solid") }
do for [f = 1:words(factors)] { eval ring(1000 + 10 * f, 0.5 * word(lengths, f), 3, 6, circle_dash[int((f - 1) % 4) + 1]) }
eval ring(2000, grain_radius, 3, 6, "solid")
set palette gray negative
set cbrange [white_below:2 * gamma_c]
unset colorbox
set style fill solid 1 border rgb "#606060"
set label 1 letter(1) at screen (panel_at + 0.1) / width, screen (panel_from + panel_height - 0.25) / height left
plot [-half:half] [-half:half] figure . "-grains.csv" using "x":"y":"radius":"gamma" with circles fillcolor palette linewidth 0.5
unset object
unset label 1
scale_cm = 0.55 * side
eval place_at(0, panel_at + 0.25 * side, panel_at + 0.25 * side + scale_cm, height - key_height - side - 0.45, height - key_height - side - 0.2)
set size noratio
set label 2 "{/:Italic γ}" at screen (panel_at - 0.15) / width, graph 0.5 right
eval draw_gray_scale
unset label
set border 31 linewidth 1
set tics in scale 0.6,0.3 offset 0, 0
eval sprintf("set tics font ',%g'", tick_points)
eval width > 12 ? place_at(1, side + 0.1 + title_room + tick_room + 0.4, width - 1.1, 1.0, height - key_height - 0.15) : place_at(1, title_room + tick_room + number_gap, width - 1.1, 1.0, 5.0)
x_from = 0
x_to = shown
y_from = 0
y_to = 1.05
x_title = "{/:Italic ℓ} / {/:Italic D}"
y_title = "{/:Italic γ_ℓ}"
eval axes
set label 100 letter(2) at graph 0.04, graph 0.93 left
last_limit = -1.0
do for [f = 1:words(factors)] {
  limit = word(thresholds, f) + 0.0
  l_c = word(lengths, f) + 0.0
  eval sprintf('set arrow %d from graph 0, first limit to graph 1, first limit nohead linestyle 103', f)
  eval sprintf('set arrow %d from first l_c, graph 0 to first l_c, first limit nohead linestyle %d', 10 + f, int((f - 1) % 4) + 1)
  if (limit <= y_to && abs(limit - last_limit) * panel_height / y_to > 0.32) { eval sprintf('set label %d factor(f) . "Γ_c" at graph 1.02, first limit left font ",7"', f); last_limit = limit }
}
plot figure . ".csv" using "l":"gamma_l" with steps linecolor rgb "#000000" linewidth 2
eval seen
eval close_page
