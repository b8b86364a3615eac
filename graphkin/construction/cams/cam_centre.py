"""A cam's follower: its position by the law, the centre of curvature, and the relations of both."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from functools import partial, wraps
from math import degrees
from typing import Any, ClassVar

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, Construction, constructions
from graphkin.construction.core.naming import drawn_amount, nearest_side, way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane, Step
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.relation import Relation, as_read, bracketed, figure, length_of
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.core.vocabulary import coordinate as along_guide
from graphkin.construction.guides.guides import (
    axis,
    axis_by_guide,
    path_of,
    path_of_block,
    standing_guide,
)
from graphkin.construction.links.link_shapes import bar_length, local_place
from graphkin.drawing.richtext import words_of
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real, sqrt
from graphkin.numbers.cam_motions import (
    BORDER,
    MOTIONS,
    Rise,
    TipMotion,
    displaced,
    displaced_along,
    guided_face,
    guided_tip,
    level_on_path,
    lever_way,
    start_on_face,
    start_on_plate,
    start_on_tip,
    swung_face,
    swung_tip,
    turned,
    upward,
)
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.model import FRAME, Cam, CamLever
from graphkin.text.errors import Message, Problem, Sought, message

NAMES = tuple(MOTIONS)


def law(axis: Point, start: Point, *rest: Real) -> Rise:
    """The displacement at the cam's axis.

    ``rest`` holds the ends, the rises, the sense and the codes of the motions.
    """
    count = (len(rest) - 1) // 3
    ends, rises = rest[:count], rest[count : 2 * count]
    sense, motions = rest[2 * count], [NAMES[int(code)] for code in rest[2 * count + 1 :]]
    turn = axis * start.conjugate()
    found = displaced(turn if sense > 0 else turn.conjugate(), ends, rises, motions)
    return Rise(found.at, sense * found.rate, found.bend)


def table(axis: Point, start: Point, *rest: Real) -> Rise:
    """The displacement at the cam's axis, from a table.

    ``rest`` holds the ends, the rises, the slopes at the begins, the slopes at the ends, and the
    sense.
    """
    count = (len(rest) - 1) // 4
    ends, rises, begins, finishes = (rest[k * count : (k + 1) * count] for k in range(4))
    sense, turn = rest[-1], axis * start.conjugate()
    slopes = list(zip(begins, finishes, strict=True))
    found = displaced(turn if sense > 0 else turn.conjugate(), ends, rises, (), slopes)
    return Rise(found.at, sense * found.rate, found.bend)


def plate_law(place: Real, start: Real, *rest: Real) -> Rise:
    """The displacement at the coordinate of a plate; ``rest`` is as in ``law``."""
    count = (len(rest) - 1) // 3
    ends, rises = rest[:count], rest[count : 2 * count]
    sense, motions = rest[2 * count], [NAMES[int(code)] for code in rest[2 * count + 1 :]]
    found = displaced_along(sense * (place - start), ends, rises, motions)
    return Rise(found.at, sense * found.rate, found.bend)


def read_off(law: Callable[..., Rise]) -> tuple[Action, Action, Action]:
    """The actions for a follower's displacement by a law and for its two derivatives.

    The derivatives are with respect to the cam's angle, counter-clockwise, or to the coordinate of
    a plate.
    """

    def part(name: str) -> Action:
        return Action("cam-lift", wraps(law)(lambda *known: getattr(law(*known), name)))

    return part("at"), part("rate"), part("bend")


lift, lift_rate, lift_bend = read_off(law)
table_lift, table_rate, table_bend = read_off(table)
plate_lift, plate_rate, plate_bend = read_off(plate_law)


@action("cam-height")
def height_of_tip(path: Line, pivot: Point, prime: Real, lift: Real) -> Real:
    """The distance along the path from the foot of the cam's pivot to the centre of a roller."""
    aside = cross(path.along, path.point - pivot) / abs(path.along)
    return sqrt(prime * prime - aside * aside) + lift


@action("cam-height")
def height_of_face(path: Line, pivot: Point, prime: Real, lift: Real) -> Real:
    """The distance of a flat face from the cam's pivot."""
    return prime + lift


@action("cam-coordinate")
def coordinate(path: Line, pivot: Point, height: Real) -> Real:
    """The coordinate of a follower at its height above the cam's pivot."""
    return dot(path.along, pivot - path.point) / abs(path.along) + height


@action("cam-coordinate")
def coordinate_on_plate(path: Line, plate: Line, prime: Real, lift: Real) -> Real:
    """The coordinate of a follower that a plate lifts."""
    return level_on_path(path, plate, prime) + lift


@action("cam-lift")
def seen_from(axis: Point, carrier: Point) -> Point:
    """The axis of a cam in the frame of the link that carries its follower."""
    return axis * carrier.conjugate()


@action("cam-lift")
def seen_at_rest(carrier: Point) -> Point:
    """The axis of a fixed cam in the frame of the link that carries its follower."""
    return carrier.conjugate()


@action("cam-swing")
def swing_on_plate(plate: Line, pin: Point, arm: Real, prime: Real, lift: Real, side: int) -> Point:
    """The direction of a lever whose roller or knife edge a plate lifts."""
    up = upward(plate.along, pin - plate.point)
    start = start_on_plate(dot(up, pin - plate.point), arm, prime)
    return lever_way(up, start, side, lift)


@action("cam-swing")
def swing_on_tip(pivot: Point, pin: Point, arm: Real, prime: Real, lift: Real, side: int) -> Point:
    """The direction of a lever whose roller or knife edge a cam lifts."""
    return lever_way(pin - pivot, start_on_tip(pin - pivot, arm, prime), side, lift)


@action("cam-swing")
def swing_on_face(pivot: Point, pin: Point, face: Real, base: Real, lift: Real, side: int) -> Point:
    """The direction of a lever whose flat face a cam lifts."""
    return lever_way(pin - pivot, start_on_face(pin - pivot, base + face), side, lift)


def tip_on_guide(pivot: Point, path: Line, height: Real, rate: Real, bend: Real) -> TipMotion:
    """The motion, relative to the cam's pivot, of a roller or knife edge that moves on a guide."""
    along = path.along / abs(path.along)
    return guided_tip(along, cross(along, path.point - pivot), height, rate, bend)


def tip_of_lever(
    pivot: Point, pin: Point, way: Point, arm: Real, rate: Real, bend: Real, side: int
) -> TipMotion:
    """The motion, relative to the cam's pivot, of a roller or knife edge at the end of a lever."""
    return swung_tip(pin - pivot, way * arm, side, rate, bend)


def curved(motion: TipMotion) -> Real:
    """The tip's distance from the cam's pivot, over the sum of that and the centre's distance.

    The fraction is zero where the pitch curve is straight and its centre of curvature lies at
    infinity.
    """
    far = abs(motion.centre)
    return abs(motion.place) / (abs(motion.place) + far)


def tip_over_plate(path: Line, plate: Line, at: Real, rate: Real, bend: Real) -> TipMotion:
    """The motion of a roller or knife edge on a guide over a plate; its place in the plane."""
    along, drift = path.along / abs(path.along), plate.along / abs(plate.along)
    return TipMotion(path.point + along * at, rate * along, bend * along, drift)


def tip_of_lever_over_plate(
    plate: Line, pin: Point, way: Point, arm: Real, rate: Real, bend: Real, side: int
) -> TipMotion:
    """The motion over a plate of a tip at the end of a lever; its place in the plane."""
    swung = swung_tip(pin, way * arm, side, rate, bend)
    return swung._replace(drift=plate.along / abs(plate.along))


def curved_over(motion: TipMotion, size: Real) -> Real:
    """The ``size`` of a law as a fraction of itself plus the radius of the pitch curve."""
    return size / (size + abs(motion.centre - motion.place))


@action("cam-centre", margin=lambda *known: curved_over(tip_over_plate(*known[:5]), known[5]))
def centre_over_plate(
    path: Line, plate: Line, at: Real, rate: Real, bend: Real, size: Real
) -> Point:
    """The centre of curvature of the pitch curve of a plate, for a tip that moves on a guide."""
    return tip_over_plate(path, plate, at, rate, bend).centre


@action("cam-centre", margin=lambda *known: curved_over(tip_of_lever_over_plate(*known), known[3]))
def centre_over_plate_by_lever(
    plate: Line, pin: Point, way: Point, arm: Real, rate: Real, bend: Real, side: int
) -> Point:
    """The centre of curvature of the pitch curve of a plate, for the tip of a lever."""
    return tip_of_lever_over_plate(plate, pin, way, arm, rate, bend, side).centre


@action("cam-centre", margin=lambda *known: curved(tip_on_guide(*known)))
def centre_under_tip(pivot: Point, path: Line, height: Real, rate: Real, bend: Real) -> Point:
    """The centre of curvature of the pitch curve, for a roller or knife edge on a guide."""
    return pivot + tip_on_guide(pivot, path, height, rate, bend).centre


@action("cam-centre")
def centre_under_face(pivot: Point, path: Line, height: Real, rate: Real, bend: Real) -> Point:
    """The centre of curvature of the profile under a flat face."""
    return pivot + guided_face(path.along / abs(path.along), height, rate, bend).centre


@action("cam-centre", margin=lambda *known: curved(tip_of_lever(*known)))
def centre_under_lever(
    pivot: Point, pin: Point, way: Point, arm: Real, rate: Real, bend: Real, side: int
) -> Point:
    """The centre of curvature of the pitch curve, for the tip of a lever."""
    return pivot + tip_of_lever(pivot, pin, way, arm, rate, bend, side).centre


@action("cam-centre")
def centre_under_swung_face(
    pivot: Point, pin: Point, way: Point, face: Real, rate: Real, bend: Real, side: int
) -> Point:
    """The centre of curvature of the profile under the flat face of a lever."""
    return pivot + swung_face(pin - pivot, way, face, side, rate, bend).centre


@action("cam-lever")
def lever_end(pin: Point, way: Point, arm: Real) -> Point:
    return pin + way * arm


class SwungLever(Construction, frozen=True, kw_only=True):
    """The ``tip``, called ``name``, of a lever ``link`` that a cam has turned about its ``pin``."""

    reasons: ClassVar[Mapping[str, str]] = {"tip": "why.cam_lever"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"tip": ByHand.LAID_OFF}
    between: ClassVar[tuple[str, ...]] = ("pin", "name")
    laid_at: ClassVar[str] = "tip"

    link: str
    pin: str
    name: str
    tip: OwnStep

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence that places the tip by the angle of its bar in the plane."""
        words, spot = drawing.words, drawing.standing.spot
        angle = words.fixed(degrees(phase(spot(self.name) - spot(self.pin))), 1)
        fields = {"p": symbol(self.pin), "name": symbol(self.name), "angle": angle}
        return words("step.cam-lever", bar=bar(self.pin, self.name), **fields)


class CurvatureCentre(Determined, frozen=True, kw_only=True):
    """The centre of curvature ``point``, called ``name``, of the cam ``link`` under its follower.

    The distance to it is measured from the cam's pivot, called ``start``.
    """

    reasons: ClassVar[Mapping[str, str]] = {"point": "why.cam_centre"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"point": ByHand.LAID_OFF}
    has_angle: ClassVar[bool] = False
    between: ClassVar[tuple[str, ...]] = ("start", "name")

    link: str
    follower: str
    start: str
    name: str
    pivot: int
    lift: int
    rate: int
    bend: int
    point: OwnStep

    def in_line(self, steps: Sequence[Step], *, nearly: bool) -> Message:
        """The words for a pitch curve without curvature."""
        return message(
            "the pitch curve of link {link} is nearly straight at the contact"
            if nearly
            else "the pitch curve of link {link} is straight at the contact",
            link=self.link,
        )

    def undetermined(self, args: Sequence[Any]) -> Problem:
        """The problem of a straight pitch curve, which no circle can replace."""
        plate = isinstance(args[0], Line)
        hint = message(
            "the follower moves by its law, but no circle replaces the cam here: move the "
            "driver, or write a straight flank as a guide on the plate"
            if plate
            else "the follower moves by its law, but no circle replaces the cam here: move the "
            "driver"
        )
        return Problem(
            message("position of {name}", name=self.name),
            message(
                "{name} lies at infinity: the pitch curve of link {link} is straight at "
                "the contact",
                name=self.name,
                link=self.link,
            ),
            message("a contact at which it is curved"),
            hint,
            about=(Sought((self.name,)),),
        )

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence that places the centre by its distance from the pivot and its direction.

        Under a face on a guide, the centre is placed by the second derivative along the guide and
        the first derivative perpendicular to the guide.
        """
        words, spot = drawing.words, drawing.standing.spot
        way = spot(self.name) - spot(self.start)
        fields = {"name": symbol(self.name), "g": escape(self.link), "p": symbol(self.start)}
        if abs(way) <= 1e-9 * drawing.standing.size:
            return words("step.cam-centre-dwell", law=self.law_words(drawing), **fields)
        step = drawing.trace.program.steps[self.point]
        if step.action is centre_under_face:
            return words("step.cam-centre-face", **fields, **self.by_face(drawing, step))
        angle = words.fixed(degrees(phase(way)), 1)
        laid = f"{bar(self.start, self.name)} = {drawn_amount(drawing, abs(way))}"
        return words(
            "step.cam-centre", laid=laid, angle=angle, law=self.law_words(drawing), **fields
        )

    def by_face(self, drawing: Drawing, step: Step) -> dict[str, str]:
        """Both derivatives as drawn on paper: the length and the side of each."""
        path, rate, bend = (drawing.trace.values[step.args[k]] for k in (1, 3, 4))
        along = path.along / abs(path.along)
        fields = {"law": self.law_words(drawing), "follower": escape(self.follower)}
        for name, way in (("along", -along * bend), ("square", -1j * along * rate)):
            side = drawing.words(f"page.to_{nearest_side(way)}")
            fields[name] = f"{drawn_amount(drawing, abs(way))} {side}"
        return fields

    def law_words(self, drawing: Drawing) -> str:
        """The follower's displacement, with its link's index, and its derivatives, as drawn."""
        return ", ".join(
            f"{name} = {number}{'' if unit in ('', '°') else ' '}{unit}"
            for name, number, unit in self.law_values(drawing, on_paper=True)
        )

    def law_values(
        self, drawing: Drawing, *, on_paper: bool = False
    ) -> Iterator[tuple[str, str, str]]:
        """The displacement and its two derivatives: the symbol, number and unit of each.

        A derivative is with respect to the cam's angle or to the coordinate of a plate. Lengths are
        in the scene's unit, or in millimetres of paper.
        """
        cam, words, k = drawing.scene.cams[self.follower], drawing.words, escape(self.follower)
        mm = words.spelled("mm" if on_paper else drawing.scene.units["length"])
        one = float(drawing.on_paper(1.0)) if on_paper else drawing.length(1.0)
        at, rate, bend = (drawing.trace.values[each] for each in (self.lift, self.rate, self.bend))
        letter, per = ("ψ" if cam.lever else "s"), (1.0 if cam.lever else one)
        units = ["°", "", ""] if cam.lever else [mm] * 3
        numbers = [degrees(at) if cam.lever else at * one, rate * per, bend * per]
        if cam.slides:
            units[1:] = (f"{mm}⁻¹", f"{mm}⁻²") if cam.lever else ("", f"{mm}⁻¹")
            numbers[1:] = numbers[1] / one, numbers[2] / one**2
        for prime, number, unit in zip(("", "′", "″"), numbers, units, strict=True):
            shown = words.significant(number, 5) if cam.slides else words.fixed(number, 3)
            yield f"*{letter}*{prime}_{{{k}}}", shown, unit


def law_steps(pen: Pen, cam: Cam) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """The steps from which a law is computed, and its sense and motions."""
    place = plate_coordinate(pen, cam) if cam.slides else seen_axis(pen, cam)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        start = pen.given("length" if cam.slides else "direction", cam.start)
        ends = [pen.given("length" if cam.slides else "number", piece.to) for piece in cam.law]
        form = "number" if cam.lever else "length"
        rises = [pen.given(form, piece.rise) for piece in cam.law]
        slopes = [pen.given(form, each) for pair in zip(*cam.slopes, strict=True) for each in pair]
    if slopes:
        steps = place, start, *ends, *rises, *slopes
        return steps, (float(cam.sense),)
    codes = [float(NAMES.index(piece.motion)) for piece in cam.law]
    steps = place, start, *ends, *rises
    return steps, (float(cam.sense), *codes)


def plate_line(pen: Pen, cam: Cam) -> int:
    """The path of a plate's point on its guide.

    The path of a cylinder's rod is drawn through the pin of the tube, which may lie off the path.
    """
    pair = pen.first_slide(cam.on)
    if ("through pin", *pair.links) not in pen.shared:
        return path_of(pen, pair, cam.on, cam.pivot)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        return path_of_block(pen, pair, standing_guide(pen, pair), cam.pivot)


def plate_coordinate(pen: Pen, cam: Cam) -> int:
    """The coordinate of a plate on its guide, from the zero of the guide of a moving link."""
    line = plate_line(pen, cam)
    if cam.carrier != FRAME:
        line = standing_guide(pen, pen.first_slide(cam.on))
    with pen.on(Part.POSITION, Plane.NUMBERS):
        return pen.draw_shared(("plate", cam.on), along_guide, line, pen.the("position", cam.pivot))


def seen_axis(pen: Pen, cam: Cam) -> int:
    """The axis of a cam in the frame of its carrier."""
    if cam.carrier == FRAME:
        return axis(pen, cam.on)
    key, carrier = ("cam seen", cam.on + cam.carrier), axis(pen, cam.carrier)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        if cam.on == FRAME:
            return pen.draw_shared(key, seen_at_rest, carrier)
        return pen.draw_shared(key, seen_from, axis(pen, cam.on), carrier)


def law_actions(cam: Cam) -> tuple[Action, Action, Action]:
    """The actions that give the displacement and its two derivatives."""
    if cam.slides:
        return plate_lift, plate_rate, plate_bend
    return (table_lift, table_rate, table_bend) if cam.slopes else (lift, lift_rate, lift_bend)


def lifted(pen: Pen, follower: str) -> tuple[int, int]:
    """The radius at which the tip starts, and the displacement of a follower."""
    cam = pen.scene.cams[follower]
    steps, extra = law_steps(pen, cam)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        prime = pen.given("length", cam.base)
        if cam.tip == "roller":
            roller = pen.given("length", cam.roller)
            prime = pen.draw_shared(("cam prime", follower), widened, prime, roller)
        found, *_ = law_actions(cam)
        return prime, pen.draw_shared(("cam lift", follower), found, *steps, extra=extra)


def height(pen: Pen, follower: str) -> tuple[int, int, int]:
    """A follower's path, the cam's pivot, and the follower's height above the pivot."""
    cam = pen.scene.cams[follower]
    path = path_of(pen, pen.first_slide(follower), follower, cam.point)
    pivot, begun = pen.the("position", cam.pivot), lifted(pen, follower)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        kind = height_of_face if cam.is_flat else height_of_tip
        return path, pivot, pen.draw_shared(("cam height", follower), kind, path, pivot, *begun)


def over_plate(pen: Pen, follower: str) -> tuple[int, int, int]:
    """A follower's path, the path of the plate under it, and the follower's coordinate."""
    cam = pen.scene.cams[follower]
    path = path_of(pen, pen.first_slide(follower), follower, cam.point)
    plate, begun = plate_line(pen, cam), lifted(pen, follower)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        key = "cam coordinate", follower
        return path, plate, pen.draw_shared(key, coordinate_on_plate, path, plate, *begun)


def swing(pen: Pen, follower: str, lever: CamLever) -> tuple[int, int, int, int]:
    """The cam's pivot or a plate's path, the pin of a lever, its direction, and its length.

    For a lever with a flat face, the offset of the face replaces the length.
    """
    cam = pen.scene.cams[follower]
    seat = plate_line(pen, cam) if cam.slides else pen.the("position", cam.pivot)
    ends = seat, pen.the("position", lever.pin)
    if cam.is_flat:
        with pen.on(Part.POSITION, Plane.NUMBERS):
            size = pen.given("length", lever.face)
    else:
        size = bar_length(pen, follower, lever.pin, cam.point)
    begun = lifted(pen, follower)
    kind = swing_on_plate if cam.slides else swing_on_face if cam.is_flat else swing_on_tip
    with pen.on(Part.POSITION, Plane.NUMBERS):
        steps = *ends, size, *begun
        way = pen.draw_shared(("cam swing", follower), kind, *steps, extra=(lever.side,))
    return *ends, way, size


def set_lever(pen: Pen, follower: str, lever: CamLever) -> None:
    """Place a lever at the angle that its cam's law gives."""
    name = pen.scene.cams[follower].point
    _, pin, way, _ = swing(pen, follower, lever)
    locals_ = [local_place(pen, follower, each) for each in (lever.pin, name)]
    with pen.on(Part.POSITION, Plane.NUMBERS):
        pen.want("axis", follower, pen.draw(axis_by_guide, way, *locals_))
    arm = bar_length(pen, follower, lever.pin, name)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        tip = pen.draw(lever_end, pin, way, arm, name=name)
        pen.make(SwungLever(link=follower, pin=lever.pin, name=name, tip=tip))
    pen.want("position", name, tip)


@action("cam-prime")
def widened(base: Real, roller: Real) -> Real:
    """The radius of the prime circle, where the roller's centre starts."""
    return base + roller


def curvature_centre(pen: Pen, name: str) -> int:
    """Draw the centre of curvature of a cam under its follower, in the plane."""
    follower = pen.scene.cam_centres[name]
    cam = pen.scene.cams[follower]
    steps, extra = law_steps(pen, cam)
    extra_side: tuple[int, ...] = ()
    if cam.lever:
        where: tuple[int, ...] = swing(pen, follower, cam.lever)
        kind = centre_under_swung_face if cam.is_flat else centre_under_lever
        kind = centre_over_plate_by_lever if cam.slides else kind
        extra_side = (cam.lever.side,)
    elif cam.slides:
        where, kind = over_plate(pen, follower), centre_over_plate
    else:
        path, pivot, above = height(pen, follower)
        where = pivot, path, above
        kind = centre_under_face if cam.is_flat else centre_under_tip
    with pen.on(Part.POSITION, Plane.NUMBERS):
        rate, bend = (pen.draw(each, *steps, extra=extra) for each in law_actions(cam)[1:])
        size = (pen.given("length", cam.law[-1].to),) if kind is centre_over_plate else ()
    displaced_by = pen.shared["cam lift", follower]
    with pen.on(Part.POSITION, Plane.MECHANISM):
        point = pen.draw(kind, *where, rate, bend, *size, extra=extra_side, name=name)
        made = CurvatureCentre(
            link=cam.on,
            follower=follower,
            start=cam.pivot,
            name=name,
            pivot=pen.the("position", cam.pivot),
            lift=displaced_by,
            rate=rate,
            bend=bend,
            point=point,
        )
        pen.make(made)
    return point


FORMS = {
    "uniform": ("{h}·{x}", "{h}/{b}", "0"),
    "parabolic": ("2·{h}·{x}^2", "4·{h}·{x}/{b}", "4·{h}/{b}^2"),
    "parabolic-late": ("{h}·(1 − 2·(1 − {x})^2)", "4·{h}·(1 − {x})/{b}", "−4·{h}/{b}^2"),
    "harmonic": (
        "{h}·(1 − cos(180°·{x}))/2",
        "π·{h}·sin(180°·{x})/(2·{b})",
        "π^2·{h}·cos(180°·{x})/(2·{b}^2)",
    ),
    "cycloidal": (
        "{h}·({x} − sin(360°·{x})/(2·π))",
        "{h}·(1 − cos(360°·{x}))/{b}",
        "2·π·{h}·sin(360°·{x})/{b}^2",
    ),
    "3-4-5": (
        "{h}·(10·{x}^3 − 15·{x}^4 + 6·{x}^5)",
        "30·{h}·{x}^2·(1 − {x})^2/{b}",
        "60·{h}·{x}·(1 − {x})·(1 − 2·{x})/{b}^2",
    ),
    "4-5-6-7": (
        "{h}·(35·{x}^4 − 84·{x}^5 + 70·{x}^6 − 20·{x}^7)",
        "140·{h}·{x}^3·(1 − {x})^3/{b}",
        "420·{h}·{x}^2·(1 − {x})^2·(1 − 2·{x})/{b}^2",
    ),
}
"""Lift, first and second derivative of each motion, by rise h, fraction x and length b."""
POLES = tuple("PSTUVWXYZ") + tuple(f"P{k}" for k in range(1000))
"""Candidate names of the point in which the cam and its follower have the same velocity."""


def of_cams(drawing: Drawing, used: Container[tuple[str, str]] = ()) -> Iterator[Relation]:
    """The displacement and derivatives of each follower, and how its centre of curvature follows.

    The distance of the centre from the pivot of its cam is added where this length is in ``used``.
    """
    for centre in constructions(drawing.trace.program, CurvatureCentre):
        if centre.point in drawing.trace.values:
            yield from of_law(drawing, centre)
            yield from of_height(drawing, centre)
            how = how_found(drawing, centre)
            if how:
                first, *more = words_of(how)
                yield Relation(first, more=tuple(more))
            if (centre.start, centre.name) in used:
                yield of_distance(drawing, centre)


def of_law(drawing: Drawing, centre: CurvatureCentre) -> Iterator[Relation]:
    """The displacement and its two derivatives, by the formulas of the current piece."""
    words, slides = drawing.words, drawing.scene.cams[centre.follower].slides
    remark = words(f"calculation.law_{'plate' if slides else 'cam'}", g=escape(centre.link))
    piece = None if slides else piece_at(drawing, centre)
    found = list(of_piece(drawing, piece)) if piece else []
    yield from found[:-3]
    formulas = found[-3:] or [Relation("")] * 3
    for (name, number, unit), formula in zip(centre.law_values(drawing), formulas, strict=True):
        said = "" if formula.symbols else remark
        yield replace(formula, left=name, result=number, unit=unit, remark=said)


def of_height(drawing: Drawing, centre: CurvatureCentre) -> Iterator[Relation]:
    """The distance of a flat face on a guide from the pivot of its cam, along that guide."""
    cam, words, k = drawing.scene.cams[centre.follower], drawing.words, escape(centre.follower)
    if not cam.is_flat or cam.lever or cam.slides:
        return
    base = float(cam.base.si(drawing.scene.values))
    high = base + float(drawing.trace.values[centre.lift])
    lift, lifted, unit = next(centre.law_values(drawing))
    yield Relation(
        words("calculation.face_height", b=symbol(cam.point), o=symbol(centre.start), k=k)
    )
    drawn = in_mm(words, drawing.on_paper(high))
    remark = words("calculation.guide_drawn", guide=way_of(drawing, centre.follower), drawn=drawn)
    figures = f"{words.fixed(drawing.length(base), 3)} + {bracketed(lifted)}"
    result = words.fixed(drawing.length(high), 3)
    yield Relation(f"*h*_{{{k}}}", f"*r*_b + {lift}", figures, result, unit, remark)


class LawPiece(Struct, frozen=True):
    """A piece of a cam's law that moves the follower, in radians and the scene's own unit of lift.

    ``angle`` is the cam's angle from the start of the law. The piece begins at ``begin`` with the
    lift ``start``, has the length ``span`` and adds ``rise``. ``sense`` is the sense of the law.
    """

    motion: str
    letter: str
    angle: float
    begin: float
    span: float
    start: float
    rise: float
    sense: int


def piece_at(drawing: Drawing, centre: CurvatureCentre) -> LawPiece | None:
    """The piece of the law at the cam's angle; None in a dwell, and for tables."""
    cam, values = drawing.scene.cams[centre.follower], drawing.scene.values
    if cam.slopes:
        return None
    steps = drawing.trace.values
    axis, start = (steps[each] for each in drawing.trace.program.steps[centre.lift].args[:2])
    turn = axis * start.conjugate()
    angle = turned(turn if cam.sense > 0 else turn.conjugate())
    one = math.degrees(1) if cam.lever else drawing.length(1.0)
    begin = lifted = 0.0
    for piece in cam.law:
        end, rise = (float(each.si(values)) for each in (piece.to, piece.rise))
        if angle < end - BORDER:
            break
        begin, lifted = end, lifted + rise
    if not rise:
        return None
    letter = "ψ" if cam.lever else "s"
    found = (angle, begin, end - begin, lifted * one, rise * one)
    return LawPiece(piece.motion, letter, *found, cam.sense)


def of_piece(drawing: Drawing, piece: LawPiece) -> Iterator[Relation]:
    """The fraction of a piece covered, its length in radians, its lift and derivatives.

    The lift and the derivatives are formulas. Yields nothing for motions that are sums of several
    sines.
    """
    late = piece.motion == "parabolic" and piece.angle - piece.begin >= piece.span / 2
    forms = FORMS.get(piece.motion + ("-late" if late else ""))
    if forms is None:
        return
    put, words = partial(figure, drawing, digits=6), drawing.words
    degrees = drawing.scene.units["angle"] == "deg"
    angle, begin, span = (
        put(math.degrees(each) if degrees else each)
        for each in (piece.angle, piece.begin, piece.span)
    )
    share, radians = put((piece.angle - piece.begin) / piece.span), put(piece.span)
    yield Relation(words("calculation.law_piece", s=f"*{piece.letter}*_0"))
    yield Relation("*x*", "(*θ* − *θ*_0)/*β*", f"({angle} − {begin})/{span}", share)
    yield Relation("*β*", "", f"π·{span}/180" if degrees else "", radians, "rad")
    turned_rise = math.radians(piece.rise) if piece.letter == "ψ" else piece.rise
    if piece.letter == "ψ":
        yield Relation("*H*", "", f"π·{bracketed(put(piece.rise))}/180", put(turned_rise), "rad")
    for number, form in enumerate(forms):
        rise = turned_rise if number else piece.rise
        ahead = (
            ("", "")
            if number or not piece.start
            else (f"*{piece.letter}*_0 + ", f"{put(piece.start)} + ")
        )
        minus = "−" if number == 1 and piece.sense < 0 else ""
        symbols = form.format(h="*H*", x="*x*", b="*β*")
        figures = form.format(h=bracketed(put(rise)), x=share, b=radians)
        yield Relation("", f"{ahead[0]}{minus}{symbols}", f"{ahead[1]}{minus}{figures}")


def how_found(drawing: Drawing, centre: CurvatureCentre) -> str:
    """How the centre follows from the law by hand; empty where no short formula gives it.

    Let t = w′ - iw be the tangent of the pitch curve in the axes of the cam, and m = w″ - 2iw′ - w.
    The tip w is at the distance |t|³/(m×t) from the centre, on the normal. The normal passes
    through the point in which the cam and the follower have the same velocity. Source: Norton, Cam
    Design and Manufacturing Handbook, ch. 7.
    """
    cam, words = drawing.scene.cams[centre.follower], drawing.words
    if cam.slides or (cam.is_flat and cam.lever):
        return ""
    k, o, b, link = (
        symbol(centre.name),
        symbol(centre.start),
        symbol(cam.point),
        escape(centre.follower),
    )
    fields = {"k": k, "o": o, "b": b, "link": link, "ok": bar(centre.start, centre.name)}
    fields["bk"] = bar(cam.point, centre.name)
    fields["pole"] = symbol(next(each for each in POLES if each not in drawing.scene.points))
    if cam.lever:
        pin = cam.lever.pin
        return words(
            "calculation.centre_lever",
            q=symbol(pin),
            oq=bar(centre.start, pin),
            qb=bar(pin, cam.point),
            sign="+" if cam.lever.side > 0 else "−",
            **fields,
        )
    return words(
        "calculation.centre_face" if cam.is_flat else "calculation.centre_guided", **fields
    )


def of_distance(drawing: Drawing, centre: CurvatureCentre) -> Relation:
    """The distance from the pivot to the centre, as measured."""
    size = drawing.on_paper(length_of(drawing, centre.start, centre.name))
    reading = as_read(drawing, size, drawing.scales.kL / 1000)
    remark = drawing.words("calculation.measured")
    ends = centre.start, centre.name
    return Relation(bar(*ends), "", *reading, "m", remark, over=(ends,))
