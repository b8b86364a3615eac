"""The effects of the motion in a construction, and the absent ones, by a count of its steps.

Every step is drawn for exactly one effect (``Step.effect``, or the effect of its part). The numbers
of an explanation therefore add up to the steps that the requested quantities need.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import get_args

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.program import OF_PART, Effect, Part, Program, Step, Target
from graphkin.construction.core.quantities import QUANTITIES, names_asked
from graphkin.construction.core.timing import Stopwatch, Timing, one_position, work_of_steps
from graphkin.construction.registry import CAUSES, LIMITED
from graphkin.mechanism import Mechanism
from graphkin.scene.expression import TIME
from graphkin.scene.model import Scene, joined_words

BY_HAND = "by-hand marks"
PENCIL = "pencil"
CERTIFICATION = "certification"
LEVER = "Zhukovsky's lever"
EFFECTS: tuple[Effect, ...] = get_args(Effect)
"""The effects whose steps add up to the requested ones."""
BY_COMMAND = {
    PENCIL: "only `solve --pencil MM` asks what a pencil makes of each step",
    LEVER: "only the sheet of forces draws it, where it checks the balance",
    CERTIFICATION: "only `solve --digits N` asks for digits that are proved",
}
"""Effects that no scene requests: checks, and the same steps on other numbers."""


class EffectRow(Struct, frozen=True):
    """One effect: whether it is present, its steps, the reason, and the cost of the steps.

    ``time`` is None where nothing is run, and before it is measured.
    """

    name: str
    steps: int
    reason: str
    included: bool
    time: Timing | None = None


def effects(mechanism: Mechanism) -> tuple[EffectRow, ...]:
    """All effects of the requests in [ask], then those of drawing by hand or of commands."""
    program, asked = mechanism.program, mechanism.asked()
    counts = Counter(parted(mechanism).values())
    wants, ask = wanted_by(mechanism), mechanism.scene.ask  # centrodes share steps of centres
    rows = [
        EffectRow(
            effect,
            counts[effect],
            reason(mechanism.scene, effect, wants.get(effect, []), asked),
            counts[effect] > 0 or (effect == "centrodes" and bool(ask.centrodes)),
        )
        for effect in EFFECTS
    ]
    by_command = [EffectRow(name, 0, why, False) for name, why in BY_COMMAND.items()]
    return (*rows, by_hand(program, asked), *by_command)


def measured(
    mechanism: Mechanism, watch: Stopwatch, wholes: Sequence[Sequence[Target]]
) -> tuple[tuple[EffectRow, ...], list[Timing]]:
    """The same, each with the time that its steps alone take on this scene; and the times of one
    position, of each whole of targets. All are measured in the same rounds.
    """
    program, asked, values = mechanism.program, mechanism.asked(), mechanism.scene.values
    trace = mechanism.trace(asked, by_hand=True)
    numbers: dict[str, list[int]] = {BY_HAND: hand_steps(program, asked)}
    for number, effect in parted(mechanism).items():
        numbers.setdefault(effect, []).append(number)
    rows = effects(mechanism)
    works = [work_of_steps(trace, numbers[row.name], values) for row in rows if row.steps]
    works += [one_position(program, program.needed(targets), values) for targets in wholes]
    found = watch.times([(work, 1) for work in works])
    left = iter(found)
    timed = tuple(replace(row, time=next(left)) if row.steps else row for row in rows)
    return timed, [*left]


def parted(mechanism: Mechanism) -> dict[int, Effect]:
    """The steps that the requests need, in order, each with the one effect it is drawn for."""
    program, asked = mechanism.program, mechanism.asked()
    found = {number: effect_of(program.steps[number]) for number in program.needed(asked)}
    for number in own_to_centrodes(mechanism.scene, program, asked):
        found[number] = "centrodes"
    return found


def effect_of(step: Step) -> Effect:
    if step.given is not None:
        is_timed = any(TIME in quantity.uses() for quantity in step.given.quantities)
        return "laws of time" if is_timed else "data and shapes"
    return step.effect or OF_PART[step.part]


def own_to_centrodes(scene: Scene, program: Program, asked: tuple[Target, ...]) -> tuple[int, ...]:
    """The steps of centres that only centrodes need."""
    links = set(scene.ask.centrodes) - set(scene.ask.centres)
    others = [target for target in asked if not (target[0] == "centre" and target[1] in links)]
    shared = set(program.needed(others))
    return tuple(
        number
        for number in program.needed(asked)
        if number not in shared and program.steps[number].part is Part.CENTRE
    )


def wanted_by(mechanism: Mechanism) -> Mapping[Effect, list[Target]]:
    """For each effect, the requested targets whose construction contains it."""
    program, whole = mechanism.program, parted(mechanism)
    wants: dict[Effect, list[Target]] = {}
    for target in dict.fromkeys(mechanism.asked()):
        for effect in {whole[number] for number in program.needed([target])}:
            wants.setdefault(effect, []).append(target)
    return wants


def hand_steps(program: Program, asked: Iterable[Target]) -> list[int]:
    """The steps that only the drawing by hand adds."""
    wanted = tuple(asked)
    return sorted(set(program.needed(wanted, by_hand=True)) - set(program.needed(wanted)))


def by_hand(program: Program, asked: tuple[Target, ...]) -> EffectRow:
    """The effect row of drawing by hand: figures, arcs, rays and arrows."""
    extra = len(hand_steps(program, asked))
    if not extra:
        return EffectRow(BY_HAND, 0, "nothing that is asked has a construction to show", False)
    words = f"drawn on the sheets only: {LIMITED}s, arcs, rays and arrows"
    return EffectRow(BY_HAND, extra, words, True)


# --- why -----------------------------------------------------------------------------------------


def reason(scene: Scene, effect: Effect, wants: list[Target], asked: tuple[Target, ...]) -> str:
    """Why an effect is present or absent, in one sentence that names the cause in the scene."""
    if wants:
        cause = cause_of(scene, effect)
        every = len(wants) == len(set(asked))
        needed = "all that is asked" if every else targets_words(wants)
        return f"{cause}; needed for {needed}" if cause else f"needed for {needed}"
    if effect == "centrodes" and scene.ask.centrodes:
        return "the centres that are asked anyway, followed over the motion"
    return absence_of(scene, effect) or f"{targets_words(asked)} can be found without"


def targets_words(targets: Sequence[Target]) -> str:
    """Targets in words, grouped by quantity: velocity of D; pole of 3, 4."""
    of: dict[str, list[str]] = {}
    for quantity, name in dict.fromkeys(targets):
        of.setdefault(quantity, []).append(name)
    return "; ".join(f"{quantity} of {', '.join(names)}" for quantity, names in of.items())


def cause_of(scene: Scene, effect: Effect) -> str:
    """The cause of an effect in the scene; empty where only a request is the cause."""
    match effect:
        case "laws of time":
            return f"{drivers_words(timed_drivers(scene))} a law of time"
        case "driver acceleration":
            return f"{drivers_words(accelerated_drivers(scene))} an acceleration"
        case "tangential components":
            return "links that no driver turns at a given rate speed up or slow down"
        case "data and shapes":
            return "numbers that the scene states, and the shapes of its links"
        case "loads":
            return f"{masses_words(scene)}-m·a and -J·ε are loads too (d'Alembert)"
        case "reactions and balance":
            return "moments and polygons of the groups, from the last to the first"
        case "centrodes":
            return "the centres of a whole motion, which only the sheet and the cycle follow"
    return next((kind.cause(scene) for kind in CAUSES if kind.effect == effect), "")


def absence_of(scene: Scene, effect: Effect) -> str:
    """The cause in the scene of an effect's absence; empty where only missing requests are."""
    match effect:
        case "laws of time" if not timed_drivers(scene):
            return "no driver is written in t"
        case "driver acceleration" if not accelerated_drivers(scene):
            return "every driver has a constant speed"
        case "instantaneous centres" if not centres_asked(scene, "velocity"):
            return "[ask] names no centres"
        case "centrodes" if not scene.ask.centrodes:
            return "[ask] names no centrodes"
        case "loads" | "reactions and balance":
            return forces_absent(scene)
        case "acceleration poles" if not centres_asked(scene, "acceleration"):
            return "[ask] names no poles"
    return next((kind.absence(scene) for kind in CAUSES if kind.effect == effect), "")


def masses_words(scene: Scene) -> str:
    """The links with masses, before what follows from them; empty without one."""
    forces = scene.forces
    links = [] if forces is None else [k for k, e in forces.masses.items() if not e.mass.is_zero()]
    return f"{joined_words(links)} have masses, so that " if links else "given loads; "


def forces_absent(scene: Scene) -> str:
    """Why no force is constructed."""
    if scene.forces is None:
        return "the scene states no masses and no loads"
    if not scene.forces.asked:
        return "[ask] names no reactions and no balance"
    return "a group has no construction of forces: all equations of equilibrium give them"


def centres_asked(scene: Scene, kind: str) -> bool:
    """Whether centres found by velocities, or by accelerations, are requested."""
    found = (each for each in QUANTITIES if each.sort == "centre" and each.kind == kind)
    return bool(names_asked(scene.ask, *found))


def drivers_words(numbers: list[int]) -> str:
    """ "Driver 1 has" or "drivers 1, 2 have", counted from one in written order."""
    return f"driver{'s' if len(numbers) > 1 else ''} {', '.join(map(str, numbers))} " + (
        "have" if len(numbers) > 1 else "has"
    )


def timed_drivers(scene: Scene) -> list[int]:
    """The numbers of drivers whose position is a function of t."""
    return [i for i, driver in enumerate(scene.drivers, 1) if TIME in driver.position.uses()]


def accelerated_drivers(scene: Scene) -> list[int]:
    """The numbers of drivers with an acceleration."""
    return [i for i, driver in enumerate(scene.drivers, 1) if not driver.acceleration.is_zero()]
