data = figure . ".csv"
law(k, L) = 1 - k / 3 * depth / L
set xlabel "{/:Italic L} / {/:Italic D}"
set ylabel "({/:Italic σ_T} / {/:Italic σ_N}) / tan {/:Italic θ}   at {/:Italic θ_c}"
stats data using "L" nooutput
set xrange [0.8 * STATS_min : 1.1 * STATS_max]
set yrange [0:1]
set key inside bottom right
plot law(k_paper, x) with lines linestyle 102 title "paper, {/:Italic k_L} − {/:Italic k}_0 = 2.5", \
     law(k, x) with lines linetype 2 title "fit, {/:Italic k_L} − {/:Italic k}_0 = " . k_text, \
     data using "L":(column("ratio") - column("bar")):(0):(2 * column("bar")) with vectors nohead linetype 1 linewidth 1 notitle, \
     data using "L":"ratio" with points linetype 1 title "beds between walls"
