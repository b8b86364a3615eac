// Your turn: the reader draws with the actions of the palette, the page checks what comes of it.
if (byId("turn")) { // names of its own
const turning = JSON.parse(byId("turning").textContent), { moves, picks } = turning;
const NEAR = { mouse: 14, touch: 26 }; // dots about a point that is meant
const ORDER = Object.keys(moves).map(Number).sort((a, b) => moves[a].at - moves[b].at || a - b);

const { plus, minus, scaled, long, dot, value_of, plane_of, results, same, on_line, shape, size, SAME } = palette_of(turning, steps => all_done(steps));
const CHOICE = ["cut", "lay_off"]; // where the reader says which of two is meant

// --- where one stands -------------------------------------------------------------------------------

let turn = null; // the turn: what is done, how, and what is picked
const all_done = steps => steps.every(step => turn.done.has(step));
const there = key => all_done(picks[key].needs) && !picks[key].by;
const goals = () => ORDER.filter(step => moves[step].goal && !turn.done.has(step));

/** The moves that are still to be made: for the goals, and for whatever these need. */
function left() {
  const found = new Set(), waiting = goals();
  while (waiting.length) {
    const step = waiting.pop();
    if (found.has(step) || turn.done.has(step)) continue;
    found.add(step);
    waiting.push(...moves[step].needs);
  }
  return ORDER.filter(step => found.has(step));
}

const possible = () => left().find(step => all_done(moves[step].needs));

/** A sentence of the page with names, which are markup, escaped where they were made. */
const worded = (key, names = {}) => turning.words[key].replace(/\{(\w+)\}/g, (gap, name) => names[name] ?? gap);
const tell_turn = text => { byId("turn-say").innerHTML = text; };
const action_name = action => byId("palette").querySelector(`[data-action=${action}]`).textContent;

function begin() {
  pause();
  if (motion && moved()) drive(motion.start);
  const from = state.step;
  turn = { done: new Set(ORDER.filter(step => moves[step].at < from)), from, log: [], action: null, inputs: [], own: 0, wrong: 0, hinted: null, asked: null, fresh: [], sheet: null };
  page.classList.add("turning");
  byId("turn-panel").hidden = false;
  byId("score").hidden = true;
  tell_turn(worded("begin"));
  forget();
  stand();
  fit();
  stand();
}

function end() {
  const { from } = turn;
  for (const key of Object.keys(picks)) if (key.startsWith("own")) delete picks[key];
  turn = null;
  page.classList.remove("turning");
  byId("turn-panel").hidden = true;
  show(from);
  fit();
  byId("turn").focus();
}

/** Show what is done, on the sheet of the next step. */
function stand() {
  const next = possible(), rest = new Set(left());
  const sheet = turn.sheet ?? (next === undefined ? sheets.length - 1 : moves[next].sheet);
  const [first, end] = data.bounds[sheet];
  state.step = next !== undefined && moves[next].sheet === sheet ? moves[next].at : end;
  state.step = Math.max(first, state.step);
  sheets.forEach(({ element }, i) => { element.hidden = i !== sheet; });
  const open = Math.min(...[...rest].map(step => moves[step].at), Infinity);
  for (const mark of sheets[sheet].marks) {
    mark.classList.toggle("later", !seen(mark, open));
    mark.classList.toggle("now", turn.fresh.includes(Number(mark.dataset.of)));
    mark.classList.remove("rest");
  }
  sheets[sheet].element.classList.remove("growing");
  byId("turn-count").textContent = worded("count", { number: rest.size });
  byId("turn-sheet").hidden = sheets.length < 2;
  for (const name of ["hint", "draw-it"]) byId(name).disabled = next === undefined;
  look();
  light();
  inputs();
  if (next === undefined && !byId("score").childElementCount) finish();
}

/** Whether a mark is drawn: with its step, or once nothing is left to do up to its sentence. */
function seen(mark, open) {
  const step = mark.dataset.of, at = Number(mark.dataset.at);
  if (!at) return true;
  if (moves[step]) return turn.done.has(Number(step));
  const needs = turning.along[step];
  return needs?.length ? all_done(needs) : at < open && at <= state.step || at < turn.from;
}

// --- picking ----------------------------------------------------------------------------------------

const slots = () => turn.action ? turning.palette[turn.action] : [];
const complete = () => turn.action && slots().every((_, i) => turn.inputs[i]);
const fits = (key, slot) => slots()[slot].includes(picks[key].kind) && there(key);

function choose(action) {
  turn.action = turn.action === action ? null : action;
  turn.inputs = [];
  turn.asked = null;
  tell_turn(turn.action ? "" : worded("choose"));
  refresh();
}

function forget() {
  turn.action = null;
  turn.inputs = [];
  turn.asked = null;
}

function refresh() {
  light();
  inputs();
}

/** The lists of what can be picked for the action, and which of two is meant. */
function inputs() {
  for (const button of byId("palette").children) button.setAttribute("aria-pressed", button.dataset.action === turn.action);
  const words = byId("palette").querySelector(`[data-action="${turn.action}"]`)?.dataset.slots.split("|") ?? [];
  byId("inputs").replaceChildren(...slots().map((kinds, i) => {
    const label = document.createElement("label"), list = document.createElement("select");
    const keys = Object.keys(picks).filter(key => fits(key, i));
    const options = ["", ...keys].map(key => new Option(key ? plain(picks[key].name) : "…", key));
    list.append(...options);
    list.value = turn.inputs[i] ?? "";
    list.dataset.slot = i;
    list.addEventListener("change", () => { turn.inputs[i] = list.value; turn.asked = null; light(); ready(); });
    label.append(words[i] ?? "", list);
    return label;
  }));
  byId("which").hidden = !turn.asked;
  ready();
}

function ready() {
  byId("turn-draw").hidden = !turn.action;
  byId("turn-draw").disabled = !complete();
}

/** Markup as plain words. */
function plain(markup) {
  const words = document.createElement("span");
  words.innerHTML = markup;
  return words.textContent;
}

/** Where a value of a drawing lies in a sheet's field: which field, and the place in mm. */
function placed(plane, value) {
  const [plan, ...fields] = turning.fields[here()], side = plane === 0 ? 0 : 1;
  if (plane !== 0 && plane !== plan) return null;
  const [x, y, re, im, mm] = fields[side];
  return { side, at: [x + (value[0] - re) * mm, y - (value[1] - im) * mm], mm };
}

/** What is drawn where something can be pointed at: a point, a segment, a line or a circle in a field. */
function shown_at(key) {
  const pick = picks[key];
  if (pick.on?.length) {
    const [p, q] = pick.on.map(end => picks[end] ? placed(picks[end].plane, value_of(end)) : null);
    return p && q && { side: p.side, from: p.at, to: q.at };
  }
  if (["length", "rate", "vector"].includes(pick.kind)) return null;
  const value = value_of(key);
  if (pick.kind === "circle") {
    const found = placed(pick.plane, value.c);
    return found && { side: found.side, at: found.at, r: value.r * found.mm };
  }
  if (pick.kind === "locus" || pick.kind === "guide") {
    const p = placed(pick.plane, value[0]), unit = scaled(value[1], 1 / long(value[1]));
    return p && { side: p.side, ...stretch(p.side, key, p.at, [unit[0], -unit[1]]) };
  }
  const point = placed(pick.plane, value);
  return point && { side: point.side, at: point.at };
}

/** As far as a line is drawn, or through the whole field where nothing else shows it. */
function stretch(side, key, at, unit) {
  const sheet = sheets[here()], svg = sheet.fields[side].svg;
  const mark = (sheet.of.get(key) ?? []).find(one => one.tagName === "line" && svg.contains(one));
  if (mark) {
    const [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(name => Number(mark.getAttribute(name)));
    return { from: [x1, y1], to: [x2, y2] };
  }
  return { from: plus(at, scaled(unit, -1000)), to: plus(at, scaled(unit, 1000)) };
}

/** How far, in mm, a place of a field is from where something is drawn. */
function away(place, { at, r, from, to }) {
  if (at) return Math.abs(long(minus(place, at)) - (r ?? 0));
  const along = minus(to, from), size = dot(along, along) || 1;
  const share = Math.min(Math.max(dot(minus(place, from), along) / size, 0), 1);
  return long(minus(place, plus(from, scaled(along, share))));
}

/** Take what is pointed at for the first input that is not yet there and can be such a thing. */
function take(event) {
  const sheet = sheets[here()], side = sheet.fields.findIndex(({ svg }) => svg.contains(event.target));
  if (side < 0) return;
  const { svg } = sheet.fields[side], matrix = svg.getScreenCTM().inverse();
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
  const near = NEAR[event.pointerType === "touch" ? "touch" : "mouse"] * matrix.a;
  if (turn.asked) {
    const found = turn.asked.map(value => placed(turn.asked.plane, value))
      .findIndex(one => one && one.side === side && long(minus([x, y], one.at)) < 1.5 * near);
    if (found >= 0) settle(found);
    return;
  }
  if (!turn.action) {
    tell_turn(worded("choose"));
    return;
  }
  const open = slots().map((_, i) => i).filter(i => !turn.inputs[i]);
  let best = null;
  for (const key of Object.keys(picks)) {
    const slot = open.find(i => fits(key, i));
    if (slot === undefined || turn.inputs.includes(key) && turn.action !== "similar") continue;
    const drawn = shown_at(key);
    if (!drawn || drawn.side !== side) continue;
    const far = away([x, y], drawn), bias = drawn.at && drawn.r === undefined ? 0.5 : 1; // points before lines
    if (far < near && (!best || far * bias < best.far)) best = { key, slot, far: far * bias };
  }
  if (!best) return;
  turn.inputs[best.slot] = best.key;
  refresh();
  if (complete()) draw();
}

// --- drawing and checking ---------------------------------------------------------------------------

function draw() {
  if (!complete()) return;
  const { action } = turn, given = turn.inputs.slice(0, slots().length), plane = plane_of(action, given);
  const found = results(action, given);
  if (CHOICE.includes(action) && found.length > 1 && !alike(action, found, plane)) {
    const apart = found.filter((one, i) => found.findIndex(other => same(action, one, other, plane)) === i);
    turn.asked = Object.assign(apart, { plane, given });
    tell_turn(worded("which"));
    refresh();
    byId("which").querySelector("button").focus();
    return;
  }
  check(action, given, found, plane);
}

const alike = (action, found, plane) => found.every(one => same(action, one, found[0], plane));

/** One of two has been chosen. */
function settle(which) {
  const { given, plane } = turn.asked, found = [turn.asked[which]];
  const other = turn.asked[1 - which];
  turn.asked = null;
  check(turn.action, given, found, plane, other);
}

/** The move that gives one of some values, those that are still to be made before others. */
function giving(action, given, found, plane, among) {
  const kind = shape(action);
  const ends = among.filter(step => moves[step].plane === plane && shape(moves[step].action) === kind)
    .filter(step => !["coincide", "similar"].includes(action) || turning.places[step]?.map(String).includes(given[action === "similar" ? 2 : 0]))
    .filter(step => found.some(value => same(action, value, moves[step].value, plane)));
  return ends.find(step => alike_inputs(moves[step], action, given) === given.length) ?? ends.find(step => turn.rest.has(step)) ?? ends[0];
}

/** How many inputs of a move are those that were given; of two alike in any order. */
function alike_inputs(move, action, given) {
  if (move.action !== action) return -1;
  const own = move.inputs.map(key => picks[key].by || key);
  const count = inputs => inputs.filter((key, i) => key === given[i]).length;
  return commutes(action) ? Math.max(count(own), count([own[1], own[0], ...own.slice(2)])) : count(own);
}

const commutes = action => ["cut", "join", "divide", "similar"].includes(action);

function check(action, given, found, plane, other) {
  turn.rest = new Set(left());
  const open = ORDER.filter(step => !turn.done.has(step));
  const step = giving(action, given, found, plane, open);
  if (step !== undefined) return make(step, turn.hinted === step ? "hint" : "alone", worded("right", { name: moves[step].name }));
  const before = giving(action, given, found, plane, [...turn.done].filter(one => moves[one]));
  if (before !== undefined) return refuse(worded("already", { name: moves[before].name }), false);
  if (other && giving(action, given, [other], plane, open) !== undefined) {
    const meant = moves[giving(action, given, [other], plane, open)];
    return refuse(worded(`other_${action}`, { name: meant.name, about: meant.about ?? meant.name }));
  }
  const lies = found.length && shape(action) !== "point" && shape(action) !== "vector" && leads_to(found[0], plane, open);
  if (lies !== undefined && lies !== false && found.length) return keep_own(action, given, found[0], plane, lies);
  return refuse(why(action, given));
}

/** A point that is still sought and lies on a line or arc. */
function leads_to(curve, plane, open) {
  return open.find(step => moves[step].goal && moves[step].plane === plane && shape(moves[step].action) === "point" &&
    on_line(moves[step].value, curve) < SAME * Math.max(size(plane), long(moves[step].value)));
}

/** A line that no sentence tells of, but that leads to a point: it is kept, and can be picked. */
function keep_own(action, given, value, plane, step) {
  const key = `own${++turn.own}`, names = given.map(one => picks[one].name);
  const sign = { perpendicular: "⊥ ", parallel: "∥ " }[action] ?? "";
  const name = action === "join" ? names.join("") : `${sign}${names[1]} (${names[0]})`;
  picks[key] = { kind: shape(action) === "circle" ? "circle" : "locus", name, plane, needs: [], value };
  turn.fresh = [];
  forget();
  tell_turn(worded("own", { name: moves[step].name }));
  stand();
}

/** Why a choice is wrong, by the move that is most like it. */
function why(action, given) {
  const near = left().filter(step => moves[step].action === action).map(step => {
    const own = moves[step].inputs.map(key => picks[key].by || key);
    const turned = commutes(action) ? [own[1], own[0], ...own.slice(2)] : own;
    const count = inputs => inputs.filter((key, i) => key === given[i]).length;
    const inputs = count(turned) > count(own) ? turned : own;
    const first = inputs.findIndex((key, i) => key !== given[i]);
    return { step, inputs, first, weight: 4 * count(inputs) + 2 * (inputs[0] === given[0]) + all_done(moves[step].needs) };
  }).filter(({ weight, first }) => weight >= 4 && first >= 0).sort((a, b) => b.weight - a.weight)[0];
  if (!near) return worded("nowhere");
  const { step, inputs, first } = near, name = key => picks[key].name;
  const others = inputs.filter((_, i) => i !== first).map(name).join(", ");
  return worded(reason_key(action, first), { name: moves[step].name, about: moves[step].about ?? moves[step].name, right: name(inputs[first]), chosen: name(given[first]), other: others });
}

/** The sentence for an input: inputs that are alike have one, and Klein's construction those of the triangle. */
function reason_key(action, slot) {
  const own = `${action === "klein" ? "triangle" : action}_`;
  return own + Array.from({ length: slot + 1 }, (_, i) => slot - i).find(i => `${own}${i}` in turning.words);
}

/** A move is made: what comes along with it is drawn. */
function make(step, how, words) {
  const before = new Set(turn.done), { value, plane, action } = moves[step];
  turn.done.add(step);
  if (["line", "circle"].includes(shape(action))) { // two of one place are drawn at once
    for (const one of ORDER) if (shape(moves[one].action) === shape(action) && moves[one].plane === plane && all_done(moves[one].needs) && same(action, moves[one].value, value, plane)) turn.done.add(one);
  }
  turn.log.push({ step, how, wrong: turn.wrong });
  turn.wrong = 0;
  turn.hinted = null;
  const came = ([, needs]) => needs.length && all_done(needs) && !needs.every(one => before.has(one));
  turn.fresh = [step, ...Object.entries(turning.along).filter(came).map(([one]) => Number(one))];
  turn.sheet = null;
  forget();
  tell_turn(words);
  stand();
}

function refuse(words, counts = true) {
  if (counts) turn.wrong += 1;
  turn.inputs = [];
  turn.fresh = [];
  tell_turn(words);
  refresh();
}

/** Light what a next possible step is drawn from, and name its action. */
function hint() {
  const step = possible();
  if (step === undefined) return;
  turn.hinted = step;
  turn.sheet = null;
  forget();
  stand();
  const move = moves[step], names = move.inputs.map(key => picks[picks[key].by || key].name).join(", ");
  tell_turn(worded("hint", { action: action_name(move.action), list: names }));
}

/** Draw a next possible step. */
function draw_it() {
  const step = possible();
  if (step !== undefined) make(step, "help", worded("helped", { name: moves[step].name, action: action_name(moves[step].action) }));
}

// --- what is lit ------------------------------------------------------------------------------------

/** Mark what is picked, what a hint names and of which two one is meant; draw own lines. */
function light() {
  const sheet = sheets[here()];
  const lit = [...turn.inputs.filter(Boolean).map(key => [key, "old"]), ...(turn.hinted ? moves[turn.hinted].inputs.map(key => [picks[key].by || key, "new"]) : [])];
  for (const { halo, front } of sheet.fields) {
    halo.replaceChildren();
    front.replaceChildren();
  }
  for (const key of Object.keys(picks).filter(one => one.startsWith("own"))) put_in("front", shown_at(key), "own");
  for (const [key, look] of lit) put_in("halo", shown_at(key), look);
  byId("which").replaceChildren();
  if (!turn.asked) return;
  turn.asked.forEach((value, i) => {
    const found = placed(turn.asked.plane, value), button = document.createElement("button");
    if (found) {
      put_in("front", { side: found.side, at: found.at, ring: 2 }, "ghost");
      put_in("front", { side: found.side, at: plus(found.at, [3, -3]), text: i + 1 }, "ghost");
    }
    button.type = "button";
    button.textContent = i + 1;
    button.addEventListener("click", () => settle(i));
    byId("which").append(button);
  });
}

/** Draw a stroke in a group of a field. */
function put_in(group, drawn, look) {
  if (!drawn) return;
  const { side, at, r, from, to, ring, text } = drawn;
  const mark = document.createElementNS(SVG, text ? "text" : at ? "circle" : "line");
  const ends = text ? { x: at[0], y: at[1] } : at ? { cx: at[0], cy: at[1], r: r ?? ring ?? 2.2 } : { x1: from[0], y1: from[1], x2: to[0], y2: to[1] };
  for (const [name, number] of Object.entries(ends)) mark.setAttribute(name, number.toFixed(2));
  mark.setAttribute("class", look);
  if (text) mark.textContent = text;
  sheets[here()].fields[side][group].append(mark);
}

// --- the score sheet --------------------------------------------------------------------------------

/** All is drawn, or the reader has had enough: what was done alone, with a hint or not at all. */
function finish() {
  const count = how => turn.log.filter(one => one.how === how).length;
  const wrong = turn.wrong + turn.log.reduce((sum, one) => sum + one.wrong, 0);
  const line = document.createElement("p"), list = document.createElement("ol");
  line.innerHTML = worded("score", { all: turn.log.length, alone: count("alone"), hint: count("hint"), help: count("help"), wrong, left: left().length });
  for (const { step, how, wrong: turns } of turn.log) {
    const item = document.createElement("li");
    item.className = how;
    item.innerHTML = `${moves[step].name}: ${worded(how === "alone" ? how : `with_${how}`)}${turns ? `, ${worded("wrong", { number: turns })}` : ""}`;
    list.append(item);
  }
  byId("score").replaceChildren(line, list);
  byId("score").hidden = false;
  if (!left().length) tell_turn(worded("complete"));
}

/** What happens on the drawing and on the keys is the turn's own while it lasts. */
function within(event) {
  if (!turn) return;
  const drawing = event.target.closest?.(".sheet"), typed = event.type === "keydown";
  if (typed ? event.key === "F5" : !drawing) return;
  if (event.type === "pointerdown" && !event.target.closest("[data-of]")) return; // the field itself may be shifted
  event.stopPropagation();
  if (event.type === "click") take(event);
  if (typed && event.key === "Escape") {
    forget();
    refresh();
  }
}

for (const type of ["keydown", "click", "pointerover", "pointerdown"]) document.addEventListener(type, within, true);
byId("turn").addEventListener("click", begin);
byId("turn-end").addEventListener("click", end);
byId("turn-score").addEventListener("click", finish);
byId("hint").addEventListener("click", hint);
byId("draw-it").addEventListener("click", draw_it);
byId("turn-sheet").addEventListener("click", () => {
  turn.sheet = (here() + 1) % sheets.length;
  stand();
});
byId("turn-form").addEventListener("submit", event => {
  event.preventDefault();
  draw();
});
for (const button of byId("palette").children) button.addEventListener("click", () => choose(button.dataset.action));
addEventListener("hashchange", () => { if (turn) end(); });
}
