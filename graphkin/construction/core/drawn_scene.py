"""The material of a sheet: the scene, the trace of the steps it needs, scales and words."""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import ceil, floor, pi
from typing import Any, Literal

from msgspec import Struct, field

from graphkin.construction.core.link_poses import LinkPoses
from graphkin.construction.core.program import Part, PlanAside, Plane, Step, plan_vector
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
from graphkin.drawing.field import Field, SheetPaper, paper_of
from graphkin.drawing.scale import Extent, Scales, extent_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.plane import Circle, Line, Ratio, Vector, cross
from graphkin.scene.model import FRAME, Scene, Slide
from graphkin.text import Markup, Words

ENDLESS = 1e9
"""A centre this many times the mechanism's size away counts as at infinity."""
NOISE = 1e-9
"""A quantity below this fraction of the largest of its kind is rounding, and is shown as zero."""


class Drawing(Struct, frozen=True, dict=True):
    """The material of one sheet; ``kind`` is velocity or acceleration, ``trace`` holds drawn steps.

    ``again``: an earlier sheet shows the same mechanism and how it is drawn. ``stand`` is the
    position of the mechanism on all sheets; None where this sheet alone decides. ``curves`` are the
    curves over the whole motion. ``computed`` gives, by symbol, the reason why a quantity is
    computed and not measured. ``driven`` holds driver angles in degrees that differ from the
    scene's.

    ``chosen`` is the sheet that decides where marks have room and which lengths are long enough for
    a mark. At another position of the same scene the choice could be different.

    ``fields`` is the layout of a sheet whose kind lays it out itself.

    ``lengths`` says how sentences give the lengths of vectors laid off: as drawn; as gaps that a
    page fills while its scales are kept; or as nothing, where a page finds them zero.
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
    fields: Any = None
    lengths: Literal["drawn", "open", "none"] = "drawn"

    @property
    def paper(self) -> SheetPaper:
        return paper_of(self.scene.sheet.paper, self.scene.sheet.frame)

    @property
    def choosing(self) -> Drawing:
        """The sheet whose position decides the places of marks."""
        return self.chosen or self

    @property
    def plane(self) -> Plane:
        """The plan that this sheet shows."""
        return PLANES[self.kind]

    @property
    def vector(self) -> MotionQuantity:
        """The quantity that this sheet finds for points: velocity or acceleration."""
        return MOTION[self.kind]

    @property
    def unit(self) -> str:
        """The unit of the vectors of its plan."""
        return self.vector.unit

    @property
    def rate(self) -> MotionQuantity:
        """The quantity that it finds for links: angular velocity or angular acceleration."""
        return RATE[self.kind]

    @property
    def sliding(self) -> MotionQuantity:
        """The quantity that it finds for blocks along their guides: speed or acceleration."""
        return SLIDING[self.kind]

    @property
    def pole(self) -> str:
        """The name of the plan's pole."""
        return "o" if self.kind == "velocity" else "o′"

    def steps(self, *planes: Plane) -> Iterator[tuple[int, Step, Any]]:
        """The executed steps of some planes, in order, with their values."""
        steps = self.trace.program.steps
        for number, value in self.trace.values.items():
            step = steps[number]
            if step.plane in planes:
                yield number, step, value

    @cached_property
    def normals(self) -> tuple[tuple[int, Step], ...]:
        """The executed steps of the triangles on the mechanism."""
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
        """The position of a centre or pole; None at infinity, or too far away to matter."""
        if abs(centre.size) * ENDLESS * self.reach <= abs(centre.shift):
            return None
        return complex(centre.start + centre.shift / centre.size)

    def is_everywhere(self, centre: Ratio) -> bool:
        """Whether every point is a centre or pole, because the link does not move."""
        least = NOISE * (self.largest or 1.0)
        return bool(abs(centre.size) <= least and abs(centre.shift) <= least * self.reach)

    @cached_property
    def standing(self) -> LinkPoses:
        """The poses of the links, guides and wheels."""
        return LinkPoses(self.scene, self.trace)

    @cached_property
    def reach(self) -> float:
        """The largest extent of the mechanism, in metres."""
        box = extent_of([*self.positions.values(), *self.corners()])
        return float(max(box.width, box.height))

    @cached_property
    def grounds(self) -> dict[float, dict[str, tuple[complex, float]]]:
        """The ground symbols of pivots chosen at this position, by scale."""
        return {}

    @property
    def positions(self) -> Mapping[str, complex]:
        """The position of each point of the mechanism, in metres."""
        return self.standing.positions

    def corners(self) -> Iterator[complex]:
        """The corners of wheels, cams and profiles, the contact points and the blocks."""
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
        """The corners of the boxes in which cam profiles turn; for plates, the profile itself."""
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
        """The ends and the extreme points of profiles with stated arcs."""
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
        """A point and the unit vector of the line along which a fixed guide leads a block.

        None for a moving guide.
        """
        along = self.standing.direction(slide) if slide.on == FRAME else None
        if along is None:
            return None
        start = self.standing.carried(FRAME, slide.along[0] if slide.along else slide.through)
        assert start is not None
        return start + 1j * along * float(slide.offset.si(self.scene.values)), along

    @cached_property
    def children(self) -> Mapping[int, tuple[int, ...]]:
        """The executed steps that use each step."""
        found: dict[int, list[int]] = {}
        for number in self.trace.values:
            for arg in self.trace.program.steps[number].args:
                found.setdefault(arg, []).append(number)
        return {number: tuple(users) for number, users in found.items()}

    @cached_property
    def results(self) -> Mapping[int, int]:
        """For the last step of a construction by hand, the composite step that it gives."""
        steps = self.trace.program.steps
        return {
            hand: number
            for number in self.trace.values
            if (hand := steps[number].by_hand) is not None
        }

    def symbol(self, name: str, short: str = "") -> Markup:
        """The symbol of a name with the signs of this sheet."""
        return symbol(name, short, self.words.signs)

    def in_signs(self, markup: str) -> str:
        """Markup written with the usual signs of scale factors and rates, with this sheet's."""
        return self.words.signs.in_sentence(markup)

    def lettered(self, number: int) -> str:
        """The letter of a step, as markup."""
        return self.symbol(self.trace.program.steps[number].name)

    def number_of(self, step: Step) -> int:
        return self.numbers[id(step)]

    @cached_property
    def numbers(self) -> Mapping[int, int]:
        """The number of each step by its identity."""
        return {id(step): number for number, step in enumerate(self.trace.program.steps)}

    @cached_property
    def joins(self) -> Mapping[tuple[int, int], Step]:
        """The arrows of the plans by the points that they join, whether executed or not.

        Where two arrows join the same points, the first one.
        """
        return {
            (step.args[0], step.args[1]): step
            for step in reversed(self.trace.program.steps)
            if step.arrow and step.action is join
        }

    @cached_property
    def feet(self) -> Mapping[int, int]:
        """The component arrows that begin or end at unnamed points of the plan, by that point."""
        found: dict[int, int] = {}
        for number, step, _ in self.steps(self.plane):
            vector = plan_vector(step)
            if vector is not None and vector.foot and step.action is join:
                found.setdefault(step.args[0 if vector.back else 1], number)
        return found

    @cached_property
    def auxiliary(self) -> Mapping[int, PlanAside]:
        """The auxiliary plan of each step that only this auxiliary plan uses."""
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
        """A magnitude of the plan, or zero where it is only rounding."""
        return 0.0 if abs(value) < NOISE * self.natural else value

    @cached_property
    def natural(self) -> float:
        """The natural magnitude of the plan, against which rounding is measured.

        It is the largest vector, or for accelerations also v²/s: v the largest velocity, s the size
        of the mechanism.
        """
        if self.plane is Plane.VELOCITIES:
            return self.largest
        return max(self.largest, self.longest(Plane.VELOCITIES) ** 2 / self.reach)

    @cached_property
    def largest(self) -> float:
        return self.longest(self.plane)

    def longest(self, plane: Plane) -> float:
        """The length of the largest vector of a plan."""
        vectors = (v for _, s, v in self.steps(plane) if s.arrow and isinstance(v, Vector))
        return max((abs(v.tip - v.tail) for v in vectors), default=0.0)

    def turning(self, link: str) -> float | None:
        """The angular velocity or acceleration of a link on this sheet; zero for rounding.

        None where the sheet does not find it.
        """
        value = self.trace.value(self.rate.target, link)
        if value is None:
            return None
        largest = self.fastest
        if self.kind == "acceleration":
            largest = max(largest**2, *map(abs, self.all_of(self.rate.target)))
        return 0.0 if abs(value) < NOISE * largest else float(value)

    def turning_name(self, link: str) -> str:
        """The name of the symbol of what turns a link on this sheet."""
        return f"{self.rate.letter}_{link}"

    def turnings(self, link: str) -> Mapping[str, float]:
        """The rate of a link on this sheet, by the name of its symbol; empty without one."""
        value = self.turning(link)
        return {} if value is None else {self.turning_name(link): value}

    def rate_size(self, number: int, kind: str = "velocity") -> float:
        """The magnitude of an angular velocity or acceleration, by its step; zero for rounding."""
        value = abs(float(self.trace.values[number]))
        largest = self.fastest if kind == "velocity" else self.fastest**2
        return 0.0 if value < NOISE * largest else value

    @cached_property
    def fastest(self) -> float:
        """The largest angular velocity, or the largest velocity over the size of the mechanism."""
        turning = map(abs, self.all_of(RATE["velocity"].target))
        return max(self.longest(Plane.VELOCITIES) / self.reach, *turning)

    def all_of(self, quantity: str) -> list[float]:
        """The values of a quantity on this sheet, for the links that have it, after a zero."""
        targets, values = self.trace.program.targets, self.trace.values
        numbers = (number for (what, _), number in targets.items() if what == quantity)
        return [0.0, *(values[number] for number in numbers if number in values)]

    def length(self, metres: float) -> float:
        """A length in the scene's own unit."""
        return metres / self.scene.unit_length

    def on_paper(self, metres: float) -> OnPaper:
        """The drawn length of a length of the mechanism."""
        return OnPaper(1000 * metres / self.scales.kL)

    def at_scale(self, plane: Plane, value: complex) -> complex:
        """A value of a plan at the mechanism's scale, in metres."""
        if plane is Plane.VELOCITIES:
            return value * self.scales.metres("velocity")
        return value * self.scales.metres("acceleration") if plane is Plane.ACCELERATIONS else value

    def plan_extent(self) -> Extent:
        """The bounding box of the plan at the mechanism's scale."""
        return extent_of(
            [
                self.at_scale(self.plane, point)
                for _, _, value in self.steps(self.plane)
                for point in ends(value)
            ]
        )

    def bare_extent(self) -> Extent:
        """The bounding box of the mechanism and its curves alone."""
        points = [*self.positions.values(), *self.corners()]
        return extent_of([*points, *shown(self.curves, extent_of(points))])

    def mechanism_extent(self) -> Extent:
        """The bounding box of the mechanism and what is drawn on it, without centres and poles."""
        points: list[complex] = []
        for _, step, value in self.on_mechanism:
            if step.part not in (Part.CENTRE, Part.POLE) and takes_room(step, value):
                points += ends(value)
        return self.bare_extent().grown(points)


def takes_room(step: Step, value: Any) -> bool:
    """Whether a value on the mechanism is a vector or a place, not a direction."""
    is_corner = step.of is not None and step.role in step.of.corners
    return bool(step.name) or isinstance(value, Vector) or is_corner


def ends(value: Any) -> tuple[complex, ...]:
    """The points of a drawn value; lines and arcs have none."""
    if isinstance(value, Vector):
        return value.tail, value.tip
    if isinstance(value, Line | Circle | Ratio) or not isinstance(value, complex):
        return ()
    return (value,)


ROOMY = 3.5
"""A curve up to this many times as wide as the mechanism is drawn whole, a wider one in part."""
INWARD = 0.96
"""The fraction of a path for which room is made.

Its ends have no letters, so they may reach into the margin for the letters of the mechanism.
"""
STRAIGHT = 1e-6
"""The largest sideways deviation of a straight curve, as a fraction of its length."""


def shown(curves: Sequence[Curve], mechanism: Extent) -> list[complex]:
    """The points of curves for which the drawing makes room.

    Curves of about the mechanism's size are drawn whole. Of a wider path only the part around the
    mechanism counts. Of a wide or straight centrode only the contact point counts. A locus needs no
    room.
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
    """Whether all points lie on one line."""
    if len(points) < 2:
        return False
    start, far = points[0], max(points, key=lambda point: abs(point - points[0]))
    aside = (abs(cross(far - start, point - start)) for point in points)
    return bool(max(aside) <= STRAIGHT * abs(far - start) ** 2)
