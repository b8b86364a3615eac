// As much room for words and values as the longest of them need, so that nothing jumps.
const LOW = 900; // dots of a window in which what the keys do comes below all else

/** Keep it. */
function fit() {
  const told = byId("told").cloneNode(true), values = byId("read")?.cloneNode(true);
  tallest(told, "told", [0, ...places.map((_, i) => i + 1)], step => {
    tell(told, step);
    names(told.querySelector("#from"), sources(step ? own[step] : []));
  });
  if (values) {
    values.querySelector("#place").textContent = byId("place").dataset.dead;
    tallest(values, "read", sheets.map(({ element }) => element.dataset.kind), kind => {
      values.querySelector("#values").replaceChildren(...all_asked(kind));
    });
  }
  const below = innerHeight < LOW ? byId("help").offsetHeight : 0; // there the drawing needs the room more
  style(page, "--dock", `${byId("dock").offsetHeight - below}px`);
  const box = byId("told");
  box.tabIndex = told.scrollHeight > box.clientHeight + 1 ? 0 : -1;
  look();
}

/** Tell the style sheet how tall a copy of a part is in the worst of some cases. */
function tallest(copy, name, cases, write) {
  copy.classList.add("measured");
  byId(name).after(copy);
  const sizes = cases.map(one => (write(one), copy.offsetHeight));
  copy.remove();
  style(page, `--${name}`, `${Math.max(...sizes)}px`);
}
