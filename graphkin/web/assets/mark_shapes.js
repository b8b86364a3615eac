// The shapes of marks that follow the driver: for each mark, `data` gives the results in y that its
// coordinates come from (see field_binder.py).
const BEYOND = 7,
  HEAD = 3.2,
  SHORT = 2 - 1e-6,
  TINY = 0.5,
  RING = 240,
  DIGITS = 4,
  NOTHING = 1e-6;

const written = number => String(Number(number.toFixed(DIGITS)));
const listed = points => points.map(([u, v]) => written(u) + "," + written(v)).join(" ");
/** @param {Place} place */
const shifted = ([u, v], fromU, fromV) => ({
  transform: `translate(${written(u - fromU)} ${written(v - fromV)})`,
});

const arc = (c, r, start, end) => {
  const at = angle => [
    c[0] + r * Math.cos((angle * Math.PI) / 180),
    c[1] - r * Math.sin((angle * Math.PI) / 180),
  ];
  const pair = p => written(p[0]) + " " + written(p[1]),
    turn = Math.abs(end - start);
  return {
    d: `M${pair(at(start))}A${written(r)} ${written(r)} 0 ${turn > 180 ? 1 : 0} ${end > start ? 0 : 1} ${pair(at(end))}`,
  };
};

/** The attributes, middles and corners of marks from the results of a construction. */
export function mark_shapes(data, { y, asDrawn }) {
  const point = i => [y[i], y[i + 1]];
  const laid = (o, d, a, b) => [y[o] + a * y[d] - b * y[d + 1], y[o + 1] + a * y[d + 1] + b * y[d]];

  const clipped = (p, q, rect) => {
    if (rect < 0) return [p, q];
    const [left, top, right, bottom] = data.rects[rect],
      du = q[0] - p[0],
      dv = q[1] - p[1];
    let low = 0,
      high = 1;
    for (const [way, room] of [
      [-du, p[0] - left],
      [du, right - p[0]],
      [-dv, p[1] - top],
      [dv, bottom - p[1]],
    ]) {
      if (way === 0) {
        if (room < 0) return null;
      } else if (way < 0) low = Math.max(low, room / way);
      else high = Math.min(high, room / way);
    }
    const at = t => [p[0] + t * du, p[1] + t * dv];
    return low < high ? [low > 0 ? at(low) : p, high < 1 ? at(high) : q] : null;
  };

  const line = (p, q, rect) => {
    const part = Math.hypot(q[0] - p[0], q[1] - p[1]) > NOTHING ? clipped(p, q, rect) : null;
    return (
      part && {
        x1: written(part[0][0]),
        y1: written(part[0][1]),
        x2: written(part[1][0]),
        y2: written(part[1][1]),
      }
    );
  };

  const shapes = {
    l: (p, q, rect) => line(point(p), point(q), rect),
    f: (o, d, a, b, e, f, rect) => line(laid(o, d, a, b), laid(o, d, e, f), rect),
    r: (o, d, ...at) => ({
      points: listed(at.filter((_, i) => i % 2 === 0).map((a, i) => laid(o, d, a, at[2 * i + 1]))),
    }),
    x: (...at) => {
      const points = [];
      for (let i = 0; i < at.length; i += 4)
        points.push(laid(at[i], at[i + 1], at[i + 2], at[i + 3]));
      return { points: listed(points) };
    },
    g: (...places) => ({ points: listed(places.map(point)) }),
    m: (o, d, a, b) => {
      const [u, v] = laid(o, d, a, b);
      return { cx: written(u), cy: written(v) };
    },
    a: (c, r, start, end) =>
      Math.abs(y[end] - y[start]) > 0.5 ? arc(point(c), y[r], y[start], y[end]) : null,
    h: (tail, tip, times = 1) => {
      const p = point(tail),
        q = point(tip),
        long = Math.hypot(q[0] - p[0], q[1] - p[1]);
      if (!(long >= SHORT * times)) return null;
      const size = Math.min(HEAD * times, 0.4 * long),
        u = (q[0] - p[0]) / long,
        v = (q[1] - p[1]) / long;
      const half = Math.max(0.25 * size, Math.min(0.5 * size, 0.6 * times)); // as in symbols.py
      const back = [q[0] - size * u, q[1] - size * v];
      return {
        points: listed([
          q,
          [back[0] - half * v, back[1] + half * u],
          [back[0] + half * v, back[1] - half * u],
        ]),
      };
    },
    s: (o, d, low, high, which, rect) => {
      const at = far => [y[o] + far * y[d], y[o + 1] + far * y[d + 1]];
      let from = y[low],
        to = y[high];
      const short = to - from <= 2 * BEYOND + TINY,
        lowIsNear = Math.abs(from) < Math.abs(to);
      if (which === 3) from = to - 2 * BEYOND;
      if (which === 2 && short) return null;
      if ((which === 1 || which === 2) && !short) {
        if (lowIsNear === (which === 1)) to = from + BEYOND;
        else from = to - BEYOND;
      }
      return line(at(from), at(to), rect);
    },
    i: (c, r) => {
      const points = [];
      for (let k = 0; k <= RING; k++) {
        const turn = (2 * Math.PI * k) / RING;
        points.push([y[c] + y[r] * Math.cos(turn), y[c + 1] - y[r] * Math.sin(turn)]);
      }
      return { points: listed(points) };
    },
    t: (o, d, a, b, u, v) => shifted(middles.t(o, d, a, b), u, v),
    b: (o, d, a, b, u, v, ...box) => shifted(middles.b(o, d, a, b, u, v, ...box), u, v),
    o: () => (asDrawn() ? {} : null),
  };
  const middles = {
    t: (o, d, a, b) => laid(o, d, a, b),
    b: (o, d, a, b, u, v, width, height, room) => {
      // distance from the segment that clears the box of the upright text
      const reach = Math.abs(y[d + 1]) * width + Math.abs(y[d]) * height;
      return laid(o, d, a, Math.sign(b) * (room + reach));
    },
  };

  // The places that bound a mark.
  const corners = {
    l: (p, q) => [point(p), point(q)],
    f: (o, d, a, b, e, f) => [laid(o, d, a, b), laid(o, d, e, f)],
    r: (o, d, ...at) =>
      at.filter((_, i) => i % 2 === 0).map((a, i) => laid(o, d, a, at[2 * i + 1])),
    x: (...at) =>
      at.filter((_, i) => i % 4 === 0).map((_, i) => laid(...at.slice(4 * i, 4 * i + 4))),
    g: (...places) => places.map(point),
    h: (tail, tip) => [point(tip)],
    m: (o, d, a, b) => [laid(o, d, a, b)],
    t: (o, d, a, b) => [laid(o, d, a, b)],
    b: (o, d, a, b) => [laid(o, d, a, b)],
  };

  // What keeps its size on the screen is drawn larger in a field shown smaller: the heads of
  // arrows, and the distances of labels with their leaders.
  const growth = new Float64Array(data.marks.length).fill(1);
  const standing = new Set(data.fields.flat().flatMap(({ off }) => off));
  const grow = times => {
    data.fields.forEach((sheet, s) =>
      sheet.forEach(({ first }, side) => growth.fill(times?.[s][side] ?? 1, first)),
    );
  };
  const grown = (i, times = growth[i]) => {
    const [, ...own] = data.marks[i],
      [kind, shown, o, d, a, b, u, v, ...box] = own;
    if (times === 1) return own;
    if (kind === "h") return [...own, times];
    if (kind === "b")
      return [kind, shown, o, d, a, b * times, u, v, ...box.map(size => size * times)];
    if (!standing.has(i)) return own;
    const more = kind === "f" ? [u * times, v * times, ...box] : [u, v, ...box];
    return [kind, shown, o, d, a * times, b * times, ...more];
  };
  return { shapes, middles, corners, laid, grow, grown, growth };
}
