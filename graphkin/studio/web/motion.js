// The moving mechanism, with its curves or step by step: a page within the page.

import { sentence } from "./mistakes.js";
import { ask, find, onSpeaking, say } from "./talk.js";

const REST = 500; // ms without a change before the page is drawn again
const toggle = find("move");
const frame = find("moving");
const status = find("motion-status");
const driver = find("motion-driver");
let scene = () => ({}); // the scene as the page sends it
let timer = 0;
let number = 0; // of the newest request
let shown = ""; // the request of the page shown

/** Whether the motion is shown instead of the drawings. */
export const inMotion = () => toggle.getAttribute("aria-pressed") === "true";

/** The view of the sheets that the motion shows; empty for any other page. */
export function sheetsShown() {
  const page = find("motion-kind").elements.page.value;
  const known = [...find("view").options].map(({ value }) => value);
  return inMotion() && known.includes(page) ? page : "";
}

/** Set the scene of the motion, and the callback for opening it. */
export function motionOf(fields, opened) {
  scene = fields;
  toggle.addEventListener("click", () => {
    if (!inMotion()) opened();
    showMotion(!inMotion());
  });
}

/** Show the motion or the drawings. */
export function showMotion(open) {
  toggle.setAttribute("aria-pressed", String(open));
  find("motion").hidden = !open;
  find("seeing").classList.toggle("moved", open);
  if (open) moveSoon(0);
}

/** Draw the motion after a pause in changes. */
export function moveSoon(pause = REST) {
  clearTimeout(timer);
  if (inMotion()) timer = setTimeout(moving, pause);
}

async function moving() {
  const page = find("motion-kind").elements.page.value;
  const fields = { ...scene(), page, driver: page === "curves" ? Number(driver.value) : 0 };
  const now = JSON.stringify(fields);
  if (now === shown) return;
  const own = ++number;
  status.textContent = say("studio.drawing_motion");
  try {
    const answer = await ask("motion", fields);
    if (own !== number) return;
    status.textContent = answer.problems.map(sentence).join(" ");
    offer(answer.drivers, page);
    if (!answer.page) return;
    frame.src = `${answer.page}#step=1`; // step by step from the first
    frame.hidden = false;
    shown = now;
  } catch (error) {
    status.textContent = error.message;
  }
}

/** Offer the drivers: one moves while the others do not, or all move with the time. */
function offer(drivers, page) {
  find("motion-drivers").hidden = drivers.length < 2 || page !== "curves";
  const now = driver.value;
  driver.replaceChildren(
    driver.firstElementChild,
    ...drivers.map((words, i) => new Option(words, String(i + 1))),
  );
  driver.value = now <= drivers.length ? now : "0";
}

find("motion-kind").addEventListener("change", () => moveSoon(0));
find("motion-kind").addEventListener("submit", event => event.preventDefault());
onSpeaking(() => {
  frame.title = say("studio.motion");
  shown = "";
  moveSoon(0);
});
