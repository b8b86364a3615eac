// Numbers as the language of the page writes them.

let mark = ".";

/**
 * Write numbers with a decimal mark.
 * @param {string} sign
 */
export function write_numbers_with(sign) {
  mark = sign;
}

/**
 * A number with so many decimals; a number that rounds to zero is 0.
 * @param {number} number
 * @param {number} places
 */
export function written(number, places) {
  const text = number.toFixed(places);
  return Number(text) === 0 ? "0" : text.replace("-", "−").replace(".", mark);
}

/**
 * A number with so many significant digits, with a power of ten when far from one.
 * @param {number} number
 * @param {number} [digits]
 */
export function significant(number, digits = 4) {
  if (number === 0) return "0";
  const [mantissa, exponent] = number.toExponential(digits - 1).split("e"),
    power = Number(exponent);
  if (power >= -4 && power < 6)
    return written(Number(number.toExponential(digits - 1)), Math.max(digits - 1 - power, 0));
  const signs = [...String(power)].map(sign => (sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(sign)]));
  return `${mantissa.replace("-", "−").replace(".", mark)}·10${signs.join("")}`;
}
