# The angle of the row over that of the column, and above each panel the coefficient of each group. The panels form a triangle in
# two columns and a sequence in one column, which is too narrow for a triangle.
size = angles - 1
panel_top = 0.15 + 0.3 * lines
triangle = width > 12
if (triangle) { height = 1.1 + size * (2.1 + panel_top) } else { eval grid(angles * size / 2, 3, 3, 2.8 + panel_top) }
do for [g = 1:groups] { entry = add_point(sprintf("linetype %d linewidth 1", g), label(g)) }
eval open_page
cell_left = title_room + tick_room + number_gap
cell_gap = larger(0.3, 2 * x_overhang + 0.1)
cell_width = (width - cell_left - larger(panel_right, 0.05 + x_overhang) + cell_gap) / size
cell_height = (height - key_height - 1.1) / size
k = 0
do for [second = 2:angles] {
  do for [first = 1:second - 1] {
    k = k + 1
    cell_top = height - key_height - (second - 2) * cell_height
    if (triangle) { eval place_at(k, cell_left + (first - 1) * cell_width, cell_left + first * cell_width - cell_gap, cell_top - cell_height, cell_top - panel_top) } \
    else { eval place(k) }
    horizontal = value(sprintf("angle_%d", first))
    vertical = value(sprintf("angle_%d", second))
    x_from = value(sprintf("low_%d", first))
    x_to = value(sprintf("high_%d", first))
    y_from = value(sprintf("low_%d", second))
    y_to = value(sprintf("high_%d", second))
    x_bare = triangle && second < angles
    y_bare = triangle && first > 1
    if (!x_bare) { x_title = value(sprintf("title_%d", first)) . " (°)" }
    if (!y_bare) { y_title = value(sprintf("title_%d", second)) . " (°)" }
    eval axes
    do for [g = 1:groups] {
      coefficient = value(sprintf("r_%d_%d_%d", first, second, g))
      set label g coefficient at screen panel_at / width, screen (panel_from + panel_height + 0.2 + 0.3 * (lines - value(sprintf("line_%d", g)))) / height left font fitted(coefficient, 6.5, panel_width) textcolor rgb colour(g)
    }
    plot for [g = 1:groups] data(g) using (column(horizontal)):(column(vertical)) with points linetype g linewidth 1 pointsize 0.3 * symbol
    eval seen
  }
}
eval close_page
