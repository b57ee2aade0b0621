data = figure . ".csv"
eval grid(1, 1, 1, height)
entry = add_entry("", "", "", bed)
do for [a = 1:words(shown)] { entry = add_curve(sprintf("linetype %d", a), value(sprintf("said_%d", a))) }
eval open_page
eval place(1)
x_from = 0
x_to = length
y_from = 0
x_title = "{/:Italic x} / {/:Italic D}"
y_title = "{/:Italic σ_{xx}} / ({/:Italic M g} / 2{/:Italic L})"
eval axes
name(a) = "sigma_xx_" . word(shown, a)
plot for [a = 1:words(shown)] data using "x":(column(name(a))) with linespoints linetype a, \
     for [a = 1:words(shown)] data using "x":(bar_from(name(a))):(0):(bar_length(name(a))) with vectors nohead linetype a dashtype solid linewidth 1
eval seen
eval close_page
