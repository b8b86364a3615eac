// The sentences: each is a link in the list, and the current one is shown above the keys.
import { html_element } from "./elements.js";
import { point_at } from "./aiming.js";
import { tint } from "./halos.js";
import { written } from "./numbers.js";
import { byId, copies, data, last, motion, moved, slider, state } from "./page.js";
import { fit, told_by_keys } from "./room.js";
import { sheets } from "./sheets.js";
import { size_read } from "./values.js";

export const places = [...document.querySelectorAll("#steps li")].map((item, i) => {
  const link = html_element("a");
  link.href = `#step=${i + 1}`;
  link.dataset.number = String(i + 1);
  link.append(...item.childNodes);
  item.append(link);
  return {
    link,
    say: link.querySelector(".say"),
    why: link.querySelector(".why"),
    aside: link.querySelector(".aside"),
    crossings: [...link.querySelectorAll(".crossing")],
    drawn: /** @type {Node[] | null} */ (null), // the sentence as it was written
  };
});

/** The crossings listed with a step; none at the beginning. */
export const crossings_of = step => places[step - 1]?.crossings ?? [];

/** Show the sentence of the step and mark it in the list; at the beginning, show the task. */
export function say() {
  const count = state.step
    ? data.count.replace("{number}", state.step).replace("{all}", last)
    : data.task[0];
  byId("count").textContent = count;
  slider.setAttribute("aria-valuetext", count);
  tell(byId("narration"), state.step);
  tell_read();
  byId("narration").scrollTop = 0;
  told_by_keys();
  places.forEach(({ link }, i) => current(link, i + 1 === state.step, "step"));
  list_in_sight();
  stops.forEach(({ dataset }, i) => {
    const is = Number(dataset.stop) <= state.step && state.step <= Number(dataset.end);
    current(stops[i], is, "true");
    if (is) stop_list.value = dataset.stop;
  });
}

export const stops = [...byId("stops").children],
  stop_list = byId("stops").appendChild(html_element("select")); // buttons, or a list where there is no room for them
stop_list.append(
  ...stops.map(({ lastChild, dataset }) => new Option(lastChild.textContent.trim(), dataset.stop)),
);
stop_list.setAttribute("aria-label", byId("stops").getAttribute("aria-label"));

/** Scroll the list to the sentence of the step. */
export function list_in_sight() {
  const list = byId("steps"),
    { offsetTop, offsetHeight } = places[Math.max(state.step - 1, 0)].link;
  if (list.scrollHeight > list.clientHeight + 4)
    list.scrollTop = offsetTop - list.offsetTop - (list.clientHeight - offsetHeight) / 2;
}

let by_hand = false; // whether the reader opened or closed the reason
export const opened_by_hand = () => {
  by_hand = true;
};

/** Scroll the reason into view after the reader has opened it. */
export function reason_in_sight() {
  fit();
  const narration = byId("narration"),
    reason = byId("reason");
  const hidden =
    reason.offsetTop + reason.offsetHeight - narration.offsetTop - narration.clientHeight;
  if (by_hand && byId("because").open && hidden > 0)
    narration.scrollTop = Math.min(hidden, reason.offsetTop - narration.offsetTop);
  by_hand = false;
}

/** Mark an element as the current one, or unmark it. */
function current(element, is, word) {
  if (is) element.setAttribute("aria-current", word);
  else element.removeAttribute("aria-current");
}

/** Write the sentence of a step, its reasons, its note, and its flattest crossing. */
export function tell(narration, step) {
  const { say: words, why, aside } = places[step - 1] ?? {};
  narration.querySelector("#sentence").replaceChildren(...(words ? copies(words) : [data.task[1]]));
  narration.querySelector("#reason").replaceChildren(...lines(why));
  narration.querySelector("#because").hidden = !why;
  narration.querySelector("#behind").hidden = !step;
  narration.querySelector("#aside").replaceChildren(...(aside ? copies(aside) : []));
  warn(narration, crossings_of(step));
}

/** Write what is read at the driver's position: for the current step, and after a movement in the list. */
export function tell_read() {
  const told = step => step in data.rates || step in data.open;
  for (const step of state.going ? [state.step] : places.map((_, i) => i + 1).filter(told)) {
    tell_rates_of(step);
    tell_lengths_of(step);
  }
  if (told(state.step)) byId("sentence").replaceChildren(...copies(places[state.step - 1].say));
}

const GAP = /\ue000(\d+)\ue001/g;

/** Write the lengths of vectors into the sentence of a step, once they or the rates are no longer as drawn. */
function tell_lengths_of(step) {
  if (!(step in data.open)) return;
  const place = places[step - 1],
    [open, fallen] = data.open[step];
  place.drawn ??= copies(place.say);
  const values = moved() && !state.dead ? motion.values(state.x) : null;
  const length_of = arrow => {
    const [row, kind] = data.lengths[arrow];
    return values ? written(Math.abs(values[row]) / data.scales[kind], 2) : "?";
  };
  const arrows = [...open.matchAll(GAP)].map(([, arrow]) => arrow);
  const holds = arrows.length
    ? arrows.every(arrow => length_of(arrow) === data.lengths[arrow][2])
    : state.figures.every((value, k) => value === motion?.figures[k].start);
  if (!moved() || holds)
    return place.say.replaceChildren(...place.drawn.map(one => one.cloneNode(true)));
  const is_zero = arrows.length && arrows.every(arrow => length_of(arrow) === "0");
  place.say.innerHTML = is_zero ? fallen : open.replace(GAP, (_, arrow) => length_of(arrow)); // markup of symbols, escaped by its maker
}

/** Write the rates into the sentence of a step. */
function tell_rates_of(step) {
  const place = places[step - 1],
    read = data.rates[step];
  if (!read) return;
  place.drawn ??= copies(place.say);
  place.say.replaceChildren(
    ...(moved()
      ? read.flatMap(({ row, text: name }, i) => {
          const { cells } = document.querySelector(`#results [data-row="${CSS.escape(row)}"]`),
            start = html_element("span");
          start.innerHTML = `${i ? data.between : ""}${name} = `; // markup of symbols, escaped by its maker
          return [start, ...(state.dead ? ["?"] : size_read([...cells]))];
        })
      : place.drawn),
  );
}

/** The reasons as lines in the colours of their strokes; buttons where a stroke can be highlighted. */
function lines(why) {
  return [...(why?.children ?? [])].map(reason => {
    const step = reason.dataset.for,
      drawn = sheets.some(({ of }) => of.has(step));
    const line = html_element(drawn ? "button" : "p");
    line.append(...copies(reason));
    line.className = drawn ? `line ${tint(step)}` : "line";
    if (drawn) line.dataset.for = step;
    return line;
  });
}

/** Highlight only the stroke of the reason pointed at. */
export function light(event) {
  point_at(event.target.closest("[data-for]")?.dataset.for ?? null);
}

/** Write the flattest of some crossings. */
export function warn(narration, crossings) {
  const factor = line => Number(line.querySelector(".factor").textContent.replace(data.mark, "."));
  const worst = crossings.reduce((a, b) => (a && factor(a) >= factor(b) ? a : b), null);
  narration.querySelector("#crossing").replaceChildren(...(worst ? copies(worst) : []));
}
