"use strict";
// The marking desk: one point after the other, decided by a key or a click.
(() => {
  const start = JSON.parse(document.body.dataset.start);
  const said = start.said;
  const find = (name) => document.getElementById(name);
  const paper = find("paper");
  const whole = () => [0, 0, ...(sheet()?.size ?? [420, 297])];
  const CLOSE = 60; // mm of paper that are seen about a doubtful point
  let sheets = [];
  let at = 0;
  let current = null; // the step of the point in hand
  let place = null; // where it is put, before a verdict
  let view = [0, 0, 420, 297];

  const shape = (name, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  };
  const sheet = () => sheets[at];
  const point = () => sheet()?.points.find((each) => each.step === current) ?? null;
  const open = (each) => each.points.filter((one) => one.ask).length;

  const tell = (text) => { find("said").textContent = text; };

  async function post(path, body) {
    try {
      const answer = await fetch(path, {
        method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body),
      });
      if (!answer.ok) throw new Error(await answer.text());
      return await answer.json();
    } catch (error) {
      tell(`${said.failed} ${error.message ?? ""}`);
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
      paper.append(shape("image", {
        href: `picture/${encodeURIComponent(now.name)}.jpg`, x: 0, y: 0, width: now.size[0], height: now.size[1],
        preserveAspectRatio: "none",
      }));
    }
    const key = shape("g", { id: "key-lines" });
    if (find("key").getAttribute("aria-pressed") !== "true") key.classList.add("hidden");
    for (const [x1, y1, x2, y2] of now.lines) key.append(shape("line", { x1, y1, x2, y2, class: "line" }));
    const size = view[2] / whole()[2];
    for (const each of now.points) {
      key.append(shape("circle", { cx: each.key[0], cy: each.key[1], r: 0.9 * size + 0.15, class: "place" }));
    }
    paper.append(key);
    for (const each of now.points) {
      const mine = each.step === current;
      const where = mine && place ? place : each.at;
      if (!where) continue;
      if (mine && each.key) {
        paper.append(shape("line", { x1: where[0], y1: where[1], x2: each.own[0], y2: each.own[1], class: "shift" }));
      }
      paper.append(shape("circle", {
        cx: where[0], cy: where[1], r: 2.4 * size + 0.4,
        class: `mark ${each.verdict}${mine ? " current" : ""}`,
      }));
    }
  }

  function list() {
    const now = sheet();
    const rows = (now?.points ?? []).map((each) => {
      const row = document.createElement("tr");
      row.classList.toggle("asked", each.ask);
      if (each.step === current) row.setAttribute("aria-current", "true");
      const off = each.at ? Math.hypot(each.at[0] - each.own[0], each.at[1] - each.own[1]).toFixed(1) : "–";
      for (const text of [each.name, said[each.verdict] + (each.decided ? " ✓" : ""), off]) {
        const cell = document.createElement("td");
        cell.textContent = text;
        row.append(cell);
      }
      row.addEventListener("click", () => hold(each.step));
      return row;
    });
    find("points").replaceChildren(...rows);
    const left = sheets.reduce((sum, each) => sum + open(each), 0);
    find("open").textContent = left ? said.open.replace("{count}", left) : said.none_open;
    [...find("sheet").options].forEach((option, i) => {
      option.textContent = label(sheets[i]);
    });
    find("sheet").selectedIndex = at;
    tell(now?.refused ? `${said.refused} ${now.refused}` : "");
  }

  const label = (each) =>
    `${each.name}: ${each.who || each.code}, ${each.kind}${each.refused ? " ✗" : open(each) ? ` (${open(each)} ?)` : " ✓"}`;

  function hold(step) {
    current = step;
    place = null;
    const now = point();
    find("note").value = now?.note ?? "";
    propose(now?.verdict);
    if (now) {
      const middle = now.at ?? now.own;
      const wide = CLOSE * Math.max(1, Math.hypot(middle[0] - now.key[0], middle[1] - now.key[1]) / 20);
      look([middle[0] - wide / 2, middle[1] - wide / 2 * 0.7, wide, wide * 0.7]);
    } else look(whole());
    list();
  }

  function next() {
    for (let i = 0; i < sheets.length; i += 1) {
      const there = (at + i) % sheets.length;
      const asked = sheets[there].points.filter((each) => each.ask);
      const later = i ? asked : [...asked.filter((each) => after(each)), ...asked];
      if (later.length) {
        at = there;
        hold(later[0].step);
        return;
      }
    }
    hold(null);
  }
  const after = (each) => {
    const steps = sheet().points.map((one) => one.step);
    return steps.indexOf(each.step) > steps.indexOf(current);
  };

  async function decide(verdict) {
    const now = point();
    if (!now) return;
    const where = verdict === "missing" ? null : (place ?? now.at);
    if (verdict !== "missing" && !where) { tell(said.help); return; }
    const found = await post("decide", {
      sheet: sheet().name, step: current, verdict, at: where, note: find("note").value,
    });
    if (!found) return;
    sheets[at] = found;
    next();
    tell(said.saved);
  }

  async function undo() {
    const found = await post("undo", {});
    if (!found || !found.name) return;
    const { step, ...rest } = found;
    at = sheets.findIndex((each) => each.name === rest.name);
    sheets[at] = rest;
    hold(step);
  }

  function put(x, y) {
    const now = point();
    if (!now) return;
    place = [Math.round(Math.min(whole()[2], Math.max(0, x)) * 100) / 100,
      Math.round(Math.min(whole()[3], Math.max(0, y)) * 100) / 100];
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
    const mistaken = before.some((each) => !each.ask && ["wrong", "missing"].includes(each.verdict));
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

  const where = (event) => {
    const spot = new DOMPoint(event.clientX, event.clientY).matrixTransform(paper.getScreenCTM().inverse());
    return [spot.x, spot.y];
  };
  let dragged = false;
  paper.addEventListener("pointerdown", (event) => {
    dragged = true;
    put(...where(event));
    paper.setPointerCapture(event.pointerId);
  });
  paper.addEventListener("pointermove", (event) => { if (dragged) put(...where(event)); });
  paper.addEventListener("pointerup", () => { dragged = false; });
  paper.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(event.deltaY > 0 ? 1.2 : 1 / 1.2, ...where(event));
  }, { passive: false });

  const keys = {
    n: next, u: undo, k: toggle, f: flicker, "+": () => zoom(1 / 1.4), "-": () => zoom(1.4),
    0: () => look(whole()),
    1: () => decide("right"), 2: () => decide("follows"), 3: () => decide("wrong"), 4: () => decide("missing"),
    Enter: () => {
      const likely = document.querySelector('#choices button[aria-pressed="true"]');
      if (likely) decide(likely.dataset.verdict);
      else tell(point() ? said.help : "");
    },
    m: () => find("note").focus(),
    PageDown: () => turn(1), PageUp: () => turn(-1),
    ArrowLeft: (far) => nudge(-far, 0), ArrowRight: (far) => nudge(far, 0),
    ArrowUp: (far) => nudge(0, -far), ArrowDown: (far) => nudge(0, far),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.matches("input")) {
      if (event.key === "Escape" || event.key === "Enter") paper.focus();
      return;
    }
    if (event.target.matches("select, button") && event.key === "Enter") return;
    const act = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act(event.shiftKey ? 1 : 0.1);
  });
  function turn(way) {
    at = (at + way + sheets.length) % sheets.length;
    hold(null);
  }

  find("next").addEventListener("click", next);
  find("undo").addEventListener("click", undo);
  find("key").addEventListener("click", toggle);
  find("flicker").addEventListener("click", flicker);
  find("sheet").addEventListener("change", (event) => { at = event.target.selectedIndex; hold(null); });
  for (const button of document.querySelectorAll("#choices button")) {
    button.addEventListener("click", () => decide(button.dataset.verdict));
  }
  (async () => {
    try {
      sheets = await (await fetch("sheets")).json();
    } catch (error) {
      tell(said.failed);
      return;
    }
    find("sheet").replaceChildren(...sheets.map(() => document.createElement("option")));
    next();
    document.body.dataset.ready = "yes";
  })();
})();
