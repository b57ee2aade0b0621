// Texts and elements.

const byId = (id) => document.getElementById(id);

/** Creates an element with attributes ("on..." are listeners) and children: nodes or plain texts. */
const element = (tag, attributes = {}, ...children) => furnish(document.createElement(tag), attributes, children);

/** Creates an SVG element in the same way. */
const shape = (tag, attributes = {}, ...children) => furnish(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);

function furnish(made, attributes, children = []) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children);
  return made;
}

/** Returns the nodes of a rich text, in which "_c" sets c as a subscript. */
function rich(text) {
  const parts = document.createDocumentFragment();
  text.split(/_(.)/u).forEach((part, k) => parts.append(k % 2 === 0 ? part : element("sub", {}, part)));
  return parts;
}

/** Returns a rich text as one SVG text. */
function richShape(text, attributes) {
  const made = shape("text", attributes);
  for (const part of rich(text).childNodes)
    if (part.nodeType === Node.TEXT_NODE) made.append(part.cloneNode());
    else
      made.append(shape("tspan", { dy: "0.22em", "font-size": "78%" }, part.textContent),
                  shape("tspan", { dy: "-0.17em" }, "\u200b"));
  return made;
}

/** Returns the plain text of a rich one: "θc" for "θ_c". */
const plainText = (text) => text.replace(/_(.)/gu, "$1");

/** Calls `use` when the width of an element has changed; in the next picture, because the callback must not change sizes. */
function onWidth(of, use) {
  let width = of.clientWidth;
  new ResizeObserver(() => requestAnimationFrame(() => {
    if (of.clientWidth === width) return;
    width = of.clientWidth;
    use();
  })).observe(of);
}

/** Formats a number with `digits` significant digits; a dash for none. */
function numberText(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = size >= 1e5 || size < 1e-4 ? powerText(size, digits) : size.toFixed(Math.min(decimals, 12));
  return (value < 0 ? "−" : "") + text;
}

const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function powerText(size, digits) {
  const [factor, power] = size.toExponential(Math.max(0, digits - 1)).split("e");
  const raised = Array.from(String(Math.abs(power)), (digit) => superscripts[digit]).join("");
  return `${factor}·10${power < 0 ? "⁻" : ""}${raised}`;
}

/** Returns round numbers from low to high, in at most `most` steps, with the same number of decimals. */
function roundTicks(low, high, most) {
  const decade = 10 ** Math.floor(Math.log10((high - low) / most));
  const step = [1, 2, 5, 10].map((f) => f * decade).find((s) => (high - low) <= s * most * (1 + 1e-9));
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-6); k <= Math.floor(high / step + 1e-6); ++k)
    ticks.push({ value: k * step, label: (k < 0 ? "−" : "") + Math.abs(k * step).toFixed(decimals) });
  return { ticks, step };
}
