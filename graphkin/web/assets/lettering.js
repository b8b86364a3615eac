// The labels of the current sheet during motion: each keeps its side while that side is free,
// fades where it is not, and reappears where there is room.
import { byId, motion, moved, state } from "./page.js";
import { here, INK, sheets } from "./sheets.js";
import { covers, taken_in } from "./turn_marks.js";

const APART = 0.3,
  CLEAR = 1.5; // mm from other labels, and for a label that reappears in motion
const HANGS = 0.4,
  AIRY = 0.9; // mm by which letters exceed their box above and below, and in motion
const HUSH = 160; // milliseconds for which a hidden label stays away
const LEAP = 11; // dots that a label may move while the driver goes one step
const standing = new Map(); // for each label its side, visibility, last change, and place
let lettered = motion?.start; // the driver position at that time

/** The records of the labels that have left their drawn places. */
export function lettering() {
  const found = new Map(),
    gone = Math.abs(state.x - lettered) / motion.step;
  if (!moved() && gone) standing.clear();
  lettered = state.x;
  sheets[here()].fields.forEach((one, side) =>
    letter(one, motion.labels(here(), side), gone, found),
  );
  return found;
}

/** The labels placed so far in a field, each with its middle and half size, and what is free of them. */
function placed_labels() {
  const placed = [];
  return {
    push: (at, box) => placed.push([...at, ...box]),
    is_free: ([u, v], box, air) =>
      !placed.some(
        ([x, z, w, h]) => Math.abs(u - x) < w + box[0] + air && Math.abs(v - z) < h + box[1] + air,
      ),
  };
}

/** Place the labels of a field in their order. */
function letter(one, labels, gone, found) {
  const placed = placed_labels();
  for (const { text, at, half } of letters_at_rest(one, labels)) {
    // letters kept off a point are read elsewhere too
    const box = half.map(size => size * one.lettering);
    const seen = one.lettering < 1.02 || placed.is_free(at, box, 0);
    for (const part of text.parentElement.children) part.classList.toggle("hushed", !seen);
    if (seen) placed.push(at, box);
  }
  const far = LEAP * Math.max(1, gone) * (Number(one.svg.style.getPropertyValue("--dot")) || 0.3);
  const fresh = ({ id }) => Number(byId(id).matches(".now")); // labels of the current step come first
  for (const label of [...labels].sort((p, q) => fresh(q) - fresh(p))) {
    const mark = byId(label.id);
    const was = standing.get(label.id) ?? { side: 0, seen: false, since: -Infinity, spot: null };
    standing.set(label.id, was);
    if (label.spots.length && !mark.matches(".later,.void")) {
      stand(one, label, was, { mark, far, placed });
      if (was.side) found.set(label.i, label.records[was.side]);
    } else Object.assign(was, { seen: false, since: -Infinity, spot: null });
  }
}

/** Let a label stay at its side, fade where it is not free, or appear where there is room. */
function stand(one, { half, records, spots, led }, was, { mark, far, placed }) {
  const off = off_middle(mark, records[0]).map(way => way * (1 - one.lettering));
  const middles = spots.map(([u, v]) => [u + off[0], v + off[1]]);
  const at = middles[was.side],
    now = performance.now(),
    box = box_of(one, mark, half);
  const fits = spot => fits_edges(one, half, spot);
  const leapt =
    state.going && was.spot && Math.hypot(at[0] - was.spot[0], at[1] - was.spot[1]) > far;
  if (leapt || (was.seen && !(fits(at) && placed.is_free(at, box, APART)))) {
    Object.assign(was, { seen: false, since: now });
  }
  if (!was.seen && (!state.going || now - was.since >= HUSH)) {
    const air = state.going ? CLEAR : APART;
    const is_open = spot => fits(spot) && placed.is_free(spot, box, air);
    const side = clearest(one, middles, box, is_open);
    if (side >= 0) Object.assign(was, { seen: true, side });
  }
  was.spot = middles[was.side];
  if (was.seen) placed.push(was.spot, box);
  mark.classList.toggle("hushed", !was.seen);
  hush_leaders(led, !was.seen || was.side > 0); // a leader points to the drawn place
}

function hush_leaders(leaders, hushed) {
  for (const id of leaders.map(motion.named)) byId(id)?.classList.toggle("hushed", hushed);
}

/** The half size of a label on the screen, with the circle around it and what hangs out of its box. */
function box_of(one, mark, [across, down]) {
  const ring = ring_of(mark),
    hangs = state.going ? AIRY : HANGS;
  return [Math.max(across, ring), Math.max(down + hangs, ring)].map(size => size * one.lettering);
}

/** Whether a label lies within the visible edges of its field. */
function fits_edges({ edges, lettering: times }, half, spot) {
  const fits = k =>
    Math.abs(spot[k] - edges[k] - edges[k + 2] / 2) <= edges[k + 2] / 2 - half[k] * times;
  return !edges || [0, 1].every(fits);
}

/** The free side of a label that covers fewest lines, or its drawn side; in motion the first free side. */
function clearest({ svg }, middles, box, is_free) {
  const open = middles.map((_, i) => i).filter(i => is_free(middles[i]));
  if (!open[0] || open.length < 2 || state.going) return open[0] ?? -1;
  const lines = taken_in(svg).filter(({ to }) => to);
  const cost = open.map(i => lines.reduce((sum, line) => sum + covers(middles[i], box, line), 0));
  return open[cost.indexOf(Math.min(...cost))];
}

/** The radius of the circle around a link number; zero for other letters. */
function ring_of(text) {
  const ring = text.parentElement.previousElementSibling;
  return ring?.matches("circle.number") ? ring.r.baseVal.value : 0;
}

const off_middles = new WeakMap();

/** The offset from the middle about which a label is enlarged to the middle of its ink. */
function off_middle(mark, record) {
  if (!off_middles.has(mark)) {
    const { x, y, width, height } = mark.getBBox();
    off_middles.set(mark, [x + width / 2 - record[6], y + height / 2 - record[7]]);
  }
  return off_middles.get(mark);
}

/** The letters of a field that do not move, with middles and half sizes; letters of points come first. */
function letters_at_rest(one, labels) {
  if (!one.resting) {
    const moving = new Set(labels.map(({ id }) => id));
    const texts = [...one.svg.querySelectorAll(".lettering>text")].filter(
      text => !moving.has(text.id),
    );
    one.resting = texts
      .map(text => {
        const { x, y, width, height } = text.getBBox();
        return {
          text,
          at: [x + width / 2, y + height / 2],
          half: [width / 2, (INK * height) / 2].map(size => Math.max(size, ring_of(text))),
        };
      })
      .sort((p, q) => Number("of" in q.text.dataset) - Number("of" in p.text.dataset));
  }
  return one.resting.filter(
    ({ text }) =>
      !text.matches(
        moved() ? ".later,.void,[visibility],[data-aside]" : ".later,.void,[visibility]",
      ),
  );
}
