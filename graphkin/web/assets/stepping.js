// A step: the drawing up to its sentence.
import { remember } from "./address.js";
import { begin } from "./beginning.js";
import { follow_pins } from "./grab.js";
import { byId, last, motion, slider, state } from "./page.js";
import { pause } from "./playing.js";
import { say } from "./sentences.js";
import { here, sheets } from "./sheets.js";
import { trace } from "./tracing.js";
import { found, read, read_out } from "./values.js";
import { lift, write } from "./writing.js";
import { put } from "./zoom.js";

/** Show a step. */
export function show(step) {
  const before = state.step,
    focus_kept = keeping_focus();
  state.step = Math.min(Math.max(Math.round(step) || 0, 0), last);
  state.over = null;
  sheets.forEach(({ element }, i) => {
    element.hidden = i !== here();
  });
  for (const mark of sheets[here()].marks) {
    const at = Number(mark.dataset.at);
    mark.classList.toggle("later", at > state.step);
    mark.classList.toggle("now", at > 0 && at === state.step);
  }
  for (const part of sheets[here()].parts)
    part.classList.toggle("later", Number(part.dataset.from) > state.step);
  for (const row of found) row.classList.toggle("unknown", Number(row.dataset.found) > state.step);
  slider.value = String(state.step);
  byId("previous").disabled = state.step === 0;
  byId("next").disabled = state.step === last;
  begin();
  if (state.going && !state.dead) read();
  say();
  if (motion) {
    read_out();
    put();
    follow_pins();
  }
  trace();
  if (state.step === before + 1) write();
  else lift();
  focus_kept();
  remember();
}

/** What gives the focus to the sentence, or else to the slider, if its element goes or is disabled. */
function keeping_focus() {
  const held = /** @type {HTMLButtonElement} */ (document.activeElement),
    other = byId("narration").contains(held) ? byId("narration") : slider;
  return () => {
    if (!held.isConnected || held.disabled) other.focus({ preventScroll: true });
  };
}

/** Show a step that the reader has chosen, and stop playing. */
export function go(step) {
  pause();
  show(step);
}
