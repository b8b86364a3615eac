"""Scale factors: as large as the page takes, or as the scene says instead."""

import pytest

from graphkin.construction.core.drawn_scene import ROOMY
from graphkin.construction.core.given_data import given
from graphkin.construction.core.layout import lay_out
from graphkin.documents.scaling import drafts_of, scales, sheet_targets
from graphkin.documents.sheet_documents import drawings_of, hand_out, proved
from graphkin.drawing.field import A3, ABOVE, MARGIN
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.drawing.scale import extent_of
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.text.errors import PageError
from tests.chosen import HALVES
from tests.documents.sheet_tools import HEAD, OTHERS, drawings, mechanism_named
from tests.scene_files import scene_text

OMEGA = 12.0
FOUR_BAR = OTHERS["four-bar-with-a-coupler-point"]
"""Driven by one crank at 12 rad/s."""
CONCHOID = scene_text("construction/conchoid")
"""The point P of a bar through a turning block describes a conchoid."""


def scene(sheet="", body=FOUR_BAR, **changes):
    """The four-bar with something said in [sheet], and pieces of its text written otherwise."""
    for old, new in changes.items():
        assert f"{old} = " in body
        body = "\n".join(
            f"{old} = {new}" if line.startswith(f"{old} = ") else line for line in body.split("\n")
        )
    head = HEAD.format(title="Four-bar")
    return Mechanism(read_text(f"{head}[sheet]\n{sheet}\n{body}", "four-bar", None, {}))


def proof(mechanism):
    """A mechanism with its verdict."""
    return mechanism, proved(mechanism, mechanism.solve())


def said(mechanism, kind, view="key", language="en"):
    """All that a sheet says."""
    pages = next(s.pages for s in hand_out(mechanism, view, language) if s.kind == kind)
    return " | ".join(plain(m.markup) for p in pages for m in p.marks if isinstance(m, Text))


# --- as large as the page takes ------------------------------------------------------------------


@pytest.mark.parametrize("name", HALVES[1])
def test_plans_are_drawn_as_many_times_as_large_as_vectors_on_the_mechanism(name):
    """There ka = kv²/kL would hold, as right triangles need it."""
    found = scales(mechanism_named(name))
    kv, ka = found.kv * found.larger, found.ka * found.larger_still
    assert ka == pytest.approx(kv**2 / found.kL, rel=1e-12)
    assert 0 < found.larger <= 5
    assert 0 < found.larger_still <= (5 if found.of_crank else 10)


@pytest.mark.parametrize("name", ["slotted-lever", "watt-1", "five-bar", "stephenson-3", "trammel"])
def test_every_drawing_fits_and_the_next_larger_plan_would_not(name):
    mechanism = mechanism_named(name, 7) if name == "slotted-lever" else mechanism_named(name)
    found = scales(mechanism)
    mm, drafts = 1000 / found.kL, drafts_of(mechanism, sheet_targets(mechanism), (), found)
    boxes = [draft.mechanism_extent() for draft in drafts]
    width = max(box.right for box in boxes) - min(box.left for box in boxes)
    room = A3.room - width * mm
    for draft in drafts:
        plan, times = draft.plan_extent(), found.times(draft.kind)
        wide, high = plan.width * mm, plan.height * mm
        assert wide <= room + 1e-6 and high <= A3.upright + 1e-6
        if times < 5:
            larger = min(m for m in (1, 1.5, 2, 2.5, 3, 4, 5) if m > times) / times
            larger = larger if found.of_crank else 2.5
            assert wide * larger > room or high * larger > A3.upright


@pytest.mark.parametrize("name", ["slotted-lever", "cam-lever", "cam-rocker", "plank-axle"])
def test_longer_vectors_are_plain_multiples_of_the_cranks_scale(name):
    """k_v = ω·k_L/m and k_a = ω²·k_L/m′ for the whole of m and m′: no hand sets 6.75."""
    for n in (7, 19, 21, 22) if name == "slotted-lever" else (0,):
        found = scales(mechanism_named(name, n) if n else mechanism_named(name))
        assert found.of_crank > 1 or n
        for times in (found.of_crank * found.larger, found.of_crank**2 * found.larger_still):
            assert (2 * times).is_integer()


def test_the_labs_own_rule_draws_vectors_as_long_as_the_crank():
    found = scales(scene('rule = "lab"'))
    assert (found.larger, found.larger_still, found.of_crank) == (1, 1, 1)
    assert found.kv == pytest.approx(OMEGA * found.kL, rel=1e-12)
    assert found.ka == pytest.approx(OMEGA**2 * found.kL, rel=1e-12)


def test_the_mechanism_stands_at_one_place_on_both_sheets():
    first, then = drawings_of(*proof(scene()), words("en"))
    assert lay_out(first).mechanism == lay_out(then).mechanism


@pytest.mark.parametrize("size", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_a_mechanism_of_any_size_fills_the_same_page(size):
    """Lengths a thousandfold at the same speeds: kL, kv and ka a thousandfold."""
    here = scales(scene())
    lengths = {"O1-A": 80, "A-B": 230, "A-C": 130, "B-C": 150, "O2-B": 160}
    resized = {name: f"{length * size!r}" for name, length in lengths.items()}
    there = scales(scene(**resized, O2=f"[{250 * size!r}, {40 * size!r}]"))
    for one, other in ((here.kL, there.kL), (here.kv, there.kv), (here.ka, there.ka)):
        assert other == pytest.approx(size * one, rel=1e-9)


# --- enlarge -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("said", "m", "n"), [("0.5", 0.5, 0.5), ("1.5", 1.5, 1.5), ("3", 3, 3), ("[2, 0.5]", 2, 0.5)]
)
def test_plans_are_enlarged_as_the_scene_says(said, m, n):
    found = scales(scene(f"enlarge = {said}"))
    assert found.kv == pytest.approx(OMEGA * found.kL / m, rel=1e-12)
    assert found.ka == pytest.approx(OMEGA**2 * found.kL / n, rel=1e-12)


# --- ka apart ------------------------------------------------------------------------------------


def lengths(mechanism):
    """How long each acceleration is drawn, in mm, wherever it is drawn, by its name."""
    page = next(s.pages[0] for s in hand_out(mechanism, "key", "en") if s.kind == "acceleration")
    found = {}
    for mark in page.marks:
        if mark.cls.split()[0] == "acceleration":
            size = abs(complex(mark.x2 - mark.x1, mark.y2 - mark.y1))
            found.setdefault(mark.name, []).append(size)
    return found


def test_with_a_ka_of_its_own_every_acceleration_is_drawn_at_it():
    mechanism = scene("ka = 0.4")
    motion, found = mechanism.solve(), scales(mechanism)
    assert found.ka == pytest.approx(400, rel=1e-12)
    assert found.kv == pytest.approx(OMEGA * found.kL / found.larger, rel=1e-12)
    drawn = lengths(mechanism)
    for point in ("A", "B", "C"):
        real = abs(motion.points[point].acceleration)
        on_plan, on_mechanism = (drawn[name] for name in (f"o′{point.lower()}′", f"a_{point}"))
        for sizes, times in ((on_plan, 1), (on_mechanism, found.larger_still)):
            for size in sizes:
                assert size == pytest.approx(1000 * real / 400 / times, rel=1e-6)


@pytest.mark.parametrize("line", ["ka = 20", "scale = 1000000"])
def test_the_scale_factor_that_is_proposed_instead_of_a_dot_is_accepted(line):
    with pytest.raises(PageError, match=r"5 mm or more; write a smaller") as refused:
        scales(scene(line))
    proposed = str(refused.value).partition("a smaller ")[2].partition(" or less")[0]
    key, _, number = proposed.partition(", ")
    assert line.startswith(key)
    assert min(longest(scene(f"{key} = {number}"))) >= 5


def longest(mechanism):
    """How large the mechanism is drawn on each sheet, and its longest vector, in mm."""
    found = scales(mechanism)
    for trial in drafts_of(mechanism, sheet_targets(mechanism), (), found):
        yield 1000 * trial.reach / found.kL
        yield 1000 * abs(trial.at_scale(trial.plane, trial.largest)) / found.kL


def test_a_ka_that_needs_a_smaller_mechanism_gets_one_unless_its_scale_is_stated():
    free = scales(scene())
    small = scales(scene("ka = 0.1"))
    assert small.kL >= free.kL and small.ka == pytest.approx(100)


# --- paths ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("language", "name"), [("en", "hart"), ("ro", "chebyshev"), ("it", "trammel")]
)
def test_a_path_reaches_no_farther_into_the_margin_than_letters_leave(language, name):
    """It is drawn whole in its field, clear of the caption's second line and of the foot."""
    drawing, *_ = drawings(name, None, language)
    field = lay_out(drawing).mechanism
    (path,) = (curve for curve in drawing.curves if curve.kind == "trajectory")
    places = [field(point) for run in path.runs for point in run]
    left, top, right, low = field.rect
    assert left + MARGIN - 6.8 <= min(x for x, _ in places)
    assert max(x for x, _ in places) <= right - MARGIN + 6.8
    assert top + ABOVE - 3.1 <= min(y for _, y in places)
    assert max(y for _, y in places) <= low - ABOVE + 3.1


def test_a_path_much_wider_than_the_mechanism_does_not_make_it_small():
    """Of a pin in a turning slot that a straight guide leads far away, the path is cut."""
    body = scene_text("construction/tangent")
    drawing, *_ = drawings_of(*proof(scene(body=body)), words("en"))
    (path,) = (curve for curve in drawing.curves if curve.kind == "trajectory")
    points = [point for run in path.runs for point in run]
    body = extent_of([*drawing.positions.values()])
    most = ROOMY * max(body.width, body.height)
    assert extent_of(points).width > 2 * most
    assert max(drawing.bare_extent().width, drawing.bare_extent().height) <= most
    field = lay_out(drawing).mechanism
    assert not all(field.holds(point) for point in points)


def test_an_angle_is_given_as_it_is_written():
    """180°, not −180°."""
    drawing, *_ = drawings_of(*proof(scene(body=CONCHOID)), words("en"))
    assert "∠*P**A**E* = 180°" in given(drawing)


def test_a_straight_path_leaves_the_mechanism_as_large_as_its_ends_in_the_margin_let_it():
    """Hart's R runs 370.1 mm up and down: 148.0 mm at 1:2.5, where letters would have 146 mm."""
    found = scales(mechanism_named("hart"))
    assert found.kL == 2.5
    assert 370 / found.kL > A3.upright
