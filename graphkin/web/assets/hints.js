// Hints in three grades: a question, the name of the action, what it starts from.
import { make_move } from "./checking.js";
import { byId } from "./page.js";
import { forget_inputs, slot_words } from "./picking.js";
import {
  action_name,
  moves,
  next_move,
  ORDER,
  picks,
  reasons_of,
  show_turn,
  tell_turn,
  turn,
  worded,
} from "./turn_state.js";

/** Give the next grade of hint for a step that can be drawn. */
export function give_hint() {
  const step = next_move();
  if (step === undefined) return;
  turn.grade = turn.hinted === step ? Math.min(turn.grade + 1, 3) : 1;
  turn.hinted = step;
  turn.sheet = null;
  forget_inputs();
  show_turn();
  tell_hint();
  byId("turn-sentence").replaceChildren(...(turn.grade > 1 ? reasons_of(step) : []));
}

/** Say the hint: the question, the action, or the action with its inputs. */
export function tell_hint() {
  const { action, inputs, name, about = name } = moves[turn.hinted],
    words = slot_words(action);
  const named = inputs.map(key => picks[picks[key].by || key].name),
    goal = goal_of(turn.hinted);
  if (turn.grade === 1)
    return tell_turn(worded(`ask_${action}`, { name, about, goal, last: named.at(-1) }));
  if (turn.grade === 2)
    return tell_turn(worded("hint_action", { action: action_name(action), goal }));
  tell_turn(
    worded("hint", {
      action: action_name(action),
      list: named.map((one, i) => `${words[i]} ${one}`).join(", "),
    }),
  );
}

/** The name of the nearest goal that a move leads to. */
function goal_of(step) {
  const leads = new Set([step]);
  const goal = ORDER.find(one => {
    if (moves[one].needs.some(need => leads.has(need))) leads.add(one);
    return leads.has(one) && moves[one].goal;
  });
  return moves[goal ?? step].name;
}

/** Draw a possible next step. */
export function draw_it() {
  const step = next_move();
  if (step !== undefined)
    make_move(
      step,
      "help",
      worded("helped", { name: moves[step].name, action: action_name(moves[step].action) }),
    );
}
