// Looks of grains: fill and rim, eight bytes per grain, from the colours stored in the page.

/** Returns the bytes of "#rrggbbaa...". */
function colourBytes(text) {
  const digits = text.replace(/#/g, "");
  return Array.from({ length: digits.length / 2 }, (_, k) => parseInt(digits.slice(2 * k, 2 * k + 2), 16));
}

/** Returns a ramp as 256 looks. */
function rampLooks(ramp) {
  if (!ramp.looks) {
    ramp.looks = new Uint8Array(8 * 256);
    const fills = colourBytes(ramp.fills), rims = colourBytes(ramp.rims);
    for (let k = 0; k < 256; ++k)
      ramp.looks.set([...fills.slice(3 * k, 3 * k + 3), 255, ...rims.slice(3 * k, 3 * k + 3), 255], 8 * k);
  }
  return ramp.looks;
}

/** Returns the entry for a frame from a list of distinct entries. */
const ofFrame = (distinct, frame) => distinct.kinds[distinct.of[frame]];

/** Returns the step of the ramp for a value, as colour_at does; the lower end if there is no value. */
function rampStep(scale, value) {
  const share = scale.log ? Math.log(value / scale.low) / Math.log(scale.high / scale.low)
                          : (value - scale.low) / (scale.high - scale.low);
  return share > 0 ? Math.round(255 * Math.min(share, 1)) : 0;
}

function scaledLooks(map, frame, looks) {
  const scale = ofFrame(map.scales, frame), ramp = rampLooks(map.ramp), field = fieldOf(map.name);
  const codes = tables[map.name].codes;
  for (let i = 0, at = frame; i < bed.free; ++i, at += frames.count) {
    const step = 8 * rampStep(scale, decoded(field, codes[at]));
    for (let k = 0; k < 8; ++k) looks[8 * i + k] = ramp[step + k];
  }
}

function clusterLooks(map, frame, looks) {
  const known = ofFrame(map.looks, frame), codes = tables.cluster.codes;
  const first = known.first.map(colourBytes), rest = colourBytes(known.rest), none = colourBytes(known.none);
  for (let i = 0, at = frame; i < bed.free; ++i, at += frames.count)
    looks.set(codes[at] === noCode ? none : first[codes[at]] || rest, 8 * i);
}

/** Returns the looks of all grains in a frame; `map` null: outlines. */
function looksOf(map, frame) {
  const looks = new Uint8Array(8 * bed.grains);
  if (!map) {
    const outline = colourBytes(data.outlines);
    for (let i = 0; i < bed.free; ++i) looks.set(outline, 8 * i);
  } else if (map.ramp) scaledLooks(map, frame, looks);
  else clusterLooks(map, frame, looks);
  const floor = colourBytes(data.floor);
  for (let i = bed.free; i < bed.grains; ++i) looks.set(floor, 8 * i);
  return looks;
}
