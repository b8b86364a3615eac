"""The pen: writes the steps of a program one by one and keeps which step holds each quantity.

The arrows of the plans: absolute and relative velocities, absolute accelerations.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.bases import Base
from graphkin.construction.core.branches import block_of, side_of, way_of
from graphkin.construction.core.kind import PlanPole
from graphkin.construction.core.program import (
    Drive,
    Effect,
    Given,
    Part,
    PlanAside,
    Plane,
    PlanVector,
    Program,
    Roles,
    Step,
    Target,
    foot_of,
)
from graphkin.construction.core.quantities import TURNING
from graphkin.construction.core.run import StepFailed, evaluate
from graphkin.construction.core.vocabulary import Action, join, pole
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.link_points import ends_of, lettered, under
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.scene.wheels import angle_less_cycles
from graphkin.structure.groups import Dyad
from graphkin.structure.pairs import Sliding, SlippingName, is_in_scene
from graphkin.structure.turning import together
from graphkin.structure.wheel_groups import counted_near
from graphkin.text.errors import ClosureError

R = TypeVar("R", bound=Roles)

PRIME = "\N{PRIME}"


class Pen:
    """Writes a program: every call adds one step and returns its number."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.steps: list[Step] = []
        self.targets: dict[Target, int] = {}
        self.bases: dict[str, Base] = {}
        self.leads: dict[str, str] = {}
        self.arrows: set[str] = set()
        self.chosen: dict[tuple[str, str], int] = {}
        self.drives: dict[int, Drive] = {}
        self.shifting = together(scene, FRAME)
        self.near = counted_near(scene)
        self.counted: set[str] = set()
        self.scale_step: int | None = None
        self.shared: dict[tuple[Any, ...], int] = {}
        self.placed: dict[str, dict[str, int]] = {}
        self.peeked: dict[int, Any] = {}
        self.layers: list[dict[Target, int]] = []
        self.tried: list[dict[Target, int]] = []
        self.auxiliary: PlanAside | None = None
        self.part, self.plane, self.hand = Part.SHAPE, Plane.NUMBERS, False
        self.effect: Effect | None = None

    @classmethod
    def resumed(cls, scene: Scene, program: Program) -> Pen:
        """A pen that writes after the steps of a program of the same scene."""
        pen = cls(scene)
        pen.steps, pen.targets = [*program.steps], {**program.targets}
        pen.scale_step = program.seconds
        pen.drives = {drive.driver: drive for drive in program.drives}
        poles = (n for n, step in enumerate(pen.steps) if isinstance(step.of, PlanPole))
        pen.shared = {("pole", pen.steps[n].plane): n for n in poles}
        return pen

    @contextmanager
    def on(self, part: Part, plane: Plane) -> Iterator[None]:
        """Write steps for one part of the work, in one drawing."""
        before = self.part, self.plane
        self.part, self.plane = part, plane
        yield
        self.part, self.plane = before

    @contextmanager
    def calls_for(self, effect: Effect | None) -> Iterator[None]:
        """Write steps for an effect of the motion; with None the part of the work decides."""
        before, self.effect = self.effect, effect
        yield
        self.effect = before

    @contextmanager
    def hands_way(self) -> Iterator[None]:
        """Write steps that only the construction by hand of a composite step needs."""
        before, self.hand = self.hand, True
        yield
        self.hand = before

    @contextmanager
    def aside(self, plan: PlanAside) -> Iterator[dict[Target, int]]:
        """Write steps of an auxiliary plan: its points get a tag, its quantities are kept apart.

        An auxiliary plan inside another one can use the quantities of the outer plan.
        """
        before, self.auxiliary = self.auxiliary, plan
        self.layers.append({})
        yield self.layers[-1]
        self.layers.pop()
        self.auxiliary = before

    def draw(
        self,
        action: Action,
        *args: int,
        name: str = "",
        extra: tuple[float, ...] = (),
        by_hand: int | None = None,
    ) -> int:
        """Add a step that follows from earlier ones."""
        aside = self.auxiliary if self.plane in (Plane.VELOCITIES, Plane.ACCELERATIONS) else None
        if name and aside is not None:
            name += aside.tag
        return self._add(
            Step(
                action,
                args,
                self.part,
                self.plane,
                name,
                extra,
                None,
                by_hand,
                self.hand,
                effect=self.effect,
                aside=aside,
            )
        )

    def make(self, construction: R) -> R:
        """Mark written steps as parts of a construction, each in its role."""
        for role, number in construction.given():
            self.steps[number] = replace(self.steps[number], of=construction, role=role)
        return construction

    def draw_shared(self, key: tuple[Any, ...], action: Action, *args: int, **more: Any) -> int:
        """Add a step unless one with this key exists already."""
        if key not in self.shared:
            self.shared[key] = self.draw(action, *args, **more)
        return self.shared[key]

    def choice(self, dyad: Dyad) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """The crossing that a dyad takes: the step that holds the sign, or the stated sign.

        The sign is reversed where the link with the guide moves against a known block.
        """
        if dyad.links in self.chosen:
            return (self.chosen[dyad.links],), ()
        if dyad.type == "RRR":
            return (), (side_of(self.scene, dyad),)
        stays = dyad.type == "RRP" and block_of(dyad) not in dyad.links
        return (), (-way_of(self.scene, dyad) if stays else way_of(self.scene, dyad),)

    def arrow(self, action: Action, *args: int, name: str) -> int:
        """Add an arrow: drawn where its ends are, used by no other step, in no auxiliary plan."""
        if self.layers:
            return -1
        self.arrows.add(name)
        return self._add(Step(action, args, self.part, self.plane, name, hand=True, arrow=True))

    def vector(self, action: Action, *args: int, of: PlanVector, name: str = "") -> None:
        """Add the arrow of a vector, under its own symbol unless ``name`` is given."""
        number = self.arrow(action, *args, name=name or of.symbol)
        if number >= 0:
            self.make(replace(of, arrow=number))

    def given(
        self, form: str, *quantities: Any, name: str = "", of: int | str | None = None
    ) -> int:
        """Add a value that the scene states; the same value of one thing is added only once."""
        key = (form, quantities, name, self.plane, of)
        if key not in self.shared:
            given = Given(form, quantities)
            plane = self.plane if form == "point" else Plane.NUMBERS
            step = Step(None, (), self.part, plane, name, (), given)
            self.shared[key] = self._add(step)
        return self.shared[key]

    def _add(self, step: Step) -> int:
        self.steps.append(step)
        return len(self.steps) - 1

    def want(self, quantity: str, of: str, number: int) -> int:
        """Record which step holds a quantity of a point or link."""
        where = self.layers[-1] if self.layers else self.targets
        where[quantity, of] = number
        return number

    def has(self, quantity: str, of: str) -> bool:
        """Whether a quantity has been constructed."""
        return any((quantity, of) in known for known in (self.targets, *self.layers))

    def the(self, quantity: str, of: str) -> int:
        """The step that holds a quantity of a point or link."""
        for layer in reversed(self.layers):
            if (quantity, of) in layer:
                return layer[quantity, of]
        return self.targets[quantity, of]

    def both(self, quantity: str, p: str, q: str) -> tuple[int, int]:
        """The steps that hold a quantity of two points or links."""
        return self.the(quantity, p), self.the(quantity, q)

    def is_zero(self, number: int) -> bool:
        """Whether a step holds a given rate that is zero for all parameters."""
        given = self.steps[number].given
        quantities = given.quantities if given is not None else ()
        return bool(quantities) and all(quantity.is_zero() for quantity in quantities)

    def pole(self, plane: Plane) -> int:
        """The pole of a plan: o for velocities, o′ for accelerations."""
        key = ("pole", plane)
        if key not in self.shared:
            name = "o" if plane is Plane.VELOCITIES else "o" + PRIME
            part = Part.VELOCITY if plane is Plane.VELOCITIES else Part.ACCELERATION
            self.shared[key] = self._add(Step(pole, (), part, plane, name))
            self.make(PlanPole(pole=self.shared[key]))
        return self.shared[key]

    def turns(self, link: str) -> bool:
        """Whether a link can rotate: False for the frame and links joined to it by slides alone."""
        return link not in self.shifting

    def drive(self, driver: Driver) -> Drive:
        """The given motion of a driver."""
        number = self.scene.drivers.index(driver)
        if number not in self.drives:
            turning = driver.kind == "turn"
            form = "direction" if turning else "length"
            with self.on(Part.SHAPE, Plane.NUMBERS):
                names = ("phi", *TURNING) if turning else ("s", "v", "a")
                position, speed, acceleration = (
                    self.given(form, driver.position, name=names[0], of=number),
                    self.given("number", driver.speed, name=names[1], of=number),
                    self.given("number", driver.acceleration, name=names[2], of=number),
                )
            self.drives[number] = self.make(Drive(number, position, speed, acceleration))
        return self.drives[number]

    def driven_angle(self, driver: Driver) -> int:
        """The angle of a turning driver in radians, with whole turns."""
        drive, number = self.drive(driver), self.scene.drivers.index(driver)
        if drive.angle is None:
            with self.on(Part.SHAPE, Plane.NUMBERS):
                angle = self.given(
                    "number", angle_less_cycles(self.scene, driver), name="angle", of=number
                )
            self.drives[number] = self.make(replace(drive, angle=angle))
            return angle
        return drive.angle

    def turner(self, link: str) -> str | None:
        """The link whose two points give the rotation of a link; None where there is none."""
        while link in self.bases and self.bases[link].end is None and link in self.leads:
            link = self.leads[link]
        return link if link in self.bases and self.bases[link].end is not None else None

    def first_slide(self, block: str) -> Sliding:
        """The first guide of a block."""
        slide = self.scene.links[block].slides[0]
        return Sliding(slide, (block, slide.on))

    def seconds(self) -> int:
        """kL/kv, the factor that sets velocities on the mechanism; 1/omega with a single crank."""
        turning = [driver for driver in self.scene.drivers if driver.kind == "turn"]
        with self.on(Part.SHAPE, Plane.NUMBERS):
            if len(turning) == len(self.scene.drivers) == 1:
                number = self.given("seconds", turning[0].speed)
            else:
                number = self.given("one")
        self.scale_step = number
        return number

    def peek(self, number: int) -> Any:
        """The value of a step at the scene's own values, for choices that depend on the shape.

        None where the mechanism does not close there.
        """
        waiting, wanted = [number], set[int]()
        while waiting:
            step = waiting.pop()
            if step not in wanted and step not in self.peeked:
                wanted.add(step)
                waiting += self.steps[step].args
        if any(is_input(self.steps[step]) for step in wanted):
            return None
        for step in sorted(wanted):
            try:
                self.peeked[step] = evaluate(
                    self.steps[step], step, self.peeked, self.scene.values, FLOAT, {}
                )
            except (StepFailed, ClosureError):
                return None
        return self.peeked[number]

    def program(self) -> Program:
        """The program of all steps written so far."""
        drives = tuple(self.drives[number] for number in sorted(self.drives))
        return Program(tuple(self.steps), dict(self.targets), self.scale_step, drives)


def is_input(step: Step) -> bool:
    """Whether the value of a step comes from outside the program."""
    return step.given is not None and step.given.form == "input"


class ImageName(Struct, frozen=True):
    """The name of an image: small letter with primes, index of the point, and ``link`` if written.

    ``apart`` marks a name that would clash with a point or the pole: it gets an extra index.
    """

    small: str
    index: str
    apart: bool
    link: str

    def __str__(self) -> str:
        """The image name as the name of a step."""
        return "_".join(
            filter(None, (self.small, self.index, "v" if self.apart else "", self.link))
        )


def image_name(point: str, prime: str = "") -> ImageName:
    """The name of a point's image.

    It is the small letter of the point: a_3 for A@3, with a ``prime`` in the acceleration plan. Two
    points in contact share one image in the velocity plan, unless the point's name says that they
    slip.
    """
    name, link = ends_of(point)
    own = is_in_scene(point) or isinstance(point, SlippingName)
    small, _, index = name.lower().partition("_")
    apart = name == name.lower() or (name.lower() == "o" and not (link and own))
    alone = prime and not is_in_scene(point) and not (index or apart)
    return ImageName(small + prime, index, apart, link if own or alone else "")


def image(point: str) -> str:
    """The name of a point's image in the velocity plan."""
    return str(image_name(point))


def second_image(point: str) -> str:
    """The name of a point's image in the acceleration plan."""
    return str(image_name(point, PRIME))


def letter(point: str) -> str:
    """A point in the index of a velocity or in a bar; a contact point is named without its link."""
    return lettered(point) if is_in_scene(point) else ends_of(point)[0]


def about(pen: Pen, pin: str, pivot: str) -> str:
    """The index of a relative acceleration: BA for B about A, B alone about a fixed pivot."""
    fixed = pivot in pen.scene.frame.points
    return lettered(pin) if fixed else lettered(pin) + lettered(pivot)


def against(pen: Pen, pin: str, pivot: str) -> str:
    """The index of a relative velocity; B alone about a fixed point or a contact at rest."""
    rests = pen.the("velocity", pivot) == pen.pole(Plane.VELOCITIES)
    fixed = pivot in pen.scene.frame.points or (not is_in_scene(pivot) and rests)
    return letter(pin) if fixed else letter(pin) + letter(pivot)


def step_name(pen: Pen, number: int) -> str:
    """The name of a step, which is also the name of its point in the plan."""
    return pen.steps[number].name


def velocity_arrows(pen: Pen, pin: str, pivot: str | None) -> None:
    """Draw the absolute velocity of a pin, and its velocity relative to a pivot if one is given."""
    arrow_between(pen, pen.pole(Plane.VELOCITIES), pen.the("velocity", pin), pin, "")
    if pivot is not None:
        relative_arrow(pen, pin, pivot)


def relative_arrow(pen: Pen, pin: str, pivot: str) -> None:
    """Draw the velocity of a pin relative to a pivot.

    Draws nothing where either velocity is zero or the two velocities are equal.
    """
    start, tip = pen.the("velocity", pivot), pen.the("velocity", pin)
    if start == tip or pen.pole(Plane.VELOCITIES) in (start, tip):
        return
    if pivot == ends_of(pin)[0]:
        arrow_between(pen, tip, start, pivot, letter(pin))
    else:
        arrow_between(pen, start, tip, pin, letter(pivot))


def arrow_between(pen: Pen, tail: int, tip: int, pin: str, about: str) -> None:
    """Draw the velocity of a point, relative to ``about`` if one is given, unless already drawn."""
    if not has_arrow(pen, tail, tip):
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            vector = PlanVector("v", letter(pin) + about, letter(pin), about)
            pen.vector(join, tail, tip, of=vector, name=arrow_name(pen, tail, tip))


def has_arrow(pen: Pen, tail: int, tip: int) -> bool:
    """Whether the plan already has an arrow between two of its points."""
    return arrow_name(pen, tail, tip) in pen.arrows


def arrow_name(pen: Pen, tail: int, tip: int) -> str:
    """The letters of both ends of an arrow."""
    return step_name(pen, tail) + step_name(pen, tip)


def acceleration_arrow(pen: Pen, pin: str) -> None:
    """Draw the absolute acceleration of a pin, from the pole to its image, unless already drawn."""
    o, tip = pen.pole(Plane.ACCELERATIONS), pen.the("acceleration", pin)
    name = f"o{PRIME}{second_image(pin)}"
    if name not in pen.arrows:
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            vector = PlanVector("a", lettered(pin), lettered(pin))
            pen.vector(join, o, tip, of=vector, name=name)


def component_arrow(pen: Pen, tail: int, tip: int, kind: str, pin: str, pivot: str) -> None:
    """Draw the normal (ν) or tangential (τ) component of a relative acceleration."""
    index = about(pen, pin, pivot)
    foot = "" if pen.steps[tip].name else foot_of(kind, index)
    vector = PlanVector("a", index, lettered(pin), lettered(pivot), kind, foot=foot)
    pen.vector(join, tail, tip, of=vector)


def slide_arrow(pen: Pen, tail: int, tip: int, link: str, point: str, *, index: str = "") -> None:
    """Draw a relative acceleration along a moving guide.

    By default this is the acceleration of the point relative to the point of the link under it;
    ``index`` names another one.
    """
    if link == FRAME:
        return
    index = index or letter(point) + letter(under(point, link))
    vector = PlanVector("a", index, point, sign="r")
    if vector.symbol not in pen.arrows:
        pen.vector(join, tail, tip, of=vector)
