/** The mechanism of a page that moves: what moving.js makes of its data; missing where nothing moves. */
declare const graphkinMotion: ReturnType<
  typeof import("../../graphkin/web/assets/moving.js").moving
>;
