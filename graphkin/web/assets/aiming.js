// Pointing at marks by mouse, finger or the keys ↑ ↓: a line is half a dot wide, a finger is not.
import { byId, data, state } from "./page.js";
import { sheets } from "./sheets.js";
import { go } from "./stepping.js";
import { trace } from "./tracing.js";
import { turn } from "./turn_state.js";
import { next_frame } from "./view.js";

const REACH = 10; // distance in dots within which a mark is meant

/** The step of the mark meant by a place on the screen; null where none is near. */
function aimed(event) {
  if (event.target.closest(".grip")) return null;
  const direct = event.target.closest("[data-of]");
  if (direct) return direct.dataset.of;
  const svg = event.target.closest(".view > svg"),
    place = svg?.getScreenCTM();
  if (!place) return null;
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(place.inverse());
  let [found, least] = [null, REACH / place.a];
  for (const mark of svg.querySelectorAll("line[data-of],circle[data-of]")) {
    if (mark.matches(".later,.void,.leader,[visibility]") || !data.at[mark.dataset.of]) continue;
    const far = away(mark, x, y);
    if (far < least) [found, least] = [mark.dataset.of, far];
  }
  return found;
}

/** The distance of a place from a line or from the middle of a circle. */
function away(mark, x, y) {
  const [x1, y1] = (mark.matches("line") ? ["x1", "y1"] : ["cx", "cy"]).map(name =>
    Number(mark.getAttribute(name)),
  );
  if (!mark.matches("line")) return Math.hypot(x - x1, y - y1);
  const [u, v] = ["x2", "y2"].map((name, i) => Number(mark.getAttribute(name)) - [x1, y1][i]);
  const part = Math.min(Math.max(((x - x1) * u + (y - y1) * v) / (u * u + v * v || 1), 0), 1);
  return Math.hypot(x - x1 - part * u, y - y1 - part * v);
}

/** The steps that have marks in a field, in the order of the sentences. */
function steps_in(svg) {
  const seen = [...svg.querySelectorAll("[data-of]:not(.later,.void,[visibility])")].map(
    mark => mark.dataset.of,
  );
  return [...new Set(seen)]
    .filter(step => data.at[step])
    .sort((p, q) => data.at[p] - data.at[q] || p - q);
}

/** Point at the next step of a field, or at the previous one. */
function point_on(svg, by) {
  const steps = steps_in(svg),
    now = steps.indexOf(String(state.over));
  if (!steps.length) return;
  const step =
    steps[now < 0 ? (by > 0 ? 0 : steps.length - 1) : (now + by + steps.length) % steps.length];
  point_at(step);
  byId("pointed").innerHTML = `${data.letters[step] ?? ""} (${data.at[step]})`; // markup of a symbol, escaped by its maker
}

/** Make the marks of a field reachable by pointer and keys. */
function reachable(one) {
  const { svg } = one;
  svg.setAttribute("tabindex", "0");
  if (svg.getAttribute("role") === "img") svg.setAttribute("role", "group"); // the picture takes keys
  let latest = null;
  const over = () => {
    if (!latest || svg.matches(".panning") || state.going) return;
    const step = aimed(latest);
    svg.classList.toggle("aimed", Boolean(data.at[step]));
    point_at(step);
  };
  svg.addEventListener("pointermove", event => {
    if (event.pointerType !== "mouse" || event.buttons) return;
    latest = event;
    next_frame(over);
  });
  svg.addEventListener("pointerleave", () => {
    latest = null;
    point_at(null);
  });
  svg.addEventListener("click", event => {
    const at = data.at[aimed(event)];
    if (at) go(at);
  });
  svg.addEventListener("blur", () => point_at(null));
  svg.addEventListener("keydown", event => {
    if (event.target !== svg || event.ctrlKey || event.metaKey || event.altKey) return;
    const at = data.at[state.over];
    const act = {
      ArrowDown: () => point_on(svg, 1),
      ArrowUp: () => point_on(svg, -1),
      Enter: at && (() => go(at)),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
}

/** Highlight the sources of the mark pointed at, except in a turn, where they would reveal the next step. */
export function point_at(step) {
  if (turn || state.over === step) return;
  state.over = step;
  trace();
}

sheets.forEach(({ fields }) => fields.forEach(reachable));
