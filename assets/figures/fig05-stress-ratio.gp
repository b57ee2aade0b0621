eval grid(1, 1, 1, height)
eval key_of_curves
entry = add_line("linestyle 102", "Γ = sin {/:Italic θ}")
eval open_page
eval place(1)
x_from = 0
x_to = 1.05 * sin(rad * theta_max)
y_from = 0
x_title = "sin {/:Italic θ}"
y_title = "Γ"
eval axes
abscissa = 'sin(rad * column("theta"))'
ordinate = "ratio"
plot @curves, x with lines linestyle 102
eval seen
eval close_page
