// Mistakes in words: where each stands, what it is, how many there are.

import { say } from "./talk.js";

/** How many mistakes there are. */
export function counted(many) {
  if (many === 0) return say("studio.none_wrong");
  return many === 1 ? say("studio.one_wrong") : say("studio.some_wrong", { count: many });
}

/** Where a mistake stands: its line and column, and the key that it is about. */
export function whereabouts({ line, column, place }) {
  const at = line ? say("studio.line", { line }) : "";
  const within = column ? say("studio.column", { column }) : "";
  const key = place.startsWith("line ") ? "" : place;
  return [[at, within].filter(Boolean).join(", "), key].filter(Boolean).join(" · ");
}

/** What is wrong, what was expected, and what helps. */
export function matter({ found, expected, hint }) {
  return [found, expected && say("studio.expected", { expected }), hint].filter(Boolean).join("; ");
}

/** A mistake in one sentence. */
export function sentence(problem) {
  return [whereabouts(problem), matter(problem)].filter(Boolean).join(": ");
}
