// A slider and a field for each parameter; only those that were moved are set.

import { element, find, onSpeaking, say } from "./talk.js";

const box = find("sliders");
const write = find("write");
const reset = find("reset");
const rows = new Map();
let moved = {};
/** @type {(quick: boolean, name?: string) => void} */
let changed = () => {};
let anew = false; // a value is also shown in the field being edited
let holding = false; // a slider is held by the pointer

/** The values that differ from the text, by name. */
export const settings = () => ({ ...moved });

/** The name of each parameter and its value as shown. */
export const values = () => [...rows].map(([name, row]) => [name, row.field.value]);

/** Whether a slider is held and may move again at any time. */
export const held = () => holding;

/** Whether a field holds an edit that is not entered yet. */
export const writing = field => field.value.trim() !== field.dataset.value;

/** Call back when a slider moves (quick, with its name) or is released, or a value is entered. */
export function onMoving(work) {
  changed = work;
}

/** Set parameters to these values, and all others to those of the text. */
export function setMoves(values) {
  moved = { ...values };
  anew = true;
  enable();
}

/** Return to the values of the text. */
export function forgetMoves() {
  moved = {};
}

/** Show the parameters; a slider that is held keeps its place. */
export function showSliders(sliders) {
  const known = new Set(sliders.map(slider => slider.name));
  moved = Object.fromEntries(Object.entries(moved).filter(([name]) => known.has(name)));
  for (const [name, row] of rows) {
    if (!known.has(name)) {
      row.whole.remove();
      rows.delete(name);
    }
  }
  sliders.forEach((slider, i) => {
    if (!rows.has(slider.name)) rows.set(slider.name, made(slider.name));
    const row = rows.get(slider.name);
    if (box.children[i] !== row.whole) box.insertBefore(row.whole, box.children[i] ?? null);
    fill(row, slider);
  });
  anew = false;
  if (!sliders.length) box.textContent = say("studio.no_parameters");
  find("into").hidden = !sliders.length;
  enable();
}

/** Mark the fields whose values are refused. */
export function markSliders(problems) {
  const wrong = new Set(problems.map(each => each.setting));
  for (const [name, row] of rows) row.field.setAttribute("aria-invalid", String(wrong.has(name)));
}

onSpeaking(() => {
  for (const [name, row] of rows) row.field.setAttribute("aria-label", valueOf(name));
  if (!rows.size && box.textContent) box.textContent = say("studio.no_parameters");
});

const valueOf = name => say("studio.value_of", { name });

function enable() {
  write.disabled = reset.disabled = Object.keys(moved).length === 0;
}

/** The row of a parameter: name, slider, value field, unit. */
function made(name) {
  if (!rows.size) box.textContent = "";
  const whole = element("div", "", "slider");
  const label = element("label", name);
  const range = element("input");
  const field = element("input");
  const unit = element("span", "", "unit");
  label.htmlFor = range.id = `slider-${name}`;
  range.type = "range";
  range.min = "0";
  field.id = `value-${name}`;
  field.size = 7;
  field.inputMode = "decimal";
  field.autocomplete = "off";
  field.setAttribute("aria-label", valueOf(name));
  whole.append(label, range, field, unit);
  const row = { whole, range, field, unit, stops: [] };
  range.addEventListener("input", () => {
    moved[name] = row.stops[Number(range.value)];
    show(row, moved[name]);
    enable();
    changed(true, name);
  });
  range.addEventListener("pointerdown", () => {
    holding = true;
  });
  range.addEventListener("lostpointercapture", letGo);
  range.addEventListener("pointerup", letGo);
  field.addEventListener("change", () => {
    const value = field.value.trim().replace(",", ".").replace("−", "-");
    if (value && value === moved[name]) return; // Enter was pressed before
    if (value) moved[name] = value;
    field.dataset.value = field.value.trim();
    enable();
    changed(false);
  });
  field.addEventListener("keydown", event => {
    if (event.key === "Enter") (event.preventDefault(), field.dispatchEvent(new Event("change")));
  });
  return row;
}

function letGo() {
  if (!holding) return;
  holding = false;
  if (Object.keys(moved).length) changed(true);
}

function fill(row, slider) {
  row.stops = slider.stops;
  row.unit.textContent = slider.unit;
  row.range.max = String(slider.stops.length - 1);
  row.range.title = slider.low || slider.high ? `${slider.low} … ${slider.high}` : "";
  if (moved[slider.name] !== undefined && moved[slider.name] !== slider.value) {
    if (row.stops[Number(row.range.value)] === moved[slider.name]) return; // a newer move
  }
  row.range.value = String(slider.index);
  show(row, slider.value);
}

function show(row, value) {
  if (anew || document.activeElement !== row.field) row.field.value = value;
  row.field.dataset.value = value;
  row.range.setAttribute("aria-valuetext", `${value} ${row.unit.textContent}`.trim());
}
