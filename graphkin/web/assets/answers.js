// Answers to wrong moves: the known error with what would come of it, or the nearest move that is due.
import { count_alike } from "./judging.js";
import { keys_within } from "./choosing.js";
import { byId, data } from "./page.js";
import { forget_inputs, show_inputs } from "./picking.js";
import { drawn_as } from "./pointing.js";
import { light_up } from "./turn_marks.js";
import {
  all_done,
  cut_at,
  dot,
  is_there,
  length_of,
  minus,
  moves,
  moves_left,
  next_move,
  ORDER,
  part_of,
  picks,
  reasons_of,
  results_of,
  SAME,
  scaled,
  shape_of,
  show_again,
  size_of,
  tell_turn,
  turn,
  turning,
  value_of,
  worded,
  own_inputs,
} from "./turn_state.js";
import { show_score } from "./your_turn.js";

/** Refuse a move and give the reason for the intended step, if any; repeating a step is no error. */
export function refuse_move(words, meant) {
  const at_keys = keys_within(),
    { wrong_line } = turn;
  if (meant !== undefined) turn.wrong += 1;
  byId("turn-sentence").replaceChildren(...(meant ? reasons_of(meant) : []));
  forget_inputs();
  turn.wrong_line = wrong_line;
  turn.fresh = [];
  tell_turn(words);
  light_up();
  show_inputs();
  show_again();
  if (!byId("score").hidden) show_score();
  if (at_keys) byId("inputs").querySelector("select")?.focus({ preventScroll: true });
}

/** Refuse the other of two results. */
export function refuse_other(meant, action, value, plane, given) {
  const [omega, sense] = moves[meant].turns ?? [],
    { name, about = name, turned } = moves[meant];
  turn.wrong_line = [drawn_as(action, plane, value, given)];
  const said = worded(omega ? "other_turned" : `other_${action}`, { name, about, omega, sense });
  refuse_move(turned ? `${said} ${worded(turned, { about })}` : said, meant);
}

/** The moves of this part of the work that are due: what they need is drawn. */
const moves_due = () =>
  moves_left().filter(
    step => all_done(moves[step].needs) && part_of(step) === part_of(next_move()),
  );

/** Say why a choice is wrong: as a known error, or by the most similar move that is due. */
export function why_wrong(action, given, found, plane) {
  turn.wrong_line = found.length ? [drawn_as(action, plane, found[0], given)] : null;
  const known = known_error(action, given);
  if (known) return refuse_move(known.words, known.step);
  const near = nearest_due(action, given);
  if (!near) return refuse_move(why_nowhere(action, given, plane), null);
  const { step, inputs, first } = near,
    name = key => picks[key].name;
  const others = inputs
    .filter((_, i) => i !== first)
    .map(name)
    .join(", ");
  const said = worded(reason_key(action, first), {
    name: moves[step].name,
    about: moves[step].about ?? moves[step].name,
    right: name(inputs[first]),
    chosen: name(given[first]),
    other: others,
  });
  refuse_move(
    [said, shape_of(action) === "line" && consequence(step, results_of(action, given)[0])]
      .filter(Boolean)
      .join(" "),
    step,
  );
}

/** What is wrong with a result that resembles nothing that is due. */
function why_nowhere(action, [start, along], plane) {
  const due = moves_due(),
    next = moves[due[0]]?.plane;
  if (next in turning.plans && due.every(step => moves[step].plane !== plane))
    return worded("other_drawing", { plan: turning.plans[next] });
  if (!["line", "circle"].includes(shape_of(action))) return worded("nowhere");
  const shown = turning.places[start] ?? [];
  return shown.length && picks[along]?.kind === "bar" && !picks[along].on.some(is_in(shown))
    ? worded("neither_end", { chosen: picks[start].name, along: picks[along].name })
    : worded("nowhere_line");
}
const is_in = shown => end => shown.includes(end);

/**
 * The move that is due and most similar to a wrong one, with the first input that differs; only of things that are there.
 * A line from the pole is similar only to one along the same bar or guide, for most lines start there.
 */
function nearest_due(action, given) {
  const of_pole = shape_of(action) === "line" && !picks[given[0]].needs.length;
  return moves_due()
    .filter(step => moves[step].action === action)
    .map(step => {
      const inputs = own_inputs(moves[step], given),
        first = inputs.findIndex((key, i) => key !== given[i]);
      return {
        step,
        inputs,
        first,
        weight: 2 * count_alike(inputs, given) + Number(inputs[0] === given[0]),
      };
    })
    .filter(
      ({ weight, first, inputs }) =>
        weight >= 2 && first >= 0 && !(of_pole && first) && inputs.every(is_there),
    )
    .sort((a, b) => b.weight - a.weight)[0];
}

/** The message key for an input: equal inputs share one, and Klein's construction uses the triangle's. */
function reason_key(action, slot) {
  const own = `${action === "klein" ? "triangle" : action}_`;
  return (
    own +
    Array.from({ length: slot + 1 }, (_, i) => slot - i).find(i => `${own}${i}` in turning.words)
  );
}

/** An error that the construction of a move knows, with what would come of it; moves left to be made come first. */
function known_error(action, given) {
  for (const step of [...moves_left(), ...turn.done]) {
    const error = (moves[step]?.errors ?? []).find(
      ([, by, ...inputs]) => by === action && inputs.every((key, i) => key === given[i]),
    );
    if (!error) continue;
    const { name, about = name } = moves[step],
      [key] = error;
    const fields = { name, about, chosen: picks[given[0]].name, along: picks[given[1]]?.name };
    return {
      step: all_done(moves[step].needs) ? step : null,
      words: [worded(key, fields), consequence(step, results_of(action, given)[0])]
        .filter(Boolean)
        .join(" "),
    };
  }
  return null;
}

/** What would come of a wrong line in place of a move's: a bar that stretches, a block that leaves its guide. */
function consequence(step, line) {
  const { keeps, plane, value: right } = moves[step];
  if (!keeps || !line) return "";
  const [key, from] = keeps,
    guided = picks[key].kind === "guide";
  const way = guided
    ? value_of(key)[1]
    : minus(value_of(key.split("-").find(end => end !== String(from))), value_of(from));
  const unit = scaled(guided ? [-way[1], way[0]] : way, 1 / length_of(way)),
    size = aside_by(step, line, right[0], unit);
  if (size === null) return "";
  const fields = {
    name: picks[key].name,
    size: `${figure_of(Math.abs(size))} ${turning.units[plane - 1]}`,
  };
  return Math.abs(size) < SAME * size_of(plane)
    ? ""
    : worded(guided ? "leaves" : size > 0 ? "stretches" : "shrinks", fields);
}

/** How far the point on a wrong line would lie along a direction that the right one forbids; null while that is open. */
function aside_by(step, [point, way], start, unit) {
  if (Math.abs(dot(way, unit)) < SAME * length_of(way)) return dot(minus(point, start), unit);
  const other = sibling_of(step);
  const [value] = other === undefined ? [] : cut_at([point, way], moves[other].value);
  return value ? dot(minus(value, start), unit) : null;
}

/** The line already drawn on which the point of a move's line lies as well. */
function sibling_of(step) {
  const cut = ORDER.find(
    one => moves[one].action === "cut" && moves[one].inputs.includes(String(step)),
  );
  return moves[cut]?.inputs
    .map(Number)
    .find(one => one !== step && turn.done.has(one) && shape_of(moves[one].action) === "line");
}

/** A number in three figures, in the page's notation. */
const figure_of = number => Number(number.toPrecision(3)).toString().replace(".", data.mark);
