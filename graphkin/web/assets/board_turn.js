// What the board needs of its page: the free board of a task page.
export { TYPED } from "./board_actions.js";
export { draw_own, show_turn } from "./board_marks.js";
export { check_move, is_letter, number_field, tell_hint, typed_numbers } from "./board_moves.js";
export {
  absent_names,
  action_name,
  add_line,
  CHOICE,
  choices_of,
  likewise,
  cross,
  dot,
  is_there,
  kinds_due,
  length_of,
  minus,
  moves,
  NUMBERS_PLANE,
  picks,
  plane_of,
  plus,
  results_of,
  same_value,
  scaled,
  shape_of,
  tell_turn,
  turn,
  turning,
  value_of,
  worded,
} from "./board_state.js";
