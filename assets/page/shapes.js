// Shapes of a frame: discs and lines in mean diameters, as arrays with a fixed number of entries per shape.

/** Returns x, y, radius, hatched of all grains; their looks are separate. */
function discShapes(frame) {
  const places = centres(frame), sizes = radii(), discs = new Float32Array(4 * bed.grains);
  for (let i = 0; i < bed.grains; ++i) {
    discs[4 * i] = places[2 * i];
    discs[4 * i + 1] = places[2 * i + 1];
    discs[4 * i + 2] = sizes[i];
    discs[4 * i + 3] = i < bed.free ? 0 : 1;
  }
  return discs;
}

/** Returns the unit normal of a contact, from a to b, and the distance between the centres, or of a from its plane. */
function branch(c, places) {
  const a = tables.a.codes[c], b = tables.b.codes[c], x = places[2 * a], y = places[2 * a + 1];
  if (b >= bed.grains) {
    const [, nx, ny] = data.contacts.planes.find((plane) => plane[0] === b);
    return { x, y, nx, ny, length: radii()[a], radius: radii()[a] };
  }
  const shift = (tables.shift.codes[c] << 24) >> 24;  // a signed byte
  const dx = places[2 * b] + shift * bed.length - x, dy = places[2 * b + 1] - y, length = Math.hypot(dx, dy);
  return { x, y, nx: dx / length, ny: dy / length, length, radius: radii()[a] };
}

/** Returns a list of lines, each with ends, half width and four bytes of colour; strong ones last, so that they lie on top. */
function forceLines(frame, places, swatches) {
  const [strong, weak] = swatches.map((swatch) => colourBytes(swatch.fill));
  const weakLines = [], strongLines = [];
  for (let c = 0, at = frame; c < tables.a.rows; ++c, at += frames.count) {
    const code = tables.force.codes[at];
    if (code === 0) continue;
    const force = forceOf(code), { x, y, nx, ny, length } = branch(c, places);
    const line = { ends: [x, y, x + length * nx, y + length * ny], half: data.contacts.half_width * force };
    if (force > 1) strongLines.push({ ...line, colour: strong });
    else weakLines.push({ ...line, colour: weak });
  }
  return weakLines.concat(strongLines);
}

/** Returns lines along the two surfaces, through the contact point. */
function criticalLines(frame, places, swatches) {
  const colour = colourBytes(swatches[0].fill), reach = 0.5 * data.contacts.critical_length, lines = [];
  for (let c = 0, at = frame; c < tables.a.rows; ++c, at += frames.count) {
    if (tables.sliding.codes[at] === 0) continue;
    const { x, y, nx, ny, radius } = branch(c, places), px = x + radius * nx, py = y + radius * ny;
    lines.push({ ends: [px + reach * ny, py - reach * nx, px - reach * ny, py + reach * nx],
                 half: data.contacts.critical_half_width, colour });
  }
  return lines;
}

/** Adds a white border to opaque lines over filled grains, which distinguishes them from any shade of gray. */
function withBorders(lines) {
  const isOpaque = (line) => line.colour[3] === 255, above = lines.filter(isOpaque);
  const borders = above.map((line) => ({ ...line, half: line.half + data.contacts.border, colour: [255, 255, 255, 255] }));
  return lines.filter((line) => !isOpaque(line)).concat(borders, above);
}

/** Returns the legend of lines over a map; `map` null: over outlines. */
const linesLegend = (lines, map) => lines.legends.find((legend) => legend.over === (map ? map.over : "")).legend;

/** Returns the lines of a frame; `numbers` has 4 ends and a half width per line, `colours` 4 bytes. */
function lineShapes(lines, map, frame) {
  if (!lines) return { count: 0, numbers: new Float32Array(0), colours: new Uint8Array(0) };
  const make = lines.name === "forces" ? forceLines : criticalLines;
  const bare = make(frame, centres(frame), linesLegend(lines, map).swatches), made = map ? withBorders(bare) : bare;
  const numbers = new Float32Array(5 * made.length), colours = new Uint8Array(4 * made.length);
  made.forEach((line, k) => {
    numbers.set(line.ends, 5 * k);
    numbers[5 * k + 4] = line.half;
    colours.set(line.colour, 4 * k);
  });
  return { count: made.length, numbers, colours };
}

/** Shifts at which the bed is drawn; a periodic bed includes its neighbouring images. */
const shifts = bed.periodic ? [0, -bed.length, bed.length] : [0];

const faded = 0.28;  // opacity of the images beyond the edges of the period
