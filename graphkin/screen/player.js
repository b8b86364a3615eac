// The page of a cycle: plays the motion, moves it by hand, and tells what is asked at each place.
(() => {
  "use strict";
  const motion = graphkinMotion;
  const data = JSON.parse(document.getElementById("run").textContent);
  const TURN = 5, WAY = 3.5; // seconds of a whole turn or a time, and of a way from end to end
  const span = data.high - data.low;
  const found = new Map();
  const byId = (id) => {
    if (!found.has(id)) found.set(id, document.getElementById(id));
    return found.get(id);
  };
  const play = byId("play"), slider = byId("at"), speed = byId("speed"), back = byId("back");
  const rows = [...document.querySelectorAll("[data-row]")];
  const state = { x: data.start, sense: 1, playing: false, last: 0 };

  // A number as the page's language writes it.
  const written = (text) => text.replace("-", "−").replace(".", data.mark);

  function significant(number) {
    if (number === 0) return "0";
    const [mantissa, power] = number.toExponential(3).split("e");
    if (power >= -4 && power < 6) {
      return written(Number(number.toExponential(3)).toFixed(Math.max(3 - power, 0)));
    }
    const signs = [...String(Number(power))].map((s) => (s === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[s]));
    return `${written(mantissa)}·10${signs.join("")}`;
  }

  // Set each letter beside its point, off from others, on another side where a letter stands.
  function letter(letters) {
    const [aside, near] = data.aside, taken = [];
    const place = (id) => ["cx", "cy"].map((name) => Number(byId(id).getAttribute(name)));
    for (const [id, point, x, y, width, others] of letters) {
      const text = byId(id), here = place(point);
      if (byId(point).getAttribute("visibility")) {
        text.setAttribute("visibility", "hidden");
        continue;
      }
      let [u, v] = [0, 0];
      for (const other of others.map(place)) {
        const far = Math.hypot(here[0] - other[0], here[1] - other[1]);
        if (far > 1) [u, v] = [u + (here[0] - other[0]) / far, v + (here[1] - other[1]) / far];
      }
      const size = Math.hypot(u, v);
      [u, v] = size > 0.1 ? [u / size, v / size] : [-0.8, -0.6];
      const ways = [[u, v], [-v, u], [v, -u], [-u, -v]];
      const spots = ways.map(([a, b]) => [here[0] + a * (aside + width / 4), here[1] + b * aside]);
      const free = spots.find((s) => taken.every((t) => Math.hypot(s[0] - t[0], s[1] - t[1]) > near));
      if (!free) {
        text.setAttribute("visibility", "hidden");
        continue;
      }
      taken.push(free);
      text.removeAttribute("visibility");
      text.setAttribute("transform", `translate(${(free[0] - x).toFixed(3)} ${(free[1] - y).toFixed(3)})`);
    }
  }

  // Put the mechanism and its plans where the driver stands.
  function show(x) {
    state.x = Math.min(Math.max(x, data.low), data.high);
    const { ok } = motion.set(state.x, byId);
    if (ok) data.letters.forEach(letter);
    const told = written(state.x.toFixed(span > 50 ? 1 : span > 5 ? 2 : 3)) + data.unit;
    slider.value = state.x;
    slider.setAttribute("aria-valuetext", told);
    byId("told").textContent = told;
    const values = ok ? motion.values(state.x) : {};
    for (const row of rows) {
      const value = values[row.dataset.row];
      row.hidden = value === undefined;
      if (value !== undefined) row.querySelector("span").textContent = significant(value);
    }
  }

  // Go on by some seconds: round, from end to end, or to and fro.
  function go(seconds) {
    const way = (seconds * span * Number(speed.value)) / (data.whole || data.once ? TURN : WAY);
    let x = state.x + state.sense * way;
    if (data.whole || data.once) {
      x = data.low + ((x - data.low) % span);
    } else if (x > data.high || x < data.low) {
      state.sense = x > data.high ? -1 : 1;
      x = 2 * (x > data.high ? data.high : data.low) - x;
    }
    show(x);
  }

  function frame(now) {
    if (!state.playing) return;
    go(Math.min(now - state.last, 100) / 1000);
    state.last = now;
    requestAnimationFrame(frame);
  }

  function start() {
    state.playing = true;
    state.last = performance.now();
    named("pause");
    requestAnimationFrame(frame);
  }

  function pause() {
    state.playing = false;
    named("play");
  }

  // Say what the button does.
  function named(what) {
    play.toggleAttribute("data-on", what === "pause");
    play.setAttribute("aria-label", play.dataset[what]);
    play.title = play.dataset[what];
  }

  const toggle = () => (state.playing ? pause() : start());
  const rest = (x) => {
    pause();
    show(x);
  };

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const at = event.target;
    const step = span / 100;
    const act = {
      " ": at.matches("button,select") ? null : toggle,
      ArrowLeft: at.matches("input,select") ? null : () => rest(state.x - step),
      ArrowRight: at.matches("input,select") ? null : () => rest(state.x + step),
      Home: at.matches("input,select") ? null : () => rest(data.start),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  slider.min = data.low;
  slider.max = data.high;
  slider.step = span / 720;
  slider.addEventListener("input", () => rest(Number(slider.value)));
  play.addEventListener("click", toggle);
  back.addEventListener("click", () => rest(data.start));
  for (const id of ["bar", "values", "help"]) byId(id).hidden = false;
  show(data.start);
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) start();
})();
