// The drawings and the numbers beside them.

import { find, onSpeaking, say } from "./talk.js";

const old = find("old");
const shown = find("shown");
const all = find("drawings");
const names = ["mechanism", "velocity", "acceleration"];
const SMALLEST = 1.8; // px for a millimetre of paper, beside the text
const NARROW = 2.6; // and below it
const narrow = matchMedia("(max-width: 60rem)");
const phone = matchMedia("(max-width: 40rem)"); // where a field is as high as its drawing
const sheet = new CSSStyleSheet();
let rules = "";
let numbers = { results: "", margins: "" }; // of what is drawn
let checked = ""; // what the independent check says of what is drawn
document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];

/** The plan whose construction stands on the mechanism. */
export const onMechanism = () => shown.querySelector("input:checked").value;

/** Call back when another construction is to be shown. */
export function onChoosing(work) {
  shown.addEventListener("change", work);
}

/** Call back with the name of a mark of the mechanism that is clicked. */
export function onPointing(work) {
  find("mechanism").addEventListener("click", ({ target }) => {
    const mark = target.closest("#mechanism .drawing [data-name]");
    if (mark) work(mark.dataset.name);
  });
}

/** Put everything in its place; what cannot be drawn now stays as it was, and says so. While a
 * slider moves the numbers follow when the drawings are painted. */
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
  const panels = new Map(answer.panels.map((panel) => [panel.name, panel]));
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

/** Show the numbers of what is drawn. */
function showNumbers() {
  set(find("results"), numbers.results);
  set(find("margins"), numbers.margins);
}

/** Put markup that the studio made into an element, where it is another. */
function set(element, markup) {
  if (element.made !== markup) element.innerHTML = element.made = markup;
}

/** A drawing is seen whole in its field. Enlarged, and on a phone, its letters are large enough to
 * be read: it can be moved in its frame, and begins with its middle; enlarged on a narrow page it
 * fills its frame both ways. */
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

/** Give one drawing the room of all, or all their own; it stays where it is seen. */
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

/** A drawing as a file of its own: its rules within it, in the millimetres of the sheet. */
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

/** Hand a drawing to the browser to be saved. */
function take(name) {
  const file = new Blob([alone(find(name).querySelector(".drawing svg"))], { type: "image/svg+xml" });
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

/** Name the buttons. */
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
