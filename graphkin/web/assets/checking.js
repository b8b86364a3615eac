// What a student draws is checked by its value; a right move is made, a wrong one answered.
/** The move that gives one of some values; moves still to be made come first. */
function giving(action, given, found, plane, among) {
  const kind = shape_of(action);
  const ends = among.filter(step => moves[step].plane === plane && shape_of(moves[step].action) === kind)
    .filter(step => !["coincide", "similar"].includes(action) || turning.places[step]?.map(String).includes(given[action === "similar" ? 2 : 0]))
    .filter(step => found.some(value => same_value(action, value, moves[step].value, plane)));
  return ends.find(step => alike_inputs(moves[step], action, given) === given.length) ?? ends.find(step => turn.rest.has(step)) ?? ends[0];
}

/** The inputs of a move in the order in which most of them equal those given: commuting ones may change places. */
function own_inputs(move, given) {
  const own = move.inputs.map(key => picks[key].by || key);
  const turned = commutes(move.action) ? [own[1], own[0], ...own.slice(2)] : own;
  return count_alike(turned, given) > count_alike(own, given) ? turned : own;
}

const count_alike = (inputs, given) => inputs.filter((key, i) => key === given[i]).length;
const alike_inputs = (move, action, given) => move.action === action ? count_alike(own_inputs(move, given), given) : -1;
const commutes = action => ["cut", "join", "divide", "similar"].includes(action);

function check_move(action, given, found, plane, other) {
  turn.rest = new Set(moves_left());
  const open = ORDER.filter(step => !turn.done.has(step));
  const step = giving(action, given, found, plane, open);
  if (step !== undefined) return make_move(step, turn.hinted === step ? "hint" : "alone", worded("right", { name: moves[step].name }), { action, given });
  const before = giving(action, given, found, plane, [...turn.done].filter(one => moves[one]));
  if (before !== undefined) return refuse_move(worded("already", { name: moves[before].name }));
  const meant = other && giving(action, given, [other], plane, open);
  if (meant !== undefined) return refuse_other(meant, action, found[0], plane, given);
  const curve = found.length && !["point", "vector"].includes(shape_of(action));
  const lies = curve ? leads_to(found[0], plane, open) : undefined;
  if (lies !== undefined) return keep_own(action, given, lies);
  return why_wrong(action, given, found, plane);
}

/** A point that is still to be found and lies on a line or arc. */
function leads_to(curve, plane, open) {
  return open.find(step => moves[step].goal && moves[step].plane === plane && shape_of(moves[step].action) === "point" &&
    on_line(moves[step].value, curve) < SAME * Math.max(size_of(plane), length_of(moves[step].value)));
}

/** Keep a line that no sentence draws but that passes through a wanted point; it can be picked. */
function keep_own(action, given, step) {
  keep_past();
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

/** Draw the lines that no sentence draws. */
function draw_own() {
  for (const key of Object.keys(picks).filter(one => one.startsWith("own") && is_there(one))) put_in("front", shown_at(key), "own");
}

/** The ways in which a move can be found, the least of a student's own work last. */
const HOW = ["alone", "hint", "help"];

/** Record a move and draw what comes along with it. */
function make_move(step, how, words, way = moves[step]) {
  const before = new Set(turn.done), { action } = moves[step];
  const at_keys = keys_within(), unknown = found.filter(row => row.matches(".unknown"));
  keep_past();
  turn.done.add(step);
  if (["line", "circle"].includes(shape_of(action))) lines_alike(step).forEach(one => turn.done.add(one));
  turn.helped[step] = HOW[Math.max(HOW.indexOf(how), HOW.indexOf(turn.helped[step]))];
  turn.log.push({ step, how: turn.helped[step], wrong: turn.wrong });
  turn.wrong = 0;
  turn.hinted = null;
  const came = ([, needs]) => needs.length && all_done(needs) && !needs.every(one => before.has(one));
  turn.fresh = [step, ...Object.entries(turning.along).filter(came).map(([one]) => Number(one))];
  turn.sheet = null;
  forget_inputs();
  const done = moves_left().every(one => part_of(one) !== part_of(step));
  tell_turn(done ? `${words} ${worded("part_drawn", { part: part_name(step) })}` : words);
  show_turn();
  explain_move(step, way, unknown);
  if (at_keys) byId("palette").querySelector(`[data-action=${action}]`).focus({ preventScroll: true });
}

/** Lines or circles at the place of a move's, which are drawn together with it. */
function lines_alike(step) {
  const { action, plane, value } = moves[step];
  return ORDER.filter(one => shape_of(moves[one].action) === shape_of(action) && moves[one].plane === plane && all_done(moves[one].needs) && same_value(action, moves[one].value, value, plane));
}

/** Say what a move has found, its sentence, and the reason of the way taken. */
function explain_move(step, way, unknown) {
  const { at, action } = moves[step], sentence = document.createElement("p"), whole = !moves_left().some(one => moves[one].at === at);
  if (whole && way.action === action) sentence.append(...copies(places[at - 1].say));
  byId("turn-sentence").replaceChildren(...told_found(unknown), sentence, ...reasons_of_way(step, way));
}

/** The reasons of a move as it was made: those of its step, or of the other way that was taken. */
function reasons_of_way(step, { action, given }) {
  if (action === moves[step].action) return reasons_of(step);
  const key = `way_${action}`, line = document.createElement("p");
  if (!(key in turning.words)) return [];
  line.innerHTML = worded(key, { name: moves[step].name, p: place_named(given[0]), q: place_named(given[1]), r: picks[given[2]]?.name });
  return [line];
}

/** The name of the point of the mechanism whose image a pick is. */
const place_named = image => picks[turning.places[image]?.[0]]?.name ?? "";
