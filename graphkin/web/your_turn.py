"""Your turn: the page's data for the moves of a student, and the owner of the score sheet."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

from msgspec import Struct

from graphkin.construction.centres.instant_centre import VelocityNormal
from graphkin.construction.core.component import Component, LaidOff, TriangleComponent
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import Construction, PlanPole, construction, constructions
from graphkin.construction.core.naming import (
    is_foot_drawn,
    letter_at,
    rate_symbol,
    sense,
    vector_of,
)
from graphkin.construction.core.palette import SIMILAR, Move, images_and_place
from graphkin.construction.core.program import Part, Plane, Step, plan_vector
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.vocabulary import (
    Action,
    in_proportion,
    lay_back,
    lay_off,
    similar_point,
)
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.forces.force_drawing import ForceLayout
from graphkin.construction.forces.polygon import PolygonSide
from graphkin.construction.higher_class.divided_point import DividedPoint
from graphkin.construction.plan import TurningOfLink
from graphkin.construction.registry import PALETTE, SAID_FIRST
from graphkin.construction.velocity.relative_motion import (
    AboutPivot,
    AlongGuide,
    LaidOffByRate,
    TurnedVelocity,
)
from graphkin.drawing.field import Field
from graphkin.drawing.symbol_markup import symbol, tag_words
from graphkin.numbers.plane import Circle, Line, Ratio, Vector, cross
from graphkin.text import Words
from graphkin.web.protocol import PageProtocol
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.writers.templates import marked_up

PLANES = (
    Plane.MECHANISM,
    Plane.VELOCITIES,
    Plane.ACCELERATIONS,
    Plane.NUMBERS,
    Plane.FORCES,
)
"""The drawings, in the order of their numbers on the page."""
PLAN_NAMES = {
    Plane.VELOCITIES: "sheet.velocity",
    Plane.ACCELERATIONS: "sheet.acceleration",
    Plane.FORCES: "sheet.force",
}
"""The plans, and the keys of their names."""
LAID_OFF: tuple[Action, ...] = (lay_off, lay_back)
"""The actions that lay off a component of an acceleration from a point of a plan."""


Way = tuple[str, tuple[str, ...]]
"""An action of the palette and its inputs, by the names of the picks."""


class Pick(Struct, frozen=True):
    """An object that a move can start from: a point, line, bar, vector, length or rate.

    ``needs`` are the moves that must come first. ``on`` are the two steps between whose points it
    lies on the screen. ``value`` is its value where no move gives it. ``by`` is the point that is
    picked in place of one too near to be drawn.
    """

    kind: str
    name: str
    plane: Plane
    needs: tuple[int, ...]
    value: Any = None
    on: tuple[int, ...] = ()
    by: str = ""


class PaletteMove(Struct, frozen=True):
    """An action of the palette that gives a recorded ``step`` from its ``inputs``, by their names.

    ``about`` is the subject of the message for a wrong choice; ``at`` is the sentence that draws
    the step; ``needs`` are the moves before it. A ``goal`` is drawn for its own sake, other moves
    only towards a goal. ``turns`` are the rate of a velocity laid off perpendicular to its bar, and
    its sense. ``turned`` is the key of the sentence for a component that is laid off backwards.
    ``keeps`` are the bar or guide that the motion on a line respects, and the step of the end of
    the bar whose image the line starts from.
    """

    step: int
    action: str
    inputs: tuple[str, ...]
    name: str
    about: str
    at: int
    needs: tuple[int, ...]
    goal: bool
    turns: tuple[str, ...] = ()
    turned: str = ""
    keeps: tuple[str, int] | None = None


Error = tuple[str, str, tuple[str, ...]]
"""The key of a known wrong move, its action, and its inputs."""


class YourTurn(Struct, frozen=True):
    """All moves of some sheets, all picks, and the moves behind the steps drawn along with them.

    ``places`` are the points of the mechanism by the step of their image. ``shares`` are the steps
    for the ratios that divide lines of auxiliary plans, with the moves that each needs. ``alike``
    says whether a link has a third point, whose image is similar to the link. ``errors`` are the
    known wrong moves in place of a move. ``shorter`` are the inputs of a similar figure that gives
    a point for which the sheet draws two lines.
    """

    moves: Mapping[int, PaletteMove]
    picks: Mapping[str, Pick]
    along: Mapping[int, tuple[int, ...]]
    places: Mapping[int, tuple[int, ...]]
    shares: Mapping[int, tuple[int, ...]]
    values: Mapping[int, Any]
    planes: Mapping[int, Plane]
    alike: bool
    errors: Mapping[int, Sequence[Error]]
    shorter: Mapping[int, tuple[str, ...]]


class MoveFinder:
    """Finds the moves of the recorded program of some sheets, in its order."""

    def __init__(self, sheets: Sequence[ScreenSheet], protocol: PageProtocol) -> None:
        self.drawings = [sheet.drawing for sheet in sheets]
        self.protocol = protocol
        self.steps = self.drawings[0].trace.program.steps
        self.values: dict[int, Any] = {}
        for sheet in sheets:
            self.values |= values_on(sheet)
        self.moves: dict[int, PaletteMove] = {}
        self.picks: dict[str, Pick] = {}
        self.same: dict[int, int] = {}
        self.parts: dict[int, int] = {}
        self.known: dict[tuple[Any, ...], int] = {}
        self.rates: dict[tuple[Any, ...], int] = {}
        self.places = self.places_of_images()
        self.arrows = {
            (step.args[0], step.args[1]): number
            for number, step in enumerate(self.steps)
            if step.arrow and number in protocol.at and isinstance(self.values[number], Vector)
            if step.plane in PLANES[1:3] and len(step.args) == 2
        }

    def found(self) -> YourTurn:
        """Every move, and every pick."""
        for number in sorted(self.values):
            self.move(number)
        self.more_picks()
        shown = {Plane.MECHANISM, Plane.NUMBERS, *(drawing.plane for drawing in self.drawings)}
        self.picks = {key: pick for key, pick in self.picks.items() if pick.plane in shown}
        along = {
            number: self.needs([number]) for number in self.protocol.at if number not in self.moves
        }
        divided = [n for n, move in self.moves.items() if move.action == "divide"]
        shares = {share: self.needs([share]) for share in map(self.share, divided)}
        planes = {number: self.steps[number].plane for number in self.values}
        planes |= {self.share(number): self.steps[number].plane for number in divided}
        alike = any(
            self.steps[n].action is similar_point and self.steps[n].plane in PLANES[1:3]
            for n in self.moves
        )
        return YourTurn(
            *(self.moves, self.picks, along, self.places, shares, self.values, planes, alike),
            self.errors(),
            self.shorter(),
        )

    def shorter(self) -> dict[int, tuple[str, ...]]:
        """The inputs by which similarity gives a point that crossing lines find by hand."""
        found = {}
        for number, move in self.moves.items():
            step = self.steps[number]
            if move.action == "cut" and step.action is similar_point and step.plane in PLANES[1:3]:
                way = self.all_of(SIMILAR.key, *images_and_place(self, number, step.args))
                if way:
                    found[number] = way[1]
        return found

    def errors(self) -> dict[int, list[Error]]:
        """The known wrong moves by the move that each is made for; right moves are none of them."""
        right = {(move.action, move.inputs) for move in self.moves.values()}
        found: dict[int, list[Error]] = {}
        kinds = constructions(self.drawings[0].trace.program, Construction)
        for kind in kinds:
            if not any(self.same.get(step, step) in self.moves for _, step in kind.given()):
                continue
            for error in kind.errors(self, self.steps):
                line = self.same.get(error.line, error.line)
                way = self.all_of(error.action.key, *error.inputs)
                if way and line in self.moves and way not in right:
                    right.add(way)  # of two names for one wrong move the first holds
                    found.setdefault(line, []).append((error.key, *way))
        return found

    # --- dependencies ----------------------------------------------------------------------------

    def needs(self, numbers: Iterable[int]) -> tuple[int, ...]:
        """The nearest moves behind some steps; a step that is a move counts itself."""
        found, seen, waiting = set[int](), set[int](), [*numbers]
        while waiting:
            number = waiting.pop()
            number = self.same.get(number, number)
            if number in seen or number not in self.values:
                continue
            seen.add(number)
            kind = construction(self.steps[number])
            if number in self.moves or number in self.parts:
                found.add(self.parts.get(number, number))
            elif isinstance(kind, Component) and kind.vector in self.moves:
                found.add(kind.vector)
            else:
                waiting += self.steps[number].args
        return tuple(sorted(found))

    def drawing(self, number: int) -> Drawing:
        """The sheet whose plan holds a step, or else the first sheet that draws it."""
        ran = [each for each in self.drawings if number in each.trace.values]
        own = (each for each in ran if each.plane is self.steps[number].plane)
        return next(own, ran[0])

    def places_of_images(self) -> dict[int, tuple[int, ...]]:
        """The points of the mechanism by image; images of auxiliary plans are matched by letter."""
        targets = self.drawings[0].trace.program.targets
        found: dict[int, list[int]] = {}
        for (quantity, of), number in targets.items():
            place = targets.get(("position", of))
            if quantity in ("velocity", "acceleration") and place in self.values:
                found.setdefault(number, []).append(place)
        named = {(self.steps[n].plane, self.steps[n].name): places for n, places in found.items()}
        for number in self.values:
            step = self.steps[number]
            if step.aside is not None and (places := named.get((step.plane, step.letter))):
                found[number] = places
            elif step.action is similar_point and step.plane in PLANES[1:3]:
                ratio = self.steps[step.args[2]]
                if ratio.action is in_proportion and self.steps[ratio.args[0]].name:
                    for image, place in zip(step.args, ratio.args, strict=False):
                        if image in self.values and place not in found.setdefault(image, []):
                            found[image].append(place)
                    found.setdefault(number, [ratio.args[2]])
        return {number: tuple(places) for number, places in found.items()}

    # --- moves -----------------------------------------------------------------------------------

    def move(self, number: int) -> None:
        """Record the move that gives a step, if any; like steps map to the first one."""
        step = self.steps[number]
        key = self.drawn_alike(number)
        alike = self.known.get(key, number)
        way = None if alike in self.moves else self.way(number)
        if way is None:
            if step.args:  # given steps are never alike
                self.known[key] = alike
                if alike != number:
                    self.same[number] = alike
            return
        self.known[key] = number
        action, inputs = way
        name, about = self.words_of(number, action, inputs)
        picks = [self.picks[name] for name in inputs]
        needs = {need for pick in picks for need in pick.needs}
        if action == "divide":
            needs |= {*self.needs([self.share(number)])}
        goal = step.plane is Plane.FORCES or (bool(step.name) and step.plane is not Plane.NUMBERS)
        at = self.sentence(number)
        self.moves[number] = PaletteMove(
            *(number, action, inputs, name, about, at, tuple(sorted(needs)), goal),
            turns=self.turns(number),
            turned=self.turned(number),
            keeps=self.keeps(number, action, inputs),
        )
        if step.plane is not Plane.NUMBERS and action != "transfer":
            self.point_or_line(number, name)

    def share(self, number: int) -> int:
        """The step that measures the ratio in which a point divides its line."""
        kind = construction(self.steps[number])
        assert isinstance(kind, DividedPoint)
        by_hand = self.steps[kind.share].by_hand
        return by_hand if by_hand in self.values and by_hand is not None else kind.share

    def drawn_alike(self, number: int) -> tuple[Any, ...]:
        """The key that steps share if they are drawn alike."""
        step = self.steps[number]
        args = tuple(self.same.get(arg, arg) for arg in step.args)
        drawn = id(step.action), args, step.extra, step.part, step.plane, step.arrow
        return *drawn, self.values[number]

    def way(self, number: int) -> Way | None:
        """The action that gives a step, and its inputs; None for a step without a move."""
        step, kind = self.steps[number], construction(self.steps[number])
        if isinstance(kind, Component) and kind.vector == number:
            if kind.palette is None or not kind.is_drawn(self.drawing(number)):
                return None
            return self.all_of(kind.palette.key, *kind.picked_from(self))
        if isinstance(kind, TriangleComponent) or not self.is_drawn(number):
            return None
        by_hand = step.by_hand in self.values and step.by_hand is not None
        drawn = self.steps[step.by_hand] if by_hand and step.by_hand is not None else step
        move = step.action.move if step.action is not None else None
        if move is not None and move.at_once:
            if not by_hand or self.place(number) is None:
                return None
            self.parts |= dict.fromkeys(drawn.args, number)
            return self.by_move(move, number, step)
        if isinstance(kind, LaidOffByRate) and not step.arrow:
            return self.by_move(kind.move, number, step)
        move = drawn.action.move if drawn.action is not None else None
        return self.by_move(move, number, drawn) if move is not None else None

    def by_move(self, move: Move, number: int, drawn: Step) -> Way | None:
        """A move with its inputs; None if this drawing has no such move or place."""
        if move.in_plan and self.steps[number].plane not in PLAN_NAMES:
            return None
        if move.action.shape == "point" and self.place(number) is None:
            return None
        return self.all_of(move.action.key, *move.inputs(self, number, drawn.args))

    def all_of(self, action: str, *inputs: str | None) -> Way | None:
        """An action with its inputs; None where one of them cannot be picked."""
        found = tuple(name for name in inputs if name is not None)
        return (action, found) if len(found) == len(inputs) else None

    def is_drawn(self, number: int) -> bool:
        """Whether a sentence draws a step, by itself or as the end of a vector."""
        return bool(self.protocol.at.get(number) or [*self.drawn_around(number)])

    def sentence(self, number: int) -> int:
        """The sentence that draws a step: its own, or the first that draws what goes with it."""
        return self.protocol.at.get(number, 0) or min(self.drawn_around(number))

    def drawn_around(self, number: int) -> Iterator[int]:
        """The sentences that draw the triangle of a component, or a vector that is laid off."""
        kind, drawing = construction(self.steps[number]), self.drawing(number)
        around: Collection[int] = ()
        if isinstance(kind, TriangleComponent):
            around = [step for _, step in kind.given()]
        elif number in drawing.feet:
            around = [drawing.feet[number]]
        elif isinstance(kind, LaidOffByRate):
            users = drawing.children.get(number, ())
            around = [user for user in users if not self.steps[user].arrow]
        yield from (at for step in around if (at := self.protocol.at.get(step, 0)))

    # --- picks -----------------------------------------------------------------------------------

    def point_or_line(self, number: int, name: str = "") -> str | None:
        """The pick of a point, line or arc by its step; None for an invisible one."""
        number = self.same.get(number, number)
        key = str(number)
        if key in self.picks:
            return key
        step, value, by = self.steps[number], self.values.get(number), ""
        kind = construction(step)
        if isinstance(value, Line | Circle):
            seen = number in self.protocol.at or step.plane in (Plane.MECHANISM, Plane.NUMBERS)
            name = name or self.name_of_line(number)
            what = self.kind_of_line(number)
            given = isinstance(value, Line) and what == "guide"
            if given and (other := self.guide_alike(name, value)):
                if value == self.picks[other].value:
                    return other
                by = other
        else:
            ends = isinstance(kind, LaidOff | LaidOffByRate | PolygonSide) and not step.name
            if ends and number not in self.moves:
                by = self.point_or_line(step.args[0]) or ""
                if not self.drawing(number).settled(abs(value - self.values[step.args[0]])):
                    return by
            seen = number in self.protocol.at or bool(by) or number in self.moves
            seen = seen and self.place(number) is not None
            name = name or self.letter(number)
            what = "point" if step.plane is Plane.MECHANISM else "image"
            what = "centre" if isinstance(value, Ratio) else what
        if not seen or not name:
            return None
        plane = Plane.MECHANISM if step.plane is Plane.NUMBERS else step.plane
        own = None if number in self.moves else value
        needs = (number,) if number in self.moves else self.needs([number])
        self.picks[key] = Pick(what, name, plane, needs, own, by=by)
        return key

    def guide_alike(self, name: str, line: Any) -> str | None:
        """An existing pick for a guide of the same name on the same line.

        The two may differ in zero and sense; where that matters, both are tried.
        """
        for key, pick in self.picks.items():
            same = (pick.kind, pick.name, pick.by) == ("guide", name, "")
            if same and isinstance(pick.value, Line):
                apart = cross(pick.value.along, line.point - pick.value.point)
                turned = cross(pick.value.along, line.along)
                sizes = abs(pick.value.along), abs(line.along), self.drawings[0].reach
                near = abs(apart) <= NOISE * sizes[0] * sizes[2]
                if near and abs(turned) <= NOISE * sizes[0] * sizes[1]:
                    return key
        return None

    def kind_of_line(self, number: int) -> str:
        """The kind of a line: an arc, a guide that is given or on the mechanism, or a locus."""
        step = self.steps[number]
        if isinstance(self.values[number], Circle):
            return "circle"
        given = step.plane is Plane.NUMBERS or step.part is Part.POSITION
        return "guide" if given else "locus"

    def noted(self, key: str, *pick: Any) -> str:
        """The key of a pick, which is added if it is new."""
        self.picks.setdefault(key, Pick(*pick))
        return key

    def bar(self, p: int, q: int) -> str | None:
        """The bar between two points of the mechanism."""
        p, q = sorted(self.same.get(end, end) for end in (p, q))
        ends = self.point_or_line(p), self.point_or_line(q)
        if p == q or ends[0] is None or ends[1] is None:
            return None
        key, name = f"{p}-{q}", self.picks[ends[0]].name + self.picks[ends[1]].name
        return self.noted(key, "bar", name, Plane.MECHANISM, self.needs([p, q]), None, (p, q))

    def arrow(self, tail: int, tip: int, name: str = "") -> str | None:
        """The vector between two points of a plan; unnamed, it follows its arrow."""
        if not name and (tip, tail) in self.arrows:
            tail, tip = tip, tail
        ends = self.point_or_line(tail), self.point_or_line(tip)
        if ends[0] is None or ends[1] is None:
            return None
        number = self.arrows.get((tail, tip))
        vector = plan_vector(self.steps[number]) if number is not None else None
        if vector:
            name = self.drawing(tip).symbol(vector.symbol)
        elif not name:
            letters = self.picks[ends[0]].name + self.picks[ends[1]].name
            name = vector_of(self.drawing(tip), tail, tip, letters)
        key, plane = f"{ends[0]}>{ends[1]}", self.steps[tip].plane
        on = int(ends[0]), int(ends[1])
        return self.noted(key, "arrow", name, plane, self.needs(on), None, on)

    def length(self, number: int, length: int) -> str:
        """The length that is laid off at a step."""
        kind, key = construction(self.steps[number]), f"l{length}"
        role = self.steps[number].role
        laid = kind.laid_length(role) if kind is not None else None
        drawing = self.drawing(number)
        if laid is not None:
            name = symbol(laid.first) + symbol(laid.last) + "/2" * laid.half
        else:
            name = drawing.words("turn.length", name=self.letter(number))
        needs = self.needs([length])
        return self.noted(key, "length", name, Plane.NUMBERS, needs, self.values[length])

    def place_of(self, image: int) -> str | None:
        """The point of the mechanism whose image a step is; of several points the first."""
        places = self.places.get(image)
        return self.point_or_line(places[0]) if places else None

    def pole_of(self, number: int) -> str | None:
        """The pole of the plan in which a step lies."""
        plane, aside = self.steps[number].plane, self.steps[number].aside
        for each, step in enumerate(self.steps):
            if (step.plane, step.aside) == (plane, aside) and isinstance(step.of, PlanPole):
                return self.point_or_line(each)
        return None

    def shown_vector(self, number: int) -> str | None:
        """The vector of a plan that a step sets on the mechanism."""
        vector = plan_vector(self.steps[number])
        _, tail, tip, *_ = self.steps[number].args
        return self.arrow(tail, tip, self.drawing(number).symbol(vector.symbol) if vector else "")

    def vector(self, number: int) -> str | None:
        """A vector that is known before it is laid off; None for a vector of length zero."""
        step = self.steps[number]
        start, *others = step.args
        kind, drawing = construction(step), self.drawing(number)
        value = self.values[number] - self.values[start]
        if not drawing.settled(abs(value)):
            return None
        likewise = (step.action, tuple(others), step.extra)
        key, on = f"v{self.rates.setdefault(likewise, number)}", tuple(others[:2])
        if step.action in LAID_OFF:
            key, value = f"v{self.same.get(others[0], others[0])}", self.values[others[0]]
            component = construction(self.steps[others[0]])
            own = kind.vector_to(step.role) if kind is not None else ""
            name = component.symbol(drawing) if isinstance(component, Component) else own
            ends = component.shown_between() if isinstance(component, Component) else ()
            on = tuple(end for end in ends if end in self.values and end is not None)
        elif isinstance(kind, LaidOffByRate):
            name = kind.fields(drawing, step.role)["vector"]
            on = () if isinstance(kind, DrivenSlide) else on
        else:
            return None
        if step.aside is not None and isinstance(kind, LaidOffByRate):
            name += f" ({tag_words(step.aside.tag)})"
        return self.noted(key, "vector", name, step.plane, self.needs(others), value, on)

    def rate(self, number: int) -> str | None:
        """The angular velocity of a link."""
        kind, name = construction(self.steps[number]), rate_symbol(self.drawing(number), number)
        on = kind.places if isinstance(kind, TurningOfLink) else ()
        own = name, Plane.NUMBERS, self.needs([number]), self.values[number], on
        return self.noted(f"r{number}", "rate", *own)

    def more_picks(self) -> None:
        """Add picks that no move starts from, to give the student a choice."""
        targets = self.drawings[0].trace.program.targets
        for number in self.protocol.at:
            step = self.steps[number]
            drawn = step.plane in PLANES[:3] and step.part is not Part.NORMAL and not step.arrow
            if step.name and drawn and number not in self.same:
                self.point_or_line(number)
        for link in self.drawings[0].scene.links.values():
            ends = (targets.get(("position", point)) for point in link.points)
            placed = [end for end in ends if end in self.values and end is not None]
            for p, q in combinations(placed, 2):
                self.bar(p, q)
        for tail, tip in self.arrows:
            self.arrow(tail, tip)
        slots = (slot for move in self.moves.values() for slot in PALETTE[move.action].slots)
        if any("rate" in kinds for _, kinds in slots):
            for (quantity, _), number in targets.items():
                if quantity == OMEGA and number in self.values:
                    self.rate(number)

    # --- names -----------------------------------------------------------------------------------

    def place(self, number: int) -> complex | None:
        """The place of a point; None for any other value and for a point at infinity."""
        value = self.values.get(number)
        if isinstance(value, Ratio):
            return self.drawing(number).place(value)
        return value if isinstance(value, complex) else None

    def letter(self, number: int) -> str:
        """The letter of a point, or the vector that it ends."""
        step = self.steps[number]
        kind, drawing, vector = construction(step), self.drawing(number), ""
        if step.name:
            return drawing.symbol(step.name)
        if isinstance(kind, LaidOff | LaidOffByRate) and number in drawing.feet:
            letter = letter_at(drawing, number)
            if letter and isinstance(kind, LaidOff) and kind.is_short(drawing):
                return f"{drawing.symbol(letter)} + {kind.component.symbol(drawing)}"
            if letter and (
                isinstance(kind, LaidOff) or is_foot_drawn(drawing, drawing.feet[number])
            ):
                return drawing.symbol(letter)
        if isinstance(kind, LaidOff):
            vector = kind.component.symbol(drawing)
        elif isinstance(kind, LaidOffByRate):
            vector = kind.fields(drawing, step.role)["vector"]
        elif kind is not None:
            vector = kind.vector_to(step.role)
        if not vector:
            return ""
        tag = f" ({tag_words(step.aside.tag)})" if step.aside else ""
        return drawing.words("turn.end_of", vector=vector) + tag

    def name_of_line(self, number: int) -> str:
        """The name of a line that no move draws, such as a guide or a side of a link."""
        kind, drawing = construction(self.steps[number]), self.drawing(number)
        if kind is not None and (name := kind.path_name(drawing)):
            return name
        points = kind.points if kind is not None else ()
        name = "".join(map(symbol, points))
        return drawing.words("turn.line", name=name or self.letters_behind(number))

    def letters_behind(self, number: int) -> str:
        """The letters of the points from which a line is drawn."""
        args = [arg for arg in self.steps[number].args if self.steps[arg].name]
        args = [arg for arg in args if self.steps[arg].plane is Plane.MECHANISM]
        return "".join(symbol(self.steps[arg].name) for arg in args)

    def turns(self, number: int) -> tuple[str, ...]:
        """The rate and sense of a velocity that is laid off perpendicular to its bar."""
        kind, drawing = construction(self.steps[number]), self.drawing(number)
        if not isinstance(kind, TurnedVelocity):
            return ()
        way = sense(drawing.words, drawing.trace.values[kind.omega])
        return (rate_symbol(drawing, kind.omega), way) if way else ()

    def turned(self, number: int) -> str:
        """The key of the sentence for a component of an acceleration laid off backwards."""
        kind = construction(self.steps[number])
        return kind.component.turned if isinstance(kind, LaidOff) else ""

    def keeps(self, number: int, action: str, inputs: Sequence[str]) -> tuple[str, int] | None:
        """The bar that keeps its length on a line of a plan, or the guide that a block stays on."""
        step = self.steps[number]
        if action not in ("perpendicular", "parallel") or step.plane not in PLANES[1:3]:
            return None
        what, args = inputs[1], step.args
        if self.picks[what].kind == "bar" and action == "perpendicular":
            return what, self.same.get(args[1], args[1])
        return (what, 0) if self.picks[what].kind == "guide" else None

    def words_of(self, number: int, action: str, inputs: Sequence[str]) -> tuple[str, str]:
        """The name of a move's result, and its subject in the message for a wrong choice."""
        names = [self.picks[name].name for name in inputs]
        kind, drawing = construction(self.steps[number]), self.drawing(number)
        if isinstance(kind, Component) and kind.vector == number:
            return kind.symbol(drawing), kind.symbol(drawing)
        if action in ("perpendicular", "parallel"):
            sign = "⊥" if action == "perpendicular" else "∥"
            return f"{sign} {names[1]} ({names[0]})", vector_on(drawing, number, kind, names[0])
        if action == "compass":
            return (drawing.words("turn.say.arc", p=names[0], bar=names[1]),) * 2
        if action == "join":
            return ("".join(names),) * 2
        if action == "transfer":
            return names[0], names[0]
        name = self.letter(number)
        return name, names[1] if action == "lay_off" else name


def vector_on(drawing: Drawing, number: int, kind: Construction | None, start: str) -> str:
    """The vector that lies on a line drawn to find its end."""
    if isinstance(kind, VelocityNormal):
        return drawing.words("turn.to_centre", p=start)
    vector = ""
    if isinstance(kind, AboutPivot):
        sign = "^τ" if drawing.kind == "acceleration" else ""
        vector = drawing.symbol(f"{drawing.vector.letter}_{kind.index}{sign}")
    elif isinstance(kind, AlongGuide):
        vector = kind.vector_along(drawing, number)
    elif kind is not None:
        vector = kind.vector_to(drawing.trace.program.steps[number].role)
    return vector or drawing.words("turn.this_line")


def values_on(sheet: ScreenSheet) -> dict[int, Any]:
    """The values of a sheet's steps; those of each polygon of forces at its place in the field."""
    values, layout = dict(sheet.drawing.trace.values), sheet.layout
    if not isinstance(layout, ForceLayout):
        return values
    x, y = layout.plan(0j)
    for number, step, value in sheet.drawing.steps(Plane.FORCES):
        u, v = layout.field(step)(0j)
        values[number] = moved_by(value, complex(u - x, y - v) / layout.plan.mm)
    return values


def moved_by(value: Any, shift: complex) -> Any:
    """A point, line or arrow, moved."""
    match value:
        case Line():
            return Line(value.point + shift, value.along)
        case Vector():
            return Vector(value.tail + shift, value.tip + shift)
        case _:
            return value + shift


def your_turn(sheets: Sequence[ScreenSheet], protocol: PageProtocol) -> YourTurn:
    """The moves of some sheets of one mechanism, in the order of its program."""
    return MoveFinder(sheets, protocol).found()


# --- the data of a turn ---------------------------------------------------------------------------


SAID = (
    "turn.say.saved",
    "turn.say.arc",
    "turn.say.again",
    "turn.say.sure",
    "turn.say.choose",
    "turn.say.count",
    "turn.say.which",
    "turn.say.right",
    "turn.say.already",
    "turn.say.own",
    "turn.say.nowhere",
    "turn.say.nowhere_line",
    "turn.say.either",
    "turn.say.unread",
    "turn.say.undrawn",
    "turn.say.unfit",
    "turn.say.other_drawing",
    "turn.say.neither_end",
    "turn.say.undone",
    "turn.say.redone",
    "turn.say.hint_action",
    "turn.say.level",
    "turn.say.reached",
    "turn.say.other_cut",
    "turn.say.other_lay_off",
    "turn.say.other_turned",
    "turn.say.hint",
    "turn.say.helped",
    "turn.say.complete",
    "turn.say.part_drawn",
    "turn.say.score",
    "turn.say.alone",
    "turn.say.with_hint",
    "turn.say.with_help",
    "turn.say.wrong",
)
"""The messages of the script, whatever the palette holds."""


CONSEQUENCES = ("turn.wrong.stretches", "turn.wrong.shrinks", "turn.wrong.leaves")
"""What would come of a wrong line: a bar that changes its length, a block off its guide."""


class TurnOwner(Struct, frozen=True):
    """The owner of a turn: the ``stem`` of saved files, and in a class an id and a code.

    The opaque code of the variant seals a saved score sheet.
    """

    stem: str = "graphkin"
    id: str = ""
    code: str = ""


def palette(turn: YourTurn, words: Words) -> list[tuple[str, list[str]]]:
    """The actions of a construction and of its known errors, with the words for their inputs."""
    used = {move.action for move in turn.moves.values()}
    used |= {action for errors in turn.errors.values() for _, action, _ in errors}
    if turn.alike:
        used.add("similar")
    return [
        (action, [words(f"turn.slot.{slot}") for slot, _ in each.slots])
        for action, each in PALETTE.items()
        if action in used
    ]


NOBODY = TurnOwner()


def record(
    sheets: Sequence[ScreenSheet], turn: YourTurn, owner: TurnOwner = NOBODY
) -> dict[str, object]:
    """The data for the script of a student's turn."""
    words = sheets[0].drawing.words
    used = [action for action, _ in palette(turn, words)]
    return {
        "palette": {action: [kinds for _, kinds in PALETTE[action].slots] for action in used},
        "moves": {move.step: written_move(turn, move) for move in turn.moves.values()},
        "picks": {key: written_pick(turn, key, pick) for key, pick in turn.picks.items()},
        "along": turn.along,
        "places": turn.places,
        "shares": [
            [PLANES.index(turn.planes[step]), turn.values[step], needs]
            for step, needs in turn.shares.items()
        ],
        "owner": [owner.stem, owner.id, owner.code],
        "seconds": seconds(sheets, turn),
        "shorter": turn.shorter,
        "plans": {PLANES.index(plan): words(key) for plan, key in PLAN_NAMES.items()},
        "units": [words.unit(unit) for unit in ("m/s", "m/s²")],
        "fields": [
            [plane_of(sheet), *map(frame, (sheet.layout.mechanism, sheet.layout.plan))]
            for sheet in sheets
        ],
        "words": {
            last_part(key): words.sentences[key]
            for key in (
                *SAID,
                *wrong_keys(turn),
                *(key for action in used for key in reasons(action, words)),
            )
        }
        | {"way_similar": words.sentences["why.similar"]}
        | {f"ask_{action}": words.sentences[f"turn.ask.{action}"] for action in used}
        | beginning(sheets),
    }


def last_part(key: str) -> str:
    """The name by which the script knows a sentence."""
    return key.rpartition(".")[2]


def wrong_keys(turn: YourTurn) -> list[str]:
    """The keys of the sentences for known errors, and for what would come of them."""
    found = {key for errors in turn.errors.values() for key, *_ in errors}
    found |= {move.turned for move in turn.moves.values() if move.turned}
    return sorted(found | set(CONSEQUENCES))


def beginning(sheets: Sequence[ScreenSheet]) -> dict[str, str]:
    """The first message, with a note on the plan of a scene that the page draws."""
    words = sheets[0].drawing.words
    begin = words("turn.say.begin")
    if more := SAID_FIRST.get(sheets[0].drawing.scene.sheet.plan):
        begin += f" {words(more)}"
    return {"begin": begin}


def reasons(action: str, words: Words) -> Iterator[str]:
    """The keys of the messages for a wrong input of an action; equal inputs share one."""
    own = PALETTE[action]
    keys = (f"turn.say.{own.said_as or own.key}_{place}" for place in range(len(own.slots)))
    yield from (key for key in keys if words.has(key))


def seconds(sheets: Sequence[ScreenSheet], turn: YourTurn) -> float:
    """kL/kv, the factor by which vectors are set on the mechanism."""
    step = sheets[0].drawing.trace.program.seconds
    return float(turn.values.get(step, 1.0)) if step is not None else 1.0


def plane_of(sheet: ScreenSheet) -> int:
    return PLANES.index(sheet.drawing.plane)


def frame(field: Field) -> list[float]:
    """The placement of values in a field: its place, its middle, millimetres per unit."""
    return [*field.at, field.middle.real, field.middle.imag, field.mm]


def written_move(turn: YourTurn, move: PaletteMove) -> dict[str, object]:
    """A move as data; the script derives from its inputs whatever they determine."""
    found: dict[str, object] = {
        "action": move.action,
        "inputs": move.inputs,
        "at": move.at,
        "plane": PLANES.index(turn.planes[move.step]),
        "value": written(turn.values[move.step]),
    }
    if not PALETTE[move.action].named:
        found["name"] = marked_up(move.name)
    if move.about != move.name and move.action != "lay_off":
        found["about"] = marked_up(move.about)
    if move.action == "divide":
        found["needs"] = move.needs
    if move.goal:
        found["goal"] = 1
    if move.turns:
        found["turns"] = [*map(marked_up, move.turns)]
    if move.turned:
        found["turned"] = last_part(move.turned)
    if move.keeps:
        found["keeps"] = move.keeps
    if errors := turn.errors.get(move.step):
        found["errors"] = [[last_part(key), action, *inputs] for key, action, inputs in errors]
    return found


def written_pick(turn: YourTurn, key: str, pick: Pick) -> dict[str, object]:
    """A pick as data; left out are what a move or two points determine, no needs, and plane 0."""
    found: dict[str, object] = {"kind": pick.kind}
    if key.isdigit() and int(key) in turn.moves:
        return found
    if pick.kind != "bar":
        found["name"] = marked_up(pick.name)
        if pick.plane is not PLANES[0]:
            found["plane"] = PLANES.index(pick.plane)
    if pick.needs and pick.kind not in ("bar", "arrow"):
        found["needs"] = pick.needs
    if pick.value is not None:
        found["value"] = written(pick.value)
    if pick.on:
        found["on"] = pick.on
    if pick.by:
        found["by"] = pick.by
    return found


DIGITS = 15
"""The digits of values on a page: all that a double surely holds."""


def written(value: Any) -> object:
    """A value as data: a number, a point [x, y], a line or vector of two, a circle {c, r}."""
    match value:
        case Ratio():
            return written(complex(value.start + value.shift / value.size))
        case Line() | Vector():
            return [written(complex(part)) for part in value]
        case Circle():
            return {"c": written(complex(value.centre)), "r": written(value.radius)}
        case complex():
            return [written(value.real), written(value.imag)]
        case _:
            return float(f"{value:.{DIGITS}g}")
