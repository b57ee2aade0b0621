set xlabel "sin {/:Italic θ}"
set ylabel "Γ"
end = 1.05 * sin(rad * theta_max)
set xrange [0:end]
set yrange [0:*]
abscissa = 'sin(rad * column("theta"))'
ordinate = "ratio"
plot @curves, x with lines linestyle 102 title "Γ = sin {/:Italic θ}"
