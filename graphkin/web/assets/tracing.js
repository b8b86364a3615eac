// The sources of a step: marked in the drawing, and named.
import { html_element } from "./elements.js";
import { halos } from "./halos.js";
import { read_from } from "./highlights.js";
import { byId, data, own, state } from "./page.js";
import { here, sheets } from "./sheets.js";
import { look } from "./zoom.js";

/** Mark what the current step, or the mark pointed at, draws, and the sources of both. */
export function trace() {
  const sheet = sheets[here()],
    from = new Set([...sources(looked_at()), ...read_from()]);
  const done = state.step === data.bounds[here()][1] && !state.over;
  sheet.element.classList.toggle("growing", !done);
  for (const mark of sheet.marks) {
    mark.classList.toggle("rest", !mark.classList.contains("now") && !from.has(mark.dataset.of));
  }
  halos();
  names(byId("from"), from);
  byId("from-key").hidden = !from.size;
  look();
}

/** The steps of the current sentence, or the step pointed at. */
export function looked_at() {
  return state.over ? [state.over] : state.step ? own[state.step] : [];
}

/** The steps that some steps are drawn from. */
export function sources(steps) {
  const from = new Set(steps.flatMap(step => data.from[step] ?? []).map(String));
  steps.forEach(step => from.delete(step));
  return from;
}

/** List the names of the sources with the steps that drew them. */
export function names(list, from) {
  const first_at = new Map();
  for (const step of from) {
    const name = data.letters[step];
    if (name && !first_at.has(name)) first_at.set(name, data.at[step]);
  }
  list.replaceChildren();
  for (const [name, at] of [...first_at].sort((a, b) => a[1] - b[1])) {
    if (list.childNodes.length) list.append(", ");
    const part = html_element(at ? "a" : "span");
    part.innerHTML = name; // markup of a symbol, escaped by its maker
    if (at) {
      part.setAttribute("href", `#step=${at}`);
      part.append(` (${at})`);
    }
    list.append(part);
  }
}
