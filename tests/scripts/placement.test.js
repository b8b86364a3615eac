// Where marks and labels go at a position of the driver.
import assert from "node:assert/strict";
import { test } from "node:test";

import { moving } from "../../graphkin/web/assets/moving.js";

/** Two points with their letters and a vector; the second point moves towards the first. */
function two_points() {
  const field = {
    room: [0, 0, 100, 100],
    still: null,
    first: 0,
    off: [],
    seen: [0, 1],
    reach: { 0: [1, 1], 1: [1, 1], 2: [3, 2], 3: [3, 2] },
  };
  const data = {
    size: 6,
    inputs: 1,
    closed: [0],
    turned: [],
    start: 0,
    // id, kind, place of its sign or -1, place, direction, along, aside, and where it was drawn
    marks: [
      ["p", "m", -1, 0, 4, 0, 0],
      ["q", "m", -1, 2, 4, 0, 0],
      ["P", "t", -1, 0, 4, 5, 0, 25, 50],
      ["Q", "t", -1, 2, 4, 5, 0, 65, 50],
      ["v", "l", -1, 0, 2, -1],
      ["h", "h", -1, 0, 2],
    ],
    fields: [
      [
        {
          ...field,
          labels: [
            [2, 1],
            [3, 1],
          ],
        },
      ],
    ],
    rects: [],
    led: {},
    more: {},
    values: [["speed", "", "v", 2]],
    margins: [],
  };
  const run = (x, y) => {
    y.set([20, 50, 60 - x[0], 50, 1, 0]);
  };
  return moving(data, run);
}

/** The attributes that a position gives to each mark. */
function marks_at(motion, x) {
  const found = {};
  const element = id => ({
    setAttribute: (name, text) => ((found[id] ??= {})[name] = text),
    removeAttribute: name => delete (found[id] ??= {})[name],
  });
  assert.deepEqual(motion.set(x, element), { ok: true });
  return found;
}

test("points, lines and arrowheads follow their results", () => {
  const { p, q, v, h } = marks_at(two_points(), 10);
  assert.deepEqual([p.cx, p.cy, q.cx, q.cy], ["20", "50", "50", "50"]);
  assert.deepEqual([v.x1, v.y1, v.x2, v.y2], ["20", "50", "50", "50"]);
  assert.match(h.points, /^50,50 46\.8,5/);
});

test("a letter follows its point, on its own side while that is free", () => {
  const { P, Q } = marks_at(two_points(), 10);
  assert.equal(P.transform, "translate(0 0)");
  assert.equal(Q.transform, "translate(-10 0)");
});

test("a letter that would cover another one changes its side", () => {
  const { P, Q } = marks_at(two_points(), 38); // q lies at 22, its letter would at 27
  assert.equal(P.transform, "translate(0 0)");
  assert.equal(Q.transform, "translate(-48 0)"); // 5 mm to the left of q
});

test("a vector too short for its head has none", () => {
  const { v, h } = marks_at(two_points(), 39);
  assert.equal(h.visibility, "hidden");
  assert.equal(v.visibility, undefined);
});

test("the extent holds what is seen, within the room of the field", () => {
  const motion = two_points();
  assert.deepEqual(motion.extent(10, 0, 0), [19, 49, 32, 2]);
  assert.deepEqual(motion.extent(-50, 0, 0), [19, 49, 81, 2]);
});

test("values and places of pins are those of the results", () => {
  const motion = two_points();
  assert.deepEqual(motion.values(10), { speed: 50 });
  assert.deepEqual(motion.place("q", 30), [30, 50]);
  assert.equal(motion.place("Q", 30), null);
});
