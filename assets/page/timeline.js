// The time line: a place for each frame, and a mark for each event.

const lineLeft = 14, lineRight = 14, lineY = 58, lineHeight = 84;

/**
 * Creates the time line. Calls `go` with a frame, and `report` with an event or null. The result has `show`, which
 * redraws it, and `move`, which moves its handle.
 */
function timeLine(go, report) {
  const svg = byId("timeline");
  let width = 0, handle = null, passed = null;
  const last = Math.max(1, frames.count - 1);
  const toX = (place) => lineLeft + ((width - lineLeft - lineRight) * place) / last;

  /** Creates a bar on the line whose height shows the size of the rearrangement. */
  const rearrangementMark = (event, x) => {
    const mark = shape("g", { class: `event ${event.kind}` },
      shape("path", { class: "bar", d: `M${x} ${lineY - 3}v${-3 - 9 * event.size}` }),
      shape("rect", { x: x - 3, y: lineY - 16, width: 6, height: 16, fill: "transparent" }));
    mark.addEventListener("pointerenter", () => report(event));
    mark.addEventListener("pointerleave", () => report(null));
    return mark;
  };
  /** Creates the marks, with labels in rows so that neighbours do not overlap. */
  const eventMarks = () => {
    const ends = [-Infinity, -Infinity, -Infinity];
    return data.events.map((event) => {
      const x = toX(event.place);
      if (event.kind === "rearrangement") return rearrangementMark(event, x);
      const half = 4 + 3.6 * plainText(event.label).length;
      const row = event.label ? ends.findIndex((end) => x - half > end) : -1;
      if (row >= 0) ends[row] = x + half;
      const mark = shape("g", { class: `event ${event.kind}` },
        shape("path", { class: "stem", d: `M${x} ${row >= 0 ? lineY - 20 - 13 * row + 4 : lineY - 12}V${lineY - 3}` }),
        shape("circle", { cx: x, cy: lineY, r: 3.5 }),
        shape("rect", { x: x - half, y: 0, width: 2 * half, height: lineY, fill: "transparent" }));
      if (row >= 0) mark.append(richShape(event.label, { x, y: lineY - 20 - 13 * row, "text-anchor": "middle" }));
      mark.addEventListener("pointerenter", () => report(event));
      mark.addEventListener("pointerleave", () => report(null));
      return mark;
    });
  };
  /** Creates labels at round angles of the tilt, as many as fit, and at the beginning of the flow. */
  const labels = () => {
    const parts = [], tilts = frames.tilts.slice(0, frames.of_tilt);
    for (let k = 0; k < frames.count; ++k) parts.push(shape("path", { class: "tick", d: `M${toX(k).toFixed(1)} ${lineY - 3}v6` }));
    if (tilts.length > 1 && tilts[tilts.length - 1] > tilts[0]) {
      const room = (toX(tilts.length - 1) - toX(0)) / 42;
      for (const tick of roundTicks(tilts[0], tilts[tilts.length - 1], Math.max(1, room)).ticks) {
        const after = Math.max(1, tilts.findIndex((tilt) => tilt >= tick.value - 1e-6));
        const place = after - 1 + (tick.value - tilts[after - 1]) / (tilts[after] - tilts[after - 1]);
        parts.push(shape("text", { x: toX(Math.max(0, place)), y: lineY + 21, "text-anchor": "middle" }, `${tick.label}°`));
      }
    }
    if (frames.of_tilt > 0 && frames.of_tilt < frames.count)
      parts.push(shape("text", { x: toX(frames.of_tilt), y: lineY + 21 }, "flow"));
    return parts;
  };
  const show = () => {
    width = svg.clientWidth;
    if (width === 0) return;
    svg.setAttribute("viewBox", `0 0 ${width} ${lineHeight}`);
    handle = shape("g", { class: "handle" }, shape("circle", { r: 7.5 }));
    passed = shape("path", { class: "passed" });
    svg.replaceChildren(shape("path", { class: "line", d: `M${toX(0)} ${lineY}H${toX(last)}` }), passed, ...labels(), ...eventMarks(), handle);
    move(view.frame);
  };
  const move = (frame) => {
    if (!handle) return;
    handle.setAttribute("transform", `translate(${toX(frame)} ${lineY})`);
    passed.setAttribute("d", `M${toX(0)} ${lineY}H${toX(frame)}`);
    svg.setAttribute("aria-valuemin", 0);
    svg.setAttribute("aria-valuemax", frames.count - 1);
    svg.setAttribute("aria-valuenow", frame);
    svg.setAttribute("aria-valuetext", plainText(frames.captions[frame]));
  };

  let held = false;
  const frameAt = (event) => {
    const x = event.clientX - svg.getBoundingClientRect().left;
    return Math.min(frames.count - 1, Math.max(0, Math.round(((x - lineLeft) * last) / (width - lineLeft - lineRight))));
  };
  svg.addEventListener("pointerdown", (event) => {
    held = true;
    svg.setPointerCapture(event.pointerId);
    go(frameAt(event));
  });
  svg.addEventListener("pointermove", (event) => held && go(frameAt(event)));
  for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, () => { held = false; });
  onWidth(svg, show);
  return { show, move };
}

/** Plays frames at a chosen speed; `step` advances by one frame and returns whether another follows. */
function player(step) {
  const button = byId("play");
  let timer = null;
  const icon = () => {
    const path = timer ? "M7 5h3.4v14H7zM13.6 5H17v14h-3.4z" : "M8 5l11 7-11 7z";
    button.replaceChildren(shape("svg", { viewBox: "0 0 24 24", width: 22, height: 22, "aria-hidden": "true" }, shape("path", { d: path })));
    button.setAttribute("aria-label", timer ? "Pause" : "Play");
  };
  const pause = () => {
    clearTimeout(timer);
    timer = null;
    icon();
  };
  const next = () => {
    timer = setTimeout(() => (step() ? next() : pause()), 1000 / Number(byId("speed").value));
  };
  const toggle = () => {
    if (timer) return pause();
    next();
    icon();
  };
  button.addEventListener("click", toggle);
  icon();
  return { toggle, pause };
}
