"""The board of a task page: the same moves in Python and on the page, and nothing of the key."""

from __future__ import annotations

import json
import re
from cmath import phase
from itertools import product
from math import isnan, log10
from random import Random
from typing import Any

import pytest

from graphkin.construction.board import (
    BETWEEN,
    FARTHEST,
    MOST_MOVES,
    MOST_SIGNS,
    Board,
    BoardGiven,
    Thing,
    board_given,
    is_finite,
    replayed,
)
from graphkin.construction.registry import BOARD
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.plane import Circle, Line
from graphkin.text.errors import PageError
from graphkin.web.offline_page import part
from graphkin.web.screen_sheets import screen_sheets
from graphkin.web.step_page import task_page
from graphkin.web.your_turn import written
from tests.documents.sheet_tools import mechanism_named
from tests.web.drawn_logs import LEVER, PLATFORM, PUMP, RING

LABS = ("pump", "pump-collinear", "offset-slider-crank", "slotted-lever")
TRIALS = 30
"""Random inputs of each action."""
NEAR = 1e-12
"""The share by which Python and the page may differ."""
SCRIPT = """async ([texts, picks, places, millimetre, moves]) => {
  const data = { moves: {}, picks, places, shares: [], seconds: 1, millimetre, words: {} };
  const loads = text => import(`data:text/javascript,${encodeURIComponent(text)}`);
  const [{ palette_of }, actions] = await Promise.all(texts.map(loads));
  const { results_of } = palette_of(data, () => true, actions);
  return moves.map(([action, ...inputs]) => results_of(action, inputs));
}"""

MODULES = ("palette.js", "board_actions.js")
"""The modules that compute the results of moves."""


def scene_of(name: str) -> Mechanism:
    """A lab, or a scene of the examples."""
    return load(name) if name in LABS else mechanism_named(name)


def given_of(name: str) -> tuple[BoardGiven, Any]:
    """What the board of a lab is given, and the values of its key."""
    drawings = [sheet.drawing for sheet in screen_sheets(scene_of(name).measured, "en", "task")]
    values = drawings[0].trace.values | drawings[-1].trace.values
    return board_given(drawings), values


# --- the same on the page and in Python -----------------------------------------------------------


def things(dice: Random) -> dict[str, Thing]:
    """Random things of every kind, in the mechanism and in both plans."""

    def point() -> complex:
        return complex(dice.uniform(-2, 2), dice.uniform(-2, 2))

    found = {
        f"{plane}p{k}": Thing("image" if plane else "point", plane, point())
        for plane, k in product(range(3), range(3))
    }
    found |= {f"{plane}l{k}": Thing("locus", plane, Line(point(), point()))
              for plane, k in product(range(3), range(2))}  # fmt: skip
    found |= {f"{plane}c{k}": Thing("circle", plane, Circle(point(), dice.uniform(1, 3)))
              for plane, k in product(range(3), range(2))}  # fmt: skip
    found |= {"g": Thing("guide", 0, Line(point(), point())), "v": Thing("vector", 3, point())}
    found |= {"54.25mm": Thing("length", 0, 54.25, paper=True), "l": Thing("length", 0, 0.7)}
    found |= {"31.5deg": Thing("angle", 0, 31.5), "-2.5rad": Thing("rate", 0, -2.5)}
    return found


class Table(Board):
    """A board with some things on it, and the bar and the velocity of a right triangle."""

    def __init__(self, dice: Random) -> None:
        self.dice = things(dice)
        given = BoardGiven(self.dice, {}, (0.01, 0.2, 3.0, 1.0), {}, {})
        super().__init__(given)
        p, q = (self.dice[key].value for key in ("0p0", "0p1"))
        self.dice["b"] = Thing("bar", 0, q - p, on=("0p0", "0p1"))
        tail, way = self.dice["1p0"].value, 1j * (q - p) * dice.uniform(-3, 3)
        self.dice["1tip"] = Thing("image", 1, tail + way)
        self.dice["a"] = Thing("arrow", 1, tail + way - tail, on=("1p0", "1tip"))
        self.dice["e"] = Thing("arrow", 2, self.dice["2p1"].value - self.dice["2p0"].value,
                               on=("2p0", "2p1"))  # fmt: skip
        self.images = {"1p0": ["0p0", "0p1"], "1p1": ["0p2"]}

    def places_of(self, image: str) -> list[complex]:
        return [self.value_of(place) for place in self.images.get(image, ())]


def picks_of(table: Table) -> dict[str, dict[str, Any]]:
    """The things of a board as the page has them."""
    found: dict[str, dict[str, Any]] = {}
    for key, each in table.dice.items():
        found[key] = {"kind": each.kind, "plane": each.plane, "name": key, "needs": []}
        found[key] |= {"value": written(each.value)} if not each.on else {"on": each.on}
        found[key] |= {"paper": True} if each.paper else {}
    return found


def inputs_of(action: str, table: Table, dice: Random) -> list[str]:
    """Inputs of an action, taken by chance; those of a right triangle and of images are right."""
    if action == "triangle":
        return [dice.choice(["0p0", "0p1"]), "b", "a"]
    if action == "similar":
        return [*dice.sample(["1p0", "1p1"], 2), "0p1"]
    own = BOARD[action]
    kinds = [each for _, each in own.free or own.slots]
    taken: list[str] = []
    for slot in kinds:
        fit = [key for key, each in table.dice.items() if each.kind in slot and key not in taken]
        plane = (
            table.dice[taken[0]].plane if taken and action in ("cut", "join", "similar") else None
        )
        alike = [key for key in fit if plane is None or table.dice[key].plane in (plane, 0)]
        taken.append(dice.choice(alike or fit))
    return taken


def parts(value: Any) -> list[float]:
    """The numbers of a result as the page has them, a direction as a unit vector."""
    if isinstance(value, Line):
        unit = value.along / abs(value.along)
        return [value.point.real, value.point.imag, unit.real, unit.imag]
    if isinstance(value, Circle):
        return [value.centre.real, value.centre.imag, value.radius]
    return [value.real, value.imag]


def from_page(value: Any) -> Any:
    """A result of the page as one of Python."""
    if isinstance(value, dict):
        return Circle(complex(*value["c"]), value["r"])
    if isinstance(value[0], list):
        return Line(complex(*value[0]), complex(*value[1]))
    return complex(*value)


@pytest.mark.parametrize("action", BOARD)
def test_every_action_draws_the_same_in_python_and_on_the_page(action: str, page: Any):
    met = 0
    for trial in range(TRIALS):
        dice = Random(f"{action} {trial}")
        table = Table(dice)
        inputs = inputs_of(action, table, dice)
        draw = BOARD[action].draw
        assert draw is not None
        own = [each for each in draw(table, *inputs) if is_finite(each)]
        told = ([*map(part, MODULES)], picks_of(table), table.images, table.given.millimetre)
        (found,) = page.evaluate(SCRIPT, [*told, [[action, *inputs]]])
        assert len(found) == len(own), (inputs, found, own)
        met += len(own)
        for one, other in zip(map(from_page, found), own, strict=True):
            size = max(1.0, *map(abs, parts(other)))
            assert all(
                abs(p - q) < NEAR * size for p, q in zip(parts(one), parts(other), strict=True)
            )
    assert met >= TRIALS / 3


# --- a whole plan from a log ----------------------------------------------------------------------


DRAWN = {
    "pump": PUMP,
    "slotted-lever": LEVER,
    "platform-3rpr": PLATFORM,
    "gears-ring": RING,
}
"""Drawings by their scene."""


@pytest.mark.parametrize(("name", "log"), DRAWN.items())
def test_a_plan_drawn_from_its_log_is_that_of_the_key(name: str, log: str):
    given, values = given_of(name)
    board = replayed(given, log)
    assert len(board.named) >= 6
    for letter, key in board.named.items():
        right = values[given.letters[letter].step]
        assert abs(board.own[key].value - right) < 2e-3 * max(1.0, abs(right)), letter


def test_the_path_of_a_crank_pin_is_curved_about_the_fixed_pivot():
    given, _ = given_of("pump")
    board = replayed(given, f"{PUMP}|curv 2 1:>A 2:>A")
    found = board.own[str(board.moves)]
    assert found.plane == 0
    assert abs(found.value - given.things["0:O1"].value) < 1e-3 * 0.3


def test_a_line_is_divided_as_one_of_the_same_drawing_alone():
    """Both ends of a line lie in one drawing, and so do the three points of its pattern."""
    given, _ = given_of("pump")
    assert replayed(given, f"{PUMP}|div 16 20 2 6 10").own
    for mixed in ("div 16 6 2 6 10", "div 16 20 16 6 10", "div 16 20 2 6 24"):
        with pytest.raises(PageError):
            replayed(given, f"{PUMP}|{mixed}")


HOSTILE = (
    "perp",
    "perp 1: O1-A",
    "evil 0:O1",
    "__init__ 0:O1",
    "ray 0:O1 1e999deg",
    "ray 0:O1 nandeg",
    "ray 0:O1 99999999deg",
    "ray 0:O1 44deg|cut 1 1",
    "ray 0:O1 44deg|off 0:O1 1 -60mm /9",
    "ray 0:O1 44deg|cut 1 g:5 /1",
    "ray 0:O1 44deg|name 1 0:A",
    "ray 0:O1 44deg|off 0:O1 1 60mm|name 2 1:A",
    "name 0:O1 0:A",
    "ray 0:O1 44deg 44deg",
    "cut g:5 2",
    "off 0:O1 g:5 99999mm|off 1 g:5 99999mm|off 2 g:5 99999mm",
    "ray 0:O1 44deg|" * (MOST_MOVES + 1),
    "x" * (MOST_SIGNS + 1),
    "ray 0:O1 44deg|cut 1 1:A",
    "\x00|||name",
    "ray 0:O1 ４４deg",
)
"""Logs that no board writes."""


@pytest.mark.parametrize("log", HOSTILE, ids=range(len(HOSTILE)))
def test_a_log_that_no_board_writes_is_refused_in_a_sentence(log: str):
    given, _ = given_of("pump")
    with pytest.raises(PageError):
        replayed(given, log)


def test_nothing_is_drawn_far_off_the_paper():
    given, _ = given_of("pump")
    log = BETWEEN.join(["ray 0:O1 0deg", "off 0:O1 1 9999mm"])
    far = replayed(given, log).own["2"].value
    assert abs(far) < FARTHEST * given.millimetre[0]


# --- nothing of the key ---------------------------------------------------------------------------

SAID = re.compile(r'<script type="application/json" id="board">(.*?)</script>', re.DOTALL)
LEADING = 40
"""The number of results of a key that are looked for."""


def numbers_in(data: Any) -> list[float]:
    """Every number in some data."""
    if isinstance(data, dict):
        return [number for each in data.values() for number in numbers_in(each)]
    if isinstance(data, list):
        return [number for each in data for number in numbers_in(each)]
    return [float(data)] if isinstance(data, int | float) and not isinstance(data, bool) else []


def results_of(name: str) -> list[float]:
    """The leading results of a key: sizes, coordinates and angles of what the sheets draw."""
    given, values = given_of(name)
    found: list[float] = []
    for letter in given.letters.values():
        value = values[letter.step]
        unit = given.millimetre[letter.plane]
        place = value if isinstance(value, complex) else value.start + value.shift / value.size
        found += [abs(place), place.real, place.imag, phase(place)]
        found += [abs(place) / unit, place.real / unit, place.imag / unit]
    own = [abs(each) for each in found if not isnan(each) and abs(each) > 1e-9]
    return own[: max(LEADING, len(own))]


@pytest.mark.parametrize("name", LABS)
def test_the_page_holds_no_value_of_the_key_in_any_rounding(name: str):
    page = task_page(load(name), "en")
    (data,) = SAID.findall(page)
    record = json.loads(data)
    stated = numbers_in(record["picks"]) + list(record["millimetre"])
    for _, *fields in record.pop("fields"):  # on a grid of 10 mm, each at its scale
        assert all(x % 10 == y % 10 == re == im == 0 for x, y, re, im, _ in fields)
    assert {place for own in record.pop("beside").values() for place in own} <= {*range(1, 5)}
    held = [number for number in numbers_in(record) if number not in stated]
    keys = results_of(name)
    assert len(keys) >= LEADING
    for value in keys:
        for digits in range(3, 16):
            rounded = float(f"{value:.{digits}g}")
            assert not [x for x in held if x and abs(abs(x) - rounded) < 1e-9 * rounded], value
    for what in ("moves", "steps", "places", "shares", "digests"):
        assert what not in record


@pytest.mark.parametrize("name", LABS)
def test_what_a_board_is_given_is_what_the_task_states(name: str):
    """Fixed points, poles, guides of the frame, lengths and angles, each from the scene alone."""
    given, _ = given_of(name)
    scene = load(name).measured.scene
    kinds = {each.kind for each in given.things.values()}
    assert kinds <= {"point", "image", "guide", "length", "angle"}
    points = [key[2:] for key, each in given.things.items() if each.kind == "point"]
    assert {*points} == {*scene.fixed_points}
    assert all(each.value == 0 for each in given.things.values() if each.kind == "image")


@pytest.mark.parametrize("name", LABS)
def test_the_place_of_a_drawing_on_its_field_tells_nothing(name: str):
    """Origins and edges lie on a grid of 10 mm, whatever the drawing's extent."""
    for sheet in screen_sheets(load(name), "en", "task"):
        for field in (sheet.layout.mechanism, sheet.layout.plan):
            assert all(abs(place - round(place, -1)) < 1e-9 for place in field(0j))
        assert sheet.layout.plan.rect[0] == round(sheet.layout.plan.rect[0], -1)


@pytest.mark.parametrize("name", ["gears-planet", "oscillating-slide", "stephenson-3-crank"])
def test_every_scene_gets_a_board(name: str):
    page = task_page(mechanism_named(name), "en")
    assert 'id="turn-panel"' in page
    assert log10(len(page)) < 5.6
