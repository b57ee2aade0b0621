// State of the page, stored in the address after "#", so that a copied address shows the same content.

const readState = () => Object.fromEntries(new URLSearchParams(location.hash.slice(1)));

/** Returns the first frame of the tilt phase nearest to a value in a list: a tilt in frames.tilts, or a place in frames.places. */
function frameNear(list, value) {
  let best = 0;
  for (let k = 1; k < frames.of_tilt; ++k) if (Math.abs(list[k] - value) < Math.abs(list[best] - value)) best = k;
  return best;
}

/** Returns the last frame before failure or, without failure, the last of the tilt phase. */
function frameAtRepose() {
  const before = frames.places.slice(0, frames.of_tilt).filter((place) => failure === null || place <= failure);
  return Math.max(0, before.length - 1);
}

/** Returns the frame given by its number on the page or by the nearest angle. */
function frameOfState(state) {
  if (state.at !== undefined && Number.isFinite(Number(state.at))) return frameNear(frames.tilts, Number(state.at));
  const frame = Math.round(Number(state.frame));
  return Number.isFinite(frame) ? Math.min(Math.max(frame, 0), frames.count - 1) : null;
}

let stateTimer = null;

/** Writes the state with a delay, because browsers limit how often an address may change. */
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
      // The browser does not allow the address to change.
    }
  }, 300);
}
