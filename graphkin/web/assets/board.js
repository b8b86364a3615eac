// The board of a task page: where its moves are kept, its keys and buttons, and its beginning.
import { draw_anew, offer_files } from "./board_files.js";
import { show_turn } from "./board_marks.js";
import { byId, page, state, style } from "./board_page.js";
import { follow_letters, log_of, picks, tell_turn, turn, worded } from "./board_state.js";
import { draw_move } from "./choosing.js";
import { forget_own_lines, keep_past, redo, undo } from "./history.js";
import { choose_action, forget_inputs } from "./picking.js";
import { sheets } from "./sheets.js";
import { EVENTS, in_turn } from "./turn_events.js";
import { light_up } from "./turn_marks.js";
import { draw_typed, is_typed_here, show_typed } from "./typing.js";
import { look, show_all } from "./zoom.js";

const kept_in = document.querySelector("form.answers input[name=drawing]");
const MEMORY = `graphkin board ${location.pathname} ${[...byId("board").textContent].reduce((sum, letter) => (Math.imul(31, sum) + letter.codePointAt(0)) | 0, 7)}`;

/** Keep the moves with the answers, or in this browser where the page has no form. */
export function keep_board() {
  const log = log_of();
  if (kept_in) {
    if (kept_in.value === log) return;
    kept_in.value = log;
    kept_in.dispatchEvent(new Event("input", { bubbles: true }));
    return;
  }
  try {
    localStorage.setItem(MEMORY, log);
  } catch {
    /* it is lost with the page */
  }
}

/** The moves that were kept. */
function kept_log() {
  try {
    return kept_in ? kept_in.value : (localStorage.getItem(MEMORY) ?? "");
  } catch {
    return "";
  }
}

/** The first message: how one draws, by keys too where there are any, with the page's sign of the pole. */
const beginning = () => {
  const pole = (picks["1:"] ?? picks["2:"])?.name ?? "o";
  return `${worded("begin")} ${is_typed_here() ? worded("by_keys", { pole }) : ""}`.trim();
};

/** Draw what was kept, in place of what is drawn. */
function recall_board() {
  const log = kept_log();
  if (log === log_of()) return;
  const whole = draw_anew(log);
  turn.future = [];
  turn.past = turn.lines.map((_, i) => ({
    done: [],
    log: turn.log.slice(0, i),
    lines: turn.lines.slice(0, i),
  })); // each move can be taken back
  tell_turn(whole ? beginning() : worded("broken", { number: turn.lines.length }));
  show_turn();
}

/** On the second request, take all moves back. */
function turn_again() {
  const { sure } = turn;
  if (sure) {
    keep_past();
    forget_own_lines();
    Object.assign(turn, { lines: [], log: [], fresh: [] });
    follow_letters();
    forget_inputs();
    show_turn();
  }
  tell_turn(sure ? beginning() : worded("sure"));
  turn.sure = !sure;
}

/** Give each field of a sheet its share of the width, and all that it shows. */
function fit() {
  for (const { fields } of sheets) for (const one of fields) one.drawn = null; // nothing is drawn that a frame could close on
  show_all();
  style(page, "--dock", `${Math.min(byId("dock").offsetHeight, innerHeight / 2)}px`);
  look();
  light_up();
}

for (const type of EVENTS) document.addEventListener(type, in_turn, true);
const acts = { "turn-undo": undo, "turn-redo": redo, "turn-again": turn_again };
for (const [name, act] of Object.entries(acts)) byId(name).addEventListener("click", act);
byId("turn-sheet").addEventListener("click", () => {
  state.step = (state.step + 1) % sheets.length;
  show_turn();
});
for (const [name, act] of Object.entries({ "turn-form": draw_move, "turn-type": draw_typed })) {
  byId(name).addEventListener("submit", event => {
    event.preventDefault();
    act();
  });
}
byId("turn-typed").addEventListener("input", show_typed);
for (const button of byId("palette").children)
  button.addEventListener("click", () => choose_action(button.dataset.action));
if (kept_in)
  kept_in.addEventListener("change", recall_board); // another file of answers was opened
else offer_files();
addEventListener("resize", fit);
follow_letters();
fit();
tell_turn(beginning());
if (kept_log()) recall_board();
else show_turn();
