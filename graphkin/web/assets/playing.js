// Playing the steps.
import { byId, last, motion, play, state } from "./page.js";
import { show } from "./stepping.js";
import { rest_from_travel } from "./travel.js";

let timer = 0;

function start() {
  if (motion) rest_from_travel();
  play.setAttribute("data-on", "");
  called(play, play.dataset.pause);
  if (state.step === last) show(0);
  wait();
}

export function pause() {
  clearTimeout(timer);
  timer = 0;
  play.removeAttribute("data-on");
  called(play, play.dataset.play);
}

export function toggle() {
  if (timer) pause();
  else start();
}

/** Wait at a step for as long as its sentence and reason take to read and its strokes to draw. */
function wait() {
  const why = byId("because").open ? byId("reason").textContent.length : 0;
  const letters = byId("sentence").textContent.length + (state.step ? why : 0);
  timer = setTimeout(
    () => {
      show(state.step + 1);
      if (state.step === last) pause();
      else wait();
    },
    Math.min(1500 + 45 * letters, 25000),
  );
}

/** Set the label of a button. */
export function called(button, words) {
  button.title = words;
  button.setAttribute("aria-label", words);
}
