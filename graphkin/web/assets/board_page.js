// The elements and the state of a task page with its board: one sheet at a time, and nothing moves.
import { html_element } from "./elements.js";
import { write_numbers_with } from "./numbers.js";

export const page = document.documentElement;
export const byId = id => document.getElementById(id);
export const data = JSON.parse(byId("board").textContent);
write_numbers_with(data.mark);
export const motion = null,
  follow = html_element("button");
export const SMALL = matchMedia("(max-width:40rem),(max-height:34rem)"); // as in page.css
export const STILL = matchMedia("(prefers-reduced-motion:reduce)");
export const state = { step: 0, going: false };

page.classList.add("js", "turning");
byId("dock").hidden = byId("turn-panel").hidden = false;

/** Nothing moves on a task page. */
export const moved = () => false;

/**
 * Set a style property only if it changes, since each change causes a new layout.
 * @param {ElementCSSInlineStyle} element
 * @param {string} name
 * @param {string} value
 */
export function style(element, name, value) {
  if (element.style.getPropertyValue(name) !== value) element.style.setProperty(name, value);
}
