// Values of a grain: next to the mouse, and on the card of the selected grain.

/** Formats a value with its unit; a count (digits: 0) is a whole number. */
function valueText(value, { digits, unit }) {
  if (!Number.isFinite(value)) return "–";
  return (digits === 0 ? String(value) : numberText(value, digits)) + (unit ? `\u00a0${unit}` : "");
}

/** Motion in a flow, in which the tilt does not grow, is not per degree. */
const unitIn = (quantity, frame) => (frame < frames.of_tilt ? quantity : { ...quantity, unit: quantity.unit.replace(" per degree", "") });

function valueRows(grain, frame) {
  const places = centres(frame);
  const known = [["diameter", valueText(2 * radii()[grain], { digits: 3, unit: "D" })],
                 ["position x, y", `${numberText(places[2 * grain], 4)}, ${numberText(places[2 * grain + 1], 3)}\u00a0D`],
                 ...grainQuantities.map((quantity) => [quantity.label, valueText(quantity.of(grain, frame), unitIn(quantity, frame))])];
  return known.map(([label, text]) => element("div", {}, element("dt", {}, rich(label)), element("dd", {}, text)));
}

/** Shows the values of the grain under the mouse next to it. */
function showHover(grain, event) {
  const tip = byId("hover");
  if (view.hovered !== grain) {
    view.hovered = grain;
    redraw();
  }
  tip.hidden = grain < 0 || event.pointerType === "touch";
  if (tip.hidden) return;
  tip.replaceChildren(element("strong", {}, `Grain ${grain}`), element("dl", {}, ...valueRows(grain, view.frame)));
  const width = tip.offsetWidth, height = tip.offsetHeight;
  const left = event.clientX + 18 + width < document.documentElement.clientWidth ? event.clientX + 18 : event.clientX - width - 14;
  const top = Math.min(event.clientY + 14, window.innerHeight - height - 8);
  tip.style.left = `${Math.max(4, left)}px`;
  tip.style.top = `${Math.max(4, top)}px`;
}

/** Creates the card of the selected grain, with a plot of its history made by `makePlot`. */
function grainCard(makePlot) {
  const card = byId("grain"), list = element("dl", { class: "values" });
  const heading = element("h2", {}, "Grain");
  const clear = element("button", { type: "button", class: "plain", title: "Clear the selection (Escape)", onclick: () => selectGrain(-1) }, "none");
  const hint = element("p", { class: "hint" }, "Point at a grain on the map to read its values; click it to keep them here, with their history.");
  const title = element("span", { class: "title" });
  const choice = element("select", { "aria-label": "Quantity of the grain" });
  for (const { name, title: text } of grainQuantities) choice.append(element("option", { value: name }, text));
  const holder = element("div", { class: "plot" });
  const plot = makePlot(holder);
  const history = element("div", {}, chooser(title, choice), holder);
  const sides = element("div", { class: "sides" },
    element("div", {}, element("div", { class: "head" }, heading, clear), hint, list), history);
  card.replaceChildren(sides);

  const show = () => {
    const chosen = view.grain >= 0;
    heading.textContent = chosen ? `Grain ${view.grain}` : "Grain";
    hint.hidden = chosen;
    for (const part of [clear, list, history]) part.hidden = !chosen;
    sides.classList.toggle("alone", !chosen);
    if (chosen) list.replaceChildren(...valueRows(view.grain, view.frame));
  };
  const showHistory = () => {
    if (view.grain < 0) return;
    const quantity = grainQuantities.find(({ name }) => name === choice.value), x = frames.places.slice(0, frames.of_tilt);
    title.replaceChildren(rich(quantity.title));
    plot.describe(`Grain ${view.grain}, ${choice.value}, over ${axis.name}`);
    plot.set([{ label: "", x, y: x.map((_, frame) => quantity.of(view.grain, frame)), points: true }]);
  };
  choice.addEventListener("change", showHistory);
  return { show, showHistory, plot };
}
