// Mistakes in words: the place of each, its description, and their number.

import { say } from "./talk.js";

/** The number of mistakes, in words. */
export function counted(many) {
  if (many === 0) return say("studio.none_wrong");
  return many === 1 ? say("studio.one_wrong") : say("studio.some_wrong", { count: many });
}

/** The place of a mistake: its line and column, and its key. */
export function whereabouts({ line, column, place }) {
  const at = line ? say("studio.line", { line }) : "";
  const within = column ? say("studio.column", { column }) : "";
  const key = place.startsWith("line ") ? "" : place;
  return [[at, within].filter(Boolean).join(", "), key].filter(Boolean).join(" · ");
}

/** The mistake, what was expected, and a hint. */
export function matter({ found, expected, hint }) {
  return [found, expected && say("studio.expected", { expected }), hint].filter(Boolean).join("; ");
}

/** A mistake in one sentence. */
export function sentence(problem) {
  return [whereabouts(problem), matter(problem)].filter(Boolean).join(": ");
}
