// Files that a page saves and opens again: tables of answers as `graphkin grade` reads them.
export const HEADS = ["field", "value"];
export const TABLE = "text/csv;charset=utf-8";

/** A text without invisible signs and without blanks around it. */
export const clean = text =>
  text
    .replace(/[\p{Cc}\p{Cf}\p{Cs}]/gu, "")
    .trim()
    .normalize("NFC");

/** A cell, in quotes where necessary. */
export const quoted = text => (/[",;\t\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** The rows of a table as text, with any of the usual separators. */
export function rows_of(text) {
  const first = text.split(/\r?\n/, 1)[0];
  const separator = [";", ",", "\t"].find(sign => first.includes(sign)) ?? ",";
  const rows = [[""]];
  let quoted = false;
  for (let i = 0; i < text.length; i++) {
    const sign = text[i];
    const row = rows.at(-1);
    if (quoted && sign === '"' && text[i + 1] === '"') row[row.length - 1] += text[++i];
    else if (sign === '"') quoted = !quoted;
    else if (!quoted && sign === separator) row.push("");
    else if (!quoted && sign === "\n") rows.push([""]);
    else row[row.length - 1] += sign;
  }
  return rows.map(row => row.map(text => clean(text).replace(/(^|;[\s"]*)'(?=[=+\-@])/g, "$1")));
}

/**
 * Save a text as a file of the browser.
 * @param {string} name
 * @param {string} text
 * @param {string} type
 */
export function save_file(name, text, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
