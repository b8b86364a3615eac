// Highlights next to the strokes of a step: links whose rates are read off, and similar triangles.
import { svg_element } from "./elements.js";
import { between, stroke, UNMARKED } from "./halos.js";
import { byId, data, motion, moved, state } from "./page.js";
import { pin } from "./sheets.js";
import { looked_at } from "./tracing.js";

const ROUND = 6.5,
  SWING = 1.9,
  BARB = 2.6; // mm of an arrow round a link's number, half its arc in radians, mm of its head
const CORNERS = [5, 7]; // mm of the arcs that mark equal angles, in both figures

/** The rates that the current step reads off. */
export function rates_read() {
  return data.rates[state.step] ?? [];
}

/** The steps that the rates are read off. */
export function read_from() {
  return state.over
    ? []
    : rates_read()
        .flatMap(({ bar, vector }) => [...(bar ?? []), vector ?? []].flat())
        .map(String);
}

/** The turning links, and the bars and vectors of their rates. */
export function rates_in(sheet, svg) {
  return rates_read().flatMap(({ body, bar, vector }) => {
    const [p, q] = (bar ?? []).map(point => pin(sheet, point));
    const strokes = body
      .map(byId)
      .filter(mark => svg.contains(mark))
      .map(mark => stroke(mark, "new"));
    if (p && q && svg.contains(p)) strokes.push(between(p, q));
    const lit = (sheet.of.get(String(vector)) ?? []).filter(
      mark => svg.contains(mark) && !mark.matches(UNMARKED),
    );
    return [...strokes, ...lit.map(mark => stroke(mark, "old"))];
  });
}

/** An arrow around the number of each turning link, in its sense. */
export function turning_in(svg) {
  if (state.over) return [];
  return rates_read().flatMap(({ row, sense, number }) => {
    const ring = byId(number),
      way = Math.sign(moved() && !state.dead ? motion.values(state.x)[row] : sense);
    if (!ring || !svg.contains(ring) || !way) return [];
    const [x, y] = ["cx", "cy"].map(name => Number(ring.getAttribute(name)));
    const at = turn => [x + ROUND * Math.sin(turn), y - ROUND * Math.cos(turn)]; // from the top, clockwise
    const [from, to] = [at(way * SWING), at(-way * SWING)];
    const arc = shape("path", "turn", `M${from}A${ROUND} ${ROUND} 0 1 ${way > 0 ? 0 : 1} ${to}`);
    const [u, v] = [-way * Math.cos(SWING), -Math.sin(SWING)].map((part, i) => (i ? -part : part));
    const tip = [to[0] + u * BARB, to[1] + v * BARB];
    const sides = [1, -1].map(s => [to[0] - (s * v * BARB) / 2.2, to[1] + (s * u * BARB) / 2.2]);
    return [arc, shape("path", "turn tip", `M${tip}L${sides[0]}L${sides[1]}Z`)];
  });
}

/** A path with a class. */
export function shape(name, look, way) {
  const element = svg_element(name);
  element.setAttribute("class", look);
  element.setAttribute("d", way);
  return element;
}

/** The similar triangles that find the pole of the current step, with their equal angles. */
export function similar_in(sheet, svg) {
  return looked_at()
    .flatMap(step => data.similar[step] ?? [])
    .flatMap(corners => {
      const circles = corners.map(point => pin(sheet, point));
      if (circles.some(circle => !circle || !svg.contains(circle))) return [];
      const points = circles.map(circle =>
        ["cx", "cy"].map(name => Number(circle.getAttribute(name))),
      );
      const [pole, a, b] = points;
      return [
        shape("path", "similar", `M${pole}L${a}L${b}Z`),
        ...angle(a, b, pole, 1),
        ...angle(b, a, pole, 2),
      ];
    });
}

/** One or two arcs between the directions from a corner to two other points. */
function angle(at, ...ends) {
  const count = ends.pop(),
    ways = ends.map(([x, y]) => Math.atan2(y - at[1], x - at[0]));
  const turn = Math.atan2(Math.sin(ways[1] - ways[0]), Math.cos(ways[1] - ways[0])) > 0 ? 1 : 0;
  return CORNERS.slice(0, count).map(radius => {
    const [from, to] = ways.map(way => [
      at[0] + radius * Math.cos(way),
      at[1] + radius * Math.sin(way),
    ]);
    return shape("path", "angle", `M${from}A${radius} ${radius} 0 0 ${turn} ${to}`);
  });
}
