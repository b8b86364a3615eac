// Marker-pen strokes beneath the marks of some steps and their sources, and above them the heads of
// all drawn vectors, large enough to show where the vectors point.
import { svg_element } from "./elements.js";
import { carry } from "./carried.js";
import { rates_in, similar_in, turning_in } from "./highlights.js";
import { data, page, state } from "./page.js";
import { here, pin, sheets } from "./sheets.js";
import { looked_at, sources } from "./tracing.js";

const TINTS = 4; // number of colours that separate the points of one sentence
const ARROW = 12,
  CORNER = 2.2,
  NONE = 0.5; // mm: velocity at its pin, right angle, least velocity shown
const TIP = 12,
  SHARE = 0.55; // dots of a head, and its largest share of the vector; its size is in steps.css
export const UNMARKED =
  ".later,.void,.hushed,[visibility],.arrowhead,.leader,.square-mark,.caption,.detail,[data-aside]";

/** The class of the colour of a step. */
export function tint(step) {
  return `t${(data.tints[step] ?? 0) % TINTS}`;
}

/** Draw the strokes in each visible field; in a student's turn only the picks are highlighted. */
export function halos() {
  if (page.classList.contains("turning")) return;
  const sheet = sheets[here()],
    steps = looked_at(),
    from = sources(steps);
  const fresh = state.over
    ? steps.flatMap(step => sheet.of.get(step) ?? [])
    : sheet.marks.filter(mark => mark.classList.contains("now"));
  carry(steps);
  for (const { svg, halo, front } of sheet.fields) {
    const strokes = steps.flatMap(step => side(sheet, svg, data.sides[step] ?? []));
    strokes.push(...steps.flatMap(step => squares(sheet, svg, data.squares[step] ?? [])));
    const add = (mark, look) => {
      if (svg.contains(mark) && !mark.matches(UNMARKED)) strokes.push(stroke(mark, look));
    };
    for (const step of from) for (const mark of sheet.of.get(step) ?? []) add(mark, "old");
    for (const mark of fresh) add(mark, `new ${tint(mark.dataset.of)}`);
    if (!state.over) strokes.push(...rates_in(sheet, svg), ...similar_in(sheet, svg));
    halo.replaceChildren(...strokes);
    front.replaceChildren(
      ...fresh.filter(mark => svg.contains(mark)).flatMap(head),
      ...turning_in(svg),
    );
  }
}

/** A stroke in the shape of a mark. */
export function stroke(mark, look) {
  const copy = mark.cloneNode(true),
    shell = mark.closest(".lettering")?.cloneNode();
  for (const name of ["id", "data-at", "data-of"]) copy.removeAttribute(name);
  copy.setAttribute("class", look);
  shell?.append(copy);
  return shell ?? copy;
}

/** The side of the mechanism to which a line of the plan is perpendicular. */
function side(sheet, svg, points) {
  const [p, q] = points.map(point => pin(sheet, point));
  return p && q && svg.contains(p) ? [between(p, q)] : [];
}

/** A stroke from one pin to another. */
export function between(p, q) {
  const line = svg_element("line");
  line.setAttribute("class", "side");
  for (const [end, mark] of [
    ["1", p],
    ["2", q],
  ]) {
    for (const axis of ["x", "y"]) line.setAttribute(axis + end, mark.getAttribute("c" + axis));
  }
  return line;
}

/** A velocity at its pin with the right angle to its line; in its plan a stroke. */
function squares(sheet, svg, points) {
  const [at, pole, image] = points.map(point => pin(sheet, point));
  if (!image || !pole || !at) return [];
  if (svg.contains(pole)) return [between(pole, image)];
  const [[x, y], tail, tip] = [at, pole, image].map(circle =>
    ["cx", "cy"].map(name => Number(circle.getAttribute(name))),
  );
  const size = Math.hypot(tip[0] - tail[0], tip[1] - tail[1]);
  if (size < NONE) return [];
  const [u, v] = [(tip[0] - tail[0]) / size, (tip[1] - tail[1]) / size];
  const place = (along, across) => `${x + along * u - across * v},${y + along * v + across * u}`;
  const drawn = (name, points, look) => {
    const line = svg_element(name);
    line.setAttribute("points", points.join(" "));
    line.setAttribute("class", look);
    return line;
  };
  return [
    drawn("polyline", [place(0, 0), place(ARROW, 0)], "aid"),
    drawn("polygon", [place(ARROW, 0), place(ARROW - 3, 0.6), place(ARROW - 3, -0.6)], "aid head"),
    drawn("polyline", [place(CORNER, 0), place(CORNER, CORNER), place(0, CORNER)], "aid"),
  ];
}

/** The head of a vector again, at the size in the style sheet; none without a place or a line. */
function head(mark) {
  const line = mark.previousElementSibling;
  if (
    !mark.matches(".arrowhead:not(.later,.void,[visibility],[data-aside])") ||
    line?.tagName !== "line"
  )
    return [];
  const [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(name => Number(line.getAttribute(name)));
  const { x, y } = mark.points[0],
    [u, v] = [x - (x1 + x2) / 2, y - (y1 + y2) / 2];
  const most = (SHARE * Math.hypot(x2 - x1, y2 - y1)) / TIP,
    copy = svg_element("polygon");
  copy.setAttribute("class", `arrowhead ${mark.classList[1]}`);
  copy.setAttribute("points", `0,0 ${-TIP},${-TIP / 3} ${-TIP},${TIP / 3}`);
  copy.style.transform = `translate(${x}px,${y}px) rotate(${Math.atan2(v, u)}rad) scale(min(max(var(--dot),var(--least)),${most}))`;
  return [copy];
}
