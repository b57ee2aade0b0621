// The time line: a place for each frame, and a mark for each event.

const lineLeft = 14, lineRight = 14, lineY = 58, lineHeight = frames.by_time ? 100 : 84;

/**
 * Creates the time line. Calls `go` with a frame, and `report` with an event or null. The result has `show`, which
 * redraws it, and `move`, which moves its handle.
 */
function timeLine(go, report) {
  const svg = byId("timeline");
  let width = 0, handle = null, passed = null;
  const last = Math.max(1, frames.count - 1);
  const toX = (place) => lineLeft + ((width - lineLeft - lineRight) * place) / last;

  const eventMark = (event, ...parts) =>
    shape("g", { class: `event ${event.kind}`, onpointerenter: () => report(event), onpointerleave: () => report(null) }, ...parts);
  /** Places labels of events in rows, that of failure first, so that none touches another one or its stem. */
  const placedLabels = () => {
    const placed = [], failureFirst = [...data.events].sort((a, b) => (b.kind === "failure") - (a.kind === "failure"));
    for (const event of failureFirst.filter(({ label }) => label)) {
      const half = 1 + 3.6 * plainText(event.label).length, stem = toX(event.place), x = Math.min(Math.max(stem, half), width - half);
      const row = [0, 1, 2].find((free) => placed.every((other) => (other.row === free ? Math.abs(other.x - x) > other.half + half
        : other.row > free ? Math.abs(other.stem - x) > half : Math.abs(stem - other.x) > other.half)));
      if (row !== undefined) placed.push({ event, half, stem, x, row, y: lineY - 20 - 13 * row });
    }
    return placed;
  };
  /** Creates the marks; a bar shows the size of a rearrangement. */
  const eventMarks = () => {
    const placed = placedLabels();
    return data.events.map((event) => {
      const x = toX(event.place), label = placed.find((each) => each.event === event);
      if (event.kind === "rearrangement")
        return eventMark(event, shape("path", { class: "bar", d: `M${x} ${lineY - 3}v${-3 - 9 * event.size}` }),
          shape("rect", { x: x - 3, y: lineY - 16, width: 6, height: 16, fill: "transparent" }));
      const half = label ? label.half : 4;
      const mark = eventMark(event,
        shape("path", { class: "stem", d: `M${x} ${label ? label.y + 4 : lineY - 12}V${lineY - 3}` }),
        shape("circle", { cx: x, cy: lineY, r: 3.5 }),
        shape("rect", { x: x - half, y: 0, width: 2 * half, height: lineY, fill: "transparent" }));
      if (label) mark.append(richShape(event.label, { x: label.x, y: label.y, "text-anchor": "middle" }));
      return mark;
    });
  };
  /** Creates labels at round places of the axis, as many as fit, with the tilt below a time; and at the beginning of the flow. */
  const labels = () => {
    const parts = [], places = frames.places.slice(0, frames.of_tilt), flows = frames.of_tilt > 0 && frames.of_tilt < frames.count;
    const label = (x, row, text) => parts.push(shape("text", { x, y: lineY + 21 + 16 * row, "text-anchor": "middle" }, text));
    for (let k = 0; k < frames.count; ++k) parts.push(shape("path", { class: "tick", d: `M${toX(k).toFixed(1)} ${lineY - 3}v6` }));
    const flowX = Math.min(toX(frames.of_tilt) + 14, width - lineRight), right = flows ? flowX - 18 : width;
    if (places.length > 1 && places[places.length - 1] > places[0]) {
      const room = (toX(places.length - 1) - toX(0)) / (frames.by_time ? 64 : 42);
      const { ticks, step } = roundTicks(places[0], places[places.length - 1], Math.max(1, room));
      let left = 0;
      for (const tick of ticks) {
        const after = Math.max(1, places.findIndex((place) => place >= tick.value - 1e-6 * step)), [from, to] = frames.tilts.slice(after - 1);
        const share = Math.max(0, (tick.value - places[after - 1]) / (places[after] - places[after - 1]));
        const text = tick.label + axis.unit, half = 3.6 * text.length, x = Math.min(Math.max(toX(after - 1 + share), half), width - half);
        if (x - half < left || x + half > right) continue;
        left = x + half + 6;
        label(x, 0, text);
        if (frames.by_time) label(x, 1, tiltText(from + share * (to - from), 1));
      }
    }
    if (flows) label(flowX, 0, "flow");
    return parts;
  };
  const show = () => {
    width = svg.clientWidth;
    if (width === 0) return;
    furnish(svg, { height: lineHeight, viewBox: `0 0 ${width} ${lineHeight}` });
    handle = shape("g", { class: "handle" }, shape("circle", { r: 7.5 }));
    passed = shape("path", { class: "passed" });
    svg.replaceChildren(shape("path", { class: "line", d: `M${toX(0)} ${lineY}H${toX(last)}` }), passed, ...labels(), ...eventMarks(), handle);
    move(view.frame);
  };
  const move = (frame) => {
    if (!handle) return;
    handle.setAttribute("transform", `translate(${toX(frame)} ${lineY})`);
    passed.setAttribute("d", `M${toX(0)} ${lineY}H${toX(frame)}`);
    furnish(svg, { "aria-valuemin": 0, "aria-valuemax": frames.count - 1, "aria-valuenow": frame, "aria-valuetext": plainText(captionOf(frame)) });
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
