// The construction at a position of the driver: `run(x, y)` is printed from the trace. x are its inputs,
// y its results. Groups of class III are closed anew from their course through the range.
const TRIES = 24,
  TRIAL = 1e-6,
  CLOSED = 1e-9; // most steps of a solver, first step, misclosure that counts as closed
const STAGES = 12; // stages in which a closure is continued to changed figures

/** The construction of some data: its inputs, its results, and what brings them to a position. */
export function construction_of(data, run, closings) {
  const y = new Float64Array(data.size),
    x = new Float64Array(data.inputs);
  let reckoned = NaN,
    closes = false;

  // The figures that can be changed; `led` says whether one differs from the drawn value.
  const figures = data.figures ?? [];
  let led = false;
  for (const { place, start } of figures) x[place] = start;
  const figure = (k, value) => {
    x[figures[k].place] = value;
    led = figures.some(({ place, start }) => x[place] !== start);
    reckoned = NaN;
  };

  const reckon = at => {
    if (at !== reckoned) {
      reckoned = at;
      x[0] = at;
      count();
      const closed = closeAll();
      run(x, y);
      closes = closed && data.closed.every(i => Number.isFinite(y[i]));
    }
    return closes;
  };

  // The turn count of links that only pins turn: the angle near which each counts, by driver position.
  const count = () => {
    for (const { place, at, near } of data.turned) {
      let k = at.length - 1;
      while (k > 0 && at[k] > x[0]) k--;
      x[place] = near[k];
    }
  };

  // Groups of class III: the secant method closes them near a state from their course.
  const trial = [];
  const secant = (miss, start, step) => {
    let old = start + step,
      now = start,
      before = miss(old),
      after = miss(now);
    for (let k = 0; k < TRIES && after !== 0 && after !== before; k++) {
      const next = now - (after * (now - old)) / (after - before);
      old = now;
      now = next;
      before = after;
      after = miss(now);
      if (!(Math.abs(now - old) >= 1e-15 * Math.max(1, Math.abs(now)))) break;
    }
    return Math.abs(after) < CLOSED * data.reach && trial[1] > 0;
  };
  // Several tried links at once: Newton's method, with Gauss-Jordan elimination in the rows of slopes.
  const newton = (miss, place, sizes) => {
    const n = sizes.length,
      missed = () => {
        miss(x, trial);
        return trial.slice(0, n);
      };
    for (let k = 0; k < TRIES; k++) {
      const here = missed(),
        rows = here.map(value => [-value]);
      sizes.forEach((size, j) => {
        const step = TRIAL * size,
          own = x[place + j];
        x[place + j] = own + step;
        missed().forEach((value, i) => {
          rows[i].splice(j, 0, (value - here[i]) / step);
        });
        x[place + j] = own;
      });
      for (let j = 0; j < n; j++) {
        const best = rows
          .slice(j)
          .reduce((b, row, i) => (Math.abs(row[j]) > Math.abs(rows[b][j]) ? i + j : b), j);
        [rows[j], rows[best]] = [rows[best], rows[j]];
        rows.forEach((row, i) => {
          const share = row[j] / rows[j][j];
          if (i !== j) rows[i] = row.map((value, m) => value - share * rows[j][m]);
        });
      }
      const way = rows.map((row, j) => row[n] / row[j]);
      way.forEach((step, j) => {
        x[place + j] += step;
      });
      if (way.every((step, j) => Math.abs(step) < 1e-14 * Math.max(1, Math.abs(x[place + j]))))
        break;
    }
    return missed().every(value => Math.abs(value) < CLOSED * data.reach) && trial[n] > 0;
  };
  const closedNear = state => {
    state.forEach((number, i) => {
      x[i + 1] = number;
    });
    return closings.every((miss, i) => {
      const place = data.course.places[i],
        size = data.course.sizes[i];
      if (size.length) return newton(miss, place, size);
      const start = x[place],
        step = TRIAL * size;
      const missed = tried => {
        x[place] = tried;
        miss(x, trial);
        return trial[0];
      };
      return secant(missed, start, step) || secant(missed, start, -step);
    });
  };
  // With changed figures the course is no longer valid, so the last closure is continued in stages.
  let carried = null;
  const carriedOn = () => {
    const goal = x.slice(),
      from = carried,
      { states, turn } = data.course,
      end = 1 + states[0].length;
    const ways = goal.map((number, i) => number - from[i]);
    if (turn) ways[0] -= turn * Math.round(ways[0] / turn);
    let state = [...from.slice(1, end)];
    for (let k = 1; k <= STAGES; k++) {
      ways.forEach((way, i) => {
        if (i === 0 || i >= end) x[i] = k < STAGES ? from[i] + (way * k) / STAGES : goal[i];
      });
      if (!closedNear(state)) {
        goal.forEach((number, i) => {
          x[i] = number;
        });
        return false;
      }
      state = [...x.slice(1, end)];
    }
    carried = x.slice();
    return true;
  };
  const closeAll = () => {
    if (!closings.length) return true;
    if (led) return carriedOn();
    const good = closedHere();
    if (good) carried = x.slice();
    return good;
  };
  const closedHere = () => {
    const { at, states, turn } = data.course;
    const place = turn ? at[0] + ((((x[0] - at[0]) % turn) + turn) % turn) : x[0];
    let k = 1;
    while (k < at.length - 1 && at[k] < place) k++;
    const part = (place - at[k - 1]) / (at[k] - at[k - 1]),
      before = states[k - 1],
      after = states[k];
    // a dyad is stretched between these two states
    if (before.some((number, i) => number === -after[i]))
      return closedNear(before) || closedNear(after);
    return closedNear(before.map((number, i) => number + part * (after[i] - number)));
  };

  /** Whether everything stands where the scene has it. */
  const asDrawn = () => !led && Math.abs(reckoned - data.start) < 1e-9;
  return { x, y, figures, figure, reckon, asDrawn };
}
