"""Trial plans as a hand wants them: round numbers, beside the right plan, told apart from it."""

from __future__ import annotations

import re
from functools import cache
from itertools import pairwise
from math import hypot, log10
from pathlib import Path

import pytest

from graphkin.construction.core.plan_vector import sign_of
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.higher_class.trial_rates import ROUND
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism, load
from graphkin.motion.motion_curves import NEAR, curves_of
from graphkin.numbers.plane import Vector
from graphkin.text import words
from tests.documents.sheet_tools import drawing_of, drawn
from tests.documents.test_words import rare

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
HIGHER = (
    "rapid-return",
    "rod-and-wheel",
    "stephenson-2-binary",
    "stephenson-2-ternary",
    "stephenson-3-crank",
)
"""The example scenes with a group of class III or more."""
PLANES = {Part.VELOCITY: Plane.VELOCITIES, Part.ACCELERATION: Plane.ACCELERATIONS}


@cache
def mechanism(name: str) -> Mechanism:
    """An example scene, read once."""
    return load(SCENES / f"{name}.toml")


def is_called(step: Step, key: str) -> bool:
    """Whether a step's action bears a name."""
    return step.action is not None and step.action.key == key


@pytest.fixture(params=HIGHER)
def higher(request) -> Mechanism:
    return mechanism(request.param)


def shares(some: Mechanism) -> list[tuple[int, Step]]:
    """The steps that say where between its trials a right plan lies."""
    return [(n, s) for n, s in enumerate(some.program.steps) if is_called(s, "share")]


def test_there_is_a_pair_of_trials_for_each_plan(higher):
    assert [step.part for _, step in shares(higher)] == [Part.VELOCITY, Part.ACCELERATION]


def test_both_trials_are_nought_or_a_round_number(higher):
    for rate in higher.trial_rates.values():
        if rate:
            digits = abs(rate) / 10.0 ** (log10(abs(rate)) // 1)
            assert any(abs(digits - digit) < 1e-9 for digit in ROUND), rate


def test_the_right_plan_does_not_hang_on_what_is_tried(higher):
    """Two plans missed in proportion give the right one, whichever two they are."""
    plain, by_hand = higher.trace(), higher.trace(by_hand=True)
    for target, number in higher.program.targets.items():
        if target[0] in ("velocity", "acceleration", "omega", "epsilon"):
            one, two = plain.values[number], by_hand.values[number]
            assert abs(one - two) <= 1e-9 * max(abs(one), 1.0), target


def test_a_solution_is_reckoned_with_the_driver_s_own_rate_and_nought(higher):
    """On paper alone the trials are round: batches need no answer before they begin."""
    trace = higher.trace()
    for _, step in shares(higher):
        first, second = (trace.values[number] for number in step.of.rates)
        assert first == 0
        assert second not in higher.trial_rates.values()


def test_the_trials_take_up_little_more_room_than_the_right_plan(higher):
    trace = higher.trace(by_hand=True)
    steps = higher.program.steps
    for number, share in shares(higher):
        points = [
            (trace.values[n], *(trace.values[arg] for arg in step.args[:2]))
            for n, step in enumerate(steps)
            if is_called(step, "between")
            and step.args[2] == number
            and step.plane is PLANES[share.part]
        ]
        whole = max(abs(right) for right, _, _ in points)
        assert max(abs(tried) for _, *trials in points for tried in trials) < 1.6 * whole
        assert max(abs(one - two) for _, one, two in points) > 0.25 * whole


def components(some: Mechanism, signs: str) -> dict[str, Vector]:
    """The arrows of the components in the right plan, under their symbols."""
    trace = some.trace(by_hand=True)
    return {
        step.name: trace.values[number]
        for number, step in enumerate(some.program.steps)
        if step.arrow and number in trace.values and (sign_of(step) or "-") in signs
    }


def assert_square(one: Vector, other: Vector, symbol: str) -> None:
    """Two arrows stand square to each other."""
    first, second = one.tip - one.tail, other.tip - other.tail
    size = max(abs(first), abs(second))
    assert abs((first * second.conjugate()).real) <= 1e-9 * size * size, symbol


@pytest.mark.parametrize("name", HIGHER)
def test_the_right_plan_has_its_normal_and_tangential_components(name):
    """Between two points of a bar stand the normal component and then the tangential one."""
    arrows = components(mechanism(name), "ντ")
    tangential = [name for name in arrows if name.endswith("τ")]
    assert len(tangential) > 1
    for component in tangential:
        normal, other = arrows[component[:-1] + "ν"], arrows[component]
        assert abs(normal.tip - other.tail) < 1e-9
        assert_square(normal, other, component)


@pytest.mark.parametrize(
    ("name", "slides"), [("rapid-return", {"PP2", "AA3"}), ("rod-and-wheel", {"BB1"})]
)
def test_the_right_plan_has_the_coriolis_component_of_each_slide_and_what_is_left(name, slides):
    """A slide's acceleration is that of the guide's point, Coriolis and what is along the guide."""
    arrows = components(mechanism(name), "cr")
    assert set(arrows) == {f"a_{index}^{sign}" for index in slides for sign in "cr"}
    for index in slides:
        coriolis, left = arrows[f"a_{index}^c"], arrows[f"a_{index}^r"]
        joined = (left.tip == coriolis.tail, coriolis.tip == left.tail)
        assert any(joined), index
        assert_square(coriolis, left, index)


@pytest.mark.parametrize(
    ("name", "asked", "brought", "left"),
    [("rapid-return", "P", {"p′_2", "q′"}, "a′_3"), ("stephenson-2-ternary", "C", {"e′"}, "d′")],
)
def test_arrows_bring_the_point_under_a_sliding_one_and_the_one_that_is_crossed(
    name, asked, brought, left
):
    """Through p′_2 the way leads to p′; by q′, which lines find, the others are divided."""
    program = mechanism(name).program
    needed = program.needed([("acceleration", asked)], by_hand=True)
    names = {program.steps[number].name for number in needed}
    assert brought <= names
    assert left not in names


def test_the_share_is_measured_where_a_crossing_finds_a_point(higher):
    """The hand's way and the gaps give the same share.

    There is no crossing for a given sliding speed, nor for a bar that moves with both its ends.
    """
    trace, steps = higher.trace(by_hand=True), higher.program.steps
    unmeasured = higher.scene.name in ("rod-and-wheel", "stephenson-2-binary")
    assert all((step.by_hand is None) is unmeasured for _, step in shares(higher))
    measured = [(step.by_hand, number) for number, step in shares(higher) if step.by_hand]
    for by_hand, number in measured:
        assert is_called(steps[by_hand], "share-on-line")
        one, two = trace.values[by_hand], trace.values[number]
        assert abs(one - two) < 1e-9 * max(abs(two), 1.0)


def test_gaps_without_a_crossing_are_drawn_square_to_their_lines():
    """From the line of each trial to the point that should lie on it; with a crossing none are."""
    some = rare("block-closes-class-iii")
    for drawing in drawings_of(some, proved(some, some.solve()), words("en")):
        marks = sheet(drawing, "key", "1").marks
        gaps = [mark for mark in marks if mark.name == "gap"]
        lines = [mark for mark in marks if mark.name == "locus of a trial"]
        (share,) = (s for _, s in shares(some) if s.part.value == drawing.kind)
        scale = drawing.scales.kv if drawing.kind == "velocity" else drawing.scales.ka
        assert len(gaps) == len(lines) == 2
        for gap, line, number in zip(gaps, lines, share.args, strict=True):
            u, v = gap.x2 - gap.x1, gap.y2 - gap.y1
            a, b = line.x2 - line.x1, line.y2 - line.y1
            assert abs(u * a + v * b) < 1e-6 * hypot(u, v) * hypot(a, b)
            x, y = gap.x2 - line.x1, gap.y2 - line.y1
            assert abs(x * b - y * a) < 1e-6 * hypot(a, b)
            missed = 1000 * abs(drawing.trace.values[number]) / scale
            assert abs(hypot(u, v) - missed) < 1e-6
    marks = drawn("rapid-return", None, "velocity").page.marks
    assert not [mark for mark in marks if mark.name == "gap"]


def test_a_relative_velocity_on_a_guide_is_an_arrow_along_it():
    """From the point of the guide to the sliding one: what the table gives as the slide's speed."""
    some = mechanism("rapid-return")
    trace = some.trace(by_hand=True)
    steps = some.program.steps
    arrows = {
        s.of.symbol: trace.values[n] for n, s in enumerate(steps) if s.arrow and n in trace.values
    }
    places = [trace.value("position", point) for point in "PQ"]
    speed = some.solve().slides["2"].speed
    for name in ("v_PP2", "v_AA3"):
        way = arrows[name].tip - arrows[name].tail
        along = way / (places[1] - places[0]) * abs(places[1] - places[0])
        assert abs(along.imag) < 1e-9 * abs(way)
        assert abs(abs(along.real) - abs(speed)) < 1e-9 * abs(speed)


def behind(some: Mechanism, number: int) -> set[int]:
    """The steps that a step is drawn from, in the stable way."""
    found, waiting = set(), [number]
    while waiting:
        found.add(step := waiting.pop())
        waiting += some.program.steps[step].args
    return found


def test_a_crossing_uses_nothing_that_the_trials_alone_do_not_give(higher):
    """Its line stands before the share is known, else a hand could not draw it."""
    steps = higher.program.steps
    given_by = {step.by_hand: step.args[2] for step in steps if is_called(step, "between")}
    crossed = {hand: share for hand, share in given_by.items() if hand is not None}
    assert bool(crossed) is (higher.scene.name not in ("rod-and-wheel", "stephenson-2-binary"))
    assert not [hand for hand, share in crossed.items() if share in behind(higher, hand)]


def test_a_trial_is_told_by_a_numeral_below_that_reads_as_no_power():
    """The link under a point comes first; what stands above is left to primes and components."""
    wanted = {"c¹": "*c*_{I}", "c′²": "*c*′_{II}", "p_2¹": "*p*_{2,I}", "c1²": "*c*_{1,II}"}
    assert {name: symbol(name) for name in wanted} == wanted
    for kind in ("velocity", "acceleration"):
        told = " ".join(said.markup for said in sentences(drawing_of("rapid-return", None, kind)))
        assert "_{2,II}" in told
        assert not re.search(r"[a-z]\*′?(_\{\w+\})?\^[12]", told)


@pytest.mark.parametrize("name", ["rapid-return", "stephenson-2-ternary", "stephenson-3-crank"])
def test_of_a_locus_only_the_piece_by_the_fit_is_drawn(name):
    (curve,) = curves_of(mechanism(name))
    (run,) = curve.runs
    fit = mechanism(name).trace().value("position", curve.of)
    lengths = [abs(q - p) for p, q in pairwise(run)]
    nearest = min(range(len(run)), key=lambda i: abs(run[i] - fit))
    assert abs(run[nearest] - fit) <= max(lengths)
    found = [point.position for point in mechanism(name).solve().points.values()]
    places = [place for place in found if place is not None]
    most = NEAR * max(abs(p - q) for p in places for q in places)
    for part in (lengths[:nearest], lengths[nearest:]):
        assert 0 < sum(part) <= most + max(lengths)
