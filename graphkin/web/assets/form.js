// The form of a lab: it reads answers as `graphkin grade` does, keeps them in this browser,
// saves them as a file and opens such a file again. Nothing is sent anywhere.
import { clean, HEADS, quoted, rows_of, save_file, TABLE } from "./answer_files.js";

const form = document.querySelector("form.answers");
const rules = JSON.parse(form.dataset.form);
const NUMBER = new RegExp("^(?:" + rules.number + ")");
const MISTYPED = new RegExp(rules.mistyped);
const RUNS = /(^|;[\s"]*)(?=[=+\-@])/g; // before text that a spreadsheet takes for a formula
const SHOWN = 30;
const NAMED = 8; // largest number of fields named in one sentence
const memory = `${rules.memory} ${location.origin}${location.pathname}`; // a copy elsewhere has its own
const fields = [...form.querySelectorAll("[name]:not([type=hidden])")];
const drawing = form.querySelector("[name=drawing]"); // the moves made on the board, which keeps them here
const own = form.querySelector("#answers-id");
const status = form.querySelector(".status");
const file = form.querySelector(".file");

const say = (key, values = {}) =>
  rules.words[key].replace(/\{(\w+)\}/g, (gap, name) => (name in values ? values[name] : gap));
const shown = text => (text.length <= SHOWN ? text : text.slice(0, SHOWN - 1) + "…");
const id = () => rules.id || clean(own.value);

// The error of an answer, as in graphkin.classroom.grading.answer_numbers; empty if it can be read.
function wrong(text, unit, name) {
  const stripped = clean(text);
  if (!stripped || rules.blanks.includes(stripped.toLowerCase())) return "";
  const found = stripped.length <= rules.longest ? NUMBER.exec(stripped) : null;
  if (!found || !names(found.groups.label, name))
    return say("no_number", { text: shown(stripped) });
  const rest = stripped.slice(found[0].length);
  const written = plainUnit(rest);
  const known = rules.units[unit];
  const factor = Object.keys(known).find(each => each.toLowerCase() === written.toLowerCase());
  if (written && !factor) {
    if (MISTYPED.test(rest)) return say("no_number", { text: shown(stripped) });
    const list = Object.keys(known).join(", ");
    return say("no_unit", { unit: shown(written), list });
  }
  const value =
    Number(`${digits(found.groups)}e${power(found.groups)}`) * (written ? known[factor] : 1);
  return value < rules.largest ? "" : say("too_large", { text: shown(stripped) });
}

// Whether a label before a number, if there is one, may name the quantity of a field.
function names(label, name) {
  const letter = name.split("_")[0];
  const known = rules.letters[letter] || [letter.toLowerCase()];
  return !label || known.some(begins => label.toLowerCase().startsWith(begins));
}

/**
 * The digits of a number with a decimal point, without gaps between thousands.
 * @param {Record<string, string>} groups the groups of NUMBER
 */
function digits({ digits: all, part, parts }) {
  const bare = [part, parts].reduce((left, gap) => (gap ? left.replaceAll(gap, "") : left), all);
  return bare.replaceAll(",", ".");
}

/** @param {Record<string, string>} groups the groups of NUMBER */
function power({ power: plain, raised }) {
  return [...(plain || raised || "0")].map(sign => rules.raised[sign] || sign).join("");
}

function plainUnit(text) {
  const latin = text.replace(
    /[А-Яа-я]+\.?/g,
    part => rules.russian[part.replace(".", "").toLowerCase()] || part,
  );
  const plain = [...latin.replace(/[\s()[\]^*·]/g, "")]
    .map(sign => rules.raised[sign] || sign)
    .join("");
  return plain.replaceAll("sec", "s").replace(/([\p{L}\p{N}])[.,;]$|^;$/u, "$1");
}

// Show the error of a field next to it, and return whether there is one.
function judge(field) {
  const problem =
    field.dataset.unit === undefined ? "" : wrong(field.value, field.dataset.unit, field.name);
  return mark(field, problem);
}

function mark(field, problem) {
  form.querySelector(`#${field.id}-wrong`).textContent = problem;
  if (problem) field.setAttribute("aria-invalid", "true");
  else field.removeAttribute("aria-invalid");
  return Boolean(problem);
}

function answers() {
  return Object.fromEntries(
    [...fields, drawing].filter(Boolean).map(({ name, value }) => [name, value]),
  );
}

function fill(values) {
  if (drawing && Object.hasOwn(values, drawing.name)) {
    drawing.value = values[drawing.name];
    drawing.dispatchEvent(new Event("change"));
  }
  for (const field of fields.filter(field => Object.hasOwn(values, field.name))) {
    const text = values[field.name];
    const sense = field.options && ["", "+", "-"].indexOf(text);
    if (sense > 0) field.selectedIndex = sense;
    else field.value = text;
    judge(field);
    if (field.options && field.selectedIndex < 0) {
      field.selectedIndex = 0;
      mark(field, say("no_sense", { text: shown(text) }));
    }
  }
}

function keep() {
  try {
    localStorage.setItem(memory, JSON.stringify({ id: own?.value ?? "", ...answers() }));
    return true;
  } catch {
    return false; // a browser that stores nothing, as the page says when it opens
  }
}

function recall() {
  try {
    const kept = JSON.parse(localStorage.getItem(memory) ?? "{}");
    if (own && typeof kept.id === "string") own.value = kept.id;
    fill(Object.fromEntries(Object.entries(kept).filter(([, text]) => typeof text === "string")));
  } catch {
    // data of another program, or none: the form stays empty
  }
}

// A cell that no spreadsheet executes, quoted where necessary.
function cell(text, read) {
  const safe = read ? text : text.replace(RUNS, "$1'");
  return quoted(safe);
}

function table() {
  const rows = [HEADS, ["id", cell(id(), rules.id || /^[+-]?\d+$/.test(id()))]];
  for (const field of fields) {
    const read = !wrong(field.value, field.dataset.unit ?? "", field.name);
    rows.push([field.name, cell(clean(field.value), read)]);
  }
  if (drawing?.value) rows.push([drawing.name, cell(drawing.value, true)]);
  return rows.map(row => row.join(rules.separator) + "\r\n").join("");
}

function save() {
  if (own && mark(own, id() ? "" : say("no_id"))) {
    status.textContent = say("no_id");
    own.focus();
    return;
  }
  const stem = rules.id ? rules.stem : `${rules.stem}-${id().replace(/[^\w-]+/g, "_")}`;
  const name = `${stem}-answers.csv`;
  save_file(name, table(), TABLE);
  keep();
  const bad = fields.filter(judge);
  const empty = fields.filter(field => !clean(field.value));
  const count = fields.length - empty.length;
  const moves = drawing?.value.split("|").filter(Boolean).length ?? 0; // as board_state.js writes them
  status.textContent = say(moves ? "saved_drawn" : "saved", {
    file: name,
    moves,
    count,
    all: fields.length,
  });
  if (count && empty.length) list("empty", empty.slice(0, NAMED), empty.length > NAMED);
  if (bad.length) list("unread", bad, false);
}

// Add a sentence with a list of fields, each by its symbol and unit as in its label.
function list(key, some, more) {
  const [before, after] = rules.words[key].split("{list}");
  const named = some.flatMap((field, i) => {
    const symbol = form.querySelector(`label[for="${field.id}"] .symbol`).cloneNode(true);
    return [i ? ", " : "", symbol, ` (${field.dataset.unit || rules.sense})`];
  });
  status.append(` ${before}`, ...named, more ? ", …" : "", after);
}

async function open() {
  const chosen = file.files[0];
  file.value = "";
  if (!chosen) return;
  const rows = rows_of(await chosen.text());
  const known = new Set(Object.keys(answers()));
  const found = rows.slice(1).filter(([name, text]) => name && text !== undefined);
  const given = found.find(([name]) => name === "id")?.[1] ?? "";
  const values = Object.fromEntries(found.filter(([name]) => known.has(name)));
  const strange = found.map(([name]) => name).filter(n => n !== "id" && !known.has(n));
  const count = Object.values(values).filter(Boolean).length;
  const said = { file: chosen.name, id: shown(given), count };
  const ours = HEADS.every((head, i) => rows[0][i] === head);
  if (ours && rules.id && given && given !== rules.id) {
    status.textContent = say("other", said);
  } else if (!ours || !Object.keys(values).length) {
    status.textContent = say("no_file", said);
  } else if (!differs(values) || confirm(say("replace", said))) {
    if (own && given) mark(Object.assign(own, { value: given }), "");
    fill(values);
    keep();
    const list = strange.map(shown).join(", ");
    status.textContent = say("opened", said) + (list ? " " + say("strange", { list }) : "");
  }
}

// Whether opening a file would replace answers by different ones.
function differs(values) {
  return Object.entries(answers()).some(
    ([name, text]) => clean(text) && name in values && values[name] !== clean(text),
  );
}

function clear() {
  if (!confirm(say("sure"))) return;
  for (const field of [own, ...fields].filter(Boolean)) {
    field.value = "";
    mark(field, "");
  }
  keep();
  status.textContent = say("cleared");
}

form.addEventListener("submit", event => event.preventDefault());
form.addEventListener("input", event => {
  keep();
  const field = /** @type {PageElement} */ (event.target);
  if (field === own) {
    mark(own, "");
    if (id() && status.textContent === say("no_id")) status.textContent = "";
  } else if (field.getAttribute("aria-invalid")) judge(field);
});
form.addEventListener("change", event => {
  const field = /** @type {PageElement} */ (event.target);
  if (fields.includes(field)) judge(field);
});
form.querySelector(".save").addEventListener("click", save);
form.querySelector(".open").addEventListener("click", () => file.click());
file.addEventListener("change", open);
form.querySelector(".clear").addEventListener("click", clear);
recall();
status.textContent = keep() ? say("kept") : say("lost");
form.querySelector(".buttons").hidden = false;
