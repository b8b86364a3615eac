// How a reader looks at a field: closer and farther by the wheel, by two fingers and by keys, aside by
// dragging what is no pin; clicked twice it is as before.
const NEAREST = 10, FARTHEST = 0.6; // times as large as the page shows it
const NOTCH = 1.25, LINES = 18, WHEEL = 320; // times by a key, dots of a line, dots of a wheel that double
const SLACK = 4; // dots that a finger or a mouse may slip in a click

/** The place of a field's paper, in mm, that is shown at a place of the window. */
function paper_at({ svg }, across, down) {
  const { x, y } = new DOMPoint(across, down).matrixTransform(svg.getScreenCTM().inverse());
  return [x, y];
}

/** The box of a field that a view of it shows in a picture. */
function viewed({ middle, scale }, [across, high]) {
  const [width, height] = [across / scale, high / scale];
  return [middle[0] - width / 2, middle[1] - height / 2, width, height];
}

/** What is looked at now. */
function view_of(one) {
  const size = [one.svg.clientWidth, one.svg.clientHeight], [x, y, width, height] = one.box, scale = dots(size, one.box);
  one.least_scale ??= scale * FARTHEST;
  one.most_scale ??= scale * NEAREST;
  return { middle: [x + width / 2, y + height / 2], scale };
}

/** Look closer by so many times, a place of the paper staying where it is. */
function closer_by(one, times, [u, v]) {
  const { middle, scale } = view_of(one);
  const next = Math.min(Math.max(scale * times, one.least_scale), one.most_scale), part = scale / next;
  see(one, { scale: next, middle: [u + (middle[0] - u) * part, v + (middle[1] - v) * part] });
}

/** Look at a place so; as the page shows it where there is none. */
function see(one, view) {
  one.view = view;
  one.svg.classList.toggle("held", view !== null);
  if (!view) one.least_scale = one.most_scale = undefined;
  next_frame(look_again);
}

let glides_back = false;

/** Look as the page shows it. */
function see_all(one) {
  glides_back = true;
  see(one, null);
}

function look_again() {
  look(glides_back);
  glides_back = false;
}

const waiting = new Set();
let dragged = false;

/** Do something once before the window is painted next. */
function next_frame(work) {
  if (waiting.has(work)) return;
  waiting.add(work);
  requestAnimationFrame(() => {
    waiting.delete(work);
    work();
  });
}

/** Follow the pointer that is down on an element until it is let go. */
function while_down(element, went, gone) {
  const held = new AbortController(), { signal } = held;
  element.addEventListener("pointermove", went, { signal });
  for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, () => (held.abort(), gone?.()), { signal });
}

/** The middle of some pointers in the window, and how far apart they are. */
function span(pointers) {
  const [p, q = p] = [...pointers.values()];
  return [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, Math.hypot(p[0] - q[0], p[1] - q[1])];
}

/** Let a field be looked at so. */
function lookable(one) {
  const { svg } = one, pointers = new Map();
  let held = null; // where the pointers were last, once they have moved
  let begun = null;
  const stop = event => {
    pointers.delete(event.pointerId);
    begun = held = null;
    if (!pointers.size) svg.classList.remove("panning");
  };
  svg.addEventListener("wheel", event => {
    const times = 2 ** (-event.deltaY * (event.deltaMode ? LINES : 1) / WHEEL);
    if (times < 1 && !one.view && !event.ctrlKey) return; // the page goes on
    event.preventDefault();
    closer_by(one, times, paper_at(one, event.clientX, event.clientY));
  }, { passive: false });
  svg.addEventListener("pointerdown", event => {
    if (event.button || event.target.closest(".grip")) return;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    begun = span(pointers);
    held = pointers.size > 1 ? begun : null;
    dragged = false;
  });
  svg.addEventListener("pointermove", event => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    const now = span(pointers), touch = event.pointerType === "touch";
    if (!held) {
      if (touch && !one.view || Math.hypot(now[0] - begun[0], now[1] - begun[1]) < SLACK) return;
      held = begun;
      svg.classList.add("panning");
      svg.setPointerCapture(event.pointerId);
    }
    dragged = true;
    const before = paper_at(one, held[0], held[1]), after = paper_at(one, now[0], now[1]), { middle, scale } = view_of(one);
    see(one, { scale, middle: [middle[0] + before[0] - after[0], middle[1] + before[1] - after[1]] });
    if (held[2] > 1 && now[2] > 1) {
      framed(one, viewed(one.view, [svg.clientWidth, svg.clientHeight]));
      closer_by(one, now[2] / held[2], paper_at(one, now[0], now[1]));
    }
    framed(one, viewed(one.view, [svg.clientWidth, svg.clientHeight]));
    held = now;
  });
  for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, stop);
  for (const name of ["touchstart", "touchmove"]) {
    svg.addEventListener(name, event => event.touches.length > 1 && event.preventDefault(), { passive: false });
  }
  svg.addEventListener("dblclick", event => {
    event.preventDefault();
    see_all(one);
  });
  svg.addEventListener("keydown", event => {
    const act = {
      "+": () => closer_by(one, NOTCH, view_of(one).middle),
      "=": () => closer_by(one, NOTCH, view_of(one).middle),
      "-": () => closer_by(one, 1 / NOTCH, view_of(one).middle),
      "0": () => see_all(one),
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  });
}

/** What ends a drag is no click. */
addEventListener("click", event => {
  if (dragged) event.stopPropagation();
  dragged = false;
}, true);
sheets.forEach(({ fields }) => fields.forEach(lookable));
