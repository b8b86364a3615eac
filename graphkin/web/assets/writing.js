// The strokes of a step as a pen draws them, one by one; arcs with their swinging radius.
import { svg_element } from "./elements.js";
import { shape } from "./highlights.js";
import { STROKES } from "./page_actions.js";
import { STILL } from "./page.js";
import { here, sheets } from "./sheets.js";

const PACE = 5,
  QUICK = 350,
  SLOW = 900,
  MOST_OF_ALL = 2600; // ms per mm of a stroke, least and most for one stroke, most for all
const WIDE = Math.PI / 3,
  FADES = 900; // radians drawn to each side of a tick, ms in which the arc fades
let written_at = 0,
  strokes_left = [];

/** Draw the strokes of the current step. */
export function write() {
  lift();
  if (STILL.matches || document.hidden) return;
  const sheet = sheets[here()];
  const fresh = sheet.marks.filter(mark =>
    mark.matches(".now:not(.void,[visibility],[data-aside])"),
  );
  const lines = fresh.filter(
    mark =>
      mark.matches("line,path,polyline") &&
      mark.matches(STROKES) &&
      !mark.matches(".leader,.arrowhead"),
  );
  const order = mark => Number(mark.dataset.of ?? 1e9);
  lines.sort((a, b) => order(a) - order(b));
  if (!lines.length) return;
  const times = lines.map(mark => Math.min(Math.max(PACE * mark.getTotalLength(), QUICK), SLOW));
  const quicker = Math.min(1, MOST_OF_ALL / times.reduce((a, b) => a + b, 0));
  let start = 0;
  strokes_left = lines.map((mark, i) => {
    const path = mark.matches(".compass") ? whole_arc(mark) : { line: bare(mark) };
    const group = mark.ownerSVGElement.appendChild(svg_element("g"));
    const one = { radius: null, ...path, mark, group, start, end: (start += times[i] * quicker) };
    one.line.setAttribute("pathLength", 1);
    group.setAttribute("class", "pen");
    if (one.radius) group.append(one.radius);
    group.append(one.line, shape("path", "nib", "M0,0L1,-3.4L9,-11.4L11.4,-9L3.4,-1Z"));
    return one;
  });
  for (const mark of fresh) mark.classList.add("unwritten");
  for (const { svg } of sheet.fields) svg.classList.add("writing");
  const from = performance.now(),
    next = now => {
      if (!move_pen(now - from, fresh)) lift();
      else written_at = requestAnimationFrame(next);
    };
  written_at = requestAnimationFrame(next);
}

/** Move the pen to its place after some milliseconds; returns whether anything is left to draw. */
function move_pen(time, fresh) {
  for (const one of strokes_left) {
    const part = Math.min(Math.max((time - one.start) / (one.end - one.start), 0), 1);
    one.line.style.strokeDashoffset = 1 - part;
    one.group.style.opacity =
      time < one.start ? 0 : Math.min(1, Math.max(0, 1 - (time - one.end) / FADES));
    const nib = one.group.lastChild,
      { x, y } = one.line.getPointAtLength(part * one.line.getTotalLength());
    nib.setAttribute("transform", `translate(${x} ${y})`);
    nib.style.opacity = time >= one.start && part < 1 ? 1 : 0;
    if (one.radius) {
      one.radius.setAttribute("x2", x);
      one.radius.setAttribute("y2", y);
      one.radius.style.opacity = part < 1 ? 1 : 0;
    }
    if (part === 1 && one.mark.matches(".unwritten")) reveal(fresh, one.mark);
  }
  const last = strokes_left.at(-1).end;
  if (time > last) for (const mark of fresh) mark.classList.remove("unwritten");
  return time < last + FADES;
}

/** Show a drawn mark, and its companions once all of its step is drawn. */
function reveal(fresh, mark) {
  mark.classList.remove("unwritten");
  const step = mark.dataset.of,
    open = strokes_left.some(one => one.mark.matches(".unwritten") && one.mark.dataset.of === step);
  if (step && !open)
    for (const one of fresh) if (one.dataset.of === step) one.classList.remove("unwritten");
}

/** Remove the pen and show the whole step. */
export function lift() {
  if (!written_at) return;
  cancelAnimationFrame(written_at);
  written_at = 0;
  for (const { group } of strokes_left) group.remove();
  strokes_left = [];
  for (const look of ["unwritten", "writing"])
    for (const one of document.querySelectorAll(`.${look}`)) one.classList.remove(look);
}

/** The shape of a mark alone. */
function bare(mark) {
  const copy = mark.cloneNode();
  for (const { name } of [...copy.attributes])
    if (name === "id" || name.startsWith("data-")) copy.removeAttribute(name);
  copy.setAttribute("class", "ink");
  return copy;
}

/** The arc around a tick, wide to both sides, and the radius that swings about its centre. */
function whole_arc(mark) {
  const long = mark.getTotalLength(),
    [p, q, r] = [0, long / 2, long].map(at => mark.getPointAtLength(at));
  const [a, b, c, d] = [q.x - p.x, q.y - p.y, r.x - q.x, r.y - q.y],
    twice = 2 * (a * d - b * c);
  if (Math.abs(twice) < 1e-6) return { line: bare(mark) };
  const [e, f] = [
    q.x ** 2 - p.x ** 2 + q.y ** 2 - p.y ** 2,
    r.x ** 2 - q.x ** 2 + r.y ** 2 - q.y ** 2,
  ];
  const x = (e * d - b * f) / twice,
    y = (a * f - e * c) / twice,
    radius = Math.hypot(q.x - x, q.y - y);
  const middle = Math.atan2(q.y - y, q.x - x),
    at = turn => [x + radius * Math.cos(turn), y + radius * Math.sin(turn)];
  const line = shape(
    "path",
    "ink",
    `M${at(middle - WIDE)}A${radius} ${radius} 0 0 1 ${at(middle + WIDE)}`,
  );
  const leg = svg_element("line");
  leg.setAttribute("class", "leg");
  leg.setAttribute("x1", x);
  leg.setAttribute("y1", y);
  return { line, radius: leg };
}
