// The page's requests to the studio, and the words of the page.

const start = JSON.parse(document.body.dataset.start);
export let language = start.language;
const tab = crypto.randomUUID();

/** A sentence of the page with its gaps filled. */
export function say(key, gaps = {}) {
  return start.words[language][key].replace(/\{(\w+)\}/g, (whole, name) => gaps[name] ?? whole);
}

/** The answer of the studio; throws an error with a sentence if there is none. */
export async function ask(what, fields) {
  let answer;
  try {
    answer = await fetch(what, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ tab, language, ...fields }),
    });
  } catch {
    throw new Error(say("studio.gone"));
  }
  if (!answer.ok) throw new Error(say(answer.status === 403 ? "studio.gone" : "studio.failed"));
  return answer.json();
}

/** The files that can be opened: own scenes, labs, and the scenes of the program. */
export async function listed() {
  try {
    return await (await fetch(`scenes?lang=${language}`)).json();
  } catch {
    throw new Error(say("studio.gone"));
  }
}

export const find = id => document.getElementById(id);

/** A new element of the page. */
export function element(name, words = "", look = "") {
  const made = document.createElement(name);
  made.textContent = words;
  made.className = look;
  return made;
}

/** A new button with its action. */
export function button(words, work, look = "") {
  const made = element("button", words, look);
  made.type = "button";
  made.addEventListener("click", work);
  return made;
}

const listeners = [];

/** Call back when the language changes. */
export function onSpeaking(work) {
  listeners.push(work);
}

/** Change the language and rewrite the words of the page. */
export function speak(chosen) {
  language = chosen;
  document.documentElement.lang = chosen;
  for (const element of document.querySelectorAll("[data-say]")) {
    element.textContent = say(element.dataset.say);
  }
  for (const element of document.querySelectorAll("[data-label]")) {
    element.setAttribute("aria-label", say(element.dataset.label));
  }
  for (const work of listeners) work();
}

const status = find("status");

/** Show a message at the top of the page: `look` is "wrong" for a failure, "poor" for a warning. */
export function tell(words, look = "") {
  if (status.textContent !== words) status.textContent = words;
  status.className = look;
}
