// What the actions of the palette draw, computed without a page.
import assert from "node:assert/strict";
import { test } from "node:test";

import * as actions from "../../graphkin/web/assets/board_actions.js";
import { named_from, palette_of } from "../../graphkin/web/assets/palette.js";

/** A palette over some picks: a bar AB of length 5 with its images a and b in a velocity plan. */
function given() {
  const point = (value, plane, kind = "point") => ({ kind, plane, needs: [], value });
  const picks = {
    A: { ...point([0, 0], 0), name: "A" },
    B: { ...point([3, 4], 0), name: "B" },
    AB: { kind: "bar", on: ["A", "B"], needs: [] },
    a: { ...point([1, 0], 1, "image"), name: "a" },
    b: { ...point([-3, 3], 1, "image"), name: "b" },
    v: { kind: "vector", plane: 1, needs: [], value: [0, -2], name: "v" },
    "30mm": { kind: "length", plane: 0, needs: [], value: 30, paper: true },
    "90deg": { kind: "angle", plane: 0, needs: [], value: 90 },
    "2rad": { kind: "rate", plane: 0, needs: [], value: 2 },
    m: {
      kind: "locus",
      plane: 1,
      needs: [],
      value: [
        [0, 0],
        [1, 0],
      ],
    },
    n: {
      kind: "locus",
      plane: 1,
      needs: [],
      value: [
        [2, 5],
        [0, 1],
      ],
    },
    p: {
      kind: "locus",
      plane: 1,
      needs: [],
      value: [
        [0, 1],
        [2, 0],
      ],
    },
    c: { kind: "circle", plane: 1, needs: [], value: { c: [0, 0], r: 5 } },
    d: { kind: "circle", plane: 1, needs: [], value: { c: [6, 0], r: 5 } },
  };
  const places = { a: ["A"], b: ["B"] };
  const record = { moves: {}, picks, places, shares: [], seconds: 1, millimetre: [0.001, 0.01, 1] };
  return palette_of({ ...record, words: { arc: "{p}, {bar}" } }, () => true, actions);
}

/** Every number of two values within rounding errors. */
function close(found, wanted) {
  const numbers = value =>
    typeof value === "number" ? [value] : Object.values(value).flatMap(numbers);
  const [own, other] = [numbers(found), numbers(wanted)];
  assert.equal(own.length, other.length);
  own.forEach((number, i) => assert.ok(Math.abs(number - other[i]) < 1e-12, `${own} for ${other}`));
}

test("a bar is named by its ends and lies in the mechanism", () => {
  const palette = given();
  close(palette.value_of("AB"), [3, 4]);
  assert.equal(palette.plane_of("perpendicular", ["a", "AB"]), 1);
  assert.equal(palette.plane_of("coriolis", ["2rad", "v"]), 3);
  assert.equal(palette.plane_of("pole", ["AB", "a", "b"]), 0);
});

test("a perpendicular is turned by a quarter, a parallel is not", () => {
  const { results_of } = given();
  close(results_of("perpendicular", ["a", "AB"]), [
    [
      [1, 0],
      [-4, 3],
    ],
  ]);
  close(results_of("parallel", ["a", "AB"]), [
    [
      [1, 0],
      [3, 4],
    ],
  ]);
});

test("lines and circles cross where they meet, and nowhere else", () => {
  const { results_of } = given();
  close(results_of("cut", ["m", "n"]), [[2, 0]]);
  assert.deepEqual(results_of("cut", ["m", "p"]), []);
  assert.deepEqual(results_of("cut", ["m", "m"]), []);
  close(results_of("cut", ["m", "c"]), [
    [5, 0],
    [-5, 0],
  ]);
  close(results_of("cut", ["c", "d"]), [
    [3, 4],
    [3, -4],
  ]);
});

test("a typed length is one of paper in the drawing of its point", () => {
  const { results_of } = given();
  close(results_of("compass", ["A", "30mm"]), [{ c: [0, 0], r: 0.03 }]);
  close(results_of("compass", ["a", "30mm"]), [{ c: [1, 0], r: 0.3 }]);
  close(results_of("ray", ["A", "90deg"]), [
    [
      [0, 0],
      [0, 1],
    ],
  ]);
});

test("the Coriolis component is twice the rate times the turned velocity", () => {
  close(given().results_of("coriolis", ["2rad", "v"]), [[8, 0]]);
});

test("the pole of a bar has no velocity", () => {
  const [x, y] = given().results_of("pole", ["AB", "a", "b"])[0];
  // v = ω × r about the pole, with ω = |ab| / |AB| = 1
  close([-(0 - y), 0 - x], [1, 0]);
});

test("values are the same within rounding, lines also from another point on them", () => {
  const { same_value } = given();
  assert.ok(
    same_value(
      "perpendicular",
      [
        [0, 0],
        [1, 2],
      ],
      [
        [2, 4],
        [-2, -4],
      ],
      1,
    ),
  );
  assert.ok(
    !same_value(
      "perpendicular",
      [
        [0, 0],
        [1, 2],
      ],
      [
        [2, 4],
        [-2, -4.001],
      ],
      1,
    ),
  );
  assert.ok(same_value("cut", [1, 2], [1, 2 + 1e-9], 1));
  assert.ok(!same_value("cut", [1, 2], [1, 2.001], 1));
});

test("results are named from their inputs", () => {
  assert.equal(named_from("perpendicular", ["a", "AB"], {}), "⊥ AB (a)");
  assert.equal(named_from("compass", ["a", "30 mm"], { arc: "{p}, {bar}" }), "a, 30 mm");
});
