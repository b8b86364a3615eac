// The figures: numbers of the data that can be dragged or changed by keys, with all that depends on them.
import { html_element } from "./elements.js";
import { move, place_of } from "./driver.js";
import { nudge } from "./grab.js";
import { written } from "./numbers.js";
import { byId, data, motion, state } from "./page.js";
import { rest_from_travel } from "./travel.js";
import { next_frame, while_down } from "./view.js";

const PULL = 5; // dots of dragging per step
const led_by = []; // the elements that show each figure

/** The control of a figure; number -1 is the driver itself, or the time. */
export function knob(k) {
  const one = motion?.figures[k];
  if (!one)
    return {
      k,
      low: motion.low,
      high: motion.high,
      step: motion.step,
      whole: motion.whole,
      now: () => state.x,
      put: move,
      wording: () => place_of(state.x),
      at: (id, x) => motion.place(id, x),
    };
  const shown = () =>
    written(motion.read(one.shows, state.x), one.moves < 0 ? 1 : places_of(one.step)) + one.unit;
  return {
    k,
    ...one,
    whole: false,
    now: () => state.figures[k],
    put: value => set_figure(k, value),
    wording: shown,
    at: (id, value) => motion.place(id, state.x, k, value),
  };
}

/** The number of decimals of a step. */
function places_of(step) {
  return Math.min(String(Number(step.toFixed(2))).split(".")[1]?.length ?? 0, 2);
}

/** Store a figure within its range, without moving anything yet. */
export function keep_figure(k, value) {
  const { low, high, start, step } = motion.figures[k],
    next = Math.min(Math.max(value, low), high);
  state.figures[k] = Math.abs(next - start) < 1e-6 * step ? start : next;
  motion.figure(k, state.figures[k]);
}

/** Change a figure, and move the driver if the figure sets its position. */
function set_figure(k, value) {
  keep_figure(k, value);
  move(led_to([motion.figures[k]], state.x));
}

/** The driver position that some figures set; the current position if they set none. */
export function led_to(some, x) {
  return motion.drawn_at >= 0 && some.some(({ moves }) => moves > 0)
    ? motion.read(motion.drawn_at, x)
    : x;
}

/** Reset all figures to their drawn values. */
export function reset_figures() {
  motion?.figures.forEach(({ start }, k) => keep_figure(k, start));
}

/** A draggable number, to be put next to its name. */
function dragged_number(k) {
  const one = knob(k),
    number = html_element("span");
  const words = {
    class: "figure",
    role: "slider",
    tabindex: 0,
    "aria-valuemin": one.low,
    "aria-valuemax": one.high,
  };
  for (const [name, value] of Object.entries(words)) number.setAttribute(name, value);
  number.addEventListener("pointerdown", event => pull(event, one, number));
  number.addEventListener("keydown", event => nudge(event, one));
  (led_by[k + 1] ??= []).push(number);
  return number;
}

/** Drag a number; it grows to the right and upwards. */
function pull(event, one, number) {
  if (event.button) return;
  event.preventDefault();
  number.focus({ preventScroll: true });
  number.setPointerCapture(event.pointerId);
  rest_from_travel();
  const from = one.now(),
    went = moved => {
      const steps = Math.round(
        (moved.clientX - event.clientX - moved.clientY + event.clientY) / PULL,
      );
      next_frame((number.follow = () => one.put(from + steps * one.step)));
    };
  while_down(number, went);
}

/** The elements that show a datum: in the task, and below the drawings. */
function said_of(datum) {
  return ["#brief ul:last-of-type li", "#given li"]
    .map(list => document.querySelectorAll(list)[datum])
    .filter(Boolean);
}

/** Put the figure of a name into an element. */
function write_figure(element, name, k) {
  element.innerHTML = `${name} = `; // markup of a symbol, escaped by its maker
  const number = dragged_number(k);
  number.setAttribute("aria-label", element.textContent.slice(0, -3));
  element.append(number);
  return element;
}

const one_worded = []; // the text that each figure shows
let rewritten = 0; // number of changed figures when the derived data were last written
let derived = []; // elements of data derived from figures, as drawn and as rewritten

/** Make every number that can be changed draggable. */
export function make_figures() {
  const own = byId("datum");
  if (own)
    for (const element of said_of([...own.parentElement.children].indexOf(own)))
      write_figure(element, byId("read").dataset.name, -1);
  motion.figures.forEach(({ name, datum }, k) => {
    byId("figures").append(write_figure(html_element("span"), name, k));
    for (const element of said_of(datum)) write_figure(element, name, k);
  });
  derived = motion.derived.flatMap(([datum, name, place, unit]) =>
    said_of(datum)
      .filter(one => !one.querySelector(".figure"))
      .map(element => ({ element, drawn: [...element.childNodes], name, place, unit })),
  );
  tell_figures();
}

/** Write all figures with their current values. */
export function tell_figures() {
  led_by.forEach((numbers, i) => {
    const one = knob(i - 1),
      wording = one.wording();
    if (one_worded[i] === wording) return;
    one_worded[i] = wording;
    for (const number of numbers) {
      number.textContent = wording;
      number.setAttribute("aria-valuenow", Number(one.now().toFixed(4)));
      number.setAttribute("aria-valuetext", wording);
    }
  });
  const changed = changed_figures().length;
  if (!changed && !rewritten) return;
  rewritten = changed;
  for (const element of data.by_rate.flatMap(said_of)) element.hidden = changed > 0; // the scales stay as they are
  for (const { element, drawn, name, place, unit } of derived) {
    if (changed) element.innerHTML = `${name} = ${plain(motion.read(place, state.x))}${unit}`;
    else element.replaceChildren(...drawn);
  }
}

/** A number without more decimals than it needs. */
export function plain(number) {
  const short = Number(number.toPrecision(5));
  return Number.isFinite(short) ? written(short, String(short).split(".")[1]?.length ?? 0) : "?";
}

/** The figures that differ from their drawn values. */
export function changed_figures() {
  return (motion?.figures ?? [])
    .map((one, k) => ({ ...one, k }))
    .filter(({ k, start }) => state.figures[k] !== start);
}
