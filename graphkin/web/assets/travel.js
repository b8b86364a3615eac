// Playing the motion: the driver runs in its sense, round and round or from end to end.
import { move, rest } from "./driver.js";
import { byId, motion, state } from "./page.js";
import { called, pause } from "./playing.js";

const TURN = 9000,
  PASS = 6000,
  STAY = 600; // milliseconds of a turn, of a range, and of the stay at its end
export const traveller = motion && byId("travel");
let travelling = 0,
  lately = 0;

/** Play the motion, or stop it. */
export function travel() {
  if (travelling) return rest_from_travel();
  pause();
  lately = performance.now();
  travelling = requestAnimationFrame(go_on);
  traveller.setAttribute("data-on", "");
  called(traveller, traveller.dataset.pause);
}

export function rest_from_travel() {
  if (travelling) rest();
  cancelAnimationFrame(travelling);
  travelling = 0;
  traveller.removeAttribute("data-on");
  called(traveller, traveller.dataset.play);
}

/** Advance by the elapsed time; a range starts again after its end. */
function go_on(now) {
  const { low, high, whole, sense } = motion,
    time = Math.min(now - lately, 100);
  const end = sense > 0 ? high : low,
    next = state.x + sense * time * (whole ? 360 / TURN : (high - low) / PASS);
  travelling = requestAnimationFrame(go_on);
  if (whole || (end - state.x) * sense > 1e-9) {
    lately = now;
    move(whole ? next : sense * Math.min(sense * next, sense * end));
  } else if (now - lately > STAY) {
    lately = now;
    move(sense > 0 ? low : high);
  }
}
