// Values and margins of a position: in the tables, in the sentences, and in the line of results.
import { html_element } from "./elements.js";
import { rates_read } from "./highlights.js";
import { significant, written } from "./numbers.js";
import { byId, copies, data, motion, state } from "./page.js";
import { crossings_of } from "./sentences.js";
import { here, sheets } from "./sheets.js";

/** The column of the size in each kind of table. */
const PLACE = { vectors: 3, turns: 1, slides: 1, sides: 2, balance: 1 };

/** Write a value into a row, by kind of table. */
const TOLD = {
  vectors(row, [, length, size], value) {
    const kind = row.closest("[data-kind]").dataset.kind;
    length.textContent = written(Math.abs(value) / data.scales[kind], 2);
    size.textContent = significant(Math.abs(value));
  },
  turns(row, [size, sense], value) {
    size.textContent = significant(Math.abs(value));
    sense.textContent = value ? data.sense[value > 0 ? 0 : 1] : "";
  },
  slides(row, [size, sense], value) {
    size.textContent = significant(Math.abs(value));
    sense.innerHTML = value ? data.slides[row.dataset.row][value > 0 ? 0 : 1] : "";
  },
};

const tables = [...document.querySelectorAll("#results table")].map(table => {
  const rows = [...table.querySelectorAll("[data-row]")];
  return {
    kind: table.className,
    rows: rows.map(row => ({
      row,
      cells: [...row.querySelectorAll("td")],
      asked: "asked" in row.dataset,
    })),
  };
});

/** Write the values of this position; during motion only those asked for or read off by the step. */
export function read() {
  const values = motion.values(state.x),
    going = state.going,
    read_now = new Set(rates_read().map(({ row }) => row));
  for (const { kind, rows } of tables) {
    const known = rows.filter(({ row }) => row.dataset.row in values);
    const sizes = known.map(({ row }) => Math.abs(values[row.dataset.row]));
    const noise = 1e-9 * Math.max(...sizes);
    known.forEach(({ row, cells, asked }, i) => {
      if (asked || !going || read_now.has(row.dataset.row))
        TOLD[kind](row, cells, sizes[i] > noise ? values[row.dataset.row] : 0);
    });
  }
  read_margins(going ? crossings_of(state.step) : document.querySelectorAll("#steps .crossing"));
  read_out();
}

/** Write the crossing angles and error factors at this position. */
function read_margins(lines) {
  const margins = motion.margins(state.x);
  for (const line of lines) {
    const sine = margins[line.dataset.of];
    if (sine === undefined) continue;
    const angle = Math.asin(Math.min(Math.max(sine, 0), 1));
    line.querySelector(".angle").textContent = written((angle * 180) / Math.PI, 0);
    line.querySelector(".factor").textContent = angle
      ? significant(1 / Math.sin(angle / 2), 2)
      : "∞";
  }
}

/** Show below the slider the quantities that the current sheet asks for. */
export function read_out() {
  byId("values").replaceChildren(...all_asked(sheets[here()].element.dataset.kind));
}

export const found = [...document.querySelectorAll("#results [data-found]")];

/** The quantities asked for on a sheet, one line each, with their values where they are known. */
export function all_asked(kind, is_known) {
  const rows = document.querySelectorAll(`[data-kind=${kind}] [data-asked]`);
  return [...rows].map(row => asked([...row.cells], is_known ?? !row.matches(".unknown")));
}

/** A quantity in one line: its name, then size and unit, or a question mark. */
export function asked(cells, is_known) {
  const value = html_element("span");
  value.append(...copies(cells[0]), " = ", ...(is_known ? size_read(cells) : ["?"]));
  return value;
}

/** The size, unit and sense of a row. */
export function size_read(cells) {
  const table = cells[0].closest("table"),
    place = PLACE[table.className];
  const found = [...copies(cells[place]), " ", ...copies(table.tHead.rows[0].cells[place])];
  return place === 1 && cells[2].textContent ? [...found, ", ", ...copies(cells[2])] : found;
}
