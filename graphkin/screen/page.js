"use strict";
(() => {
  const page = document.documentElement;
  const byId = id => document.getElementById(id);
  const data = JSON.parse(byId("run").textContent);
  const motion = typeof graphkinMotion === "undefined" ? null : graphkinMotion;
  const last = data.bounds.at(-1)[1];
  const SVG = "http://www.w3.org/2000/svg";
  const READABLE = 3.2; // dots to the millimetre at which lettering of 2.5 mm can be read
  const EDGE = 7, LEAST = 60; // mm about what is looked at, and its least width
  const MOST = 1.6; // times that a field grows for what leaves it
  const NARROW = 640; // dots of the screen below which reasons are folded
  const DEAD = 1e-4; // sine of a crossing below which nothing is drawn fairly
  const SMALL = 2.4; // and below which larger letters would not do
  const UNMARKED = ".later,[visibility],.arrowhead,.leader,.square-mark,.caption,.detail,[data-aside]";
  const SEEN = ".lettering:not(:has(.later,[visibility])),*:not(g,text,tspan,.later,[visibility],.centre-line)"; // a group holds its shift
  const state = { step: 1, x: motion ? motion.start : 0, timer: 0, kept: 0, address: location.hash, follow: null, over: null };

  page.classList.add("js");
  motion?.set(motion.start, byId); // what moves may add marks
  byId("desk").append(byId("controls").content.cloneNode(true));
  const [dock, slider, play, follow] = ["dock", "step", "play", "follow"].map(byId);
  const sheets = [...document.querySelectorAll(".sheet")].map(element => {
    const marks = [...element.querySelectorAll("svg [data-at]")];
    const of = new Map();
    for (const mark of marks) {
      const step = mark.dataset.of;
      if (step) of.set(step, [...(of.get(step) ?? []), mark]);
    }
    return { element, marks, of, fields: [...element.querySelectorAll(".view svg")].map(field) };
  });
  const own = Array.from({ length: last + 1 }, () => []); // the steps that each sentence draws
  for (const [step, at] of Object.entries(data.at)) own[at].push(step);
  const places = sentences();

  /** A field: its picture, the box that it shows whole, and the group of what is marked. */
  function field(svg) {
    const halo = svg.insertBefore(document.createElementNS(SVG, "g"), svg.firstChild);
    halo.setAttribute("class", "halo");
    const { x, y, width, height } = svg.viewBox.baseVal;
    return { svg, halo, whole: [x, y, width, height] };
  }

  /** Make each sentence of the list a link to its step. */
  function sentences() {
    return [...document.querySelectorAll("#steps li")].map((item, i) => {
      const link = document.createElement("a");
      link.href = `#step=${i + 1}`;
      link.dataset.number = i + 1;
      link.append(...item.childNodes);
      item.append(link);
      link.addEventListener("click", event => {
        event.preventDefault();
        pause();
        show(i + 1);
      });
      return { link, say: link.querySelector(".say"), why: link.querySelector(".why"), crossings: [...link.querySelectorAll(".crossing")] };
    });
  }

  // --- a step ------------------------------------------------------------------------------------

  /** Show the drawing as it stands at a step. */
  function show(step) {
    state.step = Math.min(Math.max(Math.round(step) || 1, 1), last);
    state.over = null;
    const here = sheetAt(state.step);
    sheets.forEach((sheet, i) => { sheet.element.hidden = i !== here; });
    for (const mark of sheets[here].marks) {
      const at = Number(mark.dataset.at);
      mark.classList.toggle("later", at > state.step);
      mark.classList.toggle("now", at === state.step);
    }
    slider.value = state.step;
    byId("previous").disabled = state.step === 1;
    byId("next").disabled = state.step === last;
    say();
    if (motion) read_out();
    trace(own[state.step]);
    remember();
  }

  /** The sheet on which a step is drawn. */
  function sheetAt(step) {
    return data.bounds.findIndex(([, end]) => step <= end);
  }

  /** Say the sentence of the step, and mark it in the list. */
  function say() {
    const count = data.count.replace("{number}", state.step).replace("{all}", last);
    byId("count").textContent = count;
    slider.setAttribute("aria-valuetext", count);
    byId("sentence").replaceChildren(...copies(places[state.step - 1].say));
    const { why } = places[state.step - 1];
    byId("reason").replaceChildren(...(why ? copies(why) : []));
    byId("because").hidden = !why;
    places.forEach(({ link }, i) => {
      if (i + 1 === state.step) link.setAttribute("aria-current", "step");
      else link.removeAttribute("aria-current");
    });
    const list = byId("steps");
    if (list.scrollHeight > list.clientHeight + 4) {
      const { offsetTop, offsetHeight } = places[state.step - 1].link;
      list.scrollTop = offsetTop - list.offsetTop - (list.clientHeight - offsetHeight) / 2;
    }
    for (const stop of document.querySelectorAll("#stops button")) {
      if (Number(stop.dataset.stop) === state.step) stop.setAttribute("aria-current", "step");
      else stop.removeAttribute("aria-current");
    }
    warn();
  }

  /** The flattest crossing of the step. */
  function warn() {
    const factor = line => Number(line.querySelector(".factor").textContent.replace(data.mark, "."));
    const lines = places[state.step - 1].crossings;
    const worst = lines.reduce((a, b) => (a && factor(a) >= factor(b) ? a : b), null);
    byId("crossing").replaceChildren(...(worst ? copies(worst) : []));
  }

  /** Copies of what an element holds. */
  function copies(element) {
    return [...element.cloneNode(true).childNodes];
  }

  // --- what it hangs on --------------------------------------------------------------------------

  /** Mark what some steps draw, and what that is drawn from. */
  function trace(steps) {
    const sheet = sheets[sheetAt(state.step)];
    const from = new Set(steps.flatMap(step => data.from[step] ?? []).map(String));
    steps.forEach(step => from.delete(step));
    const done = state.step === data.bounds[sheets.indexOf(sheet)][1] && !state.over;
    sheet.element.classList.toggle("growing", !done);
    for (const mark of sheet.marks) {
      mark.classList.toggle("rest", !mark.classList.contains("now") && !from.has(mark.dataset.of));
    }
    halos(sheet, steps, from);
    names(steps, from);
    look();
  }

  /** Draw the marker pen's strokes beneath the marks. */
  function halos(sheet, steps, from) {
    for (const { svg, halo } of sheet.fields) {
      const strokes = [];
      const stroke = (mark, look) => {
        if (!svg.contains(mark) || mark.matches(UNMARKED)) return;
        const copy = mark.cloneNode(true), shell = mark.closest(".lettering")?.cloneNode();
        for (const name of ["id", "data-at", "data-of"]) copy.removeAttribute(name);
        copy.setAttribute("class", look);
        shell?.append(copy);
        strokes.push(shell ?? copy);
      };
      for (const step of steps) {
        const ends = (data.sides[step] ?? []).map(point => pin(sheet, point));
        if (ends.length === 2 && ends.every(Boolean) && svg.contains(ends[0])) {
          strokes.push(between(...ends));
        }
      }
      for (const step of from) for (const mark of sheet.of.get(step) ?? []) stroke(mark, "old");
      const fresh = state.over ? steps.flatMap(step => sheet.of.get(step) ?? []) :
        sheet.marks.filter(mark => mark.classList.contains("now"));
      for (const mark of fresh) stroke(mark, "new");
      halo.replaceChildren(...strokes);
    }
  }

  /** The circle that a point is drawn as. */
  function pin(sheet, point) {
    return (sheet.of.get(String(point)) ?? []).find(mark => mark.tagName === "circle");
  }

  /** A stroke from one pin to another. */
  function between(p, q) {
    const line = document.createElementNS(SVG, "line");
    line.setAttribute("class", "side");
    for (const [end, mark] of [["1", p], ["2", q]]) {
      for (const axis of ["x", "y"]) line.setAttribute(axis + end, mark.getAttribute("c" + axis));
    }
    return line;
  }

  /** Name what the step is drawn from, with the steps that drew it. */
  function names(steps, from) {
    const told = new Map();
    for (const step of from) {
      const name = data.letters[step];
      if (name && !told.has(name)) told.set(name, data.at[step]);
    }
    const list = byId("from");
    list.replaceChildren();
    for (const [name, at] of [...told].sort((a, b) => a[1] - b[1])) {
      if (list.childNodes.length) list.append(", ");
      const part = document.createElement(at ? "a" : "span");
      part.innerHTML = name; // markup of a symbol, escaped where it was made
      if (at) {
        part.href = `#step=${at}`;
        part.append(` (${at})`);
      }
      list.append(part);
    }
    byId("from-key").hidden = !told.size;
  }

  // --- what is looked at -------------------------------------------------------------------------

  /** Show each field whole, or what is marked in it so large that its lettering can be read. */
  function look() {
    style(page, "--dock", `${dock.offsetHeight}px`);
    const words = byId("say");
    words.tabIndex = words.scrollHeight > words.clientHeight + 1 ? 0 : -1;
    const sheet = sheets[sheetAt(state.step)];
    const sizes = sheet.fields.map(({ svg }) => [svg.clientWidth, svg.clientHeight]); // read, then written
    const small = sheet.fields.some(({ whole }, i) => dots(sizes[i], whole) < SMALL);
    const near = state.follow ?? small;
    const done = !sheet.element.classList.contains("growing");
    follow.setAttribute("aria-pressed", near);
    const boxes = sheet.fields.map((one, i) => {
      const room = roomy(one);
      return near ? closer(sizes[i], room, extent(done ? one.svg : one.halo)) : room;
    });
    sheet.fields.forEach(({ svg }, i) => {
      svg.setAttribute("viewBox", boxes[i].map(number => number.toFixed(2)).join(" "));
      const times = Math.min(READABLE / dots(sizes[i], boxes[i]), near ? 2 : 1.3);
      svg.classList.toggle("larger", times > 1.02);
      style(svg, "--t", times.toFixed(2));
    });
  }

  /** Set a property of style where it is not so yet: all that it touches is laid out anew. */
  function style(element, name, value) {
    if (element.style.getPropertyValue(name) !== value) element.style.setProperty(name, value);
  }

  /** Dots of the screen to a millimetre of a box in a picture of a size. */
  function dots([across, high], [, , width, height]) {
    return Math.min(across / width, high / height) || READABLE;
  }

  /** The box of what is drawn in a picture or a part of it. */
  function extent(part) {
    const boxes = [...part.querySelectorAll(SEEN)].map(mark => mark.getBBox());
    const [left, top] = ["x", "y"].map(axis => Math.min(...boxes.map(box => box[axis])));
    const right = Math.max(...boxes.map(box => box.x + box.width));
    const bottom = Math.max(...boxes.map(box => box.y + box.height));
    return boxes.length ? [left, top, right - left, bottom - top] : null;
  }

  /** A field, larger where what has moved leaves it. */
  function roomy({ svg, whole }) {
    const found = state.x !== (motion?.start ?? 0) && extent(svg);
    if (!found) return whole;
    const [lows, highs] = [[], []];
    for (const axis of [0, 1]) {
      const [low, size] = [whole[axis], whole[axis + 2]], most = (MOST - 1) * size;
      lows.push(Math.max(Math.min(low, found[axis] - EDGE), low - most));
      highs.push(Math.min(Math.max(low + size, found[axis] + found[axis + 2] + EDGE), low + size + most));
    }
    return [...lows, highs[0] - lows[0], highs[1] - lows[1]];
  }

  /** The part of a field about a box, in the shape of its picture and not beyond the field. */
  function closer([across, high], whole, found) {
    if (!found) return whole;
    const shape = across / high;
    const needed = Math.max(found[2] + 2 * EDGE, LEAST, (found[3] + 2 * EDGE) * shape);
    const width = Math.min(needed, Math.max(whole[2], whole[3] * shape));
    const size = [width, width / shape];
    const starts = [0, 1].map(axis => {
      const spare = whole[axis + 2] - size[axis];
      const centred = found[axis] + (found[axis + 2] - size[axis]) / 2;
      if (spare <= 0) return whole[axis] + spare / 2;
      return Math.min(Math.max(centred, whole[axis]), whole[axis] + spare);
    });
    return [...starts, ...size];
  }

  // --- the driver --------------------------------------------------------------------------------

  const driver = motion && byId("driver");

  /** Set the driver, and with it all that follows. */
  function drive(x) {
    const whole = Math.min(Math.max(x, motion.low), motion.high);
    const there = Math.abs(whole - motion.start) < 1e-6 * motion.step;
    state.x = Number.isFinite(whole) && !there ? whole : motion.start;
    driver.value = state.x;
    const shown = written(state.x, 1) + byId("driven").dataset.unit;
    byId("driven").textContent = shown;
    driver.setAttribute("aria-valuetext", shown);
    const { ok } = motion.set(state.x, byId);
    const moved = state.x !== motion.start;
    page.classList.toggle("moved", moved);
    byId("back").disabled = !moved;
    const sines = ok ? Object.values(motion.margins(state.x)) : [];
    const dead = Math.min(...sines, 1) < DEAD;
    byId("place").textContent = !ok ? byId("place").dataset.open : dead ? byId("place").dataset.dead : "";
    if (ok && !dead) read();
    page.classList.toggle("silent", !ok || dead);
    warn();
    trace(state.over ? [state.over] : own[state.step]);
    remember();
  }

  /** A number with so many places after the mark, as the page's language writes it. */
  function written(number, places) {
    const text = (Number(number.toFixed(places)) + 0).toFixed(places);
    return text.replace("-", "−").replace(".", data.mark);
  }

  /** A number rounded to so many significant digits, by powers of ten when far from one. */
  function significant(number, digits = 4) {
    if (number === 0) return "0";
    const [mantissa, power] = number.toExponential(digits - 1).split("e");
    if (power >= -4 && power < 6) return written(Number(number.toExponential(digits - 1)), Math.max(digits - 1 - power, 0));
    const signs = [...String(Number(power))].map(sign => sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign]);
    return `${mantissa.replace("-", "−").replace(".", data.mark)}·10${signs.join("")}`;
  }

  /** Write the values and margins of this position into tables and sentences. */
  function read() {
    const values = motion.values(state.x), margins = motion.margins(state.x);
    for (const table of document.querySelectorAll("#results table")) {
      const rows = [...table.querySelectorAll("[data-row]")].filter(row => row.dataset.row in values);
      const sizes = rows.map(row => Math.abs(values[row.dataset.row]));
      const noise = 1e-9 * Math.max(...sizes);
      rows.forEach((row, i) => {
        const value = sizes[i] > noise ? values[row.dataset.row] : 0;
        TOLD[table.className](row, [...row.querySelectorAll("td")], value);
      });
    }
    for (const line of document.querySelectorAll("#steps .crossing")) {
      const sine = margins[line.dataset.of];
      if (sine === undefined) continue;
      const angle = Math.asin(Math.min(Math.max(sine, 0), 1));
      line.querySelector(".angle").textContent = written(angle * 180 / Math.PI, 0);
      line.querySelector(".factor").textContent = angle ? significant(1 / Math.sin(angle / 2), 2) : "∞";
    }
    read_out();
  }

  /** Tell in the line below the slider what the sheet in sight asks for. */
  function read_out() {
    const kind = sheets[sheetAt(state.step)].element.dataset.kind;
    const rows = document.querySelectorAll(`[data-kind=${kind}] [data-asked]`);
    byId("values").replaceChildren(...[...rows].map(row => asked([...row.cells])));
  }

  /** How each kind of table tells a value. */
  const TOLD = {
    vectors(row, [, length, size], value) {
      const kind = row.closest("[data-kind]").dataset.kind;
      length.textContent = written(Math.abs(value) / data.scales[kind], 2);
      size.textContent = significant(Math.abs(value));
    },
    turns(row, [size, sense], value) {
      size.textContent = significant(Math.abs(value));
      sense.textContent = value ? data.sense[value > 0 ? 0 : 1] : "";
    },
    slides(row, [size, sense], value) {
      size.textContent = significant(Math.abs(value));
      sense.innerHTML = value ? data.slides[row.dataset.row][value > 0 ? 0 : 1] : "";
    },
  };

  /** A value that is asked, in one line: its name, its size and unit. */
  function asked(cells) {
    const table = cells[0].closest("table");
    const place = { vectors: 3, turns: 1, slides: 1 }[table.className];
    const value = document.createElement("span");
    value.append(...copies(cells[0]), " = ", ...copies(cells[place]), " ");
    value.append(...copies(table.tHead.rows[0].cells[place]));
    if (place === 1 && cells[2].textContent) value.append(", ", ...copies(cells[2]));
    return value;
  }

  // --- keys, buttons, address --------------------------------------------------------------------

  /** Keep the step, and the driver's place, in the address, once nothing has moved for a moment. */
  function remember() {
    clearTimeout(state.kept);
    state.kept = setTimeout(keep, 120);
  }

  function keep() {
    if (location.hash !== state.address) return; // it leads elsewhere meanwhile
    const moved = motion && state.x !== motion.start ? `&x=${Number(state.x.toFixed(4))}` : "";
    try {
      history.replaceState(null, "", `#step=${state.step}${moved}`);
    } catch { /* a page shown inside another may not */ }
    state.address = location.hash;
  }

  /** Go where the address says. */
  function follow_address() {
    state.address = location.hash;
    const said = new URLSearchParams(state.address.slice(1));
    const x = Number.parseFloat(said.get("x"));
    const step = Number.parseInt(said.get("step"), 10) || 1;
    if (motion) drive(Number.isFinite(x) ? x : motion.start);
    show(step);
  }

  /** Say what the button does. */
  function named(words) {
    play.title = words;
    play.setAttribute("aria-label", words);
  }

  function pause() {
    clearTimeout(state.timer);
    state.timer = 0;
    play.removeAttribute("data-on");
    named(play.dataset.play);
  }

  function start() {
    play.setAttribute("data-on", "");
    named(play.dataset.pause);
    if (state.step === last) show(1);
    wait();
  }

  /** Stay at a step as long as its sentence takes to read. */
  function wait() {
    const letters = byId("sentence").textContent.length;
    state.timer = setTimeout(() => {
      show(state.step + 1);
      if (state.step === last) pause();
      else wait();
    }, Math.min(1500 + 45 * letters, 12000));
  }

  const toggle = () => (state.timer ? pause() : start());
  const go = step => { pause(); show(step); };

  function key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const at = event.target;
    if (at.matches("input:not([type=range]),select,textarea")) return;
    const range = at.matches("input[type=range]"), pressed = at.matches("button,a,summary");
    const stop = data.stops[Number(event.key) - 1];
    const act = {
      ArrowLeft: range ? null : () => go(state.step - 1),
      ArrowRight: range ? null : () => go(state.step + 1),
      Home: range ? null : () => go(1),
      End: range ? null : () => go(last),
      " ": pressed ? null : toggle,
    }[event.key] ?? (stop ? () => go(stop) : null);
    if (!act) return;
    event.preventDefault();
    act();
  }

  document.addEventListener("keydown", key);
  slider.addEventListener("input", () => go(Number(slider.value)));
  byId("previous").addEventListener("click", () => go(state.step - 1));
  byId("next").addEventListener("click", () => go(state.step + 1));
  play.addEventListener("click", toggle);
  follow.addEventListener("click", () => {
    state.follow = follow.getAttribute("aria-pressed") !== "true";
    look();
  });
  for (const stop of document.querySelectorAll("#stops button")) {
    stop.addEventListener("click", () => go(Number(stop.dataset.stop)));
  }
  for (const sheet of sheets) {
    const step = event => event.target.closest("[data-of]")?.dataset.of;
    sheet.element.addEventListener("click", event => {
      const at = data.at[step(event)];
      if (at) go(at);
    });
    sheet.element.addEventListener("pointerover", event => {
      const over = event.pointerType === "mouse" && step(event);
      if (!over || state.over === over) return;
      state.over = over;
      trace([over]);
    });
    sheet.element.addEventListener("pointerout", event => {
      if (!state.over || event.relatedTarget?.closest?.("[data-of]")) return;
      state.over = null;
      trace(own[state.step]);
    });
  }
  if (motion) {
    const { low, high, start, step } = motion;
    const min = start - Math.floor((start - low) / step) * step; // so that one stop is where it starts
    for (const [name, value] of Object.entries({ min, max: high, step })) driver.setAttribute(name, value);
    driver.addEventListener("input", () => drive(Number(driver.value)));
    byId("back").addEventListener("click", () => drive(motion.start));
  }
  addEventListener("hashchange", follow_address);
  addEventListener("resize", look);
  byId("because").open = innerWidth > NARROW;
  byId("because").addEventListener("toggle", look);
  const whole = () => {
    for (const sheet of sheets) for (const { svg, whole: box } of sheet.fields) svg.setAttribute("viewBox", box.join(" "));
  };
  addEventListener("beforeprint", whole);
  addEventListener("afterprint", look);
  follow_address();
})();
