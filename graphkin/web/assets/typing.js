// A move typed as it is written: "⊥ AB a", or with an ASCII word "perp AB a". What would come is shown before Enter.
import { byId } from "#page";
import {
  absent_names,
  action_name,
  is_letter,
  is_there,
  moves,
  picks,
  results_of,
  tell_turn,
  turn,
  turning,
  TYPED,
  typed_numbers,
  worded,
} from "#turn";
import { draw_move, settle_which } from "./choosing.js";
import { redo, undo } from "./history.js";
import {
  fits,
  forget_inputs,
  names_of,
  plain_words,
  show_picks,
  slots_asked,
  slots_of,
} from "./picking.js";
import { is_curve, show_aim } from "./pointing.js";

const PLAIN = { "°": "", "′": "'", "″": "''", ν: "n", τ: "t", ω: "w", ε: "e", "−": "-" };
export const typed_form = text =>
  text.replace(/[°′″ντωε−]/g, letter => PLAIN[letter]).replace(/[’]/g, "'");

const USUAL_POLES = { "1:": "o", "2:": "o'" }; // on a board, also where its school signs them otherwise

/** The ways in which a pick is written: its whole name, without words before it, or by the bar or guide of a line. */
function forms_of(key) {
  const { name, kind } = picks[key],
    made =
      moves[key]?.inputs ?? (key.startsWith("own") ? turn.lines[Number(key.slice(3)) - 1][1] : []);
  const whole = typed_form(plain_words(name)),
    short =
      ["locus", "circle"].includes(kind) && made[1]
        ? typed_form(plain_words(picks[made[1]].name))
        : whole;
  return [
    ...new Set(
      [whole, short, short.split(" ").at(-1), USUAL_POLES[key] ?? ""].map(form =>
        form.replaceAll(" ", ""),
      ),
    ),
  ].filter(Boolean);
}

/** The action that a typed line begins with, and the rest of the line. */
function split_action(text) {
  for (const [action, signs] of Object.entries(TYPED)) {
    if (!(action in turning.palette)) continue;
    const sign = signs.find(
      one => text.startsWith(one) && (!/\w$/.test(one) || !/^\w/.test(text.slice(one.length))),
    );
    if (sign) return [action, text.slice(sign.length)];
  }
  return [null, text];
}

/**
 * All that a typed text may name for an action: complete inputs, those that are drawn last first.
 * @param {string} action
 * @param {string} text
 * @param {boolean} in_order whether the inputs are named in the order of their words
 * @param {boolean} also_empty whether inputs count from which nothing can be drawn
 */
function readings(action, text, in_order, also_empty) {
  const found = [],
    slots = slots_of(action);
  const keys = Object.keys(picks)
    .filter(key => slots.some((_, i) => fits(action, key, i)))
    .reverse();
  const named = keys
    .flatMap(key => forms_of(key).map(form => [key, form]))
    .sort((a, b) => b[1].length - a[1].length);
  const read = (rest, inputs) => {
    const left = rest.trimStart();
    if (found.length > 20) return;
    if (!left) return void (slots.every((_, i) => inputs[i]) && found.push(inputs));
    for (const [key, form] of [...named, ...typed_numbers(left)]) {
      const end = written_length(left, form),
        free = slots.map((_, i) => i).filter(i => !inputs[i]);
      if (!end) continue;
      const slot = (in_order ? free.slice(0, 1) : free).find(i => fits(action, key, i));
      if (slot !== undefined) read(left.slice(end), Object.assign([...inputs], { [slot]: key }));
    }
  };
  read(text, []);
  const is_drawn = inputs =>
    results_of(action, inputs).length > 0 &&
    (action !== "cut" || picks[inputs[0]].plane === picks[inputs[1]].plane);
  return [...found.filter(is_drawn), ...found.filter(inputs => also_empty && !is_drawn(inputs))];
}

/** How much of a text a form of a name takes, blanks left out; 0 where the text begins otherwise. */
function written_length(text, form) {
  let end = 0;
  for (const letter of form) {
    while (end && text[end] === " ") end += 1;
    if (text[end] !== letter) return 0;
    end += 1;
  }
  return end;
}

/** The lines or arcs drawn last of which no point is found yet. */
function open_pair() {
  const drawn = [
    ...Object.keys(picks).filter(key => key.startsWith("own")),
    ...turn.log.map(({ step }) => String(step)), // before lines of one's own
  ].filter(key => picks[key] && is_curve(key));
  const cut_already = turn.lines
    .filter(([action]) => action === "cut")
    .flatMap(([, given]) => given);
  const used = new Set([
    ...cut_already,
    ...[...turn.done]
      .filter(step => moves[step]?.action === "cut")
      .flatMap(step => moves[step].inputs),
  ]);
  const free = drawn.filter(key => !used.has(key)).reverse(),
    last = free.find(key =>
      free.some(other => other !== key && picks[other].plane === picks[key].plane),
    );
  const other = free.find(key => key !== last && picks[key].plane === picks[last]?.plane);
  return other ? [other, last] : null;
}

/**
 * The moves that a typed line may mean: one that is meant, several that would fit, or none.
 * @param {string} line
 * @returns {Way[]}
 */
function typed_ways(line) {
  const [action, rest] = split_action(typed_form(line).trim());
  if (action === "cut" && !rest.trim()) {
    const pair = open_pair();
    return pair ? [{ action, inputs: pair }] : [];
  }
  if (!rest.trim()) return [];
  const of = (one, in_order) =>
    readings(one, rest, in_order, action !== null)
      .slice(0, 1)
      .map(inputs => ({ action: one, inputs }));
  if (action) return [of(action, true), of(action, false)].find(ways => ways.length) ?? [];
  const own = in_order => (turn.tool ? of(turn.tool, in_order) : []);
  const all = Object.keys(turning.palette).flatMap(one => of(one, true)),
    least = Math.min(...all.map(({ inputs }) => inputs.length));
  const others = all.filter(({ inputs }) => inputs.length === least),
    alone = others.length === 1 ? others : []; // long names before many
  const [way] = [...own(true), ...alone, ...own(false)]; // what is written in the order of its words goes first
  return way ? [way] : others;
}

/** Whether lines can be typed here: where only fingers point, the field is hidden. */
export const is_typed_here = () => byId("turn-type").checkVisibility();

/** Show on the drawing and in words what a typed line would draw. */
export function show_typed() {
  const ways = typed_ways(byId("turn-typed").value);
  show_aim(ways.length ? { ways: ways.slice(0, 1) } : null);
  const offers = ways.map(each => `${action_name(each.action)}: ${names_of(each.inputs)}`);
  byId("turn-would").innerHTML = offers.join(" · ");
}

/** Make the move that is typed; the action stays chosen for lines typed without one. */
export function draw_typed() {
  const { value } = byId("turn-typed"),
    ways = typed_ways(value),
    [way] = ways;
  if (!value.trim() || is_letter(value)) return;
  if (!way) {
    byId("turn-typed").select();
    byId("turn-sentence").replaceChildren(); // the reason of an earlier move
    return tell_turn(why_unread(value));
  }
  if (ways.length > 1) {
    const actions = ways.map(each => action_name(each.action)).join(" · ");
    return tell_turn(worded("either", { list: names_of(way.inputs), actions }));
  }
  if (split_action(typed_form(value).trim())[0] && STICKS.includes(way.action))
    turn.tool = way.action;
  forget_typed();
  turn.asked = turn.wrong_line = null;
  turn.taken = way.inputs;
  [turn.action, turn.inputs] = [way.action, way.inputs];
  show_picks();
  draw_move();
}

/** Why a typed line draws nothing: a name of nothing, a thing that is not drawn yet, or inputs that do not fit. */
function why_unread(line) {
  const [action, rest] = split_action(typed_form(line).trim());
  const there = Object.keys(picks)
    .filter(is_there)
    .flatMap(key => forms_of(key).map(form => [form, ""]));
  const absent = absent_names().map(name => [
    typed_form(plain_words(name)).replaceAll(" ", ""),
    name,
  ]);
  let left = rest.trimStart();
  while (left) {
    const [word] = left.split(" "),
      numbers = typed_numbers(left).map(([, form]) => [form, ""]);
    const [end, name] = [word, left]
      .map(text =>
        [...there, ...numbers, ...absent]
          .map(([form, name]) => [written_length(text, form), name])
          .reduce((a, b) => (b[0] > a[0] ? b : a), [0, ""]),
      )
      .reduce((a, b) => (a[0] ? a : b));
    if (name) return worded("undrawn", { name });
    if (!end) return worded("unread", { text: escaped(word) });
    left = left.slice(end).trimStart();
  }
  if (!action) return worded("unread", { text: escaped(line) });
  return `${rest.trim() ? worded("unfit") : ""} ${slots_asked(action)}`.trim();
}

const STICKS = ["perpendicular", "parallel", "triangle", "compass"]; // of which several are drawn one after the other

/** A text as markup. */
export const escaped = text => text.replace(/[&<>"]/g, sign => `&#${sign.charCodeAt(0)};`);

export function forget_typed() {
  byId("turn-typed").value = "";
  byId("turn-would").textContent = "";
}

/** Keys during a turn that are no text: undo and redo, the choice of two, Escape; letters go to the typed line. */
export function key_in_turn(event) {
  const { key, target } = event,
    field = byId("turn-typed");
  const with_command = event.ctrlKey || event.metaKey,
    writing = target === field && field.value !== "";
  const act = act_of_key(event, with_command, writing) ?? (key === "Escape" ? leave_taken : null);
  if (act) {
    event.preventDefault();
    act();
    return;
  }
  const is_letter_key = key.length === 1 && key !== " " && !with_command && !event.altKey;
  if (is_letter_key && !target.closest("input,select,textarea,svg")) {
    byId("turn-type").classList.add("keyed"); // there is a keyboard, also where only fingers point
    field.focus({ preventScroll: true }); // the letter is written there
  }
}

/** What a key does while nothing is being written: undo and redo, or the choice of a result. */
function act_of_key({ key, shiftKey, altKey }, with_command, writing) {
  if (writing) return null;
  if (with_command)
    return altKey ? null : { z: shiftKey ? redo : undo, y: redo }[key.toLowerCase()];
  return turn.asked?.[Number(key) - 1] ? () => settle_which(Number(key) - 1) : null;
}

function leave_taken() {
  forget_typed();
  forget_inputs();
  show_picks();
}
