"""What a sheet is drawn from: the scene, the trace of the steps it needs, scales and words."""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import ceil, floor, pi
from typing import TYPE_CHECKING, Any

from msgspec import Struct, field

from graphkin.construction.core.link_poses import LinkPoses
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Part, PlanAside, Plane, Step
from graphkin.construction.core.quantities import (
    MOTION,
    PLANES,
    RATE,
    SLIDING,
    MotionQuantity,
    OnPaper,
)
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import Curve, Verdict
from graphkin.construction.core.vocabulary import join
from graphkin.drawing.scale import Extent, Scales, extent_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.plane import Circle, Line, Ratio, Vector, cross
from graphkin.scene.model import FRAME, Scene, Slide
from graphkin.text import Words

if TYPE_CHECKING:
    from graphkin.drawing.field import Field

METRES = {"mm": 0.001, "cm": 0.01, "m": 1.0, "in": 0.0254}
"""The units in which a scene may write lengths."""
ENDLESS = 1e9
"""A centre so many mechanisms away counts as at infinity."""
NOISE = 1e-9
"""A quantity this small beside the largest of its kind is rounding and shown as nought."""


class Drawing(Struct, frozen=True, dict=True):
    """One sheet's material; ``kind`` is velocity or acceleration, ``trace`` holds drawn steps.

    ``again``: the mechanism stands on a sheet before this one, with how it is drawn. ``stand`` is
    where it stands on all sheets alike, None where this sheet alone decides. ``curves`` are those
    over the whole motion. ``computed`` says by the symbol why a quantity is computed, not measured.
    ``driven`` are angles of drivers in degrees, where these are not the scene's.
    ``chosen`` is the sheet whose choices of places hold for it too: where a mark has room, and what
    is long enough for one, which may be otherwise where the same scene stands elsewhere.
    """

    kind: str
    scene: Scene
    trace: Trace
    scales: Scales
    verdict: Verdict
    words: Words
    again: bool = False
    stand: Field | None = None
    curves: tuple[Curve, ...] = ()
    computed: Mapping[str, str] = field(default_factory=dict)
    driven: Mapping[str, Any] = field(default_factory=dict)
    chosen: Drawing | None = None

    @property
    def choosing(self) -> Drawing:
        """The sheet at whose position places of marks are chosen."""
        return self.chosen or self

    @property
    def plane(self) -> Plane:
        """The plan that this sheet shows."""
        return PLANES[self.kind]

    @property
    def vector(self) -> MotionQuantity:
        """What this sheet finds of points: velocity or acceleration."""
        return MOTION[self.kind]

    @property
    def rate(self) -> MotionQuantity:
        """What it finds of links: angular velocity or angular acceleration."""
        return RATE[self.kind]

    @property
    def sliding(self) -> MotionQuantity:
        """What it finds of blocks along their guides: speed or acceleration."""
        return SLIDING[self.kind]

    @property
    def pole(self) -> str:
        """Name of the plan's pole."""
        return "o" if self.kind == "velocity" else "o′"

    def steps(self, *planes: Plane) -> Iterator[tuple[int, Step, Any]]:
        """The steps of some planes that were run, in order, with their values."""
        for number, value in self.trace.values.items():
            step = self.trace.program.steps[number]
            if step.plane in planes:
                yield number, step, value

    @cached_property
    def normals(self) -> tuple[tuple[int, Step], ...]:
        """The steps of the triangles on the mechanism that were run."""
        on_it = self.steps(Plane.MECHANISM)
        return tuple((number, step) for number, step, _ in on_it if step.part is Part.NORMAL)

    @cached_property
    def on_mechanism(self) -> tuple[tuple[int, Step, Any], ...]:
        """The steps that this sheet draws on the mechanism, with their values."""
        own = (
            (Part.POSITION, Part.NORMAL, Part.POLE)
            if self.kind == "acceleration"
            else (Part.POSITION, Part.CENTRE)
        )
        parts = (*own, Part(self.kind))
        return tuple(drawn for drawn in self.steps(Plane.MECHANISM) if drawn[1].part in parts)

    def place(self, centre: Ratio) -> complex | None:
        """The point of a centre or pole; None at infinity, or as far away as makes no odds."""
        if abs(centre.size) * ENDLESS * self.reach <= abs(centre.shift):
            return None
        return complex(centre.start + centre.shift / centre.size)

    def is_everywhere(self, centre: Ratio) -> bool:
        """True when every point is a centre or pole: the link stands still."""
        least = NOISE * (self.largest or 1.0)
        return bool(abs(centre.size) <= least and abs(centre.shift) <= least * self.reach)

    @cached_property
    def standing(self) -> LinkPoses:
        """Where the links, guides and wheels stand."""
        return LinkPoses(self.scene, self.trace)

    @cached_property
    def reach(self) -> float:
        """The largest distance in the mechanism, in metres."""
        box = extent_of([*self.positions.values(), *self.corners()])
        return float(max(box.width, box.height))

    @cached_property
    def grounds(self) -> dict[float, dict[str, tuple[complex, float]]]:
        """The grounds of pivots that were chosen at this position, by the scale."""
        return {}

    @property
    def positions(self) -> Mapping[str, complex]:
        """Where each point of the mechanism stands, in metres."""
        return self.standing.positions

    def corners(self) -> Iterator[complex]:
        """The corners of the wheels' boxes, and where wheels touch and blocks are drawn."""
        for disc in self.standing.discs:
            yield disc.centre + disc.outer * (1 + 1j)
            yield disc.centre - disc.outer * (1 + 1j)
        if self.scene.cams:
            yield from self.cam_corners()
        yield from self.profile_corners()
        yield from (touch.at for touch in self.standing.touches)
        ways = self.standing.guideways
        yield from (self.standing.beside_wheels(way) for way in ways if way.slide.on == FRAME)

    def cam_corners(self) -> Iterator[complex]:
        """The corners of the boxes in which the profiles of cams turn."""
        from graphkin.construction.core.cam_profiles import DRAWN, profiles_of

        for follower, cam in self.scene.cams.items():
            axis = self.standing.axis(cam.on)
            if cam.slides and cam.pivot in self.positions and axis is not None:
                profile, *_ = profiles_of(self.scene, follower, DRAWN)
                yield from (self.positions[cam.pivot] + axis * place for place in profile.outline)
            elif cam.pivot in self.positions:
                reach = max(each.reach for each in profiles_of(self.scene, follower, DRAWN))
                yield from (self.positions[cam.pivot] + reach * way for way in (1 + 1j, -1 - 1j))

    def profile_corners(self) -> Iterator[complex]:
        """The ends of the profiles with stated arcs, and where these reach farthest."""
        for profile in (each for link in self.scene.every_link for each in link.profiles):
            if profile.arc is None or not {profile.about, profile.through} <= set(self.positions):
                continue
            centre = self.positions[profile.about]
            arm = self.positions[profile.through] - centre
            half, middle = float(profile.arc.si(self.scene.values)) / 2, phase(arm)
            first, last = ceil((middle - half) / (pi / 2)), floor((middle + half) / (pi / 2))
            angles = middle - half, middle + half, *(pi / 2 * n for n in range(first, last + 1))
            yield from (centre + rect(abs(arm), angle) for angle in angles)

    def guide(self, slide: Slide) -> tuple[complex, complex] | None:
        """A point and the unit direction of the line that a guide of the frame keeps a block on.

        None for a guide that moves.
        """
        along = self.standing.direction(slide) if slide.on == FRAME else None
        if along is None:
            return None
        start = self.standing.carried(FRAME, slide.along[0] if slide.along else slide.through)
        assert start is not None
        return start + 1j * along * float(slide.offset.si(self.scene.values)), along

    @cached_property
    def children(self) -> Mapping[int, tuple[int, ...]]:
        """The steps that use each step, among those that were run."""
        found: dict[int, list[int]] = {}
        for number in self.trace.values:
            for arg in self.trace.program.steps[number].args:
                found.setdefault(arg, []).append(number)
        return {number: tuple(users) for number, users in found.items()}

    @cached_property
    def results(self) -> Mapping[int, int]:
        """For the last step of a hand's way, the composite step that it gives."""
        steps = self.trace.program.steps
        return {
            hand: number
            for number in self.trace.values
            if (hand := steps[number].by_hand) is not None
        }

    def lettered(self, number: int) -> str:
        """Markup of the letter of a step."""
        return symbol(self.trace.program.steps[number].name)

    def number_of(self, step: Step) -> int:
        """The number of a step in its program."""
        return self.numbers[id(step)]

    @cached_property
    def numbers(self) -> Mapping[int, int]:
        """The number of each step by its identity."""
        return {id(step): number for number, step in enumerate(self.trace.program.steps)}

    @cached_property
    def joins(self) -> Mapping[tuple[int, int], Step]:
        """The arrows of the plans by the points that they join, whether or not they were run.

        Where two join the same points, the first.
        """
        return {
            (step.args[0], step.args[1]): step
            for step in reversed(self.trace.program.steps)
            if step.arrow and step.action is join
        }

    @cached_property
    def feet(self) -> Mapping[int, int]:
        """The arrows of the components that end, or begin, in points of the plan without a name."""
        found: dict[int, int] = {}
        for number, step, _ in self.steps(self.plane):
            vector = plan_vector(step)
            if vector is not None and vector.foot and step.action is join:
                found.setdefault(step.args[0 if vector.back else 1], number)
        return found

    @cached_property
    def auxiliary(self) -> Mapping[int, PlanAside]:
        """The auxiliary plan of each step of the plan that only such a plan uses."""
        found: dict[int, PlanAside] = {}
        steps = self.trace.program.steps
        own = [number for number, _, _ in self.steps(self.plane)]
        for number in reversed(own):
            if steps[number].name:
                plan = steps[number].aside
                found |= {number: plan} if plan is not None else {}
                continue
            users = [*self.children.get(number, ()), self.results.get(number, -1)]
            users = [user for user in users if user in own]
            plans = {found.get(child) for child in users}
            if len(plans) == 1 and (plan := plans.pop()) is not None:
                found[number] = plan
        return found

    def settled(self, value: float) -> float:
        """A magnitude of the plan, or nought where it is only rounding."""
        return 0.0 if abs(value) < NOISE * self.natural else value

    @cached_property
    def natural(self) -> float:
        """A magnitude as large as the plan's own: its largest vector, or as much acceleration as
        its velocities give over the size of the mechanism."""
        if self.plane is Plane.VELOCITIES:
            return self.largest
        return max(self.largest, self.longest(Plane.VELOCITIES) ** 2 / self.reach)

    @cached_property
    def largest(self) -> float:
        """The largest vector of the plan."""
        return self.longest(self.plane)

    def longest(self, plane: Plane) -> float:
        """The largest vector of a plan."""
        vectors = (v for _, s, v in self.steps(plane) if s.arrow and isinstance(v, Vector))
        return max((abs(v.tip - v.tail) for v in vectors), default=0.0)

    def turning(self, link: str) -> float | None:
        """Angular velocity or acceleration of a link on this sheet; nought for mere rounding."""
        value = self.trace.value(self.rate.target, link)
        if value is None:
            return None
        largest = self.fastest
        if self.kind == "acceleration":
            largest = max(largest**2, *map(abs, self.all_of(self.rate.target)))
        return 0.0 if abs(value) < NOISE * largest else float(value)

    def rate_size(self, number: int, kind: str = "velocity") -> float:
        """The size of an angular velocity, or acceleration, by its step; zero for mere rounding."""
        value = abs(float(self.trace.values[number]))
        largest = self.fastest if kind == "velocity" else self.fastest**2
        return 0.0 if value < NOISE * largest else value

    @cached_property
    def fastest(self) -> float:
        """The largest angular velocity, or what the largest velocity gives over the mechanism."""
        turning = map(abs, self.all_of(RATE["velocity"].target))
        return max(self.longest(Plane.VELOCITIES) / self.reach, *turning)

    def all_of(self, quantity: str) -> list[float]:
        """The values of a quantity on this sheet, of the links that have it."""
        targets, values = self.trace.program.targets, self.trace.values
        numbers = (number for (what, _), number in targets.items() if what == quantity)
        return [0.0, *(values[number] for number in numbers if number in values)]

    def length(self, metres: float) -> float:
        """A length in the scene's own unit."""
        return metres / METRES[self.scene.units["length"]]

    def on_paper(self, metres: float) -> OnPaper:
        """How long a length of the mechanism is drawn."""
        return OnPaper(1000 * metres / self.scales.kL)

    def at_scale(self, plane: Plane, value: complex) -> complex:
        """A value of a plan in metres of the mechanism, drawn side by side with it."""
        if plane is Plane.VELOCITIES:
            return value * self.scales.metres("velocity")
        return value * self.scales.metres("acceleration") if plane is Plane.ACCELERATIONS else value

    def plan_extent(self) -> Extent:
        """The box of the plan at the mechanism's scale."""
        return extent_of(
            [
                self.at_scale(self.plane, point)
                for _, _, value in self.steps(self.plane)
                for point in ends(value)
            ]
        )

    def bare_extent(self) -> Extent:
        """The box of the mechanism with its curves, and nothing else that is drawn on it."""
        points = [*self.positions.values(), *self.corners()]
        return extent_of([*points, *shown(self.curves, extent_of(points))])

    def mechanism_extent(self) -> Extent:
        """The box of the mechanism and what is drawn on it; centres and poles do not count."""
        points: list[complex] = []
        for _, step, value in self.on_mechanism:
            if step.part not in (Part.CENTRE, Part.POLE) and takes_room(step, value):
                points += ends(value)
        return self.bare_extent().grown(points)


def takes_room(step: Step, value: Any) -> bool:
    """Whether a value on the mechanism is a vector or a place; the others are directions."""
    is_corner = step.of is not None and step.role in step.of.corners
    return bool(step.name) or isinstance(value, Vector) or is_corner


def ends(value: Any) -> tuple[complex, ...]:
    """The points that a drawn value takes up by itself; lines and arcs take up none."""
    if isinstance(value, Vector):
        return value.tail, value.tip
    if isinstance(value, Line | Circle | Ratio) or not isinstance(value, complex):
        return ()
    return (value,)


ROOMY = 3.5
"""A curve so many mechanisms wide, or less, is drawn whole; of a wider one only what fits."""
INWARD = 0.96
"""What of a path there is room for, in parts: its ends, which bear no letters, may stand in the
margin that those of the mechanism need."""
STRAIGHT = 1e-6
"""How far aside, in parts of its length, a curve may lead that counts as straight."""


def shown(curves: Sequence[Curve], mechanism: Extent) -> list[complex]:
    """The points of curves for which the drawing makes room.

    Curves of the mechanism's size are drawn whole; of a wider path what is about the mechanism, of
    wider centrodes, and of straight ones, where they touch. Of a locus what lies in the field
    will do.
    """
    found: list[complex] = []
    most = ROOMY * max(mechanism.width, mechanism.height)
    for curve in curves:
        if curve.kind == "locus":
            continue
        points = [point for run in curve.runs for point in run]
        box = extent_of(points) if points else mechanism
        is_wide = max(box.width, box.height) > most
        if curve.kind == "trajectory":
            if is_wide:
                points = [each for each in points if abs(each - mechanism.middle) <= most / 2]
            middle = mechanism.grown(points).middle
            found += [middle + INWARD * (point - middle) for point in points]
        elif not is_wide and not is_straight(points):
            found += points
        elif curve.now is not None and abs(curve.now - mechanism.middle) <= most:
            found.append(curve.now)
    return found


def is_straight(points: Sequence[complex]) -> bool:
    """Whether points all lie on one line."""
    if len(points) < 2:
        return False
    start, far = points[0], max(points, key=lambda point: abs(point - points[0]))
    aside = (abs(cross(far - start, point - start)) for point in points)
    return bool(max(aside) <= STRAIGHT * abs(far - start) ** 2)
