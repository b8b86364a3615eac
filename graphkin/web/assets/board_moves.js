// Moves on the board: whatever can be drawn is drawn, and nothing says whether it is right.
import { html_element } from "./elements.js";
import { show_turn } from "./board_marks.js";
import { data } from "./board_page.js";
import {
  action_name,
  add_line,
  lettered,
  log_of,
  MOST_MOVES,
  MOST_SIGNS,
  number_key,
  picks,
  results_of,
  same_value,
  shape_of,
  tell_turn,
  turn,
  turning,
  UNITS,
  worded,
} from "./board_state.js";
import { keep_past } from "./history.js";
import {
  forget_inputs,
  is_complete,
  names_of,
  plain_words,
  show_ready,
  slot_words,
  slots_of,
} from "./picking.js";
import { show_aim } from "./pointing.js";
import { forget_typed, typed_form } from "./typing.js";

/**
 * Draw a move whose inputs are complete.
 * @param {string} action
 * @param {string[]} given
 * @param {Result[]} found
 * @param {number} plane
 * @param {Result} [_other] any result may be drawn
 */
export function check_move(action, given, found, plane, _other) {
  const why = why_nothing(action, given),
    [value] = found;
  if (!value || why === "apart") return refuse_nothing(action, given, why);
  const same = Object.keys(picks).find(
    key => key.startsWith("own") && is_same(picks[key], action, plane, value),
  );
  if (same) {
    forget_inputs();
    turn.fresh = [same];
    tell_turn(worded("already", { name: picks[same].name }));
    return show_turn();
  }
  const all = results_of(action, given);
  make_move(
    action,
    given,
    all.findIndex(one => same_value(action, one, value, plane)),
  );
}

/**
 * The key of the reason why nothing can be drawn; empty where there is nothing to say.
 * @param {string} action
 * @param {string[]} given
 */
function why_nothing(action, given) {
  const plane = place => picks[given[place]].plane;
  if (turning.beside[action]?.some(place => plane(place) !== plane(place - 1))) return "apart";
  if (action === "cut" && given[0] !== given[1]) {
    return given.some(key => picks[key].kind === "circle") ? "unmet" : "parallel";
  }
  const named = key => turning.places[key]?.length;
  if (action === "similar" && !given.slice(0, 2).every(named)) return "unlettered";
  return action === "triangle" ? "askew" : "";
}

/** Say that nothing can be drawn, and why. */
function refuse_nothing(action, given, why) {
  const said = worded("nothing", { action: action_name(action), list: names_of(given) });
  refuse(why ? `${said} ${worded(why)}` : said);
}

/** Whether a thing is what an action would draw. */
function is_same(pick, action, plane, value) {
  const shape = pick.kind === "locus" ? "line" : pick.kind === "circle" ? "circle" : "point";
  return (
    pick.plane === plane &&
    shape === shape_of(action) &&
    same_value(action, value, pick.value, plane)
  );
}

/** Make a move and say what it has drawn. */
export function make_move(action, given, which) {
  if (turn.lines.length >= MOST_MOVES || log_of().length > MOST_SIGNS - 200)
    return refuse(worded("full"));
  keep_past();
  const key = add_line(action, given, which);
  turn.log.push({});
  turn.fresh = [action === "name" ? given[0] : key];
  forget_inputs();
  const { name, kind } = picks[turn.fresh[0]],
    is_new = ["point", "image"].includes(kind) && action !== "name";
  tell_turn(is_new ? worded("which_letter") : worded("drawn", { name }));
  show_turn();
  if (action === "name") say_right(given[1], given[0]);
}

/** Say whether a lettered point is right, where the lab lets its pages do so. */
async function say_right(letter, key) {
  const { digests } = data,
    { name, value, plane } = picks[key];
  if (!digests?.of[letter] || !crypto.subtle) return;
  const cells = [0, 1].map(k =>
    [-0.5, 0.5].map(off => Math.round(value[k] / data.millimetre[plane] / digests.grid + off)),
  );
  const found = await Promise.all(
    cells[0].flatMap(u => cells[1].map(v => digest_of(`${letter} ${u} ${v}`, digests))),
  );
  if (turn.fresh.includes(key))
    tell_turn(worded(found.includes(digests.of[letter]) ? "right" : "elsewhere", { name }));
}

/** The digest of a cell, as Python makes it. */
async function digest_of(text, { salt, rounds }) {
  const bytes = one => new TextEncoder().encode(one),
    from = await crypto.subtle.importKey("raw", bytes(text), "PBKDF2", false, ["deriveBits"]);
  const found = await crypto.subtle.deriveBits(
    { name: "PBKDF2", hash: "SHA-256", salt: bytes(salt), iterations: rounds },
    from,
    64,
  );
  return [...new Uint8Array(found)].map(byte => byte.toString(16).padStart(2, "0")).join("");
}

/** A task page gives no hints. */
export const tell_hint = () => {};

function refuse(text) {
  forget_inputs();
  tell_turn(text);
  show_turn();
}

/** The point that a letter would be given to: the one that is taken, or the one drawn last. */
export function point_to_name() {
  const [key] = (turn.taken.length === 1 ? turn.taken : turn.fresh).map(String);
  return key?.startsWith("own") && ["point", "image"].includes(picks[key]?.kind) ? key : null;
}

/** The letters that a point can still have. */
export function letters_for(key) {
  const points = lettered();
  return Object.entries(turning.letters).filter(
    ([letter, { plane }]) => plane === picks[key].plane && !points[letter],
  );
}

/** Give a letter to the point drawn last, if a typed line is one; returns whether it was. */
export function is_letter(text) {
  const key = point_to_name(),
    written = typed_form(text).replaceAll(" ", "");
  const [letter] =
    (key ? letters_for(key) : []).find(
      ([, { name }]) => typed_form(plain_words(name)).replaceAll(" ", "") === written,
    ) ?? [];
  if (!letter) return false;
  forget_typed();
  make_move("name", [key, letter]);
  return true;
}

/** The numbers that a typed line goes on with: lengths, angles and rates. */
export function typed_numbers(text) {
  const [found] = /^[-−]?\d+(?:[.,]\d+)?/.exec(text) ?? [];
  return found
    ? Object.keys(UNITS)
        .map(kind => [number_key(found, [kind]), found])
        .filter(([key]) => key)
    : [];
}

/** A field in which the number of an input is typed, for an input that may be one. */
export function number_field(i) {
  const kinds = slots_of(turn.action)[i],
    kind = kinds.find(one => UNITS[one]),
    field = html_element("input");
  if (!kind) return [];
  field.inputMode = "decimal";
  field.autocomplete = "off";
  field.setAttribute("aria-label", `${slot_words()[i]}, ${UNITS[kind][1]}`);
  field.placeholder = UNITS[kind][1];
  field.addEventListener("input", () => {
    const key = number_key(field.value, kinds);
    turn.inputs[i] = key ?? undefined;
    turn.taken = turn.inputs.filter(Boolean);
    show_ready();
    show_aim(is_complete() ? { ways: [{ action: turn.action, inputs: turn.inputs }] } : null);
  });
  return [field];
}
