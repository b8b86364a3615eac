// Moving the mechanism by hand: a pin is dragged, or moved by keys, along its path.
import { svg_element } from "./elements.js";
import { changed_figures, knob } from "./figures.js";
import { byId, motion, page } from "./page.js";
import { here, sheets } from "./sheets.js";
import { rest_from_travel } from "./travel.js";
import { next_frame, paper_at, SLACK, while_down } from "./view.js";

const SAMPLES = 360,
  LEAST_WAY = 2; // driver positions at which paths are known; least size in mm of a path that can be grabbed
const SHARPER = 24,
  GOLDEN = (Math.sqrt(5) - 1) / 2; // steps of the search for the nearest position
const LEAPS = 10; // steps of the driver for a key with Shift
let way_on = 1; // the sense of the last movement of the driver

export const grips = motion ? motion.grips.map(grips_of) : [];

/** The moving pins of a sheet, each with a handle. */
function grips_of(pins, sheet) {
  const [{ svg }] = sheets[sheet].fields,
    group = svg.appendChild(svg_element("g")),
    found = [];
  group.setAttribute("class", "grips");
  for (const [id, name, driven, k] of [...pins].sort((p, q) => q[2] - p[2])) {
    const by = knob(k),
      way = way_of(id, by),
      pin = byId(id);
    if (way && !found.some(other => same(other.pin, pin)))
      found.push(grip(svg, group, { id, name, driven, by, pin, way }));
  }
  if (found.length) svg.setAttribute("role", "group"); // the picture takes input
  return found;
}

/** Whether two circles are at the same place. */
function same(one, other) {
  return ["cx", "cy"].every(
    axis => Math.abs(one.getAttribute(axis) - other.getAttribute(axis)) < 0.01,
  );
}

/** The positions of a pin over the whole range; null for a pin that hardly moves. */
function way_of(id, { low, high, at }) {
  const way = Array.from({ length: SAMPLES + 1 }, (_, i) =>
    at(id, low + ((high - low) * i) / SAMPLES),
  );
  const known = way.filter(Boolean),
    reach = axis => Math.max(...known.map(at => at[axis])) - Math.min(...known.map(at => at[axis]));
  return known.length > 1 && Math.hypot(reach(0), reach(1)) > LEAST_WAY ? way : null;
}

/** Give a pin its handle. */
function grip(svg, group, one) {
  const handle = group.appendChild(svg_element("circle"));
  const { low, high } = one.by,
    words = byId("move").dataset;
  const attributes = {
    class: one.driven ? "grip driven" : "grip",
    tabindex: 0,
    role: "slider",
    "aria-label": words.pin.replace("{pin}", one.name),
    "aria-valuemin": low,
    "aria-valuemax": high,
  };
  for (const [name, value] of Object.entries(attributes)) handle.setAttribute(name, value);
  handle.addEventListener("pointerdown", event => take(event, svg, { ...one, handle }));
  handle.addEventListener("keydown", event => nudge(event, one.by));
  return { ...one, handle };
}

/** Put the handles of the current sheet at their pins. */
export function follow_pins() {
  for (const { pin, handle, by } of grips[here()] ?? []) {
    for (const axis of ["cx", "cy"]) handle.setAttribute(axis, pin.getAttribute(axis));
    handle.setAttribute("aria-valuenow", Number(by.now().toFixed(4)));
    handle.setAttribute("aria-valuetext", by.wording());
    handle.toggleAttribute("hidden", pin.matches(".later,.void,[visibility]"));
  }
}

/** Drag a pin until it is released. */
function take(event, svg, one) {
  if (event.button) return;
  event.preventDefault();
  event.stopPropagation();
  one.handle.focus({ preventScroll: true });
  one.handle.setPointerCapture(event.pointerId);
  page.classList.add("grabbing");
  rest_from_travel();
  if (one.by.k >= 0 || changed_figures().length) one.way = way_of(one.id, one.by) ?? one.way;
  let pointer = [event.clientX, event.clientY],
    off = null;
  const [u, v] = paper_at({ svg }, pointer[0], pointer[1]),
    slip = ["cx", "cy"].map((axis, k) => Number(one.pin.getAttribute(axis)) - [u, v][k]);
  const pull = () => {
    const [across, down] = paper_at({ svg }, pointer[0], pointer[1]),
      x = nearest(one, across + slip[0], down + slip[1]);
    const went_on = x - one.by.now();
    if (went_on)
      way_on = Math.sign(went_on) * (Math.abs(went_on) > (one.by.high - one.by.low) / 2 ? -1 : 1);
    one.by.put(x);
  };
  const went = moved => {
    off ??= pointer;
    pointer = [moved.clientX, moved.clientY];
    if (off !== true && Math.hypot(pointer[0] - off[0], pointer[1] - off[1]) < SLACK / 2) return;
    off = true;
    next_frame(pull);
  };
  while_down(one.handle, went, () => page.classList.remove("grabbing"));
}

/** Move a pin or figure by keys. */
export function nudge(event, one) {
  const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
  const x =
    { Home: one.low, End: one.high }[event.key] ??
    (steps && one.now() + steps * one.step * (event.shiftKey ? LEAPS : 1));
  if (x === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  event.stopPropagation();
  rest_from_travel();
  one.put(x);
}

/** The driver position that brings a pin nearest to a place of its field, found by descent. */
function nearest({ id, way, by }, u, v) {
  const { low, high, whole, at: place, now } = by,
    part = (high - low) / SAMPLES;
  const turned = i => (whole ? ((i % SAMPLES) + SAMPLES) % SAMPLES : i);
  const off = at => (at ? Math.hypot(at[0] - u, at[1] - v) : Infinity),
    far = i => off(way[turned(i)]);
  let i = Math.round((now() - low) / part);
  const downhill = sense => far(i + sense) < far(i);
  const sense = [way_on, -way_on].find(downhill) ?? 0;
  while (sense && downhill(sense)) i += sense;
  const clamped = at => (whole ? at : Math.min(Math.max(at, low), high)),
    miss = at => off(place(id, at));
  let [from, to] = [clamped(low + (i - 1) * part), clamped(low + (i + 1) * part)];
  for (let k = 0; k < SHARPER; k++) {
    const near = to - GOLDEN * (to - from),
      farther = from + GOLDEN * (to - from);
    if (miss(near) < miss(farther)) to = farther;
    else from = near;
  }
  return (from + to) / 2;
}
