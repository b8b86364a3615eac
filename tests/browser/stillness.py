"""How still a page stays while its driver moves.

A page is driven through its range by single degrees in Chromium, and counted are labels that leap
more than 12 dots at one degree, positions in which two labels lie on one another, and labels that
fade for want of room, by a clock that counts frames, so that they hang on no machine.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from graphkin.mechanism import load
from graphkin.web.step_page import step_page
from tests.documents.sheet_tools import mechanism_named

STEP = 20
BY_FRAMES = """(() => {
  let now = 0, last = 0;
  const due = new Map(), paint = requestAnimationFrame.bind(window);
  performance.now = () => now;
  window.requestAnimationFrame = work => paint(() => work(now));
  window.setTimeout = (work, wait = 0) => (due.set(++last, [now + wait, work]), last);
  window.clearTimeout = one => due.delete(one);
  const tick = () => {
    now += 1000 / 60;
    for (const [one, [at, work]] of due) if (at <= now && due.delete(one)) work();
    paint(tick);
  };
  paint(tick);
})()"""
"""A clock that goes on by a sixtieth of a second at each frame, however long that takes."""
LEAPS = """async part => {
  const motion = graphkinMotion, driver = document.getElementById("driver");
  const frame = () => new Promise(done => requestAnimationFrame(done));
  const drive = async x => {
    driver.value = x;
    driver.dispatchEvent(new Event("input"));
    await frame();
    await frame();
  };
  const texts = ".sheet:not([hidden]) .view > svg .lettering > text:not(.later,.void,[visibility])";
  const met = (p, q) => { // two dots, and the air above and below letters, are no matter
    const [low, high] = [0.15 * p.height, 0.15 * q.height];
    return Math.min(p.right, q.right) - Math.max(p.left, q.left) > 2 &&
      Math.min(p.bottom - low, q.bottom - high) - Math.max(p.top + low, q.top + high) > 2;
  };
  const found = { positions: 0, leaps: 0, overlapping: 0, shown: 0, faded: 0 };
  let before = new Map();
  await drive(motion.low);
  for (let i = 0; i < 30; i++) await frame();
  const last = motion.low + part * (motion.high - motion.low);
  for (let x = motion.low; x <= last; x += 1) {
    await drive(x);
    const all = [...document.querySelectorAll(texts)].filter(text => !text.closest(".halo"));
    const seen = all.filter(text => !text.matches(".hushed"));
    const boxes = seen.map(text => text.getBoundingClientRect());
    found.positions += 1;
    found.shown += seen.length;
    found.faded += all.length - seen.length;
    found.overlapping += boxes.some((p, i) => boxes.slice(0, i).some(q => met(p, q)));
    const now = new Map(seen.map((text, i) => [text, boxes[i]]));
    for (const [text, { x: u, y: v, width, height }] of now) {
      const was = before.get(text);
      const half = was && [(width - was.width) / 2, (height - was.height) / 2];
      if (was && Math.hypot(u - was.x + half[0], v - was.y + half[1]) > 12) found.leaps += 1;
    }
    before = now;
  }
  return found;
}"""


def page_of(name: str) -> str:
    """The page of a lab or a scene."""
    return step_page(load(name) if name == "pump" else mechanism_named(name), "en")


def counted(page: Any, path: Path, part: float = 1.0) -> dict[str, int]:
    """What leaps, overlaps and fades on a page at one step, over a part of its range."""
    page.add_init_script(BY_FRAMES)
    page.goto("about:blank")
    page.goto(f"{path.as_uri()}#step={STEP}")
    found: dict[str, int] = page.evaluate(LEAPS, part)
    return found
