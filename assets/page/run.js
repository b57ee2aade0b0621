// The run: its data, decoded from its tables. Lengths are in mean diameters, angles in degrees.

const noCode = 65535;
const data = JSON.parse(byId("data").textContent);
const bed = data.bed;
const frames = { ...data.frames, count: data.frames.numbers.length };
const tables = {};

async function readTables(names) {
  for (const entry of data.tables)
    if (names.includes(entry.name)) tables[entry.name] = await readTable(entry);
}

const isFlow = (frame) => frame >= frames.of_tilt;

/** Returns the radii of all grains. */
function radii() {
  if (!radii.known) radii.known = Float32Array.from(tables.radius.codes, (code) => bed.radius.low + bed.radius.step * code);
  return radii.known;
}

/** Returns the centres of all grains in a frame: x, y, x, y, ... */
function centres(frame) {
  if (centres.frame !== frame) {
    const known = centres.known || new Float32Array(2 * bed.grains);
    const x = tables.x.codes, y = tables.y.codes;
    for (let i = 0, at = frame; i < bed.grains; ++i, at += frames.count) {
      known[2 * i] = bed.x.low + bed.x.step * x[at];
      known[2 * i + 1] = bed.y.low + bed.y.step * y[at];
    }
    centres.known = known;
    centres.frame = frame;
  }
  return centres.known;
}

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
function clusterSizes(frame) {
  if (clusterSizes.frame !== frame) {
    const sizes = [], codes = tables.cluster.codes;
    for (let at = frame; at < codes.length; at += frames.count)
      if (codes[at] !== noCode) sizes[codes[at]] = (sizes[codes[at]] || 0) + 1;
    clusterSizes.known = sizes;
    clusterSizes.frame = frame;
  }
  return clusterSizes.known;
}

/** Returns the number of grains in the cluster of a grain; NaN if it is not overloaded. */
function clusterSize(grain, frame) {
  const code = tables.cluster.codes[grain * frames.count + frame];
  return code === noCode ? NaN : clusterSizes(frame)[code];
}

/** Returns the number of force-carrying contacts of each grain. */
function coordinations(frame) {
  if (coordinations.frame !== frame) {
    const counts = new Uint16Array(bed.grains), { a, b, force } = tables;
    for (let c = 0; c < a.rows; ++c) {
      if (force.codes[c * frames.count + frame] === 0) continue;
      ++counts[a.codes[c]];
      if (b.codes[c] < bed.grains) ++counts[b.codes[c]];
    }
    coordinations.known = counts;
    coordinations.frame = frame;
  }
  return coordinations.known;
}

/** Returns f_n divided by the mean of its frame. */
const forceOf = (code) => data.contacts.widest * ((code - 1) / 254) ** 2;

/** Returns the values of a free grain in a frame: [{ label, value, digits, unit }], label and unit as rich text. */
function grainValues(grain, frame) {
  const values = [];
  for (const field of data.fields) {
    if (field.name === "cluster") values.push({ name: "cluster", label: "cluster", value: clusterSize(grain, frame), digits: 0, unit: "grains" });
    else values.push({ ...field, value: fieldValue(field, grain, frame) });
  }
  values.push({ name: "coordination", label: "contacts", value: coordinations(frame)[grain], digits: 0, unit: "" });
  return values;
}
