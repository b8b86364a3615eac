"""Budgets of pages: ``python -m tests.bench.plan_shares [--lang CODE] [NAME …]``.

How much of its field each drawing fills, and what each page spends on leaders, letters, rows and
scales, for the scenes named or for all.

For every lab and example scene at its default parameters, on each sheet's key: the area of the
upright box around the plan's marks over that of its field, and the same of the mechanism.

- A field is the whole rectangle on its side of the panel line, below the captions, above the
  tables: what ``lay_out`` gives the drawing, margins included.
- Marks of a plan are its pole, its points and its vectors, trials among them; marks of a mechanism
  its pins, links, plates, blocks and wheels. Labels, leaders, construction lines, guides, grounds,
  arrows on the mechanism, curves of points and lenses do not count.
- Points count without the radius of their ring, so that a plan on one line has the share 0.
- A plan whose box is more than ten times as long as it is broad is called a line.

The budgets of a page, keys and tasks with their calculations:

- a leader crosses a strong line if it does so before the last 0.8 mm; none is longer than 15 mm;
- letters are small below 2.5 mm, whole texts that is: indices are smaller by rule;
- a row to fill in is 7 mm high; a page of words ends below half of its height, but for the last;
- a scale is standard if ISO 5455 or, in the second place, GOST 2.302 has it.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from statistics import median

import numpy as np

from graphkin.construction.core.layout import lay_out
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import SheetDocument, drawings_of, hand_out, proved
from graphkin.drawing.field import Rect
from graphkin.drawing.labels import strong_lines
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Text, reach, style_class
from graphkin.drawing.scale import is_standard
from graphkin.drawing.shapes import struck
from graphkin.drawing.style import VECTORS
from graphkin.mechanism import load
from graphkin.text import words
from tests.documents.sheet_tools import fields_of

ROOT = Path(__file__).resolve().parents[2]
LABS = sorted(path.name for path in (ROOT / "sheets").iterdir() if path.is_dir())
SCENES = sorted((ROOT / "examples" / "scenes").glob("*.toml"))
PLAN = {"point", "pole", "trial", *VECTORS}
MECHANISM = {"pin", "link", "spoke", "plate", "block", "slider", "gear", "disc", "pitch"}
LITTLE = 0.12
"""A share below which a plan is listed."""
NARROW = 10.0
"""A box so many times longer than broad is that of a line."""


@dataclass(frozen=True)
class Share:
    """How much of its field the plan of one sheet fills, and the mechanism."""

    name: str
    kind: str
    plan: float
    mechanism: float
    size: tuple[float, float]
    """Width and height of the plan's box in mm."""

    @property
    def is_line(self) -> bool:
        """Whether the plan lies on an upright or level line, or nearly so."""
        return min(self.size) * NARROW < max(self.size)


def box(marks: Iterable[Mark], kinds: set[str]) -> Rect:
    """The upright box of the marks of some kinds."""
    boxes = []
    for mark in marks:
        own = set(mark.cls.split())
        if isinstance(mark, Text) or not own & kinds or own & {"detail", "inset", "construction"}:
            continue
        if isinstance(mark, CircleMark) and own & {"point", "pole", "pin"}:
            boxes.append((mark.cx, mark.cy, mark.cx, mark.cy))
        elif not own & {"leader", "arrowhead"}:
            boxes.append(reach(mark))
    if not boxes:
        return 0.0, 0.0, 0.0, 0.0
    lefts, tops, rights, bottoms = zip(*boxes, strict=True)
    return min(lefts), min(tops), max(rights), max(bottoms)


def area(rect: Rect) -> float:
    """The area of a rectangle."""
    return (rect[2] - rect[0]) * (rect[3] - rect[1])


def shares(scene: str, name: str) -> Iterator[Share]:
    """Those of the sheets of one scene."""
    mechanism = load(scene)
    for drawing in drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en")):
        layout = lay_out(drawing)
        marks = fields_of(drawing, sheet(drawing, "key", "1/2", layout)[0])
        plan = box(marks["plan"], PLAN)
        links = box((m for m in marks["mechanism"] if m.cls not in VECTORS), MECHANISM)
        yield Share(
            name,
            drawing.kind,
            area(plan) / area(layout.plan.rect),
            area(links) / area(layout.mechanism.rect),
            (plan[2] - plan[0], plan[3] - plan[1]),
        )


def every_share() -> list[Share]:
    """Those of all labs and example scenes."""
    named = [(lab, f"{lab} (lab)") for lab in LABS]
    named += [(str(path), path.stem) for path in SCENES]
    return [share for scene, name in named for share in shares(scene, name)]


def middle(found: Iterable[Share], value: Callable[[Share], float]) -> str:
    """The median of one value of some sheets, in per cent."""
    return f"{100 * median(map(value, found)):.0f} %"


# --- the budgets of pages -------------------------------------------------------------------------


LONG, SMALL, ROW = 15.0, 2.5, 7.0
"""The longest leader, the least letters, and the least row to fill in, in mm."""
WORST = 10
"""How many pages are listed as the worst."""


@dataclass(frozen=True)
class Budget:
    """What one page spends; ``end`` is the lowest text in parts of an A4 page's height."""

    name: str
    view: str
    kind: str
    place: str
    scale: str
    leaders: int
    crossing: int
    long: int
    longest: float
    small: int
    row: float
    end: float
    is_last: bool

    @property
    def weight(self) -> float:
        """How far the page is from its budgets."""
        low = 0.0 if self.row >= ROW - 1e-6 else 5.0
        return self.crossing + 3 * self.long + 0.2 * self.small + low


def budget(name: str, view: str, part: SheetDocument, nth: int) -> Budget:
    """The budget of one page of a document."""
    page = part.pages[nth]
    leaders = [m for m in page.marks if isinstance(m, LineMark) and style_class(m) == "leader"]
    ends = np.array([(m.x1, m.y1, m.x2, m.y2) for m in leaders]).reshape(-1, 4)
    lengths = np.hypot(ends[:, 2] - ends[:, 0], ends[:, 3] - ends[:, 1])
    texts = [mark for mark in page.marks if isinstance(mark, Text)]
    cells = sorted({m.y for m in texts if m.cls == "table" and m.name[:2] in ("v_", "a_")})
    rows = [low - high for high, low in pairwise(cells)] if view == "task" else []
    words = [m.y for m in texts if m.name not in ("header", "footer", "school")]
    scale = next((m.markup for m in texts if m.name == "scale"), "")
    return Budget(
        *(name, view, part.kind, f"{nth + 1}/{len(part.pages)}", scale, len(leaders)),
        int((struck(ends, strong_lines(page.marks)) > 0).sum()) if leaders else 0,
        int((lengths > LONG).sum()),
        float(lengths.max(initial=0.0)),
        sum(mark.height < SMALL for mark in texts),
        min(rows, default=ROW),
        max(words, default=0.0) / page.height,
        nth == len(part.pages) - 1,
    )


def budgets(named: Iterable[tuple[str, str]], language: str) -> Iterator[Budget]:
    """Those of all pages of some scenes."""
    for scene, name in named:
        for view in ("key", "task"):
            for part in hand_out(load(scene), view, language):
                yield from (budget(name, view, part, nth) for nth in range(len(part.pages)))


def ratio_of(scale: str) -> float:
    """Real over drawn length of a scale as it is written."""
    drawn, real = (float(each.replace(",", ".")) for each in scale.split(":"))
    return real / drawn


def budget_lines(found: Sequence[Budget]) -> Iterator[str]:
    """The totals, and the worst pages."""
    for view in ("key", "task"):
        own = [one for one in found if one.view == view]
        count, crossing = sum(one.leaders for one in own), sum(one.crossing for one in own)
        share = 100 * crossing / count if count else 0.0
        longest = max((one.longest for one in own), default=0.0)
        yield (
            f"{view}: {len(own)} pages, {count} leaders, {share:.1f} % across a strong line, "
            f"{sum(one.long for one in own)} above {LONG:g} mm, the longest {longest:.1f} mm"
        )
    small = [one for one in found if one.small]
    yield f"pages with letters below {SMALL} mm: {len(small)}, {sum(o.small for o in small)} texts"
    rows = [one for one in found if one.row < ROW - 1e-6]
    yield f"pages with rows below {ROW:g} mm: {len(rows)}"
    words = [one for one in found if one.kind == "calculation"]
    short = sum(one.end < 0.5 and not one.is_last for one in words)
    half = sum(one.end < 0.5 and one.is_last for one in words)
    yield (
        f"pages of calculation: {len(words)}, less than half full {short}, and {half} that are "
        "the last"
    )
    scales = Counter(one.scale for one in found if one.scale and one.place.startswith("1/"))
    iso = {scale for scale in scales if is_standard(ratio_of(scale))}
    yield "scales of ISO 5455: " + ", ".join(f"{s} ({scales[s]})" for s in sorted(iso))
    yield "others: " + ", ".join(f"{s} ({scales[s]})" for s in sorted({*scales} - iso))
    yield "the worst pages:"
    for one in sorted(found, key=lambda one: -one.weight)[:WORST]:
        yield (
            f"  {one.name}, {one.kind} {one.view} {one.place}: {one.leaders} leaders, "
            f"{one.crossing} across, longest {one.longest:.1f} mm, {one.small} small texts, "
            f"rows {one.row:.1f} mm"
        )


def main(names: Sequence[str] = ()) -> None:
    """Print the budgets; without names also the shares of all plans."""
    language = "en"
    if names[:1] == ["--lang"]:
        language, names = names[1], names[2:]
    named = [(lab, lab) for lab in LABS] + [(str(path), path.stem) for path in SCENES]
    some = [each for each in named if not names or each[1] in names]
    for line in budget_lines([*budgets(some, language)]):
        print(line)
    if not names:
        print()
        print_shares()


def print_shares() -> None:
    """Print the table, the medians, and the plans that fill little of their field."""
    found = every_share()
    print(f"{'scene':32} {'sheet':13} {'plan':>5} {'mechanism':>10}   plan's box, mm")
    for one in found:
        size = f"{one.size[0]:.0f} × {one.size[1]:.0f}"
        line = "  a line" if one.is_line else ""
        shown = f"{100 * one.plan:4.0f} % {100 * one.mechanism:8.0f} %"
        print(f"{one.name:32} {one.kind:13} {shown}   {size}{line}")
    print()
    for kind in ("velocity", "acceleration"):
        sheets = [one for one in found if one.kind == kind]
        plans, links = middle(sheets, lambda s: s.plan), middle(sheets, lambda s: s.mechanism)
        print(f"medians of {len(sheets)} {kind} sheets: plan {plans}, mechanism {links}")
    both = middle(found, lambda s: s.plan), middle(found, lambda s: s.mechanism)
    print(f"medians of all {len(found)} sheets: plan {both[0]}, mechanism {both[1]}")
    little = [one for one in found if one.plan < LITTLE and not one.is_line]
    lines = [one for one in found if one.plan < LITTLE and one.is_line]
    print(f"plans below {100 * LITTLE:.0f} %: {len(little)}, and {len(lines)} that are lines")
    for one in sorted(little, key=lambda s: s.plan):
        print(f"  {one.name}, {one.kind}: {100 * one.plan:.1f} %")


if __name__ == "__main__":
    main(sys.argv[1:])
