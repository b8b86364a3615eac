"""How still a page stays while its driver moves, and how long a frame takes meanwhile.

``python -m tests.bench.stillness`` drives pages through their range by single degrees in Chromium
at 1440 × 900 and counts labels that leap more than 12 dots at one degree, positions in which two
labels lie on one another, and labels that fade for want of room, by a clock that counts frames, so
that they hang on no machine; then milliseconds from one frame to the next while the mouse drags the
crank's pin, beside those of an empty loop in the same run, and the load of the machine.
"""

from __future__ import annotations

import os
import shutil
import statistics
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
WAY = """() => {
  const motion = graphkinMotion, svg = document.querySelector(".sheet:not([hidden]) .view > svg");
  const sheet = [...document.querySelectorAll(".sheet")].findIndex(one => !one.hidden);
  const from = motion.start, place = svg.getScreenCTM();
  const [id] = motion.grips[sheet].find(([id, , driven]) => driven && motion.place(id, from));
  const half = Math.min(40, motion.high - from, from - motion.low);
  return Array.from({ length: 150 }, (_, i) => {
    const [u, v] = motion.place(id, from + half * Math.sin(2 * Math.PI * i / 150));
    const { x, y } = new DOMPoint(u, v).matrixTransform(place);
    return [x, y];
  });
}"""
"""The way of the pin that the driver turns, to and fro, in dots of the window."""
RECORD = """() => {
  const times = window.frameTimes = [];
  let last = performance.now();
  const next = now => {
    times.push(now - last);
    last = now;
    window.recording = requestAnimationFrame(next);
  };
  window.recording = requestAnimationFrame(next);
}"""
RECORDED = "() => { cancelAnimationFrame(window.recording); return window.frameTimes.slice(5); }"


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


def frames(page: Any, dragging: bool) -> tuple[float, float, int]:
    """Median and 95th percentile of milliseconds from one frame to the next, and how many there
    were, while the mouse leads the crank's pin to and fro, or goes the same way and holds nothing.
    """
    way = page.evaluate(WAY)
    page.mouse.move(*way[0])
    if dragging:
        page.mouse.down()
    page.evaluate(RECORD)
    for at in way[1:]:
        page.mouse.move(*at)
    times = sorted(page.evaluate(RECORDED))
    page.mouse.up()
    page.wait_for_timeout(500)
    return statistics.median(times), times[int(0.95 * len(times))], len(times)


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
            for step in (9, STEP):
                timed.goto("about:blank")
                timed.goto(f"{path.as_uri()}#step={step}")
                timed.wait_for_timeout(500)
                for dragging in (False, True):
                    middle, late, count = frames(timed, dragging)
                    what = "dragging the crank's pin" if dragging else "an empty loop"
                    told = f"{middle:.1f}, 95 % {late:.1f} ms of {count}"
                    print(f"  step {step}, {what}: a frame {told}")
            timed.close()
        print(f"load of the machine: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        browser.close()


if __name__ == "__main__":
    main()
