# Mean above, largest value below; a panel for each threshold, with one range per row.
# The cut of a bed has the colour of the bed, or is gray if all beds share it.
cut(g) = value(sprintf("cut_%d", g))
one_cut = 1
do for [g = 2:groups] { if (cut(g) != cut(1)) { one_cut = 0 } }
cut_colour(g) = one_cut ? "#999999" : colour(g)
eval grid(2 * thresholds, thresholds, 1, width > 12 ? 5.4 : 4.4)
eval key_of_curves
entry = add_line("linestyle 103", one_cut ? "cut" : "cut of each bed, in its colour")
entry = add_point("linestyle 101", "paper")
eval open_page
do for [row = 1:2] {
  length = word("mean max", row)
  highest = 0.0
  do for [t = 1:thresholds] { if (pass > 0) { highest = larger(highest, y_most[(row - 1) * thresholds + t]) } }
  do for [t = 1:thresholds] {
    k = (row - 1) * thresholds + t
    eval place(k)
    x_from = 0
    x_to = 1.04 * (theta_max > 21 ? theta_max : 21)
    y_from = 0
    if (row == 2) { y_to = 1.2 * top }
    if (row == 1 && pass > 0) { y_to = high_end(0, highest) }
    x_title = "{/:Italic θ} (°)"
    y_title = "{/:Italic ℓ_c}^{" . length . "} / {/:Italic D}"
    eval axes
    ordinate = length . "_" . value(sprintf("factor_%d", t))
    set label 1 letter(k) . " " . value(sprintf("threshold_%d", t)) at graph 0.03, graph 0.93
    plot @curves, figure . "-paper.csv" using "theta":(column(length)) with points linestyle 101, \
      for [g = 1:(one_cut ? 1 : groups)] row == 2 ? cut(g) : NaN with lines linestyle 103 linecolor rgb cut_colour(g)
    eval seen
  }
}
eval close_page
