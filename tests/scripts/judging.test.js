// The verdict on what a student draws: b of a bar AB whose point B slides along a guide.
import assert from "node:assert/strict";
import { test } from "node:test";

import { verdicts_of } from "../../graphkin/web/assets/judging.js";
import * as actions from "../../graphkin/web/assets/page_actions.js";
import { palette_of } from "../../graphkin/web/assets/palette.js";

const ORDER = [10, 11, 12, 13];

/** The verdicts of a velocity plan: a is laid off, b lies on ⊥ AB through a and on ∥ guide through the pole. */
function bar_on_guide() {
  const pick = (kind, plane, name, value) => ({ kind, plane, name, value, needs: [] });
  const record = {
    picks: {
      A: pick("point", 0, "A", [0, 1]),
      B: pick("point", 0, "B", [2, 0]),
      AB: { kind: "bar", on: ["A", "B"], needs: [] },
      g: pick("guide", 0, "g", [
        [0, 0],
        [1, 0],
      ]),
      o: pick("image", 1, "o", [0, 0]),
      va: pick("vector", 1, "vA", [-1, 0]),
      10: { kind: "image" },
      11: { kind: "locus" },
      12: { kind: "locus" },
    },
    moves: {
      10: {
        action: "lay_off",
        inputs: ["o", "va"],
        plane: 1,
        value: [-1, 0],
        goal: true,
        name: "a",
      },
      11: {
        action: "perpendicular",
        inputs: ["10", "AB"],
        plane: 1,
        value: [
          [-1, 0],
          [1, 2],
        ],
      },
      12: {
        action: "parallel",
        inputs: ["o", "g"],
        plane: 1,
        value: [
          [0, 0],
          [1, 0],
        ],
      },
      13: { action: "cut", inputs: ["11", "12"], plane: 1, value: [-1, 0], goal: true, name: "b" },
    },
    places: {},
    shares: [],
    seconds: 1,
    millimetre: [1, 1, 1],
    words: {},
  };
  const palette = palette_of(record, () => true, actions);
  const judge = verdicts_of(record, palette, ORDER);
  return {
    ...judge,
    drawn(action, given, done, which = 0) {
      const all = palette.results_of(action, given);
      const drawn = { action, given, found: [all[which]], plane: 1, other: all[1 - which] };
      return judge.verdict(
        drawn,
        new Set(done),
        ORDER.filter(step => !done.includes(step)),
      );
    },
  };
}

test("a right move is the step that it draws", () => {
  const { drawn } = bar_on_guide();
  assert.deepEqual(drawn("perpendicular", ["10", "AB"], [10]), { is: "right", step: 11 });
  assert.deepEqual(drawn("parallel", ["o", "g"], [10]), { is: "right", step: 12 });
});

test("what is drawn already is said to be", () => {
  const { drawn } = bar_on_guide();
  assert.deepEqual(drawn("parallel", ["o", "g"], [10, 12]), { is: "already", step: 12 });
});

test("of two results the other one is told from a wrong one", () => {
  const { drawn } = bar_on_guide();
  assert.deepEqual(drawn("lay_off", ["o", "va"], [], 0), { is: "right", step: 10 });
  assert.deepEqual(drawn("lay_off", ["o", "va"], [], 1), { is: "other", step: 10 });
});

test("the other result of a move that is made is drawn already", () => {
  const { drawn } = bar_on_guide();
  assert.deepEqual(drawn("lay_off", ["o", "va"], [10], 1), { is: "already", step: 10 });
});

test("a parallel in place of a perpendicular is wrong", () => {
  const { drawn } = bar_on_guide();
  assert.deepEqual(drawn("parallel", ["o", "AB"], [10]), { is: "wrong" });
});

test("a line that no sentence draws leads to a point that lies on it", () => {
  const { drawn } = bar_on_guide();
  assert.deepEqual(drawn("parallel", ["10", "AB"], [10]), { is: "leads", step: 13 });
});

test("inputs that commute are compared in the order in which most of them agree", () => {
  const { own_inputs } = bar_on_guide();
  assert.deepEqual(own_inputs({ action: "cut", inputs: ["11", "12"] }, ["12", "11"]), ["12", "11"]);
  assert.deepEqual(own_inputs({ action: "parallel", inputs: ["o", "g"] }, ["g", "o"]), ["o", "g"]);
});

test("a line at the place of another is drawn with it", () => {
  const { lines_alike } = bar_on_guide();
  assert.deepEqual(lines_alike(12, new Set([10, 12])), [12]);
});
