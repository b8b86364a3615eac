// The inputs of a move, picked on the drawing or in lists, and their highlights.
const slots = () => turn.action ? turning.palette[turn.action] : [];
const is_complete = () => turn.action && slots().every((_, i) => turn.inputs[i]);
const fits = (key, slot) => slots()[slot].includes(picks[key].kind) && is_there(key);

function choose_action(action) {
  turn.action = turn.action === action ? null : action;
  turn.inputs = [];
  turn.asked = null;
  show_picks();
  if (!turn.action) tell_turn(worded("choose"));
  else ask_inputs();
}

/** The words for the inputs of the action. */
const slot_words = (action = turn.action) => byId("palette").querySelector(`[data-action="${action}"]`)?.dataset.slots.split("|") ?? [];

/** Name the inputs that the action still needs, or repeat the hint. */
function ask_inputs() {
  if (turn.hinted && moves[turn.hinted].action === turn.action) return tell_hint();
  if (turn.wrong) byId("turn-sentence").replaceChildren(); // the reason of an earlier choice
  const list = slot_words().map((word, i) => `${word} ${turn.inputs[i] ? picks[turn.inputs[i]].name : "…"}`).join(", ");
  tell_turn(worded("hint", { action: action_name(turn.action), list }));
}

function forget_inputs() {
  turn.action = null;
  turn.inputs = [];
  turn.asked = null;
}

function show_picks() {
  light_up();
  show_inputs();
}

/** Show the lists of possible inputs of the action, and the choice between two results. */
function show_inputs() {
  for (const button of byId("palette").children) button.setAttribute("aria-pressed", button.dataset.action === turn.action);
  const words = slot_words();
  byId("inputs").replaceChildren(...slots().map((kinds, i) => {
    const label = document.createElement("label"), list = document.createElement("select");
    const keys = Object.keys(picks).filter(key => fits(key, i));
    const options = ["", ...keys].map(key => new Option(key ? plain_words(picks[key].name) : "…", key));
    list.append(...options);
    list.value = turn.inputs[i] ?? "";
    list.dataset.slot = i;
    list.addEventListener("change", () => {
      turn.inputs[i] = list.value;
      turn.asked = null;
      byId("which").hidden = true;
      light_up();
      show_ready();
      ask_inputs();
    });
    label.append(words[i] ?? "", list);
    return label;
  }));
  byId("which").hidden = !turn.asked;
  show_ready();
}

function show_ready() {
  byId("turn-draw").hidden = !turn.action || Boolean(turn.asked);
  byId("turn-draw").disabled = !is_complete();
}

/** Markup as plain text. */
function plain_words(markup) {
  const words = document.createElement("span");
  words.innerHTML = markup;
  return words.textContent;
}

/** The field of a sheet that shows a value of a drawing, and the place in it in mm. */
function placed(plane, value) {
  const [plan, ...fields] = turning.fields[here()], side = plane === 0 ? 0 : 1;
  if (plane !== 0 && plane !== plan) return null;
  const [x, y, re, im, mm] = fields[side];
  return { side, at: [x + (value[0] - re) * mm, y - (value[1] - im) * mm], mm };
}

/** The shape at which a pick can be pointed at: a point, segment, line or circle of a field. */
function shown_at(key) {
  const pick = picks[key];
  if (pick.on?.length) {
    const [p, q] = pick.on.map(end => picks[end] ? placed(picks[end].plane, value_of(end)) : circle_of(end));
    return p && q && { side: p.side, from: p.at, to: q.at };
  }
  if (["length", "rate", "vector"].includes(pick.kind)) return null;
  const value = value_of(key);
  if (pick.kind === "circle") {
    const found = placed(pick.plane, value.c);
    return found && { side: found.side, at: found.at, r: value.r * found.mm };
  }
  if (pick.kind === "locus" || pick.kind === "guide") {
    const p = placed(pick.plane, value[0]), unit = scaled(value[1], 1 / length_of(value[1]));
    return p && { side: p.side, ...stretch(p.side, key, p.at, [unit[0], -unit[1]]) };
  }
  const point = placed(pick.plane, value);
  return point && { side: point.side, at: point.at };
}

/** The drawn circle of a point that is no input itself, such as a corner of a triangle. */
function circle_of(step) {
  const sheet = sheets[here()], circle = pin(sheet, step);
  return circle && { side: sheet.fields.findIndex(({ svg }) => svg.contains(circle)), at: ["cx", "cy"].map(name => Number(circle.getAttribute(name))) };
}

/** The drawn extent of a line, or the whole field where no mark shows the line. */
function stretch(side, key, at, unit) {
  const sheet = sheets[here()], svg = sheet.fields[side].svg;
  const mark = !turn.open.has(Number(key)) && (sheet.of.get(key) ?? []).find(one => one.tagName === "line" && svg.contains(one));
  if (mark) {
    const [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(name => Number(mark.getAttribute(name)));
    return { from: [x1, y1], to: [x2, y2] };
  }
  return { from: plus(at, scaled(unit, -1000)), to: plus(at, scaled(unit, 1000)) };
}

/** The distance, in mm, of a place of a field from a shape. */
function far_from(place, { at, r, from, to }) {
  if (at) return Math.abs(length_of(minus(place, at)) - (r ?? 0));
  const along = minus(to, from), size = dot(along, along) || 1;
  const share = Math.min(Math.max(dot(minus(place, from), along) / size, 0), 1);
  return length_of(minus(place, plus(from, scaled(along, share))));
}

/** Take the shape pointed at as the first open input that accepts it. */
function take_at(event) {
  const sheet = sheets[here()], side = sheet.fields.findIndex(({ svg }) => svg.contains(event.target));
  if (side < 0) return;
  const { svg } = sheet.fields[side], matrix = svg.getScreenCTM().inverse();
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
  const near = NEAR[event.pointerType === "touch" ? "touch" : "mouse"] * matrix.a;
  if (turn.asked) {
    const found = turn.asked.map(value => placed(turn.asked.plane, value))
      .findIndex(one => one && one.side === side && length_of(minus([x, y], one.at)) < 1.5 * near);
    if (found >= 0) settle_which(found);
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
    const far = far_from([x, y], drawn), ahead = drawn.at && drawn.r === undefined ? 0.6 * near : 0; // points before lines
    const later = drawn.from ? 0.01 * Math.min(length_of(minus(drawn.to, drawn.from)), 150) : 0; // of two on one line the shorter one
    if (far < near && (!best || far - ahead + later < best.far)) best = { key, slot, far: far - ahead + later };
  }
  if (!best) return;
  turn.inputs[best.slot] = best.key;
  show_picks();
  if (is_complete()) draw_move();
  else ask_inputs();
}

/** Mark the picks, the inputs of a hint and the choice between results; draw own lines. */
function light_up() {
  const sheet = sheets[here()];
  const lit = [...turn.inputs.filter(Boolean).map(key => [key, "old"]), ...(turn.hinted ? moves[turn.hinted].inputs.map(key => [picks[key].by || key, "new"]) : [])];
  for (const { halo, front } of sheet.fields) {
    halo.replaceChildren();
    front.replaceChildren();
  }
  for (const step of turn.open) whole_line(String(step), turn.fresh.includes(step) ? "open fresh" : "open");
  for (const key of Object.keys(picks).filter(one => one.startsWith("own") && is_there(one))) put_in("front", shown_at(key), "own");
  for (const [key, look] of lit) put_in("halo", shown_at(key), look);
  byId("which").replaceChildren();
  if (!turn.asked) return;
  turn.asked.forEach((value, i) => {
    const found = placed(turn.asked.plane, value), button = document.createElement("button");
    const start = found && turn.action === "lay_off" ? placed(turn.asked.plane, value_of(turn.inputs[0])) : null;
    if (start) put_in("front", { side: found.side, from: start.at, to: found.at }, "ghost");
    if (found) {
      put_in("front", { side: found.side, at: found.at, ring: 2 }, "ghost");
      put_in("front", { side: found.side, at: inside(found.side, plus(found.at, [3, -3])), text: String(i + 1) }, "ghost");
    }
    button.type = "button";
    button.textContent = i + 1;
    button.addEventListener("click", () => settle_which(i));
    byId("which").append(button);
  });
}

/** A line or arc that still holds an unknown point, drawn in full, since its drawn part would reveal it. */
function whole_line(key, look) {
  const drawn = shown_at(key);
  put_in("front", drawn, look);
  if (!drawn?.from) return;
  const { svg, lettering } = sheets[here()].fields[drawn.side], { x, y, width, height } = svg.viewBox.baseVal;
  const start = placed(picks[key].plane, value_of(key)[0]).at, unit = scaled(minus(drawn.to, drawn.from), 1 / length_of(minus(drawn.to, drawn.from)));
  const text = picks[key].name.replace(/ \(.*\)$/, ""), mark = put_in("front", { side: drawn.side, at: start, text }, "open"), ink = mark.getBBox();
  const half = [ink.width / 2, 0.4 * ink.height], reach = Math.abs(unit[1]) * half[0] + Math.abs(unit[0]) * half[1] + 0.7 * lettering;
  const taken = taken_in(svg, mark), own = one => one.to && [one.from, one.to].every(end => Math.abs(cross(minus(end, start), unit)) < 0.1);
  let best = null;
  for (let far = 6; far < width + height; far += 2) {
    for (const [along, aside] of [[far, reach], [far, -reach], [-far, reach], [-far, -reach]]) {
      const at = plus(plus(start, scaled(unit, along)), scaled([-unit[1], unit[0]], aside)), off = minus(at, [x + width / 2, y + height / 2]);
      if (Math.abs(off[0]) > width / 2 - half[0] - 1 || Math.abs(off[1]) > height / 2 - half[1] - 1) continue;
      const cost = 0.02 * Math.abs(far - 22) + taken.filter(one => !own(one)).reduce((sum, one) => sum + covers(at, half, one), 0);
      if (!best || cost < best.cost) best = { at, cost };
    }
  }
  const [u, v] = minus(best?.at ?? start, [ink.x + ink.width / 2, ink.y + ink.height / 2]);
  mark.setAttribute("x", (start[0] + u).toFixed(2));
  mark.setAttribute("y", (start[1] + v).toFixed(2));
}

/** The obstacles in a field except one label: boxes of letters and points, and lines end to end. */
function taken_in(svg, label = null) {
  const marks = [...svg.querySelectorAll(":is(text,circle,line):not(.later,.void,[visibility],.hushed,.grip,.leader,.halo:first-of-type *)")];
  return marks.filter(mark => mark !== label).map(mark => {
    const number = name => Number(mark.getAttribute(name));
    if (mark.matches("line")) return { from: [number("x1"), number("y1")], to: [number("x2"), number("y2")] };
    const { x, y, width, height } = mark.getBBox(), larger = mark.closest(".lettering") ? Number(svg.style.getPropertyValue("--t")) || 1 : 1;
    return { at: [x + width / 2, y + height / 2], half: [larger * width / 2, larger * (mark.matches("text") ? INK : 1) * height / 2], letters: mark.matches("text") };
  }).filter(({ half }) => !half || half[0] < 20);
}

/** The cost of the objects that a label of half size [a, b] would cover at a place. */
function covers(at, [a, b], { from, to, at: middle, half, letters }) {
  const [u, v] = minus(at, from ? scaled(plus(from, to), 0.5) : middle).map(Math.abs);
  if (!from) return u < a + half[0] && v < b + half[1] ? letters ? 20 : 4 : 0;
  const way = scaled(minus(to, from), 0.5), turned = Math.abs(cross(minus(at, from), way));
  return u < a + Math.abs(way[0]) && v < b + Math.abs(way[1]) && turned < a * Math.abs(way[1]) + b * Math.abs(way[0]) ? 3 : 0;
}

/** The nearest place that has room for a digit in a field. */
function inside(side, [u, v]) {
  const { x, y, width, height } = sheets[here()].fields[side].svg.viewBox.baseVal;
  return [Math.min(Math.max(u, x + 2), x + width - 5), Math.min(Math.max(v, y + 6), y + height - 2)];
}

/** Write a symbol into a text of a drawing, with lowered, smaller indices. */
function write_symbol(text, markup) {
  const words = document.createElement("span");
  words.innerHTML = markup; // escaped by its maker
  let [lowered, shift] = [0, 0]; // parts of the letter height
  for (const node of words.childNodes) {
    const part = document.createElementNS(SVG, "tspan"), look = node.nodeName.toLowerCase();
    shift = { sub: 0.26, sup: -0.37 }[look] ?? 0;
    part.setAttribute("dy", `${(shift - lowered) / (shift ? 0.7 : 1)}em`);
    part.setAttribute("class", look.replace("#", ""));
    part.textContent = node.textContent;
    lowered = shift;
    text.append(part);
  }
}

/** Draw a stroke in a group of a field. */
function put_in(group, drawn, look) {
  if (!drawn) return;
  const { side, at, r, from, to, ring, text } = drawn;
  const mark = document.createElementNS(SVG, text ? "text" : at ? "circle" : "line");
  const ends = text ? { x: at[0], y: at[1] } : at ? { cx: at[0], cy: at[1], r: r ?? ring ?? 2.2 } : { x1: from[0], y1: from[1], x2: to[0], y2: to[1] };
  for (const [name, number] of Object.entries(ends)) mark.setAttribute(name, number.toFixed(2));
  mark.setAttribute("class", look);
  if (text) write_symbol(mark, text);
  sheets[here()].fields[side][group].append(mark);
  return mark;
}
