// The field in which a mechanism is built by hand: each action is sent to the studio as an edit.

import { replace, written } from "./editor.js";
import { typedAfter, typedEnd } from "./exact.js";
import { keyed, panned, wheeled } from "./view.js";
import { sentence } from "./mistakes.js";
import { ask, find, onSpeaking, say, tell } from "./talk.js";
import { corners, onPicture, scale, shift, under } from "./underlay.js";

const canvas = find("canvas");
const svg = canvas.querySelector("svg");
const tip = find("tip");
const toggle = find("build");
const NEAR = 10; // px within which a pin or a bar is meant
const WIDE = 160; // steps of the grid across an empty field, and up it
const ROOM = 0.2; // margin around the mechanism, in parts of its size
const PIN = 6; // px
const BAR = 120; // px of the scale bar, at most
const LETTER = 15; // px
const BESIDE = 17; // px from a pin to the middle of its letter
const SIDES = [1, 3, 7, 5, 0, 2, 6, 4].map(part => (part * Math.PI) / 4); // directions for letters, best ones first
const SMALL = [180, 110]; // px of a small picture
const stood = new Map(); // places of points, by the text
let sketch = null;
let view = null; // left and upper edge and width of the view, in the unit of the scene
let byHand = false; // whether the reader has zoomed or panned: then the view stays
let press = null; // the start of a drag
let busy = false;
let changed = () => {};

/** Whether a mechanism is being built. */
export const isBuilding = () => toggle.getAttribute("aria-pressed") === "true";

/** The fields of a look request for this field: the places of the points. */
export const placesFields = () => ({ building: isBuilding(), places: places() });

/** Call back when the field is opened. */
export function onBuilding(work) {
  changed = work;
}

const places = () => stood.get(written()) ?? sketch?.points ?? {};
const tool = () => find("tools").elements.tool.value;

/** Show the content of the text; a text that cannot be read changes nothing. */
export function showSketch(found) {
  if (!found) return;
  const first = sketch === null;
  sketch = found;
  stood.set(written(), found.points);
  if (first && isEmpty()) find("tools").elements.tool.value = "pivot";
  explain();
  draw();
}

/** Open or close the field. */
export function building(open) {
  toggle.setAttribute("aria-pressed", String(open));
  find("field").hidden = !open;
  find("drawings").classList.toggle("building", open);
  if (open) changed();
}

/** The size of a pixel in the scene. */
const pixel = () => view.width / svg.clientWidth;

/** Bring all points into view; a view that holds them stays, unless `anew` is set or it is the first one. */
function fit(anew = !view) {
  const ghosts = sketch.ghosts.map(ghost => ghost.at);
  const at = [...Object.values(sketch.points), ...ghosts, ...corners()];
  const [width, height] = [svg.clientWidth || 1, svg.clientHeight || 1];
  const steep = height / width;
  const wide = WIDE * sketch.grid * Math.max(1, 1 / steep);
  view ??= { x: -wide / 2, y: (-wide * steep) / 2, width: wide };
  const edge = (3 * PIN * view.width) / width;
  const [right, lower] = [view.x + view.width, view.y + view.width * steep];
  const inside = ([x, y]) =>
    x > view.x + edge && x < right - edge && -y > view.y + edge && -y < lower - edge;
  const seen = byHand ? at.some(inside) : at.every(inside); // a view chosen by hand may cut something off
  if (!at.length || (!anew && seen)) return;
  const [xs, ys] = [at.map(p => p[0]), at.map(p => -p[1])];
  const middle = all => (Math.min(...all) + Math.max(...all)) / 2;
  const size = all => (Math.max(...all) - Math.min(...all)) * (1 + 2 * ROOM);
  const across = Math.max(
    size(xs),
    size(ys) / steep,
    (WIDE * sketch.grid) / 4,
    anew ? 0 : view.width,
  );
  view = { x: middle(xs) - across / 2, y: middle(ys) - (across * steep) / 2, width: across };
}

/** Show another part of the plane, as the reader wants it. */
function see(next) {
  view = next;
  byHand = true;
  draw();
}

/** Show the whole mechanism again. */
function showAll() {
  byHand = false;
  if (!sketch || !svg.clientWidth) return;
  fit(true);
  draw();
}

/** Keep the mechanism as large as the field allows when the field changes its size. */
function resized() {
  if (byHand || !view) draw();
  else showAll();
}

/** Keys of the field: digits choose tools, 0 shows all, + and - zoom, arrows pan; digits in a drag are its length. */
function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || !view) return;
  if (press) return onTyped(event);
  const named = find("tools").elements.tool[Number(event.key) - 1];
  const next = keyed(view, event.key, svg.clientHeight / svg.clientWidth);
  if (event.key === "0") showAll();
  else if (event.key !== " " && named) choose(named);
  else if (next) see(next);
  else return;
  event.preventDefault();
}

const TYPED = { bar: 0.5, wheel: 0.5, block: 5 }; // tools with a typed length or angle, with the step of a drawn angle

/** Keys of a drag: its length and angle are typed, Escape lets it go. */
function onTyped(event) {
  const typed = event.key === "Escape" ? "" : typedAfter(press.typed, event.key);
  if (typed === undefined || !TYPED[press.tool]) return;
  event.preventDefault();
  press.typed = typed;
  showDrag(press.seen ?? press.at);
}

/** The place where a drag begins, and where it ends for a pointer at a place. */
function endsOf(at) {
  const from = sketch.points[press.point] ?? press.at;
  return [from, press.typed ? typedEnd(press.typed, from, at, TYPED[press.tool]) : at];
}

/** Choose a tool as if it were pressed. */
function choose(button) {
  button.checked = true;
  button.dispatchEvent(new Event("change", { bubbles: true }));
}

/** Whether a press with the tool that moves holds nothing but the field. */
const holdsField = ({ tool, point, link, ghost }) => tool === "move" && !point && !link && !ghost;

function element(name, look, attributes, words = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  made.setAttribute("class", look);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = words;
  return made;
}

const line = (look, [x1, y1], [x2, y2]) => element("line", look, { x1, y1: -y1, x2, y2: -y2 });

/** The place of a dragged block; on a fixed guide it stays on the guide. */
function onGuide(sketch, { point, along: [u, v], fixed }, [x, y]) {
  const [a, b] = sketch.points[point];
  const part = ((x - a) * u + (y - b) * v) / (u * u + v * v || 1);
  return fixed ? [a + part * u, b + part * v] : [x, y];
}

/** The direction, of eight, farthest from the bars and guides that meet at a point. */
function freeSide(sketch, points, name) {
  const bars = Object.values(sketch.links).filter(held => held.includes(name));
  const others = bars.flat().filter(point => point !== name && points[point]);
  const ways = others.map(point => points[point].map((part, k) => part - points[name][k]));
  for (const { point, along } of sketch.blocks) {
    if (point === name)
      ways.push(
        along,
        along.map(part => -part),
      );
  }
  const turns = ways.map(([x, y]) => Math.atan2(y, x));
  const clear = side => Math.min(...turns.map(turn => Math.acos(Math.cos(turn - side))));
  return SIDES.reduce((best, side) => (clear(side) > clear(best) + 1e-6 ? side : best));
}

/** The marks of a sketch for given places of its points and size of a pixel; `named` adds the
 * letters of the points. */
function marksOf(sketch, points, one, named = true) {
  const marks = [];
  for (const block of sketch.blocks) {
    const [x, y] = onGuide(sketch, block, points[block.point]);
    const [dx, dy] = block.along.map(part => part / (Math.hypot(...block.along) || 1));
    const turn = `rotate(${(-Math.atan2(dy, dx) * 180) / Math.PI} ${x} ${-y})`;
    const reach = 60 * one;
    marks.push(line("guide", [x - dx * reach, y - dy * reach], [x + dx * reach, y + dy * reach]));
    const [width, height] = [26 * one, 16 * one];
    const box = { x: x - width / 2, y: -y - height / 2, width, height, transform: turn };
    marks.push(element("rect", "slider", { ...box, "vector-effect": "non-scaling-stroke" }));
  }
  for (const { link, centre, radius } of sketch.wheels) {
    const [x, y] = points[centre];
    const look = `wheel${sketch.driven.includes(link) ? " driven" : ""}`;
    marks.push(element("circle", look, { cx: x, cy: -y, r: radius, "data-wheel": link }));
  }
  for (const [name, held] of Object.entries(sketch.links)) {
    const at = held.filter(point => points[point]).map(point => points[point]);
    const look = `bar${sketch.driven.includes(name) ? " driven" : ""}`;
    const list = at.map(([x, y]) => `${x},${-y}`).join(" ");
    if (at.length > 1) marks.push(element("polygon", look, { points: list, "data-link": name }));
  }
  for (const ghost of sketch.ghosts) {
    for (const bar of ghost.bars) {
      const list = bar.map(([x, y]) => `${x},${-y}`).join(" ");
      marks.push(element(bar.length > 2 ? "polygon" : "polyline", "ghost", { points: list }));
    }
    marks.push(
      element("circle", "ghost", {
        cx: ghost.at[0],
        cy: -ghost.at[1],
        r: PIN * one,
        "data-ghost": ghost.point,
      }),
    );
  }
  for (const [name, [x, y]] of Object.entries(points)) {
    const look = `pin${sketch.fixed.includes(name) ? " fixed" : ""}`;
    marks.push(element("circle", look, { cx: x, cy: -y, r: PIN * one, "data-point": name }));
    if (!named) continue;
    const side = freeSide(sketch, points, name);
    const at = { x: x + BESIDE * Math.cos(side) * one, y: -y - BESIDE * Math.sin(side) * one };
    marks.push(element("text", "letter", { ...at, "font-size": LETTER * one }, name));
  }
  return marks;
}

/** A small picture of a mechanism. */
export function picture(sketch) {
  const small = element("svg", "mechanism", { "aria-hidden": "true" });
  const at = Object.values(sketch.points);
  if (!at.length) return small;
  const rims = sketch.wheels.flatMap(({ centre, radius }) => {
    const [x, y] = sketch.points[centre];
    return [
      [x - radius, y - radius],
      [x + radius, y + radius],
    ];
  });
  const seen = [...at, ...rims];
  const [xs, ys] = [seen.map(p => p[0]), seen.map(p => -p[1])];
  const [left, upper] = [Math.min(...xs), Math.min(...ys)];
  const [width, height] = [Math.max(...xs) - left, Math.max(...ys) - upper];
  const one = Math.max(width / SMALL[0], height / SMALL[1]) || 1;
  const [across, down] = [(SMALL[0] + 60) * one, (SMALL[1] + 30) * one];
  const edge = [left + width / 2 - across / 2, upper + height / 2 - down / 2];
  small.setAttribute("viewBox", [...edge, across, down].join(" "));
  small.append(...marksOf({ ...sketch, ghosts: [] }, sketch.points, one, false));
  return small;
}

/** A scale bar of a round length at the foot of the field. */
function measure(one) {
  const power = 10 ** Math.floor(Math.log10(BAR * one));
  const length = [5, 2, 1].map(m => m * power).find(each => each <= BAR * one);
  const [x, y] = [view.x + 12 * one, view.y + (svg.clientHeight - 12) * one];
  const letter = { x: x + length + 6 * one, y: y + 4 * one, "font-size": 0.8 * LETTER * one };
  return [
    element("path", "scale", {
      d: `M${x} ${y - 4 * one}v${8 * one}m0 ${-4 * one}h${length}m0 ${-4 * one}v${8 * one}`,
    }),
    element("text", "scale", letter, `${+length.toPrecision(3)} ${sketch.unit}`),
  ];
}

/** A cross with its axes at the origin. */
function origin(one) {
  const [reach, letter] = [26 * one, { "font-size": 0.8 * LETTER * one }];
  return [
    line("origin", [-reach, 0], [reach, 0]),
    line("origin", [0, -reach], [0, reach]),
    element("text", "origin", { x: reach + 3 * one, y: 4 * one, ...letter }, "x"),
    element("text", "origin", { x: -3 * one, y: -reach - 4 * one, ...letter }, "y"),
  ];
}

/** Coordinates on the grid, as they are written. */
const coordinates = at =>
  at.map(part => +(Math.round(part / sketch.grid) * sketch.grid).toFixed(6));

/** Show the pointer's coordinates at the edge of the field, or nothing. */
function tellPlace(at) {
  find("at").textContent = at && sketch ? `(${coordinates(at).join("; ")}) ${sketch.unit}` : "";
}

/** Draw everything; `shift` are points being dragged, `drawn` marks of an action in progress. */
function draw(shift = {}, drawn = []) {
  if (!sketch || !svg.clientWidth) return;
  fit();
  const one = pixel();
  const points = { ...sketch.points, ...shift };
  svg.setAttribute("viewBox", `${view.x} ${view.y} ${view.width} ${svg.clientHeight * one}`);
  const marks = marksOf(sketch, points, one);
  svg.replaceChildren(...under(), ...origin(one), ...measure(one), ...marks, ...drawn);
}

/** The place of a pointer in the scene. */
function spot(event) {
  const box = svg.getBoundingClientRect();
  const one = pixel();
  return [view.x + (event.clientX - box.left) * one, -(view.y + (event.clientY - box.top) * one)];
}

const away = ([x, y], [u, v]) => Math.hypot(x - u, y - v);

/** The distance of a place from a segment. */
function beside(at, from, to) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const part = ((at[0] - from[0]) * dx + (at[1] - from[1]) * dy) / (dx * dx + dy * dy || 1);
  const held = Math.max(0, Math.min(1, part));
  return away(at, [from[0] + held * dx, from[1] + held * dy]);
}

/** The nearest of some `things` within reach, by their distance. */
function nearest(things, distance) {
  const near = NEAR * pixel();
  const all = things.map(thing => [distance(thing), thing]).filter(([far]) => far <= near);
  return all.sort(([one], [other]) => one - other)[0]?.[1];
}

/** The pin at a place, except one. */
const pointAt = (at, but = "") => {
  const others = Object.keys(sketch.points).filter(name => name !== but);
  return nearest(others, name => away(at, sketch.points[name]));
};
const ghostAt = at => nearest(sketch.ghosts, ghost => away(at, ghost.at));

const fromRim = (at, { centre, radius }) => Math.abs(away(at, sketch.points[centre]) - radius);

/** The wheel whose rim is at a place, except wheels around a given point. */
const rimAt = (at, but) =>
  nearest(
    sketch.wheels.filter(wheel => wheel.centre !== but),
    wheel => fromRim(at, wheel),
  );

/** The bar or wheel at a place, except those of a given point. */
function linkAt(at, but = "") {
  const free = Object.keys(sketch.links).filter(name => !sketch.links[name].includes(but));
  return nearest(free, name => {
    const rims = sketch.wheels.filter(wheel => wheel.link === name);
    const rim = Math.min(Infinity, ...rims.map(wheel => fromRim(at, wheel)));
    const held = sketch.links[name].map(point => sketch.points[point]).filter(Boolean);
    const sides = held.map((point, i) => beside(at, held[i - 1] ?? held.at(-1), point));
    return held.length > 1 ? Math.min(rim, ...sides) : rim;
  });
}

/** A length as it is written. */
const lengthTold = (far, grid = sketch.grid) =>
  `${+(Math.max(1, Math.round(far / grid)) * grid).toFixed(6)} ${sketch.unit}`;

/** The distances of a new point of the pressed link from its first two points; on their line,
 * from one. */
function spokes(at) {
  const held = (sketch.links[press.link] ?? []).filter(name => sketch.points[name]).slice(0, 2);
  const [[x, y], [u, v]] = [sketch.points[held[0]] ?? at, sketch.points[held[1]] ?? at];
  const [long, aside] = [Math.hypot(u - x, v - y), (u - x) * (at[1] - y) - (v - y) * (at[0] - x)];
  if (held.length > 1 && Math.abs(aside) < sketch.grid * long) {
    const along = ((u - x) * (at[0] - x) + (v - y) * (at[1] - y)) / long;
    return `${held[0]}: ${lengthTold(Math.abs(along))}`;
  }
  return held.map(name => `${name}: ${lengthTold(away(at, sketch.points[name]))}`).join(", ");
}

/** A ring around the target pin. */
function ringed(name) {
  const [x, y] = sketch.points[name];
  return element("circle", "aim", { cx: x, cy: -y, r: 2 * PIN * pixel() });
}

/** Show a message next to the pointer until the next action. */
function tellAt(event, words) {
  const box = canvas.getBoundingClientRect();
  tip.hidden = !words;
  tip.textContent = words;
  tip.style.left = `${Math.min(event.clientX - box.left + 14, box.width * 0.6)}px`;
  tip.style.top = `${event.clientY - box.top + 14}px`;
}

/** Request an action; the text changes as if it were written. */
async function act(event, kind, of, at, more = {}) {
  if (busy) return;
  busy = true;
  svg.setAttribute("aria-busy", "true");
  try {
    const text = written();
    const answer = await ask("build", { text, kind, of, at, places: places(), ...more });
    if (answer.problems.length) {
      tellAt(event, answer.problems.map(sentence).join(" "));
      draw();
    } else if (text === written()) {
      stood.set(answer.text, answer.places);
      replace(answer.text);
      svg.focus();
    }
  } catch (error) {
    tellAt(event, error.message);
  } finally {
    busy = false;
    svg.removeAttribute("aria-busy");
  }
}

/** Drive a link at the written speed, which replaces the speed of a driven link. */
const drive = (event, link, at) =>
  act(event, "driver", [link], at, { speed: [Number(find("speed").value) || 0, 0] });

svg.addEventListener("pointerdown", event => {
  if (!sketch || event.button) return;
  tellAt(event, "");
  const at = spot(event);
  press = {
    at,
    point: pointAt(at),
    link: linkAt(at),
    ghost: ghostAt(at),
    tool: tool(),
    last: at,
    typed: "",
  };
  svg.focus({ preventScroll: true }); // a length is typed there
  svg.setPointerCapture(event.pointerId);
});

svg.addEventListener("pointerleave", () => tellPlace(null));
svg.addEventListener("pointermove", event => {
  if (!sketch || !view) return;
  const at = spot(event);
  tellPlace(at);
  if (!press) return;
  if (press.tool === "move" && press.point) {
    const goal = pointAt(at, press.point);
    draw({ [press.point]: goal ? sketch.points[goal] : at }, goal ? [ringed(goal)] : []);
  }
  if (holdsField(press)) see(panned(view, press.at, at));
  if (press.tool === "shift") {
    shift([at[0] - press.last[0], at[1] - press.last[1]]);
    press.last = at;
    draw();
  }
  press.seen = at;
  showDrag(at);
});

/** Draw what a release at a place would make, with its length and angle. */
function showDrag(pointer) {
  if (!["bar", "plate", "block", "wheel", "scale"].includes(press.tool)) return;
  const [from, at] = press.tool === "scale" ? [press.at, pointer] : endsOf(pointer);
  const goal = press.tool === "bar" && !press.typed ? pointAt(at, press.point) : undefined;
  const to = sketch.points[goal] ?? at;
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const grid = press.typed ? 0.001 : undefined; // typed numbers are drawn as they are
  const length = lengthTold(Math.hypot(dx, dy), grid);
  const step = grid ?? TYPED[press.tool] ?? 0.5; // degrees, as building.py rounds them
  const angle = `${+(Math.round((Math.atan2(dy, dx) * 180) / Math.PI / step) * step).toFixed(3)}°`;
  const slot = press.tool === "block" && linkAt(at, press.point);
  const words =
    {
      plate: () => spokes(at),
      block: () => (slot ? "" : angle),
      bar: () => (goal ? length : `${length}, ${angle}`),
    }[press.tool]?.() ?? length;
  const one = pixel();
  const letter = { x: at[0] + 14 * one, y: -at[1] - 14 * one, "font-size": LETTER * one };
  const drawn = [line("drawn", from, to), element("text", "letter", letter, words)];
  if (press.tool === "wheel") {
    drawn.push(element("circle", "drawn", { cx: from[0], cy: -from[1], r: Math.hypot(dx, dy) }));
  }
  draw({}, drawn);
}

/** What a release does, by tool; a tool whose release means nothing here returns false. */
const released = {
  pivot: ({ event, at }) => act(event, "pivot", [], at),
  move: releasedMove,
  scale: releasedScale,
  shift: ({ dragged }) => dragged,
  bar: ({ event, from, at, dragged, end, exact }) =>
    from.point &&
    dragged &&
    act(event, "bar", end ? [from.point, end] : [from.point], at, { exact }),
  plate: ({ event, from, at }) => from.link && act(event, "plate", [from.link], at),
  block({ event, from, at, dragged, exact }) {
    if (!from.point || !dragged) return false;
    const slot = exact ? undefined : linkAt(at, from.point);
    return act(event, "block", slot ? [from.point, slot] : [from.point], at, { exact });
  },
  wheel({ event, from, at, dragged, exact }) {
    if (!from.point || !dragged) return false;
    const rim = rimAt(at, from.point);
    return act(event, "wheel", rim ? [from.point, rim.link] : [from.point], at, { exact });
  },
  driver: ({ event, from, at }) => from.link && drive(event, from.link, at),
  delete: ({ event, from, at }) =>
    (from.point || from.link) &&
    act(event, "delete", [from.point ?? from.link], at, { words: from.point ? "point" : "link" }),
};

/** A point that was moved: joined with another, put elsewhere, or closed with a ghost. */
function releasedMove({ event, from, at, dragged }) {
  if (from.point && dragged) {
    const goal = pointAt(at, from.point);
    if (goal) act(event, "join", [from.point, goal], at);
    else act(event, "move", [from.point], at);
  } else if (from.ghost && !from.point) {
    act(event, "close", [from.ghost.key], at, { words: from.ghost.words });
  }
  return true;
}

/** The picture scaled by a dragged line of known length. */
function releasedScale({ event, from, at, dragged }) {
  if (!dragged) return false;
  const length = Number(find("span").value);
  if (length > 0) {
    scale(from.at, at, length);
    fit(true);
  } else tellAt(event, say("studio.how_scale"));
  draw();
  return true;
}

svg.addEventListener("pointerup", event => {
  const from = press;
  if (!from) return;
  const exact = Boolean(from.typed);
  const at = exact ? endsOf(spot(event))[1] : spot(event);
  press = null;
  const dragged = exact || away(at, from.at) > 3 * pixel();
  const end = exact ? undefined : pointAt(at);
  draw();
  const done = released[from.tool]?.({ event, from, at, dragged, end, exact });
  if (!done) tellAt(event, say(`studio.how_${from.tool}`));
});

svg.addEventListener("pointercancel", () => {
  press = null;
  draw();
});

svg.addEventListener(
  "wheel",
  event => {
    if (!sketch || !view) return;
    event.preventDefault();
    see(wheeled(view, event.deltaY, spot(event)));
  },
  { passive: false },
);

const isEmpty = () => sketch !== null && !Object.keys(sketch.points).length;

function explain() {
  const what = isEmpty() && ["move", "pivot"].includes(tool()) ? "begin" : tool();
  find("how").textContent = say(`studio.how_${what}`);
  find("driven").style.visibility = tool() === "driver" ? "visible" : "hidden";
  find("spanned").hidden = tool() !== "scale";
  if (!sketch) return;
  find("span-unit").textContent = sketch.unit;
  find("speed-unit").textContent = sketch.rate;
}

find("tools").addEventListener("change", () => {
  tip.hidden = true;
  explain();
});
for (const name of ["pointerdown", "keydown"]) addEventListener(name, () => (tip.hidden = true));
for (const field of ["speed", "span"])
  find(field).addEventListener("focus", () => find(field).select());
find("tools").addEventListener("submit", event => event.preventDefault());
find("speed").addEventListener("keydown", ({ key }) => {
  if (key !== "Enter" || sketch?.driven.length !== 1) return;
  const { left, top } = canvas.getBoundingClientRect();
  drive({ clientX: left, clientY: top }, sketch.driven[0], [0, 0]);
});
onPicture(
  error => {
    if (error) tell(error.message, "wrong");
    if (find("picture-tools").hidden && ["shift", "scale"].includes(tool())) find("tools").reset();
    explain();
    draw();
  },
  () => ({ ...view, height: svg.clientHeight * pixel() }),
);
toggle.addEventListener("click", () => building(!isBuilding()));
new ResizeObserver(resized).observe(svg);
svg.addEventListener("keydown", onKey);
find("fit").addEventListener("click", showAll);
onSpeaking(explain);
explain();
