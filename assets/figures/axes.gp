
# Panels and their axes. The script is read once without drawing (pass 0) to find the ranges of the data, which determine margins,
# steps and formats of the numbers. For each panel k, a script contains
#   eval place(k)        margins, in the grid of `grid`, or place_at for any other place
#   x_from, x_to, ...    ends of the axes, NaN to use those of the data; x_log = 1 for a logarithmic axis; y_plain = 1 if
#                        the script sets the numbers itself
#   eval axes            ranges and numbers
#   plot ...             the curves
#   eval seen            keeps the ranges
smaller(a, b) = a < b ? a : b
larger(a, b) = a > b ? a : b
known(x) = x == x

# Step of an axis: 1, 2 or 5 times a power of ten.
nice(x) = (decade = 10.0 ** floor(log10(x) + 1e-9), ratio = x / decade, (ratio < 1.001 ? 1 : ratio < 2.001 ? 2 : ratio < 5.001 ? 5 : 10) * decade)
# Common power of ten of the numbers of an axis: none between 0.01 and 99999.
power_of(low, high) = (magnitude = larger(abs(low), abs(high)), magnitude > 0 ? floor(log10(magnitude) + 1e-9) : 0)
common_power(low, high) = (p10 = power_of(low, high), p10 >= 5 || p10 <= -3 ? p10 : 0)
decimals(step, power) = (d10 = -floor(log10(step) - power + 1e-6), d10 < 0 ? 0 : d10)
signed(text) = text[1:1] eq "-" ? "−" . text[2:*] : text
number(x, step, power) = signed(sprintf(sprintf("%%.%df", decimals(step, power)), abs(x) < 1e-6 * step ? 0 : x / 10.0 ** power))
first_tick(low, step) = ceil(low / step - 1e-6)
last_tick(high, step) = floor(high / step + 1e-6)
widest_number(low, high, step, power, points) = larger(text_cm(number(first_tick(low, step) * step, step, power), points), \
  text_cm(number(last_tick(high, step) * step, step, power), points))
# Smallest step whose numbers do not overlap on an axis of the given length (cm), with at most n steps.
x_step(low, high, cm, points, n) = (step10 = nice(1.0 * (high - low) / n), n < 1.5 || \
  step10 / (high - low) * cm > widest_number(low, high, step10, common_power(low, high), points) + 0.25 ? step10 : x_step(low, high, cm, points, n - 1))
# At least two numbers, because gnuplot would replace an empty list by its own.
two_ticks(low, high, step) = !(high > low) || last_tick(high, step) > first_tick(low, step) ? step : two_ticks(low, high, nice(step / 2.5))
y_step(low, high, cm, points) = two_ticks(low, high, nice(1.0 * (high - low) / larger(1.5, smaller(6, floor(cm / (0.065 * points))))))
bare = 0  # 1: ticks without numbers
tick_list(k, last, step, power) = k > last ? "" : \
  sprintf("'%s' %.15g", bare ? "" : number(k * step, step, power), k * step) . (k < last ? ", " : "") . tick_list(k + 1, last, step, power)

# Logarithmic axis: every n-th power of ten; other numbers if these are few.
power_text(n) = n == 0 ? "1" : n == 1 ? "10" : sprintf("10^{%s}", signed(sprintf("%d", n)))
mantissa(m, n) = n >= -2 && n <= 3 ? sprintf("%g", m * 10.0 ** n) : sprintf("%d×10^{%s}", m, signed(sprintf("%d", n)))
powers(n, last, every) = n > last ? "" : sprintf(", '%s' %.15g", power_text(n), 10.0 ** n) . powers(n + every, last, every)
between(n, last, every) = n > last ? "" : (every > 1 ? (every > 12 ? "" : sprintf(", '' %.15g 1", 10.0 ** n)) : \
  sprintf(", '' %g 1, '' %g 1, '' %g 1, '' %g 1", 2 * 10.0 ** n, 4 * 10.0 ** n, 6 * 10.0 ** n, 8 * 10.0 ** n)) . between(n + 1, last, every)
tick_at(m, n, low, high) = m * 10.0 ** n >= low * 0.999999 && m * 10.0 ** n <= high * 1.000001 ? sprintf(", '%s' %.15g", mantissa(m, n), m * 10.0 ** n) : ""
# At 1, 2 and 5 times each power, or at 1 and 3 times, depending on the room for `step` (decades) between them.
few(n, last, low, high, step) = n > last ? "" : tick_at(1, n, low, high) . \
  (step < 0.3 ? tick_at(2, n, low, high) . tick_at(5, n, low, high) : step < 0.47 ? tick_at(3, n, low, high) : "") . few(n + 1, last, low, high, step)
log_list(low, high, cm, points, horizontal) = (from10 = ceil(log10(low) - 1e-6), to10 = floor(log10(high) + 1e-6), \
  every10 = ceil((log10(high) - log10(low)) * (horizontal ? 0.14 : 0.07) * points / cm), every10 = every10 < 1 ? 1 : every10, \
  to10 - from10 < 2 && log10(high / low) > 0.4 ? few(from10 - 1, to10, low, high, (horizontal ? 0.2 + text_cm("5×10^{−5}", points) : 0.06 * points) * log10(high / low) / cm)[3:*] : \
  to10 - from10 < 2 ? tick_list(first_tick(low, nice((high - low) / 2.0)), last_tick(high, nice((high - low) / 2.0)), nice((high - low) / 2.0), 0) : \
  powers(every10 * ceil(1.0 * from10 / every10), to10, every10)[3:*] . between(from10 - 1, to10, every10))

# Ends of an axis slightly beyond its data, but not below 0 if no number is, and not above a limit that all numbers respect.
wider(low, high) = high > low ? 0.05 * (high - low) : high != 0 ? 0.1 * abs(high) : 1.0
low_end(low, high) = low >= 0 && low < wider(low, high) ? 0 : low - wider(low, high)
high_end(low, high) = high <= 0 && -high < wider(low, high) ? (high == low ? 1 : 0) : high <= 1 && high + wider(low, high) > 1 ? 1 : high + wider(low, high)
log_low_end(low, high) = high > low ? low / (high / low) ** 0.05 : low / 2
log_high_end(low, high) = high > low ? high * (high / low) ** 0.05 : high * 2

# Title with its unit in parentheses, "title (s)", also from "title in s". A power of ten precedes the unit, or is at the end.
power_unit(power) = sprintf("10^{%s}", signed(sprintf("%d", power)))
last_word(text) = words(text) > 0 ? word(text, words(text)) : ""
before_last(text) = text[1:strlen(text) - strlen(last_word(text))]
has_in(text) = words(text) > 2 && word(text, words(text) - 1) eq "in"
with_unit(text) = has_in(text) ? text[1:strlen(before_last(text)) - 4] . " (" . last_word(text) . ")" : text
with_power(text, power) = power_before_unit(with_unit(text), power)
power_before_unit(text, power) = power == 0 ? text : last_word(text)[1:1] eq "(" ? before_last(text) . "(" . power_unit(power) . " " . last_word(text)[2:*] : text . " (" . power_unit(power) . ")"

most_panels = 1000
if (pass == 0) {
  array x_least[most_panels]
  array x_most[most_panels]
  array y_least[most_panels]
  array y_most[most_panels]
  tick_room = 0.3  # cm, width of the widest number on a vertical axis
  x_overhang = 0.15  # cm, half the width of the widest number on a horizontal axis
  heading_lines = 1  # lines of the longest heading
}

# Room around a panel (cm): left of its numbers for a title, above, below, and on the right; above and below all panels.
title_room = 0.5
number_gap = 0.22
panel_top = 0.15
panel_bottom = 1.0
panel_right = 0.1
grid_above = 0
grid_below = 0
tick_points = 7
title_points = 8
heading_points = 7
# Number of panels, number per row in two columns and in one column, and height of each (cm).
grid(panels, wide, narrow, panel_cm) = grid_of(panels, smaller(panels, width > 12 ? wide : narrow), panel_cm)
# A requested height is shared among the panels, if that leaves room for their texts.
stretches = 0
least_row_cm = 3
grid_of(panels, columns, panel_cm) = sprintf("stretches = 1; panel_columns = %d; panel_rows = %d; height = %g + grid_above + grid_below", \
  columns, int((panels + columns - 1) / columns), panel_cm * int((panels + columns - 1) / columns))
place_at(k, left, right, bottom, top) = sprintf("panel_k = %d; panel_at = %.9g; panel_from = %.9g; panel_width = %.9g; panel_height = %.9g; ", k, left, bottom, right - left, top - bottom) . \
  sprintf("set lmargin at screen %.9g; set rmargin at screen %.9g; set bmargin at screen %.9g; set tmargin at screen %.9g; ", left / width, right / width, bottom / height, top / height) . \
  "x_from = NaN; x_to = NaN; y_from = NaN; y_to = NaN; x_log = 0; y_log = 0; y_top = NaN; x_bare = 0; y_bare = 0; y_plain = 0; x_title = ''; y_title = ''; heading = ''"
place(k) = place_in(k, (k - 1) / panel_columns, (k - 1) % panel_columns, (height - key_height - grid_above - grid_below) / panel_rows)
place_in(k, row, column, row_cm) = place_at(k, \
  1.0 * column / panel_columns * width + title_room + tick_room + number_gap, (column + 1.0) / panel_columns * width - larger(panel_right, 0.05 + x_overhang), \
  height - key_height - grid_above - (row + 1) * row_cm + panel_bottom, height - key_height - grid_above - row * row_cm - panel_top - 0.3 * (heading_lines - 1))
first_in_row(k) = (k - 1) % panel_columns == 0

range(from, to) = "[" . (known(from) ? sprintf("%.15g", from) : "*") . ":" . (known(to) ? sprintf("%.15g", to) : "*") . "]"
x_power = 0
y_power = 0
# Range and numbers of an axis; both axes may be reversed.
set_axis(axis, from, to, list) = sprintf("set %srange %s noextend; set %stics (", axis, range(from, to), axis) . list . ")"
find_ends = 'x_a = known(x_from) ? x_from : x_log ? log_low_end(x_least[panel_k], x_most[panel_k]) : low_end(x_least[panel_k], x_most[panel_k]); \
  x_b = known(x_to) ? x_to : x_log ? log_high_end(x_least[panel_k], x_most[panel_k]) : high_end(x_least[panel_k], x_most[panel_k]); \
  y_a = known(y_from) ? y_from : y_log ? log_low_end(y_least[panel_k], y_most[panel_k]) : low_end(y_least[panel_k], y_most[panel_k]); \
  y_b = known(y_to) ? y_to : y_log ? log_high_end(y_least[panel_k], y_most[panel_k]) : high_end(y_least[panel_k], y_most[panel_k]); \
  if (known(y_top) && y_b > y_top) { y_b = y_top }; \
  if (!(abs(y_b - y_a) > 0)) { y_b = y_a + 1 }; if (!(abs(x_b - x_a) > 0)) { x_b = x_a + 1 }; \
  x_l = smaller(x_a, x_b); x_h = larger(x_a, x_b); y_l = smaller(y_a, y_b); y_h = larger(y_a, y_b); \
  x_power = x_log ? 0 : common_power(x_l, x_h); y_power = y_log || y_plain ? 0 : common_power(y_l, y_h); \
  x_s = x_log ? 0 : x_step(x_l, x_h, panel_width, tick_points, 6.0); y_s = y_log ? 0 : y_step(y_l, y_h, panel_height, tick_points)'
set_titles = 'unset label 91; unset label 92; unset label 93; \
  if (strlen(x_title) > 0) { x_title = with_power(x_title, x_power); \
    set label 91 x_title at graph 0.5, screen (panel_from - 0.7) / height center font fitted(x_title, title_points, panel_width + 2 * larger(panel_right, x_overhang)) }; \
  if (strlen(y_title) > 0) { y_title = with_power(y_title, y_power); \
    set label 92 y_title at screen (panel_at - tick_room - number_gap - 0.5 * title_room) / width, graph 0.5 center rotate by 90 font fitted(y_title, title_points, panel_height + panel_top + 0.3) }; \
  if (strlen(heading) > 0) { heading = with_power(heading, strlen(y_title) == 0 ? y_power : 0); \
    text_to_break = heading; break_cm = panel_width + 0.7 * tick_room; break_points = heading_points; eval break_text; \
    do for [l = 1:3] { eval sprintf("unset label %d", 92 + l) }; \
    do for [l = 1:smaller(text_lines, 3)] { set label 92 + l broken[l] at screen (panel_at - 0.7 * tick_room) / width, screen (panel_from + panel_height + 0.34 + 0.3 * (text_lines - l)) / height left font sprintf(",%g", heading_points) } }'
axes = 'unset logscale; if (x_log) { set logscale x }; if (y_log) { set logscale y }; \
  if (pass == 0) { eval set_axis("x", x_from, x_to, ""); eval set_axis("y", y_from, y_to, "") } else { \
    eval find_ends; \
    bare = x_bare; eval set_axis("x", x_a, x_b, x_log ? log_list(x_l, x_h, panel_width, tick_points, 1) : tick_list(first_tick(x_l, x_s), last_tick(x_h, x_s), x_s, x_power)); \
    bare = y_bare; eval set_axis("y", y_a, y_b, y_log ? log_list(y_l, y_h, panel_height, tick_points, 0) : tick_list(first_tick(y_l, y_s), last_tick(y_h, y_s), y_s, y_power)); \
    eval set_titles }'
seen = 'if (pass == 0) { \
    x_least[panel_k] = smaller(GPVAL_X_MIN, GPVAL_X_MAX); x_most[panel_k] = larger(GPVAL_X_MIN, GPVAL_X_MAX); \
    y_least[panel_k] = smaller(GPVAL_Y_MIN, GPVAL_Y_MAX); y_most[panel_k] = larger(GPVAL_Y_MIN, GPVAL_Y_MAX); \
    eval find_ends; \
    if (strlen(heading) > 0) { text_to_break = with_power(heading, strlen(y_title) == 0 ? y_power : 0); break_cm = panel_width; break_points = heading_points; eval break_text; heading_lines = larger(heading_lines, text_lines) }; \
    tick_room = larger(tick_room, y_log ? text_cm(y_h < 1001 * y_l ? "5×10^{−00}" : "10^{−00}", tick_points) : widest_number(y_l, y_h, y_s, y_power, tick_points)); \
    x_overhang = larger(x_overhang, 0.5 * (x_log ? text_cm("10^{−00}", tick_points) : widest_number(x_l, x_h, x_s, x_power, tick_points))) }'
