// Connects buttons, keys, time line, map and plots.

const plotNames = ["tilt", "packing/stress_ratio", "overloaded/fraction", "lc/max", "clusters/largest_share", "packing/volume_strain",
                   "contacts/coordination_number", "contacts/critical_share"];
const shownPlots = 6;

let cells = [], card = null, line = null, play = null;

function goTo(frame) {
  view.frame = frame;
  if (view.turned) turnCamera(view.width, view.height, turnOf(frame));
  if (view.turned && view.whole) fitCamera(view.width, view.height, turnOf(frame));
  line.move(frame);
  for (const { plot } of [...cells, card]) plot.cursor(frames.places[frame]);
  card.show();
  redraw();
  writeState(cells);
}

/** Goes to a frame on request of the user, which pauses playback. */
function goByHand(frame) {
  play.pause();
  goTo(Math.min(Math.max(frame, 0), frames.count - 1));
}

function selectGrain(grain) {
  view.grain = grain >= 0 && grain < bed.free ? grain : -1;
  card.show();
  card.showHistory();
  card.plot.cursor(frames.places[view.frame]);
  redraw();
  writeState(cells);
}

/** Creates a row of buttons of which exactly one is pressed, for a member of the view. Returns a function that chooses. */
function choiceButtons(holder, member, choices) {
  const valueOf = (choice) => (choice.value === null ? null : choice);
  const buttons = choices.map((choice) => element("button", { type: "button", title: choice.help, onclick: () => choose(valueOf(choice)) }, choice.name));
  const choose = (value) => {
    view[member] = value;
    buttons.forEach((button, k) => button.setAttribute("aria-pressed", String(valueOf(choices[k]) === value)));
    redraw();
    writeState(cells);
  };
  byId(holder).replaceChildren(...buttons);
  return choose;
}

let setMap = null, setLines = null;

function setTurned(turned) {
  view.turned = turned;
  byId("turned").setAttribute("aria-pressed", String(turned));
  fitMap();
  writeState(cells);
}

function makeButtons() {
  setMap = choiceButtons("maps", "map", [...data.maps, { value: null, name: "outlines", help: "only the outlines of the grains" }]);
  setLines = choiceButtons("lines", "lines", [{ value: null, name: "no lines", help: "only the map" }, ...data.lines]);
  byId("turned").addEventListener("click", () => setTurned(!view.turned));
  byId("fit").addEventListener("click", fitMap);
}

function zoomBy(factor) {
  view.whole = false;
  zoomCamera(factor, view.width / 2, view.height / 2, view.fitted);
  redraw();
}

function nextLines() {
  const all = [null, ...data.lines];
  setLines(all[(all.indexOf(view.lines) + 1) % all.length]);
}

const keyActions = {
  " ": () => play.toggle(),
  ArrowRight: (event) => goByHand(view.frame + (event.shiftKey ? 10 : 1)),
  ArrowLeft: (event) => goByHand(view.frame - (event.shiftKey ? 10 : 1)),
  Home: () => goByHand(0),
  End: () => goByHand(frames.count - 1),
  o: nextLines,
  t: () => setTurned(!view.turned),
  f: fitMap,
  "+": () => zoomBy(1.25),
  "=": () => zoomBy(1.25),
  "-": () => zoomBy(0.8),
  n: () => selectGrain((view.grain + 1) % bed.free),
  Escape: () => selectGrain(-1),
};

function listenToKeys() {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest("select, input, textarea")) return;
    // The space bar presses a focused button.
    if (event.key === " " && event.target.closest("button, summary")) return;
    const digit = /^[1-9]$/.test(event.key) ? Number(event.key) : 0;
    const action = digit > 0 && digit <= data.maps.length ? () => setMap(data.maps[digit - 1]) : keyActions[event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

function makePlots(state) {
  const known = new Set(data.curves.quantities.map((quantity) => quantity.name)), go = (place) => goByHand(frameNear(frames.places, place));
  const names = new Set([...(state.plots || "").split(","), ...plotNames].filter((name) => known.has(name)));
  cells = [...names].slice(0, shownPlots).map((name) => quantityCell(name, go, () => writeState(cells)));
  byId("grain").parentElement.append(...cells.map((cell) => cell.cell));
  card = grainCard((holder) => curvePlot(holder, go));
  for (const cell of cells) cell.show();
}

function tellEvent(event) {
  byId("event").replaceChildren(event ? rich(`${frames.by_time ? `${placeText(event.at)}, θ = ` : ""}${tiltText(event.tilt, 2)}: ${event.what}`) : "");
}

/** Writes the data that a test requests with "#check=1" into the document. */
function writeCheck() {
  const places = Array.from({ length: frames.count }, (_, frame) => Array.from(centres(frame)));
  const check = { frames: frames.count, tilts: frames.tilts, centres: places, radii: Array.from(radii()),
    values: Object.fromEntries(data.fields.map((field) => [field.name, Array.from({ length: frames.count }, (_, frame) =>
      Array.from({ length: bed.free }, (_unused, grain) => fieldValue(field, grain, frame)))])),
    coordination: Array.from(coordinations(view.frame)), box: byId("bed").getBoundingClientRect(),
    screen: Array.from({ length: bed.free }, (_, grain) => project(centres(view.frame)[2 * grain], centres(view.frame)[2 * grain + 1])),
    scale: camera.scale };
  document.body.append(element("script", { type: "application/json", id: "check" }, JSON.stringify(check)));
}

async function start() {
  if (typeof DecompressionStream === "undefined")
    throw new Error("this browser is too old for the page: it needs Chromium 80, Firefox 113, Safari 16.4, or later");
  const state = readState();
  showDetails(goByHand);
  await readTables();
  makePlots(state);
  makeButtons();
  const named = (list, name) => list.find((entry) => entry.name === name);
  setMap(state.map === "none" ? null : named(data.maps, state.map) || named(data.maps, "clusters") || data.maps[0]);
  setLines(named(data.lines, state.lines) || null);
  line = timeLine(goByHand, tellEvent);
  play = player(() => {
    goTo((view.frame + 1) % frames.count);
    return view.frame + 1 < frames.count;
  });
  listenToMap({ hover: showHover, click: selectGrain });
  listenToKeys();
  setTurned(state.turned === "1");
  line.show();
  const asked = frameOfState(state);
  goTo(asked === null ? frameAtRepose() : asked);
  if (state.grain !== undefined) selectGrain(Number(state.grain));
  onWidth(byId("bed"), sizeMap);
  window.addEventListener("resize", sizeMap);
  matchMedia("print").addEventListener("change", sizeMap);
  requestAnimationFrame(() => {
    drawMap();
    if (state.check) writeCheck();
    document.documentElement.dataset.state = "ready";
  });
}

function tellProblem(error) {
  const problem = byId("problem");
  problem.hidden = false;
  problem.textContent = `The page cannot be shown: ${error.message || error}.`;
  document.documentElement.dataset.state = "failed";
}

// The page reloads if the user changes the address; addresses written by the page cause no event.
window.addEventListener("hashchange", () => location.reload());
window.addEventListener("error", (event) => tellProblem(event.error || event.message));
window.addEventListener("unhandledrejection", (event) => tellProblem(event.reason));
start().catch(tellProblem);
