data = figure . ".csv"
law(k, L) = 1 - k / 3 * depth / L
eval grid(1, 1, 1, height)
entry = add_point("linetype 1", "beds between walls")
entry = add_line("linetype 2", "fit, {/:Italic k_L} − {/:Italic k}_0 = " . k_text)
entry = add_line("linestyle 102", "paper, {/:Italic k_L} − {/:Italic k}_0 = 2.5")
eval open_page
eval place(1)
stats data using "L" nooutput
x_from = 0.8 * STATS_min
x_to = 1.1 * STATS_max
y_from = 0
x_title = "{/:Italic L} / {/:Italic D}"
y_title = "({/:Italic σ_T} / {/:Italic σ_N}) / tan {/:Italic θ}   at {/:Italic θ_c}"
eval axes
above(y) = y > 0 ? y : NaN
plot above(law(k_paper, x)) with lines linestyle 102, \
     above(law(k, x)) with lines linetype 2, \
     data using "L":(column("ratio") - column("bar")):(0):(2 * column("bar")) with vectors nohead linetype 1 linewidth 1, \
     data using "L":"ratio" with points linetype 1
eval seen
eval close_page
