"""Marks follow the driver: what the page's own script writes where the scene stands, and elsewhere
beside what Python draws there."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import combinations
from math import acos, degrees, hypot, inf, isclose
from typing import Any

import numpy as np
import pytest
import shapely
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.paper_canvas import above_foot, inside
from graphkin.construction.core.quantities import SHEETS
from graphkin.drawing.field import Rect, clipped
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Polyline, Text
from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import cycle
from graphkin.motion.pieces import reachable_ranges
from graphkin.motion.sweep import sweep_of
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import FRAME
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.web.frames import place_in
from graphkin.web.moving import Moving, moving, still
from graphkin.web.page_driver import driven_by, window
from graphkin.web.screen_sheets import ScreenSheet, screen_sheets
from tests.chosen import EVERY, FOLDER, HALVES, number_of
from tests.documents.sheet_tools import mechanism_named
from tests.mechanisms import mechanism_of
from tests.scene_files import FOLDER as TESTS
from tests.web.redrawn import apart, kind_of, numbers, off_by, redrawn_near
from tests.web.written import Numbers, ran, read

LABS = ("pump", "pump-collinear", "offset-slider-crank", "slotted-lever")
CENTRES = ", all its centres"
"""The end of the name of a mechanism of which the centres of all pairs of links are asked."""
ENDLESS = tuple(f"{name}{CENTRES}" for name in ("slider-crank", "crank-fixed-slot", "trammel"))
WHICH = tuple(
    dict.fromkeys(
        (
            *LABS,
            *HALVES[0],
            "belts-arm",
            "excavator-relative",
            "gears-planet",
            "gears-rack",
            "oscillating-slide",
            *(("rapid-return", "stephenson-3-crank", "gears-ring") if EVERY else ()),
            "trammel",
            *ENDLESS[1:],
        )
    )
)
"""Cranks, slides, gears, racks, groups of class III, a driver that slides, a law of time."""
WIDTH, HEIGHT = 420, 297
"""Of a sheet, in mm."""
LIMIT = 0.01
"""Millimetres within which a page draws as Python does."""
DIGITS = 2e-4
"""Millimetres by which a number may be off that is written with four digits, and so cut."""
TEETH = ("gear", "gear-disc")
"""The outlines of gears."""
CURVES = ("trajectory", "fixed-centrode", "moving-centrode", "locus")
"""Curves of the whole motion: they are drawn once, and carried with what bears them."""
PLACES = tuple((k + 0.5) / 24 for k in range(24)) if EVERY else (0.07, 0.72)
"""The places looked at, in parts of the range: all, or one of them by the name of the scene."""


@cache
def named(name: str) -> Mechanism:
    """A shipped mechanism or an example, as it is or with all its centres."""
    if name.endswith(CENTRES):
        scene = named(name.removesuffix(CENTRES)).scene
        pairs = tuple("-".join(pair) for pair in combinations((FRAME, *scene.links), 2))
        return Mechanism(replace(scene, ask=replace(scene.ask, pairs=pairs)))
    return load(name) if name in LABS else mechanism_named(name)


@cache
def page_of(name: str) -> tuple[list[ScreenSheet], Moving]:
    """The sheets of a mechanism, and what moves them."""
    sheets = screen_sheets(named(name))
    found = moving(named(name), sheets)
    assert found is not None
    return sheets, found


def fields(sheets: Sequence[ScreenSheet]) -> Iterator[tuple[str, Mark, int, int]]:
    """Every mark with its id, its sheet, and 0 in the mechanism's field or 1 in the plan's."""
    for s, sheet in enumerate(sheets):
        for k, mark in enumerate((*sheet.left, *sheet.right)):
            yield f"m{s}-{k}", mark, s, int(k >= len(sheet.left))


def places_of(name: str) -> list[float]:
    """Where the scene stands, and the places of the driver that are looked at."""
    driven, reach = page_of(name)[1].driven, page_of(name)[1].reach
    shares = PLACES if EVERY or name in LABS else PLACES[number_of(name) % 2 :][:1]
    return [driven.start, *(reach.low + share * (reach.high - reach.low) for share in shares)]


RAN: dict[str, list[dict[str, Any]]] = {}
"""What the page of each scene did at its places, once it has run."""


def everywhere(page: Any, name: str) -> list[tuple[float, dict[str, Any]]]:
    """Every place that is looked at, with what the page does there."""
    if name not in RAN:
        RAN[name] = ran(page, page_of(name)[1], places_of(name))
    return [*zip(places_of(name), RAN[name], strict=True)]


def marks_of(name: str, here: dict[str, Any]) -> dict[str, Numbers]:
    """The numbers of the marks that a page has written somewhere."""
    assert here["ok"]
    by_id = {mark_id: mark for mark_id, mark, _, _ in fields(page_of(name)[0])}
    return {mark_id: read(by_id.get(mark_id), at) for mark_id, at in here["marks"].items()}


@pytest.mark.parametrize("name", WHICH)
def test_every_mark_lies_where_it_is_drawn(page, name):
    """Each binding gives the drawn coordinates back, and hides nothing that is drawn."""
    sheets, found = page_of(name)
    here = marks_of(name, everywhere(page, name)[0][1])
    kinds = {record[0]: record[1] for record in found.data["marks"]}
    for mark_id, mark, s, side in fields(sheets):
        if mark_id not in here or kinds[mark_id] in "oi":
            continue
        at = here[mark_id]
        if at is None and isinstance(mark, LineMark) and is_nothing(numbers(mark)):
            continue
        assert at is not None, (mark_id, mark)
        drawn = [0.0, 0.0] if isinstance(mark, Text) else numbers(mark)
        rect = sheets[s].layout.plan.rect if side else sheets[s].layout.mechanism.rect
        edges = rect, inside(rect), above_foot(rect)
        cut = [
            at,
            *(cut_to(at, edge) for edge in edges if isinstance(mark, LineMark)),
        ]
        assert min(apart(each, drawn) for each in cut) < DIGITS, (mark_id, mark)


def cut_to(at: list[float], rect: Rect) -> list[float]:
    """The part of a line that is on paper."""
    part = clipped((at[0], at[1]), (at[2], at[3]), rect)
    return [] if part is None else [*part[0], *part[1]]


@pytest.mark.parametrize("name", WHICH)
def test_what_moves_in_the_mechanism_is_bound(name):
    """Only what tells a number of the drawn position, or lies off its field, is left behind."""
    sheets, found = page_of(name)
    left = {record[0] for record in found.data["marks"] if record[1] == "o"}
    for mark_id, mark, s, _ in fields(sheets):
        if mark_id in left:
            values = sheets[s].drawing.trace.program.steps
            far = mark.step is not None and values[mark.step].part.value in ("centre", "pole")
            told = mark.name.startswith(("phi", "s ", "note", "locus"))
            detail = mark.cls == "detail"
            assert far or told or detail, mark


def is_nothing(at: Sequence[float]) -> bool:
    """Whether a line has no length."""
    return len(at) == 4 and hypot(at[2] - at[0], at[3] - at[1]) < 1e-6


def is_nowhere(key: Any, at: Sequence[float]) -> bool:
    """Whether a mark has no length, or lies beyond one edge of the sheet."""
    ends = [*at[:2], *at[6:]] if key[2] == "Arc" else at
    (left, right), (top, bottom) = ((min(some), max(some)) for some in (ends[::2], ends[1::2]))
    return is_nothing(at) or right < 0 or left > WIDTH or bottom < 0 or top > HEIGHT


def is_of_one_position(mark: Mark, drawing: Drawing) -> bool:
    """Whether a mark follows from the position alone; labels are placed by what is about them,
    curves are of the whole motion, teeth mesh by a law of their own, auxiliary circles may leave
    the page, and the head of a ray to a centre lies off it."""
    first, *about = mark.cls.split()
    if isinstance(mark, Text) or first in ("label", "number", "leader"):
        return False
    if isinstance(mark, Polyline) and first == "arrowhead":
        value = None if mark.step is None else drawing.trace.values[mark.step]
        return not isinstance(value, Ratio) or about[0] not in SHEETS
    return not isinstance(mark, Polyline) or first not in (*CURVES, *TEETH, "construction")


def compared(
    name: str, x: float, marks: dict[str, Any], other: Mechanism | None = None
) -> Iterator[str]:
    """What a page draws otherwise than Python at a place of the driver; ``other`` is the mechanism
    with its figures changed."""
    (sheets, found), mechanism = page_of(name), other or named(name)
    here = defaultdict(list)
    drawn: dict[Any, int] = defaultdict(int)
    places = {mark_id: (mark, s, side) for mark_id, mark, s, side in fields(sheets)}
    for mark_id, mark, s, side in fields(sheets):
        if not is_of_one_position(mark, sheets[s].drawing):
            continue
        drawn[s, side, *kind_of(mark)] += 1
        at = marks.get(mark_id, numbers(mark))
        if at is not None and at != []:
            here[s, side, *kind_of(mark)].append(at)
    for mark_id, (before, _, cls) in found.data["more"].items():
        mark, s, side = places[before]
        kind = "LineMark" if cls.split()[0] == "construction" else "Polyline"
        key = (s, side, kind, cls, *kind_of(mark)[2:])
        drawn[key] += 1
        if marks[mark_id] is not None:
            here[key].append(marks[mark_id])
    for s, sheet in enumerate(sheets):
        pins = {
            mark.name: marks.get(f"m{s}-{k}") or numbers(mark)
            for k, mark in enumerate(sheet.left)
            if isinstance(mark, CircleMark) and mark.cls == "pin"
        }
        for side, there in enumerate(redrawn_near(mechanism, found.driven, sheet, x, pins)):
            wanted = defaultdict(list)
            for mark in (each for each in there if is_of_one_position(each, sheet.drawing)):
                wanted[s, side, *kind_of(mark)].append(numbers(mark))
            mine = {key: at for key, at in here.items() if key[:2] == (s, side)}
            yield from differences(mine, wanted, drawn, x)


def differences(
    mine: dict[Any, list[Any]],
    wanted: dict[Any, list[Any]],
    drawn: dict[Any, int],
    x: float,
) -> Iterator[str]:
    """Marks of one that no mark of the other lies at; those that were not drawn cannot follow."""
    for key in {*mine, *wanted}:
        a, b = mine.get(key, []), wanted.get(key, [])
        off = off_by(key[3])
        if off is apart and key[2] == "LineMark":
            off = off_on_paper
        for at in (each for each in a if not is_nowhere(key, each)):
            if min((off(at, other) for other in b), default=9.0) > LIMIT:
                yield f"at {x:g} {key}: {at} is not drawn by Python, which has {b}"
        if drawn[key] >= len(b):
            for at in (each for each in b if not is_nowhere(key, each)):
                if min((off(at, other) for other in a), default=9.0) > LIMIT:
                    yield f"at {x:g} {key}: {at} is not on the page, which has {a}"


def off_on_paper(one: Sequence[float], other: Sequence[float]) -> float:
    """How far two lines lie apart, or their parts on the sheet where both leave it."""
    parts = [cut_to([*each], (0, 0, WIDTH, HEIGHT)) for each in (one, other)]
    on_paper = apart(*parts) if all(parts) else inf if any(parts) else 0.0
    return min(apart(one, other), on_paper)


@pytest.mark.parametrize("name", WHICH)
def test_marks_follow_as_python_draws_them(page, name):
    """Every line, circle, arc and vector within 0.01 mm of a fresh drawing at the same scales."""
    for x, here in everywhere(page, name)[1:]:
        assert not list(compared(name, x, marks_of(name, here)))


@pytest.mark.parametrize(
    "name", ["stephenson-1", "mobility-parallel-cranks", "two-loops", "cam-tangent"]
)
def test_a_page_goes_as_a_cycle_does_and_as_far(page, name):
    """Through change points, and no farther, with every pin where a row of the cycle has it."""
    goes_as_a_cycle(page, named(name), *page_of(name))


def test_a_page_of_parallel_cranks_may_start_on_the_other_side(page):
    """Where the whole turn begins, the crossing is then not the one that is drawn."""
    text = (FOLDER / "mobility-parallel-cranks.toml").read_text(encoding="utf-8")
    text = text.replace("value = 60, min = 20, max = 160", "value = 270, min = 200, max = 340")
    mechanism = Mechanism(read_text(text.replace("left of B-D", "right of B-D"), "cranks"))
    sheets = screen_sheets(mechanism)
    found = moving(mechanism, sheets)
    assert found is not None
    goes_as_a_cycle(page, mechanism, sheets, found)


def goes_as_a_cycle(
    page: Any, mechanism: Mechanism, sheets: Sequence[ScreenSheet], found: Moving
) -> None:
    """Holds the pins of the first sheet to the rows of a cycle, and the range to its range."""
    rows = cycle(mechanism, steps=36)
    low, high = rows.path.spans[0]
    ends = (low / found.driven.metres, high / found.driven.metres)
    assert (found.reach.low, found.reach.high) == pytest.approx(ends, abs=1e-6)
    places = [at / found.driven.metres for at in rows.at]
    pins = {
        mark_id: mark.name
        for mark_id, mark, s, _ in fields(sheets)
        if s == 0 and isinstance(mark, CircleMark) and mark.cls == "pin"
    }
    for k, here in enumerate(ran(page, found, places)):
        assert here["ok"], places[k]
        for mark_id in pins.keys() & here["marks"].keys():
            written = here["marks"][mark_id]
            at = rows.solution.points[pins[mark_id]].position
            there = sheets[0].layout.mechanism(complex(np.broadcast_to(at, len(places))[k]))
            drawn = [float(written["cx"]), float(written["cy"])]
            assert drawn == pytest.approx(there, abs=LIMIT), (pins[mark_id], places[k])


@pytest.mark.parametrize("name", WHICH)
def test_a_page_stays_small(name):
    """What moves a page has less than 150 kB, and nothing in it ends a script."""
    source = page_of(name)[1].source
    assert len(source.encode()) < 150_000
    assert "</" not in source and "<!--" not in source and "http" not in source


@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
def test_every_pin_of_the_mechanism_can_be_taken_hold_of(name):
    """Those of the driver lead it; of one driver none leads a figure."""
    sheets, found = page_of(name)
    for sheet, grips in zip(sheets, found.data["grips"], strict=True):
        circles = [mark for mark in sheet.left if isinstance(mark, CircleMark)]
        pins = {mark.name for mark in circles if mark.cls.split()[0] == "pin"}
        assert {pin for _, pin, _, _ in grips} == pins
        assert {pin for _, pin, driven, _ in grips if driven} == pins & {*found.driven.pins}
        assert {number for *_, number in grips} == {-1}


def test_nothing_stands_still_that_can_move():
    """Every example moves, groups of class III among them."""
    assert {still(named(name)) for name in WHICH} == {None}


FOUR_BAR = """
[frame]
O = [0, 0]
Q = [{d}, 0]
[links.1]
O-A = {a}
[links.2]
A-B = {b}
[links.3]
Q-B = {c}
[[drivers]]
turn = 1
angle = {angle}
speed = 10
[branches]
B = "left of A-Q"
[ask]
velocity = ["B"]
acceleration = ["B"]
"""


@pytest.mark.parametrize(
    ("a", "b", "c", "d", "angle"), [(4, 3, 2, 4, 30), (3, 2, 2.5, 3, 50), (5, 3, 1, 4, 30)]
)
def test_a_rocker_goes_as_far_as_coupler_and_follower_reach(a, b, c, d, angle):
    """Where these lie in line, A stands b + c from Q: the law of cosines tells its angle."""
    mechanism = mechanism_of(FOUR_BAR.format(a=a, b=b, c=c, d=d, angle=angle))
    found = moving(mechanism, screen_sheets(mechanism))
    assert found is not None and not found.reach.whole
    farthest = degrees(acos((a * a + d * d - (b + c) ** 2) / (2 * a * d)))
    assert isclose(found.reach.high, farthest, abs_tol=1e-6)
    nearest = degrees(acos((a * a + d * d - (b - c) ** 2) / (2 * a * d)))
    assert isclose(found.reach.low, nearest, abs_tol=1e-6)


@pytest.mark.parametrize(("angle", "place"), [(20, 20), (-20, -20), (340, -20), (700, -20)])
def test_a_rocker_that_swings_about_zero_stands_within_its_range(angle, place):
    """Whole turns more or less are the same place."""
    found = cycle(mechanism_of(FOUR_BAR.format(a=3, b=2, c=2.5, d=4, angle=angle)))
    assert place_in(found, *found.ranges[0]) == pytest.approx(place, abs=1e-9)


@pytest.mark.parametrize(
    "name", ["stephenson-2-ternary", "stephenson-3-crank"][: 2 if EVERY else 1]
)
def test_a_group_of_class_iii_goes_as_far_as_its_cycle(name):
    path = reachable_ranges(sweep_of(named(name).scene))
    reach = page_of(name)[1].reach
    assert isclose(reach.low, path.ranges[0][0].low.at, abs_tol=1e-4)
    assert isclose(reach.high, path.ranges[0][-1].high.at, abs_tol=1e-4)


def test_the_way_of_a_group_has_places_close_to_where_a_dyad_is_stretched():
    """There the sign of the dyad changes, and a page knows the group on both sides."""
    found = page_of("stephenson-2-ternary")[1]
    at, states = found.data["course"]["at"], np.array(found.data["course"]["states"])
    turned = np.flatnonzero((states[1:] == -states[:-1]).any(axis=1))
    step = max(np.diff(at))
    assert turned.size
    assert all(at[k + 1] - at[k] < step / 100 for k in turned)


def test_what_only_has_a_place_stands_still():
    """Crank, coupler and follower in line: they reach from pivot to pivot in no other position."""
    mechanism = mechanism_of(FOUR_BAR.format(a=1, b=1, c=1, d=3, angle=0))
    assert words("en")(still(mechanism) or "").startswith(
        "The driver cannot be moved from this position"
    )


def test_a_free_crank_goes_all_the_way_round():
    """The shortest bar of a Grashof chain turns fully: a range of one turn that holds the start."""
    mechanism = mechanism_of(FOUR_BAR.format(a=1, b=4, c=3, d=3.5, angle=400))
    found = moving(mechanism, screen_sheets(mechanism))
    assert found is not None and found.reach.whole
    assert (found.reach.low, found.reach.high) == (360.0, 720.0)


def test_a_wheel_of_double_size_is_back_after_two_turns_of_the_driver():
    """A page that began again after one would throw the wheel half a turn round.

    Where the wheels need many turns, the page ends after one.
    """
    for teeth, turns, whole in ((36, 2, True), (45, 1, False)):
        mechanism = load("examples/scenes/gears-pair.toml", z1=18, z2=teeth)
        found = moving(mechanism, screen_sheets(mechanism))
        assert found is not None
        assert (found.reach.low, found.reach.high) == (0, 360 * turns)
        assert found.reach.whole == whole


def test_a_parallelogram_stays_one_through_its_change_points(page):
    """The coupler keeps its direction all the way round."""
    sheets, found = page_of("four-bar-change-point")
    pins = {
        mark.name: f"m0-{k}"
        for k, mark in enumerate(sheets[0].left)
        if isinstance(mark, CircleMark) and mark.cls == "pin"
    }
    for here in ran(page, found, [10, 170, 190, 350]):
        (bx, by), (cx, cy) = (
            [float(here["marks"][pins[p]][c]) for c in ("cx", "cy")] for p in "BC"
        )
        assert abs(by - cy) < LIMIT < cx - bx


def test_an_antiparallelogram_stays_one_beside_a_followed_group(page):
    """A and B lie on both sides of the frame's line all the way round, and the plate follows."""
    mechanism = load(TESTS / "web/plate-beside-an-antiparallelogram.toml")
    sheets = screen_sheets(mechanism)
    found = moving(mechanism, sheets)
    assert found is not None and found.reach.whole
    pins = {
        mark.name: f"m0-{k}"
        for k, mark in enumerate(sheets[0].left)
        if isinstance(mark, CircleMark) and mark.cls == "pin"
    }
    rows = ran(page, found, [10, 170, 190, 350])
    assert all(here["ok"] for here in rows)
    a, b = ([float(here["marks"][pins[p]]["cy"]) for here in rows] for p in "AB")
    line = (a[0] + a[-1]) / 2
    assert all((ya - line) * (yb - line) < 0 for ya, yb in zip(a, b, strict=True))


def test_a_plate_is_hidden_nowhere(page):
    """A polygon of a body shows at every place, for it is carried along."""
    sheets, _ = page_of("pump")
    plates = [i for i, m, _, _ in fields(sheets) if isinstance(m, Polyline) and m.cls == "plate"]
    for _, here in everywhere(page, "pump"):
        marks = marks_of("pump", here)
        assert plates and all(marks[plate] for plate in plates)


@pytest.mark.parametrize("name", ["gears-pair", "gears-planet", "gears-rack", "gears-ring"])
def test_teeth_mesh_all_the_way(page, name):
    """Two wheels never cut into one another, a ring holds its planet, and teeth go on turning."""
    sheets, found = page_of(name)
    low, high, outlines = found.reach.low, found.reach.high, set()
    shares = np.linspace(0.003, 0.021, 7) if found.driven.unit == "deg" else PLACES
    places = [low + float(share) * (high - low) for share in shares]
    for here in ran(page, found, places):
        marks, shapes = marks_of(name, here), {}
        for mark_id, mark, s, _ in fields(sheets):
            if s == 0 and mark.cls in ("gear", "gear-disc") and isinstance(mark, Polyline):
                at = marks.get(mark_id) or numbers(mark)
                shapes[mark.name] = (
                    mark.cls,
                    shapely.Polygon(list(zip(at[::2], at[1::2], strict=True))),
                )
        for (a, one), (b, other) in combinations(shapes.values(), 2):
            if "gear" not in (a, b):
                assert one.intersection(other).area < 1e-3
            elif {a, b} == {"gear", "gear-disc"}:
                ring, wheel = (one, other) if a == "gear" else (other, one)
                assert wheel.difference(ring).area < 1e-3
        outlines.add(tuple(round(x, 4) for _, shape in shapes.values() for x in shape.bounds))
    assert len(outlines) > len(places) / 2


def by_law(law: str) -> Mechanism:
    """A crank-rocker driven by a law of time."""
    text = FOUR_BAR.format(a=1, b=3, c=2.5, d=3, angle=f'"{law}"').replace("speed = 10\n", "")
    return mechanism_of(f"time = 0.25\n{text}")


def test_a_law_that_makes_no_turn_is_shown_from_the_start_once_to_and_fro():
    mechanism = by_law("75 + 20*sin(180*t)")
    driven = driven_by(mechanism.scene)
    assert driven is not None
    assert window(driven) == pytest.approx((0, 0.25 + 2), abs=1e-6)
    assert still(mechanism) is None


def test_a_law_that_never_turns_back_stands_still_and_says_why():
    mechanism = by_law("75 + 20*t/(1 + t)")
    assert words("en")(still(mechanism) or "").startswith("No driver makes a whole turn")
