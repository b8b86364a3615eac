// The drawings, and the numbers next to them.

import { find, onSpeaking, say } from "./talk.js";

const old = find("old");
const shown = find("shown");
const all = find("drawings");
const names = ["mechanism", "velocity", "acceleration"];
const SMALLEST = 1.8; // px per millimetre of paper, next to the text
const NARROW = 2.6; // the same below the text
const narrow = matchMedia("(max-width: 60rem)");
const phone = matchMedia("(max-width: 40rem)"); // where a field is as high as its drawing
const sheet = new CSSStyleSheet();
let rules = "";
let numbers = { results: "", margins: "" }; // of the current drawing
let checked = ""; // words of the independent check of the current drawing
document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];

/** The plan whose construction is shown on the mechanism. */
export const onMechanism = () => shown.querySelector("input:checked").value;

/** Call back when another construction is chosen. */
export function onChoosing(work) {
  shown.addEventListener("change", work);
}

/** Call back with the name of a clicked mark of the mechanism. */
export function onPointing(work) {
  find("mechanism").addEventListener("click", event => {
    const mark = /** @type {Element} */ (event.target).closest("#mechanism .drawing [data-name]");
    if (mark) work(mark.dataset.name);
  });
}

/** Show an answer. A drawing that cannot be made keeps its last state, with a note. While a
 * slider moves, the numbers follow after the drawings are painted. */
export function showDrawings(answer, quick = false) {
  const drawn = answer.panels !== undefined;
  old.hidden = drawn || !all.querySelector(".drawing svg");
  find("seeing").classList.toggle("old", !drawn);
  if (!drawn) {
    if (checked) find("verdict").textContent = say("studio.checked_before", { words: checked });
    return;
  }
  if (answer.style !== rules) {
    rules = answer.style;
    sheet.replaceSync(rules);
  }
  const panels = new Map(answer.panels.map(panel => [panel.name, panel]));
  for (const name of names) {
    const figure = find(name);
    const panel = panels.get(name);
    figure.hidden = panel === undefined;
    if (!panel) {
      if (figure.classList.contains("large")) enlarge(figure, false);
      continue;
    }
    set(find(`caption-${name}`), panel.caption);
    set(figure.querySelector(".drawing"), panel.svg);
    legible(figure.querySelector(".drawing"));
  }
  shown.hidden = answer.kinds.length < 2;
  all.dataset.plans = String(answer.kinds.length);
  const verdict = find("verdict");
  checked = answer.verdict.words;
  verdict.textContent = `${answer.verdict.agrees ? "✓" : "✗"} ${checked}`;
  verdict.classList.toggle("wrong", !answer.verdict.agrees);
  numbers = answer;
  if (quick) requestAnimationFrame(() => setTimeout(showNumbers));
  else showNumbers();
}

/** Show the numbers of the current drawing. */
function showNumbers() {
  set(find("results"), numbers.results);
  set(find("margins"), numbers.margins);
}

/** Put markup made by the studio into an element, if it differs. */
function set(element, markup) {
  if (element.made !== markup) element.innerHTML = element.made = markup;
}

/** Size a drawing in its frame. Normally it is shown whole. Enlarged, and on a phone, its letters
 * are legible: it can be scrolled and starts centred. Enlarged on a narrow page, it fills its
 * frame both ways. */
function legible(frame) {
  const svg = frame.querySelector("svg");
  const { width, height } = svg.viewBox.baseVal;
  const large = frame.closest(".large");
  let least = narrow.matches ? NARROW : SMALLEST;
  if (!large && !phone.matches) least = 0;
  else if (narrow.matches && large) {
    least = Math.max(least, frame.clientWidth / width, frame.clientHeight / height);
  }
  svg.style.minWidth = `${Math.round(width * least)}px`;
  svg.style.minHeight = `${Math.round(height * least)}px`;
  if (frame.seen) return;
  frame.seen = true;
  frame.scrollTo((frame.scrollWidth - frame.clientWidth) / 2, 0);
}

for (const page of [narrow, phone]) {
  page.addEventListener("change", () => {
    for (const frame of all.querySelectorAll(".drawing")) if (frame.firstChild) legible(frame);
  });
}

/** Give one drawing the room of all, or each its own; it stays in view. */
function enlarge(figure, large) {
  for (const name of names) find(name).classList.toggle("large", large && name === figure.id);
  find("seeing").classList.toggle("one", large);
  figure.querySelector(".enlarge").setAttribute("aria-pressed", String(large));
  const frame = figure.querySelector(".drawing");
  frame.seen = false;
  if (frame.firstChild) legible(frame);
  figure.scrollIntoView({ block: "nearest" });
}

for (const name of names) {
  const figure = find(name);
  const button = figure.querySelector(".enlarge");
  button.addEventListener("click", () => enlarge(figure, !figure.classList.contains("large")));
}

/** A drawing as a file of its own: with its style rules, in the millimetres of the sheet. */
function alone(svg) {
  const copy = svg.cloneNode(true);
  const { width, height } = svg.viewBox.baseVal;
  copy.removeAttribute("style");
  copy.setAttribute("width", `${width}mm`);
  copy.setAttribute("height", `${height}mm`);
  const here = getComputedStyle(svg);
  const value = (_, variable) => here.getPropertyValue(variable).trim();
  const style = document.createElementNS(copy.namespaceURI, "style");
  style.textContent = `svg { font: ${here.font}; }\n${rules.replace(/var\((--[\w-]+)\)/g, value)}`;
  copy.prepend(style);
  return new XMLSerializer().serializeToString(copy);
}

/** Let the browser save a drawing. */
function take(name) {
  const file = new Blob([alone(find(name).querySelector(".drawing svg"))], {
    type: "image/svg+xml",
  });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = `${name}.svg`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

for (const name of names) {
  find(name)
    .querySelector(".take")
    .addEventListener("click", () => take(name));
}

/** Set the labels of the buttons. */
function nameButtons() {
  for (const each of names) {
    const what = each === "mechanism" ? "studio.in_mechanism" : `sheet.${each}`;
    for (const [look, words] of [
      [".enlarge", "studio.larger"],
      [".take", "studio.take"],
    ]) {
      const button = find(each).querySelector(look);
      button.title = say(words, { name: say(what) });
      button.setAttribute("aria-label", button.title);
    }
  }
}

onSpeaking(nameButtons);
nameButtons();
