// The state of a drawing on the board: what the task gives, the moves made, and what follows from their letters.
import { byId, data } from "./board_page.js";
import { named_from, palette_of } from "./palette.js";
import { ACTIONS, drawn_by, TYPED } from "./board_actions.js";

/** @type {TurnRecord} */
export const turning = { ...data, moves: {}, places: {}, shares: [], seconds: 1 };
export const { moves, picks } = turning;
export const CHOICE = Object.keys(turning.palette); // any action may have several results
export const NUMBERS_PLANE = 3; // what is computed lies in no drawing
export const UNITS = { length: ["mm", "mm"], angle: ["deg", "°"], rate: ["rad", "rad/s"] }; // of typed numbers, in the log and on the page
export const MOST_MOVES = 400,
  MOST_SIGNS = 4000; // as in graphkin.construction.board

const palette = palette_of(turning, () => true, { ACTIONS, drawn_by });
export const {
  plus,
  minus,
  scaled,
  dot,
  cross,
  length_of,
  value_of,
  plane_of,
  results_of,
  likewise,
  same_value,
  shape_of,
} = palette;

/**
 * The results from which the student chooses; a ray is followed from its start in its own direction alone.
 * @param {string} action
 * @param {string[]} given
 */
export function choices_of(action, given) {
  const found = palette.choices_of(action, given),
    [start, on] = given,
    [drawn, [from]] = turn.lines[Number(on?.slice(3)) - 1] ?? ["", []];
  return action === "set_off" && drawn === "ray" && from === start ? found.slice(0, 1) : found;
}

/** @type {Turn} */
export const turn = {
  done: new Set(),
  lines: [],
  log: [],
  past: [],
  future: [],
  fresh: [],
  open: new Set(),
  taken: [],
  inputs: [],
  tool: null,
  action: null,
  asked: null,
  aim: null,
  wrong_line: null,
};
export const moves_left = () => [],
  is_there = key => !picks[key].by;
export const kinds_due = () => Object.keys(UNITS).concat("vector");

/** A message of the page with names filled in; the names are markup, escaped by their maker. */
export const worded = (key, fields = null) =>
  turning.words[key].replace(/\{(\w+)\}/g, (gap, name) => fields?.[name] ?? gap);
export const tell_turn = text => {
  turn.sure = false;
  byId("turn-say").innerHTML = text.replace(/^\p{Ll}/u, first => first.toUpperCase());
};
export const action_name = action =>
  byId("palette").querySelector(`[data-action=${action}]`).textContent.trim();

/** The letters that are given to points, each with the key of its point. */
export const lettered = () =>
  Object.fromEntries(
    turn.lines
      .filter(([action]) => action === "name")
      .map(([, [point, letter]]) => [letter, point]),
  );

/** The letters that no point has yet, and the bars and vectors between those. */
export const absent_names = () =>
  [
    ...Object.entries(turning.letters).map(([letter, { name }]) => [letter, name]),
    ...[turning.bars, turning.arrows].flatMap(pairs =>
      Object.entries(pairs).map(([key, [, , name]]) => [key, name]),
    ),
  ]
    .filter(([key]) => !picks[key] && !lettered()[key])
    .map(([, name]) => name);

/** The name of a thing that has no letter. */
function plain_name(key, [action, given]) {
  if (["line", "circle"].includes(shape_of(action)))
    return named_from(
      action,
      given.map(one => picks[one].name),
      turning.words,
    );
  return picks[key].kind === "vector"
    ? `${picks[given[0]].name} ${picks[given.at(-1)].name}`
    : `#${key.slice(3)}`;
}

/** Add a move and what it draws; `which` is the number of its result. */
export function add_line(action, given, which) {
  const key = `own${turn.lines.push([action, given, which])}`;
  given.forEach(recall_number);
  if (action !== "name") {
    const plane = plane_of(action, given),
      shape = shape_of(action);
    const kind =
      shape === "point"
        ? ["point", "image", "image", "vector"][plane]
        : { line: "locus", circle: "circle" }[shape];
    picks[key] = { kind, plane, needs: [], value: results_of(action, given)[which] };
    picks[key].name = plain_name(key, [action, given]);
  }
  follow_letters();
  return key;
}

/** Name the lettered points, and put bars and vectors between those that belong together. */
export function follow_letters() {
  const points = lettered(),
    point_of = letter => points[letter] ?? letter;
  for (const [key, pick] of Object.entries(picks)) if (pick.on) delete picks[key];
  for (const [letter, key] of Object.entries(points))
    picks[key].name = turning.letters[letter].name;
  turning.places = Object.assign(
    turning.places,
    ...Object.keys(turning.places).map(key => ({ [key]: undefined })),
  );
  const fixed = Object.keys(picks).filter(key => key.startsWith("0:"));
  for (const plane of [1, 2]) turning.places[`${plane}:`] = fixed;
  for (const [letter, key] of Object.entries(points)) {
    const { of } = turning.letters[letter],
      place = point_of(`0:${of}`);
    if (of && picks[place]) turning.places[key] = [...(turning.places[key] ?? []), place];
  }
  for (const [kind, pairs] of [
    ["bar", turning.bars],
    ["arrow", turning.arrows],
  ]) {
    for (const [key, [tail, tip, name]] of Object.entries(pairs)) {
      const on = [tail, tip].map(point_of);
      if (on.every(end => picks[end]))
        picks[key] = { kind, on, name, plane: picks[on[0]].plane, needs: [] };
    }
  }
}

/** The thing that a typed number is: `54.2mm`, `44deg` or `-3rad`. */
function recall_number(key) {
  const [, number, unit] = /^(-?[\d.]+)(mm|deg|rad)$/.exec(key) ?? [];
  if (!unit) return;
  const [kind, [, written]] = Object.entries(UNITS).find(([, [name]]) => name === unit);
  picks[key] = {
    kind,
    plane: 0,
    needs: [],
    value: Number(number),
    name: `${number.replace("-", "−").replace(".", data.mark)} ${written}`.replace(" °", "°"),
    paper: kind === "length",
    typed: true,
  };
}

/** The key of a typed number for inputs of some kinds; null where it is none. */
export function number_key(text, kinds) {
  const kind = kinds.find(one => UNITS[one]),
    found = /^[-−]?\d{1,5}(?:[.,]\d{1,6})?$/.exec(text.trim());
  if (!kind || !found) return null;
  const key = found[0].replace("−", "-").replace(",", ".") + UNITS[kind][0];
  recall_number(key);
  return key;
}

/** The moves as a line of text, which `graphkin grade` draws again. */
export const log_of = () =>
  turn.lines
    .map(([action, given, which]) =>
      [
        word_of(action),
        ...given.map(key => key.replace(/^own/, "")),
        ...(which ? [`/${which}`] : []),
      ].join(" "),
    )
    .join("|");
const word_of = action => TYPED[action]?.find(sign => /^[a-z]+$/.test(sign)) ?? action;

/** Draw the moves of a log again; returns whether all of them could be drawn. */
export function draw_log(text) {
  for (const move of text.split("|").filter(Boolean)) {
    const words = move.split(" "),
      which = words.at(-1).startsWith("/") ? Number(words.pop().slice(1)) : 0;
    const action = Object.keys(TYPED).find(one => word_of(one) === words[0]) ?? words[0],
      given = words.slice(1).map(key => (/^\d+$/.test(key) ? `own${key}` : key));
    try {
      add_line(action, given, which);
      if (action !== "name" && !picks[`own${turn.lines.length}`].value) throw new RangeError(move);
    } catch {
      delete picks[`own${turn.lines.length}`];
      turn.lines.pop();
      return false;
    }
    turn.log.push({});
  }
  return true;
}
