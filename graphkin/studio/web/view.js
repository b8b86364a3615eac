// The part of the plane that the builder's field shows: its left and upper edge, and its width, in the unit of the scene.

const NOTCH = 1.25; // zoom of a key
const STRIDE = 0.1; // parts of the width by which an arrow key pans
const WHEEL = 1.0015; // zoom for a dot of the wheel

/** @typedef {{ x: number, y: number, width: number }} View */

/**
 * A view zoomed by a factor; a place of the scene stays where it is.
 * @param {View} view
 * @param {number} factor
 * @param {number[]} place
 */
export const zoomed = ({ x, y, width }, factor, [u, v]) => ({
  x: u + (x - u) * factor,
  y: -v + (y + v) * factor,
  width: width * factor,
});

/**
 * A view after a turn of the wheel over a place.
 * @param {View} view
 * @param {number} delta
 * @param {number[]} at
 */
export const wheeled = (view, delta, at) => zoomed(view, WHEEL ** delta, at);

/**
 * A view moved so that a place held by the pointer follows it.
 * @param {View} view
 * @param {number[]} held
 * @param {number[]} at
 */
export const panned = (view, held, at) => ({
  ...view,
  x: view.x + held[0] - at[0],
  y: view.y - held[1] + at[1],
});

/**
 * A view after a key; undefined for other keys.
 * @param {View} view
 * @param {string} key
 * @param {number} steep the height of the field in parts of its width
 */
export function keyed(view, key, steep) {
  const { x, y, width } = view;
  const middle = [x + width / 2, -(y + (width * steep) / 2)];
  const step = width * STRIDE;
  /** @type {Record<string, () => View>} */
  const next = {
    "+": () => zoomed(view, 1 / NOTCH, middle),
    "=": () => zoomed(view, 1 / NOTCH, middle),
    "-": () => zoomed(view, NOTCH, middle),
    ArrowLeft: () => ({ ...view, x: x - step }),
    ArrowRight: () => ({ ...view, x: x + step }),
    ArrowUp: () => ({ ...view, y: y - step }),
    ArrowDown: () => ({ ...view, y: y + step }),
  };
  return next[key]?.();
}
