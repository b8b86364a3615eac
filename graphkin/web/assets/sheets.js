// The sheets with their marks and fields, and the extent of marks.
import { svg_element } from "./elements.js";
import { data, state } from "#page";

export const INK = 0.7; // part of the line height that letters fill
const marksBut = gone => `.lettering:not(:has(${gone})),*:not(g,text,tspan,.centre-line,${gone})`; // a group holds its shift
export const SEEN = marksBut(".later,.void,[visibility]"),
  PLACED = marksBut(".void,[visibility]");

/** @type {Sheet[]} */
export const sheets = [...document.querySelectorAll(".sheet")].map(element => {
  const marks = [...element.querySelectorAll("svg [data-at]")];
  const of = new Map();
  for (const mark of marks) {
    const step = mark.dataset.of;
    if (step) of.set(step, [...(of.get(step) ?? []), mark]);
  }
  const parts = element.querySelectorAll("[data-from]"); // letters that share a label
  return {
    element,
    marks,
    parts,
    of,
    fields: [...element.querySelectorAll(".view svg")].map(field),
  };
});

/**
 * A field: its picture, groups below and above the marks, its box, the box of all marks, and its labels.
 * @param {PageElement} svg
 * @returns {Field}
 */
function field(svg) {
  const above = [...svg.children].find(mark => !mark.matches(".plate,.disc,.gear-disc")) ?? null; // not beneath filled areas
  const halo = svg.insertBefore(svg_element("g"), above);
  const front = svg.appendChild(svg_element("g"));
  const aims = svg.appendChild(svg_element("g")); // what a pointer or a typed line would take
  for (const group of [halo, front]) group.setAttribute("class", "halo");
  aims.setAttribute("class", "aims");
  const { x, y, width, height } = svg.viewBox.baseVal;
  svg.style.aspectRatio = `${width} / ${height}`; // whatever part of it is shown
  const sizes = [...svg.querySelectorAll(".lettering :is([font-size])")].map(run =>
    Number(run.getAttribute("font-size")),
  );
  return {
    svg,
    halo,
    front,
    aims,
    whole: [x, y, width, height],
    drawn: extent(svg, PLACED),
    labels: labels_in(svg, ".void,[visibility]"),
    least: Math.min(...sizes, 3),
    view: null,
    edges: null,
  };
}

/**
 * The labels of a picture or part with their boxes; notes are flagged, since they grow right and upwards.
 * @param {ParentNode} part
 * @param {string} gone a selector of labels that are not shown
 * @returns {Label[]}
 */
export function labels_in(part, gone) {
  return [...part.querySelectorAll(`:is(.lettering>text,.number):not(${gone})`)].map(mark => ({
    mark,
    box: mark.getBBox(),
    note: mark.matches("[data-name=note]"),
  }));
}

/** The box of labels enlarged about their middles. */
export function labels_reach(labels, times) {
  const ends = labels.map(({ box: { x, y, width, height } }) => {
    const [across, down] = [width, height].map(size => ((times - 1) * size) / 2);
    return [x - across, y - down, x + width + across, y + height + down];
  });
  const [left, top, right, bottom] = [0, 1, 2, 3].map(k =>
    Math[k < 2 ? "min" : "max"](...ends.map(end => end[k])),
  );
  return [left, top, right - left, bottom - top];
}

/**
 * The box of the marks in a picture or a part of it.
 * @param {ParentNode} part
 * @param {string} marks a selector
 * @returns {Box | null}
 */
export function extent(part, marks) {
  const boxes = [...part.querySelectorAll(marks)].map(mark => mark.getBBox());
  const [left, top] = ["x", "y"].map(axis => Math.min(...boxes.map(box => box[axis])));
  const right = Math.max(...boxes.map(box => box.x + box.width));
  const bottom = Math.max(...boxes.map(box => box.y + box.height));
  return boxes.length ? [left, top, right - left, bottom - top] : null;
}

/** The number of the current sheet. */
export function here() {
  return data.bounds.findIndex(([, end]) => state.step <= end);
}

/**
 * The circle that shows a point.
 * @param {Sheet} sheet
 * @param {string | number} point
 */
export function pin(sheet, point) {
  return (sheet.of.get(String(point)) ?? []).find(mark => mark.matches("circle:not(.void)"));
}
