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
  const AIR = 3, MOST = [0.6, 3.5]; // mm about what a field is shifted or grows for; parts of the mechanism's and the plan's field beyond its edges that are shown
  const NARROW = 640; // dots of the screen below which reasons are folded
  const DEAD = Math.sin(Math.PI / 180), FAR = 1e-4; // sines of crossings below which no hand can tell where; those of far centres and poles
  const TINTS = 4; // colours that tell apart what one sentence draws for several points
  const ARROW = 12, CORNER = 2.2, NONE = 0.5; // mm of a velocity at its pin, of a right angle, of no velocity
  const UNMARKED = ".later,.void,[visibility],.arrowhead,.leader,.square-mark,.caption,.detail,[data-aside]";
  const marksBut = gone => `.lettering:not(:has(${gone})),*:not(g,text,tspan,.centre-line,${gone})`; // a group holds its shift
  const SEEN = marksBut(".later,.void,[visibility]"), PLACED = marksBut(".void,[visibility]");
  const MOVED = marksBut(".void,[visibility],.halo *,[data-aside]");
  const state = { step: 1, x: motion ? motion.start : 0, timer: 0, kept: 0, address: location.hash, follow: null, over: null, dead: false };

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

  /** A field: its picture, the group of what is marked, its box, and that of all that is drawn. */
  function field(svg) {
    const halo = svg.insertBefore(document.createElementNS(SVG, "g"), svg.firstChild);
    halo.setAttribute("class", "halo");
    const { x, y, width, height } = svg.viewBox.baseVal;
    svg.style.aspectRatio = `${width} / ${height}`; // whatever part of it is shown
    return { svg, halo, whole: [x, y, width, height], drawn: extent(svg, PLACED) };
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
      const parts = own[i + 1].some(step => data.tints[step]) ? link.querySelectorAll("[data-for]") : [];
      for (const part of parts) part.className = `tint ${tint(part.dataset.for)}`;
      return { link, say: link.querySelector(".say"), why: link.querySelector(".why"), crossings: [...link.querySelectorAll(".crossing")] };
    });
  }

  /** The class of the colour of a step. */
  function tint(step) {
    return `t${(data.tints[step] ?? 0) % TINTS}`;
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
    tell(byId("told"), state.step);
    byId("told").scrollTop = 0;
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
      const { stop: first, end } = stop.dataset;
      if (first <= state.step && state.step <= end) stop.setAttribute("aria-current", "true");
      else stop.removeAttribute("aria-current");
    }
  }

  /** Write the sentence of a step, why, and its flattest crossing. */
  function tell(told, step) {
    const { say: words, why } = places[step - 1];
    told.querySelector("#sentence").replaceChildren(...copies(words));
    told.querySelector("#reason").replaceChildren(...(why ? copies(why) : []));
    told.querySelector("#because").hidden = !why;
    warn(told, step);
  }

  /** Write the flattest crossing of a step. */
  function warn(told, step) {
    const factor = line => Number(line.querySelector(".factor").textContent.replace(data.mark, "."));
    const lines = places[step - 1].crossings;
    const worst = lines.reduce((a, b) => (a && factor(a) >= factor(b) ? a : b), null);
    told.querySelector("#crossing").replaceChildren(...(worst ? copies(worst) : []));
  }

  /** Copies of what an element holds. */
  function copies(element) {
    return [...element.cloneNode(true).childNodes];
  }

  // --- what it hangs on --------------------------------------------------------------------------

  /** Mark what some steps draw, and what that is drawn from. */
  function trace(steps) {
    const sheet = sheets[sheetAt(state.step)];
    const from = sources(steps);
    const done = state.step === data.bounds[sheets.indexOf(sheet)][1] && !state.over;
    sheet.element.classList.toggle("growing", !done);
    for (const mark of sheet.marks) {
      mark.classList.toggle("rest", !mark.classList.contains("now") && !from.has(mark.dataset.of));
    }
    halos(sheet, steps, from);
    names(byId("from"), from);
    byId("from-key").hidden = !from.size;
    look();
  }

  /** What some steps are drawn from. */
  function sources(steps) {
    const from = new Set(steps.flatMap(step => data.from[step] ?? []).map(String));
    steps.forEach(step => from.delete(step));
    return from;
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
      for (const step of steps) strokes.push(...squares(sheet, svg, data.squares[step] ?? []));
      for (const step of from) for (const mark of sheet.of.get(step) ?? []) stroke(mark, "old");
      const fresh = state.over ? steps.flatMap(step => sheet.of.get(step) ?? []) :
        sheet.marks.filter(mark => mark.classList.contains("now"));
      for (const mark of fresh) stroke(mark, `new ${tint(mark.dataset.of)}`);
      halo.replaceChildren(...strokes);
    }
  }

  /** The circle that a point is drawn as. */
  function pin(sheet, point) {
    return (sheet.of.get(String(point)) ?? []).find(mark => mark.matches("circle:not(.void)"));
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

  /** A velocity at its pin, with the right angle in which a line stands to it; in its plan a stroke. */
  function squares(sheet, svg, points) {
    const [at, pole, image] = points.map(point => pin(sheet, point));
    if (!image || !pole || !at) return [];
    if (svg.contains(pole)) return [between(pole, image)];
    const [[x, y], tail, tip] = [at, pole, image].map(circle => ["cx", "cy"].map(name => Number(circle.getAttribute(name))));
    const size = Math.hypot(tip[0] - tail[0], tip[1] - tail[1]);
    if (size < NONE) return [];
    const [u, v] = [(tip[0] - tail[0]) / size, (tip[1] - tail[1]) / size];
    const place = (along, across) => `${x + along * u - across * v},${y + along * v + across * u}`;
    const drawn = (name, points, look) => {
      const line = document.createElementNS(SVG, name);
      line.setAttribute("points", points.join(" "));
      line.setAttribute("class", look);
      return line;
    };
    return [
      drawn("polyline", [place(0, 0), place(ARROW, 0)], "aid"),
      drawn("polygon", [place(ARROW, 0), place(ARROW - 3, 0.6), place(ARROW - 3, -0.6)], "aid head"),
      drawn("polyline", [place(CORNER, 0), place(CORNER, CORNER), place(0, CORNER)], "aid"),
    ];
  }

  /** Name in a list what is drawn from, with the steps that drew it. */
  function names(list, from) {
    const told = new Map();
    for (const step of from) {
      const name = data.letters[step];
      if (name && !told.has(name)) told.set(name, data.at[step]);
    }
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
  }

  // --- what is looked at -------------------------------------------------------------------------

  /** Keep as much room for words and values as the longest of them need, so that nothing jumps. */
  function fit() {
    const told = byId("told").cloneNode(true), read = byId("read")?.cloneNode(true);
    const tallest = (part, name, cases, write) => {
      part.classList.add("measured");
      byId(name).after(part);
      const sizes = cases.map(one => (write(one), part.offsetHeight));
      part.remove();
      style(page, `--${name}`, `${Math.max(...sizes)}px`);
    };
    tallest(told, "told", places.map((_, i) => i + 1), step => {
      tell(told, step);
      names(told.querySelector("#from"), sources(own[step]));
    });
    if (read) {
      read.querySelector("#place").textContent = byId("place").dataset.dead;
      tallest(read, "read", sheets.map(sheet => sheet.element.dataset.kind), kind => {
        read.querySelector("#values").replaceChildren(...all_asked(kind));
      });
    }
    style(page, "--dock", `${dock.offsetHeight}px`);
    const box = byId("told");
    box.tabIndex = told.scrollHeight > box.clientHeight + 1 ? 0 : -1;
    look();
  }

  /** Show all that is drawn in each field, or what is marked in it so large that it can be read. */
  function look() {
    const sheet = sheets[sheetAt(state.step)];
    const sizes = sheet.fields.map(({ svg }) => [svg.clientWidth, svg.clientHeight]); // read, then written
    const near = state.follow ?? innerWidth <= NARROW;
    const done = !sheet.element.classList.contains("growing");
    follow.setAttribute("aria-pressed", near);
    const boxes = sheet.fields.map((one, i) => {
      const room = roomy(one, sizes[i], sheets.indexOf(sheet), i);
      return near ? closer(sizes[i], room, extent(done ? one.svg : one.halo, SEEN)) : room;
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
  function extent(part, marks) {
    const boxes = [...part.querySelectorAll(marks)].map(mark => mark.getBBox());
    const [left, top] = ["x", "y"].map(axis => Math.min(...boxes.map(box => box[axis])));
    const right = Math.max(...boxes.map(box => box.x + box.width));
    const bottom = Math.max(...boxes.map(box => box.y + box.height));
    return boxes.length ? [left, top, right - left, bottom - top] : null;
  }

  /** The part of a field in which all is drawn, shifted for what has moved out of it, and larger where that is not enough. */
  function roomy({ svg, whole, drawn }, picture, sheet, side) {
    const base = closer(picture, whole, drawn);
    const known = () => svg.clientWidth ? extent(svg, MOVED) : null; // without what has no place
    const found = moved() && (state.dead ? known() : motion.extent(state.x, sheet, side));
    if (!found) return base;
    const [starts, sizes] = [[], []];
    for (const axis of [0, 1]) {
      const reach = MOST[side] * whole[axis + 2];
      const low = Math.max(found[axis] - AIR, whole[axis] - reach);
      const high = Math.min(found[axis] + found[axis + 2] + AIR, whole[axis] + whole[axis + 2] + reach);
      const size = Math.max(base[axis + 2], high - low);
      starts.push(Math.min(Math.max(base[axis], high - size), low));
      sizes.push(size);
    }
    return [...starts, ...sizes];
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

  const driver = motion && byId("driver"), datum = motion && byId("datum");
  const given = [...(datum?.childNodes ?? [])];
  const notes = motion ? [...document.querySelectorAll(".sheet h2, #given-name")].map(name => {
    const one = document.createElement("small");
    one.className = "moved-note";
    name.after(one);
    return one;
  }) : [];

  /** Whether the driver has left the drawn position. */
  function moved() {
    return motion !== null && state.x !== motion.start;
  }

  /** The place of the driver that is meant by a number: an angle may be whole turns off. */
  function meant(x) {
    const { low, high, unit } = motion, off = x < low || x > high;
    const turned = off && unit === "deg" ? x - 360 * Math.round((x - (low + high) / 2) / 360) : x;
    return Math.min(Math.max(turned, low), high);
  }

  /** Set the driver, and with it all that follows. */
  function drive(x) {
    const whole = meant(x);
    const there = Math.abs(whole - motion.start) < 1e-6 * motion.step;
    state.x = Number.isFinite(whole) && !there ? whole : motion.start;
    driver.value = state.x;
    const shown = place_of(state.x);
    byId("driven").textContent = shown;
    driver.setAttribute("aria-valuetext", shown);
    const { ok } = motion.set(state.x, byId);
    page.classList.toggle("moved", moved());
    byId("back").disabled = !moved();
    note(shown);
    const sines = Object.entries(ok ? motion.margins(state.x) : {}).map(([step, sine]) => [Number(step), sine]);
    const flat = sines.filter(([step, sine]) => sine < (data.aside.includes(step) ? FAR : DEAD)).map(([step]) => step);
    const dead = flat.some(step => !data.aside.includes(step));
    state.dead = !ok || dead;
    clear_off(step => !ok || flat.some(crossing => data.hangs[step].includes(crossing)));
    byId("place").textContent = !ok ? byId("place").dataset.open : dead ? byId("place").dataset.dead : "";
    if (ok && !dead) read();
    page.classList.toggle("silent", !ok || dead);
    warn(byId("told"), state.step);
    trace(state.over ? [state.over] : own[state.step]);
    remember();
  }

  /** A place of the driver in words. */
  function place_of(x) {
    return written(x, 1) + byId("driven").dataset.unit;
  }

  /** Take what hangs on lines that do not cross off the drawings. */
  function clear_off(hangs) {
    for (const { of } of sheets) {
      for (const [step, marks] of of) {
        const gone = step in data.hangs && hangs(step);
        for (const mark of marks) mark.classList.toggle("void", gone);
      }
    }
  }

  /** Say beside drawings and data where the driver now is, and what they were given and checked for. */
  function note(shown) {
    const { name, moved: words } = byId("read").dataset, start = `${name} = ${place_of(motion.start)}`;
    const here = `${name} = ${shown}`; // markup of a symbol, escaped where it was made
    for (const one of notes) {
      one.innerHTML = words.replace("{place}", here).replace("{start}", start);
      one.hidden = !moved();
    }
    if (datum && moved()) datum.innerHTML = here;
    else datum?.replaceChildren(...given);
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
    byId("values").replaceChildren(...all_asked(sheets[sheetAt(state.step)].element.dataset.kind));
  }

  /** All that is asked on a sheet, each in one line. */
  function all_asked(kind) {
    const rows = document.querySelectorAll(`[data-kind=${kind}] [data-asked]`);
    return [...rows].map(row => asked([...row.cells]));
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
  const zoom = () => {
    state.follow = follow.getAttribute("aria-pressed") !== "true";
    look();
  };

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
      z: zoom,
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
  follow.addEventListener("click", zoom);
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
  addEventListener("resize", fit);
  byId("because").open = innerWidth > NARROW;
  byId("because").addEventListener("toggle", fit);
  const print = () => sheets.forEach(({ fields }, s) => fields.forEach((one, i) => {
    const box = roomy(one, one.whole.slice(2), s, i);
    one.svg.setAttribute("viewBox", box.map(number => number.toFixed(2)).join(" "));
  }));
  addEventListener("beforeprint", print);
  addEventListener("afterprint", look);
  follow_address();
  fit();
})();
