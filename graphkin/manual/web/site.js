// The search over all pages, the filter of the gallery, and the contents on a small screen.
"use strict";

const MOST = 30; // hits shown
const root = document.body.dataset.root;
/** @typedef {typeof SECTIONS[number]} Section */

/**
 * An element with a text.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 */
const element = (tag, text = "") =>
  Object.assign(document.createElement(tag), { textContent: text });

/** An element that is there; the template has it. */
function there(/** @type {PageElement | null} */ found) {
  if (!found) throw new TypeError("the page lacks an element");
  return found;
}
const byId = (/** @type {string} */ id) => there(document.getElementById(id));

// --- search --------------------------------------------------------------------------------------

/**
 * How well a section fits the words; 0 where one of them is missing.
 * @param {Section} section
 * @param {string[]} words
 */
function fit(section, words) {
  const title = section.title.toLowerCase();
  const page = section.page.toLowerCase();
  const text = section.words.toLowerCase();
  let sum = 0;
  for (const word of words) {
    const found =
      Number(title === word) * 60 +
      Number(title.includes(word)) * 20 +
      Number(page.includes(word)) * 6 +
      Number(text.includes(word));
    if (!found) return 0;
    sum += found;
  }
  return sum;
}

/**
 * The words around the first word that is sought, with all of them marked.
 * @param {Section} section
 * @param {string[]} words
 */
function excerpt(section, words) {
  const text = section.words;
  const at = Math.max(text.toLowerCase().indexOf(words[0]), 0);
  const start = Math.max(at - 60, 0);
  const line = element("span");
  const piece =
    (start ? "… " : "") + text.slice(start, start + 180) + (start + 180 < text.length ? " …" : "");
  const any = new RegExp(
    `(${words.map(word => word.replace(/[^\p{L}\p{N}]/gu, "\\$&")).join("|")})`,
    "giu",
  );
  piece.split(any).forEach((part, i) => line.append(i % 2 ? element("mark", part) : part));
  return line;
}

function search() {
  const words = byId("sought").value.toLowerCase().split(/\s+/).filter(Boolean);
  byId("hits").hidden = !words.length;
  if (!words.length) return;
  const hits = SECTIONS.map(section => ({ sum: fit(section, words), section })).filter(
    ({ sum }) => sum,
  );
  hits.sort((one, other) => other.sum - one.sum);
  byId("count").textContent =
    hits.length > MOST ? `${hits.length} sections, the best ${MOST}:` : `${hits.length} sections`;
  byId("found").replaceChildren(
    ...hits.slice(0, MOST).map(({ section }) => {
      const item = element("li");
      const link = element(
        "a",
        section.title === section.page ? section.page : `${section.page}: ${section.title}`,
      );
      link.href = root + section.to;
      link.addEventListener("click", () => (byId("hits").hidden = true));
      item.append(link, excerpt(section, words));
      return item;
    }),
  );
}

byId("sought").addEventListener("input", search);
byId("search").addEventListener("submit", event => {
  event.preventDefault();
  byId("found").querySelector("a")?.click();
});
document.addEventListener("keydown", event => {
  if (event.key === "Escape") byId("hits").hidden = true;
  if (
    event.key === "/" &&
    !/^(INPUT|TEXTAREA|SELECT)$/.test(document.activeElement?.tagName ?? "")
  ) {
    event.preventDefault();
    byId("sought").focus();
  }
});

// --- contents ------------------------------------------------------------------------------------

const contents = there(document.querySelector("nav details"));
const small = matchMedia("(max-width: 52rem)");
const fold = () => (contents.open = !small.matches);
small.addEventListener("change", fold);
fold();

// --- gallery -------------------------------------------------------------------------------------

/**
 * Put the cards of each kind into a grid, and a box for each effect into the filter.
 * @param {PageElement} filter
 */
function gallery(filter) {
  for (const kind of document.querySelectorAll("main > h2")) {
    const grid = element("div");
    grid.className = "cards";
    while (kind.nextElementSibling?.matches(".card")) grid.append(kind.nextElementSibling);
    if (grid.children.length) kind.after(grid);
  }
  const cards = [...document.querySelectorAll(".card")];
  const shows = new Map(
    cards.map(card => [card, (card.dataset.shows ?? "").split(", ").filter(Boolean)]),
  );
  const effects = [...new Set([...shows.values()].flat())].sort();
  for (const effect of effects) {
    const label = element("label");
    const box = Object.assign(element("input"), { type: "checkbox", value: effect });
    label.append(box, ` ${effect}`);
    there(filter.querySelector("fieldset")).append(label);
  }
  const update = () => {
    const wanted = [...filter.querySelectorAll(":checked")].map(box => box.value);
    for (const [card, own] of shows) card.hidden = !wanted.every(effect => own.includes(effect));
    for (const grid of document.querySelectorAll(".cards")) {
      const empty = !grid.querySelector(":scope > :not([hidden])");
      grid.hidden = empty;
      grid.previousElementSibling?.toggleAttribute("hidden", empty);
    }
    byId("left").textContent =
      `${cards.filter(card => !card.hidden).length} of ${cards.length} scenes`;
  };
  filter.addEventListener("change", update);
  there(document.querySelector("main > h2")).before(filter);
  filter.hidden = false;
  update();
  document.querySelector(`[id="${decodeURIComponent(location.hash.slice(1))}"]`)?.scrollIntoView();
}

const filter = document.getElementById("filter");
if (filter) gallery(filter);
