// A step: the drawing as it stands there.

/** Show it. */
function show(step) {
  state.step = Math.min(Math.max(Math.round(step) || 1, 1), last);
  state.over = null;
  sheets.forEach(({ element }, i) => { element.hidden = i !== here(); });
  for (const mark of sheets[here()].marks) {
    const at = Number(mark.dataset.at);
    mark.classList.toggle("later", at > state.step);
    mark.classList.toggle("now", at === state.step);
  }
  slider.value = state.step;
  byId("previous").disabled = state.step === 1;
  byId("next").disabled = state.step === last;
  say();
  if (motion) read_out();
  trace();
  remember();
}

/** Show what one has chosen: from then on nothing goes by itself. */
function go(step) {
  pause();
  show(step);
}
