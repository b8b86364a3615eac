// A step: the drawing up to its sentence.

/** Show a step. */
function show(step) {
  const before = state.step;
  state.step = Math.min(Math.max(Math.round(step) || 0, 0), last);
  state.over = null;
  sheets.forEach(({ element }, i) => { element.hidden = i !== here(); });
  for (const mark of sheets[here()].marks) {
    const at = Number(mark.dataset.at);
    mark.classList.toggle("later", at > state.step);
    mark.classList.toggle("now", at > 0 && at === state.step);
  }
  for (const part of sheets[here()].parts) part.classList.toggle("later", Number(part.dataset.from) > state.step);
  for (const row of found) row.classList.toggle("unknown", Number(row.dataset.found) > state.step);
  slider.value = state.step;
  byId("previous").disabled = state.step === 0;
  byId("next").disabled = state.step === last;
  begin();
  if (state.going && !state.dead) read();
  say();
  if (motion) {
    read_out();
    put();
    follow_pins();
  }
  trace();
  if (state.step === before + 1) write();
  else lift();
  remember();
}

/** Show a step that the reader has chosen, and stop playing. */
function go(step) {
  pause();
  show(step);
}
