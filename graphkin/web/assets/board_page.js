// The elements and the state of a task page with its board: one sheet at a time, and nothing moves.
const page = document.documentElement;
const byId = id => document.getElementById(id);
const data = JSON.parse(byId("board").textContent);
const motion = null, follow = document.createElement("button");
const SMALL = matchMedia("(max-width:40rem),(max-height:34rem)"); // as in page.css
const STILL = matchMedia("(prefers-reduced-motion:reduce)");
const INK = 0.7; // part of the line height that letters fill
const state = { step: 0, going: false };

page.classList.add("js", "turning");
byId("dock").hidden = byId("turn-panel").hidden = false;

/** Nothing moves on a task page. */
const moved = () => false;

/** Set a style property only if it changes, since each change causes a new layout. */
function style(element, name, value) {
  if (element.style.getPropertyValue(name) !== value) element.style.setProperty(name, value);
}
