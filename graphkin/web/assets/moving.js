// What the page moves: marks and labels at a position of the driver, their extents, and the values there.
import { construction_of } from "./closing.js";
import { mark_shapes } from "./mark_shapes.js";

const OVER = 0.5; // mm by which two labels may overlap
const ASIDE = 7,
  NEARER = 0.7; // without its leader a letter lies nearer

/** Give each mark its whole id; a number goes on with the prefix of the mark before. */
function name_marks(marks) {
  let prefix = "";
  for (const mark of marks) {
    if (typeof mark[0] === "number") mark[0] = prefix + mark[0];
    else prefix = mark[0].replace(/\d*$/, "");
  }
}

/**
 * The mechanism of a page that moves.
 * @param {any} data
 * @param {(x: Float64Array, y: Float64Array) => void} run printed from the trace
 * @param {(x: Float64Array, led: boolean) => boolean} [close] what must be closed before
 */
export function moving(data, run, close = () => true) {
  name_marks(data.marks);
  const { x, y, figures, figure, reckon, asDrawn } = construction_of(data, run, close);
  const { shapes, middles, corners, laid, grow, grown, growth } = mark_shapes(data, { y, asDrawn });

  const extent = (at, sheet, side, times = 1) => {
    if (!reckon(at)) return null;
    const { room, still, seen, reach } = data.fields[sheet][side];
    const box = still ? [...still] : [Infinity, Infinity, -Infinity, -Infinity];
    for (const i of seen) {
      const [across, down] = reach[i] ?? [0, 0];
      const [kind, shown, ...rest] = grown(i, times),
        size = kind === "t" || kind === "b" ? times : 1;
      if (shown >= 0 && !(y[shown] > 0)) continue;
      for (const [u, v] of corners[kind](...rest)) {
        if (!Number.isFinite(u) || !Number.isFinite(v)) continue;
        box[0] = Math.min(box[0], u - size * across);
        box[1] = Math.min(box[1], v - size * down);
        box[2] = Math.max(box[2], u + size * across);
        box[3] = Math.max(box[3], v + size * down);
      }
    }
    const [left, top, right, bottom] = [0, 1, 2, 3].map(k =>
      Math.min(Math.max(box[k], room[k % 2]), room[2 + (k % 2)]),
    );
    return right >= left ? [left, top, right - left, bottom - top] : null;
  };

  // A label that would overlap an earlier one moves to the other side. If that is no better,
  // the letter of a point stays and the label of a vector is hidden.
  const overturned = ([kind, shown, o, d, a, b, ...rest]) => [
    kind,
    shown,
    o,
    d,
    kind === "b" ? a : -a,
    -b,
    ...rest,
  ];
  const free = (record, [across, down], placed) => {
    const [u, v] = middles[record[0]](...record.slice(2));
    const hit = ([x, z, w, h]) =>
      Math.abs(u - x) < w + across - OVER && Math.abs(v - z) < h + down - OVER;
    return placed.some(hit) ? null : [u, v, across, down];
  };
  const arranged = () => {
    const found = new Map();
    if (asDrawn()) return found;
    for (const { labels, reach } of data.fields.flat()) {
      const placed = [];
      for (const [i, sides] of labels) {
        const own = grown(i),
          other = overturned(own);
        const [across, down] = reach[i].map(size => size * growth[i]);
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
    const [before, tag, cls] = data.more[id] || [],
      line = before && element(before);
    if (!line || !line.ownerDocument) return null;
    const mark = line.ownerDocument.createElementNS(line.namespaceURI, tag);
    for (const { name, value } of line.attributes)
      if (name.startsWith("data-")) mark.setAttribute(name, value);
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
  const within = sheet => {
    const first = s => data.fields[s]?.[0].first ?? data.marks.length;
    return sheet === undefined ? [0, data.marks.length] : [first(sheet), first(sheet + 1)];
  };

  const draw = (at, element, times, sheet, lettering) => {
    if (!reckon(at)) return { ok: false };
    grow(times);
    const turned = lettering ? lettering() : arranged();
    for (let [i, end] = within(sheet); i < end; i++) {
      const [id] = data.marks[i],
        mark = element(id) || made(id, element);
      if (!mark) continue;
      const [kind, shown, ...rest] = turned.get(i) || grown(i),
        hidden = turned.get(i) === null;
      const found = !hidden && (shown < 0 || y[shown] > 0) ? shapes[kind](...rest) : null;
      const good =
        found &&
        Object.values(found).every(text => !text.includes("NaN") && !text.includes("Infinity"));
      give(mark, "visibility", good ? null : "hidden");
      if (good) for (const name in found) give(mark, name, found[name]);
    }
    return { ok: true };
  };

  // The visible labels of a field: record, half size, and the records for the sides on which the
  // label may lie, its own side first; and the records of its leader and circle.
  const sides = ([kind, shown, o, d, a, b, ...rest], turns) => {
    const own = [[a, b]];
    if (kind === "b")
      own.push(
        [a, -b],
        ...[ASIDE, -ASIDE].flatMap(by => [
          [a + by, b],
          [a + by, -b],
        ]),
      );
    else if (turns)
      own.push(
        ...[
          [-1, 0],
          [0, 1],
          [0, -1],
          [1.6, 0],
          [-1.6, 0],
        ].map(([k, l]) =>
          [k * a - l * b, l * a + k * b].map(far => (turns > 1 ? NEARER : 1) * far),
        ),
      );
    return own.map(([along, off]) => [kind, shown, o, d, along, off, ...rest]);
  };
  const labels = (sheet, side) => {
    const { labels: own_labels, reach } = data.fields[sheet][side];
    return own_labels.map(([i, turns]) => {
      const [id] = data.marks[i],
        own = grown(i),
        shown = own[1] < 0 || y[own[1]] > 0;
      const records = shown ? sides(own, turns) : [];
      return {
        i,
        id,
        half: reach[i],
        records,
        spots: records.map(([kind, , ...rest]) => middles[kind](...rest)),
        led: data.led[i] ?? [],
      };
    });
  };

  // The place of a circle at a driver position; null where nothing closes.
  const circles = new Map(
    data.marks.flatMap(([id, kind, , ...rest]) => (kind === "m" ? [[id, rest]] : [])),
  );
  const place = (id, at, k = -1, value = 0) => {
    if (k < 0) return circles.has(id) && reckon(at) ? laid(...circles.get(id)) : null;
    const own = x[figures[k].place];
    figure(k, value);
    const found = place(id, at);
    figure(k, own);
    return found;
  };

  const settled = found => {
    // rounding errors relative to the largest value of the kind become zero
    const most = {};
    for (const [, , kind, i] of data.values) most[kind] = Math.max(most[kind] || 0, Math.abs(y[i]));
    for (const [name, , kind, i] of data.values)
      found[name] = Math.abs(y[i]) < 1e-9 * most[kind] ? 0 : y[i];
    return found;
  };

  return {
    name: data.name,
    unit: data.unit,
    low: data.low,
    high: data.high,
    start: data.start,
    whole: data.whole,
    step: data.step,
    sense: data.sense,
    grips: data.grips,
    figures,
    derived: data.derived,
    figure,
    read: (i, at) => (reckon(at), y[i]),
    drawn_at: data.drawn_at,
    drawn: figures.map(({ shows }) => (reckon(data.start), y[shows])),
    set: draw,
    extent,
    labels,
    place,
    named: i => data.marks[i][0],
    values: at => (reckon(at) ? settled({}) : {}),
    margins: at =>
      reckon(at) ? Object.fromEntries(data.margins.map(([step, i]) => [step, y[i]])) : {},
  };
}
