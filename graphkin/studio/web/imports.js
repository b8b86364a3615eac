// Files, links and texts of other programs, as scenes; and the manual's page of the key at the caret.

import { sentence } from "./mistakes.js";
import { ask, find, say } from "./talk.js";

const MOST = 512 * 1024; // bytes of a file
const FOREIGN =
  /^\s*(https?:\/\/\S+\?|<\?xml|<linkage|<geogebra|M\[\s*J\[|joints\s*\n|\{\s*"|0\s*\n\s*SECTION)/;
let file = null; // the name and the content of the chosen file, in base 64

/** The content of a file in base 64. */
async function read(chosen) {
  if (chosen.size > MOST) throw new Error(say("studio.too_large", { name: chosen.name }));
  const bytes = new Uint8Array(await chosen.arrayBuffer());
  return btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(""));
}

/** Import what is chosen or pasted; `take` gets the text of a scene, its file name and the notes. */
export function importing(take) {
  const status = find("import-said");
  const fields = () => {
    const words = Object.fromEntries(
      ["fixed", "drive", "slides"].map(key => [key, find(`import-${key}`).value]),
    );
    return { ...words, ...(file ?? { pasted: find("import-pasted").value }) };
  };
  async function bring(given = fields()) {
    status.textContent = "";
    try {
      const { problems, drawing, text, name, notes } = await ask("bring", given);
      find("import-drawing").hidden = !drawing && find("import-drawing").hidden;
      if (problems.length) {
        status.textContent = problems.map(sentence).join(" ");
        return status.textContent;
      }
      find("opening").close();
      await take(text, name, notes);
    } catch (error) {
      status.textContent = error.message;
    }
    return status.textContent;
  }
  find("import-file").addEventListener("change", async () => {
    const field = find("import-file"),
      [chosen] = field.files;
    field.value = "";
    if (!chosen) return;
    try {
      file = { file: await read(chosen), name: chosen.name };
      find("import-drawing").hidden = true;
      await bring();
    } catch (error) {
      status.textContent = error.message;
    }
  });
  find("import-pasted").addEventListener("input", () => (file = null));
  find("import").addEventListener("click", () => bring());
  find("opening").addEventListener("close", () => {
    file = null;
    status.textContent = "";
    find("import-pasted").value = "";
    find("import-drawing").hidden = true;
  });
  find("text").addEventListener("paste", async event => {
    const pasted = event.clipboardData.getData("text/plain");
    if (!FOREIGN.test(pasted)) return;
    event.preventDefault();
    const wrong = await bring({ pasted, fixed: "", drive: "", slides: "" });
    if (!wrong) return;
    find("open").click();
    find("import-pasted").value = pasted;
    status.textContent = wrong;
  });
}

/** Open the manual at the key at the caret of the text that was last written in. */
export function helping() {
  let last = find("text");
  for (const text of [find("text"), find("rules")])
    text.addEventListener("focus", () => (last = text));
  const open = async () => {
    const before = last.value.slice(0, last.selectionStart).split("\n");
    const [line, column] = [before.length - 1, before.at(-1).length];
    const page = window.open("", "graphkin-manual");
    const { address } = await ask("explain", { text: last.value, line, column });
    if (page) page.location.href = new URL(address, location.href).href;
  };
  find("help").addEventListener("click", open);
  addEventListener("keydown", event => {
    if (event.key !== "F1") return;
    event.preventDefault();
    open();
  });
}
