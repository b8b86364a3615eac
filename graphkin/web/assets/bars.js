// The scale bars next to the captions of the fields, each a round number of millimetres of paper long.
import { style } from "#page";
import { written } from "./numbers.js";
import { dots } from "./zoom.js";

const LONGEST = 0.2,
  SHORTEST = 0.2; // of the narrower field's width, and of that

/** Set the bars of a sheet, given the sizes and view boxes of its fields. */
export function bars(sheet, sizes, boxes) {
  const scales = sizes.map((size, i) => dots(size, boxes[i]));
  const most = LONGEST * Math.min(...sizes.map(([across]) => across));
  if (!(most > 0)) return; // not laid out yet
  const alike = round(most / Math.max(...scales)); // both bars show the same number, chosen for the field drawn larger
  sheet.fields.forEach(({ svg }, i) => {
    const figure = svg.closest("figure"),
      long = alike * scales[i] < SHORTEST * most ? round(most / scales[i]) : alike;
    const [across, high] = sizes[i],
      [, , width, height] = boxes[i];
    const measures = { bar: long, wide: width, high: height };
    for (const [name, value] of Object.entries(measures))
      style(figure, `--${name}`, value.toFixed(2));
    style(figure, "--shown", `${high || across}px`);
    figure.querySelector(".mm").textContent = written(
      long,
      Math.max(0, -Math.floor(Math.log10(long))),
    );
  });
}

/** The largest round number that does not exceed a number. */
function round(number) {
  const power = 10 ** Math.floor(Math.log10(number)),
    first = number / power;
  return power * (first < 2 ? 1 : first < 5 ? 2 : 5);
}
