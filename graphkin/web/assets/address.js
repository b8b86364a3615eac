// The step, and the driver's place, in the address.
let address = location.hash, keeping = 0;

/** Keep them there, once nothing has moved for a moment. */
function remember() {
  clearTimeout(keeping);
  keeping = setTimeout(keep, 120);
}

function keep() {
  if (location.hash !== address) return; // it leads elsewhere meanwhile
  const x = moved() ? `&x=${Number(state.x.toFixed(4))}` : "";
  try {
    history.replaceState(null, "", `#step=${state.step}${x}`);
  } catch { /* a page shown inside another may not */ }
  address = location.hash;
}

/** Go where it says. */
function follow_address() {
  address = location.hash;
  const said = new URLSearchParams(address.slice(1));
  const x = Number.parseFloat(said.get("x"));
  const step = Number.parseInt(said.get("step"), 10) || 0;
  if (motion) drive(Number.isFinite(x) ? x : motion.start);
  show(step);
}
