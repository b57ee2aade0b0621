// Legend of the map, its scale, and the direction of gravity.

function barElement(bar, ramp) {
  const stops = [];
  for (let k = 0; k < 256; k += 15) stops.push(`#${ramp.fills.slice(6 * k, 6 * k + 6)}`);
  const colours = element("div", { class: "colours" });
  colours.style.backgroundImage = `linear-gradient(to right, ${stops.join(", ")})`;
  const ticks = element("div", { class: "ticks" });
  bar.ticks.forEach((tick, k) => {
    const label = element("span", {}, rich(tick.label));
    label.style.left = `${100 * tick.share}%`;
    if (k === 0 && tick.share < 0.05) label.className = "first";
    if (k === bar.ticks.length - 1 && tick.share > 0.95) label.className = "last";
    ticks.append(label);
  });
  return element("div", { class: "bar" }, element("span", { class: "name" }, rich(bar.title)), element("div", {}, colours, ticks));
}

function swatchElement(swatch) {
  const svg = shape("svg", { viewBox: "0 0 20 20", width: 16, height: 16, "aria-hidden": "true" });
  if (swatch.kind === "disc")
    svg.append(shape("circle", { cx: 10, cy: 10, r: 8.4, fill: swatch.fill, stroke: swatch.rim, "stroke-width": 2.4 }));
  else
    svg.append(shape("line", { x1: 3, y1: 10, x2: 17, y2: 10, stroke: swatch.fill, "stroke-width": Math.max(1.5, 20 * swatch.width), "stroke-linecap": "round" }));
  return element("span", { class: "swatch" }, svg, element("span", {}, rich(swatch.label)));
}

/** Shows the legend of a map and of the lines over it; either may be null. */
function showLegend(map, lines, frame) {
  const legend = byId("legend"), parts = [];
  if (map) {
    const own = ofFrame(map.legends, frame);
    parts.push(...own.bars.map((bar) => barElement(bar, map.ramp)), ...own.swatches.map(swatchElement));
  }
  if (lines) parts.push(...linesLegend(lines, map).swatches.map(swatchElement));
  legend.replaceChildren(...parts);
}

/** Returns the title as in pictures: "Overloaded grains; force chains". */
function titleOf(map, lines, frame) {
  const titles = [map, lines].filter(Boolean).map((shown) => ofFrame(shown.titles, frame));
  if (titles.length === 0) return "Grains";
  return titles.length === 1 ? titles[0] : `${titles[0]}; ${titles[1].charAt(0).toLowerCase()}${titles[1].slice(1)}`;
}

/** Shows a scale bar with a round number of diameters, and an arrow along gravity in the turned picture. */
function showScale(frame) {
  const svg = byId("scale"), arrow = 26, most = 110;
  const diameters = [100, 50, 20, 10, 5, 2, 1, 0.5].find((count) => count * camera.scale <= most) || 0.5;
  const width = diameters * camera.scale, height = 34;
  const fall = (frames.tilts[frame] * Math.PI) / 180 - camera.turn;
  const x = width + 34, y = height / 2, reach = arrow / 2 - 1;
  const tipX = x + reach * Math.sin(fall), tipY = y + reach * Math.cos(fall);
  const head = [-0.5, 0.5].map((side) => {
    const hx = tipX - 8 * (Math.sin(fall) - side * Math.cos(fall)), hy = tipY - 8 * (Math.cos(fall) + side * Math.sin(fall));
    return `M${hx.toFixed(2)} ${hy.toFixed(2)}L${tipX.toFixed(2)} ${tipY.toFixed(2)}`;
  });
  furnish(svg, { width: width + 68, height, viewBox: `0 0 ${width + 68} ${height}` });
  svg.replaceChildren(
    shape("path", { class: "ink", d: `M1 19v8M1 23H${width}M${width} 19v8` }),
    shape("text", { x: width / 2, y: 14, "text-anchor": "middle" }, `${diameters} D`),
    shape("path", { class: "ink", d: `M${x - reach * Math.sin(fall)} ${y - reach * Math.cos(fall)}L${tipX} ${tipY}${head.join("")}` }),
    shape("text", { x: x + 20, y: y + 5, class: "symbol" }, "g"));
}
