// What a frame needs of moving marks: on a task page nothing moves.
export const grips = [];
export const halos = () => {};
export const lettering = () => new Map();
export const shape = () => null;
