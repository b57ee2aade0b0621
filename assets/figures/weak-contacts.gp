data = figure . ".csv"
states = "start repose"
set xlabel "mobilised friction |{/:Italic f}_t| / (μ {/:Italic f}_n)"
set ylabel "fabric along strong contacts" offset 1
set key inside bottom left vertical Left reverse
set xrange [0:1]
set yrange [-1.2:1.2]
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead linestyle 103
set arrow 2 from coherent, graph 0 to coherent, graph 1 nohead linestyle 103
middle = '(0.5 * (column("mobilised_from") + column("mobilised_to")))'
plot for [s = 1:2] data using @middle:(column("fabric_" . word(states, s))):(column("fabric_" . word(states, s) . "_error")) with yerrorlines linetype s notitle, \
  for [s = 1:2] data using @middle:(column("fabric_" . word(states, s))) with linespoints linetype s title "{/:Italic θ} = " . value("theta_" . word(states, s)) . "°"
