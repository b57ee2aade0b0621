// Curves over the tilt or over time, in SVG.

const plotHeight = 150, plotLeft = 46, plotRight = 10, plotTop = 8, plotBottom = 22;

function extentOf(lists) {
  let low = Infinity, high = -Infinity;
  for (const list of lists)
    for (const value of list)
      if (Number.isFinite(value)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
  if (low > high) return [0, 1];
  if (low === high) return [low - (Math.abs(low) * 0.1 || 0.5), high + (Math.abs(high) * 0.1 || 0.5)];
  return [low, high];
}

/** Returns the path of a curve, interrupted at missing values. */
function curvePath(curve, toX, toY) {
  let path = "", pen = "M";
  for (let k = 0; k < curve.x.length; ++k) {
    const y = curve.y[k];
    if (Number.isFinite(y)) path += `${pen}${toX(curve.x[k]).toFixed(1)} ${toY(y).toFixed(1)}`;
    pen = Number.isFinite(y) ? "L" : "M";
  }
  return path;
}

/** Returns the value of a curve at the place nearest to x. */
function valueNear(curve, x) {
  let best = 0;
  for (let k = 1; k < curve.x.length; ++k) if (Math.abs(curve.x[k] - x) < Math.abs(curve.x[best] - x)) best = k;
  return curve.y[best];
}

/**
 * Creates a plot in a holder; `go` is called with the place on the axis that was clicked. The result has `set` for curves
 * { label, x, y, points }, and `cursor` for a place.
 */
function curvePlot(holder, go) {
  const svg = shape("svg", { role: "img", height: plotHeight });
  const reading = element("div", { class: "reading" });
  holder.replaceChildren(svg, reading);
  let curves = [], place = 0, pointed = null, range = null, line = null;

  const draw = () => {
    const width = holder.clientWidth;
    if (width === 0) return;
    const [xLow, xHigh] = extentOf([data.curves.frames, data.curves.rows, frames.places]);
    const [low, high] = extentOf(curves.map((curve) => curve.y));
    const { step } = roundTicks(low, high, 4);
    const bottom = Math.min(low, step * Math.floor(low / step + 1e-9)), top = Math.max(high, step * Math.ceil(high / step - 1e-9));
    const toX = (x) => plotLeft + ((width - plotLeft - plotRight) * (x - xLow)) / (xHigh - xLow);
    const toY = (y) => plotTop + ((plotHeight - plotTop - plotBottom) * (top - y)) / (top - bottom);
    range = { toX, back: (px) => xLow + ((px - plotLeft) * (xHigh - xLow)) / (width - plotLeft - plotRight), xLow, xHigh };
    furnish(svg, { width, viewBox: `0 0 ${width} ${plotHeight}` });
    const parts = [];
    for (const tick of roundTicks(bottom, top, 4).ticks)
      parts.push(shape("path", { class: "grid", d: `M${plotLeft} ${toY(tick.value).toFixed(1)}H${width - plotRight}` }),
                 shape("text", { x: plotLeft - 6, y: toY(tick.value) + 4, "text-anchor": "end" }, tick.label));
    for (const tick of roundTicks(xLow, xHigh, Math.max(2, Math.floor(width / 60))).ticks)
      parts.push(shape("text", { x: toX(tick.value), y: plotHeight - 6, "text-anchor": "middle" }, tick.label + axis.unit));
    if (failure !== null)
      parts.push(shape("path", { class: "failure", d: `M${toX(failure)} ${plotTop}V${plotHeight - plotBottom}` }));
    curves.forEach((curve, k) => {
      parts.push(shape("path", { class: `curve curve-${k}`, d: curvePath(curve, toX, toY) }));
      if (curve.points)
        curve.y.forEach((y, at) => Number.isFinite(y) && parts.push(shape("circle", { class: `dot curve-${k}`, cx: toX(curve.x[at]), cy: toY(y), r: 1.6 })));
    });
    line = shape("path", { class: "cursor" });
    svg.replaceChildren(...parts, line);
    moveLine();
  };
  const moveLine = () => {
    if (!line || !range) return;
    line.setAttribute("d", `M${range.toX(place).toFixed(1)} ${plotTop}V${plotHeight - plotBottom}`);
    report();
  };
  const report = () => {
    const at = pointed === null ? place : pointed;
    const values = curves.map((curve, k) => element("span", { class: `curve-${k}` }, rich(`${curve.label ? `${curve.label} ` : ""}${numberText(valueNear(curve, at), 4)}`)));
    reading.replaceChildren(element("span", {}, placeText(at)), ...values);
  };
  const clamped = (event) => Math.min(Math.max(range.back(event.clientX - svg.getBoundingClientRect().left), range.xLow), range.xHigh);
  const point = (next) => { pointed = next; report(); };
  svg.addEventListener("pointermove", (event) => point(range && clamped(event)));
  svg.addEventListener("pointerleave", () => point(null));
  svg.addEventListener("click", (event) => range && go(clamped(event)));
  onWidth(holder, draw);
  return {
    set: (next) => { curves = next; draw(); },
    cursor: (next) => { place = next; moveLine(); },
    describe: (text) => svg.setAttribute("aria-label", text),
  };
}

/** Creates a title over its list of choices; a title can have subscripts, list entries cannot. */
const chooser = (title, choice) => element("div", { class: "head chooser" }, title, element("span", { class: "arrow", "aria-hidden": "true" }, "▾"), choice);

/** Creates a cell with a plot of any quantity of the table. */
function quantityCell(name, go, onChange) {
  const title = element("span", { class: "title" });
  const choice = element("select", { "aria-label": "Quantity of the plot" });
  for (const [label, common] of [["Curves", true], ["All quantities of a frame", false]]) {
    const group = element("optgroup", { label });
    for (const quantity of data.curves.quantities)
      if (quantity.common === common) group.append(element("option", { value: quantity.name }, quantity.title));
    if (group.children.length > 0) choice.append(group);
  }
  choice.value = name;
  const holder = element("div", { class: "plot" });
  const plot = curvePlot(holder, go);
  const show = () => {
    const quantity = data.curves.quantities.find((known) => known.name === choice.value);
    choice.title = quantity.definition;
    title.replaceChildren(quantity.common ? rich(quantity.title) : quantity.title);
    plot.describe(`${quantity.title} over ${axis.name}`);
    plot.set(quantity.curves.map(({ label, over, values }) => ({ label, x: data.curves[over], y: values, points: over === "frames" })));
  };
  choice.addEventListener("change", () => { show(); onChange(); });
  const cell = element("article", { class: "cell" }, chooser(title, choice), holder);
  return { cell, plot, show, name: () => choice.value };
}
