/** The mechanism of the page that moves: what moving.js makes of its data; missing where nothing moves. */
declare const graphkinMotion: ReturnType<typeof import("../../graphkin/web/assets/moving.js").moving>;
/** The sections of the manual that its search looks through. */
declare const SECTIONS: { title: string; page: string; words: string; to: string }[];
