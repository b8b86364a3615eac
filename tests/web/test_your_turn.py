"""Your turn: every step of a plan is a move of the palette, and the page computes its value."""

from __future__ import annotations

from functools import cache
from itertools import chain
from typing import Any

import pytest

from graphkin.construction.core.program import SPEEDS, Plane, Program
from graphkin.construction.registry import PALETTE
from graphkin.construction.velocity.relative_motion import LaidOffByRate
from graphkin.mechanism import load
from graphkin.numbers.plane import Circle, Line, Ratio
from graphkin.text import LANGUAGES, words
from graphkin.web.offline_page import part
from graphkin.web.protocol import PageProtocol, telling
from graphkin.web.screen_sheets import ScreenSheet, screen_sheets
from graphkin.web.your_turn import MoveFinder, YourTurn, palette, record, your_turn
from tests.chosen import CHOSEN, SCENES
from tests.documents.sheet_tools import mechanism_named

LABS = ("pump", "pump-collinear", "offset-slider-crank", "slotted-lever")
ALL = tuple(dict.fromkeys((*LABS, *CHOSEN, "plank-two-sizes")))
PLANS = (Plane.VELOCITIES, Plane.ACCELERATIONS)
NEAR = 1e-9
COMING_ALONG = {
    *("arm", "bar-line", "beside", "cam-centre", "cam-lever", "chord-cuts-guide", "close"),
    *("circle-on-diameter", "circle-through", "common-chord", "contact-of-wheels"),
    *("contact-on-track", "coriolis-base", "coriolis-ray", "from-corner", "inflection-circle"),
    *("inflection-meet", "inflection-point", "inflection-square", "instant-centre"),
    *("lacks", "ladder-axis", "ladder-foot", "ladder-ray", "ladder-speeds", "ladder-tip"),
    *("normals-meet", "perpendicular-at", "pin-centre", "pole", "pole-ray", "rack-at", "ray"),
    *("relative-centre", "set-way", "square-to-guide", "step-along", "to-corner", "turn-over"),
}
"""Actions that no move draws: given lines and points, parts of a figure that one move draws, and
special points that a student reads off."""
RESULTS = """async ([texts, record]) => {
  const loads = text => import(`data:text/javascript,${encodeURIComponent(text)}`);
  const [{ palette_of }, actions] = await Promise.all(texts.map(loads));
  const { results_of } = palette_of(record, () => true, actions);
  return Object.fromEntries(Object.entries(record.moves).map(([step, { action, inputs }]) =>
    [step, results_of(action, inputs.map(key => record.picks[key].by || key))]));
}"""

MODULES = ("palette.js", "page_actions.js")
"""The modules that compute the results of moves."""


@cache
def turn_of(name: str) -> tuple[list[ScreenSheet], PageProtocol, YourTurn]:
    """The sheets of a scene, their protocol and the moves."""
    mechanism = mechanism_named(name) if name in SCENES else load(name)
    sheets = screen_sheets(mechanism, "en")
    told = telling(sheets)
    return sheets, told, your_turn(sheets, told)


def flat(value: Any) -> list[float]:
    """The numbers of a value of the page."""
    if isinstance(value, dict):
        return [*value["c"], value["r"]]
    return list(chain.from_iterable(value)) if isinstance(value[0], list) else list(value)


def apart(found: Any, meant: Any, least: float = 0.0) -> float:
    """How far a value of the page is from that of a trace, in parts of what is drawn there, or of
    a ``least`` size, for what falls on the pole."""
    numbers = flat(found)
    if isinstance(meant, Ratio):
        meant = meant.start + meant.shift / meant.size
    if isinstance(meant, Line):
        point, along = complex(*numbers[:2]), complex(*numbers[2:])
        unit = meant.along / abs(meant.along)
        turned = abs((along / abs(along) / unit).imag)
        size = max(abs(meant.point), abs(point)) or 1.0
        return max(turned, abs(((point - meant.point) / unit).imag) / size)
    if isinstance(meant, Circle):
        meant = [meant.centre.real, meant.centre.imag, meant.radius]
    elif isinstance(meant, complex):
        meant = [meant.real, meant.imag]
    else:
        meant = [meant.tail.real, meant.tail.imag, meant.tip.real, meant.tip.imag]
    assert len(meant) == len(numbers)
    size = max(least, *map(abs, meant)) or 1.0
    return max(abs(a - b) for a, b in zip(numbers, meant, strict=True)) / size


def for_speeds_alone(program: Program) -> set[int]:
    """The steps that nothing needs but the points on a line of speeds."""
    others = [target for target in program.targets if target[0] != SPEEDS]
    return {*program.needed(program.targets)} - {*program.needed(others)}


@pytest.mark.parametrize("name", ALL)
def test_every_step_of_a_plan_is_a_move(name):
    """Or one that is drawn already, or has no length: it falls on a point that it is drawn from.

    What only the line of speeds calls for comes along with what it is drawn from.
    """
    sheets, told, turn = turn_of(name)
    program = sheets[0].drawing.trace.program
    along = for_speeds_alone(program)
    assert bool(along) == (name == "gears-kutzbach")
    finder = MoveFinder(sheets, told)
    finder.found()
    for number, at in told.at.items():
        step = finder.steps[number]
        if not at or step.arrow or step.plane not in PLANS or number in along:
            continue
        if number in turn.moves or finder.same.get(number) in turn.moves:
            continue
        values = [turn.values[arg] for arg in step.args[:2]]
        points = [value for value in values if isinstance(value, complex)]
        points += [value.point for value in values if isinstance(value, Line)]
        assert min(abs(turn.values[number] - point) for point in points) < NEAR, (number, step)


@pytest.mark.parametrize("name", ALL)
def test_every_other_action_is_a_move(name):
    """An action that a sentence draws is somewhere a move, or one of those that come along."""
    sheets, told, turn = turn_of(name)
    finder = MoveFinder(sheets, told)
    finder.found()
    for number in told.at:
        step = finder.steps[number]
        if step.action is None or step.arrow:
            continue
        by_hand = finder.steps[step.by_hand] if step.by_hand in finder.values else step
        drawn = by_hand.action or step.action
        moved = number in turn.moves or finder.same.get(number) in turn.moves
        assert moved <= (drawn.key not in COMING_ALONG), drawn.key
        has = drawn.move or step.action.move or isinstance(step.of, LaidOffByRate)
        assert has or drawn.key in COMING_ALONG, drawn.key


@pytest.mark.parametrize("name", ALL)
def test_the_page_computes_what_the_trace_holds(page, name):
    """One result of each move's action is the value of its step."""
    sheets, _, turn = turn_of(name)
    found = page.evaluate(RESULTS, [[*map(part, MODULES)], record(sheets, turn)])
    assert turn.moves
    points = (abs(value) for value in turn.values.values() if isinstance(value, complex))
    least = max(points) / 1000
    for step in turn.moves:
        near = [apart(value, turn.values[step], least) for value in found[str(step)]]
        assert near and min(near) < NEAR, turn.moves[step]


@pytest.mark.parametrize("name", ALL)
def test_what_a_move_is_drawn_from_can_be_picked(name):
    """Each input is of a kind that its place takes, there before the move, under its own name."""
    _, _, turn = turn_of(name)
    for move in turn.moves.values():
        slots = PALETTE[move.action].slots
        assert len(slots) == len(move.inputs)
        for key, (_, kinds) in zip(move.inputs, slots, strict=True):
            pick = turn.picks[key]
            assert pick.kind in kinds
            assert pick.name
            assert set(pick.needs) <= set(move.needs)
            assert not pick.by or turn.picks[pick.by].kind in kinds
        assert all(need < move.step for need in move.needs)
    named = [(p.kind, p.name, p.plane) for p in turn.picks.values()]
    assert len(set(named)) == len(named)


def test_what_a_hand_draws_otherwise_than_it_is_computed_is_drawn_so():
    """Points of links and centres where lines cross, poles of accelerations by equal angles."""
    sheets, _, turn = turn_of("pump")
    steps = sheets[0].drawing.trace.program.steps
    found = {
        steps[number].name: move.action
        for number, move in turn.moves.items()
        if steps[number].by_hand is not None and steps[number].plane is not Plane.NUMBERS
    }
    cut = dict.fromkeys(("C", "c", "c′", "I3"), "cut")
    assert found == {**cut, "J3": "pole", "J4": "pole"}


@pytest.mark.parametrize("name", ["pump", "slotted-lever", "gears-ring", "stephenson-3-crank"])
def test_all_that_the_sheets_draw_comes_of_moves(name):
    """What is drawn by a sentence is a move, or comes along with moves or from what is given."""
    _, told, turn = turn_of(name)
    for number in told.at:
        assert number in turn.moves or set(turn.along[number]) <= set(turn.moves)
    goals = [move for move in turn.moves.values() if move.goal]
    needed, waiting = set[int](), [move.step for move in goals]
    while waiting:
        step = waiting.pop()
        if step not in needed:
            needed.add(step)
            waiting += turn.moves[step].needs
    assert needed == set(turn.moves)


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_input_has_its_word_and_its_line(language):
    spoken = words(language)
    for action, slots in ((key, each.slots) for key, each in PALETTE.items()):
        assert spoken.has(f"turn.action.{action}")
        for slot, _ in slots:
            assert spoken.has(f"turn.slot.{slot}")
        base = "triangle" if action == "klein" else action
        assert spoken.has(f"turn.say.{base}_0")
    for key, said in spoken.sentences.items():
        if key.startswith("turn.say."):
            assert not set(said) & set("<>&*_^"), key


def test_only_actions_that_are_needed_are_offered():
    sheets, _, turn = turn_of("pump")
    offered = [action for action, _ in palette(turn, sheets[0].drawing.words)]
    assert "triangle" in offered and "transfer" in offered
    assert not {"coriolis", "divide", "klein", "join"} & set(offered)
