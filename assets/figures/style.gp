# Common part of all figures. FIGURE.gp has the variables of the figure above it and the script below. It is read four times:
# once without drawing, to find the room that its numbers need, then for PDF, SVG and PNG.
if (!exists("pass")) pass = 0
reset
set encoding utf8
set datafile separator comma
set datafile columnheaders
rad = pi / 180
letter(k) = sprintf("(%s)", k <= 26 ? "abcdefghijklmnopqrstuvwxyz"[k:k] : sprintf("%s%s", "abcdefghijklmnopqrstuvwxyz"[(k - 1) / 26:(k - 1) / 26], "abcdefghijklmnopqrstuvwxyz"[(k - 1) % 26 + 1:(k - 1) % 26 + 1]))

# Variables of group g: data_g, its file; label_g, its name in the key; every_g, the number of rows between symbols; and, if it
# has several runs, runs_g, the file of the individual runs, and drawn_g, their number.
data(g) = value(sprintf("data_%d", g))
has_runs(g) = exists(sprintf("runs_%d", g))
runs(g) = has_runs(g) ? value(sprintf("runs_%d", g)) : data(g)
if (!exists("spread")) { spread = 0 }  # 1 if any group has several runs
label(g) = value(sprintf("label_%d", g))
every(g) = value(sprintf("every_%d", g))

# Length of a scale bar, in D like the length of the bed.
scale_bar(bed_length) = bed_length < 12 ? 1 : bed_length < 25 ? 2 : bed_length < 40 ? 5 : bed_length < 300 ? 10 : bed_length < 1000 ? 50 : 100

font = "DejaVu Sans,8"
# Terminals have different units: the scales below give 8 pt letters, and lines of 0.5 pt for a width of 1.
set_terminal = 'if (pass == 0) { set terminal dumb size 200, 100; set output "/dev/null" }; \
  if (pass == 1) { eval sprintf("set terminal pdfcairo enhanced color rounded size %gcm,%gcm font \"%s\" fontscale 0.75", width, height, font) }; \
  if (pass == 2) { eval sprintf("set terminal svg enhanced rounded size %d,%d font \"%s\" fontscale 1.333 linewidth 0.667", width / 2.54 * 96, height / 2.54 * 96, font) }; \
  if (pass == 3) { eval sprintf("set terminal pngcairo enhanced color rounded size %d,%d font \"%s\" fontscale 3.125 linewidth 2.083 pointscale 4.167", width / 2.54 * 300, height / 2.54 * 300, font) }; \
  if (pass > 0) { set output figure . word(".pdf .svg .png", pass) }'

set border linewidth 1
set tics in scale 0.6,0.3
set style fill solid 0.25 noborder
unset key

# Curves of groups, distinguished in gray by dash and symbol.
array ink[8] = ["#000000", "#1f4e79", "#b03a2e", "#3d8b7d", "#7a5c99", "#b8860b", "#707070", "#5d9cc9"]
array dash[8] = ["solid", "(10,4)", "(3,3)", "(12,3,3,3)", "(6,3)", "(12,3,3,3,3,3)", "(2,4)", "(18,4)"]
array mark[8] = [7, 4, 9, 12, 6, 5, 8, 10]
symbol = pass == 2 ? 1.333 : 1  # the unit of symbols in SVG is the pixel
do for [k = 1:8] {
  eval sprintf('set linetype %d linecolor rgb "%s" dashtype %s linewidth 2 pointtype %d pointsize %g', k, ink[k], dash[k], mark[k], 0.45 * symbol)
}
set linetype cycle 8
colour(g) = ink[int((g - 1) % 8) + 1]
# Marks of the paper's values, laws and thresholds, and auxiliary lines.
set style line 101 linecolor rgb "#000000" dashtype solid linewidth 2 pointtype 2 pointsize 0.8 * symbol
set style line 102 linecolor rgb "#555555" dashtype (1,3) linewidth 2
set style line 103 linecolor rgb "#999999" dashtype (6,4) linewidth 1.5
set style line 104 linecolor rgb "#bbbbbb" dashtype solid linewidth 1

# Error bars are vectors, because those of gnuplot blank their surroundings.
bar_from(name) = scale * (column(name) - column(name . "_error"))
bar_length(name) = scale * 2 * column(name . "_error")

# Bands around a mean, for width = "_error" or "_deviation". Thin lines are transparent, because many are behind the mean.
band_low(name, width) = scale * (column(name) - column(name . width))
band_high(name, width) = scale * (column(name) + column(name . width))
opacity(g) = has_runs(g) && value(sprintf("drawn_%d", g)) > 14 ? 5.0 / value(sprintf("drawn_%d", g)) : 0.35
pale(g) = sprintf("#%02x", 255 * (1 - opacity(g))) . colour(g)[2:7]

# The curves of all groups, `scale` times column `ordinate` over the expression `abscissa`: plot @curves, ...
# Behind them are the bands of the standard deviation, the individual runs, and the bands of the standard error (omitted
# if NaN); then lines, and symbols unless `symbols` = 0. `key_of_curves` has all of these for the key.
# Symbols are sparse, and curves with many oscillations have none, so that peaks between symbols are visible in the line.
ordinate = "none"
scale = 1
symbols = 1
abscissa = 'column("theta")'
marked(g) = symbols || every(g) == 1
curves = 'for [g = 1:groups] data(g) using (@abscissa):(band_low(ordinate, "_deviation")):(band_high(ordinate, "_deviation")) ' . \
  'with filledcurves linetype g fillstyle transparent solid 0.13 noborder notitle, ' . \
  'for [g = 1:groups] for [side = -1:1:2] data(g) using (@abscissa):(scale * (column(ordinate) + side * column(ordinate . "_deviation"))) ' . \
  'with lines linetype g dashtype solid linewidth 0.5 notitle, ' . \
  'for [g = 1:groups] runs(g) using (@abscissa):(has_runs(g) ? scale * column(ordinate) : NaN) with lines linecolor rgb pale(g) dashtype solid linewidth 0.5 notitle, ' . \
  'for [g = 1:groups] data(g) using (@abscissa):(band_low(ordinate, "_error")):(band_high(ordinate, "_error")) ' . \
  'with filledcurves linetype g fillstyle transparent solid 0.4 noborder notitle, ' . \
  'for [g = 1:groups] data(g) using (@abscissa):(scale * column(ordinate)) with lines linetype g notitle, ' . \
  'for [g = 1:groups] data(g) using (@abscissa):(marked(g) ? scale * column(ordinate) : NaN) every every(g) with points linetype g notitle'
key_of_curves = 'do for [g = 1:groups] { entry = marked(g) ? add_curve(sprintf("linetype %d", g), label(g)) : add_line(sprintf("linetype %d", g), label(g)) }; \
  if (spread) { entry = add_line("linecolor rgb \"#999999\" dashtype solid linewidth 0.5", "runs"); \
    entry = add_box("fillcolor rgb \"#000000\" fillstyle transparent solid 0.4 noborder", "± standard error"); \
    entry = add_box("fillcolor rgb \"#000000\" fillstyle transparent solid 0.13 noborder", "± standard deviation") }'

# Edges of a bed whose contacts are drawn, in the units of the bed: dotted if it is periodic.
bed_edges = 'do for [side = 0:1] { x = side * bed_length; \
  eval sprintf("set arrow from %g, bed_bottom to %g, bed_top nohead %s", x, x, periodic ? "linestyle 102" : "linewidth 2") }; \
  set arrow from 0, bed_bottom to bed_length, bed_bottom nohead linewidth 1'
