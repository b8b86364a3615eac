// Marks that follow the driver: for each mark, `data` gives the results in y that its coordinates
// come from (see field_binder.py).
const BEYOND = 7, HEAD = 3.2, SHORT = 2 - 1e-6, TINY = 0.5, RING = 240, DIGITS = 4, NOTHING = 1e-6, OVER = 0.5;
const written = (number) => String(Number(number.toFixed(DIGITS)));
const point = (i) => [y[i], y[i + 1]];
const laid = (o, d, a, b) => [y[o] + a * y[d] - b * y[d + 1], y[o + 1] + a * y[d + 1] + b * y[d]];
const listed = (points) => points.map(([u, v]) => written(u) + "," + written(v)).join(" ");

const clipped = (p, q, rect) => {
  if (rect < 0) return [p, q];
  const [left, top, right, bottom] = data.rects[rect], du = q[0] - p[0], dv = q[1] - p[1];
  let low = 0, high = 1;
  for (const [way, room] of [[-du, p[0] - left], [du, right - p[0]], [-dv, p[1] - top], [dv, bottom - p[1]]]) {
    if (way === 0) {
      if (room < 0) return null;
    } else if (way < 0) low = Math.max(low, room / way);
    else high = Math.min(high, room / way);
  }
  const at = (t) => [p[0] + t * du, p[1] + t * dv];
  return low < high ? [low > 0 ? at(low) : p, high < 1 ? at(high) : q] : null;
};

const line = (p, q, rect) => {
  const part = Math.hypot(q[0] - p[0], q[1] - p[1]) > NOTHING ? clipped(p, q, rect) : null;
  return part && { x1: written(part[0][0]), y1: written(part[0][1]), x2: written(part[1][0]), y2: written(part[1][1]) };
};

const arc = (c, r, start, end) => {
  const at = (angle) => [c[0] + r * Math.cos(angle * Math.PI / 180), c[1] - r * Math.sin(angle * Math.PI / 180)];
  const pair = (p) => written(p[0]) + " " + written(p[1]), turn = Math.abs(end - start);
  return { d: `M${pair(at(start))}A${written(r)} ${written(r)} 0 ${turn > 180 ? 1 : 0} ${end > start ? 0 : 1} ${pair(at(end))}` };
};

const shapes = {
  l: (p, q, rect) => line(point(p), point(q), rect),
  f: (o, d, a, b, e, f, rect) => line(laid(o, d, a, b), laid(o, d, e, f), rect),
  r: (o, d, ...at) => ({ points: listed(at.filter((_, i) => i % 2 === 0).map((a, i) => laid(o, d, a, at[2 * i + 1]))) }),
  x: (...at) => {
    const points = [];
    for (let i = 0; i < at.length; i += 4) points.push(laid(at[i], at[i + 1], at[i + 2], at[i + 3]));
    return { points: listed(points) };
  },
  g: (...places) => ({ points: listed(places.map(point)) }),
  m: (o, d, a, b) => {
    const [u, v] = laid(o, d, a, b);
    return { cx: written(u), cy: written(v) };
  },
  a: (c, r, start, end) => (Math.abs(y[end] - y[start]) > 0.5 ? arc(point(c), y[r], y[start], y[end]) : null),
  h: (tail, tip, times = 1) => {
    const p = point(tail), q = point(tip), long = Math.hypot(q[0] - p[0], q[1] - p[1]);
    if (!(long >= SHORT * times)) return null;
    const size = Math.min(HEAD * times, 0.4 * long), u = (q[0] - p[0]) / long, v = (q[1] - p[1]) / long;
    const half = Math.max(0.25 * size, Math.min(0.5 * size, 0.6 * times)); // as in symbols.py
    const back = [q[0] - size * u, q[1] - size * v];
    return { points: listed([q, [back[0] - half * v, back[1] + half * u], [back[0] + half * v, back[1] - half * u]]) };
  },
  s: (o, d, low, high, which, rect) => {
    const at = (far) => [y[o] + far * y[d], y[o + 1] + far * y[d + 1]];
    let from = y[low], to = y[high];
    const short = to - from <= 2 * BEYOND + TINY, lowIsNear = Math.abs(from) < Math.abs(to);
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
      const turn = 2 * Math.PI * k / RING;
      points.push([y[c] + y[r] * Math.cos(turn), y[c + 1] - y[r] * Math.sin(turn)]);
    }
    return { points: listed(points) };
  },
  t: (o, d, a, b, u, v) => shifted(middles.t(o, d, a, b), u, v),
  b: (o, d, a, b, u, v, ...box) => shifted(middles.b(o, d, a, b, u, v, ...box), u, v),
  o: () => (asDrawn() ? {} : null),
};
const asDrawn = () => !led && Math.abs(reckoned - data.start) < 1e-9;
const middles = {
  t: (o, d, a, b) => laid(o, d, a, b),
  b: (o, d, a, b, u, v, width, height, room) => {
    // distance from the segment that clears the box of the upright text
    const reach = Math.abs(y[d + 1]) * width + Math.abs(y[d]) * height;
    return laid(o, d, a, Math.sign(b) * (room + reach));
  },
};
const shifted = ([u, v], fromU, fromV) => ({ transform: `translate(${written(u - fromU)} ${written(v - fromV)})` });

// The places that bound a mark.
const corners = {
  l: (p, q) => [point(p), point(q)],
  f: (o, d, a, b, e, f) => [laid(o, d, a, b), laid(o, d, e, f)],
  r: (o, d, ...at) => at.filter((_, i) => i % 2 === 0).map((a, i) => laid(o, d, a, at[2 * i + 1])),
  x: (...at) => at.filter((_, i) => i % 4 === 0).map((_, i) => laid(...at.slice(4 * i, 4 * i + 4))),
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
const grow = (times) => {
  data.fields.forEach((sheet, s) => sheet.forEach(({ first }, side) => growth.fill(times?.[s][side] ?? 1, first)));
};
const grown = (i, times = growth[i]) => {
  const [, ...own] = data.marks[i], [kind, shown, o, d, a, b, u, v, ...box] = own;
  if (times === 1) return own;
  if (kind === "h") return [...own, times];
  if (kind === "b") return [kind, shown, o, d, a, b * times, u, v, ...box.map((size) => size * times)];
  if (!standing.has(i)) return own;
  const more = kind === "f" ? [u * times, v * times, ...box] : [u, v, ...box];
  return [kind, shown, o, d, a * times, b * times, ...more];
};

const extent = (at, sheet, side, times = 1) => {
  if (!reckon(at)) return null;
  const { room, still, seen } = data.fields[sheet][side];
  const box = still ? [...still] : [Infinity, Infinity, -Infinity, -Infinity];
  for (const [i, across, down] of seen) {
    const [kind, shown, ...rest] = grown(i, times), size = kind === "t" || kind === "b" ? times : 1;
    if (shown >= 0 && !(y[shown] > 0)) continue;
    for (const [u, v] of corners[kind](...rest)) {
      if (!Number.isFinite(u) || !Number.isFinite(v)) continue;
      box[0] = Math.min(box[0], u - size * across);
      box[1] = Math.min(box[1], v - size * down);
      box[2] = Math.max(box[2], u + size * across);
      box[3] = Math.max(box[3], v + size * down);
    }
  }
  const [left, top, right, bottom] = [0, 1, 2, 3].map((k) => Math.min(Math.max(box[k], room[k % 2]), room[2 + k % 2]));
  return right >= left ? [left, top, right - left, bottom - top] : null;
};

// A label that would overlap an earlier one moves to the other side. If that is no better,
// the letter of a point stays and the label of a vector is hidden.
const overturned = ([kind, shown, o, d, a, b, ...rest]) => [kind, shown, o, d, kind === "b" ? a : -a, -b, ...rest];
const free = (record, [across, down], placed) => {
  const [u, v] = middles[record[0]](...record.slice(2));
  const hit = ([x, z, w, h]) => Math.abs(u - x) < w + across - OVER && Math.abs(v - z) < h + down - OVER;
  return placed.some(hit) ? null : [u, v, across, down];
};
const arranged = () => {
  const found = new Map();
  if (asDrawn()) return found;
  for (const { labels } of data.fields.flat()) {
    const placed = [];
    for (const label of labels) {
      const [i, ...rest] = label, own = grown(i), other = overturned(own);
      const [across, down] = rest.map((size) => size * growth[i]), sides = rest[2];
      if (own[1] >= 0 && !(y[own[1]] > 0)) continue;
      let box = free(own, [across, down], placed);
      if (!box && sides && (box = free(other, [across, down], placed))) found.set(i, other);
      else if (!box && own[0] === "b") found.set(i, null);
      placed.push(box || [...middles[own[0]](...own.slice(2)), across, down]);
      if (found.get(i) === null) placed.pop();
    }
  }
  return found;
};

const made = (id, element) => {
  // a mark that the drawn position lacks, such as the head of a vector that is too short there
  const [before, tag, cls] = data.more[id] || [], line = before && element(before);
  if (!line || !line.ownerDocument) return null;
  const mark = line.ownerDocument.createElementNS(line.namespaceURI, tag);
  for (const { name, value } of line.attributes) if (name.startsWith("data-")) mark.setAttribute(name, value);
  mark.setAttribute("id", id);
  mark.setAttribute("class", cls);
  line.after(mark);
  return mark;
};

// The attributes last given to each mark; unchanged ones are not written again.
const given = new WeakMap();
const give = (mark, name, text) => {
  const had = given.get(mark) || given.set(mark, {}).get(mark);
  if (had[name] === text) return;
  had[name] = text;
  if (text === null) mark.removeAttribute(name);
  else mark.setAttribute(name, text);
};

// The records of one sheet, or of all.
const within = (sheet) => {
  const first = (s) => data.fields[s]?.[0].first ?? data.marks.length;
  return sheet === undefined ? [0, data.marks.length] : [first(sheet), first(sheet + 1)];
};

const draw = (at, element, times, sheet, lettering) => {
  if (!reckon(at)) return { ok: false };
  grow(times);
  const turned = lettering ? lettering() : arranged();
  for (let [i, end] = within(sheet); i < end; i++) {
    const [id] = data.marks[i], mark = element(id) || made(id, element);
    if (!mark) continue;
    const [kind, shown, ...rest] = turned.get(i) || grown(i), hidden = turned.get(i) === null;
    const found = !hidden && (shown < 0 || y[shown] > 0) ? shapes[kind](...rest) : null;
    const good = found && Object.values(found).every((text) => !text.includes("NaN") && !text.includes("Infinity"));
    give(mark, "visibility", good ? null : "hidden");
    if (good) for (const name in found) give(mark, name, found[name]);
  }
  return { ok: true };
};

// The visible labels of a field: record, half size, and the records for the sides on which the
// label may lie, its own side first; and the records of its leader and circle.
const ASIDE = 7, NEARER = 0.7; // without its leader a letter lies nearer
const sides = ([kind, shown, o, d, a, b, ...rest], turns) => {
  const own = [[a, b]];
  if (kind === "b") own.push([a, -b], ...[ASIDE, -ASIDE].flatMap((by) => [[a + by, b], [a + by, -b]]));
  else if (turns) own.push(...[[-1, 0], [0, 1], [0, -1], [1.6, 0], [-1.6, 0]].map(([k, l]) => [k * a - l * b, l * a + k * b].map(far => (turns > 1 ? NEARER : 1) * far)));
  return own.map(([along, off]) => [kind, shown, o, d, along, off, ...rest]);
};
const labels = (sheet, side) => data.fields[sheet][side].labels.map(([i, across, down, turns]) => {
  const [id] = data.marks[i], own = grown(i), shown = own[1] < 0 || y[own[1]] > 0;
  const records = shown ? sides(own, turns) : [];
  return { i, id, half: [across, down], records, spots: records.map(([kind, , ...rest]) => middles[kind](...rest)), led: data.led[i] ?? [] };
});

// The place of a circle at a driver position; null where nothing closes.
const circles = new Map(data.marks.flatMap(([id, kind, , ...rest]) => (kind === "m" ? [[id, rest]] : [])));
const place = (id, at, k = -1, value = 0) => {
  if (k < 0) return circles.has(id) && reckon(at) ? laid(...circles.get(id)) : null;
  const own = x[figures[k].place];
  figure(k, value);
  const found = place(id, at);
  figure(k, own);
  return found;
};

const settled = (found) => {
  // rounding errors relative to the largest value of the kind become zero
  const most = {};
  for (const [, , kind, i] of data.values) most[kind] = Math.max(most[kind] || 0, Math.abs(y[i]));
  for (const [name, , kind, i] of data.values) found[name] = Math.abs(y[i]) < 1e-9 * most[kind] ? 0 : y[i];
  return found;
};

return {
  name: data.name, unit: data.unit, low: data.low, high: data.high, start: data.start, whole: data.whole, step: data.step,
  sense: data.sense, grips: data.grips, figures, derived: data.derived, figure, read: (i, at) => (reckon(at), y[i]), stands: data.stands,
  drawn: figures.map(({ shows }) => (reckon(data.start), y[shows])), set: draw, extent, labels, place, named: (i) => data.marks[i][0],
  values: (at) => (reckon(at) ? settled({}) : {}),
  margins: (at) => (reckon(at) ? Object.fromEntries(data.margins.map(([step, i]) => [step, y[i]])) : {}),
};
