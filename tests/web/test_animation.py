"""Animations begin where the scene stands, follow the cycle, and nothing leaves the picture."""

from __future__ import annotations

import io
from functools import lru_cache, partial
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import astuple

from graphkin.construction.frame_over_motion import STILL
from graphkin.construction.step_marks import plan_box
from graphkin.drawing.marks import Text, reach
from graphkin.drawing.scale import Extent
from graphkin.mechanism import load
from graphkin.motion.cycle import cycle
from graphkin.text import words
from graphkin.web import frames
from graphkin.web.animation_pictures import (
    AIR,
    AREA,
    BAR,
    EDGE,
    HELD,
    PICTURE,
    SMALL,
    STEEPEST,
    WAYS,
    Stage,
    aside,
    cut,
    leaves,
    mechanism_seen,
    paths_of,
    plan_pane,
    room_in,
    scale_bar,
    scale_in,
    stage,
    worth,
)
from graphkin.web.frames import GROWN, FrameSequence, motion
from graphkin.web.moving_labels import COVERED, GAP, LETTER, crossed, obstacles, price
from graphkin.web.player import PAUSE, gif, player_page, vector_names
from graphkin.web.screen_sheets import screen_sheets
from tests.chosen import EVERY
from tests.running import Run
from tests.scene_files import scene_text

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
NAMES = (
    "belts-arm",
    "pump",
    "slotted-lever",
    "gears-ring",
    "five-bar",
    "four-bar-change-point",
    "stephenson-3-crank",
    "excavator-absolute",
)
"""Whole turns and ranges; drivers that turn, slide and roll; two of them; class III; wheels."""
FRAMES = 12
SLACK = 1e-9


@lru_cache
def shown(name: str) -> FrameSequence:
    """A motion in a few moments."""
    path = SCENES / f"{name}.toml"
    mechanism = load(str(path)) if path.is_file() else load(name, n=7)
    return motion(cycle(mechanism), words("en"), FRAMES)


@pytest.mark.parametrize("name", NAMES)
def test_it_begins_where_the_scene_stands(name):
    found = shown(name)
    first = found.moments[found.order[0]]
    drawn = found.cycle.mechanism.solve()
    size = max(abs(z) for z in first.alone.positions.values())
    for point, place in first.alone.positions.items():
        assert abs(place - drawn.points[point].position) < SLACK * size
    if found.cycle.sweep.driver is not None:
        turn = 360 if found.cycle.sweep.whole else np.inf
        assert abs(first.at - found.cycle.sweep.start) % turn < SLACK


@pytest.mark.parametrize("name", NAMES)
def test_every_moment_is_a_place_of_the_cycle(name):
    """One construction by floats against the batch of all places, closures and all."""
    found = shown(name)
    whole = 360 if found.cycle.sweep.whole else np.inf
    rows = found.cycle.along([m.at for m in found.moments])
    assert len(rows.at) >= len(found.moments) - 2  # dead points have no row
    for moment in found.moments:
        near = np.flatnonzero(np.abs(np.abs(rows.at - moment.at) % whole) < SLACK)
        if not near.size:
            continue
        for point, place in moment.alone.positions.items():
            other = np.broadcast_to(rows.solution.points[point].position, rows.at.shape)[near[0]]
            assert abs(place - other) < 1e-8 * (1 + abs(place)), (name, point, moment.at)


@pytest.mark.parametrize("name", NAMES)
def test_it_goes_on_without_a_jump_and_then_begins_anew(name):
    found = shown(name)
    order, ends = np.array(found.order), len(found.moments) - 1
    steps = np.diff(np.append(order, order[0]))
    assert sorted(abs(steps)) == [1] * ends + [ends]
    assert set(order) == set(range(len(found.moments)))
    places = [moment.at for moment in found.moments]
    assert places == sorted(places)


@pytest.mark.parametrize("name", ["pump", "trammel", "engine", "slider-crank-slider", "five-bar"])
def test_every_point_moves_as_its_velocity_says(name):
    """Ranges and whole turns, drivers in both senses, a law of time: Δr is about v·Δt, Δt > 0."""
    found = shown(name)
    fast = found.cycle.along([moment.at for moment in found.moments])
    ways, speeds = [], []
    for point, moves in fast.solution.points.items():
        speed = np.broadcast_to(moves.velocity, fast.at.shape)
        for here, there in pairwise(found.order):
            rows = [np.flatnonzero(fast.at == found.moments[n].at) for n in (here, there)]
            if abs(here - there) == 1 and all(row.size for row in rows):
                one, two = (found.moments[n].alone.positions[point] for n in (here, there))
                ways.append(two - one)
                speeds.append((speed[rows[0][0]] + speed[rows[1][0]]) / 2)
    along = np.real(np.array(ways) * np.conj(speeds))
    apart = np.abs(ways) * np.abs(speeds)
    assert np.sum(apart > 0) >= FRAMES // 2
    assert np.median(along[apart > 0] / apart[apart > 0]) > 0.95
    assert np.mean(along[apart > 0] > 0) > 0.9


@pytest.mark.parametrize("name", NAMES)
def test_nothing_leaves_its_field_and_scales_stay(name):
    found = shown(name)
    set_up = stage(found, words("en"))
    for moment in found.moments:
        parts = [(set_up.mechanism, set_up.mechanism_marks(moment.alone))]
        for kind, drawing in moment.drawings.items():
            field = set_up.seated(drawing)
            assert field.rect == set_up.plans[kind].rect
            assert (field.mm, field.middle) == (set_up.plans[kind].mm, set_up.plans[kind].middle)
            parts.append((field, [*cut(set_up.plan_marks(drawing, field), field.rect)]))
        for field, marks in parts:
            for mark in marks:
                box = reach(mark)
                room = 3.0 if isinstance(mark, Text) else 1.0 if mark.cls[:5] == "arrow" else 1e-6
                assert box[0] > field.rect[0] - room, (name, moment.at, mark)
                assert box[1] > field.rect[1] - room, (name, moment.at, mark)
                assert box[2] < field.rect[2] + room, (name, moment.at, mark)
                assert box[3] < field.rect[3] + room, (name, moment.at, mark)


@pytest.mark.parametrize("name", NAMES)
def test_the_bar_of_a_scale_is_as_long_as_it_says_and_stands_right_of_its_caption(name):
    """In every pane: round, at most 30 mm, between two ends of 2 mm, told to its left."""
    set_up = stage(shown(name), words("en"))
    for field, caption, unit, size in set_up.captions:
        bar, *ends, told = scale_bar(field, unit, size, words("en"))
        number, _, said = told.markup.partition(" ")
        assert (bar.x2 - bar.x1) == pytest.approx(float(number) * size * field.mm)
        assert float(number) / 10 ** np.floor(np.log10(float(number)) + SLACK) in (1, 2, 2.5, 5)
        assert said == unit.replace("/s2", "/s^2") or "^" in said
        assert [(end.x1, end.x2, end.y2 - end.y1) for end in ends] == [
            (x, x, pytest.approx(2)) for x in (bar.x1, bar.x2)
        ]
        assert {(end.y1 + end.y2) / 2 for end in ends} == {bar.y1} == {bar.y2}
        assert bar.x2 == pytest.approx(field.rect[2] - 4)
        longest = min(BAR, (field.rect[2] - field.rect[0]) / 2 - 4)
        assert longest / STEEPEST - SLACK <= bar.x2 - bar.x1 <= longest + SLACK
        box, head = reach(told), Text(field.rect[0] + 3, field.rect[1] + 4.5, caption, "", SMALL)
        assert field.rect[0] < box[0] < box[2] < bar.x1
        assert reach(head)[2] < box[0] or reach(head)[3] < box[1]
        assert field.rect[1] < box[1] < bar.y1 < box[3] + 1


@pytest.mark.parametrize("name", NAMES)
def test_a_path_is_drawn_of_every_asked_point_that_moves_and_of_no_other(name):
    """Each as its own points go: through every moment of the ranges, a whole turn closed."""
    found = shown(name)
    scene, points = found.cycle.scene, found.cycle.solution.points
    asked = {*scene.ask.velocity, *scene.ask.acceleration, *scene.ask.curves}
    paths = [*paths_of(found)]
    assert len(paths) == len(asked.difference(scene.fixed_points))
    for path in paths:
        own = [z.position for n, z in points.items() if n in asked and np.ndim(z.position)]
        assert min(abs(row[np.isfinite(row)] - path[0]).min() for row in own) < SLACK
        assert len({*path}) > 1
        jumps = abs(np.diff(path))
        assert jumps.max() < 0.35 * max(np.ptp(np.real(path)), np.ptp(np.imag(path)))


@pytest.mark.parametrize("way", WAYS)
def test_the_worth_of_panes_grows_as_drawings_do_and_twice_as_much_by_the_mechanism(way):
    """k times as small drawings fit k times as large; a plan counts once, the mechanism twice."""
    rects, box = way(0.5, 2), Extent(-1.0, -1.0, 2.0, 1.0)
    plans = [[box], [Extent(0.0, 0.0, 1.0, 3.0)]]
    small, thin = (Extent(*(side / 2 for side in astuple(each))) for each in (box, plans[1][0]))
    whole = worth(rects, box, plans)
    assert worth(rects, small, plans) == pytest.approx(4 * whole)
    assert worth(rects, box, [[box], [thin]]) == pytest.approx(2 * whole)


@lru_cache
def closely(name: str, *, beside: bool) -> Stage:
    """The stage of a motion in as many moments as it is shown."""
    path = SCENES / f"{name}.toml"
    mechanism = load(str(path)) if path.is_file() else load(name, n=7)
    return stage(motion(cycle(mechanism), words("en")), words("en"), beside=beside)


@pytest.mark.parametrize(("name", "beside"), [("pump", False), ("slotted-lever", True)])
def test_plans_fill_a_third_of_their_panes_at_the_median(name, beside):
    """A scale for the peaks alone would make a dot of what is seen most of the time."""
    set_up = closely(name, beside=beside)
    assert set(set_up.plans) == {"velocity", "acceleration"}
    for kind, field in set_up.plans.items():
        left, top, right, bottom = field.rect
        boxes = [plan_box(moment.drawings[kind]) for moment in set_up.motion.moments]
        filled = [
            max(box.width * field.mm / (right - left), box.height * field.mm / (bottom - top))
            for box in boxes
        ]
        assert np.median(filled) > 1 / 3, (kind, np.median(filled))
        gone = [leaves(plan_pane(field, box), box) for box in boxes]
        assert np.mean(gone) <= 1 - HELD[-1] + 1 / len(boxes)


@pytest.mark.parametrize("name", NAMES)
def test_a_plan_that_has_room_stands_in_its_pane_and_a_larger_one_is_told(name):
    found = shown(name)
    set_up = stage(found, words("en"))
    said = words("en")("animation.beyond")
    for moment in found.moments:
        told = [m for m in set_up.moving(moment) if isinstance(m, Text) and m.markup == said]
        gone = 0
        for drawing in moment.drawings.values():
            field, box = set_up.seated(drawing), plan_box(drawing)
            room = room_in(field.rect, AIR)
            size = box.width * field.mm, box.height * field.mm
            fits = size[0] <= room[2] - room[0] and size[1] <= room[3] - room[1]
            assert not (fits and leaves(field, box)), (name, moment.at)
            assert field.holds(0j, AIR - SLACK), (name, moment.at)
            gone += leaves(field, box)
        assert len(told) == gone


@given(st.floats(-50, 150), st.floats(0, 200), st.floats(0, 1), st.floats(-1e-3, 1e-3))
def test_a_plan_is_moved_aside_no_more_than_needed_and_without_a_jump(low, size, part, more):
    start, end, pole = 10.0, 90.0, low + part * size
    way = aside(low, low + size, pole, start, end)
    if low >= start and low + size <= end:
        assert way == 0
    if size <= end - start:
        assert low + way >= start - SLACK
        assert low + size + way <= end + SLACK
    assert start - SLACK <= pole + way <= end + SLACK
    grown = max(size + more, 0.0)
    assert (
        abs(aside(low, low + grown, low + part * grown, start, end) - way) <= 2 * abs(more) + SLACK
    )


@pytest.mark.parametrize(
    ("name", "unit", "ends"),
    [("pump", "°", ("−32.62°", "186.9°")), ("trammel", " mm", ("−220.0 mm", "220.0 mm"))],
)
def test_the_driver_is_told_in_its_own_unit(name, unit, ends):
    page = player_page(shown(name), words("en"))
    assert f'"unit":"{unit}"' in page
    assert f"The mechanism reaches from {ends[0]} to {ends[1]};" in page


STRONG = ("link", "guide", "slider", "block", "guide-bar")


@pytest.mark.parametrize(
    "name", ["pump", "slotted-lever", *(["rapid-return", "crank-rocker"] if EVERY else [])]
)
def test_letters_of_the_mechanism_seldom_lie_on_bars_and_never_on_one_another(name):
    """Before, every third one did: on the walls of guides, on blocks, on bars that turn below."""
    set_up = closely(name, beside=True)
    ground = [mark for mark in set_up.ground if mark.cls.split()[0] in STRONG]
    covered, letters = 0, 0
    for moment in set_up.motion.moments:
        seen = mechanism_seen(moment.alone, set_up.mechanism)
        lines = [mark for mark in seen.marks if mark.cls.split()[0] in STRONG]
        ends = obstacles([*lines, *ground])[0]
        placed = [m for m in set_up.mechanism_marks(moment.alone) if isinstance(m, Text)]
        boxes = [reach(text) for text in placed]
        for i, box in enumerate(boxes):
            middle = np.array([[(box[0] + box[2]) / 2, (box[1] + box[3]) / 2]])
            half = (box[2] - box[0]) / 2, (box[3] - box[1]) / 2
            covered += bool(crossed(middle, half, ends).any())
            letters += 1
            for other in boxes[:i]:
                assert (
                    box[0] > other[2] or other[0] > box[2] or box[1] > other[3] or other[1] > box[3]
                )
    assert letters > 0.9 * len(set_up.motion.moments) * len(seen.letters)
    assert covered < 0.16 * letters


@pytest.mark.parametrize("beside", [False, True])
@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
def test_letters_of_the_frame_stand_clear_of_hatching(name, beside):
    set_up = closely(name, beside=beside)
    moment = set_up.motion.moments[0]
    marks = [*mechanism_seen(moment.alone, set_up.mechanism).marks, *set_up.ground]
    ends = obstacles([mark for mark in marks if mark.cls.split()[0] == "ground"])[0]
    fixed = set_up.motion.cycle.scene.frame.points
    placed = set_up.mechanism_marks(moment.alone)
    letters = [m for m in placed if isinstance(m, Text) and m.name in fixed]
    assert len(letters) == len(fixed)
    for text in letters:
        box = reach(text)
        middle = np.array([[(box[0] + box[2]) / 2, (box[1] + box[3]) / 2]])
        half = (box[2] - box[0]) / 2, (box[3] - box[1]) / 2
        assert not crossed(middle, half, ends).any(), text


@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
def test_letters_go_smoothly_with_their_points(name):
    """Each as far from its point as at any other moment, but where it yields to another."""
    set_up = closely(name, beside=True)
    for moment in set_up.motion.moments:
        seen = mechanism_seen(moment.alone, set_up.mechanism)
        for text in set_up.mechanism_marks(moment.alone):
            if isinstance(text, Text):
                (x, y), rule = seen.places[text.name], set_up.rules["mechanism"][text.name]
                box = reach(text)
                across = (box[0] + box[2]) / 2 - x
                down = (box[1] + box[3]) / 2 - y
                wide = rule.far + seen.letters[text.name].width / 4
                assert (across / wide) ** 2 + (down / rule.far) ** 2 == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("name", ["pump", "slotted-lever", "trammel", "roller"])
def test_what_belongs_to_the_frame_does_not_travel(name):
    found = shown(name)
    field = stage(found, words("en")).mechanism
    fixed = [
        {m for m in mechanism_seen(moment.alone, field).marks if m.cls in STILL}
        for moment in found.moments
    ]
    assert all(marks == fixed[0] for marks in fixed)


@pytest.mark.parametrize("beside", [False, True])
@pytest.mark.parametrize("name", ["pump", "trammel", "roller"])
def test_guides_and_tracks_end_within_their_field(name, beside):
    set_up = stage(shown(name), words("en"), beside=beside)
    left, top, right, bottom = set_up.mechanism.rect
    marks = [mark for mark in set_up.ground if mark.cls.split()[0] in STILL]
    assert marks
    for mark in marks:
        box = reach(mark)
        assert left + EDGE <= box[0] + SLACK and box[2] - SLACK <= right - EDGE, mark
        assert top + EDGE <= box[1] + SLACK and box[3] - SLACK <= bottom - EDGE, mark


@pytest.mark.parametrize("name", ["pump", "trammel"])
def test_it_ends_before_a_dead_point(name):
    """There a driver at constant speed gives velocities without bound."""
    found = shown(name)
    assert found.reached[0] < found.low < found.high < found.reached[1]
    assert found.shortened
    rows = found.cycle.along(np.linspace(found.low, found.high, 200))
    for rate in ("velocity", "acceleration"):
        every = [getattr(p, rate) for p in found.cycle.solution.points.values()]
        usual = np.median(
            np.max([np.abs(np.broadcast_to(v, found.cycle.at.shape)) for v in every], axis=0)
        )
        here = [getattr(p, rate) for p in rows.solution.points.values()]
        assert max(float(np.max(np.abs(v))) for v in here) <= 1.1 * GROWN * usual


def test_a_whole_turn_is_not_cut():
    found = shown("slotted-lever")
    assert not found.shortened
    assert len(found.order) == FRAMES


@lru_cache
def gif_of(name: str) -> bytes:
    """The picture that moves of a motion."""
    return gif(shown(name), words("en"))


def test_a_gif_has_all_its_pictures_and_the_same_bytes_again():
    from PIL import Image

    found, data = shown("pump"), gif_of("pump")
    assert data == gif(found, words("en"))
    with Image.open(io.BytesIO(data)) as picture:
        assert picture.n_frames == len(found.order)
        assert picture.info["loop"] == 0
        assert picture.info["duration"] == PAUSE
        assert picture.width / picture.height == pytest.approx(PICTURE[0] / PICTURE[1], rel=0.01)
    assert len(data) < 5e6 * len(found.order) / 72


def test_the_first_picture_is_the_drawn_position():
    """The ink of a pin's place: dark where A stands, white where it stands nowhere."""
    from PIL import Image

    found = shown("pump")
    set_up = stage(found, words("en"))
    with Image.open(io.BytesIO(gif_of("pump"))) as picture:
        dots = np.asarray(picture.convert("L"))
    drawn = found.cycle.mechanism.solve()
    scale = dots.shape[1] / PICTURE[0]
    for name in "ABCD":
        x, y = set_up.mechanism(complex(drawn.points[name].position))
        around = dots[int((y - 1.5) * scale) : int((y + 1.5) * scale)]
        assert around[:, int((x - 1.5) * scale) : int((x + 1.5) * scale)].min() < 100
    left, top = int((AREA[0] + 2) * scale), int((AREA[1] + 12) * scale)
    assert dots[top : top + 20, left : left + 20].min() > 240


@pytest.fixture
def in_few_moments(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a command moves, it moves in as many moments as are looked at here."""
    monkeypatch.setattr(frames, "motion", partial(motion, frames=FRAMES))


@pytest.mark.usefixtures("in_few_moments")
def test_the_command_writes_both(run: Run, tmp_path: Path):
    args = ("cycle", "slotted-lever", "-o", tmp_path, "--format", "gif,html", "--steps", "4")
    result = run(*args)
    assert result.exit_code == 0, result.output
    names = {path.name for path in tmp_path.iterdir()}
    stem = next(name for name in names if name.endswith("-cycle.csv")).removesuffix("-cycle.csv")
    tables = {f"{stem}-cycle.csv", f"{stem}-extremes.csv"}
    assert names == {*tables, f"{stem}-motion.gif", f"{stem}-motion.html"}
    again = run(*args)
    assert again.exit_code == 2
    assert "--force" in again.stderr


@pytest.mark.parametrize("kind", ["gif", "html"])
def test_what_cannot_move_is_a_message(run: Run, tmp_path: Path, kind: str):
    path = tmp_path / "rigid.toml"
    path.write_text(scene_text("web/rigid"), encoding="utf-8")
    result = run("cycle", path, "-o", tmp_path / "out", "--format", kind)
    assert result.exit_code == 2
    assert "Traceback" not in result.output
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("in_few_moments")
def test_a_page_moves_one_of_several_drivers(run: Run, tmp_path: Path):
    args = ("cycle", SCENES / "five-bar.toml", "--driver", "2", "-o", tmp_path)
    assert run(*args, "--format", "html,gif", "--steps", "4").exit_code == 0
    page = (tmp_path / "five-bar-motion.html").read_text(encoding="utf-8")
    assert '<label for="at">Driver <i>φ</i><sub>4</sub></label>' in page


@pytest.mark.parametrize("plans", [1, 2, 3])
@pytest.mark.parametrize("share", [0.4, 0.7])
def test_panes_part_the_picture_without_rest(share, plans):
    """The mechanism has its share of it, all plans alike what is left."""
    for way in WAYS:
        own, *others = (shapely.box(*rect) for rect in way(share, plans))
        whole = shapely.box(*AREA)
        assert own.area == pytest.approx(share * whole.area)
        assert len(others) == plans
        assert {round(each.area, 6) for each in others} == {
            round((1 - share) * whole.area / plans, 6)
        }
        assert shapely.union_all([own, *others]).symmetric_difference(whole).area < 1e-6
    assert [len({rect[1] for rect in way(0.4, 3)}) for way in WAYS] == [3, 2, 1]
    assert [len({rect[0] for rect in way(0.4, 3)}) for way in WAYS] == [2, 3, 4]


def test_a_scale_is_that_of_the_largest_part_of_a_motion_at_which_a_plan_is_half_its_room():
    """Not that of a peak: boxes of a motion, by twentieths of it; all where nothing is peaked."""
    room = (0.0, 0.0, 60.0, 30.0)

    def scale(*sizes):
        return scale_in(room, [Extent(0, 0, size, size / 4) for size in sizes])

    assert scale(*[20.0] * 20) == pytest.approx(3.0)
    assert scale(*[20.0] * 19, 39.0) == pytest.approx(60 / 39)
    assert scale(*[20.0] * 19, 41.0) == pytest.approx(3.0)
    assert scale(*[20.0] * 17, 30.0, 50.0, 60.0) == pytest.approx(2.0)
    assert scale(*[20.0] * 10, *[90.0] * 10) == pytest.approx(60 / 90)
    assert scale_in(room, [Extent(0, 0, 10, 20)]) == pytest.approx(1.5)
    assert scale(0.0) == 1.0


PLACES = st.tuples(st.floats(-20, 20), st.floats(-20, 20))


@given(st.lists(st.tuples(PLACES, PLACES), min_size=1, max_size=8), PLACES)
def test_a_box_is_crossed_by_what_meets_it(lines, place):
    """By another library, for boxes that a hair's breadth decides not about."""
    half, (x, y) = (3.0, 1.5), place
    ends = np.array([[*one, *other] for one, other in lines])
    found = crossed(np.array([place]), half, ends)[0]
    for line, is_met in zip(map(shapely.LineString, lines), found, strict=True):
        narrow, wide = (
            shapely.box(x - 3 - e, y - 1.5 - e, x + 3 + e, y + 1.5 + e) for e in (-1e-9, 1e-9)
        )
        assert is_met or not line.intersects(narrow)
        assert not is_met or line.intersects(wide)


def test_a_letter_pays_for_each_thing_that_it_covers():
    """A line by its price, a point within a millimetre, another letter, and the edge of the pane;
    what lies beside it costs nothing."""
    width, half = 4.0, (4.0 / 2 + GAP / 2, LETTER / 2 + GAP / 2)
    spots = np.array([(20.0, 20.0), (80.0, 20.0), (50.0, 60.0), (100.0 - half[0] + 0.1, 40.0)])
    none = np.empty((0, 4)), np.empty(0), np.empty((0, 2))

    def cost(lines=none, letters=()):
        return list(price(spots, width, lines, letters, (0.0, 0.0, 100.0, 80.0)))

    outside, point, letter = (COVERED[key] for key in ("outside", "point", "letter"))
    assert cost() == [0, 0, 0, outside]
    lines = np.array([(10.0, 20.0, 30.0, 20.0), (19.0, 10.0, 19.0, 30.0), (0.0, 75.0, 99.0, 75.0)])
    assert cost((lines, np.array([0.5, 0.25, 9.0]), none[2])) == [0.75, 0, 0, outside]
    for off, met in ((half[0] + 0.9, True), (half[0] + 1.1, False)):
        near = np.array([(80 + off, 20.0)])
        assert cost((*none[:2], near)) == [0, point * met, 0, outside]
        near = np.array([(80.0, 20 - off + half[0] - half[1])])
        assert cost((*none[:2], near)) == [0, point * met, 0, outside]
    beside = ((50.0, 60 + LETTER + GAP - 0.1), 6.0), ((20.0, 20 + LETTER + GAP + 0.1), 6.0)
    assert cost(letters=beside) == [0, 0, letter, outside]


@pytest.mark.parametrize(("name", "asked"), [("pump", {"D"}), ("slotted-lever", {"C", "A3"})])
def test_vectors_are_named_that_are_asked_for_first_and_no_other_counts_as_asked(name, asked):
    for number, (sheet, sign) in enumerate(zip(screen_sheets(load(name), "en"), "va", strict=True)):
        names = [*vector_names(sheet, number)]
        flags = [each.asked for each in names]
        assert {each.text.name for each in names if each.asked} == {f"{sign}_{p}" for p in asked}
        assert flags == sorted(flags, reverse=True)
        assert {*flags} == {True, False}
        lines = [int(each.line.partition("-")[2]) for each in names]
        drawn = sheet.left + sheet.right
        looks = [drawn[line].cls.split()[0] for line in lines]
        assert [each.text.cls for each in names] == [f"label {look}" for look in looks]
