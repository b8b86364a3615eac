"""What a step page costs beside the SVG of the same sheets: ``python -m tests.bench.screen``.

Warm: the mechanisms are read and their programs written, no drawing has been laid out before. Of
the pump the median over students, of the other scenes one page each. The SVG holds the same two
layouts; a page adds the run of sentences, the tables and the construction as a script.
"""

from __future__ import annotations

import timeit
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median

from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet_documents import drawings_of, drawn_sheets, language_of, proved
from graphkin.mechanism import Mechanism, load
from graphkin.web.moving import moving
from graphkin.web.screen_sheets import screen_sheets
from graphkin.web.step_page import step_page
from graphkin.writers.svg import write_svg

ROOT = Path(__file__).resolve().parents[2]
SCENES = ("slotted-lever", "oldham", "gears-ring", "oscillating-slide", "centrodes-cardan")
STUDENTS = range(1, 31)
LIMIT = 0.150
"""Seconds that the page of a scene may take."""

Rows = list[tuple[str, float, float]]


def ready(name: str, **settings: int) -> Mechanism:
    """A mechanism whose program is written."""
    path = ROOT / "examples" / "scenes" / f"{name}.toml"
    mechanism = load(str(path) if path.exists() else name, **settings)
    assert mechanism.program
    return mechanism


def thrice(name: str) -> list[Mechanism]:
    """The same mechanism three times, nothing shared."""
    return [ready(name) for _ in range(3)]


def both_svg(mechanism: Mechanism) -> None:
    """Both sheets with their key, as SVG."""
    verdict = proved(mechanism, sheet_motion(mechanism))
    drawings = drawings_of(mechanism, verdict, language_of(mechanism, None))
    for sheet in drawn_sheets(drawings, "key"):
        for page in sheet.pages:
            write_svg(page)


def once(work: Callable[[Mechanism], object], mechanism: Mechanism) -> float:
    """Seconds of one call."""
    return timeit.timeit(lambda: work(mechanism), number=1)


def of(name: str, mechanisms: Callable[[], list[Mechanism]]) -> Rows:
    """The median times of some mechanisms, each work on mechanisms of its own."""
    for mechanism in mechanisms()[:2]:
        step_page(mechanism)  # what every page shares is there from now on
        both_svg(mechanism)
    svg = median(once(both_svg, one) for one in mechanisms())
    page = median(once(step_page, one) for one in mechanisms())
    sheets = [(one, screen_sheets(one)) for one in mechanisms()]
    move = median(timeit.timeit(lambda p=pair: moving(*p), number=1) for pair in sheets)
    return [
        (f"{name}: both sheets as SVG", svg, svg),
        (f"{name}: its page", page, svg),
        (f"{name}: of that, what moves", move, svg),
    ]


def rows() -> Rows:
    """All rows."""
    found = of("the pump, a student", lambda: [ready("pump", n=n) for n in STUDENTS])
    for name in SCENES:
        found += of(name, partial(thrice, name))
    return found


def table() -> str:
    """All rows as one text, and which pages take longer than they may."""
    found = rows()
    lines = [
        f"{name:46} {1000 * seconds:7.1f} ms {seconds / plain:8.2f} ×"
        for name, seconds, plain in found
    ]
    slow = [n for n, seconds, _ in found if n.endswith("its page") and seconds > LIMIT]
    return "\n".join([*lines, *(f"above {1000 * LIMIT:.0f} ms: {name}" for name in slow)])


if __name__ == "__main__":
    print(table())
