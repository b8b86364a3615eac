// The elements and the state of the page, and small helpers for every part.
import { write_numbers_with } from "./numbers.js";

export const page = document.documentElement;
export const byId = id => document.getElementById(id);
export const data = JSON.parse(byId("run").textContent);
export const motion = typeof graphkinMotion === "undefined" ? null : graphkinMotion;
write_numbers_with(data.mark);
export const last = data.bounds.at(-1)[1];
export const SMALL = matchMedia("(max-width:40rem),(max-height:34rem)"); // as in page.css
export const STILL = matchMedia("(prefers-reduced-motion:reduce)");
export const state = {
  step: 0,
  x: motion ? motion.start : 0,
  over: null,
  dead: false,
  going: false,
  figures: (motion?.figures ?? []).map(({ start }) => start),
};

page.classList.add("js");
motion?.set(motion.start, byId); // the moving part may add marks
byId("desk").append(byId("controls").content.cloneNode(true));
export const slider = byId("step"),
  play = byId("play"),
  follow = byId("follow");
export const own = Array.from({ length: last + 1 }, () => []); // the steps that each sentence draws
for (const [step, at] of Object.entries(data.at)) own[at].push(step);

/** Whether the driver has left the drawn position. */
export function moved() {
  return (
    motion !== null &&
    (state.x !== motion.start ||
      state.figures.some((value, k) => value !== motion.figures[k].start))
  );
}

/** Copies of the contents of an element. */
export function copies(element) {
  return [...element.cloneNode(true).childNodes];
}

/**
 * Set a style property only if it changes, since each change causes a new layout.
 * @param {ElementCSSInlineStyle} element
 * @param {string} name
 * @param {string} value
 */
export function style(element, name, value) {
  if (element.style.getPropertyValue(name) !== value) element.style.setProperty(name, value);
}
