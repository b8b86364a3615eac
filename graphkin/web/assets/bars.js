// The bars beside the fields' captions: as long as a round number of millimetres of paper is there.
const LONGEST = 0.2, SHORTEST = 0.2; // of the narrower field's width, and of that

/** Set those of a sheet whose fields are shown so. */
function bars(sheet, sizes, boxes) {
  const scales = sizes.map((size, i) => dots(size, boxes[i]));
  const most = LONGEST * Math.min(...sizes.map(([across]) => across));
  if (!(most > 0)) return; // not laid out yet
  const alike = round(most / Math.max(...scales)); // one number for both shows where more is drawn to a dot
  sheet.fields.forEach(({ svg }, i) => {
    const figure = svg.closest("figure"), long = alike * scales[i] < SHORTEST * most ? round(most / scales[i]) : alike;
    const [across, high] = sizes[i], [, , width, height] = boxes[i];
    const told = { bar: long, wide: width, high: height };
    for (const [name, value] of Object.entries(told)) style(figure, `--${name}`, value.toFixed(2));
    style(figure, "--shown", `${high || across}px`);
    figure.querySelector(".mm").textContent = written(long, Math.max(0, -Math.floor(Math.log10(long))));
  });
}

/** The longest round number not above another. */
function round(number) {
  const power = 10 ** Math.floor(Math.log10(number)), first = number / power;
  return power * (first < 2 ? 1 : first < 5 ? 2 : 5);
}
