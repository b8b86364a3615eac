// Levels of a turn: goals with the fewest moves known, and stars for reaching them, for few moves and for exactness.
import { html_element } from "./elements.js";
import { byId } from "./page.js";
import { all_done, moves, ORDER, picks, turn, turning, worded } from "./turn_state.js";

const goals_in = plane => ORDER.filter(step => moves[step].goal && moves[step].plane === plane);

/** The goals of each level: the first point that is found in a plan, and the points of each plan. */
const all_levels = () =>
  [
    {
      goals: goals_in(1)
        .filter(step => moves[step].action !== "lay_off")
        .slice(0, 1),
    },
    ...Object.keys(turning.plans).map(plan => ({ goals: goals_in(Number(plan)), plan })),
  ].filter(({ goals }) => goals.length);

/** The moves that lead to some goals from what a turn began with, by the ways given for them. */
function moves_to(goals, needs_of) {
  const found = new Set(),
    waiting = [...goals];
  while (waiting.length) {
    const step = waiting.pop();
    if (found.has(step) || moves[step].at < turn.from) continue;
    found.add(step);
    waiting.push(...needs_of(step));
  }
  return found;
}

const recorded_needs = step => moves[step].needs;
const shortest_needs = step =>
  turning.shorter[step]?.flatMap(key => picks[key].needs) ?? moves[step].needs;

/** How far a level is: its moves and the fewest known, and its stars; none where nothing of it was left to be drawn. */
function level_of({ goals, plan }) {
  const whole = moves_to(goals, recorded_needs),
    fewest = moves_to(goals, shortest_needs).size;
  if (!whole.size) return null;
  const made = turn.log.filter(({ step }) => whole.has(step)),
    number = made.length + turn.lines.length;
  const reached = all_done(goals),
    exact = made.every(({ how, wrong }) => how === "alone" && !wrong);
  const own = made.some(({ how }) => how !== "help"); // what the page alone has drawn earns nothing
  const name = plan ? turning.plans[plan] : moves[goals[0]].name;
  return {
    name,
    fewest,
    moves: number,
    reached,
    stars: reached && own ? 1 + Number(number <= fewest) + Number(exact) : 0,
  };
}

/** Show the levels with their stars, and say which one has just been reached. */
export function show_levels() {
  const levels = all_levels().map(level_of).filter(Boolean),
    before = turn.reached ?? [];
  byId("levels").replaceChildren(
    ...levels.map(level => {
      const item = html_element("li"),
        stars = html_element("span"),
        said = html_element("span");
      item.innerHTML = `${level.name} `;
      stars.textContent = "★".repeat(level.stars) + "☆".repeat(3 - level.stars);
      stars.setAttribute("aria-hidden", "true");
      said.className = "unseen";
      said.innerHTML = worded("level", level);
      item.append(stars, said);
      item.classList.toggle("reached", level.reached);
      return item;
    }),
  );
  turn.reached = levels.filter(({ reached }) => reached).map(({ name }) => name);
  return levels.find(({ name, reached }) => reached && !before.includes(name));
}
