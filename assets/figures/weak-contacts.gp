data = figure . ".csv"
eval grid(1, 1, 1, height)
do for [s = 1:words(states)] { entry = add_curve(sprintf("linetype %d", s), "{/:Italic θ} = " . word(tilts, s) . "°") }
entry = add_line("linestyle 103", "coherent: from here on")
eval open_page
eval place(1)
x_from = 0
x_to = 1
y_from = -1.2
y_to = 1.2
x_title = "mobilised friction |{/:Italic f}_t| / (μ {/:Italic f}_n)"
y_title = "fabric along strong contacts"
eval axes
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead linestyle 104
set arrow 2 from coherent, graph 0 to coherent, graph 1 nohead linestyle 103
middle = '(0.5 * (column("mobilised_from") + column("mobilised_to")))'
plot for [s = 1:words(states)] data using @middle:(column("fabric_" . word(states, s))):(column("fabric_" . word(states, s) . "_error")) with yerrorlines linetype s, \
  for [s = 1:words(states)] data using @middle:(column("fabric_" . word(states, s))) with linespoints linetype s
eval seen
eval close_page
