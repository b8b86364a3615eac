// What a student draws is checked by its value; for a wrong choice the page says why.
function draw_move() {
  if (!is_complete()) return;
  const { action } = turn, given = turn.inputs.slice(0, slots().length), plane = plane_of(action, given);
  const found = results_of(action, given);
  if (CHOICE.includes(action) && found.length > 1 && !all_alike(action, found, plane)) {
    const apart = found.filter((one, i) => found.findIndex(other => same_value(action, one, other, plane)) === i);
    const at_keys = keys_within();
    turn.asked = Object.assign(apart, { plane, given });
    tell_turn(worded("which"));
    show_picks();
    if (at_keys) byId("which").querySelector("button").focus({ preventScroll: true });
    return;
  }
  check_move(action, given, found, plane);
}

const all_alike = (action, found, plane) => found.every(one => same_value(action, one, found[0], plane));

/** Go on with the result that the student has chosen out of two. */
function settle_which(which) {
  const { given, plane } = turn.asked, found = [turn.asked[which]];
  const other = turn.asked[1 - which];
  if (keys_within()) byId("inputs").querySelector("select").focus({ preventScroll: true });
  turn.asked = null;
  check_move(turn.action, given, found, plane, other);
}

/** Whether the keyboard focus is in the lists, where it must stay. */
const keys_within = () => byId("turn-form").contains(document.activeElement);

/** The move that gives one of some values; moves still to be made come first. */
function giving(action, given, found, plane, among) {
  const kind = shape_of(action);
  const ends = among.filter(step => moves[step].plane === plane && shape_of(moves[step].action) === kind)
    .filter(step => !["coincide", "similar"].includes(action) || turning.places[step]?.map(String).includes(given[action === "similar" ? 2 : 0]))
    .filter(step => found.some(value => same_value(action, value, moves[step].value, plane)));
  return ends.find(step => alike_inputs(moves[step], action, given) === given.length) ?? ends.find(step => turn.rest.has(step)) ?? ends[0];
}

/** The number of inputs of a move that equal those given; commuting inputs count in either order. */
function alike_inputs(move, action, given) {
  if (move.action !== action) return -1;
  const own = move.inputs.map(key => picks[key].by || key);
  const count = inputs => inputs.filter((key, i) => key === given[i]).length;
  return commutes(action) ? Math.max(count(own), count([own[1], own[0], ...own.slice(2)])) : count(own);
}

const commutes = action => ["cut", "join", "divide", "similar"].includes(action);

function check_move(action, given, found, plane, other) {
  turn.rest = new Set(moves_left());
  const open = ORDER.filter(step => !turn.done.has(step));
  const step = giving(action, given, found, plane, open);
  if (step !== undefined) return make_move(step, turn.hinted === step ? "hint" : "alone", worded("right", { name: moves[step].name }));
  const before = giving(action, given, found, plane, [...turn.done].filter(one => moves[one]));
  if (before !== undefined) return refuse_move(worded("already", { name: moves[before].name }));
  if (other && giving(action, given, [other], plane, open) !== undefined) {
    const meant = giving(action, given, [other], plane, open);
    const [omega, sense] = moves[meant].turns ?? [];
    const { name, about = name } = moves[meant];
    return refuse_move(worded(omega ? "other_turned" : `other_${action}`, { name, about, omega, sense }), meant);
  }
  const lies = found.length && shape_of(action) !== "point" && shape_of(action) !== "vector" && leads_to(found[0], plane, open);
  if (lies !== undefined && lies !== false && found.length) return keep_own(action, given, lies);
  return why_wrong(action, given);
}

/** A point that is still to be found and lies on a line or arc. */
function leads_to(curve, plane, open) {
  return open.find(step => moves[step].goal && moves[step].plane === plane && shape_of(moves[step].action) === "point" &&
    on_line(moves[step].value, curve) < SAME * Math.max(size_of(plane), length_of(moves[step].value)));
}

/** Keep a line that no sentence draws but that passes through a wanted point; it can be picked. */
function keep_own(action, given, step) {
  add_line(action, given, here());
  turn.fresh = [];
  forget_inputs();
  tell_turn(worded("own", { name: moves[step].name }));
  show_turn();
}

/** Make a line drawn from some picks on a sheet available as a pick. */
function add_line(action, given, sheet) {
  const name = named_from(action, given.map(one => picks[one].name), turning.words), [value] = results_of(action, given);
  picks[`own${turn.lines.push([action, given, sheet])}`] = { kind: shape_of(action) === "circle" ? "circle" : "locus", name, plane: plane_of(action, given), needs: [], value, sheet };
}

/** Say why a choice is wrong, by the move most similar to it. */
function why_wrong(action, given) {
  const near = moves_left().filter(step => moves[step].action === action).map(step => {
    const own = moves[step].inputs.map(key => picks[key].by || key);
    const turned = commutes(action) ? [own[1], own[0], ...own.slice(2)] : own;
    const count = inputs => inputs.filter((key, i) => key === given[i]).length;
    const inputs = count(turned) > count(own) ? turned : own;
    const first = inputs.findIndex((key, i) => key !== given[i]);
    return { step, inputs, first, weight: 4 * count(inputs) + 2 * (inputs[0] === given[0]) + all_done(moves[step].needs) };
  }).filter(({ weight, first }) => weight >= 4 && first >= 0).sort((a, b) => b.weight - a.weight)[0];
  if (!near) return refuse_move(worded("nowhere"), null);
  const { step, inputs, first } = near, name = key => picks[key].name;
  const others = inputs.filter((_, i) => i !== first).map(name).join(", ");
  refuse_move(worded(reason_key(action, first), { name: moves[step].name, about: moves[step].about ?? moves[step].name, right: name(inputs[first]), chosen: name(given[first]), other: others }), step);
}

/** The message key for an input: equal inputs share one, and Klein's construction uses the triangle's. */
function reason_key(action, slot) {
  const own = `${action === "klein" ? "triangle" : action}_`;
  return own + Array.from({ length: slot + 1 }, (_, i) => slot - i).find(i => `${own}${i}` in turning.words);
}

/** Record a move and draw what comes along with it. */
function make_move(step, how, words) {
  const before = new Set(turn.done), { value, plane, action } = moves[step];
  turn.done.add(step);
  if (["line", "circle"].includes(shape_of(action))) { // lines or circles at one place are drawn together
    for (const one of ORDER) if (shape_of(moves[one].action) === shape_of(action) && moves[one].plane === plane && all_done(moves[one].needs) && same_value(action, moves[one].value, value, plane)) turn.done.add(one);
  }
  turn.log.push({ step, how, wrong: turn.wrong });
  turn.wrong = 0;
  turn.hinted = null;
  const came = ([, needs]) => needs.length && all_done(needs) && !needs.every(one => before.has(one));
  const at_keys = keys_within(), unknown = found.filter(row => row.matches(".unknown"));
  turn.fresh = [step, ...Object.entries(turning.along).filter(came).map(([one]) => Number(one))];
  turn.sheet = null;
  forget_inputs();
  const done = moves_left().every(one => part_of(one) !== part_of(step));
  tell_turn(done ? `${words} ${worded("part_drawn", { part: part_name(step) })}` : words);
  show_turn();
  const { at } = moves[step], rest = moves_left(), sentence = document.createElement("p");
  if (!rest.some(one => moves[one].at === at)) sentence.append(...copies(places[at - 1].say));
  byId("turn-sentence").replaceChildren(...told_found(unknown), sentence, ...reasons_of(step));
  if (at_keys) byId("palette").querySelector(`[data-action=${action}]`).focus({ preventScroll: true });
}

/** Refuse a move and give the reason for the intended step, if any; repeating a step is no error. */
function refuse_move(words, meant) {
  const at_keys = keys_within();
  if (meant !== undefined) turn.wrong += 1;
  byId("turn-sentence").replaceChildren(...(meant ? reasons_of(meant) : []));
  turn.inputs = [];
  turn.fresh = [];
  tell_turn(words);
  show_picks();
  show_again();
  if (!byId("score").hidden) show_score();
  if (at_keys) byId("inputs").querySelector("select").focus({ preventScroll: true });
}

/** Highlight the inputs of a possible next step and name its action. */
function give_hint() {
  const step = next_move();
  if (step === undefined) return;
  turn.hinted = step;
  turn.sheet = null;
  forget_inputs();
  show_turn();
  tell_hint();
  byId("turn-sentence").replaceChildren(...reasons_of(step));
}

/** Name the action of the hint and its inputs. */
function tell_hint() {
  const { action, inputs } = moves[turn.hinted], words = slot_words(action), list = inputs.map((key, i) => `${words[i]} ${picks[picks[key].by || key].name}`).join(", ");
  tell_turn(worded("hint", { action: action_name(action), list }));
}

/** Draw a possible next step. */
function draw_it() {
  const step = next_move();
  if (step !== undefined) make_move(step, "help", worded("helped", { name: moves[step].name, action: action_name(moves[step].action) }));
}
