// The run: its data, decoded from its tables. Lengths are in mean diameters, angles in degrees.

const noCode = 65535;
const data = JSON.parse(byId("data").textContent);
const bed = data.bed;
const frames = { ...data.frames, count: data.frames.numbers.length };
const tables = {};

/** The axis of time line and curves (frames.places): the tilt or, if it does not only grow, the time since the first frame. */
const axis = frames.by_time ? { name: "time", symbol: "t", unit: "\u00a0s" } : { name: "the tilt", symbol: "θ", unit: "°" };
const placeText = (place) => `${axis.symbol} = ${place.toFixed(2)}${axis.unit}`;
if (frames.by_time)
  data.curves.quantities.unshift({ name: "tilt", title: "θ (°)", common: true, definition: "tilt of the bed, negative if it slopes backwards",
    curves: [{ label: "", over: "rows", values: data.curves.tilts }] });

/** Returns an angle with a minus sign unless it rounds to 0. */
const tiltText = (tilt, decimals) => tilt.toFixed(decimals).replace(/^-(?=.*[1-9])/, "−").replace(/^-/, "") + "°";

/** Returns the caption of a frame, which begins with its time if time is the axis. */
const captionOf = (frame) => (frames.by_time ? `${placeText(frames.places[frame])}, ` : "") + frames.captions[frame];

/** The place of failure on the axis; null without failure. */
const failure = frames.by_time ? (data.events.find((event) => event.kind === "failure") || { at: null }).at : data.theta_c;

async function inflate(text) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Undoes difference_bytes: each column is the difference from the previous one, the first from the row above. */
function undoDifferences(planes, { rows, columns, bytes }) {
  const count = rows * columns;
  const codes = bytes === 1 ? new Uint8Array(count) : bytes === 2 ? new Uint16Array(count) : new Uint32Array(count);
  for (let plane = 0; plane < bytes; ++plane)
    for (let k = 0, at = plane * count; k < count; ++k, ++at) codes[k] |= planes[at] << (8 * plane);
  for (let row = 0; row < rows; ++row) {
    const first = row * columns;
    if (row > 0 && columns > 0) codes[first] += codes[first - columns];
    for (let k = first + 1; k < first + columns; ++k) codes[k] += codes[k - 1];
  }
  return codes;
}

/** Reads all tables, base64 of a zlib stream of differences, byte by byte; removes their texts, which are large. */
async function readTables() {
  for (const entry of data.tables) {
    const holder = byId(`table-${entry.name}`), planes = await inflate(holder.textContent);
    holder.textContent = "";
    if (planes.length !== entry.rows * entry.columns * entry.bytes)
      throw new Error(`the table ${entry.name} is incomplete: the page was truncated or changed`);
    tables[entry.name] = { ...entry, codes: undoDifferences(planes, entry) };
  }
}

/** Returns a function of a frame that keeps its last result. */
function remembering(compute) {
  let last = -1, known = null;
  return (frame = 0) => {
    if (frame !== last) known = compute(frame);
    last = frame;
    return known;
  };
}

const radii = remembering(() => Float32Array.from(tables.radius.codes, (code) => bed.radius.low + bed.radius.step * code));

/** Returns the centres of all grains in a frame: x, y, x, y, ... */
const centres = remembering((frame) => {
  const places = new Float32Array(2 * bed.grains), x = tables.x.codes, y = tables.y.codes;
  for (let i = 0, at = frame; i < bed.grains; ++i, at += frames.count) {
    places[2 * i] = bed.x.low + bed.x.step * x[at];
    places[2 * i + 1] = bed.y.low + bed.y.step * y[at];
  }
  return places;
});

/** Returns the value of a code of a field; NaN for none. */
function decoded(field, code) {
  if (code === noCode) return NaN;
  if (!field.log) return field.low + field.step * code;
  return code === 0 ? 0 : field.low * Math.exp(field.step * code);
}

const fieldOf = (name) => data.fields.find((field) => field.name === name);

/** Returns the value of a free grain in a frame. */
const fieldValue = (field, grain, frame) => decoded(field, tables[field.name].codes[grain * frames.count + frame]);

/** Returns the number of grains in each cluster of overloaded grains of a frame. */
const clusterSizes = remembering((frame) => {
  const sizes = [], codes = tables.cluster.codes;
  for (let at = frame; at < codes.length; at += frames.count)
    if (codes[at] !== noCode) sizes[codes[at]] = (sizes[codes[at]] || 0) + 1;
  return sizes;
});

/** Returns the number of grains in the cluster of a grain; NaN if it is not overloaded. */
function clusterSize(grain, frame) {
  const code = tables.cluster.codes[grain * frames.count + frame];
  return code === noCode ? NaN : clusterSizes(frame)[code];
}

/** Returns the number of force-carrying contacts of each grain. */
const coordinations = remembering((frame) => {
  const counts = new Uint16Array(bed.grains), { a, b, force } = tables;
  for (let c = 0; c < a.rows; ++c) {
    if (force.codes[c * frames.count + frame] === 0) continue;
    ++counts[a.codes[c]];
    if (b.codes[c] < bed.grains) ++counts[b.codes[c]];
  }
  return counts;
});

/** The values of free grains: { name, label and unit as rich text, title, digits, of(grain, frame) }. */
const grainQuantities = [
  ...data.fields.map((field) => (field.name === "cluster"
    ? { ...field, label: "cluster", title: "grains in its cluster", unit: "grains", of: clusterSize }
    : { ...field, title: field.label + (field.unit ? ` (${field.unit})` : ""), of: (grain, frame) => fieldValue(field, grain, frame) })),
  { name: "coordination", label: "contacts", title: "contacts", unit: "", digits: 0, of: (grain, frame) => coordinations(frame)[grain] },
];
