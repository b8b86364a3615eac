// The step and the driver's position in the address of the page.
import { drive } from "./driver.js";
import { changed_figures, keep_figure, led_to, reset_figures } from "./figures.js";
import { motion, moved, state } from "./page.js";
import { show } from "./stepping.js";

let address = location.hash,
  keeping = 0;

/** Write step and position to the address once nothing has moved for a moment. */
export function remember() {
  clearTimeout(keeping);
  keeping = setTimeout(keep, 120);
}

function keep() {
  if (location.hash !== address) return; // the address has changed in the meantime
  const set = changed_figures()
    .map(({ key, k }) => `${key}:${Number(state.figures[k].toFixed(4))}`)
    .join();
  const x =
    (moved() ? `&x=${Number(state.x.toFixed(4))}` : "") +
    (set && `&set=${encodeURIComponent(set)}`);
  try {
    history.replaceState(null, "", `#step=${state.step}${x}`);
  } catch {
    /* a page shown inside another may not */
  }
  address = location.hash;
}

/** Go to the step and position that the address gives. */
export function follow_address() {
  address = location.hash;
  const said = new URLSearchParams(address.slice(1));
  const x = Number.parseFloat(said.get("x"));
  const step = Number.parseInt(said.get("step"), 10) || 0;
  if (motion) reset_figures();
  for (const [key, value] of (said.get("set") ?? "").split(",").map(one => one.split(":"))) {
    const k = motion?.figures.findIndex(one => one.key === key) ?? -1;
    if (k >= 0 && Number.isFinite(Number(value))) keep_figure(k, Number(value));
  }
  if (motion) drive(Number.isFinite(x) ? x : led_to(changed_figures(), motion.start));
  show(step);
}
