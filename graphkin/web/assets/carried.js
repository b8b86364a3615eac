// The velocity plan next to the acceleration plan, where a step takes a segment from it.
import { html_element } from "./elements.js";
import { between } from "./halos.js";
import { data, motion, moved, state } from "./page.js";
import { here, pin, sheets } from "./sheets.js";

const SMALLER = 2.4; // enlargement of the lines and letters of the small plan
const LIFTED = [".later", ".now", ".rest"].map(look => look.slice(1));
const aside = sheets.length > 1 ? small_plan() : null;

/** An empty picture in the field of the second plan, named after the first sheet. */
function small_plan() {
  const box = html_element("figure"),
    name = html_element("figcaption");
  box.className = "carried";
  box.hidden = true;
  name.textContent = sheets[0].element.querySelector("h2").textContent;
  box.append(name);
  sheets[1].fields[1].svg.parentElement.append(box);
  return box;
}

/** Show the small plan with the segments that some steps take from it; hide it where they take none. */
export function carry(steps) {
  if (!aside) return;
  const plan = sheets[0].fields[1];
  const pairs = here() === 1 ? steps.map(step => carried_by(step, plan)).filter(Boolean) : [];
  aside.hidden = !pairs.length || state.dead;
  if (aside.hidden) return;
  const lit = new Set(pairs.flat()),
    svg = plan.svg.cloneNode(true);
  for (const group of svg.querySelectorAll(".halo,.aims")) group.remove();
  for (const mark of svg.querySelectorAll("[data-at]")) {
    mark.classList.remove(...LIFTED);
    if (mark.matches("text,.leader,.construction,.square-mark") && !lit.has(mark.dataset.of))
      mark.remove();
    mark.removeAttribute("id");
  }
  const strokes = pairs.map(ends => between(...ends.map(end => pin(sheets[0], end))));
  for (const line of strokes) line.setAttribute("class", "lit");
  svg.prepend(...strokes);
  svg.removeAttribute("aria-labelledby");
  svg.setAttribute("aria-label", aside.firstChild.textContent);
  const [x, y, across, high] = moved() ? motion.extent(state.x, 0, 1) : plan.drawn,
    edge = 0.08 * Math.max(across, high);
  svg.setAttribute(
    "viewBox",
    [x - edge, y - edge, across + 2 * edge, high + 2 * edge]
      .map(number => number.toFixed(2))
      .join(" "),
  );
  svg.classList.add("larger");
  svg.removeAttribute("style");
  svg.style.setProperty("--g", String(SMALLER));
  svg.style.setProperty("--t", String(SMALLER));
  aside.replaceChildren(aside.firstChild, svg);
  seat(sheets[1].fields[1].svg);
}

/** Put the small plan into the corner of its field where it covers least of the drawing. */
function seat(svg) {
  const place = svg.getScreenCTM(),
    room = svg.getBoundingClientRect(),
    own = aside.getBoundingClientRect();
  const lines = [...svg.querySelectorAll("line[data-of]:not(.later,.void,[visibility])")];
  const spots = lines.flatMap(({ x1, y1, x2, y2 }) =>
    [0, 0.25, 0.5, 0.75, 1].map(part => {
      const [x, y] = [
        [x1, x2],
        [y1, y2],
      ].map(([a, b]) => a.baseVal.value + part * (b.baseVal.value - a.baseVal.value));
      const { x: u, y: v } = new DOMPoint(x, y).matrixTransform(place);
      return [
        u < room.left + own.width + 8,
        u > room.right - own.width - 8,
        v > room.bottom - own.height - 8,
        v < room.top + own.height + 8,
      ];
    }),
  );
  const corners = [
    ["left", "bottom"],
    ["right", "bottom"],
    ["left", "top"],
    ["right", "top"],
  ];
  const covered = corners.map(
    ([side, end]) =>
      spots.filter(
        ([left, right, low, high]) =>
          (side === "left" ? left : right) && (end === "bottom" ? low : high),
      ).length,
  );
  const [side, end] = corners[covered.indexOf(Math.min(...covered))];
  aside.dataset.corner = `${side} ${end}`;
}

/** The two images of the first plan whose segment a step sets on the mechanism; null for other steps. */
function carried_by(step, plan) {
  const [mark] = sheets[1].of.get(String(step)) ?? [];
  if (!mark || !sheets[1].fields[0].svg.contains(mark)) return null;
  const images = (data.from[step] ?? []).map(String).filter(source => {
    const circle = pin(sheets[0], source);
    return circle && plan.svg.contains(circle);
  });
  return images.length === 2 ? images : null;
}
