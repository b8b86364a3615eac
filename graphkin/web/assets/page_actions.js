// The actions of your turn, as graphkin.construction.registry has them. Made by `python -m tests.scripts`.

/** Shape of each result, its drawing (0 mechanism, 1 velocities, 2 accelerations, 3 numbers), and
 * the input whose drawing it shares; only where it is no point beside its first input.
 * @type {Record<string, [string, number | null, number]>} */
export const ACTIONS = {
  perpendicular: ["line", null, 0],
  parallel: ["line", null, 0],
  compass: ["circle", null, 0],
  coincide: ["point", null, 1],
  triangle: ["point", 3, 0],
  klein: ["point", 3, 0],
  coriolis: ["point", 3, 0],
  join: ["line", null, 0],
  pole: ["point", 0, 0],
  curvature: ["point", 0, 0],
  transfer: ["vector", 0, 0],
};

/** The signs and words by which each action is typed.
 * @type {Record<string, string[]>} */
export const TYPED = {
  perpendicular: ["⊥", "perp", "_"],
  parallel: ["∥", "par", "//"],
  cut: ["×", "cut", "x"],
  lay_off: ["→", "lay", "+"],
  compass: ["arc"],
  mark_off: ["len"],
  similar: ["∼", "sim", "~"],
  coincide: ["≡", "falls"],
  triangle: ["△", "tri"],
  klein: ["klein"],
  coriolis: ["cor"],
  join: ["join"],
  divide: ["div"],
  pole: ["pole"],
  curvature: ["curv"],
  transfer: ["set", "@"],
};

/** What each action draws from the keys of its picks: a list of results.
 * @param {any} given
 * @returns {Record<string, (...keys: any[]) => any[]>} */
export const drawn_by = ({ plus, minus, scaled, quarter, long, dot, cross, times, over, cuts, value_of, way, places_of, reach, normal, picks, shares, seconds, all_done }) => ({
  perpendicular: (p, to) => [[value_of(p), quarter(way(to))]],
  parallel: (p, to) => [[value_of(p), way(to)]],
  cut: (m, n) => m === n ? [] : cuts(value_of(m), value_of(n)),
  lay_off: (p, v) => [plus(value_of(p), value_of(v)), minus(value_of(p), value_of(v))],
  compass: (p, opening) => [{ c: value_of(p), r: reach(opening, p) }],
  mark_off: (line, length) => {
      const [point, along] = value_of(line);
      return [plus(point, scaled(along, value_of(length) / long(along)))];
    },
  similar: (i, j, point) => places_of(i).flatMap(p =>
      places_of(j).filter(q => long(minus(q, p))).map(q => plus(value_of(i), times(
        minus(value_of(j), value_of(i)), over(minus(value_of(point), p), minus(q, p)))))),
  coincide: (point, image) => [value_of(image)],
  triangle: normal,
  klein: normal,
  coriolis: (rate, velocity) => [scaled(quarter(value_of(velocity)), 2 * value_of(rate))],
  join: (p, q) => p === q ? [] : [[value_of(p), minus(value_of(q), value_of(p))]],
  divide: (p, q, m, n, point) => {
      const part = end => minus(value_of(end), value_of(m)), parts = m
        ? [dot(part(point), part(n)) / dot(part(n), part(n))]
        : shares.filter(([plane,, needs]) => plane === picks[p].plane && all_done(needs))
          .map(([, share]) => share);
      return parts.map(one => plus(value_of(p), scaled(minus(value_of(q), value_of(p)), one)));
    },
  pole: (bar, i, j) => [picks[bar].on, [...picks[bar].on].reverse()].map(ends => {
      const [p, q] = ends.map(value_of), image = value_of(i);
      return plus(p, times(minus(q, p), over(scaled(image, -1), minus(value_of(j), image))));
    }),
  curvature: (p, velocity, acceleration) => {
      const [v, a] = [value_of(velocity), value_of(acceleration)];
      return [plus(value_of(p), scaled(quarter(v), dot(v, v) / cross(v, a)))];
    },
  transfer: (arrow, point) => {
      const shrunk = seconds ** picks[arrow].plane;
      return [[value_of(point), plus(value_of(point), scaled(value_of(arrow), shrunk))]];
    },
});

/** The marks that a pen draws. */
export const STROKES = ".construction,.ray,.compass,.trial,.trial-line,.centre,.inflection,.ordinate,.velocity,.relative-velocity,.acceleration,.normal,.tangential,.coriolis,.sliding,.link,.outline";
