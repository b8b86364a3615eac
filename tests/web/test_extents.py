"""Lines reach the points they belong to wherever these go, and what must be seen is in sight."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot
from pathlib import Path
from typing import Any

import pytest

from graphkin.drawing.marks import CircleMark, LineMark, Mark
from graphkin.numbers.plane import Line as Carrier
from graphkin.numbers.plane import Ratio
from graphkin.web.field_binder import box_of, room_of
from graphkin.web.step_page import step_page
from tests.browser.opening import Opened
from tests.chosen import EVERY
from tests.web.test_moving import LIMIT, fields, marks_of, named, page_of
from tests.web.written import Numbers, ran

SCENES = ("pump", "gears-ring", "slotted-lever")
PLACES = (0.05, 0.17, 0.3, 0.43, 0.57, 0.7, 0.83, 0.95)
"""Parts of the range at which is looked, none of them at a dead point."""
EXTENTS = """([source, places]) => {
  const motion = new Function(source + ';return graphkinMotion')();
  return places.map(x => [0, 1].map(sheet => [0, 1].map(side => motion.extent(x, sheet, side))));
}"""
IN_SIGHT = """() => [...document.querySelectorAll('.sheet:not([hidden]) .view svg')].map(svg => {
  const pane = svg.getBoundingClientRect();
  const circles = [...svg.querySelectorAll('circle:is(.pin,.point):not([visibility])')];
  const seen = circles.filter(circle => {
    const { left, right, top, bottom } = circle.getBoundingClientRect();
    const [x, y] = [(left + right) / 2, (top + bottom) / 2];
    return x > pane.left && x < pane.right && y > pane.top && y < pane.bottom;
  });
  return [seen.length, circles.length];
})"""


def places_of(name: str) -> list[float]:
    """The places of the driver that are looked at."""
    reach = page_of(name)[1].reach
    return [reach.low + share * (reach.high - reach.low) for share in PLACES]


def everywhere(page: Any, name: str) -> Iterator[tuple[float, dict[str, Numbers]]]:
    """Each of them, with the marks that the page has written there."""
    places = places_of(name)
    for x, here in zip(places, ran(page, page_of(name)[1], places), strict=True):
        yield x, marks_of(name, here)


def lines_and_points(
    name: str, x: float, here: dict[str, Numbers]
) -> Iterator[tuple[str, list[Any], list[Any], bool]]:
    """Of each construction line its parts as drawn, and the circles of the points that it makes.

    The last is true where all of the line is drawn and not only what lies beyond its points.
    """
    sheets, found = page_of(name)
    kinds = {record[0]: record for record in found.data["marks"]}
    every = list(fields(sheets))
    for s, sheet in enumerate(sheets):
        for side in (0, 1):
            own = [(i, mark) for i, mark, *at in every if at == [s, side]]
            points = {m.step: here[i] for i, m in own if isinstance(m, CircleMark) and i in here}
            for number in sorted(sheet.layout.spans):
                value = sheet.drawing.trace.values[number]
                if not isinstance(value, Carrier):
                    continue
                names = [i for i, m in own if m.step == number and isinstance(m, LineMark)]
                names += [i for i in (f"{name}h" for name in names) if i in found.data["more"]]
                names = [i for i in names if i in kinds and kinds[i][1] == "s"]
                children = sheet.drawing.children.get(number, ())
                steps = {sheet.drawing.results.get(child, child) for child in children}
                on = [at for each in steps if (at := points.get(each)) is not None]
                parts = [at for i in names if (at := here[i]) is not None]
                whole = all(kinds[i][-2] == 0 for i in names)
                if parts and on:
                    yield f"{name} at {x:g}, step {number} of sheet {s}", parts, on, whole


def off(part: list[float], point: list[float]) -> float:
    """How far a point lies from a segment, in mm."""
    (x, y), (u, v) = part[:2], (part[2] - part[0], part[3] - part[1])
    along = ((point[0] - x) * u + (point[1] - y) * v) / (u * u + v * v)
    t = min(max(along, 0.0), 1.0)
    return hypot(point[0] - x - t * u, point[1] - y - t * v)


@pytest.mark.parametrize("name", SCENES)
def test_every_line_ends_at_the_points_it_belongs_to(page, name):
    """All of a line holds each of its points; of one drawn at its ends, each end begins at one."""
    compared = 0
    for x, here in everywhere(page, name):
        for where, parts, on, whole in lines_and_points(name, x, here):
            if whole:
                for point in on:
                    assert min(off(part, point) for part in parts) < LIMIT, where
            else:
                nearest = [min(off(part, point) for point in on) for part in parts]
                assert min(nearest) < LIMIT, where
            compared += len(on)
    assert compared > 100


@pytest.mark.parametrize("name", SCENES)
def test_what_must_be_seen_lies_in_the_extent(page, name):
    """Pins and points of both fields, as far as the field can grow; it is never larger."""
    sheets, found = page_of(name)
    boxes = page.evaluate(EXTENTS, [found.source, places_of(name)])
    for (x, here), sheets_here in zip(everywhere(page, name), boxes, strict=True):
        for mark_id, mark, s, side in fields(sheets):
            left, top, width, height = sheets_here[s][side]
            room = room_of(field_of(sheets[s], side))
            assert left >= room[0] and left + width <= room[2] + LIMIT
            assert top >= room[1] and top + height <= room[3] + LIMIT
            at = here.get(mark_id)
            if at and must_be_there(sheets[s], mark):
                u, v = (min(max(at[i], room[i]), room[i + 2]) for i in (0, 1))
                assert left - LIMIT <= u <= left + width + LIMIT, (x, mark)
                assert top - LIMIT <= v <= top + height + LIMIT, (x, mark)


def field_of(sheet: Any, side: int) -> tuple[float, float, float, float]:
    """The rectangle of a field."""
    rect: tuple[float, float, float, float] = (sheet.layout.mechanism, sheet.layout.plan)[side].rect
    return rect


def must_be_there(sheet: Any, mark: Mark) -> bool:
    """Whether a mark is a pin or a point of the construction, and no centre or pole."""
    values = sheet.drawing.trace.values
    is_far = mark.step is not None and isinstance(values[mark.step], Ratio)
    return isinstance(mark, CircleMark) and not is_far


def test_a_box_holds_what_stands_still():
    """Lines, circles and polygons; a chain-dotted line across the field goes as far as it likes."""
    marks = [
        LineMark(3, 4, 8, 2, "ground"),
        CircleMark(10, 5, 1.5, "pin"),
        LineMark(-90, 0, 90, 0, "centre-line"),
    ]
    assert box_of(marks) == (3, 2, 11.5, 6.5)
    assert box_of(marks[2:]) is None


MOVED = {"pump": 150, "slotted-lever": 216, "gears-ring": 306}
"""Places of the driver at which something has left the pane."""


@pytest.mark.parametrize("name", MOVED if EVERY else ["pump"])
def test_all_points_are_in_sight_after_a_move(opened: Opened, tmp_path: Path, name):
    """The pane follows what leaves it."""
    path = tmp_path / "page.html"
    path.write_text(step_page(named(name), "en"), encoding="utf-8")
    shown = opened(path, viewport={"width": 1440, "height": 900})
    shown.evaluate(f"location.hash = '#step=99&x={MOVED[name]}'")
    shown.locator("#next:disabled").wait_for()
    for seen, drawn in shown.evaluate(IN_SIGHT):
        assert seen == drawn > 2
