// The results of palette actions: complex numbers as [x, y], lines as [point, direction], circles as { c, r }.

/**
 * The name of a result, from the names of its inputs; used where the result has no name of its own.
 * @param {string} action
 * @param {string[]} names
 * @param {Record<string, string>} words
 */
export function named_from(action, names, words) {
  if (action === "compass") return words.arc.replace("{p}", names[0]).replace("{bar}", names[1]);
  if (action === "join") return names.join("");
  if (action === "transfer") return names[0];
  return `${{ perpendicular: "⊥", parallel: "∥", ray: "∠" }[action]} ${names[1]} (${names[0]})`;
}

/**
 * A record completed by what follows from it: picks of moves, bars and vectors, names and needs.
 * @param {TurnRecord} record
 */
function followed({ moves, picks, words }) {
  const of_ends = key => {
    const pick = picks[key];
    const ends = ["bar", "arrow"].includes(pick.kind) ? pick.on.map(end => picks[end]) : [];
    if (pick.kind === "bar")
      Object.assign(pick, { name: ends.map(({ name }) => name).join(""), plane: 0 });
    if (ends.length) pick.needs = [...new Set(ends.flatMap(({ needs }) => needs))];
  };
  for (const pick of Object.values(picks)) {
    pick.needs ??= [];
    pick.plane ??= 0;
  }
  for (const [step, move] of Object.entries(moves)) {
    // in the order of the program
    for (const key of move.inputs) of_ends(key);
    const names = move.inputs.map(key => picks[key].name);
    move.name ??= named_from(move.action, names, words);
    if (move.action === "lay_off") move.about ??= names[1];
    move.needs ??= [...new Set(move.inputs.flatMap(key => picks[key].needs))];
    if (picks[step])
      Object.assign(picks[step], { name: move.name, plane: move.plane, needs: [Number(step)] });
  }
  for (const key of Object.keys(picks)) of_ends(key);
}

/**
 * The actions of a construction by its record; `all_done` says whether some moves are made.
 * @param {TurnRecord} record
 * @param {(steps: number[]) => boolean} all_done
 * @param {Pick<typeof import("./page_actions.js"), "ACTIONS" | "drawn_by">} actions
 */
export function palette_of(record, all_done, { ACTIONS, drawn_by }) {
  followed(record);
  const { moves, picks, places, shares, seconds, millimetre } = record;
  const SAME = 1e-7; // parts of a drawing within which two values are equal
  const steps = Object.keys(moves).map(Number);

  const plus = (a, b) => [a[0] + b[0], a[1] + b[1]],
    minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
  const scaled = (a, k) => [a[0] * k, a[1] * k],
    quarter = a => [-a[1], a[0]],
    long = a => Math.hypot(...a);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1],
    cross = (a, b) => a[0] * b[1] - a[1] * b[0];
  const times = (a, b) => [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
  const over = (a, b) => scaled(times(a, [b[0], -b[1]]), 1 / dot(b, b));

  /** The intersection of two lines, measured from the nearer point; none for parallel lines. */
  function lines_meet(m, n) {
    const gap = minus(n[0], m[0]),
      turn = cross(m[1], n[1]);
    const [s, t] = [cross(gap, n[1]) / turn, cross(gap, m[1]) / turn];
    const found =
      Math.abs(s) * long(m[1]) < Math.abs(t) * long(n[1])
        ? plus(m[0], scaled(m[1], s))
        : plus(n[0], scaled(n[1], t));
    return found.every(Number.isFinite) ? [found] : [];
  }

  /** The intersections of a line and a circle. */
  function line_cuts([point, way], { c, r }) {
    const unit = scaled(way, 1 / long(way)),
      gap = minus(c, point);
    const along = dot(gap, unit),
      aside = cross(unit, gap),
      half = Math.sqrt((r - aside) * (r + aside));
    return Number.isNaN(half)
      ? []
      : [half, -half].map(step => plus(point, scaled(unit, along + step)));
  }

  /** The intersections of two circles. */
  function circles_meet(m, n) {
    const gap = minus(n.c, m.c),
      size = long(gap),
      along = (((m.r - n.r) * (m.r + n.r)) / size + size) / 2;
    const half = Math.sqrt((m.r - along) * (m.r + along));
    if (Number.isNaN(half)) return [];
    return [half, -half].map(side => plus(m.c, times([along, side], scaled(gap, 1 / size))));
  }

  /** The intersections of two curves. */
  function cuts(m, n) {
    if (m.r === undefined) return n.r === undefined ? lines_meet(m, n) : line_cuts(m, n);
    return n.r === undefined ? line_cuts(n, m) : circles_meet(m, n);
  }

  /** The value of a pick. */
  function value_of(key) {
    const pick = picks[key];
    if (pick.value !== undefined) return pick.value;
    if (pick.on && !moves[key]) {
      const [p, q] = pick.on.map(value_of);
      return minus(q, p);
    }
    return moves[key].value;
  }

  /** The direction of a bar, a vector or a line. */
  const way = key => (picks[key].on ? value_of(key) : value_of(key)[1]);
  const places_of = key => (places[key] ?? []).map(value_of);

  /** A length in the drawing of another pick; a typed length is in millimetres of paper. */
  const reach = (length, at) =>
    value_of(length) * (picks[length].paper ? millimetre[picks[at].plane] : 1);

  /** The vector along a bar from its other end to a point at one end. */
  function arm(point, bar) {
    const [p, q] = picks[bar].on;
    const other = String(p) === point ? q : String(q) === point ? p : null;
    return other === null ? null : minus(value_of(point), value_of(other));
  }

  /** v²/l of a point at the end of a bar, towards the other end; the relative velocity is perpendicular. */
  function normal(point, bar, velocity) {
    const reach = arm(point, bar),
      speed = value_of(velocity);
    if (!reach || Math.abs(dot(reach, speed)) > SAME * long(reach) * long(speed)) return [];
    return [scaled(reach, -dot(speed, speed) / dot(reach, reach))];
  }

  /** The results of each action; of several, one is meant. */
  const DRAW = drawn_by({
    plus,
    minus,
    scaled,
    quarter,
    long,
    dot,
    cross,
    times,
    over,
    cuts,
    value_of,
    way,
    places_of,
    reach,
    normal,
    picks,
    shares,
    seconds,
    all_done,
  });
  /** The drawing that holds the result of an action. */
  function plane_of(action, inputs) {
    const [, plane, lies_with] = ACTIONS[action] ?? ["point", null, 0];
    return plane ?? picks[inputs[lies_with]].plane;
  }

  /** The results of an action, way by way: from its inputs, and from undrawn points that share the pick of a nearby point. */
  function results_by_way(action, inputs) {
    const alike = inputs.map(key => [
      key,
      ...Object.keys(picks).filter(
        other => picks[other].by === key && all_done(picks[other].needs),
      ),
    ]);
    const ways = alike.reduce(
      (found, keys) => found.flatMap(one => keys.map(key => [...one, key])),
      [[]],
    );
    const is_finite = value => flat(value).every(Number.isFinite);
    return ways.map(way => DRAW[action](...way).filter(is_finite));
  }

  const results = (action, inputs) => results_by_way(action, inputs).flat();

  /** The results of each way at the place of a result of the first one: they look alike. */
  function likewise(action, inputs, value) {
    const [first, ...others] = results_by_way(action, inputs),
      place = first.findIndex(one => flat(one).every((part, i) => part === flat(value)[i]));
    return [value, ...others.map(way => way[place]).filter(Boolean)];
  }

  const flat = value => (value.r === undefined ? value.flat() : [...value.c, value.r]);

  /** The shape of an action's result: a line, a circle, a vector set on the mechanism, or a point. */
  const shape_of = action => ACTIONS[action]?.[0] ?? "point";

  /** The size of each drawing. */
  const sizes = [0, 1, 2, 3, 4].map(plane =>
    Math.max(
      1e-12,
      ...steps
        .filter(step => moves[step].plane === plane)
        .flatMap(step =>
          shape_of(moves[step].action) === "line"
            ? long(moves[step].value[0])
            : flat(moves[step].value).map(Math.abs),
        ),
    ),
  );

  /** Whether two values of an action's kind are equal in a drawing. */
  function same(action, a, b, plane) {
    const near = SAME * sizes[plane];
    if (shape_of(action) === "line") {
      const turned = cross(a[1], b[1]) / long(a[1]) / long(b[1]);
      return (
        Math.abs(turned) < SAME &&
        on_line(b[0], a) < Math.max(near, SAME * long(a[0]), SAME * long(b[0]))
      );
    }
    const own = Math.max(near, SAME * Math.max(...flat(b).map(Math.abs)));
    return (
      flat(a).length === flat(b).length &&
      flat(a).every((number, i) => Math.abs(number - flat(b)[i]) < own)
    );
  }

  /** The distance of a point from a line or a circle. */
  function on_line(point, curve) {
    if (curve.r !== undefined) return Math.abs(long(minus(point, curve.c)) - curve.r);
    return Math.abs(cross(minus(point, curve[0]), curve[1])) / long(curve[1]);
  }

  return {
    plus,
    minus,
    scaled,
    dot,
    cross,
    cuts,
    length_of: long,
    value_of,
    plane_of,
    results_of: results,
    choices_of: (action, inputs) => results_by_way(action, inputs)[0],
    likewise,
    same_value: same,
    on_line,
    shape_of,
    size_of: plane => sizes[plane],
    SAME,
  };
}
