// The frame of each field: all that is drawn, or the marked parts, enlarged until legible.
import { grips, halos, lettering, shape } from "#marks";
import { byId, follow, motion, moved, SMALL, state, STILL, style } from "#page";
import { bars } from "./bars.js";
import { extent, here, labels_in, labels_reach, SEEN, sheets } from "./sheets.js";
import { viewed } from "./view.js";

const READABLE = 3.2; // dots per millimetre at which lettering of 2.5 mm is legible
export const EDGE = 7,
  LEAST = 60; // mm around the content, and least width of the frame
const AIR = 3,
  MOST = 0.12,
  PIN = 6; // mm around content that moves or grows the frame; part of a field shown beyond its edges; mm around a pin
const HEM = 0.5,
  GROWS = 0.15,
  ROUNDS = 4; // mm around letters at the edge; largest growth per side for letters, in parts of the field; rounds of growth
const PLACES = 72,
  NEARLY = 0.75; // positions of a motion that are examined; part of them whose drawing is in the frame
const LEGIBLE = 9.1,
  LARGEST = 6,
  GLIDE = 250; // dots of the smallest lettering, largest magnification; milliseconds from frame to frame
const KEPT = [2, Infinity]; // largest reduction of each field at which lettering keeps its size
let wanted = null; // whether the marked parts are enlarged; null follows the screen

/** Show all that is drawn, on screens of any size. */
export function show_all() {
  wanted = false;
}
export const DRAWN = sheets.map(() => [1, 1]); // factors at the position of the scene
let grown = DRAWN; // magnification of what keeps its size, for each field

/** Set the frames of the current fields; `glides` animates the change. */
export function look(glides = false) {
  const sheet = sheets[here()];
  const sizes = sheet.fields.map(({ svg }) => [svg.clientWidth, svg.clientHeight]); // read, then written
  const near = wanted ?? SMALL.matches;
  const done = !sheet.element.classList.contains("growing");
  follow.setAttribute("aria-pressed", near);
  const rooms = sheet.fields.map((one, i) => {
    const room = roomy(one, sizes[i], here(), i);
    if (one.view) return viewed(one.view, sizes[i]);
    return near ? closer(sizes[i], room, extent(done ? one.svg : one.halo, SEEN)) : room;
  });
  const times = sheet.fields.map((one, i) => kept(one, sizes[i], rooms[i], i)),
    before = sheet.fields.map(one => one.lettering);
  const grows = (one, i, box) =>
    legible(one, dots(sizes[i], box), (near ? 2 : 1.3) * times[i], LARGEST * times[i]);
  const boxes = sheet.fields.map((one, i) => {
    const labels = (
      near ? labels_in(done ? one.svg : one.halo, ".later,.void,[visibility],.hushed") : one.labels
    ).filter(({ note }) => !note);
    return one.view || moved() || !labels.length
      ? rooms[i]
      : around(labels, rooms[i], box => grows(one, i, box));
  });
  keep_size(sheets.map(one => (one === sheet ? times : [1, 1])));
  sheet.fields.forEach((one, i) => {
    style(one.svg, "--dot", (1 / dots(sizes[i], boxes[i])).toFixed(3));
    one.edges = one.view || near ? null : in_sight(boxes[i], sizes[i]); // in a partial view, labels extend beyond the edge
    frame(one, boxes[i], times[i], grows(one, i, boxes[i]), glides);
  });
  if (motion && !state.going && sheet.fields.some((one, i) => one.lettering !== before[i])) {
    // letters of another size have other places
    put();
    halos();
  }
  sheet.fields.forEach((one, i) => mark_beyond(one, in_sight(boxes[i], sizes[i])));
  bars(sheet, sizes, boxes);
}

/**
 * Mark where lines continue beyond the visible part of a field, once nothing moves.
 * @param {Field} field
 * @param {Box} box
 */
function mark_beyond({ svg, front, view }, [x, y, width, height]) {
  for (const mark of front.querySelectorAll(".beyond")) mark.remove();
  if (!moved() || state.going || view) return;
  front.append(
    ...[
      ...svg.querySelectorAll("line[data-of]:not(.later,.void,.leader,.centre-line,[visibility])"),
    ].flatMap(line => {
      const [u, v, p, q] = ["x1", "y1", "x2", "y2"].map(name => line[name].baseVal.value),
        way = [p - u, q - v];
      const ends = [
        [x - u, x + width - u],
        [y - v, y + height - v],
      ].map((edges, k) => edges.map(edge => edge / way[k]).sort((a, b) => a - b));
      const [low, high] = [Math.max(ends[0][0], ends[1][0]), Math.min(ends[0][1], ends[1][1])];
      return low < high
        ? [low > 0 && low < 1 && [low, -1], high > 0 && high < 1 && [high, 1]]
            .filter(Boolean)
            .map(([part, sense]) => {
              const mark = shape("path", "beyond", "M-14-5l5 5-5 5M-8-5l5 5-5 5");
              mark.style.transform = `translate(${u + part * way[0]}px,${v + part * way[1]}px) rotate(${Math.atan2(sense * way[1], sense * way[0])}rad) scale(var(--dot))`;
              return mark;
            })
        : [];
    }),
  );
}

/** The magnification of lettering at a scale: up to `most` for easy reading, up to `largest` for legibility. */
function legible({ least }, scale, most, largest) {
  return Math.max(Math.min(READABLE / scale, most), Math.min(LEGIBLE / (scale * least), largest));
}

/** A box with room for all labels at the size that they have in it. */
function around(labels, base, grows) {
  let box = base;
  const within = ([low, size], k) => [
    Math.max(low, base[k] - GROWS * base[k + 2]),
    Math.min(low + size, base[k] + (1 + GROWS) * base[k + 2]),
  ];
  for (let round = 0; round < ROUNDS; round += 1) {
    const reach = labels_reach(labels, Math.max(grows(box), 1));
    const [[left, right], [top, bottom]] = [0, 1].map(k => within([reach[k], reach[k + 2]], k));
    box = about([left, top, right - left, bottom - top], base, HEM);
  }
  return box;
}

/** Limit the growth of a label to the room that it has. */
function crowd({ labels, edges }, lettering) {
  for (const { mark, box, note } of labels) {
    const shell = mark.closest(".lettering");
    if (!shell) continue;
    const [left, right] =
      edges && !moved()
        ? [box.x - edges[0], edges[0] + edges[2] - box.x - box.width]
        : [Infinity, Infinity];
    const room = 1 + ((note ? right : 2 * Math.min(left, right)) - HEM) / box.width;
    style(shell, "--t", room < lettering ? Math.max(room, 1).toFixed(2) : "");
  }
}

/** Show every field as on paper, for printing. */
export function whole() {
  const paper = sheets.map(({ fields }, sheet) =>
    fields.map((one, side) => {
      const box = roomy(one, one.whole.slice(2), sheet, side);
      return { one, box, times: kept(one, one.whole.slice(2), box, side) };
    }),
  );
  keep_size(paper.map(fields => fields.map(({ times }) => times)));
  for (const { one, box, times } of paper.flat()) {
    one.edges = null;
    frame(one, box, times, times);
  }
  sheets.forEach((sheet, i) =>
    bars(
      sheet,
      sheet.fields.map(({ whole }) => whole.slice(2)),
      paper[i].map(({ box }) => box),
    ),
  );
}

/**
 * Show a box of a field, with the magnifications of fixed-size parts and of lettering.
 * @param {Field} one
 * @param {Box} box
 * @param {number} times
 * @param {number} lettering
 */
function frame(one, box, times, lettering, glides = false) {
  one.lettering = Math.max(lettering, 1);
  one.svg.classList.toggle("larger", lettering > 1.02);
  style(one.svg, "--g", times.toFixed(2));
  style(one.svg, "--t", lettering.toFixed(2));
  crowd(one, lettering);
  cancelAnimationFrame(one.gliding);
  if (glides && one.box && !STILL.matches) glide(one, one.box, box, performance.now());
  else framed(one, box);
}

/** Show a box of a field at once. */
export function framed(one, box) {
  one.box = box;
  one.svg.setAttribute("viewBox", box.map(number => number.toFixed(2)).join(" "));
}

/** Move from one box of a field to another, slowly at both ends. */
function glide(one, from, to, since) {
  one.gliding = requestAnimationFrame(now => {
    const part = Math.min(Math.max((now - since) / GLIDE, 0), 1),
      share = part * part * (3 - 2 * part);
    framed(
      one,
      to.map((end, i) => from[i] + share * (end - from[i])),
    );
    if (part < 1) glide(one, from, to, since);
  });
}

/**
 * The reduction of a field in a box, as far as lettering keeps its size.
 * @param {Field} field
 * @param {number[]} picture
 * @param {Box} box
 * @param {number} side
 */
function kept({ whole, drawn }, picture, box, side) {
  const smaller = dots(picture, closer(picture, whole, drawn)) / dots(picture, box);
  return Math.min(KEPT[side], Math.max(1, Math.round(10 * smaller) / 10));
}

/** Set the magnification of what keeps its size on the screen, for each field. */
function keep_size(times) {
  if (!moved() || String(times) === String(grown)) return;
  put(times);
  halos();
}

/** Put the marks of the current sheet at the driver's position; returns whether the mechanism closes. */
export function put(times = moved() ? grown : DRAWN) {
  grown = times;
  return motion.set(state.x, byId, times, here(), lettering).ok;
}

/** Switch between the marked parts, enlarged, and all that is drawn. */
export function zoom() {
  wanted = follow.getAttribute("aria-pressed") !== "true";
  look();
}

/**
 * Dots of the screen per millimetre of a box in a picture of a given size.
 * @param {number[]} size
 * @param {Box} box
 */
export function dots([across, high], [, , width, height]) {
  return Math.min(across / width, high / height) || READABLE;
}

/**
 * The part of a field that a picture shows when it must show a box.
 * @param {Box} box
 * @param {number[]} picture
 * @returns {Box}
 */
function in_sight(box, picture) {
  const [x, y, width, height] = box,
    size = picture.map(each => each / dots(picture, box));
  return [x - (size[0] - width) / 2, y - (size[1] - height) / 2, ...size];
}

/**
 * The frame of all that is drawn in a field; for a moving field, the frame of the whole motion.
 * @param {Field} one
 * @param {number[]} picture
 * @param {number} sheet
 * @param {number} side
 */
function roomy(one, picture, sheet, side) {
  const { whole, drawn } = one,
    base = closer(picture, whole, drawn);
  const begins = state.step === 0 && sheet + side === 0;
  const found = motion && (moved() || begins) && all_the_way(sheet, side);
  const frame = found ? about(found, base) : base;
  const rests = moved() && !state.going && !state.dead && motion.extent(state.x, sheet, side);
  return rests ? about(rests, frame) : frame; // after the motion the frame includes what has left it
}

/** The box of a field over most of the motion and all paths of its pins; constant during the motion. */
function all_the_way(sheet, side) {
  const one = sheets[sheet].fields[side];
  if (one.motion === undefined) {
    const { low, high } = motion,
      at = Array.from({ length: PLACES + 1 }, (_, i) => low + ((high - low) * i) / PLACES);
    const found = at.map(x => motion.extent(x, sheet, side)).filter(Boolean),
      pins = side
        ? []
        : grips[sheet].flatMap(({ by, way }) => (by.k < 0 ? way : [])).filter(Boolean);
    const end = (k, sign) => {
      const ends = found
        .map(box => sign * (sign < 0 ? box[k] : box[k] + box[k + 2]))
        .sort((p, q) => p - q);
      const edge =
        one.whole[k] + (sign < 0 ? 0 : one.whole[k + 2]) + sign * MOST * one.whole[k + 2];
      return (
        sign *
        Math.max(
          Math.min(ends[Math.floor(NEARLY * (ends.length - 1))], sign * edge),
          ...pins.map(place => sign * place[k] + PIN),
        )
      );
    };
    const [left, top, right, bottom] = [end(0, -1), end(1, -1), end(0, 1), end(1, 1)];
    one.motion = found.length ? [left, top, right - left, bottom - top] : null;
  }
  return one.motion;
}

/**
 * A box moved, and enlarged if necessary, to hold another box with some air around it.
 * @param {Box} found
 * @param {Box} base
 * @param {number} [air]
 * @returns {Box}
 */
function about(found, base, air = AIR) {
  const [starts, sizes] = [[], []];
  for (const axis of [0, 1]) {
    const low = found[axis] - air,
      high = found[axis] + found[axis + 2] + air;
    const size = Math.max(base[axis + 2], high - low);
    starts.push(Math.min(Math.max(base[axis], high - size), low));
    sizes.push(size);
  }
  return [...starts, ...sizes];
}

/**
 * The part of a field around a box, in the shape of its picture and within the field; all of it without a box or a picture.
 * @param {number[]} size
 * @param {Box} whole
 * @param {Box | null} found
 * @returns {Box}
 */
function closer([across, high], whole, found) {
  if (!found || !across || !high) return whole;
  const shape = across / high;
  const needed = Math.max(found[2] + 2 * EDGE, LEAST, (found[3] + 2 * EDGE) * shape);
  const width = Math.min(needed, Math.max(whole[2], whole[3] * shape));
  const size = [width, width / shape];
  const starts = [0, 1].map(axis => {
    const spare = whole[axis + 2] - size[axis];
    const centred = found[axis] + (found[axis + 2] - size[axis]) / 2;
    if (spare <= 0) return whole[axis] + spare / 2;
    return Math.min(Math.max(centred, whole[axis]), whole[axis] + spare);
  });
  return [...starts, ...size];
}
