"""How still a page stays while its driver moves, and how long a frame takes meanwhile.

``python -m tests.bench.stillness`` drives pages through their range by single degrees in Chromium
at 1440 × 900 and counts labels that leap more than 12 dots at one degree, positions in which two
labels lie on one another, and labels that fade for want of room; then milliseconds from one frame
to the next, beside those of an empty loop in the same run.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import Any

from graphkin.mechanism import load
from graphkin.web.step_page import step_page
from tests.documents.sheet_tools import mechanism_named

SCENES = ("pump", "gears-ring", "stephenson-3")
STEP = 20
SIZE = {"width": 1440, "height": 900}
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
LEAPS = """async () => {
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
  for (let x = motion.low; x <= motion.high; x += 1) {
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
FRAMES = """async moving => {
  const motion = graphkinMotion, driver = document.getElementById("driver"), times = [];
  let last = await new Promise(requestAnimationFrame);
  for (let i = 0; i < 150; i++) {
    if (moving) {
      driver.value = motion.low + (motion.high - motion.low) * i / 150;
      driver.dispatchEvent(new Event("input"));
    }
    const now = await new Promise(requestAnimationFrame);
    times.push(now - last);
    last = now;
  }
  times.sort((p, q) => p - q);
  return [times[75], times[142]];
}"""


def page_of(name: str) -> str:
    """The page of a lab or a scene."""
    return step_page(load(name) if name == "pump" else mechanism_named(name), "en")


def counted(page: Any, path: Path, step: int = STEP) -> dict[str, int]:
    """What leaps, overlaps and fades on a page at one step."""
    page.add_init_script(BY_FRAMES)
    page.goto("about:blank")
    page.goto(f"{path.as_uri()}#step={step}")
    found: dict[str, int] = page.evaluate(LEAPS)
    return found


def main() -> None:
    """Print all counts and times."""
    from playwright.sync_api import sync_playwright

    from tests.browser.opening import ARGS

    with sync_playwright() as driver, tempfile.TemporaryDirectory() as folder:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=ARGS)
        page = browser.new_page(viewport=SIZE, reduced_motion="reduce")
        for name in SCENES:
            path = Path(folder, f"{name}.html")
            path.write_text(page_of(name), encoding="utf-8")
            print(name, counted(page, path))
            timed = browser.new_page(viewport=SIZE, reduced_motion="reduce")
            timed.goto(f"{path.as_uri()}#step={STEP}")
            empty, moving = (timed.evaluate(FRAMES, one) for one in (False, True))
            timed.close()
            print(f"  a frame, median and 95 %: {moving} ms; of an empty loop {empty} ms")
        browser.close()


if __name__ == "__main__":
    main()
