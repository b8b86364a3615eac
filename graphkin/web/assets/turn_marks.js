// The marks of a turn: inputs, hints, results to choose from, open lines with their names.
import { html_element, svg_element } from "./elements.js";
import { byId } from "#page";
import {
  cross,
  draw_own,
  length_of,
  minus,
  moves,
  picks,
  plus,
  scaled,
  turn,
  value_of,
} from "#turn";
import { settle_which } from "./choosing.js";
import { placed, shown_at } from "./pick_shapes.js";
import { here, INK, sheets } from "./sheets.js";

/** Mark the picks, the inputs of a hint and the choice between results; draw own lines. */
export function light_up() {
  const sheet = sheets[here()];
  const lit = [
    ...turn.taken.map(key => [key, "old"]),
    ...(turn.hinted && turn.grade > 2
      ? moves[turn.hinted].inputs.map(key => [picks[key].by || key, "new"])
      : []),
  ];
  for (const { halo, front, aims } of sheet.fields)
    for (const group of [halo, front, aims]) group.replaceChildren();
  for (const step of turn.open)
    whole_line(String(step), turn.fresh.includes(step) ? "open fresh" : "open");
  draw_own();
  for (const [key, look] of lit) put_in("halo", shown_at(key), look);
  for (const drawn of turn.wrong_line ?? []) put_in("front", drawn, "wrong");
  byId("which").replaceChildren();
  if (turn.asked) light_choice();
}

/** Number the results that a student chooses from, on the drawing and as buttons. */
function light_choice() {
  turn.asked.forEach((value, i) => {
    const found = placed(turn.asked.plane, value),
      button = html_element("button");
    const start =
      found && turn.action === "lay_off"
        ? placed(turn.asked.plane, value_of(turn.inputs[0]))
        : null;
    if (start) put_in("front", { side: found.side, from: start.at, to: found.at }, "ghost");
    if (found) {
      put_in("front", { side: found.side, at: found.at, ring: 2 }, "ghost");
      put_in(
        "front",
        { side: found.side, at: inside(found.side, plus(found.at, [3, -3])), text: String(i + 1) },
        "ghost",
      );
    }
    button.type = "button";
    button.textContent = String(i + 1);
    button.addEventListener("click", () => settle_which(i));
    byId("which").append(button);
  });
}

/**
 * A line or arc that still holds an unknown point, drawn in full, since its drawn part would reveal it.
 * @param {string} key
 * @param {string} look
 */
export function whole_line(key, look) {
  const drawn = shown_at(key);
  put_in("front", drawn, look);
  if (!drawn?.from) return;
  const { svg, lettering } = sheets[here()].fields[drawn.side],
    { x, y, width, height } = svg.viewBox.baseVal;
  const start = placed(picks[key].plane, value_of(key)[0]).at,
    unit = scaled(minus(drawn.to, drawn.from), 1 / length_of(minus(drawn.to, drawn.from)));
  const text = picks[key].name.replace(/ \(.*\)$/, ""),
    mark = put_in("front", { side: drawn.side, at: start, text }, "open"),
    ink = mark.getBBox();
  const half = [ink.width / 2, 0.4 * ink.height],
    reach = Math.abs(unit[1]) * half[0] + Math.abs(unit[0]) * half[1] + 0.7 * lettering;
  const taken = taken_in(svg, mark),
    own = one =>
      one.to && [one.from, one.to].every(end => Math.abs(cross(minus(end, start), unit)) < 0.1);
  let best = null;
  for (let far = 6; far < width + height; far += 2) {
    for (const [along, aside] of [
      [far, reach],
      [far, -reach],
      [-far, reach],
      [-far, -reach],
    ]) {
      const at = plus(plus(start, scaled(unit, along)), scaled([-unit[1], unit[0]], aside)),
        off = minus(at, [x + width / 2, y + height / 2]);
      if (Math.abs(off[0]) > width / 2 - half[0] - 1 || Math.abs(off[1]) > height / 2 - half[1] - 1)
        continue;
      const cost =
        0.02 * Math.abs(far - 22) +
        taken.filter(one => !own(one)).reduce((sum, one) => sum + covers(at, half, one), 0);
      if (!best || cost < best.cost) best = { at, cost };
    }
  }
  const [u, v] = minus(best?.at ?? start, [ink.x + ink.width / 2, ink.y + ink.height / 2]);
  mark.setAttribute("x", (start[0] + u).toFixed(2));
  mark.setAttribute("y", (start[1] + v).toFixed(2));
}

/**
 * The obstacles in a field except one label: boxes of letters and points, and lines end to end.
 * @param {PageElement} svg
 * @param {Element | null} label
 * @returns {Obstacle[]}
 */
export function taken_in(svg, label = null) {
  const marks = [
    ...svg.querySelectorAll(
      ":is(text,circle,line):not(.later,.void,[visibility],.hushed,.grip,.leader,.halo:first-of-type *,.aims *)",
    ),
  ];
  return marks
    .filter(mark => mark !== label)
    .map(mark => {
      const number = name => Number(mark.getAttribute(name));
      if (mark.matches("line"))
        return { from: [number("x1"), number("y1")], to: [number("x2"), number("y2")] };
      const { x, y, width, height } = mark.getBBox(),
        larger = mark.closest(".lettering") ? Number(svg.style.getPropertyValue("--t")) || 1 : 1;
      return {
        at: [x + width / 2, y + height / 2],
        half: [(larger * width) / 2, (larger * (mark.matches("text") ? INK : 1) * height) / 2],
        letters: mark.matches("text"),
      };
    })
    .filter(({ half }) => !half || half[0] < 20);
}

/**
 * The cost of the objects that a label of half size [a, b] would cover at a place.
 * @param {Place} at
 * @param {Place} half
 * @param {Obstacle} obstacle
 */
export function covers(at, [a, b], { from, to, at: middle, half, letters }) {
  const [u, v] = minus(at, from ? scaled(plus(from, to), 0.5) : middle).map(Math.abs);
  if (!from) return u < a + half[0] && v < b + half[1] ? (letters ? 20 : 4) : 0;
  const way = scaled(minus(to, from), 0.5),
    turned = Math.abs(cross(minus(at, from), way));
  return u < a + Math.abs(way[0]) &&
    v < b + Math.abs(way[1]) &&
    turned < a * Math.abs(way[1]) + b * Math.abs(way[0])
    ? 3
    : 0;
}

/**
 * The nearest place that has room for a digit in a field.
 * @param {number} side
 * @param {Place} place
 */
export function inside(side, [u, v]) {
  const { x, y, width, height } = sheets[here()].fields[side].svg.viewBox.baseVal;
  return [
    Math.min(Math.max(u, x + 2), x + width - 5),
    Math.min(Math.max(v, y + 6), y + height - 2),
  ];
}

/** Write a symbol into a text of a drawing, with lowered, smaller indices. */
function write_symbol(text, markup) {
  const words = html_element("span");
  words.innerHTML = markup; // escaped by its maker
  let lowered = 0; // parts of the letter height
  for (const node of words.childNodes) {
    const part = svg_element("tspan"),
      look = node.nodeName.toLowerCase();
    const shift = { sub: 0.26, sup: -0.37 }[look] ?? 0;
    part.setAttribute("dy", `${(shift - lowered) / (shift ? 0.7 : 1)}em`);
    part.setAttribute("class", look.replace("#", ""));
    part.textContent = node.textContent;
    lowered = shift;
    text.append(part);
  }
}

/**
 * Draw a stroke in a group of a field.
 * @param {"halo" | "front" | "aims"} group
 * @param {Shape | null} drawn
 * @param {string} look
 */
export function put_in(group, drawn, look) {
  if (!drawn) return;
  const { side, at, r, from, to, ring, text } = drawn;
  const mark = svg_element(text ? "text" : at ? "circle" : "line");
  const ends = text
    ? { x: at[0], y: at[1] }
    : at
      ? { cx: at[0], cy: at[1], r: r ?? ring ?? 2.2 }
      : { x1: from[0], y1: from[1], x2: to[0], y2: to[1] };
  for (const [name, number] of Object.entries(ends)) mark.setAttribute(name, number.toFixed(2));
  mark.setAttribute("class", look);
  if (text) write_symbol(mark, text);
  sheets[here()].fields[side][group].append(mark);
  return mark;
}
