"""The centre of curvature by which a cam moves its follower at an instant, and the law behind it.

With the follower's point at w from the cam's pivot, and its displacement s(θ) along the unit vector
u of the guide, the pitch curve runs in the cam's axes along t = s'u - iw and bends by
m = s"u - 2is'u - w: its centre of curvature lies at w + it|t|²/(t×m). Under a flat face the
distance h of the face is the support of the profile, whose centre lies at -s"u - s'iu.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping
from math import degrees
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.bases import Base
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import drawn_amount
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action
from graphkin.construction.guides.guides import axis, path_of
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.drawing.richtext import escape
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real, sqrt
from graphkin.numbers.cam_motions import MOTIONS, Rise, displaced
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.model import Cam

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing

NAMES = tuple(MOTIONS)


def law(axis: Point, start: Point, *rest: Real) -> Rise:
    """The displacement at the cam's axis; ``rest`` are ends, rises, the sense and the motions."""
    count = (len(rest) - 1) // 3
    ends, rises = list(rest[:count]), list(rest[count : 2 * count])
    sense, motions = rest[2 * count], [NAMES[int(code)] for code in rest[2 * count + 1 :]]
    turn = axis * start.conjugate()
    found = displaced(turn if sense > 0 else turn.conjugate(), ends, rises, motions)
    return Rise(found.at, sense * found.rate, found.bend)


@action("cam-lift")
def lift(axis: Point, start: Point, *rest: Real) -> Real:
    """The displacement of the follower."""
    return law(axis, start, *rest).at


@action("cam-lift")
def lift_rate(axis: Point, start: Point, *rest: Real) -> Real:
    """Its derivative by the cam's angle, counter-clockwise."""
    return law(axis, start, *rest).rate


@action("cam-lift")
def lift_bend(axis: Point, start: Point, *rest: Real) -> Real:
    """Its second derivative."""
    return law(axis, start, *rest).bend


@action("cam-height")
def height_of_tip(path: Line, pivot: Point, prime: Real, lift: Real) -> Real:
    """How far along its path the centre of a roller stands from the foot of the cam's pivot."""
    aside = cross(path.along, path.point - pivot) / abs(path.along)
    return sqrt(prime * prime - aside * aside) + lift


@action("cam-height")
def height_of_face(path: Line, pivot: Point, prime: Real, lift: Real) -> Real:
    """How far a flat face stands from the cam's pivot."""
    return prime + lift


@action("cam-coordinate")
def coordinate(path: Line, pivot: Point, height: Real) -> Real:
    """The coordinate of a follower at its height above the cam's pivot."""
    return dot(path.along, pivot - path.point) / abs(path.along) + height


@action("cam-centre")
def centre_under_tip(pivot: Point, path: Line, height: Real, rate: Real, bend: Real) -> Point:
    """The centre of curvature of the pitch curve of a roller or a knife."""
    along = path.along / abs(path.along)
    place = height * along + 1j * along * cross(along, path.point - pivot)
    way = rate * along - 1j * place
    turn = bend * along - rate * (2j * along) - place
    return pivot + place + 1j * way * (dot(way, way) / cross(way, turn))


@action("cam-centre")
def centre_under_face(pivot: Point, path: Line, height: Real, rate: Real, bend: Real) -> Point:
    """The centre of curvature of the profile under a flat face."""
    along = path.along / abs(path.along)
    return pivot - along * bend - 1j * along * rate


class CurvatureCentre(Construction, frozen=True, kw_only=True):
    """The centre of curvature ``point``, called ``name``, of the cam ``link`` under its follower.

    It is laid off from the cam's pivot ``start``.
    """

    gives: ClassVar[tuple[str, ...]] = ("point",)
    reasons: ClassVar[Mapping[str, str]] = {"point": "why.cam_centre"}
    laid_off: ClassVar[frozenset[str]] = frozenset({"point"})

    link: str
    follower: str
    start: str
    name: str
    lift: int
    rate: int
    bend: int
    point: int

    @property
    def points(self) -> tuple[str, ...]:
        """The pivot and the centre."""
        return self.start, self.name

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """By its distance from the pivot, and its direction in the plane."""
        words, spot = drawing.words, drawing.standing.spot
        way = spot(self.name) - spot(self.start)
        fields = {"name": symbol(self.name), "g": escape(self.link), "p": symbol(self.start)}
        if abs(way) <= 1e-9 * drawing.standing.size:
            return words("step.cam-centre-dwell", law=self.law_words(drawing), **fields)
        angle = words.fixed(degrees(phase(way)), 1)
        laid = f"{bar(self.start, self.name)} = {drawn_amount(drawing, abs(way))}"
        return words(
            "step.cam-centre", laid=laid, angle=angle, law=self.law_words(drawing), **fields
        )

    def law_words(self, drawing: Drawing) -> str:
        """The displacement of the follower and its derivatives, by numbers."""
        unit, values = drawing.scene.units["length"], drawing.trace.values
        numbers = (values[self.lift], values[self.rate], values[self.bend])
        s, rate, bend = (drawing.words.fixed(drawing.length(each), 3) for each in numbers)
        return drawing.words("page.cam_law", s=s, rate=rate, bend=bend, unit=unit)


def law_steps(pen: Pen, shapes: LinkShapes, cam: Cam) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """What the steps of a law start from, and its sense and motions."""
    with pen.on(Part.POSITION, Plane.NUMBERS):
        start = pen.given("direction", cam.start)
        ends = [pen.given("number", piece.to) for piece in cam.law]
        rises = [pen.given("length", piece.rise) for piece in cam.law]
    codes = [float(NAMES.index(piece.motion)) for piece in cam.law]
    steps = axis(pen, shapes, cam.on), start, *ends, *rises
    return steps, (float(cam.sense), *codes)


def height(pen: Pen, shapes: LinkShapes, follower: str) -> tuple[int, int, int]:
    """The path of a follower's point, the cam's pivot, and how high above this it stands."""
    key = ("cam height", follower)
    cam, point = pen.scene.cams[follower], pen.scene.link(follower).points[0]
    path = path_of(pen, shapes, pen.first_slide(follower), follower, point)
    pivot = pen.the("position", cam.pivot)
    if key not in pen.shared:
        steps, extra = law_steps(pen, shapes, cam)
        with pen.on(Part.POSITION, Plane.NUMBERS):
            prime = pen.given("length", cam.base)
            if cam.tip == "roller":
                prime = pen.draw(widened, prime, pen.given("length", cam.roller))
            lifted = pen.draw_shared(("cam lift", follower), lift, *steps, extra=extra)
            kind = height_of_face if cam.is_flat else height_of_tip
            pen.shared[key] = pen.draw(kind, path, pivot, prime, lifted)
    return path, pivot, pen.shared[key]


@action("cam-prime")
def widened(base: Real, roller: Real) -> Real:
    """The radius of the prime circle, on which the roller's centre begins."""
    return base + roller


def curvature_centre(pen: Pen, shapes: LinkShapes, base: Base, name: str) -> int:
    """The centre of curvature of a cam under its follower, in the plane."""
    follower = pen.scene.cam_centres[name]
    cam = pen.scene.cams[follower]
    path, pivot, above = height(pen, shapes, follower)
    steps, extra = law_steps(pen, shapes, cam)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        rate = pen.draw(lift_rate, *steps, extra=extra)
        bend = pen.draw(lift_bend, *steps, extra=extra)
    lifted = pen.shared["cam lift", follower]
    kind = centre_under_face if cam.is_flat else centre_under_tip
    with pen.on(Part.POSITION, Plane.MECHANISM):
        point = pen.draw(kind, pivot, path, above, rate, bend, name=name)
        roles = {"link": cam.on, "follower": follower, "start": cam.pivot, "name": name}
        made = CurvatureCentre(**roles, lift=lifted, rate=rate, bend=bend, point=point)
        pen.make(made)
    return point
