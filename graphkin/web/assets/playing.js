// What plays the steps.
let timer = 0;

function start() {
  play.setAttribute("data-on", "");
  named(play.dataset.pause);
  if (state.step === last) show(1);
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

/** Stay at a step as long as its sentence takes to read. */
function wait() {
  const letters = byId("sentence").textContent.length;
  timer = setTimeout(() => {
    show(state.step + 1);
    if (state.step === last) pause();
    else wait();
  }, Math.min(1500 + 45 * letters, 12000));
}

/** Say what the button does. */
function named(words) {
  play.title = words;
  play.setAttribute("aria-label", words);
}
