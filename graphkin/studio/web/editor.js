// A text with numbered lines and marked mistakes: the scene, and its lab.

import { counted, matter, whereabouts } from "./mistakes.js";
import { button, element, find, onSpeaking, say } from "./talk.js";

// The tokens of a line: a comment, a quoted text, a heading, a key, a number.
const LOOKS = ["comment", "text", "heading", "key", "number"];
const TOKEN =
  /(#.*)|("(?:\\.|[^"\\])*"?|'[^']*'?)|(^\s*\[\[?[^\]#]*\]?\]?)|([\w-]+(?:\.[\w-]+)*(?=\s*=))|([+-]?\b\d[\w.]*|\b(?:true|false)\b)/g;

/** The pieces of a line, each with its class; blanks and punctuation have none. */
function pieces(line) {
  const found = [];
  let at = 0;
  for (const match of line.matchAll(TOKEN)) {
    if (match.index > at) found.push([line.slice(at, match.index), ""]);
    found.push([match[0], LOOKS[match.slice(1).findIndex(part => part !== undefined)]]);
    at = match.index + match[0].length;
  }
  if (at < line.length) found.push([line.slice(at), ""]);
  return found;
}

/** The nodes of a line from one place to another. */
function coloured(line, from, to) {
  const nodes = [];
  let at = 0;
  for (const [words, look] of pieces(line)) {
    const part = words.slice(Math.max(from - at, 0), Math.max(to - at, 0));
    at += words.length;
    if (!part) continue;
    nodes.push(look ? element("span", part, look) : document.createTextNode(part));
  }
  return nodes;
}

/** The editor in a part of the page. */
export function editorOf(part) {
  const text = part.querySelector("textarea");
  const gutter = part.querySelector(".gutter");
  const under = part.querySelector(".under");
  const count = part.querySelector(".count");
  const list = part.querySelector(".problems");
  let shown = ""; // the problems now shown

  /** The current text. */
  const written = () => text.value;

  /** @type {(kind: string) => void} */
  let wrote = () => {};

  /** Call back when the text changes, with the kind of a change that continues: typing or
   * deleting. */
  function onWriting(work) {
    wrote = work;
  }

  text.addEventListener("input", ({ inputType = "" }) => {
    forget();
    wrote(
      inputType === "insertText"
        ? "typing"
        : inputType.startsWith("deleteContent")
          ? "deleting"
          : "",
    );
  });

  /** Number the lines and mark those with mistakes; each number is as high as its wrapped line. */
  function number(wrong = new Set()) {
    gutter.replaceChildren(
      ...text.value
        .split("\n")
        .map((_, i) => element("span", String(i + 1), wrong.has(i + 1) ? "wrong" : "")),
    );
    measure();
  }

  /** Wrap the text beneath like the textarea, and align the numbers with its lines. */
  function measure() {
    under.style.width = `${text.clientWidth}px`;
    const heights = [...under.children].map(line => line.getBoundingClientRect().height);
    [...gutter.children].forEach((line, i) => (line.style.height = `${heights[i]}px`));
    follow();
  }

  /** Remove the underlining while it may be in the wrong place. */
  function forget() {
    shown = "";
    underline([]);
    number();
  }

  /** Keep numbers and underlining aligned with their lines. */
  function follow() {
    gutter.style.transform = `translateY(${-text.scrollTop}px)`;
    under.style.transform = `translateY(${-text.scrollTop}px)`;
  }

  /** Show every problem: in the gutter, under its key, and in the list; `instead` replaces the
   * count. */
  function showProblems(problems, instead = "") {
    if (JSON.stringify([problems, instead]) === shown) return;
    shown = JSON.stringify([problems, instead]);
    underline(problems);
    number(new Set(problems.map(each => each.line)));
    text.setAttribute("aria-invalid", String(problems.length > 0));
    const said = instead || counted(problems.length);
    if (count.textContent !== said) count.textContent = said;
    count.classList.toggle("wrong", problems.length > 0);
    list.replaceChildren(...problems.map(item));
  }

  /** Rewrite the text beneath, coloured and with mistakes underlined. The reader sees this text;
   * the textarea above it only takes input. */
  function underline(problems) {
    let start = 0;
    const lines = text.value.split("\n").map(words => {
      const line = element("span");
      let at = 0;
      for (const problem of problems) {
        const [from, to] = [problem.start - start, problem.end - start];
        if (!problem.line || from < at || from > words.length) continue;
        const mark = element("mark");
        mark.append(...coloured(words, from, to));
        if (!mark.firstChild) mark.textContent = " ";
        line.append(...coloured(words, at, from), mark);
        at = to;
      }
      line.append(...coloured(words, at, words.length));
      start += words.length + 1;
      return line;
    });
    under.replaceChildren(...lines);
  }

  /** A problem of the list; a problem with a place is a button that goes there. */
  function item(problem) {
    const entry = element("li");
    const body = problem.line ? button("", () => go(problem)) : element("div");
    body.append(element("strong", whereabouts(problem)), " ", element("span", matter(problem)));
    entry.append(body);
    for (const edit of problem.mends) {
      const { before, text: words } = edit;
      const after = words.trim().replaceAll("\n", ", ").replace(/^, /, "");
      const key = before && after ? "write_instead" : after ? "write_too" : "leave_out";
      const said = say(`studio.${key}`, { before: before.replaceAll("\n", ", "), after });
      entry.append(button(said, () => change([edit]), "mend"));
    }
    return entry;
  }

  /** Select a piece of the text and centre its line. */
  function go({ start, end }) {
    text.focus();
    text.setSelectionRange(start, end);
    const line = text.value.slice(0, start).split("\n").length;
    const number = gutter.children[line - 1];
    const middle = number.offsetTop + number.offsetHeight / 2;
    text.scrollTop = middle - text.clientHeight / 2;
    follow();
  }

  /** Change pieces of the text, the last first, as one change. */
  function change(edits) {
    text.focus();
    for (const { start, end, text: words } of edits) text.setRangeText(words, start, end, "end");
    forget();
    wrote("");
  }

  /** Replace the text, as one change of the part that differs. */
  function replace(words) {
    const before = text.value;
    const least = Math.min(before.length, words.length);
    let start = 0;
    while (start < least && before[start] === words[start]) start++;
    let same = 0;
    while (same < least - start && before.at(-1 - same) === words.at(-1 - same)) same++;
    const [end, stop] = [before.length - same, words.length - same];
    if (start !== end || start !== stop) change([{ start, end, text: words.slice(start, stop) }]);
  }

  text.addEventListener("scroll", follow, { passive: true });
  new ResizeObserver(measure).observe(text);
  onSpeaking(() => (shown = ""));
  forget();

  /** The rectangle of the cursor on the screen. */
  function caret() {
    const before = text.value.slice(0, text.selectionStart);
    const row = before.split("\n").length - 1;
    const line = under.children[row];
    let left = before.length - before.lastIndexOf("\n") - 1;
    const walk = document.createTreeWalker(line, NodeFilter.SHOW_TEXT);
    while (walk.nextNode()) {
      const { length } = walk.currentNode.textContent;
      if (left <= length) {
        const range = document.createRange();
        range.setStart(walk.currentNode, left);
        return range.getBoundingClientRect();
      }
      left -= length;
    }
    return line.getBoundingClientRect();
  }

  return { text, written, onWriting, showProblems, change, replace, go, caret };
}

export const scene = editorOf(find("scene-part"));

/** The text of the scene. */
export const { written, onWriting, showProblems, change, replace, go } = scene;
