// The beginning: the whole mechanism is shown as a ghost, beside the task.
import { make_figures } from "./figures.js";
import { byId, data, motion, page, state } from "./page.js";
import { sheets } from "./sheets.js";

const ghosts = data.ghosts.map(k => byId(`m0-${k}`));

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
}
