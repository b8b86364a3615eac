// The beginning: the whole mechanism is shown as a ghost, beside the task.
import { make_figures } from "./figures.js";
import { byId, data, motion, page, state } from "./page.js";
import { sheets } from "./sheets.js";

const ghosts = data.ghosts.map(k => byId(`m0-${k}`));

/** Put the task into the empty plan, and make its numbers draggable. */
export function show_task() {
  sheets[0].fields[1].svg.parentElement.append(...byId("task").content.children);
  if (motion) make_figures();
}

/** Show the ghost at the first step and remove it elsewhere. */
export function begin() {
  const here = state.step === 0;
  page.classList.toggle("beginning", here);
  for (const mark of ghosts) mark.classList.toggle("ghost", here);
}
