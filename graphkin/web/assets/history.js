// Undo and redo during a turn: every move can be taken back; how it was found stays counted.
import { byId } from "#page";
import { add_line, picks, show_turn, tell_turn, turn, worded } from "#turn";
import { forget_inputs } from "./picking.js";

/** What a move changes. */
const drawn_so_far = () => ({ done: [...turn.done], log: [...turn.log], lines: [...turn.lines] });

/** Note what is drawn before a move changes it. */
export function keep_past() {
  turn.past.push(drawn_so_far());
  turn.future = [];
}

/** Go back by one move, or on again by one that was taken back. */
function step_in_time(from, to) {
  if (!turn[from].length) return;
  turn[to].push(drawn_so_far());
  const { done, log, lines } = turn[from].pop();
  forget_own_lines();
  Object.assign(turn, {
    done: new Set(done),
    log: [...log],
    lines: [],
    fresh: [],
    sheet: null,
    hinted: null,
  });
  for (const [action, given, which] of lines) add_line(action, given, which);
  forget_inputs();
  byId("turn-sentence").replaceChildren();
  tell_turn(worded(from === "past" ? "undone" : "redone", { number: turn.log.length }));
  show_turn();
}

export const undo = () => step_in_time("past", "future");
export const redo = () => step_in_time("future", "past");

/** Take the lines that no sentence draws off the picks. */
export function forget_own_lines() {
  for (const key of Object.keys(picks)) if (key.startsWith("own")) delete picks[key];
}

/** Offer to go back and on, where there is anything. */
export function show_time() {
  byId("turn-undo").disabled = !turn.past.length;
  byId("turn-redo").disabled = !turn.future.length;
}
