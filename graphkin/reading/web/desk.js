// The marking desk: one thing after the other, decided by a key or a click.
const start = JSON.parse(document.body.dataset.start);
const said = start.said;
const find = name => document.getElementById(name);
const paper = find("paper");
const whole = () => [0, 0, ...(sheet()?.size ?? [420, 297])];
const CLOSE = 60; // mm of paper that are seen about a doubtful point
const EVERY = 4000; // ms between two looks at what others decided
let sheets = [];
let items = []; // what else is to be decided: name, kind, title, state
let count = []; // the lines of the files that this page has seen
let at = 0;
let held = null; // the item in hand; null for a sheet
let row = 0; // the row of it in hand
let current = null; // the step of the point in hand
let place = null; // where it is put, before a verdict
let spot = null; // where the pointer was last
let pinning = null; // the place of a remark that is being written
let view = [0, 0, 420, 297];

const shape = (name, attributes) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
};
const sheet = () => sheets[at];
const point = () => sheet()?.points.find(each => each.step === current) ?? null;
const open = each => each.points.filter(one => one.ask).length;
const waits = item => item.state !== "decided";

const tell = text => {
  find("said").textContent = text;
};
// A request that never arrived is a TypeError; any other was refused with a reason.
const why = (error, saidFirst) =>
  error instanceof TypeError ? said.gone : `${saidFirst} ${error.message}`.trim();

async function post(path, body) {
  try {
    const answer = await fetch(path, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(body),
    });
    if (!answer.ok) throw new Error(await answer.text());
    return await answer.json();
  } catch (error) {
    tell(why(error, said.failed));
    return null;
  }
}

function look(box) {
  view = box;
  paper.setAttribute("viewBox", box.join(" "));
  draw();
}

function draw() {
  const now = sheet();
  paper.replaceChildren();
  if (!now) return;
  if (now.refused === null) {
    paper.append(
      shape("image", {
        href: `picture/${encodeURIComponent(now.name)}.jpg`,
        x: 0,
        y: 0,
        width: now.size[0],
        height: now.size[1],
        preserveAspectRatio: "none",
      }),
    );
  }
  const key = shape("g", { id: "key-lines" });
  if (find("key").getAttribute("aria-pressed") !== "true") key.classList.add("hidden");
  for (const [x1, y1, x2, y2] of now.lines)
    key.append(shape("line", { x1, y1, x2, y2, class: "line" }));
  const size = view[2] / whole()[2];
  for (const each of now.points) {
    key.append(
      shape("circle", { cx: each.key[0], cy: each.key[1], r: 0.9 * size + 0.15, class: "place" }),
    );
  }
  paper.append(key);
  const pins = pinning && !pinning.old ? [...now.pins, pinning] : now.pins;
  pins.forEach((each, i) => {
    const [x, y] = each.at;
    const number = shape("text", {
      x,
      y: y + 1.7 * size,
      "font-size": 4.8 * size,
      class: "pin-number",
    });
    number.textContent = i + 1;
    paper.append(shape("circle", { cx: x, cy: y, r: 3.4 * size, class: "pin" }), number);
  });
  for (const each of now.points) {
    const mine = each.step === current;
    const where = mine && place ? place : each.at;
    if (!where) continue;
    if (mine && each.key) {
      paper.append(
        shape("line", {
          x1: where[0],
          y1: where[1],
          x2: each.own[0],
          y2: each.own[1],
          class: "shift",
        }),
      );
    }
    paper.append(
      shape("circle", {
        cx: where[0],
        cy: where[1],
        r: 2.4 * size + 0.4,
        class: `mark ${each.verdict}${mine ? " current" : ""}`,
      }),
    );
  }
}

function list() {
  const now = sheet();
  const rows = (now?.points ?? []).map(each => {
    const row = document.createElement("tr");
    row.classList.toggle("asked", each.ask);
    if (each.step === current) row.setAttribute("aria-current", "true");
    const off = each.at
      ? Math.hypot(each.at[0] - each.own[0], each.at[1] - each.own[1]).toFixed(1)
      : "–";
    const verdict = said[each.verdict] + (each.decided ? " ✓" : "");
    row.append(marked("td", each.symbol), element("td", verdict), element("td", off));
    row.addEventListener("click", () => hold(each.step));
    return row;
  });
  find("points").replaceChildren(...rows);
  find("pins").replaceChildren(
    ...(now?.pins ?? []).map(each => {
      const line = document.createElement("li");
      line.textContent = each.note;
      line.addEventListener("click", () => writePin({ ...each, old: true }));
      return line;
    }),
  );
  queue();
  const rivals = point()?.rivals;
  const refused = now?.refused && `${said.refused} ${now.refused}`;
  tell([refused, now?.whole, rivals && `${said.rivals} ${rivals}`].filter(Boolean).join(" "));
}

const label = each =>
  `${each.name}: ${each.who || each.code}, ${each.kind}${each.refused ? " ✗" : open(each) ? ` (${open(each)} ?)` : " ✓"}`;
const sign = { open: " ?", decided: " ✓", disagree: " ≠" };

// The queue: what waits in cells, then drawings, then all else. Each entry is an item or a sheet.
function entries() {
  const of = kind => items.filter(each => each.kind === kind).map(item => ({ item }));
  const [first, ...rest] = start.kinds;
  const groups = [
    [`kind_${first}`, of(first)],
    ["sheets", sheets.map((_, sheet) => ({ sheet }))],
  ];
  return [...groups, ...rest.map(kind => [`kind_${kind}`, of(kind)])].filter(
    ([, some]) => some.length,
  );
}
const isHere = entry => (held ? entry.item?.name === held.name : entry.sheet === at);

function queue() {
  const groups = entries().map(([key, some]) => {
    const group = document.createElement("optgroup");
    group.label = said[key];
    for (const entry of some) {
      const option = document.createElement("option");
      option.textContent = entry.item
        ? entry.item.title + sign[entry.item.state]
        : label(sheets[entry.sheet]);
      option.selected = isHere(entry);
      group.append(option);
    }
    return group;
  });
  find("queue").replaceChildren(...groups);
  const left = sheets.reduce((sum, each) => sum + open(each), 0) + items.filter(waits).length;
  find("open").textContent = left ? said.open.replace("{count}", left) : said.none_open;
}

function panels() {
  for (const [kind, out] of Object.entries({
    ".of-drawing": held !== null,
    ".of-marks": held === null,
  })) {
    for (const part of document.querySelectorAll(kind)) part.toggleAttribute("hidden", out); // an SVG has no property for it
  }
}

async function get(path) {
  try {
    const answer = await fetch(path);
    if (!answer.ok) throw new Error(await answer.text());
    return await answer.json();
  } catch (error) {
    tell(why(error, ""));
    return null;
  }
}

// --- one item: a card ----------------------------------------------------------------------

async function holdItem(name) {
  const found = await get(`item/${encodeURIComponent(name)}`);
  if (!found) return;
  row = 0;
  card(found);
  for (const field of ["reading", "own-points", "reason"]) find(field).value = "";
  find("reading").value = found.cut_out ? "" : (found.reads ?? "");
  find(found.cut_out && waits(found) ? "reading" : "card").focus();
}

function element(name, text = "", kind = "") {
  const made = document.createElement(name);
  made.textContent = text;
  if (kind) made.className = kind;
  return made;
}

function marked(name, html, kind = "") {
  const made = element(name, "", kind);
  made.innerHTML = html; // written and escaped by the desk, never by a student
  return made;
}

function card(found) {
  held = found;
  panels();
  find("card-title").textContent = `${said[`kind_${found.kind}`]}: ${found.title}`;
  find("told").textContent = found.told;
  find("cut-out").hidden = !found.cut_out;
  if (found.cut_out) find("cut-out").src = `cut-out/${encodeURIComponent(found.name)}.jpg`;
  find("sums").replaceChildren(...found.sums.map(each => element("li", each)));
  find("causes").replaceChildren(...found.causes.map(each => marked("li", each)));
  const who = new Set(found.rows.map(each => each.who)).size > 1;
  const heads = element("tr");
  heads.append(
    ...(who ? [element("th", said.student)] : []),
    ...found.heads.map((each, i) => marked("th", each, i ? "n" : "")),
  );
  const lines = found.rows.flatMap((each, i) => {
    const cells = element("tr", "", "cells");
    cells.append(...(who ? [element("td", each.who)] : []));
    cells.append(...each.cells.map((cell, j) => marked("td", cell, j ? "n" : "")));
    const below = element("tr", "", "why");
    const why = marked("td", [each.why, each.table].filter(Boolean).join("; "), each.status);
    why.colSpan = found.heads.length + (who ? 1 : 0);
    if (each.remark)
      why.append(
        document.createElement("br"),
        element("span", `${said.remark}: ${each.remark}`, "remark"),
      );
    below.append(why);
    for (const part of [cells, below]) {
      if (i === row) part.setAttribute("aria-current", "true");
      part.addEventListener("click", () => holdRow(i));
    }
    return [cells, below];
  });
  find("rows").replaceChildren(...(lines.length ? [heads, ...lines] : []));
  find("decided").replaceChildren(...found.decided.map(each => element("li", each)));
  find("decided").className = found.state;
  find("options").replaceChildren(
    ...found.choices.map((each, i) => {
      const button = element("button");
      button.append(element("kbd", i + 1), ` ${each}`);
      button.addEventListener("click", () => rule({ choice: i }));
      return button;
    }),
  );
  find("reads").hidden = found.reads === null;
  find("own-points").placeholder = found.most ? `0 … ${found.most}` : "";
  find("remark").value = found.rows[row]?.remark ?? "";
  find("remark").disabled = !found.rows.length;
  queue();
  tell(found.state === "disagree" ? said.disagree : "");
}

function holdRow(i) {
  row = Math.min(held.rows.length - 1, Math.max(0, i));
  card(held);
  document.querySelector("#rows [aria-current]")?.scrollIntoView({ block: "nearest" });
}

async function rule(what) {
  const found = await post("rule", {
    item: held.name,
    known: held.known,
    reason: find("reason").value,
    ...what,
  });
  if (!found) return;
  items = found.items;
  held = null;
  const waiting = items.find(each => each.name === found.name);
  if (waiting.state === "disagree") {
    await holdItem(found.name);
    return;
  }
  queue();
  next({ item: waiting });
  tell(said.saved);
}

async function remark() {
  const found = await post("remark", {
    item: held.name,
    known: held.known,
    row,
    text: find("remark").value,
  });
  if (!found) return;
  card(found);
  find("card").focus();
  tell(said.saved);
}

// --- one sheet: points and pins -------------------------------------------------------------

function writePin(pin) {
  pinning = pin;
  find("pin").value = pin.note;
  find("pin").focus();
  draw();
}

async function savePin() {
  const { at: where } = pinning;
  const note = find("pin").value.trim();
  pinning = null;
  find("pin").value = "";
  paper.focus();
  draw();
  const found = await post("decide", {
    sheet: sheet().name,
    step: null,
    verdict: "unread",
    at: where,
    note,
    seen: sheet().known,
  });
  if (!found) return;
  sheets[at] = found;
  draw();
  list();
  tell(said.saved);
}

function hold(step) {
  held = null;
  panels();
  current = step;
  place = null;
  const now = point();
  find("note").value = now?.note ?? "";
  propose(now?.verdict);
  if (now) {
    const middle = now.at ?? now.own;
    const wide =
      CLOSE * Math.max(1, Math.hypot(middle[0] - now.key[0], middle[1] - now.key[1]) / 20);
    look([middle[0] - wide / 2, middle[1] - (wide / 2) * 0.7, wide, wide * 0.7]);
  } else look(whole());
  list();
}

// The next that waits: on this sheet after the point in hand, then in the queue after ``from``.
function next(from = null) {
  const here = from === null && held === null ? sheet() : null;
  const [asked] = here?.points.filter(each => each.ask && after(each)) ?? [];
  if (asked) {
    hold(asked.step);
    return;
  }
  const every = entries().flatMap(([, some]) => some);
  const same = entry => (from ? entry.item?.name === from.item.name : isHere(entry));
  const place = every.findIndex(same);
  for (let i = 1; i <= every.length; i += 1) {
    if (holdWaiting(every[(place + i) % every.length])) return;
  }
  if (sheets.length) hold(null);
  else if (items.length) holdItem((from?.item ?? held ?? items[0]).name);
  else queue();
}
// Take an entry of the queue in hand if it waits; whether it does.
function holdWaiting(entry) {
  if (entry.item) {
    if (!waits(entry.item)) return false;
    holdItem(entry.item.name);
    return true;
  }
  const asked = sheets[entry.sheet].points.find(each => each.ask);
  if (!asked) return false;
  at = entry.sheet;
  hold(asked.step);
  return true;
}
const after = each => {
  const steps = sheet().points.map(one => one.step);
  return steps.indexOf(each.step) > steps.indexOf(current);
};

async function decide(verdict) {
  const now = point();
  if (!now) return;
  const where = verdict === "missing" ? null : (place ?? now.at);
  if (verdict !== "missing" && !where) {
    tell(said.help);
    return;
  }
  const found = await post("decide", {
    sheet: sheet().name,
    step: current,
    verdict,
    at: where,
    note: find("note").value,
    seen: sheet().known,
  });
  if (!found) return;
  sheets[at] = found;
  next();
  tell(said.saved);
}

async function undo() {
  const found = await post("undo", {});
  if (!found) return;
  if (found.items) {
    items = found.items;
    if (found.item) holdItem(found.item);
    else queue();
    return;
  }
  if (!found.name) return;
  const { step, ...rest } = found;
  at = sheets.findIndex(each => each.name === rest.name);
  sheets[at] = rest;
  hold(step);
}

function put(x, y) {
  const now = point();
  if (!now) return;
  place = [
    Math.round(Math.min(whole()[2], Math.max(0, x)) * 100) / 100,
    Math.round(Math.min(whole()[3], Math.max(0, y)) * 100) / 100,
  ];
  draw();
  propose(likely(now));
}

// What the new place of a point makes likely. By hand the student's own place of it is not known
// (it is taken for the key's): after a mistake, what lies elsewhere may follow from that.
function likely(now) {
  const off = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]);
  const near = Math.max(now.error, 0.5);
  const moved = off(now.own, now.key) > near;
  if (off(place, now.own) <= near) return moved ? "follows" : "right";
  const before = sheet().points.slice(0, sheet().points.indexOf(now));
  const mistaken = before.some(each => !each.ask && ["wrong", "missing"].includes(each.verdict));
  return moved || !mistaken ? "wrong" : "";
}

// What Enter decides: what was read of the point, or what its new place makes likely.
function propose(likely) {
  for (const button of document.querySelectorAll("#choices button")) {
    button.setAttribute("aria-pressed", button.dataset.verdict === likely);
  }
}

const toggle = () => {
  const pressed = find("key").getAttribute("aria-pressed") === "true";
  find("key").setAttribute("aria-pressed", !pressed);
  draw();
};
let flickering = null;
const flicker = () => {
  if (flickering) {
    clearInterval(flickering);
    flickering = null;
    paper.classList.remove("flicker");
    return;
  }
  flickering = setInterval(() => paper.classList.toggle("flicker"), 350);
};
const zoom = (times, x = view[0] + view[2] / 2, y = view[1] + view[3] / 2) => {
  const wide = Math.min(whole()[2], Math.max(8, view[2] * times));
  const ratio = wide / view[2];
  look([x - (x - view[0]) * ratio, y - (y - view[1]) * ratio, wide, view[3] * ratio]);
};
const nudge = (x, y) => {
  const now = place ?? point()?.at ?? point()?.own;
  if (now) put(now[0] + x, now[1] + y);
};

const where = event => {
  const spot = new DOMPoint(event.clientX, event.clientY).matrixTransform(
    paper.getScreenCTM().inverse(),
  );
  return [spot.x, spot.y];
};
let dragged = false;
paper.addEventListener("pointerdown", event => {
  dragged = true;
  put(...where(event));
  paper.setPointerCapture(event.pointerId);
});
paper.addEventListener("pointermove", event => {
  spot = where(event).map(part => Math.round(part * 100) / 100);
  if (dragged) put(...spot);
});
paper.addEventListener("pointerup", () => {
  dragged = false;
});
paper.addEventListener(
  "wheel",
  event => {
    event.preventDefault();
    zoom(event.deltaY > 0 ? 1.2 : 1 / 1.2, ...where(event));
  },
  { passive: false },
);

const write = field => {
  find(field).focus();
  find(field).select();
};
const choose = i => () => {
  if (i < held.choices.length) rule({ choice: i });
};
const everywhere = { n: () => next(), u: undo, PageDown: () => turn(1), PageUp: () => turn(-1) };
const onMarks = {
  r: () => {
    if (held.reads !== null) write("reading");
  },
  p: () => write("own-points"),
  m: () => write("reason"),
  c: () => write("remark"),
  ArrowUp: () => holdRow(row - 1),
  ArrowDown: () => holdRow(row + 1),
  ...Object.fromEntries([...Array(9).keys()].map(i => [i + 1, choose(i)])),
};
const onPaper = {
  k: toggle,
  f: flicker,
  "+": () => zoom(1 / 1.4),
  "-": () => zoom(1.4),
  0: () => look(whole()),
  1: () => decide("right"),
  2: () => decide("follows"),
  3: () => decide("wrong"),
  4: () => decide("missing"),
  Enter: () => {
    const likely = document.querySelector('#choices button[aria-pressed="true"]');
    if (likely) decide(likely.dataset.verdict);
    else tell(point() ? said.help : "");
  },
  m: () => find("note").focus(),
  c: () => {
    const middle = [view[0] + view[2] / 2, view[1] + view[3] / 2];
    writePin({ at: spot ?? place ?? point()?.at ?? middle, note: "" });
  },
  ArrowLeft: far => nudge(-far, 0),
  ArrowRight: far => nudge(far, 0),
  ArrowUp: far => nudge(0, -far),
  ArrowDown: far => nudge(0, far),
};
const onEnter = {
  // what Enter does in a field; in the others it leaves the field
  pin: savePin,
  remark,
  reading: () => {
    const reading = find("reading").value;
    if (held.cut_out && !reading.trim()) next();
    else rule({ reading });
  },
  "own-points": () => rule({ points: find("own-points").value.trim() }),
};
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const target = /** @type {Element} */ (event.target);
  if (target.matches("input")) inField(event);
  else if (!target.matches("select, button") || event.key !== "Enter") onDesk(event);
});
// Enter and Escape in a field.
function inField(event) {
  if (event.key !== "Escape" && event.key !== "Enter") return;
  const work = event.key === "Enter" ? onEnter[event.target.id] : null;
  if (work) {
    event.preventDefault();
    work();
    return;
  }
  pinning = null;
  (held ? find("card") : paper).focus();
  if (!held) draw();
}
// A key outside all fields.
function onDesk(event) {
  const keys = { ...everywhere, ...(held ? onMarks : onPaper) };
  const act = keys[event.key] ?? keys[event.key.toLowerCase()];
  if (!act || event.target.matches("select")) return;
  event.preventDefault();
  act(event.shiftKey ? 1 : 0.1);
}
function go(entry) {
  if (entry.item) {
    holdItem(entry.item.name);
    return;
  }
  at = entry.sheet;
  hold(null);
}
function turn(way) {
  const every = entries().flatMap(([, some]) => some);
  if (every.length) go(every[(every.findIndex(isHere) + way + every.length) % every.length]);
}

// Whether a card is shown already as it is: made anew, its buttons would miss a click on them.
function isShown(card) {
  const own = each => JSON.stringify({ ...each, known: 0 });
  return own(card) === own(held);
}

// What others decided meanwhile.
async function news() {
  const found = await post("news", count);
  if (!found?.count) return;
  const typing = document.activeElement?.matches("input") && document.activeElement.value;
  ({ sheets, items, count } = found);
  if (held) {
    const now = await get(`item/${encodeURIComponent(held.name)}`);
    if (now && isShown(now)) held = now;
    else if (now && held?.name === now.name && !typing) card(now);
    queue();
  } else if (!typing && sheets.length) {
    draw();
    list();
  } else queue();
}

find("next").addEventListener("click", () => next());
find("undo").addEventListener("click", undo);
find("key").addEventListener("click", toggle);
find("flicker").addEventListener("click", flicker);
find("queue").addEventListener("change", () => {
  go(entries().flatMap(([, some]) => some)[find("queue").selectedIndex]);
});
for (const button of document.querySelectorAll("#choices button")) {
  button.addEventListener("click", () => decide(button.dataset.verdict));
}
(async () => {
  const found = await get("everything");
  if (!found) return;
  ({ sheets, items, count } = found);
  const first = entries().flatMap(([, some]) => some)[0];
  if (first?.item && waits(first.item)) await holdItem(first.item.name);
  else {
    held = first?.item ?? null;
    panels();
    next();
  }
  setInterval(news, EVERY);
  document.body.dataset.ready = "yes";
})();
