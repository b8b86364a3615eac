// The beginning: the whole mechanism is shown as a ghost and moves once through its range.
import { make_figures } from "./figures.js";
import { byId, data, motion, moved, page, state, STILL } from "./page.js";
import { sheets } from "./sheets.js";
import { DRAWN, put } from "./zoom.js";

export const SWEEP = 5000; // milliseconds of the sweep
const ghosts = data.ghosts.map(k => byId(`m0-${k}`));
let ghost = 0,
  shown_once = false;

/** Put the task and the data into the empty plan, and make their numbers draggable. */
export function show_task() {
  const list = byId("given").querySelector("ul").cloneNode(true);
  sheets[0].fields[1].svg.parentElement.append(...byId("task").content.children);
  for (const item of list.children) item.removeAttribute("id");
  byId("brief").append(list);
  if (motion) make_figures();
}

/** Show the ghost at the first step and remove it elsewhere. */
export function begin() {
  const here = state.step === 0;
  page.classList.toggle("beginning", here);
  for (const mark of ghosts) mark.classList.toggle("ghost", here);
  if (!here) settle();
  else if (motion && !shown_once && !moved() && !STILL.matches && !document.hidden) sweep();
}

/** Move the ghost once through the range. */
function sweep() {
  const from = performance.now();
  shown_once = true;
  const next = now => {
    const part = (now - from) / SWEEP;
    if (part >= 1 || moved()) return settle();
    motion.set(along(part), byId, DRAWN, 0);
    ghost = requestAnimationFrame(next);
  };
  ghost = requestAnimationFrame(next);
}

/** The driver's position after a part of the way: a full turn, or to one end, to the other and back. */
function along(part) {
  const { low, high, start, whole } = motion,
    eased = part - Math.sin(2 * Math.PI * part) / (2 * Math.PI);
  const way = 2 * (high - low) * eased,
    up = high - start;
  if (whole) return low + ((start - low + way / 2) % (high - low));
  return way < up
    ? start + way
    : way < up + high - low
      ? high - (way - up)
      : low + (way - up - (high - low));
}

/** Put the ghost back to the drawn position. */
function settle() {
  if (!ghost) return;
  cancelAnimationFrame(ghost);
  ghost = 0;
  if (!moved()) put();
}
