// What a student has taken for a move, on the drawing, in lists or by typing, and the action it fits.
import { html_element } from "./elements.js";
import { byId } from "#page";
import {
  action_name,
  is_there,
  kinds_due,
  moves,
  number_field,
  picks,
  tell_hint,
  tell_turn,
  turn,
  turning,
  worded,
} from "#turn";
import { draw_move } from "./choosing.js";
import { shown_at, UNSEEN } from "./pick_shapes.js";
import { light_up } from "./turn_marks.js";

/** @type {(action: string | null) => string[][]} */
export const slots_of = action => (action ? turning.palette[action] : []);
export const is_complete = () =>
  slots_of(turn.action).length > 0 && slots_of(turn.action).every((_, i) => turn.inputs[i]);
export const fits = (action, key, slot) =>
  slots_of(action)[slot].includes(picks[key].kind) && is_there(key);

/** The inputs of an action from things taken; each takes the first open place, or in order the next one. */
function assigned(action, taken, in_order) {
  const inputs = [];
  for (const key of taken) {
    const slot = slots_of(action).findIndex(
      (_, i) => !inputs[i] && i >= (in_order ? inputs.length : 0) && fits(action, key, i),
    );
    if (slot < 0) return null;
    inputs[slot] = key;
  }
  return inputs;
}

/**
 * The actions that some things can be taken for: the chosen one, or else all others.
 * @param {string[]} taken
 * @returns {Way[]}
 */
export function ways_of(taken) {
  const own = turn.tool && assigned(turn.tool, taken, false);
  if (own) return [{ action: turn.tool, inputs: own }];
  const all = in_order =>
    Object.keys(turning.palette).flatMap(action => {
      const inputs = assigned(action, taken, in_order);
      return inputs ? [{ action, inputs }] : [];
    });
  const ordered = all(true);
  return ordered.length ? ordered : all(false);
}

/**
 * The one action for which everything is taken; none where others are left.
 * @param {Way[]} ways
 * @returns {Way | null}
 */
export function whole_way(ways) {
  const [way] = ways;
  return ways.length === 1 && slots_of(way.action).every((_, i) => way.inputs[i]) ? way : null;
}

/**
 * Take a thing for a move, and make the move once it has all that it needs.
 * @param {string} key
 */
export function take_pick(key) {
  if (turn.asked) forget_inputs();
  let taken = [...turn.taken, key],
    ways = ways_of(taken);
  if (!ways.length) [taken, ways] = [[key], ways_of([key])];
  turn.taken = taken;
  turn.wrong_line = null;
  const [way] = ways;
  [turn.action, turn.inputs] = ways.length === 1 ? [way.action, way.inputs] : [turn.tool, []];
  show_picks();
  if (whole_way(ways)) draw_move();
  else if (ways.length > 1)
    tell_turn(
      worded("either", {
        list: names_of(taken),
        actions: ways.map(each => action_name(each.action)).join(" · "),
      }),
    );
  else ask_inputs();
}

export const names_of = keys => keys.map(key => picks[key].name).join(", ");

/**
 * Choose an action, which stays chosen; what is taken already is kept where it fits.
 * @param {string} action
 */
export function choose_action(action) {
  const kept = turn.asked ? null : assigned(action, turn.taken, false);
  turn.tool = turn.tool === action && !turn.taken.length ? null : action;
  turn.taken = kept && turn.tool ? turn.taken : [];
  turn.inputs = turn.taken.length ? kept : [];
  turn.action = turn.tool;
  turn.asked = turn.wrong_line = null;
  show_picks();
  if (!turn.tool) tell_turn(worded("choose"));
  else if (is_complete()) draw_move();
  else ask_inputs();
}

/** The words for the inputs of an action. */
export const slot_words = (action = turn.action) =>
  byId("palette").querySelector(`[data-action="${action}"]`)?.dataset.slots.split("|") ?? [];

/** Name the inputs that the action still needs, or repeat the hint. */
function ask_inputs() {
  if (turn.hinted && turn.grade > 2 && moves[turn.hinted].action === turn.action)
    return tell_hint();
  if (turn.wrong) byId("turn-sentence").replaceChildren(); // the reason of an earlier choice
  tell_turn(slots_asked(turn.action, turn.inputs));
}

/** What an action starts from, in words, with the inputs that it has. */
export function slots_asked(action, inputs = []) {
  const list = slot_words(action)
    .map((word, i) => `${word} ${inputs[i] ? picks[inputs[i]].name : "…"}`)
    .join(", ");
  return worded("hint", { action: action_name(action), list });
}

/** Let go of everything taken; the chosen action stays. */
export function forget_inputs() {
  turn.action = turn.tool;
  turn.taken = [];
  turn.inputs = [];
  turn.asked = null;
  turn.aim = null;
  turn.wrong_line = null;
}

export function show_picks() {
  light_up();
  show_inputs();
}

/** Show the lists of possible inputs of the action, and the choice between two results. */
export function show_inputs() {
  for (const button of byId("palette").children) {
    button.setAttribute("aria-pressed", button.dataset.action === turn.tool);
    button.classList.toggle(
      "meant",
      button.dataset.action === turn.action && turn.action !== turn.tool,
    );
  }
  byId("inputs").replaceChildren(...slots_of(turn.action).map((_, i) => input_list(i)));
  byId("which").hidden = !turn.asked;
  byId("turn-panel").classList.toggle("taking", turn.taken.length > 0 || turn.asked !== null);
  show_chips();
  show_ready();
}

/** The list of what an input of the action may be. */
function input_list(i) {
  const label = html_element("label"),
    list = html_element("select");
  const keys = Object.keys(picks).filter(key => fits(turn.action, key, i));
  list.append(
    ...["", ...keys].map(key => new Option(key ? plain_words(picks[key].name) : "…", key)),
  );
  list.value = turn.inputs[i] ?? "";
  list.dataset.slot = i;
  list.addEventListener("change", () => {
    turn.inputs[i] = list.value;
    turn.taken = turn.inputs.filter(Boolean);
    turn.asked = null;
    byId("which").hidden = true;
    light_up();
    show_ready();
    ask_inputs();
  });
  label.append(slot_words()[i] ?? "", list, ...number_field(i));
  return label;
}

export function show_ready() {
  byId("turn-draw").hidden = !turn.action || Boolean(turn.asked);
  byId("turn-draw").disabled = !is_complete();
}

/** Offer what cannot be pointed at here as buttons: for the chosen action, and vectors of this part of the work. */
function show_chips() {
  const kinds = new Set([
    ...kinds_due().filter(kind => UNSEEN.includes(kind)),
    ...slots_of(turn.tool)
      .flat()
      .filter(kind => kind === "arrow"),
  ]);
  const keys = Object.keys(picks).filter(
    key =>
      kinds.has(picks[key].kind) &&
      is_there(key) &&
      !picks[key].typed &&
      (UNSEEN.includes(picks[key].kind) || !shown_at(key)),
  );
  const held = document.activeElement?.dataset.pick; // the focus stays where it is
  byId("chips").replaceChildren(
    ...keys.map(key => {
      const chip = html_element("button");
      chip.type = "button";
      chip.dataset.pick = key;
      chip.innerHTML = picks[key].name;
      chip.setAttribute("aria-pressed", turn.taken.includes(key));
      chip.addEventListener("click", () => take_pick(key));
      return chip;
    }),
  );
  if (held) byId("chips").querySelector(`[data-pick="${held}"]`)?.focus({ preventScroll: true });
}

/** Markup as plain text. */
export function plain_words(markup) {
  const words = html_element("span");
  words.innerHTML = markup;
  return words.textContent;
}
