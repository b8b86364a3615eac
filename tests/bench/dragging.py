"""Dragging a pin on a step page, beside an empty loop: ``python -m tests.bench.dragging``.

In Chromium a pin of the pump is led to and fro, a place a frame; between them frames pass in which
nothing moves. The rows are the times from frame to frame of both, and the processor time of the
page's thread for a move, which other programs lengthen less. ``python -m tests.bench.dragging leaks
2000`` presses, leads and lets go as often; its rows are what the page holds before and after:
memory, nodes and listeners, by the browser's own tools, after the search for garbage.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from graphkin.mechanism import load
from graphkin.web.step_page import step_page
from tests.bench.studio import ROOT

SCENES = ("pump", "stephenson-3")
ALIKE, SLOWEST = 1.05, 33.0
"""How many times an empty frame the median may take, and milliseconds for 95 of 100."""
WARM, DRAGS, FRAMES, ROUNDS = 60, 2000, 120, 5
GRIP = """() => {
  const grip = document.querySelector(".sheet:not([hidden]) .grip.driven");
  const { x, y, width, height } = grip.getBoundingClientRect();
  return [x + width / 2, y + height / 2];
}"""
"""Where the driver is taken."""
LED = """async ([frames, moves, x, y]) => {
  const grip = document.querySelector(".sheet:not([hidden]) .grip.driven"), found = [];
  let last = await new Promise(requestAnimationFrame);
  for (let k = 1; k <= frames; k++) {
    const turn = 0.35 * Math.sin(k / 9), to = { clientX: x + 90 * turn, clientY: y + 60 * turn };
    if (moves) grip.dispatchEvent(new PointerEvent("pointermove", { bubbles: true, ...to }));
    const now = await new Promise(requestAnimationFrame);
    found.push(now - last);
    last = now;
  }
  return found;
}"""
"""Milliseconds from frame to frame, with a move in each or none."""


DRAGGED = """async ([drags, x, y]) => {
  const grip = document.querySelector(".sheet:not([hidden]) .grip.driven");
  const tell = (what, k) => grip.dispatchEvent(new PointerEvent(what,
    { bubbles: true, cancelable: true, pointerId: 1, clientX: x + k, clientY: y }));
  for (let k = 0; k < drags; k++) {
    tell("pointerdown", 0);
    tell("pointermove", 5 + k % 7);
    await new Promise(requestAnimationFrame);
    tell("pointerup", 5 + k % 7);
  }
}"""
"""Press, lead and let go, a frame each; the pointer is that of the mouse, which stays pressed."""


def page_of(name: str) -> str:
    """The step page of a lab or an example."""
    path = ROOT / "examples" / "scenes" / f"{name}.toml"
    return step_page(load(str(path) if path.exists() else name), "en")


@contextmanager
def shown(name: str) -> Iterator[Any]:
    """A step page in Chromium, at its last step."""
    from playwright.sync_api import sync_playwright

    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        path = Path(folder) / "page.html"
        path.write_text(page_of(name), encoding="utf-8")
        args = ["--no-sandbox", "--disable-gpu"]
        browser = driver.chromium.launch(executable_path=chromium, args=args)
        page = browser.new_page(viewport={"width": 1366, "height": 768})
        page.goto(path.as_uri())
        page.keyboard.press("End")
        yield page
        browser.close()


def led(name: str) -> list[str]:
    """The rows of one scene: an empty loop and a drag, in turn."""
    with shown(name) as page:
        tools = page.context.new_cdp_session(page)
        tools.send("Performance.enable", {"timeDomain": "threadTicks"})

        def busy() -> float:
            metrics = tools.send("Performance.getMetrics")["metrics"]
            return next(each["value"] for each in metrics if each["name"] == "TaskDuration")

        x, y = page.evaluate(GRIP)
        page.mouse.move(x, y)
        page.mouse.down()
        page.evaluate(LED, [WARM, True, x, y])
        still: list[float] = []
        moved: list[float] = []
        work = {False: 0.0, True: 0.0}
        for _ in range(ROUNDS):
            for moves, times in ((False, still), (True, moved)):
                begun = busy()
                times.extend(page.evaluate(LED, [FRAMES, moves, x, y]))
                work[moves] += busy() - begun
        page.mouse.up()
    own = 1e3 * (work[True] - work[False]) / (ROUNDS * FRAMES)
    least, tail = median(still), quantiles(still, n=20)[-1]
    return [
        f"{name}: {words:42} {time:7.1f} ms {time / plain:7.3f} × {limit}"
        for words, time, plain, limit in (
            ("a frame of an empty loop, median", least, least, ""),
            ("a frame while a pin is led, median", median(moved), least, f"(at most {ALIKE})"),
            ("an empty frame, 95 of 100", tail, tail, ""),
            ("a frame led, 95 of 100", quantiles(moved, n=20)[-1], tail, f"(at most {SLOWEST} ms)"),
            ("the page's thread, for a move", own, least, ""),
        )
    ]


def leaks(name: str, count: int) -> list[str]:
    """The rows of one scene: what its page holds before and after some drags."""
    with shown(name) as page:
        tools = page.context.new_cdp_session(page)
        x, y = page.evaluate(GRIP)

        def held() -> dict[str, float]:
            tools.send("HeapProfiler.collectGarbage")
            counters = tools.send("Memory.getDOMCounters")
            used = tools.send("Runtime.getHeapUsage")["usedSize"] / 1024
            return {"kB": used, **{key: counters[key] for key in ("nodes", "jsEventListeners")}}

        page.mouse.move(x, y)
        page.mouse.down()
        page.evaluate(DRAGGED, [WARM, x, y])
        before = held()
        page.evaluate(DRAGGED, [count, x, y])
        after = held()
    return [
        f"{name}: {what} after {count} drags {before[what]:10.0f} → {after[what]:10.0f} "
        f"({after[what] / before[what]:.3f} ×)"
        for what in before
    ]


if __name__ == "__main__":
    if sys.argv[1:2] == ["leaks"]:
        print("\n".join(leaks("pump", int((sys.argv[2:] or [str(DRAGS)])[0]))))
    else:
        print("\n".join(row for scene in sys.argv[1:] or SCENES for row in led(scene)))
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")
