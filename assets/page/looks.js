// Looks of grains and lines: bytes of their colours, fill and rim, from those stored in the page. Lengths are in mean diameters.

/** Returns the bytes of "#rrggbbaa...". */
function colourBytes(text) {
  const digits = text.replace(/#/g, "");
  return Array.from({ length: digits.length / 2 }, (_, k) => parseInt(digits.slice(2 * k, 2 * k + 2), 16));
}

/** Returns the entry for a frame from a list of distinct entries. */
const ofFrame = (distinct, frame) => distinct.kinds[distinct.of[frame]];

/** Returns the step of the ramp for a value, as colour_at does; the lower end if there is no value. */
function rampStep(scale, value) {
  const share = scale.log ? Math.log(value / scale.low) / Math.log(scale.high / scale.low)
                          : (value - scale.low) / (scale.high - scale.low);
  return share > 0 ? Math.round(255 * Math.min(share, 1)) : 0;
}

/** Returns a function that gives the look of a free grain in a frame. */
function lookOf(map, frame) {
  if (!map) {
    const outline = colourBytes(data.outlines);
    return () => outline;
  }
  if (map.ramp) {
    const scale = ofFrame(map.scales, frame), field = fieldOf(map.name);
    const fills = colourBytes(map.ramp.fills), rims = colourBytes(map.ramp.rims);
    return (grain) => {
      const step = 3 * rampStep(scale, fieldValue(field, grain, frame));
      return [fills[step], fills[step + 1], fills[step + 2], 255, rims[step], rims[step + 1], rims[step + 2], 255];
    };
  }
  const known = ofFrame(map.looks, frame), first = known.first.map(colourBytes), rest = colourBytes(known.rest), none = colourBytes(known.none);
  return (grain) => {
    const cluster = tables.cluster.codes[grain * frames.count + frame];
    return cluster === noCode ? none : first[cluster] || rest;
  };
}

/** Returns the looks of all grains in a frame, eight bytes each; `map` null: outlines. */
function looksOf(map, frame) {
  const looks = new Uint8Array(8 * bed.grains), free = lookOf(map, frame), floor = colourBytes(data.floor);
  for (let i = 0; i < bed.grains; ++i) looks.set(i < bed.free ? free(i) : floor, 8 * i);
  return looks;
}

/** Returns the centre of a, the unit normal from a to b, and the distance between the centres, or of a from its plane. */
function branch(c, places) {
  const a = tables.a.codes[c], b = tables.b.codes[c], x = places[2 * a], y = places[2 * a + 1], radius = radii()[a];
  if (b >= bed.grains) {
    const [, nx, ny] = data.contacts.planes.find((plane) => plane[0] === b);
    return { x, y, nx, ny, length: radius, radius };
  }
  const shift = (tables.shift.codes[c] << 24) >> 24;  // a signed byte
  const dx = places[2 * b] + shift * bed.length - x, dy = places[2 * b + 1] - y, length = Math.hypot(dx, dy);
  return { x, y, nx: dx / length, ny: dy / length, length, radius };
}

/** Returns lines between centres, by width, first the weak forces and then the strong ones. */
function forceLines(frame, places, [strong, weak]) {
  const weakLines = [], strongLines = [];
  for (let c = 0, at = frame; c < tables.a.rows; ++c, at += frames.count) {
    const code = tables.force.codes[at];
    if (code === 0) continue;
    const force = data.contacts.widest * ((code - 1) / 254) ** 2, { x, y, nx, ny, length } = branch(c, places);
    (force > 1 ? strongLines : weakLines).push({ x0: x, y0: y, x1: x + length * nx, y1: y + length * ny,
                                                 half: data.contacts.half_width * force, look: force > 1 ? strong : weak });
  }
  return weakLines.concat(strongLines);
}

/** Returns lines along the two surfaces, through the contact point. */
function criticalLines(frame, places, [look]) {
  const reach = 0.5 * data.contacts.critical_length, lines = [];
  for (let c = 0, at = frame; c < tables.a.rows; ++c, at += frames.count) {
    if (tables.sliding.codes[at] === 0) continue;
    const { x, y, nx, ny, radius } = branch(c, places), px = x + radius * nx, py = y + radius * ny;
    lines.push({ x0: px + reach * ny, y0: py - reach * nx, x1: px - reach * ny, y1: py + reach * nx,
                 half: data.contacts.critical_half_width, look });
  }
  return lines;
}

/** Returns the legend of lines over a map; `map` null: over outlines. */
const linesLegend = (lines, map) => lines.legends.find((legend) => legend.over === (map ? map.over : "")).legend;

/** Returns the lines of a frame. Over a map opaque ones get a white border, which distinguishes them from any shade of gray. */
function linesOf(lines, map, frame) {
  if (!lines) return [];
  const looks = linesLegend(lines, map).swatches.map((swatch) => colourBytes(swatch.fill + swatch.fill));
  const made = (lines.name === "forces" ? forceLines : criticalLines)(frame, centres(frame), looks);
  if (!map) return made;
  const white = Array(8).fill(255), above = made.filter((line) => line.look[3] === 255);
  const borders = above.map((line) => ({ ...line, half: line.half + data.contacts.border, look: white }));
  return made.filter((line) => line.look[3] !== 255).concat(borders, above);
}
