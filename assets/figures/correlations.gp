data = figure . ".csv"
names = "force gamma stress"
array titles[3] = ["normal forces", "{/:Italic γ} of grains", "mean stress of grains"]
eval grid(words(states), 2, 1, width > 12 ? 6.5 : 5)
do for [k = 1:3] { entry = add_curve(sprintf("linetype %d", k), titles[k]) }
least_row_cm = 4
eval open_page
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead linestyle 104
do for [s = 1:words(states)] {
  state = word(states, s)
  eval place(s)
  x_from = 0
  y_top = 0.6
  x_title = "{/:Italic r} / {/:Italic D}"
  y_title = "correlation"
  eval axes
  set label 1 letter(s) . "  {/:Italic θ} = " . word(tilts, s) . "°" at graph 0.96, graph 0.92 right
  plot for [k = 1:3] data using "r":(column(word(names, k) . "_" . state)):(column(word(names, k) . "_" . state . "_error")) with yerrorlines linetype k, \
    for [k = 1:3] data using "r":(column(word(names, k) . "_" . state)) with linespoints linetype k
  eval seen
}
eval close_page
