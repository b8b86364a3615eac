// What a frame needs of the marks that move on a step page.
export { grips } from "./grab.js";
export { halos } from "./halos.js";
export { shape } from "./highlights.js";
export { lettering } from "./lettering.js";
