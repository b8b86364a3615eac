"""Which effects of the motion are in a construction and which are out, by counting its steps.

Every step of the program belongs to exactly one effect, so that the numbers of an explanation add
up to the steps that what is asked needs.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.mechanism import Mechanism
from graphkin.scene.expression import TIME
from graphkin.scene.model import FRAME, Scene
from graphkin.steps.program import Part, Program, Step, Target
from graphkin.structure.graph import turns

BY_HAND = "by-hand marks"
OF_PART = {
    Part.SHAPE: "data and shapes",
    Part.POSITION: "position",
    Part.VELOCITY: "velocity",
    Part.NORMAL: "normal components",
    Part.ACCELERATION: "acceleration",
    Part.CENTRE: "instantaneous centres",
    Part.POLE: "acceleration poles",
    Part.RESULT: "results",
}
NAMES = (
    "laws of time",
    "data and shapes",
    "position",
    "rolling and gears",
    "velocity",
    "acceleration",
    "driver acceleration",
    "normal components",
    "tangential components",
    "Coriolis",
    "instantaneous centres",
    "acceleration poles",
    "results",
)
WHEELS = ("roll", "wheel", "gear", "mesh", "contact")
NORMALS = ("centripetal", "lay-off")


@dataclass(frozen=True, slots=True)
class Effect:
    """One effect: how many steps it costs, and the sentence that says why it is in or out."""

    name: str
    steps: int
    reason: str

    @property
    def included(self) -> bool:
        """True when the construction has steps of it."""
        return self.steps > 0


def effects(mechanism: Mechanism) -> tuple[Effect, ...]:
    """All effects of what [ask] asks, and last the marks that only a hand's drawing adds."""
    program, asked = mechanism.program, mechanism.asked()
    counts = Counter(effect_of(program.steps[number]) for number in program.needed(asked))
    wants = wanted_by(program, asked)
    found = [
        Effect(name, counts[name], reason(mechanism.scene, name, wants.get(name, []), asked))
        for name in NAMES
    ]
    return (*found, by_hand(program, asked))


def effect_of(step: Step) -> str:
    """The one effect that a step belongs to."""
    if step.given is not None:
        timed = any(TIME in quantity.uses() for quantity in step.given.quantities)
        return "laws of time" if timed else "data and shapes"
    key = step.action.key if step.action is not None else ""
    if "coriolis" in key:
        return "Coriolis"
    if any(word in key for word in WHEELS):
        return "rolling and gears"
    if key == "driven-tangential":
        return "driver acceleration"
    if step.part is Part.ACCELERATION and key in NORMALS:
        return "normal components"
    if step.part is Part.ACCELERATION and key == "square-to":
        return "tangential components"
    return OF_PART.get(step.part, "results")


def wanted_by(program: Program, asked: tuple[Target, ...]) -> Mapping[str, list[Target]]:
    """For each effect the targets whose own construction contains it."""
    wants: dict[str, list[Target]] = {}
    for target in asked:
        inside = {effect_of(program.steps[number]) for number in program.needed([target])}
        for name in inside:
            wants.setdefault(name, []).append(target)
    return wants


def by_hand(program: Program, asked: tuple[Target, ...]) -> Effect:
    """The steps that only the drawing by hand adds: right triangles, arcs, rays and arrows."""
    extra = len(program.needed(asked, by_hand=True)) - len(program.needed(asked))
    if not extra:
        return Effect(BY_HAND, 0, "nothing that is asked has a construction to show")
    return Effect(
        BY_HAND, extra, "drawn on the sheets only: right triangles, arcs, rays and arrows"
    )


def reason(scene: Scene, name: str, wants: list[Target], asked: tuple[Target, ...]) -> str:
    """Why an effect is in or out, in one sentence that names what in the scene decides it."""
    cause = cause_of(scene, name)
    if wants:
        needed = "all that is asked" if len(wants) == len(asked) else targets_words(wants)
        return f"{cause}; needed for {needed}" if cause else f"needed for {needed}"
    if not asked:
        return "[ask] asks for nothing"
    return absence_of(scene, name) or f"{targets_words(list(asked))} can be found without"


def targets_words(targets: list[Target]) -> str:
    """Targets in words, those of one quantity together: velocity of D; pole of 3, 4."""
    of: dict[str, list[str]] = {}
    for quantity, name in targets:
        of.setdefault(quantity, []).append(name)
    return "; ".join(f"{quantity} of {', '.join(names)}" for quantity, names in of.items())


def cause_of(scene: Scene, name: str) -> str:
    """What in the scene brings an effect in; empty where only what is asked does."""
    match name:
        case "laws of time":
            return f"{drivers_words(timed_drivers(scene))} a law of time"
        case "rolling and gears":
            return f"wheels roll: {', '.join(rolling_links(scene))}"
        case "driver acceleration":
            return f"{drivers_words(accelerated_drivers(scene))} an acceleration"
        case "Coriolis":
            return f"the guide of {', '.join(moving_guides(scene))} turns with its link"
        case "normal components":
            return "points that move about others need a normal component"
        case "tangential components":
            return "links that a driver does not turn speed up or slow down"
        case "data and shapes":
            return "numbers that the scene states, and the shapes of its links"
    return ""


def absence_of(scene: Scene, name: str) -> str:
    """What in the scene keeps an effect out; empty where only what is asked does."""
    match name:
        case "laws of time":
            return "" if timed_drivers(scene) else "no driver is written in t"
        case "rolling and gears":
            return "" if rolling_links(scene) else "no link rolls"
        case "driver acceleration":
            constant = "every driver has a constant speed"
            return "" if accelerated_drivers(scene) else constant
        case "Coriolis":
            return "" if moving_guides(scene) else no_moving_guide(scene)
        case "instantaneous centres":
            return "" if scene.ask.centres or scene.ask.pairs else "[ask] names no centres"
        case "acceleration poles":
            return "" if scene.ask.poles or scene.ask.inflection else "[ask] names no poles"
    return ""


def drivers_words(numbers: list[int]) -> str:
    """Driver 1 has, or drivers 1, 2 have, counted from one as they are written."""
    return f"driver{'s' if len(numbers) > 1 else ''} {', '.join(map(str, numbers))} " + (
        "have" if len(numbers) > 1 else "has"
    )


def timed_drivers(scene: Scene) -> list[int]:
    """Drivers whose position is written in t."""
    return [i for i, driver in enumerate(scene.drivers, 1) if TIME in driver.position.uses()]


def accelerated_drivers(scene: Scene) -> list[int]:
    """Drivers that do not run at constant speed."""
    return [i for i, driver in enumerate(scene.drivers, 1) if not driver.acceleration.is_zero()]


def rolling_links(scene: Scene) -> list[str]:
    """Links that roll on another."""
    return [link.name for link in scene.links.values() if link.rolls]


def moving_guides(scene: Scene) -> list[str]:
    """Blocks whose guide is on a link that turns."""
    return [
        link.name
        for link in scene.links.values()
        if any(slide.on != FRAME and turns(scene, slide.on) for slide in link.slides)
    ]


def no_moving_guide(scene: Scene) -> str:
    """Why nothing slides on a moving link."""
    fixed = [link.name for link in scene.links.values() if link.slides]
    if not fixed:
        return "no link slides"
    return f"the guide of {', '.join(fixed)} does not turn"
