// Values of a grain: next to the mouse, and on the card of the selected grain.

/** Formats a value with its unit; a count (digits: 0) is a whole number. */
function valueText({ value, digits, unit }) {
  if (!Number.isFinite(value)) return "–";
  return (digits === 0 ? String(value) : numberText(value, digits)) + (unit ? `\u00a0${unit}` : "");
}

function valueRows(grain, frame) {
  const radius = radii()[grain], places = centres(frame);
  const known = [{ label: "diameter", value: 2 * radius, digits: 3, unit: "D" },
                 { label: "position x, y", text: `${numberText(places[2 * grain], 4)}, ${numberText(places[2 * grain + 1], 3)}\u00a0D` },
                 ...grainValues(grain, frame)];
  return known.map((row) => element("div", {}, element("dt", {}, rich(row.label)), element("dd", {}, row.text || valueText(row))));
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

/** Returns the history of a grain over all frames of the page. */
function grainHistory(name, grain) {
  if (name === "coordination" || name === "cluster") {
    const of = name === "cluster" ? clusterSize : (g, frame) => coordinations(frame)[g];
    return frames.tilts.map((_, frame) => of(grain, frame));
  }
  const field = fieldOf(name);
  return frames.tilts.map((_, frame) => fieldValue(field, grain, frame));
}

/** Returns the fields that a history can show. */
function historyChoices() {
  return [...data.fields.filter((field) => field.name !== "cluster"), ...(fieldOf("cluster") ? [{ name: "cluster", label: "grains in its cluster", unit: "" }] : []),
          { name: "coordination", label: "contacts", unit: "" }];
}

/** Creates the card of the selected grain, with a plot of its history made by `makePlot`. */
function grainCard(makePlot) {
  const card = byId("grain"), list = element("dl", { class: "values" });
  const heading = element("h2", {}, "Grain");
  const clear = element("button", { type: "button", class: "plain", title: "Clear the selection (Escape)", onclick: () => selectGrain(-1) }, "none");
  const hint = element("p", { class: "hint" }, "Point at a grain on the map to read its values; click it to keep them here, with their history over the tilt.");
  const title = element("span", { class: "title" });
  const choice = element("select", { "aria-label": "Quantity of the grain" });
  const titleOfField = (field) => field.label + (field.unit ? ` in ${field.unit}` : "");
  for (const field of historyChoices()) choice.append(element("option", { value: field.name }, titleOfField(field)));
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
    if (!chosen) return;
    list.replaceChildren(...valueRows(view.grain, view.frame));
  };
  const showHistory = () => {
    if (view.grain < 0) return;
    const tilts = frames.tilts.slice(0, frames.of_tilt);
    title.replaceChildren(rich(titleOfField(historyChoices().find((field) => field.name === choice.value))));
    plot.describe(`Grain ${view.grain}, ${choice.value}, over the tilt`);
    plot.set({ curves: [{ label: "", x: tilts, y: grainHistory(choice.value, view.grain).slice(0, frames.of_tilt), points: true }] });
  };
  choice.addEventListener("change", showHistory);
  return { show, showHistory, plot };
}
