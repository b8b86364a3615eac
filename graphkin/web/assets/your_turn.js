// Your turn: hints, help, the score sheet, and what the keys and the drawing do meanwhile.
/** All is drawn, or the reader has had enough: what was done alone, with a hint or not at all. */
function show_score() {
  const count = how => turn.log.filter(one => one.how === how).length;
  const wrong = turn.wrong + turn.log.reduce((sum, one) => sum + one.wrong, 0);
  const line = document.createElement("p"), list = document.createElement("ol");
  line.innerHTML = worded("score", { all: turn.log.length, alone: count("alone"), hint: count("hint"), help: count("help"), wrong, left: moves_left().length });
  for (const { step, how, wrong: turns } of turn.log) {
    const item = document.createElement("li");
    item.className = how;
    item.innerHTML = `${moves[step].name}: ${worded(how === "alone" ? how : `with_${how}`)}${turns ? `, ${worded("wrong", { number: turns })}` : ""}`;
    list.append(item);
  }
  byId("score").replaceChildren(line, list);
  byId("score").hidden = false;
  if (!moves_left().length) tell_turn(worded("complete"));
}

/** What happens on the drawing and on the keys is the turn's own while it lasts. */
function in_turn(event) {
  if (!turn) return;
  const drawing = event.target.closest?.(".sheet"), typed = event.type === "keydown";
  if (typed ? event.key === "F5" : !drawing) return;
  if (event.type === "pointerdown" && !event.target.closest("[data-of]")) return; // the field itself may be shifted
  event.stopPropagation();
  if (event.type === "click") take_at(event);
  if (typed && event.key === "Escape") {
    forget_inputs();
    show_picks();
  }
}

/** Begin to listen, where there is something to draw. */
if (byId("turn")) {
  for (const type of ["keydown", "click", "pointerover", "pointerdown"]) document.addEventListener(type, in_turn, true);
  byId("turn").addEventListener("click", begin_turn);
  byId("turn-end").addEventListener("click", end_turn);
  byId("turn-score").addEventListener("click", show_score);
  byId("hint").addEventListener("click", give_hint);
  byId("draw-it").addEventListener("click", draw_it);
  byId("turn-sheet").addEventListener("click", () => {
    turn.sheet = (here() + 1) % sheets.length;
    show_turn();
  });
  byId("turn-form").addEventListener("submit", event => {
    event.preventDefault();
    draw_move();
  });
  for (const button of byId("palette").children) button.addEventListener("click", () => choose_action(button.dataset.action));
  addEventListener("hashchange", () => { if (turn) end_turn(); });
}
