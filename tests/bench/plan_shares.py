"""How much of its field each drawing fills: ``python -m tests.bench.plan_shares``.

For every lab and example scene at its default parameters, on each sheet's key: the area of the
upright box around the plan's marks over that of its field, and the same of the mechanism.

- A field is the whole rectangle on its side of the panel line, below the captions, above the
  tables: what ``lay_out`` gives the drawing, margins included.
- Marks of a plan are its pole, its points and its vectors, trials among them; marks of a mechanism
  its pins, links, plates, blocks and wheels. Labels, leaders, construction lines, guides, grounds,
  arrows on the mechanism, curves of points and lenses do not count.
- Points count without the radius of their ring, so that a plan on one line has the share 0.
- A plan whose box is more than ten times as long as it is broad is called a line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from graphkin.construction.core.layout import lay_out
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.field import Rect
from graphkin.drawing.marks import CircleMark, Mark, Text, reach
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


def main() -> None:
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
    main()
