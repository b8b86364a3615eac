// Keys and pointers while something is drawn: they belong to the drawing before all else.
/** During a turn, keep keys and pointers on the drawing from other handlers. */
function in_turn(event) {
  if (!turn) return;
  const typed = event.type === "keydown", drawing = event.target.closest?.(".sheet");
  if (typed) {
    const zooms = event.target.closest?.("svg") && ["+", "=", "-", "0"].includes(event.key);
    if (event.key === "F5" || zooms) return;
    event.stopPropagation();
    return key_in_turn(event);
  }
  if (event.type.startsWith("pointer") && event.type !== "pointerover") {
    if ((drawing || press) && point_in_turn(event)) event.stopPropagation();
    if (!drawing && !press && turn.aim && event.type === "pointermove") show_aim(null);
    return;
  }
  const fits_all = event.type === "dblclick" && !hits_at(spot_at(event)).length; // nothing is meant but the whole field
  if (drawing && !fits_all) event.stopPropagation();
}

const EVENTS = ["keydown", "click", "dblclick", "pointerover", "pointerdown", "pointermove", "pointerup", "pointercancel"];
