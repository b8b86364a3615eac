// The curves of a cycle: the quantities asked for over the driver's position, with a moving cursor.
import { significant, written } from "./numbers.js";
import { byId, data, motion, rest, rows, span, state } from "./player.js";

const WIDE = 320,
  HIGH = 160,
  LEFT = 44,
  RIGHT = 16,
  TOP = 8,
  FOOT = 22; // size of a chart, and the margins around its curves
const SAMPLES = 360,
  MOST = 0.97,
  ROOM = 1.12; // number of positions, share of them that a chart must show, and headroom
const drawn = []; // for each chart its picture, rows, scales and cursor

/** Draw a chart for each unit. */
export function charts() {
  const places = Array.from({ length: SAMPLES + 1 }, (_, i) => data.low + (span * i) / SAMPLES);
  const values = places.map(x => motion.values(x));
  const units = Map.groupBy ? Map.groupBy(rows, row => row.dataset.unit) : grouped(rows);
  const section = byId("curves");
  section.hidden = false;
  for (const [unit, some] of units) {
    const series = some.map(row => values.map(found => found[row.dataset.row]));
    if (series.flat().some(value => value !== undefined))
      section.append(chart(unit, some, series, places));
  }
}

/** The rows grouped by unit. */
function grouped(all) {
  const found = new Map();
  for (const row of all) found.set(row.dataset.unit, [...(found.get(row.dataset.unit) ?? []), row]);
  return found;
}

/** A chart under the names of its rows. */
function chart(unit, some, series, places) {
  const figure = document.createElement("figure"),
    caption = document.createElement("figcaption");
  some.forEach((row, i) => {
    const one = document.createElement("span");
    one.className = `c${i % 4}`;
    one.append(...row.querySelector("dt").cloneNode(true).childNodes);
    caption.append(one, " ");
  });
  const wording = document.createElement("span");
  wording.innerHTML = some[0].querySelector(".unit").innerHTML;
  caption.append(wording);
  const [low, high] = bounds(series.flat().filter(Number.isFinite));
  const u = x => LEFT + ((x - data.low) / span) * (WIDE - LEFT - RIGHT);
  const v = y => HIGH - FOOT - ((y - low) / (high - low)) * (HIGH - TOP - FOOT);
  const svg = make("svg", {
    viewBox: `0 0 ${WIDE} ${HIGH}`,
    role: "slider",
    tabindex: 0,
    "aria-label": `${caption.textContent}, ${byId("curves").dataset.name}`,
    "aria-valuemin": data.low,
    "aria-valuemax": data.high,
  });
  for (const x of steps(data.low, data.high, 7, data.degrees))
    tick(svg, "across", u(x), written(x, places_of(span)) + (data.degrees ? "°" : ""));
  for (const y of steps(low, high, 5))
    tick(svg, y === 0 ? "level zero" : "level", v(y), significant(y, 3).replace(/[.,]0+$/, ""));
  const inner = make("svg", {
    x: LEFT,
    y: TOP,
    width: WIDE - LEFT - RIGHT,
    height: HIGH - TOP - FOOT,
    viewBox: `${LEFT} ${TOP} ${WIDE - LEFT - RIGHT} ${HIGH - TOP - FOOT}`,
  });
  series.forEach((values, i) =>
    inner.append(
      make("path", { class: `curve c${i % 4}`, d: curve(values, places, u, v, high - low) }),
    ),
  );
  const cursor = make("line", { class: "cursor", y1: TOP, y2: HIGH - FOOT });
  const dots = some.map((_, i) => make("circle", { class: `dot c${i % 4}`, r: 3 }));
  inner.append(cursor, ...dots);
  svg.append(inner);
  listen(svg);
  drawn.push({ svg, some, cursor, dots, u, v });
  figure.append(caption, svg);
  return figure;
}

/** The path of a curve, broken where a value is missing or jumps from one infinity to the other. */
function curve(values, places, u, v, size) {
  let pen = "M";
  return values
    .map((value, i) => {
      const leaps = i && Math.abs(value - values[i - 1]) > 2 * size;
      if (!Number.isFinite(value) || leaps) pen = "M";
      if (!Number.isFinite(value)) return "";
      const part = `${pen}${u(places[i]).toFixed(2)} ${v(value).toFixed(2)}`;
      pen = "L";
      return part;
    })
    .join("");
}

/** The range of a chart: it includes zero and leaves out only a few isolated peaks. */
function bounds(values) {
  const sizes = values.map(Math.abs).sort((a, b) => a - b),
    most = sizes.at(-1) || 1;
  const usual = sizes[Math.floor(MOST * (sizes.length - 1))] || most,
    end = most > 2 * usual ? 1.5 * usual : most;
  const below = Math.max(Math.min(0, ...values), -end),
    above = Math.min(Math.max(0, ...values), end);
  return [below * ROOM, above * ROOM || (below ? 0 : 1)];
}

/** Round numbers between two values; for angles, divisors of a turn. */
function steps(low, high, most, degrees = false) {
  const power = 10 ** Math.floor(Math.log10((high - low) / most));
  const sizes =
    degrees && high - low > 40
      ? [15, 30, 45, 60, 90, 180, 360]
      : [1, 2, 5, 10].map(size => size * power);
  const size = sizes.find(one => (high - low) / one <= most) ?? sizes.at(-1);
  const first = Math.ceil(low / size - 1e-9);
  return Array.from(
    { length: Math.floor(high / size + 1e-9) - first + 1 },
    (_, i) => (first + i) * size,
  );
}

/** The number of decimals that distinguishes positions of a range. */
function places_of(size) {
  return size > 10 ? 0 : size > 1 ? 1 : 2;
}

/** A line of the grid with its number. */
function tick(svg, look, at, wording) {
  const across = look === "across";
  const ends = across
    ? { x1: at, x2: at, y1: TOP, y2: HIGH - FOOT }
    : { x1: LEFT, x2: WIDE - RIGHT, y1: at, y2: at };
  const text = make(
    "text",
    across
      ? { x: at, y: HIGH - FOOT + 12, "text-anchor": "middle" }
      : { x: LEFT - 5, y: at + 3, "text-anchor": "end" },
  );
  text.textContent = wording;
  svg.append(make("line", { class: look, ...ends }), text);
}

/** An element of a picture. */
function make(tag, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

/** Move the driver where a chart is clicked or dragged. */
function listen(svg) {
  const lead = event => {
    const { left, width } = svg.getBoundingClientRect(),
      x = ((event.clientX - left) / width) * WIDE;
    rest(data.low + ((x - LEFT) / (WIDE - LEFT - RIGHT)) * span);
  };
  svg.addEventListener("pointerdown", event => {
    svg.setPointerCapture(event.pointerId);
    lead(event);
  });
  svg.addEventListener("pointermove", event => {
    if (svg.hasPointerCapture(event.pointerId)) lead(event);
  });
}

/** Set the cursors at the driver's position, and a dot on each curve. */
export function point(values, wording) {
  for (const { svg, some, cursor, dots, u, v } of drawn) {
    const x = u(state.x);
    cursor.setAttribute("x1", x);
    cursor.setAttribute("x2", x);
    svg.setAttribute("aria-valuenow", state.x);
    svg.setAttribute("aria-valuetext", wording);
    some.forEach((row, i) => {
      const value = values[row.dataset.row];
      dots[i].setAttribute("visibility", Number.isFinite(value) ? "visible" : "hidden");
      if (!Number.isFinite(value)) return;
      dots[i].setAttribute("cx", x);
      dots[i].setAttribute("cy", v(value));
    });
  }
}
