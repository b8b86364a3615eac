// Opening and saving, and the questions before anything is replaced or lost.

import { picture } from "./build.js";
import { sentence } from "./mistakes.js";
import { sheetsShown } from "./motion.js";
import { values } from "./sliders.js";
import { ask, button, element, find, language, listed, say, tell } from "./talk.js";

for (const button of document.querySelectorAll("dialog .close")) {
  button.addEventListener("click", () => button.closest("dialog").close());
}

/** The answer to a question: "yes", "other" where there is an alternative, or empty; `lines` are
 * its details. */
export function agreed(question, yes, other = "", lines = []) {
  const dialog = find("asking");
  find("question").textContent = question;
  find("asked-lines").textContent = lines.join("\n");
  find("asked-lines").hidden = !lines.length;
  find("yes").textContent = yes;
  find("other").textContent = other;
  find("other").hidden = !other;
  dialog.returnValue = "";
  dialog.showModal();
  find("no").focus();
  return new Promise(resolve => {
    find("yes").onclick = () => dialog.close("yes");
    find("other").onclick = () => dialog.close("other");
    find("no").onclick = () => dialog.close();
    dialog.onclose = () => resolve(dialog.returnValue);
  });
}

/** Save something, and ask first where files exist; null if the user refuses. */
export async function saved(what, fields) {
  let answer = await ask(what, fields);
  if (answer.exist.length) {
    const list = answer.exist.join(", ");
    const question = say(fields.mark ? "studio.changed" : "studio.exist", { list });
    if (!(await agreed(question, say("studio.replace"), "", answer.changes))) return null;
    answer = await ask(what, { ...fields, replace: true });
  }
  return answer;
}

/** Draw the pictures of items that come into view, one after another. */
function pictured(items) {
  let last = Promise.resolve();
  const seen = new IntersectionObserver(entries => {
    for (const { target, isIntersecting } of entries) {
      if (!isIntersecting) continue;
      seen.unobserve(target);
      last = last
        .then(async () => {
          if (!find("opening").open) return;
          const { key: kind, name } = target.dataset;
          const { sketch } = await ask("picture", { kind, name });
          if (sketch) target.prepend(picture(sketch));
        })
        .catch(() => {});
    }
  });
  for (const item of items) seen.observe(item);
  find("opening").addEventListener("close", () => seen.disconnect(), { once: true });
}

/** Show only entries whose name or title contains every word of the search. */
function seek() {
  const words = find("sought").value.toLowerCase().split(/\s+/);
  for (const list of find("opening").querySelectorAll("ul")) {
    for (const item of list.querySelectorAll(":scope > li")) {
      const name = item.querySelector("[data-key]").textContent.toLowerCase();
      item.hidden = !words.every(word => name.includes(word));
    }
  }
}

find("sought").addEventListener("input", seek);

/** Let the user choose a scene or a lab; `go` receives the address that opens it. */
export async function choose(go) {
  const { scenes, more, labs, examples } = await listed();
  const opener = (key, name, words) =>
    button(words, () => {
      find("opening").close();
      go(`?${key}=${encodeURIComponent(name)}`);
    });
  const entry = (key, name, title = "") => {
    const item = element("li");
    const shown = opener(key, name, title ? `${name} – ${title}` : name);
    Object.assign(shown.dataset, { key, name });
    item.append(shown);
    if (key === "scene") {
      const like = opener("like", name, say("studio.like"));
      like.setAttribute("aria-label", `${like.textContent}: ${name}`);
      item.append(like);
    }
    return item;
  };
  find("scenes").replaceChildren(...scenes.map(name => entry("scene", name)));
  find("labs").replaceChildren(...labs.map(([name, title]) => entry("lab", name, title)));
  find("examples").replaceChildren(
    ...examples.map(([name, title]) => entry("example", name, title)),
  );
  find("no-scenes").hidden = scenes.length > 0;
  find("more-scenes").textContent = more;
  find("from-nothing").onclick = () => {
    find("opening").close();
    go("?empty=yes");
  };
  find("sought").value = "";
  find("opening").showModal();
  pictured(find("opening").querySelectorAll("li [data-key]"));
}

/** Let the user choose file formats, then draw and save the sheets; `fields` gives the current
 * scene, `left` says what remains unsaved. */
export function saveSheets(fields, left) {
  const dialog = find("saving");
  const said = find("saving-said");
  const list = values()
    .map(([name, value]) => `${name} = ${value}`)
    .join(", ");
  said.textContent = "";
  find("saving-values").textContent = list && say("studio.drawn_for", { values: list });
  find("sheet-language").value = language;
  find("view").value = sheetsShown() || find("view").value;
  find("saving-form").onsubmit = async event => {
    event.preventDefault();
    const formats = [...dialog.querySelectorAll("[name=formats]:checked")].map(box => box.value);
    if (!formats.length) {
      said.textContent = say("studio.no_files");
      return;
    }
    said.textContent = say("studio.drawing_sheets");
    find("draw").disabled = true;
    try {
      const chosen = {
        formats,
        view: find("view").value,
        language: find("sheet-language").value,
        page_language: language,
      };
      const answer = await saved("sheets", { ...fields(), ...chosen });
      said.textContent = "";
      if (answer?.problems.length) said.textContent = answer.problems.map(sentence).join(" ");
      else if (answer) {
        tell(
          [say("studio.saved", { list: answer.files.join(", ") }), left()]
            .filter(Boolean)
            .join("; "),
        );
        dialog.close();
      }
    } catch (error) {
      said.textContent = error.message;
    } finally {
      find("draw").disabled = false;
    }
  };
  dialog.showModal();
}
