// New elements of the page and of its pictures.
export const SVG = "http://www.w3.org/2000/svg";

/**
 * An element of the page.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 */
export const html_element = tag => document.createElement(tag);

/**
 * An element of a picture.
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} tag
 */
export const svg_element = tag => document.createElementNS(SVG, tag);
