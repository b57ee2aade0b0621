data = figure . ".csv"
set xlabel "{/:Italic x} / {/:Italic D}"
set ylabel "{/:Italic σ_{xx}} / ({/:Italic M g} / 2{/:Italic L})"
set xrange [0:length]
set yrange [0:*]
set key title bed
name(a) = sprintf("sigma_xx_%d", a)
plot for [a = 1:angles] data using "x":(column(name(a))) with linespoints linetype a title value(sprintf("angle_%d", a)), \
     for [a = 1:angles] data using "x":(bar_from(name(a))):(0):(bar_length(name(a))) with vectors nohead linetype a dashtype solid linewidth 1 notitle
