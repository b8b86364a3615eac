// Your turn: hints, help, the score sheet, and the keys and clicks during a turn.
import { save_file } from "./answer_files.js";
import { html_element } from "./elements.js";
import { follow_address } from "./address.js";
import { draw_move } from "./choosing.js";
import { draw_it, give_hint } from "./hints.js";
import { redo, undo } from "./history.js";
import { byId } from "./page.js";
import { choose_action, plain_words } from "./picking.js";
import { here, sheets } from "./sheets.js";
import { EVENTS, in_turn } from "./turn_events.js";
import {
  begin_turn,
  end_turn,
  moves,
  moves_left,
  show_turn,
  tell_turn,
  turn,
  turn_again,
  turning,
  worded,
} from "./turn_state.js";
import { draw_typed, show_typed } from "./typing.js";

/** Show the score: the steps done alone, with a hint, or with help. */
export function show_score() {
  const count = how => turn.log.filter(one => one.how === how).length;
  const wrong = turn.wrong + turn.log.reduce((sum, one) => sum + one.wrong, 0);
  const line = html_element("p"),
    list = html_element("ol");
  line.innerHTML = worded("score", {
    all: turn.log.length,
    alone: count("alone"),
    hint: count("hint"),
    help: count("help"),
    wrong,
    left: moves_left().length,
  });
  for (const { step, how, wrong: turns } of turn.log) {
    const item = html_element("li");
    item.className = how;
    item.innerHTML = `${moves[step].name}: ${worded(how === "alone" ? how : `with_${how}`)}${turns ? `, ${worded("wrong", { number: turns })}` : ""}`;
    list.append(item);
  }
  byId("score").replaceChildren(line, list);
  byId("score").hidden = byId("turn-save").hidden = false;
  if (!moves_left().length) tell_turn(worded("complete"));
}

/** Save the score sheet as a file. The seal by the variant's code reveals changes but proves nothing. */
async function save_score() {
  const [stem, id, code] = turning.owner;
  const steps = turn.log.map(({ step, how, wrong }) => [plain_words(moves[step].name), how, wrong]);
  const record = { graphkin_turn: 1, id, from: turn.from, steps, left: moves_left().length };
  const seal = code
    ? await seal_of(`${code}\n${JSON.stringify([id, record.from, steps, record.left])}`)
    : "";
  const file = `${stem}-turn.json`;
  save_file(file, JSON.stringify({ ...record, seal }), "application/json");
  byId("turn-say").textContent = worded("saved", { file });
}

/** The SHA-256 of a text in hexadecimal digits; empty where the browser offers none. */
async function seal_of(text) {
  const bytes = await crypto.subtle?.digest("SHA-256", new TextEncoder().encode(text));
  return bytes
    ? [...new Uint8Array(bytes)].map(byte => byte.toString(16).padStart(2, "0")).join("")
    : "";
}

/** Start listening where there is something to draw. */
export function listen_to_turn() {
  if (!byId("turn")) return;
  for (const type of EVENTS) document.addEventListener(type, in_turn, true);
  const acts = {
    turn: begin_turn,
    "turn-end": end_turn,
    "turn-again": turn_again,
    "turn-score": show_score,
    "turn-save": save_score,
    hint: give_hint,
    "draw-it": draw_it,
    "turn-undo": undo,
    "turn-redo": redo,
  };
  for (const [name, act] of Object.entries(acts)) byId(name).addEventListener("click", act);
  byId("turn-sheet").addEventListener("click", () => {
    turn.sheet = (here() + 1) % sheets.length;
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
  addEventListener("hashchange", () => {
    if (!turn) return;
    end_turn();
    follow_address(); // a turn ends where it was begun
  });
}
