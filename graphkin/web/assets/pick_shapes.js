// Where picks lie on the screen, as points, segments, lines and circles in mm of a field.
import { dot, length_of, minus, picks, plus, scaled, turn, turning, value_of } from "#turn";
import { here, pin, sheets } from "./sheets.js";

export const UNSEEN = ["length", "rate", "vector", "angle"]; // kinds of picks that are drawn nowhere
/**
 * The field of a sheet that shows a value of a drawing, and the place in it in mm.
 * @param {number} plane
 * @param {Place} value
 * @returns {{ side: number, at: Place, mm: number } | null}
 */
export function placed(plane, value) {
  const [plan, ...fields] = turning.fields[here()],
    side = plane === 0 ? 0 : 1;
  if (plane !== 0 && plane !== plan) return null;
  const [x, y, re, im, mm] = fields[side];
  return { side, at: [x + (value[0] - re) * mm, y - (value[1] - im) * mm], mm };
}

/**
 * The shape at which a pick can be pointed at: a point, segment, line or circle of a field.
 * @param {string} key
 * @returns {Shape | null}
 */
export function shown_at(key) {
  const pick = picks[key];
  if (pick.on?.length) {
    const [p, q] = pick.on.map(end =>
      picks[end] ? placed(picks[end].plane, value_of(end)) : circle_of(end),
    );
    return p && q && { side: p.side, from: p.at, to: q.at };
  }
  if (UNSEEN.includes(pick.kind)) return null;
  const value = value_of(key);
  if (pick.kind === "circle") {
    const found = placed(pick.plane, value.c);
    return found && { side: found.side, at: found.at, r: value.r * found.mm };
  }
  if (pick.kind === "locus" || pick.kind === "guide") {
    const p = placed(pick.plane, value[0]),
      unit = scaled(value[1], 1 / length_of(value[1]));
    return p && { side: p.side, ...stretch(p.side, key, p.at, [unit[0], -unit[1]]) };
  }
  const point = placed(pick.plane, value);
  return point && { side: point.side, at: point.at };
}

/** The drawn circle of a point that is no input itself, such as a corner of a triangle. */
function circle_of(step) {
  const sheet = sheets[here()],
    circle = pin(sheet, step);
  return (
    circle && {
      side: sheet.fields.findIndex(({ svg }) => svg.contains(circle)),
      at: ["cx", "cy"].map(name => Number(circle.getAttribute(name))),
    }
  );
}

/** The drawn extent of a line, or the whole field where no mark shows the line. */
function stretch(side, key, at, unit) {
  const sheet = sheets[here()],
    svg = sheet.fields[side].svg;
  const mark =
    !turn.open.has(Number(key)) &&
    (sheet.of.get(key) ?? []).find(one => one.tagName === "line" && svg.contains(one));
  if (mark) {
    const [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(name => Number(mark.getAttribute(name)));
    return { from: [x1, y1], to: [x2, y2] };
  }
  return { from: plus(at, scaled(unit, -1000)), to: plus(at, scaled(unit, 1000)) };
}

/**
 * The distance, in mm, of a place of a field from a shape.
 * @param {Place} place
 * @param {Shape} shape
 */
export function far_from(place, { at, r, from, to }) {
  if (at) return Math.abs(length_of(minus(place, at)) - (r ?? 0));
  const along = minus(to, from),
    size = dot(along, along) || 1;
  const share = Math.min(Math.max(dot(minus(place, from), along) / size, 0), 1);
  return length_of(minus(place, plus(from, scaled(along, share))));
}
