// The construction at a position of the driver: `run(x, y)` is printed from the trace. x are its inputs,
// y its results. What must be closed anew before it, `close` closes (see solving.js).

/**
 * The construction of some data: its inputs, its results, and what brings them to a position.
 * @param {any} data
 * @param {(x: Float64Array, y: Float64Array) => void} run
 * @param {(x: Float64Array, led: boolean) => boolean} close whether the inputs could be closed, for
 *   figures as drawn or led away from that
 */
export function construction_of(data, run, close) {
  const y = new Float64Array(data.size),
    x = new Float64Array(data.inputs);
  let reckoned = NaN,
    closes = false;

  // The figures that can be changed; `led` says whether one differs from the drawn value.
  /** @type {Figure[]} */
  const figures = data.figures ?? [];
  let led = false;
  for (const { place, start } of figures) x[place] = start;

  /**
   * Change a figure.
   * @param {number} k
   * @param {number} value
   */
  function figure(k, value) {
    x[figures[k].place] = value;
    led = figures.some(({ place, start }) => x[place] !== start);
    reckoned = NaN;
  }

  /**
   * Bring the construction to a position of the driver; whether it closes there.
   * @param {number} at
   */
  function reckon(at) {
    if (at !== reckoned) {
      reckoned = at;
      x[0] = at;
      count();
      const closed = close(x, led);
      run(x, y);
      closes = closed && data.closed.every((/** @type {number} */ i) => Number.isFinite(y[i]));
    }
    return closes;
  }

  /** The turn count of links that only pins turn: the angle near which each counts, by driver position. */
  function count() {
    for (const { place, at, near } of data.turned) {
      let k = at.length - 1;
      while (k > 0 && at[k] > x[0]) k--;
      x[place] = near[k];
    }
  }

  /** Whether everything is where the scene has it. */
  const asDrawn = () => !led && Math.abs(reckoned - data.start) < 1e-9;
  return { x, y, figures, figure, reckon, asDrawn };
}
