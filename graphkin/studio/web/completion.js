// Completion in a scene: keys of the table, names of points, links and parameters.

import { scene } from "./editor.js";
import { element, find } from "./talk.js";

const MOST = 12; // largest number of offers
const list = find("offered");
const { text } = scene;
let help = { keys: {}, points: [], links: [], parameters: [] };
let begun = ""; // the written part of the word
let chosen = 0;

/** Keep the names known from the last text that was read. */
export function showHelp(found) {
  if (found?.points.length) help = found;
  else if (found) help.keys = { ...found.keys, ...help.keys };
}

/** The name of the table of the last line, as the reader of scenes writes it. */
function tableOf(lines) {
  for (const line of lines.toReversed()) {
    const heading = line.match(/^\s*\[\[?([^\]]+)\]/);
    if (heading) return heading[1].replace(/["'\s]/g, "");
  }
  return "";
}

/** The keys that a table may have; for a new table, the keys of similar tables. */
function keysOf(place) {
  const plain = Object.entries(help.keys).map(([name, keys]) => [
    name.replace(/\[\d+\]/g, ""),
    keys,
  ]);
  const same = plain.filter(([name]) => name === place).flatMap(([, keys]) => keys);
  if (same.length) return same;
  const [depth, first, last] = [
    place.split(".").length,
    place.split(".")[0],
    place.split(".").at(-1),
  ];
  const isPoint = name => /^[A-Z]/.test(name);
  const alike = plain.filter(([name]) => {
    const parts = name.split(".");
    const own = parts.at(-1) === last || (isPoint(parts.at(-1)) && isPoint(last));
    return parts.length === depth && parts[0] === first && (depth < 3 || own);
  });
  return alike.flatMap(([, keys]) => keys).filter(key => /^[a-z]+$/.test(key));
}

/** The possible words at the cursor, and the part of one that is written. */
function offers() {
  const before = text.value.slice(0, text.selectionStart);
  const lines = before.split("\n");
  const line = lines.pop();
  const word = line.match(/[\w-]*$/)[0];
  const ahead = line.slice(0, line.length - word.length);
  if (/#/.test(ahead.replace(/"[^"]*"/g, ""))) return [word, []];
  const within = ahead.match(/([\w.-]+)\s*=\s*\{[^}]*$/);
  const inTable = within && !/=\s*[^,{]*$/.test(ahead.slice(ahead.lastIndexOf("{")));
  if (inTable) return [word, keysOf([tableOf(lines), within[1]].filter(Boolean).join("."))];
  if (/^\s*$/.test(ahead)) return [word, keysOf(tableOf(lines))];
  if (/^\s*\[\[?$/.test(ahead)) return [word, keysOf("")];
  if (!/=/.test(ahead)) return [word, []];
  const part = word.match(/\w*$/)[0];
  const quoted = (ahead.match(/"/g) ?? []).length % 2 === 1;
  return quoted ? [part, [...help.points, ...help.parameters, ...help.links]] : [part, help.links];
}

/** Offer words that begin like the word at the cursor; `asked` offers words without a beginning. */
function offer(asked = false) {
  const [word, known] = offers();
  const low = word.toLowerCase();
  const begins = known.filter(each => each.toLowerCase().startsWith(low) && each !== word);
  const found = [...new Set(begins)].slice(0, MOST);
  if (!found.length || !(word || asked)) return close();
  begun = word;
  chosen = 0;
  list.replaceChildren(
    ...found.map((each, i) => {
      const item = element("li", each);
      item.role = "option";
      item.id = `offered-${i}`;
      item.addEventListener("pointerdown", event => {
        event.preventDefault();
        chosen = i;
        take();
      });
      return item;
    }),
  );
  list.hidden = false;
  place();
  text.setAttribute("aria-controls", "offered");
  mark();
}

/** Put the list next to the cursor: below, or above where it would cover the mistakes. */
function place() {
  const at = scene.caret();
  list.style.left = `${Math.min(at.left, innerWidth - list.offsetWidth - 8)}px`;
  const [below, above] = [at.bottom + 2, at.top - list.offsetHeight - 2];
  const end = Math.min(text.getBoundingClientRect().bottom, innerHeight);
  list.style.top = `${below + list.offsetHeight < end || above < 0 ? below : above}px`;
}

/** Move the list with the text, or close it when the cursor leaves the view. */
function follow() {
  const at = scene.caret();
  const seen = text.getBoundingClientRect();
  if (at.bottom < seen.top || at.top > seen.bottom) close();
  else place();
}

function mark() {
  [...list.children].forEach((item, i) => item.setAttribute("aria-selected", String(i === chosen)));
  text.setAttribute("aria-activedescendant", `offered-${chosen}`);
  list.children[chosen].scrollIntoView({ block: "nearest" });
}

function close() {
  list.hidden = true;
  text.removeAttribute("aria-activedescendant");
}

/** Replace the begun word by the chosen one. */
function take() {
  const end = text.selectionStart;
  const word = list.children[chosen].textContent;
  close();
  scene.change([{ start: end - begun.length, end, text: word }]);
}

text.addEventListener("input", ({ inputType }) => (inputType === "insertText" ? offer() : close()));
text.addEventListener("blur", close);
text.addEventListener("pointerdown", close);
text.addEventListener("scroll", () => list.hidden || follow(), { passive: true });
text.addEventListener("keydown", event => {
  if (event.key === " " && event.ctrlKey) {
    event.preventDefault();
    offer(true);
    return;
  }
  if (list.hidden) return;
  const many = list.children.length;
  const acts = {
    ArrowDown: () => ((chosen = (chosen + 1) % many), mark()),
    ArrowUp: () => ((chosen = (chosen + many - 1) % many), mark()),
    Enter: take,
    Tab: take,
    Escape: close,
  };
  if (event.key in acts) {
    event.preventDefault();
    acts[event.key]();
  } else if (["ArrowLeft", "ArrowRight", "Home", "End"].includes(event.key)) close();
});
