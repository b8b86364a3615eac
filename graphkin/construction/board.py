"""The board of a task page: what a student is given, and a drawing replayed from its log.

A log is a line of moves, with ``|`` between them. A move is the word of an action and the keys of
what it is drawn from, such as ``perp 1: O1-A``; the result of the third move is ``3``. Where an
action has several results, ``/1`` takes the second one. ``name 3 1:A`` gives a point its letter.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from math import degrees, isfinite
from typing import Any

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.naming import angle_symbol
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import KINDS
from graphkin.construction.guides.guides import GuideLine
from graphkin.construction.registry import BOARD
from graphkin.drawing.symbol_markup import bar
from graphkin.numbers.plane import Line, Ratio
from graphkin.scene.link_points import SIGN, lettered
from graphkin.scene.model import lengths_of
from graphkin.text.errors import Message, PageError, Problem, message

PLANES = (Plane.MECHANISM, Plane.VELOCITIES, Plane.ACCELERATIONS, Plane.NUMBERS)
"""The drawings, in the order of their numbers on a page."""
MOST_SIGNS, MOST_MOVES = 4000, 400
"""The most characters and moves of a log, which fits a cell of a table."""
FARTHEST = 1e5
"""The farthest that anything may be drawn, in mm of paper."""
BETWEEN = "|"
"""The sign between the moves of a log."""
VECTOR_OF = {1: "v", 2: "a"}
"""The letters of the vectors of both plans."""
WORDS = {
    next(word for word in each.typed if word.isascii() and word.isalpha()): key
    for key, each in BOARD.items()
}
"""The actions by their words in a log."""
BESIDE = "and"
"""The input of an action that must lie in the drawing of the input before it."""
NAME = "name"
"""The move that gives a point its letter."""
TYPED = re.compile(r"(-?[0-9]{1,5}(?:\.[0-9]{1,6})?)(mm|deg|rad)")
"""A typed number: a length in mm of paper, an angle in degrees, a rate in rad/s."""
KIND_OF = {"mm": "length", "deg": "angle", "rad": "rate"}
"""The kind of thing that a typed number is, by its unit."""


class Thing(Struct, frozen=True):
    """A thing on the board: its kind, the number of its drawing, and its value.

    ``name`` is its markup. Between the two points ``on`` lies a bar or an arrow. ``paper`` says
    that a length is in mm of paper.
    """

    kind: str
    plane: int
    value: Any = None
    name: str = ""
    on: tuple[str, ...] = ()
    paper: bool = False


class BoardLetter(Struct, frozen=True):
    """A letter that a drawn point may have: its markup, drawing, point, and step.

    ``of`` is the place in the mechanism that the point shows; empty for a centre or a pole.
    """

    name: str
    plane: int
    of: str
    step: int


class BoardGiven(Struct, frozen=True):
    """What the task states: fixed points, guides, lengths and angles, and the letters to be drawn.

    ``things`` are given by their keys. ``millimetre`` is a millimetre of paper in each drawing.
    ``bars`` are pairs of places, and ``arrows`` pairs of letters, between which the board has a bar
    and a vector once both are drawn.
    """

    things: Mapping[str, Thing]
    letters: Mapping[str, BoardLetter]
    millimetre: tuple[float, ...]
    bars: Mapping[str, tuple[str, str, str]]
    arrows: Mapping[str, tuple[str, str, str]]


def board_given(drawings: Sequence[Drawing]) -> BoardGiven:
    """What a task states, for the sheets of one mechanism; nothing in it is a result."""
    first = drawings[0]
    targets, scene = first.trace.program.targets, first.scene
    places: dict[int, str] = {}
    for (what, of), number in targets.items():
        if what == KINDS[0]:
            places.setdefault(number, of)
    place_of = {of: places[n] for (what, of), n in targets.items() if what == KINDS[0]}
    letters = dict(letters_of(drawings, place_of))
    things = {
        f"0:{point}": Thing("point", 0, first.trace.values[targets[KINDS[0], point]],
                            first.symbol(point))
        for point in scene.fixed_points
        if (KINDS[0], point) in targets
    }  # fmt: skip
    things |= {
        pole_key(plane): Thing("image", plane, 0j, each.symbol(each.pole))
        for each in drawings
        if (plane := PLANES.index(each.plane))
    }
    things |= dict(guides(first)) | dict(lengths(first)) | dict(angles(first))
    letters = {key: each for key, each in letters.items() if key not in things}
    bars, arrows = pairs(first, place_of, letters)
    scales = (lay_out(each) for each in drawings)
    millimetre = {
        PLANES.index(d.plane): 1 / s.plan.mm for d, s in zip(drawings, scales, strict=True)
    }
    millimetre[0] = 1 / lay_out(first).mechanism.mm
    return BoardGiven(
        things,
        letters,
        tuple(millimetre.get(plane, 1.0) for plane in range(len(PLANES))),
        bars,
        arrows,
    )


def pole_key(plane: int) -> str:
    return f"{plane}:"


def letters_of(
    drawings: Sequence[Drawing], place_of: Mapping[str, str]
) -> Iterator[tuple[str, BoardLetter]]:
    """The letters of the points that a sheet shows, by their keys."""
    seen = set[int]()
    for drawing in drawings:
        steps, values = drawing.trace.program.steps, drawing.trace.values
        for (what, of), number in drawing.trace.program.targets.items():
            step, value = steps[number], values.get(number)
            if number in seen or not step.name or not step.args or step.plane not in PLANES[:3]:
                continue
            if not isinstance(value, complex | Ratio):
                continue
            seen.add(number)
            plane = PLANES.index(step.plane)
            place = place_of.get(of, of) if what in KINDS else ""
            key = f"{plane}:{of}" if what in KINDS else f"{plane}:{of}.{what.replace(' ', '-')}"
            yield key, BoardLetter(drawing.symbol(step.name), plane, place, number)


def guides(drawing: Drawing) -> Iterator[tuple[str, Thing]]:
    """The guides of the frame: straight lines that the task states."""
    program, seen = drawing.trace.program, set[tuple[Any, ...]]()
    for number, value in drawing.trace.values.items():
        kind = program.steps[number].of
        if isinstance(kind, GuideLine) and isinstance(value, Line) and type(kind) is GuideLine:
            slide = drawing.scene.links[kind.block].slides[0]
            if slide.on == drawing.scene.frame.name and value not in seen:
                seen.add(value)
                name = kind.path_name(drawing) or drawing.words("turn.line", name=kind.block)
                yield f"g:{kind.block}", Thing("guide", 0, value, name)


def lengths(drawing: Drawing) -> Iterator[tuple[str, Thing]]:
    """The stated lengths of bars."""
    scene = drawing.scene
    for link in scene.links.values():
        for placing in link.placings:
            for p, q, size in lengths_of(placing):
                value = float(size.si(scene.values))
                yield f"l:{p}-{q}", Thing("length", 0, value, bar(p, q))


def angles(drawing: Drawing) -> Iterator[tuple[str, Thing]]:
    """The stated angles of drivers against the frame."""
    scene = drawing.scene
    for number, driver in enumerate(scene.drivers):
        if driver.kind == "turn" and driver.against == scene.frame.name:
            turned = degrees(float(driver.position.si(scene.values)))
            yield f"a:{number + 1}", Thing("angle", 0, turned, angle_symbol(scene, driver))


Pairs = dict[str, tuple[str, str, str]]
"""Bars or arrows by their keys: the keys of both ends, and the markup of the name."""


def pairs(
    drawing: Drawing, place_of: Mapping[str, str], letters: Mapping[str, BoardLetter]
) -> tuple[Pairs, Pairs]:
    """The bars between places of one link, and the arrows of the plans between their letters."""
    scene, bars, arrows = drawing.scene, Pairs(), Pairs()
    plans = sorted({each.plane for each in letters.values() if each.plane})

    def arrow(plane: int, tail: str, tip: str) -> None:
        ends = f"{plane}:{tail}" if tail else pole_key(plane), f"{plane}:{tip}"
        if ends[1] in letters and (not tail or ends[0] in letters):
            sign = f"{VECTOR_OF[plane]}_{lettered(tip)}{lettered(tail) if tail else ''}"
            arrows[f"{plane}:{tail}>{tip}"] = *ends, drawing.symbol(sign)

    for link in scene.links.values():
        own = [of for of in place_of if of in link.points or of.endswith(f"{SIGN}{link.name}")]
        for p, q in combinations(own, 2):
            one, two = place_of[p], place_of[q]
            if one != two and f"{two}-{one}" not in bars:
                bars[f"{one}-{two}"] = f"0:{one}", f"0:{two}", bar(one, two)
            for plane in plans:
                arrow(plane, p, q)
    for plane in plans:
        for of, place in place_of.items():
            arrow(plane, "", of)
            if of != place:
                arrow(plane, of, place)
    return bars, arrows


# --- a drawing from its log -----------------------------------------------------------------------


class Board:
    """A drawing that grows move by move from what is given; see ``DrawnThings``.

    ``own`` maps the keys of drawn things to them, ``named`` the keys of letters to the keys of
    their points.
    """

    def __init__(self, given: BoardGiven) -> None:
        self.given = given
        self.own: dict[str, Thing] = {}
        self.named: dict[str, str] = {}
        self.moves = 0

    # --- what the actions ask -------------------------------------------------------------------

    def thing(self, key: str) -> Thing:
        """A thing by its key. Raises KeyError for one that is not there."""
        if key in self.own:
            return self.own[key]
        if key in self.given.things:
            return self.given.things[key]
        if key in self.named:
            return self.own[self.named[key]]
        pair = self.given.bars.get(key) or self.given.arrows.get(key)
        if pair is not None:
            tail, tip = map(self.thing, pair[:2])
            kind = "bar" if key in self.given.bars else "arrow"
            return Thing(kind, tail.plane, tip.value - tail.value, on=pair[:2])
        if found := TYPED.fullmatch(key):
            kind = KIND_OF[found[2]]
            return Thing(kind, 0, float(found[1]), paper=kind == "length")
        raise KeyError(key)

    def value_of(self, key: str) -> Any:
        return self.thing(key).value

    def way(self, key: str) -> complex:
        """The direction of a bar, a vector or a line."""
        value = self.value_of(key)
        return complex(value.along if isinstance(value, Line) else value)

    def reach(self, length: str, at: str) -> float:
        """A length in the drawing of another thing."""
        found = self.thing(length)
        return float(found.value) * (
            self.given.millimetre[self.thing(at).plane] if found.paper else 1.0
        )

    def ends_of(self, bar: str) -> tuple[complex, complex]:
        """The two ends of a bar."""
        p, q = (self.value_of(end) for end in self.thing(bar).on)
        return p, q

    def arm(self, point: str, bar: str) -> complex | None:
        """The vector along a bar from its other end to a point at one end; None elsewhere."""
        p, q = self.ends_of(bar)
        here = self.thing(point)
        at = [self.thing(end) is here for end in self.thing(bar).on]
        return q - p if at[1] else p - q if at[0] else None

    def places_of(self, image: str) -> Sequence[complex]:
        """The places in the mechanism whose image a thing is."""
        here, found = self.thing(image), list[complex]()
        if any(here is self.given.things.get(pole_key(plane)) for plane in (1, 2)):
            return [each.value for each in self.given.things.values() if each.kind == "point"]
        for key, own in self.named.items():
            place = f"0:{self.given.letters[key].of}"
            if self.own[own] is here and (place in self.named or place in self.given.things):
                found.append(self.value_of(place))
        return found

    # --- moves ----------------------------------------------------------------------------------

    def move(self, words: Sequence[str]) -> None:
        """Make one move. Raises ValueError, KeyError or ZeroDivisionError for one that fails."""
        self.moves += 1
        action, *inputs = words
        if action == NAME:
            point, letter = inputs
            self.name(point, letter)
            return
        which = int(inputs.pop()[1:]) if inputs and re.fullmatch(r"/[0-9]", inputs[-1]) else 0
        own = BOARD[WORDS[action]]
        slots = own.free or own.slots
        if len(inputs) != len(slots):
            raise ValueError(action)
        taken = [self.thing(key) for key in inputs]
        if any(each.kind not in kinds for each, (_, kinds) in zip(taken, slots, strict=True)):
            raise ValueError(action)
        for one, two, (slot, _) in zip(taken, taken[1:], slots[1:], strict=False):
            if slot == BESIDE and one.plane != two.plane:
                raise ValueError(action)
        assert own.draw is not None
        plane = taken[own.lies_with].plane if own.plane is None else own.plane
        value = [each for each in own.draw(self, *inputs) if is_finite(each)][which]
        if not self.is_near(value, plane):
            raise ValueError(action)
        self.own[str(self.moves)] = Thing(kind_of(own.shape, plane), plane, value)

    def name(self, point: str, letter: str) -> None:
        """Give a drawn point a letter, which no other point has."""
        plane = self.given.letters[letter].plane
        if self.own[point].kind not in ("point", "image") or self.own[point].plane != plane:
            raise ValueError(point)
        self.named[letter] = point

    def is_near(self, value: Any, plane: int) -> bool:
        """Whether a result lies at most ``FARTHEST`` from the origin of its drawing."""
        place = value[0] if isinstance(value, tuple) else value
        unit = self.given.millimetre[plane] if plane < PLANES.index(Plane.NUMBERS) else 1.0
        return bool(abs(place) < FARTHEST * unit)


def is_finite(value: Any) -> bool:
    """Whether all numbers of a result are finite, as on the page."""
    parts = value if isinstance(value, tuple) else (value,)
    return all(isfinite(abs(part)) for part in parts)


def kind_of(shape: str, plane: int) -> str:
    """The kind of thing that an action gives."""
    if shape == "point":
        return ("point", "image", "image", "vector")[plane]
    return {"line": "locus", "circle": "circle"}[shape]


def replayed(given: BoardGiven, log: str) -> Board:
    """The drawing of a log. Raises PageError, with the move, for a log of another task."""
    board = Board(given)
    if len(log) > MOST_SIGNS:
        raise PageError(unplayed(message("has {count} characters", count=len(log)),
                                 message("at most {most}", most=MOST_SIGNS)))  # fmt: skip
    moves = [move.split() for move in log.split(BETWEEN) if move.strip()]
    if len(moves) > MOST_MOVES:
        raise PageError(unplayed(message("has {count} moves", count=len(moves)),
                                 message("at most {most}", most=MOST_MOVES)))  # fmt: skip
    for number, move in enumerate(moves, 1):
        try:
            board.move(move)
        except (ArithmeticError, IndexError, KeyError, TypeError, ValueError):
            found = message("cannot be drawn from its move {number} on", number=number)
            raise PageError(
                unplayed(found, message("a drawing made on this task's page"))
            ) from None
    return board


def unplayed(found: Message, expected: Message) -> Problem:
    """The problem of a log that is no drawing."""
    return Problem("drawing", found, expected)
