// What is shown, in the address: after "#", so that a copied address shows the same.

function readState() {
  return Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
}

/** The frame nearest to a tilt, among those of the tilt. */
function frameAtTilt(tilt) {
  let best = 0;
  for (let k = 1; k < frames.of_tilt; ++k) if (Math.abs(frames.tilts[k] - tilt) < Math.abs(frames.tilts[best] - tilt)) best = k;
  return best;
}

/** The last frame before failure; the last of the tilt where it has not failed. */
function frameAtRepose() {
  const last = Math.max(0, frames.of_tilt - 1);
  if (data.theta_c === null) return last;
  let found = 0;
  for (let k = 0; k <= last; ++k) if (frames.tilts[k] <= data.theta_c) found = k;
  return found;
}

/** A frame by its place on the page, or the nearest to an angle. */
function frameOfState(state) {
  if (state.at !== undefined && Number.isFinite(Number(state.at))) return frameAtTilt(Number(state.at));
  const frame = Math.round(Number(state.frame));
  return Number.isFinite(frame) ? Math.min(Math.max(frame, 0), frames.count - 1) : null;
}

let stateTimer = null;

/** Not at once, as browsers refuse to change an address many times in a second. */
function writeState(cells) {
  clearTimeout(stateTimer);
  stateTimer = setTimeout(() => {
    const state = new URLSearchParams({ frame: view.frame, map: view.map ? view.map.name : "none", lines: view.lines ? view.lines.name : "none" });
    if (view.turned) state.set("turned", "1");
    if (view.grain >= 0) state.set("grain", view.grain);
    state.set("plots", cells.map((cell) => cell.name()).join(","));
    try {
      history.replaceState(null, "", `#${state}`);
    } catch (error) {
      // An address that may not be changed is left as it is.
    }
  }, 300);
}
