// Marks that are pointed at: a line is half a dot wide, a finger is not.
const REACH = 10; // dots from a mark within which it is meant

/** The step of the mark that is meant by a place on the screen; null where none is near. */
function aimed(event) {
  const direct = event.target.closest("[data-of]");
  if (direct) return direct.dataset.of;
  const svg = event.target.closest(".view > svg"), place = svg?.getScreenCTM();
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

/** How far a line or the middle of a circle lies from a place. */
function away(mark, x, y) {
  const [x1, y1] = (mark.matches("line") ? ["x1", "y1"] : ["cx", "cy"]).map(name => Number(mark.getAttribute(name)));
  if (!mark.matches("line")) return Math.hypot(x - x1, y - y1);
  const [u, v] = ["x2", "y2"].map((name, i) => Number(mark.getAttribute(name)) - [x1, y1][i]);
  const part = Math.min(Math.max(((x - x1) * u + (y - y1) * v) / (u * u + v * v || 1), 0), 1);
  return Math.hypot(x - x1 - part * u, y - y1 - part * v);
}
