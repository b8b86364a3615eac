// Bundles the modules of the pages, each program into one file: `node build.js`, or `node build.js FOLDER`.
import { build } from "esbuild";
import { mkdir, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const SOURCES = new URL("../../graphkin/web/assets/", import.meta.url);
const OUT = process.argv[2] ?? fileURLToPath(new URL("bundles", SOURCES));

/** The programs: the first module, the condition of its `#` imports, and what it gives to the page. */
const PROGRAMS = {
  step: { entry: "keys.js" },
  board: { entry: "board.js", conditions: ["board"] },
  player: { entry: "player.js" },
  form: { entry: "form.js" },
  moving: { entry: "moving.js", gives: "moving", as: "graphkinMoving" },
  moving_closed: { entry: "moving_closed.js", gives: "moving_closed", as: "graphkinMoving" },
};

/** A module in one file as a script: its names are hidden, but for the one that it gives. */
function as_script(text, gives, as) {
  if (!gives) return `(()=>{"use strict";${text.trim()}})();\n`;
  const [exported, own] = text.match(/export\{(\S+) as \S+\};?\s*$/);
  return `const ${as}=(()=>{"use strict";${text.replace(exported, "").trim()}return ${own}})();\n`;
}

await mkdir(OUT, { recursive: true });
for (const [name, { entry, gives, as, conditions = [] }] of Object.entries(PROGRAMS)) {
  const { outputFiles } = await build({
    stdin: {
      contents: gives ? `export { ${gives} } from "./${entry}"` : `import "./${entry}"`,
      resolveDir: fileURLToPath(SOURCES),
    },
    write: false,
    bundle: true,
    minify: true,
    treeShaking: true,
    format: "esm",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    logLevel: "warning",
    conditions,
  });
  await writeFile(`${OUT}/${name}.js`, as_script(outputFiles[0].text, gives, as));
}
