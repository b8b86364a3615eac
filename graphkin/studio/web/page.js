// The page: each change is sent to the studio, and the answer is shown.

import { building, isBuilding, onBuilding, placesFields, showSketch } from "./build.js";
import { showHelp } from "./completion.js";
import { agreed, choose, saved, saveSheets } from "./dialogs.js";
import { onChoosing, onMechanism, onPointing, showDrawings } from "./drawings.js";
import { change, go as goTo, onWriting, replace, showProblems, written } from "./editor.js";
import { historyOf } from "./history.js";
import { helping, importing } from "./imports.js";
import {
  inClass,
  labOf,
  markScene,
  onWritingRules,
  replaceRules,
  showClass,
  showRules,
  trySoon,
  writtenRules,
} from "./lab.js";
import { counted, sentence } from "./mistakes.js";
import { inMotion, motionOf, moveSoon, showMotion } from "./motion.js";
import {
  forgetMoves,
  held as isHeld,
  markSliders,
  onMoving,
  setMoves,
  settings,
  showSliders,
  writing,
} from "./sliders.js";
import { ask, find, language, say, speak, tell } from "./talk.js";

const PAUSE = 150; // ms without typing before the text is read
const LONG = 400; // ms after which the page shows that it is drawing
const REST = 200; // ms without a move before labels are placed
const TO_TEXT = "to-text"; // the key that puts the focus of the next page into the text
const file = find("file");
const drawings = find("drawings");
const { mark, rulesMark } = document.body.dataset;
let held = { name: file.value, mark, rulesMark, lab: Boolean(rulesMark) }; // as it was opened or saved
let safe = ""; // the texts as they were opened or last saved
let number = 0; // of the newest request
let shown = 0; // of the newest answer
let moving = false; // a move is being drawn
let next = false; // another move has come since
let timer = 0;
let spots = {}; // places of names in the text
let back = false; // the state shown comes from the history
let wrong = []; // mistakes of the scene at the last look
let chosen = ""; // the language, where it was chosen here

const scene = () => ({ text: written(), name: file.value.trim(), settings: settings() });

/** Whether nothing is built yet, and nothing that is written is wrong. */
const isBare = ({ sketch, problems }) =>
  sketch &&
  ![...Object.keys(sketch.points), ...Object.keys(sketch.links)].length &&
  problems.every(({ line }) => !line);

/** Request a look at the current scene and show the answer, unless a newer one is shown; returns
 * whether it was. */
async function look(quick) {
  unsettled();
  const own = ++number;
  const waiting = setTimeout(() => drawings.setAttribute("aria-busy", "true"), LONG);
  const asked = held; // the answer cannot know of a file saved in the meantime
  try {
    const fields = { ...scene(), number: own, mechanism: onMechanism(), quick, ...placesFields() };
    const answer = await ask("look", fields);
    if (answer.stale || own < shown) return false;
    shown = own;
    wrong = answer.problems;
    markScene(answer.title !== undefined);
    if (isBare(answer)) {
      showProblems([], say("studio.how_begin"));
      showSliders([]);
    } else showProblems(wrong);
    if (answer.title !== undefined) {
      find("title").textContent = answer.title;
      showSliders(answer.sliders);
    }
    markSliders(answer.problems);
    showHelp(answer.help);
    if (answer.help) spots = answer.help.spots;
    showDrawings(answer, quick);
    showSketch(answer.sketch);
    document.body.dataset.shown = String(own);
    if (own === number && !timer) document.body.dataset.settled = String(!quick);
    if (!answer.there && asked === held && held.mark && held.name === file.value.trim()) gone();
    unsaved();
    if (!quick) moveSoon();
    return true;
  } catch (error) {
    tell(error.message, "wrong");
    return false;
  } finally {
    clearTimeout(waiting);
    if (own === number) drawings.removeAttribute("aria-busy");
  }
}

/** Draw one move at a time: the newest follows the last answer, moves in between are skipped. */
async function move() {
  next = moving;
  if (moving) return;
  moving = true;
  do {
    next = false;
    await look(true);
  } while (next);
  moving = false;
  if (!isHeld()) timer = setTimeout(() => look(false), REST);
}

/** Mark the page as out of date, and cancel a request that is still to be sent. */
function unsettled() {
  clearTimeout(timer);
  timer = 0;
  document.body.dataset.settled = "false";
}

function soon() {
  unsettled();
  timer = setTimeout(() => look(false), PAUSE);
}

const texts = () => JSON.stringify([written(), writtenRules()]);
const isSafe = () => texts() === safe;

/** Note that the file no longer exists: the text is not saved, and can be. */
function gone() {
  held = { ...held, mark: "", rulesMark: "" };
  safe = "";
  tell(say("studio.gone_from_disk", { name: held.name }), "poor");
}

/** Whether the status line shows a failure or a warning. */
const isSaid = () => ["wrong", "poor"].includes(find("status").className);

/** Clear an earlier failure when the user does something else. */
function state() {
  if (isSaid()) tell("");
  unsaved();
}

/** The key under which this tab stores unsaved text of its address. */
function draft() {
  const query = new URLSearchParams(location.search);
  query.delete("lang");
  return `draft ${query}`;
}

/** Store the text over a reload, with the file that it came from. */
function keep() {
  const kept = { text: written(), rules: writtenRules(), held, saved: isSafe() };
  sessionStorage.setItem(draft(), JSON.stringify(kept));
}

/** Restore stored text of this address that is not in its file, as a change that can be undone. A
 * file that has changed since is still not replaced unasked. */
function recall() {
  const kept = JSON.parse(sessionStorage.getItem(draft()) ?? "null");
  const lost = "gone" in document.body.dataset;
  if (!kept?.held || kept.held.name !== held.name) {
    if (lost) tell(say("studio.gone_unkept", { name: held.name }), "poor");
    return;
  }
  if (kept.saved && !lost) return;
  held = kept.held;
  replace(kept.text);
  replaceRules(kept.rules);
  if (lost) gone();
}

/** Show in the title and status line whether something is unsaved; a recent failure stays. */
function unsaved() {
  keep();
  document.title = `${isSafe() ? "" : "• "}${file.value} – graphkin`;
  if (isSaid()) return;
  if (!isSafe()) tell(say("studio.unsaved"));
  else if (find("status").textContent === say("studio.unsaved")) tell("");
}

/** Leave for another scene; ask first where something would be lost. */
async function go(address) {
  if (!isSafe() && !(await agreed(say("studio.leave"), say("studio.go_on")))) return;
  sessionStorage.removeItem(draft());
  safe = texts();
  sessionStorage.setItem(TO_TEXT, "yes");
  location.assign(chosen ? `${address}${address === "?" ? "" : "&"}lang=${chosen}` : address);
}

/** Ask which values to save where sliders were moved; null if the user cancels. */
async function settled() {
  const { edits, problems } = await ask("write", scene());
  if (problems.length) {
    tell(problems.map(sentence).join(" "), "wrong");
    return null;
  }
  if (!edits.length) return "";
  const list = key =>
    edits
      .map(edit => `${edit.name} = ${edit[key]}`)
      .reverse()
      .join(", ");
  const gaps = { moved: list("text"), written: list("before") };
  const question = say("studio.moved", gaps);
  const answer = await agreed(question, say("studio.write_save", gaps), say("studio.save_text"));
  if (!answer) return null;
  if (answer === "other") return say("studio.as_text", gaps);
  forgetMoves();
  change(edits);
  look(false);
  return say("studio.with_values", gaps);
}

async function save() {
  if (document.querySelector("dialog[open]")) return;
  state();
  try {
    const values = await settled();
    if (values === null) return;
    const now = texts();
    const name = file.value.trim();
    const own = name === held.name ? held : { mark: "", rulesMark: "" };
    const rules = held.lab ? { rules: writtenRules(), rules_mark: own.rulesMark } : {};
    const answer = await saved("save", { text: written(), name, mark: own.mark, ...rules });
    if (!answer) return;
    if (answer.problems.length) {
      tell(answer.problems.map(sentence).join(" "), "wrong");
      return;
    }
    sessionStorage.removeItem(draft());
    safe = now;
    file.value = answer.files[0];
    held = { ...held, name: file.value, mark: answer.mark, rulesMark: answer.rules_mark };
    state();
    tellSaved(answer.files, values);
    address(`scene=${encodeURIComponent(file.value)}`);
  } catch (error) {
    tell(error.message, "wrong");
  }
}

/** Say which files were saved with which values, then the mistakes once they are known. */
async function tellSaved(files, values) {
  const parts = [say("studio.saved", { list: files.join(", ") }), values].filter(Boolean);
  tell(parts.join("; "));
  if (!(await look(false)) || !isSafe() || !wrong.length) return;
  const { line } = wrong[0];
  const count = counted(wrong.length);
  parts.push(line ? `${count} (${say("studio.line", { line })})` : count);
  parts.push(say("studio.not_drawable"));
  tell(parts.join("; "), "poor");
}

/** Save the sheets; a mistake is reported at once instead. */
async function sheets() {
  state();
  await look(false);
  if (find("status").classList.contains("wrong")) return;
  if (!wrong.length)
    saveSheets(scene, () => (isSafe() ? "" : `${file.value}: ${say("studio.unsaved")}`));
  else {
    tell(`${say("studio.mend_first")} ${sentence(wrong[0])}`, "wrong");
    find("problems").querySelector("button")?.focus();
  }
}

/** Set the address to the current file, in the chosen language. */
function address(what) {
  history.replaceState(null, "", `?${what}${chosen && `&lang=${chosen}`}`);
}

function another() {
  chosen = find("language").value;
  const query = new URLSearchParams(location.search);
  query.set("lang", chosen);
  history.replaceState(null, "", `?${query}`);
  speak(chosen);
  state();
  look(false);
}

async function intoText() {
  try {
    const { edits, problems } = await ask("write", scene());
    if (problems.length) throw new Error(problems.map(sentence).join(" "));
    forgetMoves();
    change(edits);
    look(false);
  } catch (error) {
    tell(error.message, "wrong");
  }
}

const changes = historyOf(
  () => ({ text: written(), rules: writtenRules(), moved: settings() }),
  state => {
    setMoves(state.moved);
    back = true;
    replace(state.text);
    replaceRules(state.rules);
    back = false;
    look(false);
  },
);
onWriting(kind => {
  if (!back) changes.note(kind);
  state();
  soon();
  trySoon();
});
onWritingRules(kind => {
  if (!back) changes.note(kind);
  state();
  trySoon();
});
onMoving((quick, name) => {
  changes.note(name && `slider ${name}`);
  if (quick) move();
  else look(false);
});
for (const which of ["undo", "redo"]) {
  find(which).addEventListener("click", () => changes[which]());
  for (const text of [find("text"), find("rules")]) {
    text.addEventListener("beforeinput", event => {
      if (event.inputType !== `history${which[0].toUpperCase()}${which.slice(1)}`) return;
      event.preventDefault();
      changes[which]();
    });
  }
}
onChoosing(() => look(false));
onPointing(name => {
  if (!spots[name]) return;
  const [start, end] = spots[name];
  goTo({ start, end });
});
file.addEventListener("input", state);
find("new").addEventListener("click", () => {
  state();
  go("?");
});
find("empty").addEventListener("click", () => {
  state();
  go("?empty=yes");
});
find("open").addEventListener("click", () => {
  state();
  choose(go).catch(error => tell(error.message, "wrong"));
});
find("save").addEventListener("click", save);
find("sheets").addEventListener("click", sheets);
find("language").addEventListener("change", another);
find("write").addEventListener("click", intoText);
find("reset").addEventListener("click", () => {
  forgetMoves();
  changes.note();
  look(false);
});
find("parameters").addEventListener("submit", event => event.preventDefault());
addEventListener("keydown", event => {
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") {
    event.preventDefault();
    save();
  }
});

/** Whether a key belongs to the field in which it is pressed. */
const own = field => {
  if (field.closest?.("dialog") || field === file) return true;
  return Boolean(field.dataset?.value !== undefined && writing(field));
};

addEventListener("keydown", event => {
  const key = event.key.toLowerCase();
  if (!(event.ctrlKey || event.metaKey) || !["z", "y"].includes(key) || own(event.target)) return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) changes.redo();
  else changes.undo();
});
addEventListener("beforeunload", event => {
  if (!isSafe()) event.preventDefault();
});
/** Turn the file into a lab: a folder with a scene and its rules. */
function asLab() {
  held = { ...held, lab: true };
  const stem = file.value
    .trim()
    .replace(/^.*\//, "")
    .replace(/\.toml$/, "");
  if (!/(^|\/)scene\.toml$/.test(file.value.trim())) file.value = `${stem}/scene.toml`;
  state();
}

/** Show an imported scene as a change of the text, under a name of its own. */
async function imported(text, name, notes) {
  if (!isSafe() && !(await agreed(say("studio.leave"), say("studio.go_on")))) return;
  held = { name, mark: "", rulesMark: "", lab: false };
  file.value = name;
  forgetMoves();
  replace(text);
  replaceRules("");
  safe = "";
  state();
  await look(false);
  if (notes.length) tell(notes.join("; "), "poor");
}

safe = texts();
recall();
importing(imported);
helping();
labOf(scene, asLab, () => inMotion() && showMotion(false));
motionOf(scene, () => {
  if (inClass()) showClass(false);
  if (isBuilding()) building(false);
});
onBuilding(() => {
  if (inClass()) showClass(false);
  if (inMotion()) showMotion(false);
  look(false);
});
const query = new URLSearchParams(location.search);
if (query.has("empty")) building(true);
else look(false);
if (query.has("rules")) showRules().catch(error => tell(error.message, "wrong"));
if (query.has("gallery")) {
  choose(go).catch(error => tell(error.message, "wrong"));
}
find("language").value = language;
if (query.get("lang") === language) chosen = language;
if (sessionStorage.getItem(TO_TEXT)) {
  sessionStorage.removeItem(TO_TEXT);
  find("text").focus();
  find("text").setSelectionRange(0, 0);
}
