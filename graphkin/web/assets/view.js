// The reader's view of a field: zoom by the wheel, by two fingers or by keys, and pan by
// dragging anything but a pin; a double click restores the page's own view.
import { sheets } from "./sheets.js";
import { dots, framed, look } from "./zoom.js";

const NEAREST = 10,
  FARTHEST = 0.6; // limits of the zoom, relative to the page
const NOTCH = 1.25,
  LINES = 18,
  WHEEL = 320; // zoom per key, dots per line, dots of the wheel for a factor of two
export const SLACK = 4; // dots by which a pointer may slip in a click

/**
 * The place on a field's paper, in mm, at a place of the window.
 * @param {{ svg: PageElement }} field
 * @param {number} across
 * @param {number} down
 * @returns {Place}
 */
export function paper_at({ svg }, across, down) {
  const { x, y } = new DOMPoint(across, down).matrixTransform(svg.getScreenCTM().inverse());
  return [x, y];
}

/**
 * The box that a view shows of a field in a picture of a given size.
 * @param {{ middle: Place, scale: number }} view
 * @param {number[]} size
 * @returns {Box}
 */
export function viewed({ middle, scale }, [across, high]) {
  const [width, height] = [across / scale, high / scale];
  return [middle[0] - width / 2, middle[1] - height / 2, width, height];
}

/**
 * The current view.
 * @param {Field} one
 */
function view_of(one) {
  const size = [one.svg.clientWidth, one.svg.clientHeight],
    [x, y, width, height] = one.box,
    scale = dots(size, one.box);
  one.least_scale ??= scale * FARTHEST;
  one.most_scale ??= scale * NEAREST;
  return { middle: [x + width / 2, y + height / 2], scale };
}

/**
 * Zoom by a factor about a fixed place of the paper.
 * @param {Field} one
 * @param {number} times
 * @param {Place} place
 */
function closer_by(one, times, [u, v]) {
  const { middle, scale } = view_of(one);
  const next = Math.min(Math.max(scale * times, one.least_scale), one.most_scale),
    part = scale / next;
  see(one, { scale: next, middle: [u + (middle[0] - u) * part, v + (middle[1] - v) * part] });
}

/**
 * Set the view of a field; null restores the page's own view.
 * @param {Field} one
 * @param {Field["view"]} view
 */
export function see(one, view) {
  one.view = view;
  one.svg.classList.toggle("held", view !== null);
  if (!view) one.least_scale = one.most_scale = undefined;
  next_frame(look_again);
}

let glides_back = false;

/** Restore the page's own view. */
function see_all(one) {
  glides_back = true;
  see(one, null);
}

function look_again() {
  look(glides_back);
  glides_back = false;
}

const waiting = new Set();
let dragged = false;

/** Run a function once before the next repaint. */
export function next_frame(work) {
  if (waiting.has(work)) return;
  waiting.add(work);
  requestAnimationFrame(() => {
    waiting.delete(work);
    work();
  });
}

/** Follow a pressed pointer on an element until its release. */
export function while_down(element, went, gone) {
  const held = new AbortController(),
    { signal } = held;
  element.addEventListener("pointermove", went, { signal });
  for (const name of ["pointerup", "pointercancel"])
    element.addEventListener(name, () => (held.abort(), gone?.()), { signal });
}

/** The middle of some pointers in the window, and their distance. */
function span(pointers) {
  const [p, q = p] = [...pointers.values()];
  return [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, Math.hypot(p[0] - q[0], p[1] - q[1])];
}

/** Let a field be zoomed and panned. */
function lookable(one) {
  const { svg } = one,
    pointers = new Map();
  let held = null; // the last place of the pointers, once they have moved
  let begun = null;
  const stop = event => {
    pointers.delete(event.pointerId);
    begun = held = null;
    if (!pointers.size) svg.classList.remove("panning");
  };
  svg.addEventListener(
    "wheel",
    event => {
      const times = 2 ** ((-event.deltaY * (event.deltaMode ? LINES : 1)) / WHEEL);
      if (times < 1 && !one.view && !event.ctrlKey) return; // the page scrolls on
      event.preventDefault();
      closer_by(one, times, paper_at(one, event.clientX, event.clientY));
    },
    { passive: false },
  );
  svg.addEventListener("pointerdown", event => {
    if (event.button || event.target.closest(".grip")) return;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    begun = span(pointers);
    held = pointers.size > 1 ? begun : null;
    dragged = false;
  });
  svg.addEventListener("pointermove", event => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    const now = span(pointers),
      touch = event.pointerType === "touch";
    if (!held) {
      if ((touch && !one.view) || Math.hypot(now[0] - begun[0], now[1] - begun[1]) < SLACK) return;
      held = begun;
      svg.classList.add("panning");
      svg.setPointerCapture(event.pointerId);
    }
    dragged = true;
    const before = paper_at(one, held[0], held[1]),
      after = paper_at(one, now[0], now[1]),
      { middle, scale } = view_of(one);
    see(one, {
      scale,
      middle: [middle[0] + before[0] - after[0], middle[1] + before[1] - after[1]],
    });
    if (held[2] > 1 && now[2] > 1) {
      framed(one, viewed(one.view, [svg.clientWidth, svg.clientHeight]));
      closer_by(one, now[2] / held[2], paper_at(one, now[0], now[1]));
    }
    framed(one, viewed(one.view, [svg.clientWidth, svg.clientHeight]));
    held = now;
  });
  for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, stop);
  for (const name of ["touchstart", "touchmove"]) {
    svg.addEventListener(name, event => event.touches.length > 1 && event.preventDefault(), {
      passive: false,
    });
  }
  svg.addEventListener("dblclick", event => {
    event.preventDefault();
    see_all(one);
  });
  svg.addEventListener("keydown", event => {
    const act = {
      "+": () => closer_by(one, NOTCH, view_of(one).middle),
      "=": () => closer_by(one, NOTCH, view_of(one).middle),
      "-": () => closer_by(one, 1 / NOTCH, view_of(one).middle),
      0: () => see_all(one),
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  });
}

/** The end of a drag is not a click. */
addEventListener(
  "click",
  event => {
    if (dragged) event.stopPropagation();
    dragged = false;
  },
  true,
);
sheets.forEach(({ fields }) => fields.forEach(lookable));
