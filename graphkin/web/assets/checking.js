// What a student draws is checked by its value; a right move is made, a wrong one answered.
import { html_element } from "./elements.js";
import { refuse_move, refuse_other, why_wrong } from "./answers.js";
import { keys_within } from "./choosing.js";
import { keep_past } from "./history.js";
import { byId, copies } from "./page.js";
import { named_from } from "./palette.js";
import { shown_at } from "./pick_shapes.js";
import { forget_inputs } from "./picking.js";
import { places } from "./sentences.js";
import { here } from "./sheets.js";
import { put_in } from "./turn_marks.js";
import {
  all_done,
  is_there,
  lines_alike,
  moves,
  moves_left,
  part_name,
  part_of,
  picks,
  plane_of,
  reasons_of,
  results_of,
  shape_of,
  show_turn,
  tell_turn,
  told_found,
  turn,
  turning,
  verdict,
  worded,
} from "./turn_state.js";
import { found } from "./values.js";

/**
 * Answer a move: make it where it is right, and say what is wrong elsewhere.
 * @param {string} action
 * @param {string[]} given
 * @param {Result[]} found
 * @param {number} plane
 * @param {Result} [other] the result that was not chosen
 */
export function check_move(action, given, found, plane, other) {
  const { is, step } = verdict({ action, given, found, plane, other }, turn.done, moves_left());
  const answers = {
    right: () => {
      const how = turn.hinted === step ? "hint" : "alone";
      make_move(step, how, worded("right", { name: moves[step].name }), { action, given });
    },
    already: () => refuse_move(worded("already", { name: moves[step].name })),
    other: () => refuse_other(step, action, found[0], plane, given),
    leads: () => keep_own(action, given, step),
    wrong: () => why_wrong(action, given, found, plane),
  };
  answers[is]();
}

/** Keep a line that no sentence draws but that passes through a wanted point; it can be picked. */
function keep_own(action, given, step) {
  keep_past();
  add_line(action, given, here());
  turn.fresh = [];
  forget_inputs();
  tell_turn(worded("own", { name: moves[step].name }));
  show_turn();
}

/**
 * Make a line drawn from some picks on a sheet available as a pick.
 * @param {string} action
 * @param {string[]} given
 * @param {number} sheet
 */
export function add_line(action, given, sheet) {
  const name = named_from(
      action,
      given.map(one => picks[one].name),
      turning.words,
    ),
    [value] = results_of(action, given);
  picks[`own${turn.lines.push([action, given, sheet])}`] = {
    kind: shape_of(action) === "circle" ? "circle" : "locus",
    name,
    plane: plane_of(action, given),
    needs: [],
    value,
    sheet,
  };
}

/** Draw the lines that no sentence draws. */
export function draw_own() {
  for (const key of Object.keys(picks).filter(one => one.startsWith("own") && is_there(one)))
    put_in("front", shown_at(key), "own");
}

/** The ways in which a move can be found, the least of a student's own work last. */
const HOW = ["alone", "hint", "help"];

/**
 * Record a move and draw what comes along with it.
 * @param {number} step
 * @param {string} how one of HOW
 * @param {string} words
 * @param {{ action: string, given?: string[] }} [way] the move as the student made it
 */
export function make_move(step, how, words, way = moves[step]) {
  const before = new Set(turn.done),
    { action } = moves[step];
  const at_keys = keys_within(),
    unknown = found.filter(row => row.matches(".unknown"));
  keep_past();
  turn.done.add(step);
  if (["line", "circle"].includes(shape_of(action)))
    lines_alike(step, turn.done).forEach(one => turn.done.add(one));
  turn.helped[step] = HOW[Math.max(HOW.indexOf(how), HOW.indexOf(turn.helped[step]))];
  turn.log.push({ step, how: turn.helped[step], wrong: turn.wrong });
  turn.wrong = 0;
  turn.hinted = null;
  const came = ([, needs]) =>
    needs.length && all_done(needs) && !needs.every(one => before.has(one));
  turn.fresh = [
    step,
    ...Object.entries(turning.along)
      .filter(came)
      .map(([one]) => Number(one)),
  ];
  const { sheet } = moves[step];
  turn.sheet = moves_left().some(one => moves[one].sheet === sheet) ? sheet : null; // until it is whole
  forget_inputs();
  const done = moves_left().every(one => part_of(one) !== part_of(step));
  tell_turn(done ? `${words} ${worded("part_drawn", { part: part_name(step) })}` : words);
  show_turn();
  explain_move(step, way, unknown);
  if (at_keys)
    byId("palette").querySelector(`[data-action=${action}]`).focus({ preventScroll: true });
}

/** Say what a move has found, its sentence, and the reason of the way taken. */
function explain_move(step, way, unknown) {
  const { at, action } = moves[step],
    sentence = html_element("p"),
    whole = !moves_left().some(one => moves[one].at === at);
  if (whole && way.action === action) sentence.append(...copies(places[at - 1].say));
  byId("turn-sentence").replaceChildren(
    ...told_found(unknown),
    sentence,
    ...reasons_of_way(step, way),
  );
}

/** The reasons of a move as it was made: those of its step, or of the other way that was taken. */
function reasons_of_way(step, { action, given }) {
  if (action === moves[step].action) return reasons_of(step);
  const key = `way_${action}`,
    line = html_element("p");
  if (!(key in turning.words)) return [];
  line.innerHTML = worded(key, {
    name: moves[step].name,
    p: place_named(given[0]),
    q: place_named(given[1]),
    r: picks[given[2]]?.name,
  });
  return [line];
}

/** The name of the point of the mechanism whose image a pick is. */
const place_named = image => picks[turning.places[image]?.[0]]?.name ?? "";
