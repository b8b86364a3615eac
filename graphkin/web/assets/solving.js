// Groups of class III, closed anew from their course through the range: the tried numbers among the
// inputs are brought to where each `miss(x, trial)` is zero on the branch that is drawn.
const TRIES = 24,
  TRIAL = 1e-6,
  CLOSED = 1e-9; // most steps of a solver, first step, misclosure that counts as closed
const STAGES = 12; // stages in which a closure is continued to changed figures

/** Bring a number to where a function is zero, by the secant method; the value that is left. */
function by_secant(missed, start, step) {
  let old = start + step,
    now = start,
    before = missed(old),
    after = missed(now);
  for (let k = 0; k < TRIES && after !== 0 && after !== before; k++) {
    const next = now - (after * (now - old)) / (after - before);
    [old, now, before, after] = [now, next, after, missed(next)];
    if (!(Math.abs(now - old) >= 1e-15 * Math.max(1, Math.abs(now)))) break;
  }
  return after;
}

/** Bring several inputs from a place on to where some functions are zero, by Newton's method. */
function by_newton(missed, x, place, sizes) {
  for (let k = 0; k < TRIES; k++) {
    const way = solved(slopes(missed, x, place, sizes));
    way.forEach((step, j) => {
      x[place + j] += step;
    });
    const rests = (step, j) => Math.abs(step) < 1e-14 * Math.max(1, Math.abs(x[place + j]));
    if (way.every(rests)) return;
  }
}

/** The equations of a step: for each function its slopes, and its value with the other sign. */
function slopes(missed, x, place, sizes) {
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
  return rows;
}

/** The solution of linear equations by Gauss-Jordan elimination; each row ends with its right side. */
function solved(rows) {
  const n = rows.length;
  for (let j = 0; j < n; j++) {
    let best = j;
    for (let i = j; i < n; i++) if (Math.abs(rows[i][j]) > Math.abs(rows[best][j])) best = i;
    [rows[j], rows[best]] = [rows[best], rows[j]];
    rows.forEach((row, i) => {
      const share = row[j] / rows[j][j];
      if (i !== j) rows[i] = row.map((value, m) => value - share * rows[j][m]);
    });
  }
  return rows.map((row, j) => row[n] / row[j]);
}

/**
 * What closes the groups of a construction at its inputs.
 * @param {any} data
 * @param {((x: Float64Array, trial: number[]) => void)[]} closings the misclosure of each group
 * @returns {(x: Float64Array, led: boolean) => boolean}
 */
export function closing_of({ course, reach }, closings) {
  const trial = [],
    is_zero = value => Math.abs(value) < CLOSED * reach;
  let carried = null; // the inputs that closed last

  /** Close one group near its tried numbers. */
  function close_group(x, miss, place, size) {
    const missed = () => (miss(x, trial), trial);
    if (size.length) {
      const n = size.length,
        values = () => missed().slice(0, n);
      by_newton(values, x, place, size);
      return values().every(is_zero) && trial[n] > 0;
    }
    const start = x[place],
      step = TRIAL * size;
    const missed_at = tried => {
      x[place] = tried;
      return missed()[0];
    };
    return [step, -step].some(one => is_zero(by_secant(missed_at, start, one)) && trial[1] > 0);
  }

  /** Close all groups near a state. */
  function closed_near(x, state) {
    x.set(state, 1);
    return closings.every((miss, i) => close_group(x, miss, course.places[i], course.sizes[i]));
  }

  /** With changed figures the course is no longer valid: the last closure is continued in stages. */
  function carried_on(x) {
    const goal = x.slice(),
      from = carried,
      { states, turn } = course,
      end = 1 + states[0].length;
    const ways = goal.map((number, i) => number - from[i]);
    if (turn) ways[0] -= turn * Math.round(ways[0] / turn);
    let state = from.slice(1, end);
    for (let k = 1; k <= STAGES; k++) {
      ways.forEach((way, i) => {
        if (i === 0 || i >= end) x[i] = k < STAGES ? from[i] + (way * k) / STAGES : goal[i];
      });
      if (!closed_near(x, state)) {
        x.set(goal);
        return false;
      }
      state = x.slice(1, end);
    }
    carried = x.slice();
    return true;
  }

  /** Close between the two states of the course beside a position. */
  function closed_here(x) {
    const { at, states, turn } = course;
    const place = turn ? at[0] + ((((x[0] - at[0]) % turn) + turn) % turn) : x[0];
    let k = 1;
    while (k < at.length - 1 && at[k] < place) k++;
    const part = (place - at[k - 1]) / (at[k] - at[k - 1]),
      before = states[k - 1],
      after = states[k];
    // a dyad is stretched between these two states
    if (before.some((number, i) => number === -after[i])) {
      return closed_near(x, before) || closed_near(x, after);
    }
    return closed_near(
      x,
      before.map((number, i) => number + part * (after[i] - number)),
    );
  }

  return (x, led) => {
    if (led) return carried_on(x);
    const good = closed_here(x);
    if (good) carried = x.slice();
    return good;
  };
}
