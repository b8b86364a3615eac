// What closes a construction anew: the secant method, Newton's method, and the changed figures.
import assert from "node:assert/strict";
import { test } from "node:test";

import { construction_of } from "../../graphkin/web/assets/closing.js";
import { closing_of } from "../../graphkin/web/assets/solving.js";

/** A construction whose result is its tried number u with u² = c·x for the driver x and a figure c. */
function root() {
  const course = { at: [1, 4, 9], states: [[1], [2], [3]], places: [1], sizes: [1], turn: null };
  const figures = [{ place: 2, start: 1 }];
  const data = { size: 1, inputs: 3, figures, closed: [0], turned: [], reach: 1, start: 1, course };
  const miss = (x, trial) => {
    trial[0] = x[1] ** 2 - x[2] * x[0];
    trial[1] = x[1]; // positive on the branch that is drawn
  };
  const run = (x, y) => {
    y[0] = x[1];
  };
  return construction_of(data, run, closing_of(data, [miss]));
}

test("one tried number closes by the secant method on its own branch", () => {
  const { reckon, y } = root();
  for (const [x, u] of [
    [1, 1],
    [2.25, 1.5],
    [6.25, 2.5],
    [9, 3],
  ]) {
    assert.equal(reckon(x), true);
    assert.ok(Math.abs(y[0] - u) < 1e-9, `${y[0]} at ${x}`);
  }
});

test("the closure goes on with a figure that is changed, and comes back", () => {
  const { reckon, figure, asDrawn, y } = root();
  reckon(1);
  assert.equal(asDrawn(), true);
  figure(0, 4);
  assert.equal(reckon(1), true);
  assert.ok(Math.abs(y[0] - 2) < 1e-9);
  assert.equal(asDrawn(), false);
  figure(0, 1);
  reckon(1);
  assert.ok(Math.abs(y[0] - 1) < 1e-9);
  assert.equal(asDrawn(), true);
});

test("what cannot close says so, and closes again where it can", () => {
  const { reckon, figure } = root();
  reckon(1);
  figure(0, -4);
  assert.equal(reckon(1), false);
  figure(0, 1);
  assert.equal(reckon(4), true);
});

test("several tried numbers close together by Newton's method", () => {
  const course = {
    at: [1, 9],
    states: [
      [1, 1],
      [3, 3],
    ],
    places: [1],
    sizes: [[1, 1]],
    turn: null,
  };
  const data = { size: 2, inputs: 3, closed: [0, 1], turned: [], reach: 1, start: 1, course };
  const miss = (x, trial) => {
    trial[0] = x[1] ** 2 + x[2] ** 2 - 2 * x[0];
    trial[1] = x[1] - x[2];
    trial[2] = x[1];
  };
  const run = (x, y) => {
    y.set(x.slice(1));
  };
  const { reckon, y } = construction_of(data, run, closing_of(data, [miss]));
  assert.equal(reckon(4), true);
  assert.ok(Math.abs(y[0] - 2) < 1e-9 && Math.abs(y[1] - 2) < 1e-9);
});

test("the turn count of a link follows the driver", () => {
  const turned = [{ place: 1, at: [0, 5], near: [10, 370] }];
  const data = { size: 1, inputs: 2, closed: [], turned, reach: 1, start: 0 };
  const run = (x, y) => {
    y[0] = x[1];
  };
  const { reckon, y } = construction_of(data, run, () => true);
  reckon(4);
  assert.equal(y[0], 10);
  reckon(6);
  assert.equal(y[0], 370);
});
