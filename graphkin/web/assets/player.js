// The page of a cycle: it plays the motion, lets it be moved by hand, and shows the quantities
// asked for at each position.
import { charts, point } from "./curves.js";
import { significant, write_numbers_with, written } from "./numbers.js";

export const motion = graphkinMotion;
export const data = JSON.parse(document.getElementById("run").textContent);
write_numbers_with(data.mark);
export const span = data.high - data.low;
const found = new Map();
// A missing element is looked up again, since a mark may be created when first needed.
export const byId = id => {
  if (!found.has(id)) {
    const element = document.getElementById(id);
    if (!element) return null;
    found.set(id, element);
  }
  return found.get(id);
};
const play = byId("play"),
  slider = byId("at"),
  speed = byId("speed"),
  back = byId("back");
export const rows = [...document.querySelectorAll("[data-row]")];
const NEAR = 0.8,
  ALONG = [0.5, 0.35, 0.65]; // mm of a name from its vector, parts of the vector next to which it may lie
const STILL = matchMedia("(prefers-reduced-motion:reduce)");
export const state = { x: data.start, playing: false, last: 0 };

const numbers = (mark, names) => names.map(name => Number(mark.getAttribute(name)));
const hides = mark => mark.getAttribute("visibility") === "hidden";

// The shift of a plan from low to high into its room; a larger plan overhangs on both sides.
function aside(low, high, pole, start, end) {
  if (high - low <= end - start) return Math.max(start - low, 0) + Math.min(end - high, 0);
  return start + ((pole - low) / (high - low)) * (end - start) - pole;
}

// Move the window over a plan so that the plan fits, and show a note where it does not fit.
function seat({ figure, rect, room, pole }) {
  const svg = byId(figure).querySelector("svg"),
    xs = [],
    ys = [];
  for (const mark of svg.querySelectorAll(":scope > line, :scope > circle")) {
    if (hides(mark)) continue;
    const names = mark.tagName === "line" ? ["x1", "x2", "y1", "y2"] : ["cx", "cx", "cy", "cy"];
    const [u, w, v, z] = numbers(mark, names);
    xs.push(u, w);
    ys.push(v, z);
  }
  const [x, y] = numbers(byId(pole), ["cx", "cy"]);
  const [left, right] = [Math.min(...xs, x), Math.max(...xs, x)];
  const [top, bottom] = [Math.min(...ys, y), Math.max(...ys, y)];
  const u = aside(left, right, x, room[0], room[2]),
    v = aside(top, bottom, y, room[1], room[3]);
  const window = [rect[0] - u, rect[1] - v, rect[2] - rect[0], rect[3] - rect[1]];
  svg.setAttribute("viewBox", window.map(number => number.toFixed(3)).join(" "));
  const fixed = `translate(${(-u).toFixed(3)} ${(-v).toFixed(3)})`;
  svg.querySelector(".fixed").setAttribute("transform", fixed);
  const inside =
    left + u >= rect[0] && right + u <= rect[2] && top + v >= rect[1] && bottom + v <= rect[3];
  byId(figure).querySelector(".beyond").hidden = inside;
}

// The unit direction from some places to another, with equal weights; null if undefined.
function off(here, others) {
  let [u, v] = [0, 0];
  for (const [x, y] of others) {
    const far = Math.hypot(here[0] - x, here[1] - y);
    if (far > 1) [u, v] = [u + (here[0] - x) / far, v + (here[1] - y) / far];
  }
  const size = Math.hypot(u, v);
  return size > 0.1 ? [u / size, v / size] : null;
}

// The magnification of letters in each field, so that the smallest are legible on this screen.
const LEGIBLE = 9.1,
  LARGEST = 2.5; // dots of their height; largest magnification
const enlarged = new Map();
function enlarge() {
  for (const svg of document.querySelectorAll("#stage svg")) {
    const { width, height } = svg.viewBox.baseVal,
      dots = Math.min(svg.clientWidth / width, svg.clientHeight / height);
    const least = Math.min(
      ...[...svg.querySelectorAll("[font-size]")].map(run => Number(run.getAttribute("font-size"))),
    );
    const times = Math.min(Math.max(LEGIBLE / (dots * least), 1), LARGEST);
    enlarged.set(svg, Number.isFinite(times) ? times : 1);
    svg.style.setProperty("--t", enlarged.get(svg).toFixed(3));
  }
}
const times_of = text => enlarged.get(text.ownerSVGElement) ?? 1;

// Place each letter by its rule next to its point, or on another side if a letter is in the way.
function letter(letters) {
  const [drawn, gap, beside, leftward, upward] = data.letter,
    taken = [],
    times = letters.length ? times_of(byId(letters[0][0])) : 1,
    height = drawn * times;
  const place = id => numbers(byId(id), ["cx", "cy"]);
  const meets = (s, width, t) =>
    Math.abs(s[0] - t[0]) < (width + t[2]) / 2 + beside && Math.abs(s[1] - t[1]) < height + gap;
  for (const [id, point, x, y, across, away, c, s, others] of letters) {
    const text = byId(id),
      here = place(point),
      width = across * times,
      far = away * times;
    const from = others.length ? off(here, others.map(place)) : [1, 0];
    const [u, v] = from
      ? [from[0] * c - from[1] * s, from[0] * s + from[1] * c]
      : [leftward, upward];
    const ways = [
      [u, v],
      [-v, u],
      [v, -u],
      [-u, -v],
    ];
    const spots = ways.map(([a, b]) => [here[0] + a * (far + width / 4), here[1] + b * far, width]);
    const free = hides(byId(point))
      ? null
      : spots.find(spot => !taken.some(t => meets(spot, width, t)));
    if (!free) {
      text.setAttribute("visibility", "hidden");
      continue;
    }
    taken.push(free);
    text.removeAttribute("visibility");
    text.setAttribute(
      "transform",
      `translate(${(free[0] - x).toFixed(3)} ${(free[1] - y).toFixed(3)})`,
    );
  }
  return taken.map(([x, y, width]) => [x, y, width, height]);
}

// Place the name of each vector next to it, clear of letters and other vectors. The name of a
// vector asked for must be clear of letters only. A vector too short for its name gets none.
function name(vectors, taken) {
  const lines = vectors
    .map(([, line]) => byId(line))
    .map(mark => (hides(mark) ? null : numbers(mark, ["x1", "y1", "x2", "y2"])));
  vectors.forEach(([id, , x, y, across, down, asked], i) => {
    const text = byId(id),
      [width, height] = [across, down].map(size => size * times_of(text)),
      [x1, y1, x2, y2] = lines[i] ?? [0, 0, 0, 0],
      long = Math.hypot(x2 - x1, y2 - y1);
    const [u, v] = [(x2 - x1) / long, (y2 - y1) / long],
      far = NEAR + (Math.abs(v) * width + Math.abs(u) * height) / 2;
    const spots = ALONG.flatMap(part =>
      [1, -1].map(side => [
        x1 + part * (x2 - x1) - side * v * far,
        y1 + part * (y2 - y1) + side * u * far,
        width,
        height,
      ]),
    );
    const apart = spot =>
      taken.every(
        ([c, d, w, h]) =>
          Math.abs(spot[0] - c) > (width + w) / 2 + NEAR ||
          Math.abs(spot[1] - d) > (height + h) / 2 + NEAR,
      );
    const free = long > 1.2 * width ? spots.filter(apart) : [];
    const clear = free.find(spot => !lines.some((line, k) => k !== i && line && cuts(line, spot)));
    const at = clear ?? (asked ? free[0] : null);
    text.toggleAttribute("data-off", !at);
    if (!at) return;
    taken.push(at);
    text.setAttribute(
      "transform",
      `translate(${(at[0] - x).toFixed(3)} ${(at[1] - y).toFixed(3)})`,
    );
  });
}

/**
 * Whether a line crosses a box around a spot.
 * @param {number[]} line
 * @param {Box} spot
 */
function cuts([x1, y1, x2, y2], [x, y, width, height]) {
  const [a, b] = [width / 2, height / 2],
    [u, v] = [(x2 - x1) / 2, (y2 - y1) / 2],
    [p, q] = [x - x1 - u, y - y1 - v];
  const within = Math.abs(p) < a + Math.abs(u) && Math.abs(q) < b + Math.abs(v);
  return within && Math.abs(p * v - q * u) < a * Math.abs(v) + b * Math.abs(u);
}

// Put the mechanism and its plans at a position of the driver.
function show(x) {
  state.x = Math.min(Math.max(x, data.low), data.high);
  const { ok } = motion.set(state.x, byId);
  if (ok) {
    const taken = data.letters.map(letter);
    data.vectors.forEach((vectors, i) => name(vectors, taken[2 * i + 1] ?? []));
    data.panes.forEach(seat);
  }
  const wording = written(state.x, span > 50 ? 1 : span > 5 ? 2 : 3) + data.unit;
  slider.value = state.x;
  slider.setAttribute("aria-valuetext", wording);
  byId("position").textContent = wording;
  const values = ok ? motion.values(state.x) : {};
  for (const row of rows) {
    const value = values[row.dataset.row];
    row.hidden = value === undefined;
    if (value !== undefined) tell(row, value);
  }
  point(values, wording);
}

// Write size and sense of a quantity.
function tell(row, value) {
  const senses = data.senses[row.dataset.row];
  row.querySelector(".size").textContent = significant(Math.abs(value));
  row.querySelector(".sense").innerHTML = value && senses ? `, ${senses[value > 0 ? 0 : 1]}` : "";
}

// Advance by some seconds in the sense of the driver's speed, and past the end from the beginning.
function go(seconds) {
  const way = data.sense * (seconds / data.seconds) * span * Number(speed.value);
  const beyond = state.x + way < data.low || state.x + way > data.high;
  if (beyond && data.back && !STILL.matches)
    byId("stage").animate([{ opacity: 0.15 }, { opacity: 1 }], 600);
  show(data.low + ((((state.x + way - data.low) % span) + span) % span));
}

function frame(now) {
  if (!state.playing) return;
  go(Math.min(Math.max(now - state.last, 0), 100) / 1000); // a frame may have begun before the click
  state.last = now;
  requestAnimationFrame(frame);
}

function start() {
  state.playing = true;
  state.last = performance.now();
  named("pause");
  requestAnimationFrame(frame);
}

function pause() {
  state.playing = false;
  named("play");
}

// Set the label of the play button.
function named(what) {
  play.toggleAttribute("data-on", what === "pause");
  play.setAttribute("aria-label", play.dataset[what]);
  play.title = play.dataset[what];
}

const toggle = () => (state.playing ? pause() : start());
export const rest = x => {
  pause();
  show(x);
};

document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const at = /** @type {Element} */ (event.target);
  const step = span / 100;
  const act = {
    " ": at.matches("button,select") ? null : toggle,
    ArrowLeft: at.matches("input,select") ? null : () => rest(state.x - step),
    ArrowRight: at.matches("input,select") ? null : () => rest(state.x + step),
    Home: at.matches("input,select") ? null : () => rest(data.start),
  }[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});
// The dead points and turning points below the slider; each jumps to its place, or as near as shown.
for (const [at, words] of data.notable) {
  const turned =
    data.degrees && !data.back ? data.low + ((((at - data.low) % 360) + 360) % 360) : at;
  const place = Math.min(Math.max(turned, data.low), data.high);
  const tick = document.createElement("button");
  tick.title = `${written(turned, span > 50 ? 1 : 2)}${data.unit}: ${words}`;
  tick.setAttribute("aria-label", tick.title);
  tick.style.setProperty("--part", String((place - data.low) / span));
  tick.addEventListener("click", () => rest(place));
  byId("notable").append(tick);
}
slider.min = data.low;
slider.max = data.high;
slider.step = span / 720;
slider.addEventListener("input", () => rest(Number(slider.value)));
play.addEventListener("click", toggle);
back.addEventListener("click", () => rest(data.start));
for (const id of ["bar", "values", "help", "anew"]) if (byId(id)) byId(id).hidden = false;
charts();
enlarge();
addEventListener("resize", () => {
  enlarge();
  show(state.x);
});
show(data.start);
