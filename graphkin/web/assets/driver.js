// The driver, and all that follows it.
import { html_element } from "./elements.js";
import { remember } from "./address.js";
import { changed_figures, knob, plain, tell_figures } from "./figures.js";
import { follow_pins } from "./grab.js";
import { halos } from "./halos.js";
import { written } from "./numbers.js";
import { byId, data, motion, moved, page, state } from "./page.js";
import { crossings_of, tell_read, warn } from "./sentences.js";
import { sheets } from "./sheets.js";
import { read } from "./values.js";
import { lift } from "./writing.js";
import { look, put } from "./zoom.js";

const DEAD = Math.sin(Math.PI / 180),
  FAR = 1e-4; // least sines of crossings: for hand drawing, and for far centres and poles
export const driver = motion && byId("driver");
const notes = motion
  ? [...document.querySelectorAll(".sheet h2, #given-name")].map(name => {
      const one = html_element("small");
      one.className = "moved-note";
      name.after(one);
      return one;
    })
  : [];
if (motion) {
  const { low, high, start, step } = motion;
  const min = start - Math.floor((start - low) / step) * step; // so that one stop is the starting position
  for (const [name, value] of Object.entries({ min, max: high, step }))
    driver.setAttribute(name, value);
}

const REST = 250; // milliseconds without movement after which the driver rests
let resting = 0;

/** Set the driver to a position. */
export function drive(x, glides = false) {
  place_driver(x);
  look(glides);
  follow_pins();
  remember();
}

/** Move the driver; scale and frame stay as they are during the movement. */
export function move(x) {
  const first = !state.going;
  state.going = true;
  clearTimeout(resting);
  resting = setTimeout(rest, REST);
  place_driver(x);
  if (first) look(true);
  follow_pins();
}

/** End a movement: all labels that have room reappear, and all numbers are of this place. */
export function rest() {
  clearTimeout(resting);
  state.going = false;
  put();
  halos();
  look(true);
  if (!state.dead) read();
  tell_read();
  remember();
}

/** Put everything that follows the driver in place. */
function place_driver(x) {
  lift();
  const place = meant(x);
  const there = Math.abs(place - motion.start) < 1e-6 * motion.step;
  state.x = Number.isFinite(place) && !there ? place : motion.start;
  driver.value = state.x;
  const shown = place_of(state.x);
  byId("driven").textContent = shown;
  driver.setAttribute("aria-valuetext", shown);
  const ok = put();
  page.classList.toggle("moved", moved());
  byId("back").disabled = !moved();
  note(shown);
  const flat = ok ? flat_crossings() : [];
  const dead = flat.some(step => !data.aside.includes(step));
  state.dead = !ok || dead;
  clear_off(!ok, flat);
  byId("place").textContent = !ok
    ? byId("place").dataset.open
    : dead
      ? byId("place").dataset.dead
      : "";
  if (!state.dead) read();
  tell_read();
  page.classList.toggle("silent", state.dead);
  warn(byId("narration"), crossings_of(state.step));
  halos();
}

/** The driver position meant by a number; an angle may differ by whole turns. */
function meant(x) {
  const { low, high, unit, whole } = motion,
    circle = whole ? high - low : 360,
    off = x < low || x > high;
  const turned =
    off && unit === "deg" ? x - circle * Math.round((x - (low + high) / 2) / circle) : x;
  return Math.min(Math.max(turned, low), high);
}

/** A position of the driver in words. */
export function place_of(x) {
  const { digits, unit } = byId("driven").dataset;
  return written(x, Number(digits)) + unit;
}

/** The steps whose lines cross at too flat an angle. */
function flat_crossings() {
  const sines = Object.entries(motion.margins(state.x)).map(([step, sine]) => [Number(step), sine]);
  return sines
    .filter(([step, sine]) => sine < (data.aside.includes(step) ? FAR : DEAD))
    .map(([step]) => step);
}

/** The crossings that each step of a plan needs. */
const behind = new Map(
  data.hangs.flatMap(([crossings, steps]) => steps.map(step => [String(step), crossings])),
);
let cleared = "";

/** Remove marks that depend on missing crossings, or all marks, from the drawings. */
function clear_off(all, flat) {
  const now = `${all} ${flat}`;
  if (now === cleared) return;
  cleared = now;
  for (const { of } of sheets) {
    for (const [step, marks] of of) {
      const crossings = behind.get(step),
        gone = crossings && (all || flat.some(crossing => crossings.includes(crossing)));
      for (const mark of marks) mark.classList.toggle("void", Boolean(gone));
    }
  }
}

/** Note next to drawings and data where the driver is, and for which position they were checked. */
function note(shown) {
  const { name, moved: words } = byId("read").dataset,
    changed = changed_figures();
  const own = state.x !== motion.start || !changed.length;
  const list = (place, wording_of) =>
    [
      ...(own ? [`${name} = ${place}`] : []),
      ...changed.map(one => `${one.name} = ${wording_of(one)}`),
    ].join(", "); // markup of symbols, escaped by its maker
  const here = list(shown, ({ k }) => knob(k).wording());
  const start = list(place_of(motion.start), one => plain(motion.drawn[one.k]) + one.unit);
  for (const one of notes) {
    one.innerHTML = words.replace("{place}", here).replace("{start}", start);
    one.hidden = !moved();
  }
  tell_figures();
}
