// Drawing by mouse, finger or pen: what a release would take is lit, and what would come is shown dashed.
import {
  check_move,
  CHOICE,
  choices_of,
  dot,
  is_there,
  length_of,
  likewise,
  minus,
  NUMBERS_PLANE,
  picks,
  plane_of,
  plus,
  results_of,
  same_value,
  scaled,
  shape_of,
  turn,
  turning,
  value_of,
} from "#turn";
import { different, settle_which } from "./choosing.js";
import { named_from } from "./palette.js";
import { end_magnifying, magnify } from "./magnifier.js";
import { far_from, placed, shown_at } from "./pick_shapes.js";
import { take_pick, ways_of, whole_way } from "./picking.js";
import { here, sheets } from "./sheets.js";
import { inside, put_in } from "./turn_marks.js";
import { next_frame } from "./view.js";

const NEAR = { mouse: 14, touch: 26 }; // dots around a point that is meant
const SLIP = 4; // dots by which a pointer may slip in a click
export let press = null,
  latest_place = null; // the pressed pointer with what it began on, and the last place of a mouse

/**
 * The field at a place of the window, that place in mm, and the reach of a pointer there.
 * @param {any} event
 * @returns {Spot | null}
 */
export function spot_at({ clientX, clientY, pointerType }) {
  const svg = document.elementFromPoint(clientX, clientY)?.closest(".view > svg");
  const side = sheets[here()].fields.findIndex(one => one.svg === svg);
  if (side < 0) return null;
  const matrix = svg.getScreenCTM().inverse(),
    { x, y } = new DOMPoint(clientX, clientY).matrixTransform(matrix);
  return { side, at: [x, y], near: NEAR[pointerType === "touch" ? "touch" : "mouse"] * matrix.a };
}

/**
 * The picks and crossings near a place, the one most likely meant first.
 * @param {Spot | null} spot
 * @returns {{ key?: string, cross?: string[], value?: Result, rank: number }[]}
 */
export function hits_at(spot) {
  if (!spot) return [];
  const { side, at, near } = spot;
  const found = [];
  for (const key of Object.keys(picks).filter(is_there)) {
    const drawn = shown_at(key);
    if (!drawn || drawn.side !== side) continue;
    const far = far_from(at, drawn),
      ahead = drawn.at && drawn.r === undefined ? 0.6 * near : 0; // points before lines
    const later = drawn.from ? 0.01 * Math.min(length_of(minus(drawn.to, drawn.from)), 150) : 0; // of two on one line the shorter one
    if (far < near) found.push({ key, rank: far - ahead + later });
  }
  return [...found, ...crossings_at(side, at, near)].sort((a, b) => a.rank - b.rank);
}

/** Whether a pick is a line or arc that can be seen whole, so that its crossings can be pointed at. */
export const is_curve = key =>
  picks[key].kind === "locus" ||
  picks[key].kind === "guide" ||
  (picks[key].kind === "circle" && (key.startsWith("own") || turn.open.has(Number(key))));

/** The crossings of two lines or arcs near a place where no point is drawn yet. */
function crossings_at(side, at, near) {
  const curves = Object.keys(picks).filter(key => is_curve(key) && is_there(key)),
    found = [];
  const close = curves.filter(key => {
    const drawn = shown_at(key);
    return drawn?.side === side && far_from(at, drawn) < near;
  });
  close.forEach((m, i) =>
    close
      .slice(i + 1)
      .filter(n => picks[n].plane === picks[m].plane)
      .forEach(n => {
        for (const value of results_of("cut", [m, n])) {
          const one = placed(picks[m].plane, value),
            far = one && length_of(minus(at, one.at));
          if (one && far < near && !is_marked(picks[m].plane, one.at, near))
            found.push({ cross: [m, n], value, rank: far - 0.55 * near });
        }
      }),
  );
  return found;
}

/** Whether a point of a drawing is drawn at a place. */
const is_marked = (plane, at, near) =>
  Object.keys(picks).some(
    key =>
      ["point", "image", "centre"].includes(picks[key].kind) &&
      is_there(key) &&
      picks[key].plane === plane &&
      length_of(minus(placed(plane, value_of(key)).at, at)) < 0.05 * near,
  );

/**
 * What a release at a place would take, after some things that are taken: what the chosen action takes goes first.
 * @param {Spot | null} spot
 * @param {string[]} taken
 * @returns {Aim | null}
 */
function aim_at(spot, taken) {
  const aims = hits_at(spot)
    .map(hit => aim_of(hit, taken))
    .filter(Boolean);
  return aims.find(({ ways, value }) => value || ways[0].action === turn.tool) ?? aims[0] ?? null;
}

/**
 * What may be taken of one thing that was hit.
 * @param {ReturnType<typeof hits_at>[number]} hit
 * @param {string[]} taken
 * @returns {Aim | null}
 */
function aim_of({ key, cross, value }, taken) {
  if (cross)
    return !taken.length && turning.palette.cut
      ? { ways: [{ action: "cut", inputs: cross }], value }
      : null;
  if (taken.includes(key) && turn.action !== "similar") return null;
  const ways = ways_of([...taken, key]);
  return ways.length ? { key, ways } : null;
}

/**
 * The results that a whole way has to choose from; empty for a single one.
 * @param {Way} way
 * @returns {Result[]}
 */
function choices_for({ action, inputs }) {
  const found = CHOICE.includes(action) ? choices_of(action, inputs) : [],
    values = different(action, found, plane_of(action, inputs));
  return values.length > 1 ? values : [];
}

/**
 * The aim of a pressed pointer: what it began on, or what it has been dragged to.
 * @param {Spot | null} spot
 * @returns {Aim | null}
 */
function pressed_aim(spot) {
  const { aim, moved } = press,
    way = whole_way(aim.ways);
  if (!moved) return aim;
  if (!way) return spot && (aim_at(spot, [...turn.taken, aim.key]) ?? { band: [aim.key, spot] });
  const values = aim.value ? [] : choices_for(way);
  if (values.length < 2) return spot && aim_at(spot, turn.taken); // slid to something else
  const far = value =>
    length_of(minus(spot.at, placed(plane_of(way.action, way.inputs), value)?.at ?? spot.at));
  return spot && { ...aim, value: values.reduce((a, b) => (far(b) < far(a) ? b : a)) };
}

/**
 * Show what a release here would take, and what would come of it.
 * @param {Aim | null} aim
 */
export function show_aim(aim) {
  turn.aim = aim;
  for (const { aims } of sheets[here()].fields) aims.replaceChildren();
  if (!aim) return;
  const from = press?.moved && !whole_way(press.aim.ways) ? press.aim.key : turn.taken.at(-1);
  if (aim.band) return draw_band(shown_at(from), aim.band[1]);
  const way = whole_way(aim.ways);
  if (from && press?.moved && from !== aim.key) put_in("aims", shown_at(from), "lit");
  for (const key of aim.key ? [aim.key] : way.inputs) put_in("aims", shown_at(key), "lit");
  if (way) show_coming(way, aim.value);
  else name_aim(picks[aim.key].name, shown_at(aim.key));
}

/** A dashed line from what a drag began on to the pointer, within one field. */
function draw_band(drawn, { side, at }) {
  if (!drawn) return;
  put_in("aims", drawn, "lit");
  if (drawn.side === side) put_in("aims", { side, from: foot_on(drawn, at), to: at }, "band");
}

/** The place of a shape that is nearest to another place. */
function foot_on({ at, from, to }, place) {
  if (at) return at;
  const along = minus(to, from),
    share = dot(minus(place, from), along) / (dot(along, along) || 1);
  return plus(from, scaled(along, Math.min(Math.max(share, 0), 1)));
}

/**
 * Draw dashed what a whole way would give.
 * @param {Way} way
 * @param {Result} [value]
 */
function show_coming({ action, inputs }, value) {
  const plane = plane_of(action, inputs),
    results = value ? [value] : choices_of(action, inputs);
  const named = ["perpendicular", "parallel", "compass", "join"].includes(action)
    ? named_from(
        action,
        inputs.map(key => picks[key].name),
        turning.words,
      )
    : "";
  for (const one of results) {
    const drawn = drawn_as(action, plane, one, inputs);
    put_in("aims", drawn, "would");
    if (named && one === results[0]) name_aim(named, drawn);
  }
}

/**
 * How a result is drawn in its field: a line, circle, vector or point.
 * @param {string} action
 * @param {number} plane
 * @param {Result} value
 * @param {string[]} inputs
 * @returns {Shape | null}
 */
export function drawn_as(action, plane, value, inputs) {
  const shape = shape_of(action);
  if (plane === NUMBERS_PLANE) return null;
  if (shape === "circle") {
    const found = placed(plane, value.c);
    return found && { side: found.side, at: found.at, r: value.r * found.mm };
  }
  const start = placed(plane, shape === "point" ? value : value[0]);
  if (!start) return null;
  if (shape === "line") {
    const way = scaled([value[1][0], -value[1][1]], 1000 / length_of(value[1]));
    return {
      side: start.side,
      from: minus(start.at, way),
      to: plus(start.at, way),
      near: start.at,
      way: scaled(way, 0.001),
    };
  }
  if (shape === "vector")
    return { side: start.side, from: start.at, to: placed(plane, value[1]).at };
  const tail = action === "lay_off" ? placed(plane, value_of(inputs[0])) : null;
  return tail
    ? { side: start.side, from: tail.at, to: start.at }
    : { side: start.side, at: start.at };
}

/**
 * Write the name of what would be taken or come beside it.
 * @param {string} name
 * @param {Shape | null} drawn
 */
function name_aim(name, drawn) {
  if (!drawn || !name) return;
  const middle = drawn.near
    ? plus(drawn.near, scaled(drawn.way, 14))
    : (drawn.at ?? scaled(plus(drawn.from, drawn.to), 0.5));
  put_in(
    "aims",
    { side: drawn.side, at: inside(drawn.side, plus(middle, [2.5, -2.5])), text: name },
    "would",
  );
}

/**
 * Take what a release has meant.
 * @param {Aim} aim
 */
function settle_aim(aim) {
  const way = whole_way(aim.ways);
  if (!aim.value) return take_pick(aim.key);
  turn.taken = way.inputs;
  [turn.action, turn.inputs] = [way.action, way.inputs];
  const plane = plane_of(way.action, way.inputs);
  const other = choices_for(way).find(one => !same_value(way.action, one, aim.value, plane));
  const found = likewise(way.action, way.inputs, aim.value);
  check_move(way.action, way.inputs, found, plane, other);
}

/**
 * Choose one of two results by pointing at it; returns whether one was meant.
 * @param {Spot} spot
 */
function settle_asked({ side, at, near }) {
  const found = turn.asked
    .map(value => placed(turn.asked.plane, value))
    .map(one => (one?.side === side ? length_of(minus(at, one.at)) : Infinity));
  const least = found.indexOf(Math.min(...found));
  if (found[least] < 1.5 * near) settle_which(least);
}

/** Begin a press; returns whether it is one on something that can be taken. */
function begin_press(event) {
  if (press) return void drop_press(); // a second finger zooms
  const spot = event.button ? null : spot_at(event);
  if (!spot) return false;
  const aim = turn.asked ? null : aim_at(spot, turn.taken);
  if (!aim && !turn.asked) return false;
  press = { aim, x: event.clientX, y: event.clientY, moved: false, id: event.pointerId };
  show_aim(aim);
  magnify(spot, event, false);
  return true;
}

function move_press(event) {
  const far = Math.hypot(event.clientX - press.x, event.clientY - press.y);
  if (far > SLIP && press.aim) press.moved = true;
  const spot = spot_at(event);
  if (press.aim) show_aim(pressed_aim(spot));
  magnify(spot, event, far > SLIP);
}

/** Give a press up. */
function drop_press() {
  press = null;
  end_magnifying();
  show_aim(null);
}

function end_press(event) {
  const { aim: first, moved } = press,
    spot = spot_at(event);
  const aim = first && pressed_aim(spot),
    way = first && whole_way(first.ways);
  drop_press();
  if (!first) return spot && settle_asked(spot);
  if (!aim || aim.band) return; // let go over nothing
  if (moved && !way) take_pick(first.key);
  settle_aim(aim);
}

/** Follow the mouse while no button is pressed. */
function hover() {
  if (!turn || !latest_place || press) return;
  const spot =
    turn.asked || document.querySelector(".view > svg.panning") ? null : spot_at(latest_place);
  show_aim(spot && aim_at(spot, turn.taken));
  for (const { svg } of sheets[here()].fields) svg.classList.toggle("aimed", Boolean(turn.aim));
}

/** Pointers over the drawing during a turn; returns whether nothing else may follow the event. */
export function point_in_turn(event) {
  if (event.type === "pointerdown") return begin_press(event);
  if (event.type === "pointermove") {
    if (press?.id === event.pointerId) move_press(event);
    else if (event.pointerType === "mouse" && !event.buttons) {
      latest_place = event;
      next_frame(hover);
    }
    return Boolean(press);
  }
  if (press?.id !== event.pointerId) return false;
  if (event.type === "pointerup") end_press(event);
  else drop_press();
  return true;
}
