# Above, where the critical contacts are in one bed, if its run is there; below, how many they are and how they hang together.
below = height - key_height - map_height * width  # cm, for the curves
set multiplot
if (map_height > 0) {
  set lmargin at screen 0
  set rmargin at screen 1
  set tmargin at screen 1 - key_height / height
  set bmargin at screen below / height
  set style arrow 1 nohead linecolor rgb "#bbbbbb" linewidth 0.5
  set style arrow 2 nohead linecolor rgb "#000000" linewidth 2
  unset border
  unset tics
  unset key
  do for [side = 0:1] {
    x = side * bed_length
    if (periodic) { set arrow from x, bed_bottom to x, bed_top nohead linestyle 102 } else { set arrow from x, bed_bottom to x, bed_top nohead linewidth 2 }
  }
  set arrow from 0, bed_bottom to bed_length, bed_bottom nohead linewidth 1
  plot [-margin:bed_length + margin] [bed_bottom - margin:bed_top] \
    figure . "-surface.csv" using "x":"y" with lines linecolor rgb "#000000" linewidth 0.75, \
    for [kind = 0:1] figure . "-contacts.csv" using \
      (column("critical") == kind ? column("x1") : NaN):"y1":(column("x2") - column("x1")):(column("y2") - column("y1")) \
      with vectors arrowstyle (kind + 1)
  unset arrow
  set label 1 "(a)  {/:Italic θ} = " . theta . "°" at screen 0.35 / width, screen (below - 0.25) / height left
}

set border 31 linewidth 1
set tics
set xlabel "{/:Italic θ} (deg)"
set key
array titles[3] = ["critical share of the contacts", "contacts in the largest cluster", "correlation length / {/:Italic D}"]
do for [k = 1:3] {
  set lmargin at screen (k - 1) / 3. + 1.5 / width
  set rmargin at screen k / 3. - 0.35 / width
  set bmargin at screen 1.1 / height
  set tmargin at screen (below - (map_height > 0 ? 0.7 : 0.3)) / height
  set label 2 sprintf("(%s)", letters[k:k]) at graph 0.04, graph 0.93 left
  set ylabel titles[k] offset 0.5, 0
  ordinate = word("share largest correlation_length", k)
  plot [0 : 1.04 * theta_max] [0:*] @curves
  unset key
  unset label 1
}
unset multiplot
