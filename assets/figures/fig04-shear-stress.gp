eval grid(1, 1, 1, height)
eval key_of_curves
entry = add_line("linestyle 102", "{/:Italic σ_T} / {/:Italic σ_N} = tan {/:Italic θ}")
eval open_page
eval place(1)
x_from = 0
x_to = 1.05 * tan(rad * theta_max)
y_from = 0
x_title = "tan {/:Italic θ}"
y_title = "{/:Italic σ_T} / {/:Italic σ_N}"
eval axes
abscissa = 'tan(rad * column("theta"))'
ordinate = "ratio"
plot @curves, x with lines linestyle 102
eval seen
eval close_page
