// The map: drawing of the bed, and its mouse controls.

const view = {
  frame: 0, map: null, lines: null, turned: false, grain: -1, hovered: -1,
  width: 0, height: 0, ratio: 1, fitted: 1, whole: true, content: "", drawn: "", waiting: false,
};

const turnOf = (frame) => (view.turned ? (Math.max(0, frames.tilts[frame]) * Math.PI) / 180 : 0);

/** Sets the size of the map. Its height follows from the bed, to avoid empty space. */
function sizeMap() {
  const holder = byId("bed"), width = holder.clientWidth;
  if (width === 0) return;
  const box = boxAt(view.turned ? (Math.max(0, ...frames.tilts) * Math.PI) / 180 : 0);
  const natural = (width * (box.high - box.low)) / (box.right - box.left);
  const height = Math.round(Math.min(Math.max(natural, 110), Math.max(260, 0.62 * window.innerHeight)));
  holder.style.height = `${height}px`;
  Object.assign(view, { width, height, ratio: window.devicePixelRatio || 1, drawn: "" });
  for (const canvas of [byId("discs"), byId("marks")])
    Object.assign(canvas, { width: Math.round(width * view.ratio), height: Math.round(height * view.ratio) });
  const before = { ...camera };
  fitCamera(width, height, turnOf(view.frame));
  view.fitted = camera.scale;
  if (!view.whole) Object.assign(camera, before);
  redraw();
}

function fitMap() {
  view.whole = true;
  sizeMap();
}

function drawMarks() {
  const pen = byId("marks").getContext("2d");
  pen.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  pen.clearRect(0, 0, view.width, view.height);
  drawEdges(pen);
  drawRing(pen, view.hovered, 1.5);
  drawRing(pen, view.grain, 3);
}

/** Draws walls and a smooth floor as lines, and the edges of a period as dashes. */
function drawEdges(pen) {
  const line = (x0, y0, x1, y1) => {
    pen.beginPath();
    pen.moveTo(...project(x0, y0));
    pen.lineTo(...project(x1, y1));
    pen.stroke();
  };
  pen.lineWidth = bed.periodic ? 1 : 2;
  pen.strokeStyle = bed.periodic ? "rgba(60, 70, 80, 0.45)" : "#000";
  pen.setLineDash(bed.periodic ? [3, 4] : []);
  for (const x of [0, bed.length]) line(x, bed.low, x, bed.high);
  pen.setLineDash([]);
  pen.strokeStyle = "#000";
  pen.lineWidth = 2;
  if (bed.smooth_floor) line(0, 0, bed.length, 0);
}

/** Draws a ring in two tones, visible on every colour. */
function drawRing(pen, grain, width) {
  if (grain < 0) return;
  const places = centres(view.frame);
  for (const shift of shifts) {
    const [x, y] = project(places[2 * grain] + shift, places[2 * grain + 1]);
    const radius = Math.max(camera.scale * radii()[grain], 3);
    for (const [colour, more] of [["#fff", 2.5], ["#e8590c", 0]]) {
      pen.strokeStyle = colour;
      pen.lineWidth = width + more;
      pen.beginPath();
      pen.arc(x, y, radius + width / 2, 0, 2 * Math.PI);
      pen.stroke();
    }
  }
}

/** Draws what has changed: grains and lines, or only the marks over them if the mouse points at another grain. */
function drawMap() {
  const { frame, map, lines } = view, content = `${frame} ${map && map.name} ${lines && lines.name}`;
  const drawn = `${content} ${Object.values(camera)}`;
  if (content !== view.content) {
    const title = titleOf(map, lines, frame);
    Object.assign(view, { content, looks: looksOf(map, frame), shownLines: linesOf(lines, map, frame) });
    byId("map-title").replaceChildren(rich(title));
    byId("map-caption").replaceChildren(rich(captionOf(frame)));
    byId("bed").setAttribute("aria-label", plainText(`${title}, ${captionOf(frame)}`));
    showLegend(map, lines, frame);
  }
  if (drawn !== view.drawn) {
    view.drawn = drawn;
    drawBed(byId("discs"), frame, view.looks, view.shownLines, view.ratio);
    showScale(frame);
  }
  drawMarks();
}

function redraw() {
  if (view.waiting) return;
  view.waiting = true;
  requestAnimationFrame(() => {
    view.waiting = false;
    drawMap();
  });
}

/** Returns the free grain at a point of the picture; -1 if there is none. */
function grainAt(px, py) {
  let [x, y] = unproject(px, py);
  if (bed.periodic) x -= bed.length * Math.floor(x / bed.length);
  const places = centres(view.frame), sizes = radii(), reach = Math.max(1, 6 / camera.scale);
  let found = -1, nearest = reach;
  for (let i = 0; i < bed.free; ++i) {
    let dx = Math.abs(places[2 * i] - x);
    if (bed.periodic) dx = Math.min(dx, bed.length - dx);
    const distance = Math.hypot(dx, places[2 * i + 1] - y) / Math.max(sizes[i], 4 / camera.scale);
    if (distance <= 1 && distance < nearest) {
      nearest = distance;
      found = i;
    }
  }
  return found;
}

/** Listens to mouse, touch and wheel. `use` has the handlers hover (grain or -1, event) and click (grain). */
function listenToMap(use) {
  const holder = byId("bed"), pointers = new Map();
  let moved = 0;
  const place = (event) => {
    const box = holder.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  holder.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.whole = false;
    const lines = event.deltaMode === 1 ? 16 : 1;
    zoomCamera(Math.exp(-0.0016 * lines * event.deltaY), ...place(event), view.fitted);
    redraw();
  }, { passive: false });
  holder.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pointers.set(event.pointerId, place(event));
    moved = 0;
    holder.setPointerCapture(event.pointerId);
  });
  holder.addEventListener("pointermove", (event) => {
    const at = place(event), before = pointers.get(event.pointerId);
    if (!before) return use.hover(grainAt(...at), event);
    moved += Math.hypot(at[0] - before[0], at[1] - before[1]);
    if (moved < 4) return;
    const other = [...pointers].find(([id]) => id !== event.pointerId);
    if (other) pinch(before, at, other[1]);
    else moveCamera(at[0] - before[0], at[1] - before[1]);
    pointers.set(event.pointerId, at);
    view.whole = false;
    use.hover(-1, event);
    redraw();
  });
  const end = (event) => {
    if (pointers.delete(event.pointerId) && event.type === "pointerup" && moved < 4) use.click(grainAt(...place(event)));
  };
  holder.addEventListener("pointerup", end);
  holder.addEventListener("pointercancel", end);
  holder.addEventListener("pointerleave", (event) => use.hover(-1, event));
  holder.addEventListener("dblclick", fitMap);
}

/** Zooms and moves while one finger goes from `before` to `at` and the other stays. */
function pinch(before, at, still) {
  const factor = Math.hypot(at[0] - still[0], at[1] - still[1]) / Math.max(1, Math.hypot(before[0] - still[0], before[1] - still[1]));
  zoomCamera(factor, (at[0] + still[0]) / 2, (at[1] + still[1]) / 2, view.fitted);
  moveCamera((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
}
