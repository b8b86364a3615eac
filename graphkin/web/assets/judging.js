// The verdict on what a student draws, by its value: right, already drawn, the other of two results,
// a line that leads to a point still to be found, or wrong.

/** Whether the first two inputs of an action may change places. */
const commutes = action => ["cut", "join", "divide", "similar"].includes(action);

/** The number of inputs that equal those given, place by place. */
export const count_alike = (inputs, given) => inputs.filter((key, i) => key === given[i]).length;

/**
 * The verdicts on the moves of a construction.
 * @param {TurnRecord} record
 * @param {ReturnType<typeof import("./palette.js").palette_of>} palette
 * @param {number[]} order the moves in the order of their sentences
 */
export function verdicts_of({ moves, picks, places }, palette, order) {
  const { shape_of, same_value, on_line, size_of, length_of, SAME } = palette;

  /** The inputs of a move in the order in which most of them equal those given. */
  function own_inputs(move, given) {
    const own = move.inputs.map(key => picks[key].by || key);
    const turned = commutes(move.action) ? [own[1], own[0], ...own.slice(2)] : own;
    return count_alike(turned, given) > count_alike(own, given) ? turned : own;
  }

  /** Whether an image belongs to the point that it is drawn for; other results belong to any. */
  function is_placed(step, action, given) {
    if (!["coincide", "similar"].includes(action)) return true;
    return places[step]?.map(String).includes(given[action === "similar" ? 2 : 0]);
  }

  /** The move that gives one of some values; moves still to be made come first. */
  function giving({ action, given, plane }, values, among, left) {
    const gives = step => values.some(one => same_value(action, one, moves[step].value, plane));
    const ends = among.filter(
      step =>
        moves[step].plane === plane &&
        shape_of(moves[step].action) === shape_of(action) &&
        is_placed(step, action, given) &&
        gives(step),
    );
    const alike = step =>
      moves[step].action === action &&
      count_alike(own_inputs(moves[step], given), given) === given.length;
    return ends.find(alike) ?? ends.find(step => left.includes(step)) ?? ends[0];
  }

  /** A point that is still to be found and lies on a line or arc: a goal, or another one that is due. */
  function leads_to({ action, found, plane }, open, done) {
    if (!found.length || ["point", "vector"].includes(shape_of(action))) return undefined;
    const near = value => SAME * Math.max(size_of(plane), length_of(value));
    const is_point = step =>
      moves[step].plane === plane && shape_of(moves[step].action) === "point";
    const lies = ({ value }) => on_line(value, found[0]) < near(value);
    const on_it = open.filter(step => is_point(step) && lies(moves[step]));
    const is_due = step => moves[step].needs.every(need => done.has(need));
    return on_it.find(step => moves[step].goal) ?? on_it.find(is_due);
  }

  /**
   * The verdict on a drawn move, with the step that it is about.
   * @param {{ action: string, given: string[], found: any[], plane: number, other?: any }} drawn
   *   an action, its inputs, the result chosen, and the result that was not chosen
   * @param {Set<number>} done the moves that are made
   * @param {number[]} left the moves that the goals still need
   * @returns {{ is: "right" | "already" | "other" | "leads" | "wrong", step?: number }}
   */
  function verdict(drawn, done, left) {
    const open = order.filter(step => !done.has(step));
    const right = giving(drawn, drawn.found, open, left);
    if (right !== undefined) return { is: "right", step: right };
    const made = [...done].filter(step => moves[step]);
    const before = giving(drawn, drawn.found, made, left);
    if (before !== undefined) return { is: "already", step: before };
    const other = drawn.other ? [drawn.other] : [];
    const turned = giving(drawn, other, made, left);
    if (turned !== undefined) return { is: "already", step: turned };
    const meant = giving(drawn, other, open, left);
    if (meant !== undefined) return { is: "other", step: meant };
    const point = leads_to(drawn, open, done);
    return point === undefined ? { is: "wrong" } : { is: "leads", step: point };
  }

  /**
   * Lines or circles at the place of a move's, which are drawn together with it.
   * @param {number} step
   * @param {Set<number>} done
   */
  function lines_alike(step, done) {
    const { action, plane, value } = moves[step];
    return order.filter(
      one =>
        shape_of(moves[one].action) === shape_of(action) &&
        moves[one].plane === plane &&
        moves[one].needs.every(need => done.has(need)) &&
        same_value(action, moves[one].value, value, plane),
    );
  }

  return { own_inputs, verdict, lines_alike };
}
