// Lengths and angles typed while a bar, wheel or guide is dragged: "120", "120 30", or " 30" for the angle alone.

const SIGNS = /^[\d.,\s<-]$/;

/**
 * What is typed after another key; undefined for a key that is not part of a number.
 * @param {string} typed
 * @param {string} key
 */
export function typedAfter(typed, key) {
  if (key === "Backspace") return typed.slice(0, -1);
  return SIGNS.test(key) ? typed + key : undefined;
}

/**
 * The length and the angle in degrees of a drag, where they are typed.
 * @param {string} typed
 * @returns {(number | null)[]}
 */
function numbersIn(typed) {
  const [length, angle] = typed
    .split(/[\s<]+/)
    .map(text => Number.parseFloat(text.replace(",", ".")));
  return [length, angle].map(number => (Number.isFinite(number) ? number : null));
}

/**
 * The end of a drag from a place to the pointer, with a typed length and angle in place of its own.
 * @param {string} typed
 * @param {number[]} from
 * @param {number[]} to
 * @param {number} step of an angle that is drawn, in degrees
 */
export function typedEnd(typed, [x, y], [u, v], step) {
  const [length, angle] = numbersIn(typed);
  const own =
    (Math.round((Math.atan2(v - y, u - x) * 180) / Math.PI / step) * step * Math.PI) / 180;
  const turn = angle === null ? own : (angle * Math.PI) / 180;
  const long = length !== null && length > 0 ? length : Math.hypot(u - x, v - y);
  return [x + long * Math.cos(turn), y + long * Math.sin(turn)];
}
