// What is looked at: all that is drawn in each field, or what is marked so large that it can be read.
const READABLE = 3.2; // dots to the millimetre at which lettering of 2.5 mm can be read
const EDGE = 7, LEAST = 60; // mm about what is looked at, and its least width
const AIR = 3, MOST = [0.6, 3.5]; // mm about what a field is shifted or grows for; parts of the mechanism's and the plan's field beyond its edges that are shown
const KEPT = [2, Infinity]; // how many times smaller than as drawn a field can be and lettering keep its size
let wanted = null; // whether what is marked is to be shown large; as the screen is, until one says
const DRAWN = sheets.map(() => [1, 1]); // as where the scene stands
let grown = DRAWN; // how many times larger what keeps its size is drawn in each field

/** Show the fields in sight so. */
function look() {
  const sheet = sheets[here()];
  const sizes = sheet.fields.map(({ svg }) => [svg.clientWidth, svg.clientHeight]); // read, then written
  const near = wanted ?? SMALL.matches;
  const done = !sheet.element.classList.contains("growing");
  follow.setAttribute("aria-pressed", near);
  if (near || state.dead) keep_size(DRAWN); // then what is looked at is found by what is drawn
  const boxes = sheet.fields.map((one, i) => {
    const room = roomy(one, sizes[i], here(), i);
    return near ? closer(sizes[i], room, extent(done ? one.svg : one.halo, SEEN)) : room;
  });
  const times = sheet.fields.map((one, i) => kept(one, sizes[i], boxes[i], i));
  keep_size(sheets.map(one => one === sheet ? times : [1, 1]));
  sheet.fields.forEach(({ svg }, i) => {
    const readable = READABLE / dots(sizes[i], boxes[i]);
    style(svg, "--dot", (1 / dots(sizes[i], boxes[i])).toFixed(3));
    frame(svg, boxes[i], times[i], Math.min(readable, (near ? 2 : 1.3) * times[i]));
  });
  bars(sheet, sizes, boxes);
}

/** Show every field as it is on paper. */
function whole() {
  const paper = sheets.map(({ fields }, sheet) => fields.map((one, side) => {
    const box = roomy(one, one.whole.slice(2), sheet, side);
    return [one.svg, box, kept(one, one.whole.slice(2), box, side)];
  }));
  keep_size(paper.map(fields => fields.map(([, , times]) => times)));
  for (const [svg, box, times] of paper.flat()) frame(svg, box, times, times);
  sheets.forEach((sheet, i) => bars(sheet, sheet.fields.map(({ whole }) => whole.slice(2)), paper[i].map(([, box]) => box)));
}

/** Show a box of a field, what keeps its size and the lettering so many times larger. */
function frame(svg, box, times, lettering) {
  svg.setAttribute("viewBox", box.map(number => number.toFixed(2)).join(" "));
  svg.classList.toggle("larger", lettering > 1.02);
  style(svg, "--g", times.toFixed(2));
  style(svg, "--t", lettering.toFixed(2));
}

/** How many times smaller than as drawn a field is shown in a box, as far as lettering then keeps its size. */
function kept({ whole, drawn }, picture, box, side) {
  const smaller = dots(picture, closer(picture, whole, drawn)) / dots(picture, box);
  return Math.min(KEPT[side], Math.max(1, Math.round(10 * smaller) / 10));
}

/** Draw what keeps its size on the screen so many times larger in each field. */
function keep_size(times) {
  if (!moved() || String(times) === String(grown)) return;
  put(times);
  halos();
}

/** Put the marks where the driver stands; tells whether the mechanism closes there. */
function put(times = moved() ? grown : DRAWN) {
  grown = times;
  return motion.set(state.x, byId, times).ok;
}

/** Show what is marked large, or all that is drawn. */
function zoom() {
  wanted = follow.getAttribute("aria-pressed") !== "true";
  look();
}

/** Dots of the screen to a millimetre of a box in a picture of a size. */
function dots([across, high], [, , width, height]) {
  return Math.min(across / width, high / height) || READABLE;
}

/** The part of a field in which all is drawn, shifted for what has moved out of it, and larger where that is not enough. */
function roomy(one, picture, sheet, side) {
  const { svg, whole, drawn } = one, base = closer(picture, whole, drawn);
  const known = () => svg.clientWidth ? extent(svg, MOVED) : null; // without what has no place
  const found = swept(sheet, side) ?? (moved() && (state.dead ? known() : motion.extent(state.x, sheet, side)));
  if (!found) return base;
  const box = about(found, base, whole, MOST[side]), times = kept(one, picture, box, side);
  if (times === 1 || state.dead) return box;
  return about(motion.extent(state.x, sheet, side, times), base, whole, MOST[side]);
}

/** A box so shifted, and if need be so much larger, that another lies in it with some air about it. */
function about(found, base, whole, most) {
  const [starts, sizes] = [[], []];
  for (const axis of [0, 1]) {
    const reach = most * whole[axis + 2];
    const low = Math.max(found[axis] - AIR, whole[axis] - reach);
    const high = Math.min(found[axis] + found[axis + 2] + AIR, whole[axis] + whole[axis + 2] + reach);
    const size = Math.max(base[axis + 2], high - low);
    starts.push(Math.min(Math.max(base[axis], high - size), low));
    sizes.push(size);
  }
  return [...starts, ...sizes];
}

/** The part of a field about a box, in the shape of its picture and not beyond the field. */
function closer([across, high], whole, found) {
  if (!found) return whole;
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
