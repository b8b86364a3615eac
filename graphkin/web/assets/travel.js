// What plays the motion: the driver goes in its sense, round and round or from one end to the other.
const TURN = 9000, PASS = 6000, STAY = 600; // milliseconds of a turn and of a range, and those at its end
const traveller = motion && byId("travel");
let travelling = 0, lately = 0;

/** Play it, or stop. */
function travel() {
  if (travelling) return rest_from_travel();
  pause();
  lately = performance.now();
  travelling = requestAnimationFrame(go_on);
  traveller.setAttribute("data-on", "");
  called(traveller, traveller.dataset.pause);
}

function rest_from_travel() {
  cancelAnimationFrame(travelling);
  travelling = 0;
  traveller.removeAttribute("data-on");
  called(traveller, traveller.dataset.play);
}

/** Go on by the time since; from the end of a range it begins again. */
function go_on(now) {
  const { low, high, whole, sense } = motion, time = Math.min(now - lately, 100);
  const end = sense > 0 ? high : low, next = state.x + sense * (high - low) * time / (whole ? TURN : PASS);
  travelling = requestAnimationFrame(go_on);
  if (whole || (end - state.x) * sense > 1e-9) {
    lately = now;
    move(whole ? next : sense * Math.min(sense * next, sense * end));
  } else if (now - lately > STAY) {
    lately = now;
    move(sense > 0 ? low : high);
  }
}
