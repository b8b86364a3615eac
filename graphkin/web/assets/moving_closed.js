// What a page moves whose groups of class III are closed anew.
import { moving } from "./moving.js";
import { closing_of } from "./solving.js";

/** The mechanism of such a page: `run` and `closings` are printed from the trace. */
export const moving_closed = (data, run, closings) => moving(data, run, closing_of(data, closings));
