// Keys, buttons, sliders, marks and the window; at the end, the start of the page.
import { follow_address } from "./address.js";
import { point_at } from "./aiming.js";
import { listen_to_turn } from "./your_turn.js";
import { show_task } from "./beginning.js";
import { drive, driver, move } from "./driver.js";
import { reset_figures } from "./figures.js";
import { byId, data, follow, last, motion, play, slider, SMALL, state } from "./page.js";
import { toggle } from "./playing.js";
import { fit } from "./room.js";
import { light, opened_by_hand, places, reason_in_sight, stop_list, stops } from "./sentences.js";
import { sheets } from "./sheets.js";
import { go } from "./stepping.js";
import { rest_from_travel, travel, traveller } from "./travel.js";
import { recall_turn } from "./turn_state.js";
import { next_frame, see } from "./view.js";
import { look, whole, zoom } from "./zoom.js";

function key(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const at = event.target;
  if (at.matches("input:not([type=range]),select,textarea")) return;
  const range = at.matches("input[type=range]"),
    pressed = at.matches("button,a,summary");
  const stop = event.key === "0" ? 0 : data.stops[Number(event.key) - 1];
  const act =
    {
      ArrowLeft: range ? null : () => go(state.step - 1),
      ArrowRight: range ? null : () => go(state.step + 1),
      Home: range ? null : () => go(0),
      End: range ? null : () => go(last),
      " ": pressed ? null : toggle,
      z: zoom,
      m: motion ? travel : null,
    }[event.key] ?? (stop === undefined ? null : () => go(stop));
  if (!act) return;
  event.preventDefault();
  act();
}

show_task();
listen_to_turn();
document.addEventListener("keydown", key);
slider.addEventListener("input", () => go(Number(slider.value)));
byId("previous").addEventListener("click", () => go(state.step - 1));
byId("next").addEventListener("click", () => go(state.step + 1));
play.addEventListener("click", toggle);
follow.addEventListener("click", zoom);
for (const stop of stops) stop.addEventListener("click", () => go(Number(stop.dataset.stop)));
stop_list.addEventListener("change", () => go(Number(stop_list.value)));
places.forEach(({ link }, i) =>
  link.addEventListener("click", event => {
    event.preventDefault();
    go(i + 1);
  }),
);
if (motion) {
  const follow_slider = () => move(Number(driver.value));
  driver.addEventListener("input", () => {
    rest_from_travel();
    next_frame(follow_slider);
  });
  traveller.addEventListener("click", travel);
  byId("back").addEventListener("click", () => {
    rest_from_travel();
    sheets.forEach(({ fields }) => fields.forEach(one => see(one, null)));
    reset_figures();
    drive(motion.start, true);
  });
}
for (const sign of ["pointerover", "focusin"]) byId("reason").addEventListener(sign, light);
byId("reason").addEventListener("pointerleave", () => point_at(null));
for (const part of ["reason", "from"]) {
  // the sources of a reason stay named while the focus is there
  byId(part).addEventListener(
    "focusout",
    ({ relatedTarget: to }) =>
      /** @type {Element} */ (to)?.closest("#reason,#from") || point_at(null),
  );
}
addEventListener("hashchange", follow_address);
addEventListener("resize", fit);
addEventListener("beforeprint", whole);
addEventListener("afterprint", () => look());
byId("because").open = !SMALL.matches;
byId("because").addEventListener("toggle", reason_in_sight);
byId("because").querySelector("summary").addEventListener("click", opened_by_hand);
follow_address();
fit();
if (byId("turn")) recall_turn();
