"""What a page's own script writes of its marks, in chromium, at places of the driver."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Text
from graphkin.web.moving import Moving

RUN = """([source, places, changed, size]) => {
  const motion = new Function(source + ';return graphkinMotion')();
  for (const [k, value] of changed) motion.figure(k, value);
  return places.map((x) => {
    const marks = {};
    const mark = (id) => ({
      setAttribute: (name, value) => { (marks[id] = marks[id] || {})[name] = value; },
      removeAttribute: () => { marks[id] = marks[id] || {}; },
    });
    const { ok } = motion.set(x, mark);
    const y = Array.from({ length: size }, (_, i) => motion.read(i, x));
    return { ok, marks, y, values: motion.values(x), margins: motion.margins(x) };
  });
}"""
Numbers = list[float] | None
"""The numbers of a mark as ``redrawn.numbers`` has them, a text's shift; None where hidden."""


def ran(
    page: Any, moving: Moving, places: Sequence[float], figures: Mapping[str, float] | None = None
) -> list[dict[str, Any]]:
    """What the script of a page does at some places, with some of its figures changed."""
    names = [each.name for each in moving.driven.figures]
    changed = [[names.index(name), value] for name, value in (figures or {}).items()]
    size = moving.data["size"]
    found: list[dict[str, Any]] = page.evaluate(RUN, [moving.source, [*places], changed, size])
    return found


def read(mark: Mark | None, written: Mapping[str, str]) -> Numbers:
    """The numbers of a mark by its attributes; of one that is not drawn where the scene stands
    only these tell the kind."""
    if written.get("visibility") == "hidden":
        return None
    if not written:
        return []
    if isinstance(mark, Text):
        return signed(written["transform"])
    if isinstance(mark, LineMark) or (mark is None and "x1" in written):
        return [float(written[name]) for name in ("x1", "y1", "x2", "y2")]
    if isinstance(mark, CircleMark):
        return [float(written[name]) for name in ("cx", "cy")]
    if isinstance(mark, Arc):
        numbers = signed(written["d"])
        return [*numbers[:4], *numbers[5:]]  # without the turn of its axes
    return signed(written["points"])


def signed(text: str) -> list[float]:
    """All numbers of a text."""
    return [float(number) for number in re.findall(r"-?\d+\.?\d*", text)]
