// The page: what is written or moved is asked of the studio, and what it answers is shown.

import { agreed, choose, saved, saveSheets, sentence } from "./dialogs.js";
import { onChoosing, onMechanism, showDrawings } from "./drawings.js";
import { change, onWriting, showProblems, written } from "./editor.js";
import { forgetMoves, markSliders, onMoving, settings, showSliders } from "./sliders.js";
import { ask, find, say, tell } from "./talk.js";

const PAUSE = 150; // ms without a sign before the text is read
const LONG = 400; // ms after which it is shown that something is being drawn
const REST = 200; // ms without a move before labels find their places
const file = find("file");
const drawings = find("drawings");
let safe = written(); // the text as it was opened or last saved
let mark = ""; // what the last saving gave
let number = 0; // of the newest request
let shown = 0; // of the newest answer
let moving = false; // a move is on its way
let next = false; // another move has come since
let timer = 0;

const scene = () => ({ text: written(), name: file.value.trim(), settings: settings() });

/** Ask for a look at the scene as it is, and show the answer unless a newer one is there. */
async function look(quick) {
  const own = ++number;
  const waiting = setTimeout(() => drawings.setAttribute("aria-busy", "true"), LONG);
  try {
    const fields = { ...scene(), number: own, mechanism: onMechanism(), quick };
    const answer = await ask("look", fields);
    if (answer.stale || own < shown) return;
    shown = own;
    showProblems(answer.problems);
    if (answer.title !== undefined) {
      find("title").textContent = answer.title;
      showSliders(answer.sliders);
    }
    markSliders(answer.problems);
    showDrawings(answer);
    document.body.dataset.shown = String(own);
    document.body.dataset.settled = String(!quick);
    state();
  } catch (error) {
    tell(error.message, true);
  } finally {
    clearTimeout(waiting);
    if (own === number) drawings.removeAttribute("aria-busy");
  }
}

/** One move at a time: the newest goes as soon as the last is answered, those between are left. */
async function move() {
  clearTimeout(timer);
  next = moving;
  if (moving) return;
  moving = true;
  do {
    next = false;
    await look(true);
  } while (next);
  moving = false;
  timer = setTimeout(() => look(false), REST);
}

function soon() {
  clearTimeout(timer);
  timer = setTimeout(() => look(false), PAUSE);
}

const isSafe = () => written() === safe;

/** Say at the top whether something is not saved. */
function state() {
  document.title = `${isSafe() ? "" : "• "}${file.value} – graphkin`;
  if (find("status").classList.contains("wrong")) tell("");
  if (!isSafe()) tell(say("studio.unsaved"));
  else if (find("status").textContent === say("studio.unsaved")) tell("");
}

/** Leave for another scene, after asking where something would be lost. */
async function go(address) {
  if (!isSafe() && !(await agreed(say("studio.leave"), say("studio.go_on")))) return;
  safe = written();
  location.assign(address);
}

async function save() {
  const text = written();
  try {
    const answer = await saved("save", { text, name: file.value.trim(), mark });
    if (!answer) return;
    if (answer.problems.length) {
      tell(answer.problems.map(sentence).join(" "), true);
      return;
    }
    safe = text;
    mark = answer.mark;
    state();
    tell(say("studio.saved", { list: answer.files.join(", ") }));
    history.replaceState(null, "", `?scene=${encodeURIComponent(answer.files[0])}`);
  } catch (error) {
    tell(error.message, true);
  }
}

async function intoText() {
  try {
    const { edits } = await ask("write", scene());
    forgetMoves();
    change(edits);
    look(false);
  } catch (error) {
    tell(error.message, true);
  }
}

onWriting(() => {
  state();
  soon();
});
onMoving((quick) => (quick ? move() : look(false)));
onChoosing(() => look(false));
find("new").addEventListener("click", () => go("?"));
find("open").addEventListener("click", () => choose(go).catch((error) => tell(error.message, true)));
find("save").addEventListener("click", save);
find("sheets").addEventListener("click", () => saveSheets(scene));
find("write").addEventListener("click", intoText);
find("reset").addEventListener("click", () => {
  forgetMoves();
  look(false);
});
find("parameters").addEventListener("submit", (event) => event.preventDefault());
addEventListener("keydown", (event) => {
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") {
    event.preventDefault();
    save();
  }
});
addEventListener("beforeunload", (event) => {
  if (!isSafe()) event.preventDefault();
});
look(false);
