# Left, the grain and its neighbourhoods, circles every 2 D; right, gamma_l over l. l_c of each threshold by its dash.
half = 0.5 * shown + 1.2
side = height - 1.3  # cm
factor(f) = word(factors, f) eq "1" ? "" : word(factors, f) . " "
array circle_dash[4] = ["solid", "(5,3)", "(2,2)", "(6,2,2,2)"]
do for [f = 1:4] { eval sprintf('set style line %d linecolor rgb "#000000" linewidth 2 dashtype %s', f, circle_dash[f]) }
ring(tag, radius, ink, paper, dash) = \
  sprintf('set object %d circle at 0, 0 size %g front fillstyle empty border rgb "#ffffff" linewidth %g; ', tag, radius, paper) . \
  sprintf('set object %d circle at 0, 0 size %g front fillstyle empty border rgb "#000000" linewidth %g dashtype %s', tag + 1, radius, ink, dash)

set multiplot
unset border
unset tics
unset key
set lmargin at screen 0.1 / width
set rmargin at screen (0.1 + side) / width
set bmargin at screen 1.2 / height
set tmargin at screen (1.2 + side) / height
set size ratio -1
do for [k = 1:int(shown / 2)] { eval ring(10 * k, k, 1, 2.5, "solid") }
do for [f = 1:words(factors)] { eval ring(1000 + 10 * f, 0.5 * word(lengths, f), 3, 6, circle_dash[f]) }
eval ring(2000, grain_radius, 3, 6, "solid")
set palette defined (0 "#ffffff", 1 "#606060")
set cbrange [0:1]
set colorbox user horizontal origin screen 0.2 * side / width, screen 0.85 / height size screen 0.6 * side / width, screen 0.2 / height
set cbtics 0.5 scale 0.5 offset 0, 0.4
set label 1 "{/:Italic γ}" at screen (0.2 * side - 0.2) / width, screen 0.95 / height right
set style fill solid 1 border rgb "#606060"
plot [-half:half] [-half:half] figure . "-grains.csv" using "x":"y":"radius":"gamma" with circles fillcolor palette linewidth 0.5

unset object
unset label
unset colorbox
set size noratio
set lmargin at screen (side + 1.9) / width
set rmargin at screen 1 - 1.1 / width
set bmargin at screen 1.2 / height
set tmargin at screen 1 - 0.2 / height
set border 31 linewidth 1
set xtics autofreq
set mxtics 2
set ytics autofreq
set mytics 2
set xlabel "{/:Italic ℓ} / {/:Italic D}"
set ylabel "{/:Italic γ_ℓ}"
set key inside top right vertical Right noreverse samplen 3
do for [f = 1:words(factors)] {
  limit = word(thresholds, f) + 0.0
  l_c = word(lengths, f) + 0.0
  eval sprintf('set arrow %d from graph 0, first limit to graph 1, first limit nohead linestyle 103', f)
  eval sprintf('set arrow %d from first l_c, graph 0 to first l_c, first limit nohead linestyle %d', 10 + f, f)
  eval sprintf('set label %d factor(f) . "Γ_c" at graph 1.02, first limit left', f)
}
plot [0:shown] [0:1.05] figure . ".csv" using "l":"gamma_l" with steps linecolor rgb "#000000" linewidth 2 notitle, \
  for [f = 1:words(factors)] NaN with lines linestyle f title sprintf("{/:Italic ℓ}_c = %.2f {/:Italic D} at %sΓ_c", word(lengths, f) + 0.0, factor(f))
unset multiplot
