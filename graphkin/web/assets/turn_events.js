// Keys and pointers while something is drawn: they belong to the drawing before all else.
import { turn } from "#turn";
import { hits_at, point_in_turn, press, show_aim, spot_at } from "./pointing.js";
import { key_in_turn } from "./typing.js";

/** During a turn, keep keys and pointers on the drawing from other handlers. */
export function in_turn(event) {
  if (!turn) return;
  if (event.type === "keydown") typed_in_turn(event);
  else if (event.type.startsWith("pointer") && event.type !== "pointerover") pointed_in_turn(event);
  else if (is_on_drawing(event) && !fits_all(event)) event.stopPropagation();
}

const is_on_drawing = ({ target }) => Boolean(target.closest?.(".sheet"));

/** Whether an event means nothing but the whole field. */
const fits_all = event => event.type === "dblclick" && !hits_at(spot_at(event)).length;

function typed_in_turn(event) {
  const zooms = event.target.closest?.("svg") && ["+", "=", "-", "0"].includes(event.key);
  if (event.key === "F5" || zooms) return;
  event.stopPropagation();
  key_in_turn(event);
}

function pointed_in_turn(event) {
  const drawing = is_on_drawing(event);
  if ((drawing || press) && point_in_turn(event)) event.stopPropagation();
  if (!drawing && !press && turn.aim && event.type === "pointermove") show_aim(null);
}

export const EVENTS = [
  "keydown",
  "click",
  "dblclick",
  "pointerover",
  "pointerdown",
  "pointermove",
  "pointerup",
  "pointercancel",
];
