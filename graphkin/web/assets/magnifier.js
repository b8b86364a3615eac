// A magnifier above a finger that is held on a drawing, since a finger hides what it points at.
import { html_element } from "./elements.js";
import { here, sheets } from "./sheets.js";

const HOLD = 160; // milliseconds of holding before it is shown; a tap needs none
const LARGER = 2.5; // times the size on the screen
const ABOVE = 28,
  EDGE = 4; // dots from the finger to its rim, and least from the window's edge

/** @type {{ box: HTMLElement, svg: SVGElement, side: number } | null} */
let glass = null;
let waits = 0;

/**
 * Show what a held finger points at, now or once it has been held for a while.
 * @param {Spot | null} spot
 * @param {PointerEvent} event
 * @param {boolean} moved whether the finger has been moved
 */
export function magnify(spot, event, moved) {
  if (event.pointerType !== "touch") return;
  clearTimeout(waits);
  if (!spot) remove_glass();
  else if (glass || moved) show_glass(spot, event);
  else waits = setTimeout(() => show_glass(spot, event), HOLD);
}

/** Put the magnifier away. */
export function end_magnifying() {
  clearTimeout(waits);
  remove_glass();
}

function remove_glass() {
  glass?.box.remove();
  glass = null;
}

/**
 * Show the surroundings of a place of a field.
 * @param {Spot} spot
 * @param {{ clientX: number, clientY: number }} finger
 */
function show_glass({ side, at }, finger) {
  const field = sheets[here()].fields[side];
  if (glass?.side !== side) take_glass(field, side);
  const { box, svg } = glass,
    size = box.offsetWidth;
  const half = svg.clientWidth / 2 / LARGER / field.svg.getScreenCTM().a;
  svg.setAttribute(
    "viewBox",
    [at[0] - half, at[1] - half, 2 * half, 2 * half].map(n => n.toFixed(3)).join(" "),
  );
  svg.lastElementChild.replaceWith(field.aims.cloneNode(true)); // what would be taken and come
  const above = finger.clientY - ABOVE - size;
  const aside = finger.clientX > innerWidth / 2 ? -ABOVE - 1.5 * size : ABOVE + size / 2;
  const [left, top] =
    above < EDGE ? [finger.clientX + aside, EDGE] : [finger.clientX - size / 2, above];
  box.style.left = `${Math.min(Math.max(left, EDGE), innerWidth - size - EDGE)}px`;
  box.style.top = `${top}px`;
}

/** Make the magnifier of a field: a copy of its picture, as it is when the finger comes. */
function take_glass(field, side) {
  remove_glass();
  const box = html_element("div"),
    svg = field.svg.cloneNode(true);
  box.className = "view magnifier";
  box.setAttribute("aria-hidden", "true");
  for (const one of [svg, ...svg.querySelectorAll("[id]")]) one.removeAttribute("id");
  for (const name of ["tabindex", "role", "aria-labelledby"]) svg.removeAttribute(name);
  for (const grips of svg.querySelectorAll(".grips")) grips.remove();
  svg.append(svg.querySelector(".aims"));
  box.append(svg);
  sheets[here()].element.append(box);
  glass = { box, svg: /** @type {any} */ (svg), side };
}
