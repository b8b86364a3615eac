// A lab next to its scene: its rules as a text, the class that they make, and proposed ranges.

import { change, editorOf } from "./editor.js";
import { sentence } from "./mistakes.js";
import { ask, button, element, find, language, onSpeaking, say, tell } from "./talk.js";

const REST = 500; // ms without typing before the lab is tried again
const SVG = "http://www.w3.org/2000/svg";
const rules = editorOf(find("rules-part"));
const toggle = find("lab");
const room = find("class");
const advice = find("advice");
let scene = () => ({}); // the scene as the page sends it
let begun = () => {};
let opened = () => {};
let number = 0; // of the newest request
let timer = 0;
let students = [];
let chosen = ""; // the student whose sheets are shown
let tried = ""; // the texts of the report shown
let unread = false; // the scene has mistakes
let refused = {}; // whether the scene and the rules were refused when the lab was last tried
let searching = false; // for fair ranges

/** The text of lab.toml; empty without one. */
export const writtenRules = () => rules.written();
export const { onWriting: onWritingRules, replace: replaceRules } = rules;

/** Whether the class is shown instead of the drawings. */
export const inClass = () => toggle.getAttribute("aria-pressed") === "true";

/** Set the scene of the lab, and the callbacks for a new lab.toml and for opening the class. */
export function labOf(fields, beginning, opening) {
  scene = fields;
  begun = beginning;
  opened = opening;
}

/** Allow the search for ranges only for a complete lab, or say what must be corrected first. */
function ready() {
  const { scene_wrong: scene, problems = [] } = refused;
  const why =
    unread || scene ? say("studio.scene_first") : problems.length ? say("studio.rules_first") : "";
  find("find-ranges").disabled = searching || Boolean(why);
  find("why-no-ranges").textContent = why;
}

/** Record whether the scene can be read. */
export function markScene(is) {
  unread = !is;
  ready();
}

/** Show the rules next to the scene, and their fairness. */
export async function showRules() {
  if (!find("rules-part").hidden) return;
  find("rules-part").hidden = find("fairness").hidden = false;
  if (!writtenRules()) await begin();
  begun();
  trySoon(0);
}

/** Show the class or the drawings. */
export async function showClass(open) {
  toggle.setAttribute("aria-pressed", String(open));
  room.hidden = !open;
  find("seeing").classList.toggle("classroom", open);
  if (!open) return;
  opened();
  await showRules();
}

/** Begin a lab.toml for a scene without one. */
async function begin() {
  const answer = await ask("begin", scene());
  if (answer.problems.length) fairness(answer.problems.map(sentence).join(" "), true);
  else rules.replace(answer.rules);
}

function fairness(words, wrong = false) {
  find("fairness").textContent = words;
  find("fairness").classList.toggle("wrong", wrong);
}

/** Try the lab after a pause in typing. */
export function trySoon(pause = REST) {
  clearTimeout(timer);
  if (find("rules-part").hidden || !writtenRules()) return;
  room.classList.toggle("old", tried !== texts());
  timer = setTimeout(() => attempt().catch(error => fairness(error.message, true)), pause);
}

const texts = () => JSON.stringify([scene().text, writtenRules(), language]);

/** Send a request about the lab; null for an answer that is out of date. */
async function asked(what) {
  const own = ++number;
  const answer = await ask(what, { ...scene(), rules: writtenRules(), settings: {}, number: own });
  if (answer.stale || own !== number) return null;
  rules.showProblems(answer.problems);
  refused = answer;
  ready();
  if (answer.scene_wrong) fairness(say("studio.scene_first"), true);
  else if (answer.problems.length) fairness("");
  if (!answer.scene_wrong && !answer.problems.length) return answer;
  tried = "";
  return null;
}

async function attempt() {
  const now = texts();
  if (now === tried) return;
  fairness(say("studio.trying"));
  const report = await asked("variants");
  if (!report) return;
  tried = now;
  room.classList.remove("old");
  const summary = [say("studio.fair_of", report), report.exact].filter(Boolean).join(" ");
  fairness(summary, report.fair < report.count);
  find("class-tables").innerHTML = report.tables;
  students = report.students;
  map(report);
  list();
  const shown = students.find(({ name }) => name === chosen);
  if (shown) await sheets(shown);
}

/** Show the map of what each student's right values earn on every other sheet; cells can be
 * pointed at. */
function map({ shares, closest, apart }) {
  const figure = find("neighbours");
  figure.hidden = !shares.length;
  const svg = figure.querySelector("svg");
  const size = shares.length;
  svg.setAttribute("viewBox", `0 0 ${size} ${size}`);
  find("closest").textContent = closest;
  svg.replaceChildren(
    ...shares.flatMap((row, y) =>
      row.map((share, x) => {
        const cell = document.createElementNS(SVG, "rect");
        const look = { x: x + 0.04, y: y + 0.04, width: 0.92, height: 0.92 };
        for (const [key, value] of Object.entries(look)) cell.setAttribute(key, value);
        cell.setAttribute("fill-opacity", share < 0 ? 0 : 0.06 + (0.94 * share) / 100);
        if (share > apart) cell.classList.add("over");
        Object.assign(cell.dataset, { own: y, other: x, share });
        return cell;
      }),
    ),
  );
}

find("neighbours").addEventListener("pointerover", event => {
  const { own, other, share } = /** @type {Element} */ (event.target).dataset;
  if (!(Number(share) >= 0)) return;
  const gaps = { own: students[own].name, other: students[other].name, share };
  find("pointed").textContent = say("studio.earns_of", gaps);
});
find("neighbours").addEventListener("click", event => {
  const { own } = /** @type {Element} */ (event.target).dataset;
  if (own) choose(students[own]);
});

/** List the students of the class; each entry opens the student's sheets. */
function list() {
  find("students").hidden = !students.length;
  find("students").tBodies[0].replaceChildren(
    ...students.map(student => {
      const row = element("tr", "", student.name === chosen ? "chosen" : "");
      const head = element("th");
      head.scope = "row";
      head.append(button(student.name, () => choose(student)));
      const earns = student.earns && `${student.earns} (${student.whose})`;
      const { data, faults, flattest, shortest } = student;
      const cells = [data, faults, flattest, shortest, earns].map(words => element("td", words));
      cells[1].className = "faults";
      row.append(head, ...cells);
      return row;
    }),
  );
}

function choose(student) {
  chosen = student.name;
  list();
  sheets(student).catch(error => tell(error.message, "wrong"));
  find("student-sheets").scrollIntoView({ block: "nearest" });
}

/** Show the sheets of a student, in the language of the page. */
async function sheets(student) {
  const part = find("student-sheets");
  part.hidden = false;
  find("student").textContent = say("studio.sheet_of", student);
  part.setAttribute("aria-busy", "true");
  const view = find("student-view").value;
  const answer = await ask("student", { ...scene(), settings: student.settings, view });
  if (student.name !== chosen) return;
  part.removeAttribute("aria-busy");
  const pages = find("student-pages");
  for (const old of pages.querySelectorAll("img")) URL.revokeObjectURL(old.src);
  pages.replaceChildren(...answer.problems.map(each => element("p", sentence(each), "wrong")));
  for (const text of answer.sheets) {
    const page = element("img");
    page.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
    page.alt = say("studio.sheet_of", student);
    page.addEventListener("click", () => page.classList.toggle("large"));
    pages.append(page);
  }
}

/** Find fair ranges, and offer to put them into the text. */
async function propose() {
  clearTimeout(timer);
  searching = true;
  ready();
  advice.hidden = false;
  advice.replaceChildren(element("p", say("studio.searching")));
  try {
    const found = await asked("ranges");
    if (found) showAdvice(found);
    else advice.hidden = true;
  } catch (error) {
    advice.replaceChildren(element("p", error.message, "wrong"));
  } finally {
    searching = false;
    ready();
    trySoon(0);
  }
}

/** A button that carries out a piece of advice. */
function following(words, work) {
  const tools = element("div", "", "tools");
  tools.append(
    button(words, () => {
      advice.hidden = true;
      work();
    }),
  );
  return tools;
}

function showAdvice({ fair, shares, ranges, rules: after, kept, formula, mending }) {
  const parts = [element("p", fair)];
  const charts = element("div", "", "charts");
  if (formula) parts.push(element("p", formula, mending ? "faults" : ""));
  if (mending) parts.push(following(say("studio.mend_scene"), () => change([mending])));
  for (const { name, decides, parts: values } of shares) {
    const bars = element("div", "", "bars");
    bars.append(element("h3", say("studio.decides", { name, share: decides })));
    for (const [ends, share] of values) {
      const bar = element("meter");
      Object.assign(bar, { max: 100, value: share });
      bar.setAttribute("aria-label", `${name} ${ends}`);
      bars.append(element("span", ends), bar, element("span", `${share} %`));
    }
    charts.append(bars);
  }
  parts.push(charts);
  if (ranges) parts.push(element("pre", ranges));
  parts.push(element("p", kept));
  if (ranges) parts.push(following(say("studio.put_ranges"), () => rules.replace(after)));
  advice.replaceChildren(...parts);
}

toggle.addEventListener("click", () =>
  showClass(!inClass()).catch(error => tell(error.message, "wrong")),
);
find("find-ranges").addEventListener("click", propose);
find("student-view").addEventListener("change", () => {
  const shown = students.find(({ name }) => name === chosen);
  if (shown) choose(shown);
});
onSpeaking(() => {
  ready();
  trySoon(0);
});
