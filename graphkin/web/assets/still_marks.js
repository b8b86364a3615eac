// What a frame needs of moving marks: on a task page nothing moves.
/** @type {{ by: any, way: Place[] }[][]} */
export const grips = [];
export const halos = () => {};
/** @type {() => Map<number, any>} */
export const lettering = () => new Map();
/** @type {(tag: string, look: string, d: string) => SVGElement} */
export const shape = () => document.createElementNS("http://www.w3.org/2000/svg", "g");
