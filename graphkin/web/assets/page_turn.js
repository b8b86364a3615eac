// What the board of a turn needs of its page: your turn on a step page.
export { TYPED } from "./page_actions.js";
export { add_line, check_move, draw_own } from "./checking.js";
export { tell_hint } from "./hints.js";
export {
  action_name,
  CHOICE,
  choices_of,
  likewise,
  cross,
  dot,
  is_letter,
  is_there,
  kinds_due,
  length_of,
  minus,
  moves,
  number_field,
  NUMBERS_PLANE,
  picks,
  plane_of,
  plus,
  results_of,
  same_value,
  scaled,
  shape_of,
  show_turn,
  tell_turn,
  turn,
  turning,
  typed_numbers,
  value_of,
  worded,
} from "./turn_state.js";
