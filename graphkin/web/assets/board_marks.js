// The marks of the board: lines, arcs, points with letters, bars and vectors, all that the student has drawn.
import { html_element } from "./elements.js";
import { letters_for, make_move, point_to_name } from "./board_moves.js";
import { byId } from "./board_page.js";
import { length_of, minus, picks, plus, scaled, turn } from "./board_state.js";
import { keep_board } from "./board.js";
import { show_time } from "./history.js";
import { shown_at } from "./pick_shapes.js";
import { show_inputs } from "./picking.js";
import { here, sheets } from "./sheets.js";
import { light_up, put_in, whole_line } from "./turn_marks.js";
import { look } from "./zoom.js";

const OFF = [3.2, -3.2]; // mm from a point to its letter
const HEAD = 3.2,
  SPREAD = 0.16; // mm of an arrowhead, and half its width in parts of that

/** Draw all that the student has drawn in the current sheet. */
export function draw_own() {
  const used = new Set(turn.lines.flatMap(([, given]) => given));
  for (const [key, pick] of Object.entries(picks)) {
    if (!shown_at(key)) continue;
    const fresh = turn.fresh.includes(key) ? " fresh" : "";
    if (pick.kind === "bar") put_in("front", shown_at(key), "bar");
    else if (pick.kind === "arrow") draw_arrow(shown_at(key));
    else if (!key.startsWith("own")) continue;
    else if (pick.kind === "locus" && !used.has(key)) whole_line(key, `open${fresh}`);
    else if (["locus", "circle"].includes(pick.kind))
      put_in("front", shown_at(key), `${used.has(key) ? "done" : "open"}${fresh}`);
  }
  for (const key of Object.keys(picks).filter(
    one => one.startsWith("own") && ["point", "image"].includes(picks[one].kind),
  ))
    draw_point(key);
}

/**
 * A vector with its head.
 * @param {Shape} vector
 */
function draw_arrow({ side, from, to }) {
  const way = minus(to, from),
    size = length_of(way);
  put_in("front", { side, from, to }, "vector");
  if (size < 0.5) return;
  const back = scaled(way, -Math.min(HEAD, 0.5 * size) / size);
  for (const aside of [SPREAD, -SPREAD])
    put_in(
      "front",
      { side, from: to, to: plus(to, plus(back, scaled([-back[1], back[0]], aside))) },
      "vector",
    );
}

/** A point with its letter. */
function draw_point(key) {
  const drawn = shown_at(key),
    { name } = picks[key],
    fresh = turn.fresh.includes(key) ? " fresh" : "";
  if (!drawn) return;
  put_in("front", { ...drawn, ring: 0.9 }, `dot${fresh}`);
  if (!name.startsWith("#") || fresh)
    put_in(
      "front",
      { side: drawn.side, at: plus(drawn.at, OFF), text: name.startsWith("#") ? "?" : name },
      `open letter${fresh}`,
    );
}

/** Show the board: its sheet, all that is drawn, and what may be done next. */
export function show_turn() {
  sheets.forEach(({ element }, i) => {
    element.hidden = i !== here();
  });
  byId("turn-sheet").hidden = sheets.length < 2;
  look();
  light_up();
  show_inputs();
  show_time();
  show_letters();
  byId("turn-again").hidden = !turn.lines.length;
  keep_board();
}

/** Offer the letters that the point drawn last can have. */
function show_letters() {
  const key = point_to_name();
  byId("letters").replaceChildren(
    ...(key ? letters_for(key) : []).map(([letter, { name }]) => {
      const button = html_element("button");
      button.type = "button";
      button.innerHTML = name;
      button.addEventListener("click", () => make_move("name", [key, letter]));
      return button;
    }),
  );
}
