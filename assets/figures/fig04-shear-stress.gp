set xlabel "tan {/:Italic θ}"
set ylabel "{/:Italic σ_T} / {/:Italic σ_N}"
end = 1.05 * tan(rad * theta_max)
set xrange [0:end]
set yrange [0:*]
abscissa = 'tan(rad * column("theta"))'
ordinate = "ratio"
plot @curves, x with lines linestyle 102 title "{/:Italic σ_T} / {/:Italic σ_N} = tan {/:Italic θ}"
