// An action with all its inputs is drawn; of two results the student chooses one.
import { byId } from "#page";
import {
  check_move,
  CHOICE,
  choices_of,
  likewise,
  picks,
  plane_of,
  results_of,
  same_value,
  tell_turn,
  turn,
  worded,
} from "#turn";
import { is_complete, show_picks, slots_of } from "./picking.js";

export function draw_move() {
  if (!is_complete()) return;
  const { action } = turn,
    given = turn.inputs.slice(0, slots_of(action).length),
    plane = plane_of(action, given);
  const found = results_of(action, given);
  const apart = action === "cut" && picks[given[0]].plane !== picks[given[1]].plane;
  const choices = different(action, choices_of(action, given), plane);
  if (CHOICE.includes(action) && choices.length > 1 && !apart) {
    const at_keys = keys_within();
    turn.asked = Object.assign(choices, { plane, given });
    tell_turn(worded("which"));
    byId("turn-sentence").replaceChildren(); // what an earlier move has found
    show_picks();
    if (at_keys) byId("which").querySelector("button").focus({ preventScroll: true });
    return;
  }
  check_move(action, given, found, plane);
}

export const different = (action, found, plane) =>
  found.filter((one, i) => found.findIndex(other => same_value(action, one, other, plane)) === i);

/** Go on with the result that the student has chosen out of two. */
export function settle_which(which) {
  const { given, plane } = turn.asked,
    { action } = turn,
    found = likewise(action, given, turn.asked[which]),
    other = turn.asked[1 - which];
  if (keys_within()) byId("inputs").querySelector("select").focus({ preventScroll: true });
  turn.asked = null;
  check_move(action, given, found, plane, other);
}

/** Whether the keyboard focus is in the lists, where it must stay. */
export const keys_within = () => byId("turn-form").contains(document.activeElement);
