// One history of everything that changes the scene on the page: the text and the sliders.

const TOGETHER = 1000; // ms within which typing, or moves of a slider, count as one change
const MOST = 500; // number of states remembered

/** A history of states; `now` returns the current state and `show` goes to another. */
export function historyOf(now, show) {
  const states = [now()];
  let at = 0;
  let last = { kind: "", time: 0 };

  /** Record a change; a change of the same kind right after another extends it. An empty kind
   * never does. */
  function note(kind = "") {
    const state = now();
    const time = performance.now();
    const on =
      kind && kind === last.kind && time - last.time < TOGETHER && at === states.length - 1;
    last = { kind, time };
    if (JSON.stringify(state) === JSON.stringify(states[at])) return;
    if (!on || at === 0) at++;
    states.splice(at, Infinity, state);
    if (states.length > MOST) (states.shift(), at--);
  }

  /** Go forward or back by some changes, as far as there are any. */
  function go(changes) {
    note();
    const goal = Math.max(0, Math.min(states.length - 1, at + changes));
    if (goal === at) return;
    at = goal;
    show(states[at]);
  }

  return { note, undo: () => go(-1), redo: () => go(1) };
}
