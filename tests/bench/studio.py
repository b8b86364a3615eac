"""The studio's answers to a slider, as a browser gets them: ``python -m tests.bench.studio``.

``python -m tests.bench.studio painted`` measures in Chromium: from the event of a slider, or of
typing, until what it changes is painted, the browser's layout included; with the processor time of
the server and of the browser's processes for each, which tells what an idle machine would need at
least, and the machine's load. A scene of class III, or its path, can follow.

A server in a process of its own, one connection that is kept; each time is that of the whole way:
what is asked as JSON, solving, checking, drawing, the answer as JSON, and its way back. Times are
given beside the limit for a move; the growth of memory beside what the process held before.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from statistics import median, quantiles
from time import perf_counter
from urllib.parse import urlsplit

from graphkin.scene import scene_files

ROOT = Path(__file__).resolve().parents[2]
LIMIT = 0.05
"""Seconds in which a move of a slider is to be answered."""
TYPED = 0.3
"""Seconds in which a sign that is typed is to be seen, the pause before it is read included."""
WARM, MOVES = 60, 500
ORDER = {"tab": "bench", "language": "en", "name": "pump.toml"}


class Page:
    """The page's side: one connection, requests counted."""

    def __init__(self, address: str, text: str) -> None:
        parts = urlsplit(address)
        self.line = HTTPConnection(parts.hostname or "", parts.port, timeout=60)
        self.path = f"{parts.path}look"
        self.text, self.number = text, 0

    def look(self, n: int, **options: object) -> float:
        """Seconds until a move of n is answered and read."""
        self.number += 1
        order = {**ORDER, "text": self.text, "number": self.number, "settings": {"n": str(n)}}
        start = perf_counter()
        body = json.dumps({**order, **options})
        self.line.request("POST", self.path, body, {"Content-Type": "application/json"})
        answer = json.loads(self.line.getresponse().read())
        took = perf_counter() - start
        assert len(answer["panels"]) == 3, answer
        return took

    def moves(self, count: int, **options: object) -> list[float]:
        """The times of some moves, to and fro over all numbers."""
        there = [*range(1, 31), *range(29, 1, -1)]
        return [self.look(there[i % len(there)], **options) for i in range(count)]


@contextmanager
def served(lab: str) -> Iterator[tuple[int, str]]:
    """A studio that runs: its process and its address."""
    with tempfile.TemporaryDirectory() as folder:
        if Path(lab).is_file():
            lab = shutil.copy(lab, folder)
        command = [sys.executable, "-m", "graphkin", "studio", lab, "--no-browser"]
        environment = {"PYTHONPATH": str(ROOT), "PYTHONUNBUFFERED": "1", "PATH": ""}
        with subprocess.Popen(
            command, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True
        ) as process:
            assert process.stdout is not None
            try:
                yield process.pid, process.stdout.readline().strip()
            finally:
                process.terminate()


def held(process: int) -> float:
    """Memory that a process holds, in MB."""
    status = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    line = next(line for line in status.splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


def spent(process: int) -> float:
    """Seconds of processor that a process has used, whatever else the machine does meanwhile."""
    fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measured(lab: str) -> list[str]:
    """The rows of one lab."""
    text = (scene_files.shelf() / lab / "scene.toml").read_text(encoding="utf-8")
    with served(lab) as (process, address):
        page = Page(address, text)
        first = page.look(7)
        page.moves(WARM)
        page.moves(WARM, quick=True)
        before, begun = held(process), spent(process)
        moves = page.moves(MOVES, quick=True)
        after, used = held(process), spent(process) - begun
        accelerations = page.moves(WARM, quick=True, mechanism="acceleration")
        rest = page.moves(WARM)
        both = page.moves(WARM, mechanism="acceleration")
    rows = [
        ("limit of a move", LIMIT),
        ("a move, processor time, mean", used / MOVES),
        ("a move, median", median(moves)),
        ("a move, 95 of 100", quantiles(moves, n=20)[-1]),
        ("a move, the slowest", max(moves)),
        ("a move, accelerations on the mechanism, median", median(accelerations)),
        ("at rest, all labels placed, median", median(rest)),
        ("at rest, all labels placed, the slowest", max(rest)),
        ("at rest, accelerations on it, median", median(both)),
        ("the first look", first),
    ]
    lines = [f"{lab}: {name:50} {1e3 * t:8.1f} ms {t / LIMIT:8.2f} ×" for name, t in rows]
    grown = f"{after - before:+8.2f} MB {after / before:8.3f} ×"
    return [*lines, f"{lab}: {f'memory after {MOVES} moves':50} {grown}"]


PAINTED = """async (value) => {
  const after = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const change = (field, words) => {
    field.value = words;
    field.dispatchEvent(new InputEvent("input", { bubbles: true, inputType: "insertText" }));
  };
  const seen = new Promise((done) => {
    const watch = new MutationObserver(() => (watch.disconnect(), done()));
    watch.observe(document.body, { attributeFilter: ["data-shown"] });
  });
  const start = performance.now();
  const slider = document.querySelector("#sliders input[type=range]");
  if (value === null) {
    const text = document.getElementById("text");
    change(text, text.value.endsWith("#") ? text.value.slice(0, -1) : `${text.value}#`);
  } else change(slider, value);
  await seen;
  await after();
  return performance.now() - start;
}"""
"""Move a slider to a place, or write a sign where none is given: milliseconds until it is seen."""


def painted(scene: str, count: int = 120) -> list[str]:
    """The rows of one scene in Chromium."""
    from playwright.sync_api import sync_playwright

    path = shutil.which("chromium") or shutil.which("chromium-browser")
    args = ["--no-sandbox", "--disable-gpu"]
    with served(scene) as (process, address), sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=path, args=args)
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        page.goto(address)
        page.wait_for_selector("body[data-settled=true] .drawing svg", timeout=60_000)
        told = browser.new_browser_cdp_session()

        def browsers() -> float:
            found = told.send("SystemInfo.getProcessInfo")["processInfo"]
            return sum(each["cpuTime"] for each in found if each["type"] == "renderer")

        slider = page.locator("#sliders input[type=range]").first
        most = int(slider.get_attribute("max") or 0)
        there = [*range(most + 1), *range(most - 1, 0, -1)]
        places = [str(there[i % len(there)]) for i in range(count)]
        slider.dispatch_event("pointerdown")
        for place in places[:20]:
            page.evaluate(PAINTED, place)
        begun = spent(process), browsers()
        moves = [page.evaluate(PAINTED, place) / 1e3 for place in places]
        own, shown = spent(process) - begun[0], browsers() - begun[1]
        slider.dispatch_event("pointerup")
        page.wait_for_selector("body[data-settled=true]", timeout=60_000)
        begun = spent(process), browsers()
        signs = [page.evaluate(PAINTED, None) / 1e3 for _ in range(12)]
        typing = spent(process) - begun[0] + browsers() - begun[1]
        browser.close()
    rows = [
        ("a move, event to painted, median", median(moves), LIMIT),
        ("a move, event to painted, 95 of 100", quantiles(moves, n=20)[-1], 2 * LIMIT),
        ("a move, processor time of the server, mean", own / count, LIMIT),
        ("a move, processor time of the page, mean", shown / count, LIMIT),
        ("a sign typed, event to painted, median", median(signs), TYPED),
        ("a sign typed, processor time of both, mean", typing / len(signs), TYPED),
    ]
    name = Path(scene).stem
    return [f"{name}: {words:50} {1e3 * t:8.1f} ms {t / limit:8.2f} ×" for words, t, limit in rows]


def table() -> str:
    """All rows as one text."""
    return "\n".join(line for lab in ("pump", "slotted-lever") for line in measured(lab))


def painted_table(scenes: list[str]) -> str:
    """All rows in Chromium as one text, with the machine's load."""
    lines = [line for scene in scenes for line in painted(scene)]
    return "\n".join([*lines, f"load of the machine: {os.getloadavg()[0]:.1f}"])


if __name__ == "__main__":
    if sys.argv[1:2] == ["painted"]:
        three = ROOT / "examples" / "scenes" / "stephenson-3.toml"
        print(painted_table(sys.argv[2:] or ["pump", "slotted-lever", str(three)]))
    else:
        print(table())
