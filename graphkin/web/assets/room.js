// Room for words and values, as much as the longest of them need, so that nothing jumps.
import { byId, own, page, style } from "./page.js";
import { list_in_sight, places, tell } from "./sentences.js";
import { here, sheets } from "./sheets.js";
import { names, sources } from "./tracing.js";
import { all_asked } from "./values.js";
import { EDGE, LEAST, look } from "./zoom.js";

const NARROWEST = 0.36; // least part of the width for a field
const ROOM = 14,
  FOLD = 3; // dots between the drawing, the keys and the window edge; the same where the help is below
const LOW = 1000; // dots of a window in which the help comes below all else
const BESIDE = matchMedia("(min-width:60.01rem) and (min-height:34.01rem)"); // as in steps.css: words next to the drawing

/** Put the words next to the drawing, or between the drawing and the keys. */
function seat_words() {
  const narration = byId("narration"),
    place = BESIDE.matches ? byId("page") : byId("dock");
  if (narration.parentElement !== place) place.prepend(narration);
}

/** Let keys scroll the words where they do not fit. */
export function told_by_keys() {
  const narration = byId("narration");
  narration.tabIndex = narration.scrollHeight > narration.clientHeight + 1 ? 0 : -1;
}

/** Reserve the room. */
export function fit() {
  seat_words();
  const narration = byId("narration").cloneNode(true),
    values = byId("read")?.cloneNode(true);
  tallest(narration, "narration", [0, ...places.map((_, i) => i + 1)], step => {
    tell(narration, step);
    names(narration.querySelector("#from"), sources(step ? own[step] : []));
  });
  if (values) {
    values.querySelector("#place").textContent = byId("place").dataset.dead;
    tallest(
      values,
      "read",
      sheets.map(({ element }) => element.dataset.kind),
      kind => {
        values.querySelector("#values").replaceChildren(...all_asked(kind, true));
      },
    );
  }
  const below = innerHeight < LOW ? byId("help").offsetHeight : 0; // in a low window the drawing needs the room more
  style(page, "--dock", `${byId("dock").offsetHeight - below}px`);
  const seen = sheets[here()].element.querySelector(".view");
  style(
    page,
    "--above",
    `${Math.ceil(seen.getBoundingClientRect().top + scrollY + (below ? FOLD : ROOM))}px`,
  );
  told_by_keys();
  sheets.forEach(share);
  look();
  list_in_sight();
}

/** Divide a sheet's width so that both fields are drawn at the same size. */
function share({ element, fields }) {
  const sides = fields.map(({ drawn, whole }) =>
    drawn ? Math.max(drawn[2] + 2 * EDGE, LEAST) : whole[2],
  );
  const [left, right] = sides.map(side => Math.max(side, NARROWEST * (sides[0] + sides[1])));
  for (const [name, wide] of [
    ["--left", left],
    ["--right", right],
  ])
    style(element.querySelector(".fields"), name, `${wide.toFixed(1)}fr`);
}

/** Give the style sheet the largest height of a part over some cases, measured on a copy. */
function tallest(copy, name, cases, write) {
  copy.classList.add("measured");
  byId(name).after(copy);
  const sizes = cases.map(one => (write(one), copy.offsetHeight));
  copy.remove();
  style(page, `--${name}`, `${Math.max(...sizes)}px`);
}
