
# Widths of texts in DejaVu Sans, estimated conservatively, to which keys, margins and axes are fitted.
# Width of a character in units of the font size; markup has none.
em(c) = strstrt("{}_^\\", c) > 0 ? 0 : strstrt("ijlI|'", c) > 0 ? 0.3 : strstrt(" .,:;/()[]ftr-!\"°", c) > 0 ? 0.41 : \
  strstrt("mwMW%@", c) > 0 ? 0.98 : strstrt("=+−±×≤≥<>~#", c) > 0 ? 0.84 : strstrt("ABCDEFGHKLNOPQRSTUVXYZΓ", c) > 0 ? 0.76 : 0.64
plain_em(text) = strlen(text) < 1 ? 0 : (sum [i = 1:strlen(text)] em(text[i:i]))
times_in(text, part) = strlen(text) < strlen(part) ? 0 : (sum [i = 1:strlen(text) - strlen(part) + 1] (text[i:i + strlen(part) - 1] eq part))
# Width (cm) of a text at the given font size in points; its height is about 0.045 cm per point.
text_cm(text, points) = 0.0353 * points * (plain_em(text) - times_in(text, "/:Italic ") * plain_em("/:Italic ") - times_in(text, "/:Bold ") * plain_em("/:Bold "))

# Font for a text that may not exceed the given length in cm.
fitted_points(text, points, longest) = text_cm(text, points) > longest ? points * longest / text_cm(text, points) : points
fitted(text, points, longest) = sprintf(",%g", fitted_points(text, points, longest))

# Breaks `text_to_break` into `text_lines` lines of at most `break_cm`: broken[1], broken[2], ... Breaks are at blanks outside braces;
# a longer word is broken anywhere.
array broken[60]
break_text = 'text_lines = 0; this_line = ""; text_rest = text_to_break; \
  while (strlen(text_rest) > 0) { \
    blank_at = strstrt(text_rest, " "); next_word = blank_at > 0 ? text_rest[1:blank_at - 1] : text_rest; text_rest = blank_at > 0 ? text_rest[blank_at + 1:*] : ""; \
    longer = strlen(this_line) > 0 ? this_line . " " . next_word : next_word; \
    if (strlen(this_line) > 0 && text_cm(longer, break_points) > break_cm && times_in(this_line, "{") == times_in(this_line, "}") && text_lines < 58) { \
      text_lines = text_lines + 1; broken[text_lines] = this_line; this_line = next_word } else { this_line = longer }; \
    while (text_cm(this_line, break_points) > break_cm && strstrt(this_line, " ") == 0 && strlen(this_line) > 1 && text_lines < 58) { \
      cut_at = strlen(this_line) - 1; \
      while (cut_at > 1 && (text_cm(this_line[1:cut_at], break_points) > break_cm || this_line[cut_at:cut_at] eq "\\")) { cut_at = cut_at - 1 }; \
      text_lines = text_lines + 1; broken[text_lines] = this_line[1:cut_at]; this_line = this_line[cut_at + 1:*] } }; \
  text_lines = text_lines + 1; broken[text_lines] = this_line'
