// Sections below the plots: events, definitions, scenario, origin of the run, and keys.

const table = (heads, rows) =>
  element("table", {}, element("thead", {}, element("tr", {}, ...heads.map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, ...rows.map((cells) => element("tr", {}, ...cells.map((cell) => element("td", {}, cell))))));

const keyHelp = [
  ["space", "play, pause"],
  ["→ ←", "next, previous frame; with shift by ten"],
  ["home, end", "first, last frame"],
  ["1 … 9", "maps in the order of their buttons"],
  ["o", "lines over the map: none, forces, critical contacts"],
  ["t", "turn the bed to its slope"],
  ["wheel, + −", "zoom"],
  ["drag", "move the picture"],
  ["f, double click", "whole bed"],
  ["click", "select a grain; n selects the next one, Escape none"],
];

function showDetails(go) {
  byId("title").textContent = data.title;
  byId("sentence").replaceChildren(rich(data.sentence));
  byId("scenario").textContent = data.scenario;
  const events = data.events.map((event) => [
    element("button", { type: "button", class: "plain", onclick: () => go(Math.round(event.place)) }, event.at.toFixed(2) + axis.unit),
    ...(frames.by_time ? [tiltText(event.tilt, 2)] : []), rich(event.label || "–"), rich(event.what)]);
  byId("events").append(events.length > 0 ? table([axis.symbol, ...(frames.by_time ? ["θ"] : []), "", "event"], events) : element("p", {}, "No events are known for this run."));
  byId("definitions").append(
    element("p", {}, "Lengths are in mean diameters D, angles in degrees; g is gravity, ρ the density of the grains. Stresses are positive in compression. " +
      "The paper is Staron, Vilotte and Radjai, Multiscale Analysis of the Stress State in a Granular Slope in Transition to Failure."),
    table(["quantity", "meaning"], data.curves.quantities.map((quantity) => [
      quantity.common ? rich(quantity.title) : quantity.title, quantity.definition])));
  byId("provenance").append(table(["", ""], [["run", data.name], ...data.provenance]),
    element("p", {},
      "Positions are stored with 16 bits, other values to better than one shade of their map, forces above a quarter of their mean to 2 %."));
  byId("keys").append(table(["", ""], keyHelp));
  byId("foot").append(`${data.name}: frames ${frames.numbers[0]} to ${frames.numbers[frames.count - 1]} of the run, ${frames.count} on this page.`);
}
