// The state of a student's turn: what is done, what is left, and how it is shown.
import { html_element } from "./elements.js";
import { carry } from "./carried.js";
import { add_line } from "./checking.js";
import { drive } from "./driver.js";
import { reset_figures } from "./figures.js";
import { forget_own_lines, show_time } from "./history.js";
import { show_levels } from "./levels.js";
import { byId, copies, data, follow, motion, moved, own, page, state } from "./page.js";
import { verdicts_of } from "./judging.js";
import { palette_of } from "./palette.js";
import { forget_inputs, show_inputs } from "./picking.js";
import { called, pause } from "./playing.js";
import { fit } from "./room.js";
import { places, stops } from "./sentences.js";
import { here, sheets } from "./sheets.js";
import { show } from "./stepping.js";
import { light_up } from "./turn_marks.js";
import { asked, found } from "./values.js";
import { show_score } from "./your_turn.js";
import { look, put } from "./zoom.js";
import { ACTIONS, drawn_by } from "./page_actions.js";

/** @type {TurnRecord} */
export const turning = JSON.parse(byId("turning").textContent);
export const { moves, picks } = turning;
export const ORDER = Object.keys(moves)
  .map(Number)
  .sort((a, b) => moves[a].at - moves[b].at || a - b);

const palette = palette_of(turning, steps => all_done(steps), { ACTIONS, drawn_by });
export const {
  plus,
  minus,
  scaled,
  dot,
  cross,
  cuts: cut_at,
  length_of,
  value_of,
  plane_of,
  results_of,
  choices_of,
  likewise,
  same_value,
  on_line,
  shape_of,
  size_of,
  SAME,
} = palette;
export const { own_inputs, verdict, lines_alike } = verdicts_of(turning, palette, ORDER);
for (const move of Object.values(moves))
  move.sheet = data.bounds.findIndex(([, end]) => move.at <= end);
export const CHOICE = ["cut", "lay_off"]; // actions for which the student chooses between two results
export const NUMBERS_PLANE = 3; // what is computed lies in no drawing

/** @type {Turn | null} */
export let turn = null;
/** @type {Turn | null} */
let left_turn = null; // the current turn with its moves and picks; a turn that was left
export const all_done = steps => steps.every(step => turn.done.has(step));
export const is_there = key =>
  all_done(picks[key].needs) && !picks[key].by && here() === (picks[key].sheet ?? here());
/** The names of the things that are not drawn yet. */
export const absent_names = () =>
  Object.keys(picks)
    .filter(key => !is_there(key))
    .map(key => picks[key].name);
const open_goals = () => ORDER.filter(step => moves[step].goal && !turn.done.has(step));

/** The moves still to be made: the goals, and the moves that goals need. */
export function moves_left() {
  const found = new Set(),
    waiting = open_goals();
  while (waiting.length) {
    const step = waiting.pop();
    if (found.has(step) || turn.done.has(step)) continue;
    found.add(step);
    waiting.push(...moves[step].needs);
  }
  return ORDER.filter(step => found.has(step));
}

export const next_move = () => moves_left().find(step => all_done(moves[step].needs));

/** The kinds of things that this part of the work still needs. */
export const kinds_due = () =>
  moves_left()
    .filter(step => part_of(step) === part_of(next_move()))
    .flatMap(step => moves[step].inputs.map(key => picks[key].kind));
// Here nothing is typed but moves: no numbers and no letters.
/** @type {(text: string) => [string, string][]} */
export const typed_numbers = () => [];
/** @type {(slot: number) => HTMLInputElement[]} */
export const number_field = () => [];
/** @type {(text: string) => boolean} */
export const is_letter = () => false;

/** A message of the page with names filled in; the names are markup, escaped by their maker. */
export const worded = (key, fields = null) =>
  turning.words[key].replace(/\{(\w+)\}/g, (gap, name) => fields?.[name] ?? gap);
export const tell_turn = text => {
  turn.sure = false;
  byId("turn-say").innerHTML = text.replace(/^\p{Ll}/u, first => first.toUpperCase());
};
export const action_name = action =>
  byId("palette").querySelector(`[data-action=${action}]`).textContent;

/** Resume the turn that was left, or begin one at the current step. */
export function begin_turn() {
  pause();
  state.over = null;
  carry([]);
  if (motion && moved()) {
    reset_figures();
    drive(motion.start);
  }
  const came = state.step;
  if (left_turn) turn = Object.assign(left_turn, { came });
  else new_turn(came);
  page.classList.add("turning");
  byId("turn-panel").hidden = false;
  turn.near = follow.getAttribute("aria-pressed") === "true";
  if (turn.near) follow.click(); // everything still to be drawn must be in sight
  tell_turn(worded("begin"));
  show_turn();
  fit();
  byId("palette").firstElementChild.focus({ preventScroll: true });
}

/** Begin a turn at a step, with nothing drawn from there on. */
function new_turn(came) {
  forget_own_lines();
  const done = new Set(ORDER.filter(step => moves[step].at < came)),
    taking = { tool: null, action: null, taken: [], inputs: [], asked: null, aim: null };
  turn = {
    done,
    from: came,
    came,
    near: turn?.near,
    log: [],
    lines: [],
    wrong: 0,
    hinted: null,
    grade: 0,
    helped: {},
    past: [],
    future: [],
    fresh: [],
    open: new Set(),
    sheet: null,
    wrong_line: null,
    ...taking,
  };
  byId("score").hidden = byId("turn-save").hidden = true;
  byId("turn-sentence").replaceChildren();
}

/** On the second request, discard the turn and begin at the step shown before it. */
export function turn_again() {
  const { sure } = turn;
  if (sure) new_turn(turn.came);
  tell_turn(worded(sure ? "begin" : "sure"));
  turn.sure = !sure;
  if (sure) show_turn();
}

/** Whether the turn holds anything that would be lost. */
const is_begun = one => one.log.length + one.lines.length + one.wrong + one.past.length > 0;

const MEMORY = `graphkin turn ${[...byId("turning").textContent].reduce((sum, letter) => (Math.imul(31, sum) + letter.codePointAt(0)) | 0, 7)}`; // equal pages share it

/** Store the turn in this browser, if allowed, for when the page is opened again. */
function keep_turn() {
  const one = turn ?? left_turn;
  try {
    if (!one || !is_begun(one)) return localStorage.removeItem(MEMORY);
    const { done, from, log, lines, wrong, hinted, grade, helped, past, future } = one;
    localStorage.setItem(
      MEMORY,
      JSON.stringify({
        done: [...done],
        from,
        log,
        lines,
        wrong,
        hinted,
        grade,
        helped,
        past,
        future,
        open: turn !== null,
      }),
    );
  } catch {
    /* it is lost with the page */
  }
}

/** Restore the stored turn of this page, and resume it if the page was left during the turn. */
export function recall_turn() {
  try {
    const { done, lines, open, ...kept } = JSON.parse(localStorage.getItem(MEMORY));
    new_turn(kept.from);
    Object.assign(turn, kept, { done: new Set(done) });
    for (const [action, given, which] of lines) add_line(action, given, which);
    left_turn = turn;
    turn = null;
    call_turn();
    if (open) begin_turn();
  } catch {
    turn = left_turn = null; // there is none, or it belongs to another page
  }
}

/** Set the label of the turn button: begin or resume. */
const call_turn = () => called(byId("turn"), byId("turn").dataset[left_turn ? "resume" : "begin"]);

/** Leave the turn; what is drawn is kept. */
export function end_turn() {
  const { came, near } = turn;
  forget_inputs();
  left_turn = is_begun(turn) ? turn : null;
  call_turn();
  turn = null;
  keep_turn();
  page.classList.remove("turning");
  byId("turn-panel").hidden = true;
  if (near) follow.click();
  show(came);
  fit();
  byId("turn").focus({ preventScroll: true });
}

/** Show what is done, on the sheet of the next step. */
export function show_turn() {
  const next = next_move(),
    rest = moves_left();
  const sheet = turn.sheet ?? (next === undefined ? sheets.length - 1 : moves[next].sheet);
  const [first, end] = data.bounds[sheet],
    is_next = next !== undefined && moves[next].sheet === sheet;
  state.step = Math.max(first, is_next ? moves[next].at : end);
  sheets.forEach(({ element }, i) => {
    element.hidden = i !== sheet;
  });
  show_drawn(sheets[sheet], rest);
  tell_count(next, rest);
  byId("turn-sheet").hidden = sheets.length < 2;
  for (const name of ["hint", "draw-it"]) byId(name).disabled = next === undefined;
  if (motion) put(); // labels make room for new ones
  look();
  light_up();
  show_inputs();
  show_again();
  const level = show_levels();
  if (next === undefined || !byId("score").hidden) show_score();
  if (level && turn.log.length) byId("turn-say").innerHTML += ` ${worded("reached", level)}`;
}

/** Show the marks of a sheet that are drawn while some moves are left, and the values found. */
function show_drawn(sheet, rest) {
  const open = Math.min(...rest.map(step => moves[step].at), Infinity);
  turn.open = new Set(rest.flatMap(step => moves[step].needs).filter(is_open_line));
  for (const mark of sheet.marks) {
    mark.classList.toggle("later", !is_seen(mark, open));
    mark.classList.toggle("now", turn.fresh.includes(Number(mark.dataset.of)));
    mark.classList.remove("rest");
  }
  for (const key of rest.flatMap(step => moves[step].inputs)) {
    // such as the ray at the crank's angle
    const unseen = () => sheet.of.get(key)?.every(mark => mark.matches(".later"));
    const is_guide = picks[key].kind === "guide" && Number(key) && is_there(key);
    if (is_guide && unseen()) turn.open.add(Number(key));
  }
  for (const part of sheet.parts) part.classList.toggle("later", Number(part.dataset.from) >= open);
  for (const row of found) row.classList.toggle("unknown", !is_found(Number(row.dataset.found)));
  sheet.element.classList.remove("growing");
}

/** Whether a step is a drawn line or circle. */
const is_open_line = step =>
  turn.done.has(step) && ["line", "circle"].includes(shape_of(moves[step].action));

/** Store the turn, and offer to begin again. */
export function show_again() {
  byId("turn-again").hidden = !is_begun(turn);
  byId("turn-again").textContent = worded("again", { number: Math.max(turn.came, 1) });
  show_time();
  keep_turn();
}

/** Whether a sentence is done: all that it draws, and the vectors of its rates, are drawn. */
function is_found(at) {
  const drawn = ORDER.filter(step => moves[step].at === at),
    read = (data.rates[at] ?? []).flatMap(({ vector }) => vector ?? []);
  const steps = [...drawn, ...own[at], ...read]
    .map(String)
    .filter(step => !["line", "circle"].includes(shape_of(moves[step]?.action))); // there may be other ways
  return steps.length ? steps.every(is_drawn) : moves_left().every(step => moves[step].at > at);
}

/** Whether a step is drawn, as a move or along with moves. */
const is_drawn = step =>
  moves[step] ? turn.done.has(Number(step)) : all_done(turning.along[step] ?? []);

/** The results that a move has found, with their length in the plan. */
export function told_found(rows) {
  return rows
    .filter(row => !row.matches(".unknown"))
    .map(row => {
      const line = html_element("p"),
        cells = [...row.cells],
        table = row.closest("table"),
        vector = table.matches(".vectors");
      line.className = "found";
      line.append(asked(cells, true));
      if (vector)
        line.append(
          " (",
          ...copies(cells[1]),
          " = ",
          ...copies(cells[2]),
          " ",
          ...copies(table.tHead.rows[0].cells[2]),
          ")",
        );
      return line;
    });
}

/** The part of the work of a step, by its button. */
export const part_of = step => stops.find(({ dataset }) => moves[step].at <= Number(dataset.end));
export const part_name = step => part_of(step).lastChild.textContent.trim();

/** Show the next goal and the number of steps left, in this part of the work and in all. */
function tell_count(next, rest) {
  const [goal] = open_goals(),
    left = rest.filter(step => part_of(step) === part_of(next)).length;
  byId("turn-count").innerHTML =
    next === undefined
      ? ""
      : worded("count", {
          part: part_name(next),
          left,
          number: rest.length,
          name: called_goal(goal),
        });
}

/** The name of a goal, with the vector from the pole of its plan. */
function called_goal(goal) {
  const { name } = moves[goal],
    arrow = Object.values(picks).find(
      ({ kind, on }) => kind === "arrow" && on[1] === goal && !picks[on[0]]?.needs.length,
    );
  return arrow ? `${name} (${picks[arrow.on[0]].name}${name} = ${arrow.name})` : name;
}

/** The reasons of a step, or those of its sentence if it has none. */
export function reasons_of(step) {
  const all = [...(places[moves[step].at - 1].why?.children ?? [])],
    own = all.filter(({ dataset }) => Number(dataset.for) === step);
  return (own.length ? own : all).map(reason => {
    const line = html_element("p");
    line.append(...copies(reason));
    return line;
  });
}

/** Whether a mark is drawn: with its step, or once everything up to its sentence is done. */
function is_seen(mark, open) {
  const step = mark.dataset.of,
    at = Number(mark.dataset.at);
  if (!at) return true;
  if (moves[step]) return turn.done.has(Number(step)) && !turn.open.has(Number(step)); // whole, as light_up draws it
  const needs = turning.along[step];
  return needs?.length ? all_done(needs) : (at < open && at <= state.step) || at < turn.from;
}
