// The file of a drawing, on a task page without a form: a table of answers with the drawing alone.
import { HEADS, quoted, rows_of, save_file, TABLE } from "./answer_files.js";
import { show_turn } from "./board_marks.js";
import { byId } from "./board_page.js";
import { draw_log, follow_letters, log_of, tell_turn, turn, worded } from "./board_state.js";
import { forget_own_lines, keep_past } from "./history.js";
import { escaped, forget_typed } from "./typing.js";

const FIELD = "drawing"; // as in graphkin.classroom.grading.answers
const stem = decodeURIComponent(location.pathname.split("/").at(-1)).replace(/\.html?$/i, "");

/** Say something of a file, and how many moves the drawing has. */
const tell_of = (key, file) =>
  tell_turn(worded(key, { file: escaped(file), number: turn.lines.length }));

/** Draw the moves of a log in place of what is drawn; returns whether all could be drawn. */
export function draw_anew(log) {
  forget_own_lines();
  Object.assign(turn, { lines: [], log: [], fresh: [] });
  follow_letters();
  return draw_log(log);
}

/** Save the drawing as a file. */
function save_drawing() {
  const name = `${stem || "graphkin"}-drawing.csv`,
    rows = [HEADS, [FIELD, quoted(log_of())]];
  save_file(name, rows.map(row => `${row.join(",")}\r\n`).join(""), TABLE);
  tell_of("saved", name);
}

/** Draw what a file holds; it can be undone. */
async function open_drawing() {
  const file = byId("drawing-file"),
    [chosen] = file.files;
  file.value = "";
  if (!chosen) return;
  const log = rows_of(await chosen.text()).find(([field]) => field === FIELD)?.[1];
  if (log === undefined) return tell_of("no_drawing", chosen.name);
  keep_past();
  const whole = draw_anew(log);
  forget_typed();
  tell_of(whole ? "opened" : "broken", chosen.name);
  show_turn();
}

/** Let a drawing be saved and opened, where it is not saved with answers. */
export function offer_files() {
  byId("drawing-save").addEventListener("click", save_drawing);
  byId("drawing-open").addEventListener("click", () => byId("drawing-file").click());
  byId("drawing-file").addEventListener("change", open_drawing);
}
