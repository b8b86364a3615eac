// The text of the scene: its lines numbered, mistakes marked where they stand.

import { find, say } from "./talk.js";

const text = find("text");
const gutter = find("gutter");
const under = find("under");
const count = find("count");
const list = find("problems");
let lines = 0;
let marks = [];

/** The text as it is written. */
export const written = () => text.value;

/** Call back whenever the text changes. */
export function onWriting(work) {
  text.addEventListener("input", () => {
    number();
    forget();
    work();
  });
}

/** Number the lines, those with mistakes marked. */
function number(wrong = new Set()) {
  lines = text.value.split("\n").length;
  gutter.replaceChildren(
    ...Array.from({ length: lines }, (_, i) => {
      const line = document.createElement("span");
      line.textContent = String(i + 1);
      if (wrong.has(i + 1)) line.className = "wrong";
      return line;
    }),
  );
}

/** Take the underlining away while it may stand in the wrong place. */
function forget() {
  under.replaceChildren();
  follow();
}

/** Keep numbers and underlining beside their lines. */
function follow() {
  gutter.style.transform = `translateY(${-text.scrollTop}px)`;
  under.style.transform = `translate(${-text.scrollLeft}px, ${-text.scrollTop}px)`;
}

/** Show every problem: in the gutter, under its key, and in the list. */
export function showProblems(problems) {
  if (JSON.stringify(problems) === JSON.stringify(marks) && under.childNodes.length) return;
  marks = problems;
  number(new Set(problems.map((each) => each.line)));
  underline(problems);
  text.setAttribute("aria-invalid", String(problems.length > 0));
  const said =
    problems.length === 0
      ? say("studio.none_wrong")
      : problems.length === 1
        ? say("studio.one_wrong")
        : say("studio.some_wrong", { count: problems.length });
  if (count.textContent !== said) count.textContent = said;
  count.classList.toggle("wrong", problems.length > 0);
  list.replaceChildren(...problems.map(item));
  follow();
}

/** The same text beneath, transparent, with what is wrong underlined. */
function underline(problems) {
  const value = text.value;
  const parts = [];
  let at = 0;
  for (const { line, start, end } of problems) {
    if (!line || start < at) continue;
    parts.push(value.slice(at, start));
    const mark = document.createElement("mark");
    mark.textContent = value.slice(start, end) || " ";
    parts.push(mark);
    at = end;
  }
  parts.push(`${value.slice(at)}\n`);
  under.replaceChildren(...parts);
}

/** One problem of the list; where it has a place, a button that goes there. */
function item(problem) {
  const entry = document.createElement("li");
  const body = document.createElement(problem.line ? "button" : "div");
  const where = document.createElement("strong");
  const place = problem.place.startsWith("line ") ? "" : problem.place;
  const at = problem.line ? say("studio.line", { line: problem.line }) : "";
  where.textContent = [at, place].filter(Boolean).join(" · ");
  const words = document.createElement("span");
  const expected = problem.expected && `expected ${problem.expected}`;
  words.textContent = [problem.found, expected, problem.hint].filter(Boolean).join("; ");
  words.lang = "en";
  body.append(where, " ", words);
  if (problem.line) {
    body.type = "button";
    body.addEventListener("click", () => go(problem));
  }
  entry.append(body);
  return entry;
}

/** Go to a problem: its key selected, its line in the middle. */
function go({ line, start, end }) {
  text.focus();
  text.setSelectionRange(start, end);
  const height = text.scrollHeight / Math.max(lines, 1);
  text.scrollTop = (line - 0.5) * height - text.clientHeight / 2;
  text.scrollLeft = 0;
  follow();
}

/** Change pieces of the text, the last first, so that each can be undone. */
export function change(edits) {
  text.focus();
  for (const { start, end, text: words } of edits) {
    text.setSelectionRange(start, end);
    if (!document.execCommand("insertText", false, words)) text.setRangeText(words);
  }
  number();
  forget();
}

text.addEventListener("scroll", follow, { passive: true });
number();
