// One history of everything that changes the scene on the page: the text and the sliders.

const TOGETHER = 1000; // ms within which signs that are typed, or moves of a slider, are one change
const MOST = 500; // states that are remembered

/** A history of states; `now` gives the present one and `show` goes to another. */
export function historyOf(now, show) {
  const states = [now()];
  let at = 0;
  let last = { kind: "", time: 0 };

  /** Remember a change; one of the same kind as just before goes on with it, but for none. */
  function note(kind = "") {
    const state = now();
    const time = performance.now();
    const on = kind && kind === last.kind && time - last.time < TOGETHER && at === states.length - 1;
    last = { kind, time };
    if (JSON.stringify(state) === JSON.stringify(states[at])) return;
    if (!on || at === 0) at++;
    states.splice(at, Infinity, state);
    if (states.length > MOST) states.shift(), at--;
  }

  /** Go so many changes on, or back; nothing at either end. */
  function go(changes) {
    note();
    const goal = Math.max(0, Math.min(states.length - 1, at + changes));
    if (goal === at) return;
    at = goal;
    show(states[at]);
  }

  return { note, undo: () => go(-1), redo: () => go(1) };
}
