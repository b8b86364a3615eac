// What the scripts of the pages find there: globals of other scripts, and elements of their templates.

/** The sections of the manual that its search looks through. */
declare const SECTIONS: { title: string; page: string; words: string; to: string }[];

/**
 * An element that an id or a selector names. The template says of which kind it is, so it has what
 * the elements of these pages have; a misspelt name is still an error.
 */
interface PageElement extends Omit<HTMLElement, "hidden"> {
  hidden: boolean;
  // fields, buttons, forms, dialogs
  checked: boolean;
  disabled: boolean;
  elements: HTMLFormControlsCollection & Record<string, PageElement>;
  files: FileList | null;
  max: string;
  min: string;
  name: string;
  open: boolean;
  options: HTMLOptionsCollection;
  placeholder: string;
  returnValue: string;
  selectedIndex: number;
  selectionEnd: number;
  selectionStart: number;
  step: string;
  value: string;
  cloneNode(deep?: boolean): PageElement;
  close(value?: string): void;
  reset(): void;
  select(): void;
  setSelectionRange(start: number, end: number): void;
  showModal(): void;
  // links, frames, templates, tables
  cells: HTMLCollectionOf<HTMLTableCellElement>;
  content: DocumentFragment;
  href: string;
  src: string;
  tBodies: HTMLCollectionOf<HTMLTableSectionElement>;
  tHead: HTMLTableSectionElement;
  // pictures
  cx: SVGAnimatedLength;
  cy: SVGAnimatedLength;
  r: SVGAnimatedLength;
  x1: SVGAnimatedLength;
  x2: SVGAnimatedLength;
  y1: SVGAnimatedLength;
  y2: SVGAnimatedLength;
  ownerSVGElement: SVGSVGElement;
  viewBox: SVGAnimatedRect;
  getBBox(): DOMRect;
  getPointAtLength(far: number): DOMPoint;
  getScreenCTM(): DOMMatrix;
  getTotalLength(): number;
}

interface Document {
  getElementById(id: string): PageElement | null;
}
interface ParentNode {
  querySelector(selectors: string): PageElement | null;
  querySelectorAll(selectors: string): NodeListOf<PageElement>;
}
interface Element extends HTMLOrSVGElement {
  closest(selectors: string): PageElement | null;
  /** The DOM writes numbers and truth values as text. */
  setAttribute(name: string, value: string | number | boolean): void;
}

// --- what the scripts of a page pass to each other ------------------------------------------------

/** A datum that a page lets its reader change: its input, its range, and the result that it shows. */
interface Figure {
  key: string;
  name: string;
  place: number;
  start: number;
  low: number;
  high: number;
  step: number;
  unit: string;
  shows: number;
  datum: number;
  moves: number;
}

/** A point or vector [x, y]: of a drawing upwards in metres, of a field downwards in millimetres. */
type Place = number[];
/** A box [left, top, width, height] of a field, in millimetres of paper. */
type Box = number[];
/** A circle of a drawing. */
type Circle = { c: Place; r: number };
/** A result of an action: a point or vector, a line as a point with a direction, or a circle. */
type Result = any;

/** A label of a field with its box; a note grows to the right and upwards only. */
interface Label {
  mark: PageElement;
  box: DOMRect;
  note: boolean;
}
/** A field of a sheet: its picture, the groups for what is lit, its boxes, its labels and its view. */
interface Field {
  svg: PageElement;
  halo: SVGElement;
  front: SVGElement;
  aims: SVGElement;
  whole: Box;
  drawn: Box | null;
  labels: Label[];
  least: number;
  view: { middle: Place; scale: number } | null;
  edges: Box | null;
  box?: Box;
  motion?: Box | null;
  lettering?: number;
  gliding?: number;
  least_scale?: number;
  most_scale?: number;
  resting?: { text: PageElement; at: Place; half: Place }[];
}
/** A sheet: its marks, the letters that share a label, the marks of each step, and its two fields. */
interface Sheet {
  element: PageElement;
  marks: PageElement[];
  parts: NodeListOf<PageElement>;
  of: Map<string, PageElement[]>;
  fields: Field[];
}
/** What can be taken for a move: a point, line, circle, vector or number with its value. */
interface Thing {
  kind: string;
  name?: string;
  plane?: number;
  needs: number[];
  value?: Result;
  on?: (string | number)[];
  by?: string;
  sheet?: number;
  paper?: boolean;
  typed?: boolean;
}
/** A move of your turn: an action with its inputs, its result, and what it belongs to. */
interface Move {
  action: string;
  inputs: string[];
  plane: number;
  value: Result;
  at: number;
  sheet: number;
  needs: number[];
  name: string;
  about?: string;
  goal?: boolean;
  turns?: string[];
  turned?: string;
  keeps?: [string, number];
  errors?: string[][];
}
/** An action with the inputs taken for it. */
interface Way {
  action: string;
  inputs: string[];
}
/** What a release would take: a thing or a crossing, with the ways that it fits; or a band to nothing. */
interface Aim {
  key?: string;
  value?: Result;
  ways?: Way[];
  band?: [string, Spot];
}
/** A place of a field that is pointed at, with the reach of the pointer there. */
interface Spot {
  side: number;
  at: Place;
  near: number;
}
/** A shape in a field: a point or circle at a place, or a segment; with a ring or a text instead. */
interface Shape {
  side: number;
  at?: Place;
  r?: number;
  from?: Place;
  to?: Place;
  ring?: number;
  text?: string;
  near?: Place;
  way?: Place;
}
/** What a label must not cover: a box of letters or a point, or a line. */
interface Obstacle {
  at?: Place;
  half?: Place;
  letters?: boolean;
  from?: Place;
  to?: Place;
}
/** The results that a student chooses from. */
type Asked = Result[] & { plane: number; given: string[] };
/** A turn, or a drawing on the board: what is drawn, and what is taken for the next move. */
interface Turn {
  done: Set<number>;
  lines: [string, string[], number][];
  log: { step?: number; how?: string; wrong?: number }[];
  past: Past[];
  future: Past[];
  fresh: (number | string)[];
  open: Set<number>;
  taken: string[];
  inputs: string[];
  tool: string | null;
  action: string | null;
  asked: Asked | null;
  aim: Aim | null;
  wrong_line: (Shape | null)[] | null;
  sure?: boolean;
  // only your turn
  from?: number;
  came?: number;
  near?: boolean;
  wrong?: number;
  hinted?: number | null;
  grade?: number;
  helped?: Record<number, string>;
  sheet?: number | null;
  reached?: string[];
}
/** What a move changes, to be taken back. */
interface Past {
  done: number[];
  log: Turn["log"];
  lines: Turn["lines"];
}
/** What the palette and the board of a page read: the things, the moves, and what names them. */
interface TurnRecord {
  moves: Record<string, Move>;
  picks: Record<string, Thing>;
  /** The points of the mechanism whose image a thing is. */
  places: Record<string, (string | number)[]>;
  /** The kinds of things that each place of an action takes. */
  palette: Record<string, string[][]>;
  /** The plan of each sheet, and for its two fields the origin on paper, of the drawing, and the scale. */
  fields: any[][];
  /** The messages of the page by their keys. */
  words: Record<string, string>;
  shares: [number, number, number[]][];
  seconds: number;
  millimetre: number[];
  [more: string]: any;
}
