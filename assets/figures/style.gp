# What all figures share: terminals, fonts, lines. FIGURE.gp has the figure's own variables above this, and its script
# below. It is read three times: for PDF, SVG and PNG.
if (!exists("pass")) pass = 1
reset
set encoding utf8
set datafile separator comma
set datafile columnheaders
rad = pi / 180

# Of group g: variable data_g, its file; label_g, its name for the key; every_g, the rows from one symbol to the next; and
# runs_g, the file of its runs one by one, drawn_g in number, where there are several.
data(g) = value(sprintf("data_%d", g))
has_runs(g) = exists(sprintf("runs_%d", g))
runs(g) = has_runs(g) ? value(sprintf("runs_%d", g)) : data(g)
if (!exists("spread")) { spread = 0 }  # 1 where any group has several runs
label(g) = value(sprintf("label_%d", g))
every(g) = value(sprintf("every_%d", g))

# Where key_entries is given, the key stands above all panels, in as many columns as its longest text allows; the figure
# is higher by as much (cm).
key_height = 0
if (exists("key_entries")) {
  key_columns = int((width - 1.2) / (1.2 + 0.13 * key_longest))
  if (key_columns < 1) { key_columns = 1 }
  key_rows = (key_entries + key_columns - 1) / key_columns
  key_height = 0.2 + 0.33 * key_rows
  height = height + key_height
}

# The length of a scale bar, in D like that of the bed.
scale_bar(bed_length) = bed_length < 12 ? 1 : bed_length < 25 ? 2 : bed_length < 40 ? 5 : 10

# The font of a text that is to be no longer than so many cm.
fitted(text, size, longest) = sprintf(",%g", 0.0186 * size * strlen(text) > longest ? longest / (0.0186 * strlen(text)) : size)

font = "DejaVu Sans,8"
# Each terminal has its own unit: all scales below give 8 pt letters and lines of 0.5 pt for a width of 1.
if (pass == 1) eval sprintf('set terminal pdfcairo enhanced color size %gcm,%gcm font "%s" fontscale 0.75', width, height, font)
if (pass == 2) eval sprintf('set terminal svg enhanced size %d,%d font "%s" fontscale 1.333 linewidth 0.667', width / 2.54 * 96, height / 2.54 * 96, font)
if (pass == 3) eval sprintf('set terminal pngcairo enhanced color size %d,%d font "%s" fontscale 3.125 linewidth 2.083 pointscale 4.167', width / 2.54 * 300, height / 2.54 * 300, font)
set output figure . word(".pdf .svg .png", pass)

set border linewidth 1
set tics in scale 0.6,0.3
set style fill solid 0.25 noborder
set key above left Left reverse samplen 3 spacing 1.1 font ",7"
# A text that is longer than the figure is wide has smaller letters.
if (exists("key_entries") && 0.13 * key_longest > width - 2.4) {
  eval sprintf('set key font ",%g"', 7 * (width - 2.4) / (0.13 * key_longest) < 4 ? 4 : 7 * (width - 2.4) / (0.13 * key_longest))
}
if (exists("key_entries")) {
  eval sprintf('set key at screen %g, screen %g left top vertical maxrows %d', 1.2 / width, 1 - 0.1 / height, key_rows)
  set tmargin at screen 1 - key_height / height
}

# The margins of panel (row, column) of so many, below the key, with room (cm) to its left and below for its axes.
panel_left = 1.4
panel_top = 0.1
panel_bottom = 1.15
panel(row, rows, column, columns) = \
  sprintf("set lmargin at screen %g; set rmargin at screen %g; ", (column - 1.0) / columns + panel_left / width, 1.0 * column / columns - 0.25 / width) . \
  sprintf("set tmargin at screen %g; set bmargin at screen %g", \
          1 - (key_height + (row - 1.0) / rows * (height - key_height) + panel_top) / height, \
          1 - (key_height + 1.0 * row / rows * (height - key_height) - panel_bottom) / height)

# Curves of groups: told apart in gray by dash and symbol.
array ink[8] = ["#000000", "#1f4e79", "#b03a2e", "#3d8b7d", "#7a5c99", "#b8860b", "#707070", "#5d9cc9"]
array dash[8] = ["solid", "(10,4)", "(3,3)", "(12,3,3,3)", "(6,3)", "(12,3,3,3,3,3)", "(2,4)", "(18,4)"]
array mark[8] = [7, 4, 9, 12, 6, 5, 8, 10]
symbol = pass == 2 ? 1.333 : 1  # the unit of symbols in SVG is the pixel
do for [k = 1:8] {
  eval sprintf('set linetype %d linecolor rgb "%s" dashtype %s linewidth 2 pointtype %d pointsize %g', k, ink[k], dash[k], mark[k], 0.45 * symbol)
}
set linetype cycle 8
colour(g) = ink[int((g - 1) % 8) + 1]
# Marks of the paper's values, laws and thresholds, and helping lines.
set style line 101 linecolor rgb "#000000" dashtype solid linewidth 2 pointtype 2 pointsize 0.8 * symbol
set style line 102 linecolor rgb "#555555" dashtype (1,3) linewidth 2
set style line 103 linecolor rgb "#999999" dashtype (6,4) linewidth 1.5

# Error bars are vectors: those of gnuplot blank what lies around them.
bar_from(name) = scale * (column(name) - column(name . "_error"))
bar_length(name) = scale * 2 * column(name . "_error")

# Bands around a mean, for width = "_error" or "_deviation". Thin lines are transparent: many of them are behind it.
band_low(name, width) = scale * (column(name) - column(name . width))
band_high(name, width) = scale * (column(name) + column(name . width))
opacity(g) = has_runs(g) && value(sprintf("drawn_%d", g)) > 14 ? 5.0 / value(sprintf("drawn_%d", g)) : 0.35
pale(g) = sprintf("#%02x", 255 * (1 - opacity(g))) . colour(g)[2:7]

# The curves of all groups, `scale` times column `ordinate` over the expression `abscissa`: plot @curves, ...
# Behind them the bands of the standard deviation, the runs one by one, and the bands of the standard error (none of them
# where it is NaN); then lines and symbols, and all of these in the key.
ordinate = "none"
scale = 1
abscissa = 'column("theta")'
key_of_spread = spread ? ', keyentry with lines linecolor rgb "#999999" dashtype solid linewidth 0.5 title "runs", ' . \
  'keyentry with boxes linecolor rgb ink[1] fillstyle transparent solid 0.4 noborder title "± standard error", ' . \
  'keyentry with boxes linecolor rgb ink[1] fillstyle transparent solid 0.13 noborder title "± standard deviation"' : ''
curves = 'for [g = 1:groups] data(g) using (@abscissa):(band_low(ordinate, "_deviation")):(band_high(ordinate, "_deviation")) ' . \
  'with filledcurves linetype g fillstyle transparent solid 0.13 noborder notitle, ' . \
  'for [g = 1:groups] for [side = -1:1:2] data(g) using (@abscissa):(scale * (column(ordinate) + side * column(ordinate . "_deviation"))) ' . \
  'with lines linetype g dashtype solid linewidth 0.5 notitle, ' . \
  'for [g = 1:groups] runs(g) using (@abscissa):(has_runs(g) ? scale * column(ordinate) : NaN) with lines linecolor rgb pale(g) dashtype solid linewidth 0.5 notitle, ' . \
  'for [g = 1:groups] data(g) using (@abscissa):(band_low(ordinate, "_error")):(band_high(ordinate, "_error")) ' . \
  'with filledcurves linetype g fillstyle transparent solid 0.4 noborder notitle, ' . \
  'for [g = 1:groups] data(g) using (@abscissa):(scale * column(ordinate)) with lines linetype g notitle, ' . \
  'for [g = 1:groups] data(g) using (@abscissa):(scale * column(ordinate)) every every(g) with points linetype g notitle, ' . \
  'for [g = 1:groups] NaN with linespoints linetype g title label(g)' . key_of_spread
