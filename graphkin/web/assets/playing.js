// What plays the steps.
let timer = 0;

function start() {
  play.setAttribute("data-on", "");
  named(play.dataset.pause);
  if (state.step === last) show(0);
  wait();
}

function pause() {
  clearTimeout(timer);
  timer = 0;
  play.removeAttribute("data-on");
  named(play.dataset.play);
}

function toggle() {
  if (timer) pause();
  else start();
}

/** Stay at a step as long as its sentence and why take to read, and its strokes to draw. */
function wait() {
  const why = byId("because").open ? byId("reason").textContent.length : 0;
  const letters = byId("sentence").textContent.length + (state.step ? why : 0);
  timer = setTimeout(() => {
    show(state.step + 1);
    if (state.step === last) pause();
    else wait();
  }, Math.max(Math.min(1500 + 45 * letters, 25000), state.step ? 0 : SWEEP));
}

/** Say what the button does. */
function named(words) {
  play.title = words;
  play.setAttribute("aria-label", words);
}
