"""A scene as frozen records: numbers are exact and in their written units.

Nothing is solved here. A link's points come as *placings*, in an order in which each uses only
earlier points. The construction finds where a link lies in the plane.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, get_args

from msgspec import Struct, field
from msgspec.structs import astuple, replace

from graphkin.numbers.arithmetic import FLOAT, Kind, Point
from graphkin.scene.expression import TIME
from graphkin.scene.house import FRAMES, PLAIN, USUAL_PAPER, House
from graphkin.scene.quantity import LENGTHS, Quantity, combined, in_unit
from graphkin.text import IMPERIAL
from graphkin.text.errors import Message, message
from graphkin.text.school_signs import USUAL, SchoolSigns
from graphkin.text.tables import listed

if TYPE_CHECKING:
    from graphkin.numbers.cam_motions import Rise
    from graphkin.scene.forces import Forces

FRAME = "0"
"""Name of the fixed link."""


Lengths = tuple[tuple[str, str, Quantity], ...]
"""Bars with their lengths, as (from, to, length)."""


class Parameter(Struct, frozen=True):
    """A number that a variant may change, with its permitted range."""

    name: str
    value: Quantity
    minimum: Quantity | None = None
    maximum: Quantity | None = None
    step: Quantity | None = None


class At(Struct, frozen=True):
    """``P = [x, y]``: a point by its coordinates in the link's axes."""

    point: str
    x: Quantity
    y: Quantity


class Polar(Struct, frozen=True):
    """``P = {from, length, angle}``: at a distance from a point, at an angle to the x axis."""

    point: str
    start: str
    length: Quantity
    angle: Quantity


class Apart(Struct, frozen=True):
    """``P-Q = l`` for the link's first two points: Q at that distance along the x axis."""

    point: str
    start: str
    length: Quantity


class Triangle(Struct, frozen=True):
    """Two lengths and ``P = "left of A-B"``: side is +1 left of the line from A to B, -1 right."""

    point: str
    first: str
    second: str
    from_first: Quantity
    from_second: Quantity
    side: int


class OnLine(Struct, frozen=True):
    """``P = "on A-B"`` or ``"beyond B on A-B"``: at a distance from ``start`` along A to B.

    sense +1 steps from ``start`` in the direction from ``first`` to ``second``, -1 in the other.
    ``by_parts`` means that the scene places ``second`` on the bar from ``first`` to ``point``.
    """

    point: str
    first: str
    second: str
    start: str
    length: Quantity
    sense: int
    by_parts: bool = False


class Angled(Struct, frozen=True):
    """``P-Q-R`` with ``Q-R``: R at that distance from Q, turned counter-clockwise from QP.

    ``clockwise`` is for P where ``R-Q-P`` is written: the angle counts as negative.
    """

    point: str
    vertex: str
    arm: str
    length: Quantity
    angle: Quantity
    clockwise: bool = False


Placing = At | Polar | Apart | Triangle | OnLine | Angled


def lengths_of(placing: Placing) -> Lengths:
    """The bars whose lengths a placing states."""
    match placing:
        case At():
            return ()
        case Triangle(point, first, second, one, other):
            return (first, point, one), (second, point, other)
        case Angled(point, vertex, _, length):
            return ((vertex, point, length),)
    return ((placing.start, placing.point, placing.length),)


class Slide(Struct, frozen=True):
    """A block on a straight guide of link ``on``.

    The guide passes ``through`` a point of that link, given by name or coordinates, at an angle to
    its x axis. Or it runs ``along`` two of its points; the coordinate is then zero at the first and
    positive towards the second. The block's first point keeps the distance ``offset`` to the left
    of the guide. ``rollers`` of one size, which keep a link parallel to their track, may replace a
    guide.
    """

    on: str
    through: str | tuple[Quantity, Quantity] | None
    angle: Quantity | None
    along: tuple[str, str] | None
    offset: Quantity
    pin: bool = False
    rollers: tuple[str, ...] = ()

    def named(self, block: str) -> Message:
        """The description of the guide of a block."""
        return message("the guide of block {block} on {on}", block=block, on=link_words(self.on))

    def called(self, names: Mapping[str, str]) -> Slide:
        """The slide with links renamed."""
        return replace(self, on=names.get(self.on, self.on))


class Wheel(Struct, frozen=True):
    """A circle of a link about one of its points; ``inside`` for a ring with inner teeth.

    ``sized`` says what gave the radius of a wheel known by its teeth alone: a distance of centres,
    or a module that the program proposes.
    """

    centre: str
    radius: Quantity | None
    teeth: Quantity | None = None
    inside: bool = False
    sized: Literal["", "distance", "proposed"] = ""


def of_one_size(one: Wheel, other: Wheel) -> bool:
    """Whether two wheels have one size for all parameters: written alike, or equal numbers."""
    r, s = one.radius, other.radius
    if r is None or s is None:
        return False
    if r.uses() or s.uses():
        return (r.tree, r.unit) == (s.tree, s.unit)
    return bool(r.number({}) == s.number({}))


def between_centres(wheels: Sequence[Wheel], sizes: Sequence[Quantity]) -> Quantity:
    """The sum of the sizes of two wheels that touch; their difference where one is a ring."""
    (one, other), (first, second) = wheels, sizes
    if one.inside:
        return combined("-", first, second)
    return combined("-" if other.inside else "+", second, first)


class StrandTension(Struct, frozen=True):
    """What fixes the tensions in both strands of a belt, beside the moment that it carries.

    ``key`` is one of TENSIONS, ``number`` its value: a force in N, or a ratio.
    """

    key: str
    number: Quantity


TENSIONS = {"slack": "N", "pretension": "N", "ratio": ""}
"""What a scene may state of a belt's tensions, with its unit.

They are the tension in the slack strand, the mean of both strands, and the ratio of the tight
strand's tension to the slack one's.
"""


class Belt(Struct, frozen=True):
    """A belt, chain or rope round two wheels, ``crossed`` or open."""

    crossed: bool = False
    tension: StrandTension | None = None

    @property
    def sense(self) -> int:
        """+1 where the wheels turn oppositely relative to their arm, like gears; else -1."""
        return 1 if self.crossed else -1


class Rolling(Struct, frozen=True):
    """A wheel that rolls without slip on a straight or circular track of link ``on``.

    With a ``belt`` the wheels do not touch: the belt joins their rims, without slip. ``turns`` are
    whole turns, added to the angle of a link that only its pins determine. That angle is otherwise
    within half a turn of its ``start``. ``keeper`` is the massless link that keeps the wheel in
    contact, where no link of the scene does. ``wheels`` are the indices, in their links' lists, of
    the wheel and of the one it rolls ``on``; without them the distance of the centres decides.
    """

    on: str
    through: str | tuple[Quantity, Quantity] | None
    angle: Quantity | None
    start: Mapping[str, Quantity]
    side: int = 1
    turns: Mapping[str, Quantity] = {}
    belt: Belt | None = None
    keeper: str = ""
    wheels: tuple[int, int] | None = None

    def pairs(self, own: Sequence[Wheel], other: Sequence[Wheel]) -> list[tuple[Wheel, Wheel]]:
        """The wheels of both links that may touch: the two named, else each with each."""
        if self.wheels is None:
            return [(one, another) for one in own for another in other]
        i, k = self.wheels
        return [*zip(own[i : i + 1], other[k : k + 1], strict=False)]

    def named(self, wheel: str) -> Message:
        """The description of the contact of a wheel."""
        return message("the contact of link {wheel} with {on}", wheel=wheel, on=link_words(self.on))

    def called(self, names: Mapping[str, str]) -> Rolling:
        """The rolling contact with links renamed."""
        return replace(
            self,
            on=names.get(self.on, self.on),
            keeper=names.get(self.keeper, self.keeper),
            start={names.get(name, name): angle for name, angle in self.start.items()},
            turns={names.get(name, name): count for name, count in self.turns.items()},
        )


GuideOrTrack = Slide | Rolling
"""A joint that guides a link."""


class Profile(Struct, frozen=True):
    """The edge by which a link touches another: an arc about a point of the link, only drawn.

    It passes ``through`` the present position of a point, which may belong to another link. It is
    drawn over an ``arc`` about that position or, without one, as far as there is room. For a
    ``hollow``, the link lies beyond the arc and is not drawn to its centre.
    """

    about: str
    through: str
    arc: Quantity | None = None
    hollow: bool = False


class CamPiece(Struct, frozen=True):
    """A piece of a cam's law: up to the angle ``to`` it lifts by ``rise``, zero in a dwell.

    A piece of a table is a cubic between two of its points. ``slopes`` are its derivatives at both
    ends times its angle.
    """

    to: Quantity
    rise: Quantity
    motion: str
    slopes: tuple[Quantity, Quantity] | None = None


class CamLever(Struct, frozen=True):
    """A follower that a cam swings about ``pin``, with its bar from there to the tip.

    ``side`` is +1 for a bar left of the line from the cam's pivot to the pin. A flat face is
    parallel to the bar, ``face`` nearer to the cam.
    """

    pin: str
    side: int
    face: Quantity


class Conjugate(Struct, frozen=True):
    """A second roller of a follower, about its point ``at``, on a second profile of the cam."""

    at: str
    roller: Quantity


class Cam(Struct, frozen=True):
    """A cam that lifts a follower by a law: the disc of link ``on``, which turns about ``pivot``.

    ``tip`` is the follower's tip: a roller of the radius ``roller``, a knife, or a flat face.
    ``point`` is the roller's centre, the knife's edge, or a point of the face. A follower with a
    ``lever`` swings; another slides. The law counts from the cam's angle ``start``,
    counter-clockwise for ``sense`` +1. The equivalent linkage of an instant joins the centre of
    curvature ``centre``, a point of the cam, by link ``link``. A ``conjugate`` roller keeps contact
    on the other side and does not change the motion.

    All positions are relative to the link ``carrier`` that guides the follower or carries its pin.
    A cam that ``slides`` on that link is a plate, level along the path of its point ``pivot``. The
    law is then a function of its coordinate, counted from ``start``, forward for ``sense`` +1.
    """

    on: str
    pivot: str
    tip: str
    base: Quantity
    roller: Quantity
    law: tuple[CamPiece, ...]
    start: Quantity
    sense: int
    centre: str
    link: str
    point: str
    lever: CamLever | None = None
    conjugate: Conjugate | None = None
    carrier: str = FRAME
    slides: bool = False

    @property
    def is_flat(self) -> bool:
        """Whether the follower touches the cam with a flat face."""
        return self.tip == "flat"

    @property
    def slopes(self) -> tuple[tuple[Quantity, Quantity], ...]:
        """The slopes of a table's cubics; none for a law of motions."""
        return tuple(piece.slopes for piece in self.law if piece.slopes is not None)

    def displacement(self, place: Point, values: Mapping[str, Any], kind: Kind = FLOAT) -> Rise:
        """The lift of the follower, with its derivatives by the cam's angle or coordinate.

        ``place`` is the direction of the cam's axis relative to the carrier, or the coordinate (m)
        of a cam that slides.
        """
        from graphkin.numbers.cam_motions import displaced, displaced_along

        pieces = (
            [piece.to.si(values, kind) for piece in self.law],
            [piece.rise.si(values, kind) for piece in self.law],
            [piece.motion for piece in self.law],
        )
        if self.slides:
            found = displaced_along(self.sense * (place - self.start.si(values, kind)), *pieces)
            return found._replace(rate=self.sense * found.rate)
        from_start = place * self.start.direction(values, kind).conjugate()
        found = displaced(
            from_start if self.sense > 0 else from_start.conjugate(),
            *pieces,
            [(one.si(values, kind), other.si(values, kind)) for one, other in self.slopes],
        )
        return found._replace(rate=self.sense * found.rate)

    def called(self, names: Mapping[str, str]) -> Cam:
        """The cam with links renamed."""
        on, link, carrier = (names.get(name, name) for name in (self.on, self.link, self.carrier))
        return replace(self, on=on, link=link, carrier=carrier)


JOINED = ("slides", "rolls", "belt", "wheel", "wheels")
"""The keys of a link's joints other than points."""
MASS_KEYS = ("mass", "centre", "inertia")
"""The keys of a link's mass."""
TABLES = frozenset((*JOINED, "touches", "profiles", "cam"))
"""The keys of a link that hold tables."""
KEYWORDS = TABLES.union(MASS_KEYS)
LEADING = message("slides or rolls")
"""The keys, in words, of joints that guide a link along another."""
LINK_KEYS = message("slides, rolls, belt, wheel, touches or profiles")
"""The keys, in words, of a link other than its points."""


class Link(Struct, frozen=True):
    """A rigid body: its points in the order written, their placings, its guides and wheels."""

    name: str
    points: tuple[str, ...]
    placings: tuple[Placing, ...]
    slides: tuple[Slide, ...] = ()
    wheels: tuple[Wheel, ...] = ()
    rolls: tuple[Rolling, ...] = ()
    profiles: tuple[Profile, ...] = ()
    cam: Cam | None = None

    def wheel_sign(self, wheel: Wheel) -> str:
        """The label of one of its wheels: the link's name, then with primes: 2, 2′, 2″."""
        return self.name + ("′" * self.wheels.index(wheel)).replace("′′", "″")

    @property
    def rim(self) -> Wheel:
        """The wheel that a straight track touches: the first with its rim outside."""
        return next((wheel for wheel in self.wheels if not wheel.inside), self.wheels[0])

    @property
    def has_wheels(self) -> bool:
        """Whether the link has wheels, or rolls on those of others."""
        return bool(self.wheels or self.rolls)

    @property
    def paths(self) -> tuple[GuideOrTrack, ...]:
        return (*self.slides, *self.rolls)

    @property
    def spare_paths(self) -> tuple[GuideOrTrack, ...]:
        """The joints that may be idle: tracks of its wheels, and all guides except the first."""
        return (*self.rolls, *self.slides[1:])

    def without(self, path: GuideOrTrack) -> Link:
        """The link without one of its guides or tracks."""
        slides = tuple(each for each in self.slides if each is not path)
        return replace(self, slides=slides, rolls=tuple(r for r in self.rolls if r is not path))

    def is_hollow_about(self, point: str) -> bool:
        """Whether a point of the link is the centre of a hollow in it."""
        return any(each.hollow and each.about == point for each in self.profiles)

    def called(self, names: Mapping[str, str]) -> Link:
        """The link renamed, and with the links renamed on which it slides and rolls."""
        return replace(
            self,
            name=names.get(self.name, self.name),
            slides=tuple(slide.called(names) for slide in self.slides),
            rolls=tuple(rolling.called(names) for rolling in self.rolls),
            cam=None if self.cam is None else self.cam.called(names),
        )


def link_words(name: str) -> Message:
    """A link by its name; link 0 is the frame."""
    return message("the frame") if name == FRAME else message("link {on}", on=name)


def joined_words(names: Sequence[str]) -> str:
    """Several links by their names; the frame is named separately."""
    return listed(map(link_words, names)) if FRAME in names else f"links {listed(names)}"


DriverKind = Literal["turn", "slide", "roll"]
DRIVEN: tuple[str, ...] = get_args(DriverKind)
"""The kinds of driver, as written."""


class Driver(Struct, frozen=True):
    """A given motion: link ``link`` turns, slides or rolls ``against`` another.

    ``of`` names the line (from, to) of the link whose angle is given; without it, the x axis
    counts.
    """

    kind: DriverKind
    link: str
    against: str
    position: Quantity
    speed: Quantity
    acceleration: Quantity
    of: tuple[str, str] | None = None

    @property
    def jerk(self) -> Quantity:
        """The derivative of the acceleration: of its law of time, else zero."""
        return self.acceleration.derivative(TIME)


class Side(Struct, frozen=True):
    """``B = "right of A-O2"``: +1 left, -1 right of the line from ``first`` to ``second``."""

    first: str
    second: str
    side: int

    def __str__(self) -> str:
        return f"{'left' if self.side > 0 else 'right'} of {self.first}-{self.second}"


class Way(Struct, frozen=True):
    """``5 = "forward"``: +1 the larger, -1 the smaller slide coordinate of the two closures."""

    way: int

    def __str__(self) -> str:
        return "forward" if self.way > 0 else "backward"


class Closure(Struct, frozen=True):
    """``2 = "closure 1"``: the number of a closure of a group of higher class."""

    number: int

    def __str__(self) -> str:
        return f"closure {self.number}"


Branch = Side | Way | Closure


PointNames = tuple[str, ...]
"""Names of points, which may be written ``A@3``."""
LinkNames = tuple[str, ...]


class Ask(Struct, frozen=True):
    """The requested quantities, each with the points or links of which it is requested.

    ``pairs`` are two links with a dash, such as ``2-4``, whose relative centre is requested. They
    are in the order of the scene, with the frame first. ``curves`` are points whose paths are
    requested. ``strokes`` are blocks whose stroke, and links whose swing is requested.
    """

    velocity: PointNames = ()
    acceleration: PointNames = ()
    jerk: PointNames = ()
    omega: LinkNames = ()
    epsilon: LinkNames = ()
    poles: LinkNames = ()
    centres: LinkNames = ()
    centrodes: LinkNames = ()
    slides: LinkNames = ()
    pairs: LinkNames = ()
    inflection: LinkNames = ()
    curvature: PointNames = ()
    curves: PointNames = ()
    strokes: LinkNames = ()
    time_ratios: LinkNames = ()

    @property
    def anything(self) -> bool:
        return any(astuple(self))

    @property
    def chosen_by_place(self) -> bool:
        """Whether a request is solved in a way that depends on the position of the mechanism."""
        return bool(self.pairs or self.inflection)


POINTS_ASKED = tuple(key for key, names in Ask.__annotations__.items() if names == "PointNames")
"""The keys of [ask] that list points; the others list links."""


class Sheet(Struct, frozen=True):
    """The contents of the title block and the options of the page.

    ``method`` selects how components of accelerations are found: triangles, or Klein's
    construction. ``plan`` selects how velocities are drawn: images alone, or Kutzbach's plan of a
    train with them. ``rule`` sets the size of plans: as large as possible, or as in the lab, with
    vectors of the crank's pin as long as the crank. ``enlarge`` is the factor on that length, one
    number for each plan or one for both. ``student`` is the owner of the sheet, set by a class, not
    by a scene. ``steps`` are the first digits of a school's scales, () for the usual ones.
    ``paper`` and ``frame`` are names of papers and frames.
    """

    owner: str = ""
    author: str = ""
    student: str = ""
    approved: str = ""
    date: str = ""
    number: str = ""
    language: str = "en"
    scale: Quantity | None = None
    sheets: int = 2
    rule: str = "largest"
    enlarge: tuple[Quantity, ...] = ()
    ka: Quantity | None = None
    method: str = "triangles"
    plan: str = "images"
    signs: SchoolSigns = USUAL
    steps: tuple[float, ...] = ()
    paper: str = USUAL_PAPER
    frame: str = FRAMES[0]


class StatedPositions(Struct, frozen=True):
    """The positions that a sheet of the whole motion shows.

    ``count`` are the equal steps of the driver, which may depend on parameters. ``start`` is
    "scene", "dead" for a dead point, or a position of the driver. ``strong`` is the number of the
    position that is drawn strongly, None for the one nearest to the scene's own. With ``one_pole``
    all plans of a kind have one pole; otherwise each has its own. ``accelerations`` are the numbers
    of the positions with an acceleration plan, None for all.
    """

    count: int | Quantity = 12
    start: Literal["scene", "dead"] | Quantity = "scene"
    strong: int | None = None
    one_pole: bool = False
    accelerations: tuple[int, ...] | None = None


def quantities_within(part: object) -> Iterator[Quantity]:
    """The quantities that occur in a part of a scene, in order."""
    if isinstance(part, Quantity):
        yield part
    elif isinstance(part, Struct):
        yield from quantities_within(astuple(part))
    elif isinstance(part, Mapping):
        yield from quantities_within(tuple(part.values()))
    elif isinstance(part, tuple | list):
        for each in part:
            yield from quantities_within(each)


HALVED = (1.0, 2.0, 4.0, 8.0)
"""The first digits of the scales of drawings in inches or feet: full, half, quarter, eighth."""
MEASURED = ("frame", "links", "drivers", "near", "forces")
"""The parts of a scene that have lengths, forces and masses."""


def rebased(part: Any, base: str) -> Any:
    """A part of a scene with its lengths computed in another unit."""
    if isinstance(part, Quantity):
        unit = in_unit(part.unit, base)
        return part if unit == part.unit else replace(part, unit=unit)
    if isinstance(part, Struct):
        own = {name: getattr(part, name) for name in part.__struct_fields__}
        new = {name: rebased(each, base) for name, each in own.items()}
        changed = {name: each for name, each in new.items() if each is not own[name]}
        return replace(part, **changed) if changed else part
    if isinstance(part, Mapping):
        return {name: rebased(each, base) for name, each in part.items()}
    if isinstance(part, tuple | list):
        return type(part)(rebased(each, base) for each in part)
    return part


class Scene(Struct, frozen=True, dict=True):
    """A planar mechanism in one position, with the requested quantities.

    ``near`` gives angles within half a turn of which links' angles are taken, where a motion says
    more than the ``start`` of a rolling. Scenes do not state them; sweeps do. ``titles`` and
    ``notes`` hold texts per language, and ``names`` the links' names in each. ``values`` holds the
    parameters as set, exact. ``forces`` are its masses and loads, None if it has none. ``house``
    are the conventions of its school. ``results`` names the unit of results, "" for the usual one.
    ``base`` is the unit in which its lengths are computed.
    """

    name: str
    title: str
    units: Mapping[str, str]
    parameters: Mapping[str, Parameter]
    frame: Link
    links: Mapping[str, Link]
    drivers: tuple[Driver, ...]
    branches: Mapping[str, Branch]
    ask: Ask
    sheet: Sheet = field(default_factory=Sheet)
    time: Quantity | None = None
    near: Mapping[str, Quantity] = field(default_factory=dict)
    titles: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    notes: Mapping[str, str] = field(default_factory=dict)
    values: Mapping[str, Any] = field(default_factory=dict)
    source: str | None = None
    forces: Forces | None = None
    positions: StatedPositions = field(default_factory=StatedPositions)
    house: House = PLAIN
    results: str = ""
    base: str = "m"

    def title_in(self, language: str) -> str:
        """The title in a language."""
        return self.titles.get(language, self.title)

    @property
    def unit_of_results(self) -> str:
        """The unit of length in which results are printed: as stated, else inches of inches.

        With inches or feet, forces are in pounds-force, otherwise in newtons.
        """
        own = self.units["length"]
        usual = own if own in IMPERIAL else "m"
        return {"": usual, "SI": "m", "scene": own}.get(self.results, self.results)

    def computed_in(self, base: str) -> Scene:
        """The same scene with its lengths, forces and masses computed in the system of a unit."""
        if base == self.base:
            return self
        parts = {name: rebased(getattr(self, name), base) for name in MEASURED}
        return replace(self, **parts, base=base)

    @property
    def unit_length(self) -> float:
        """The unit of its lengths, in the unit in which lengths are computed."""
        return float(LENGTHS[self.units["length"]] / LENGTHS[self.base])

    @property
    def every_link(self) -> tuple[Link, ...]:
        """The frame, then the moving links as written."""
        return (self.frame, *self.links.values())

    @property
    def fixed_points(self) -> tuple[str, ...]:
        """The points of the frame that do not move, unlike a fixed cam's centre of curvature."""
        return tuple(point for point in self.frame.points if point not in self.cam_centres)

    def driver_name(self, driver: Driver) -> str:
        """The driven link, with the other one where several drivers move it: 1, or 1-2."""
        several = sum(each.link == driver.link for each in self.drivers) > 1
        return f"{driver.link}-{driver.against}" if several else driver.link

    @property
    def keepers(self) -> Mapping[str, tuple[str, Rolling]]:
        """The massless links that keep wheels in contact, with the wheels' links."""
        every = ((link.name, rolling) for link in self.every_link for rolling in link.rolls)
        return {rolling.keeper: (name, rolling) for name, rolling in every if rolling.keeper}

    @property
    def unseen(self) -> frozenset[str]:
        """The keepers of wheels that reports do not mention.

        A keeper that a driver moves is mentioned, and one that keeps two wheels at their distance,
        as the arm between sun and ring does.
        """
        driven = {end for driver in self.drivers for end in (driver.link, driver.against)}
        axles = Counter(each for link in self.every_link for each in self.axles_of(link))
        return frozenset(
            name
            for name in self.keepers
            if name in self.links  # a part of a mechanism may be without it
            and name not in driven
            and axles[frozenset(self.links[name].points)] < 2
        )

    def axles_of(self, link: Link) -> Iterator[frozenset[str]]:
        """The centres of both wheels of each contact of a link with a wheel."""
        for rolling in link.rolls:
            if rolling.through is None and rolling.belt is None:
                pairs = rolling.pairs(link.wheels, self.link(rolling.on).wheels)
                yield from {frozenset((one.centre, other.centre)) for one, other in pairs}

    @property
    def bare(self) -> Scene:
        """The scene without its unseen keepers, as links and pairs are counted."""
        if not (unseen := self.unseen):
            return self

        def less(link: Link) -> Link:
            rolls = (
                replace(each, keeper="") if each.keeper in unseen else each for each in link.rolls
            )
            return replace(link, rolls=tuple(rolls))

        links = {name: less(link) for name, link in self.links.items() if name not in unseen}
        return replace(self, frame=less(self.frame), links=links)

    @property
    def touching(self) -> tuple[tuple[str, str], ...]:
        """Each wheel's link with the link on which it rolls or to which a belt runs, as written."""
        return tuple((link.name, each.on) for link in self.every_link for each in link.rolls)

    @property
    def in_touch(self) -> tuple[tuple[str, str], ...]:
        """The contacts except open belts on wheels of one size, whose points never touch."""
        every = ((link.name, each) for link in self.every_link for each in link.rolls)
        return tuple((name, each.on) for name, each in every if not self.turn_alike(name, each))

    @property
    def belted(self) -> tuple[tuple[str, str], ...]:
        """The pairs of links that a belt joins."""
        return tuple((name, each.on) for name, each in self.belts)

    @property
    def belts(self) -> Iterator[tuple[str, Rolling]]:
        """The belts, each with the link that has its key."""
        links = self.links.values()
        return ((link.name, each) for link in links for each in link.rolls if each.belt)

    def turn_alike(self, name: str, rolling: Rolling) -> bool:
        """Whether an open belt joins a wheel of link ``name`` with another of the same size."""
        belt = rolling.belt
        if belt is None or belt.crossed:
            return False
        both = rolling.pairs(self.link(name).wheels, self.link(rolling.on).wheels)
        return of_one_size(*both[0])

    @cached_property
    def cams(self) -> Mapping[str, Cam]:
        """The cams by the links that they lift."""
        return {link.name: link.cam for link in self.links.values() if link.cam is not None}

    @cached_property
    def cam_links(self) -> Mapping[str, str]:
        """The links of equivalent linkages, with the follower that each moves."""
        return {cam.link: follower for follower, cam in self.cams.items()}

    @cached_property
    def cam_centres(self) -> Mapping[str, str]:
        """The centres of curvature of cams, with the follower that each moves."""
        return {cam.centre: follower for follower, cam in self.cams.items()}

    @cached_property
    def points(self) -> Mapping[str, None]:
        """Every point of every link, once, in the order written."""
        return dict.fromkeys(point for link in self.every_link for point in link.points)

    def link(self, name: str) -> Link:
        """The link of a name, the frame included."""
        return self.frame if name == FRAME else self.links[name]

    def values_in(self, kind: Kind) -> Mapping[str, object]:
        """The values, with the time as a number of the given kind; it may be no fraction."""
        if kind is FLOAT or self.time is None:
            return self.values
        return {**self.values, TIME: self.time.number(self.values, kind)}
