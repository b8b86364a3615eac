"""What is handed out: the sheets of a mechanism, each one proved right before it is drawn."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from graphkin.errors import Problem, SceneError, WitnessError
from graphkin.mechanism import Mechanism
from graphkin.paper.areas import HEIGHT, WIDTH
from graphkin.paper.drawing import Drawing
from graphkin.paper.scale import Scales, extent_of, fitting_scale, kept_scale, preferred
from graphkin.steps.program import Target
from graphkin.steps.solution import FAIR, Solution, Verdict
from graphkin.text import LANGUAGES, Words, words

if TYPE_CHECKING:
    from graphkin.paper.marks import Page

WANTED = {
    "velocity": ("velocity", "omega", "centre"),
    "acceleration": ("acceleration", "epsilon", "pole"),
}
"""The sheet on which each quantity is asked."""


@dataclass(frozen=True)
class Sheet:
    """The pages of one document: velocity, acceleration or calculation."""

    kind: str
    pages: tuple[Page, ...]


def hand_out(mechanism: Mechanism, view: str = "key", language: str | None = None) -> list[Sheet]:
    """The sheets that a scene asks for, in a language (the scene's own if None).

    Raises WitnessError when the independent route disagrees, PageError when a page does not fit.
    """
    from graphkin.paper.calculation import calculation
    from graphkin.paper.sheet import sheet

    spoken = language_of(mechanism, language)
    if mechanism.scene.sheet.sheets != len(WANTED):
        raise SceneError(
            Problem("sheet.sheets", "one sheet for both plans is not drawn yet", "2, or left out")
        )
    verdict = proved(mechanism, mechanism.solve())
    drawings = drawings_of(mechanism, verdict, spoken)
    total = len(drawings)
    sheets = [
        Sheet(drawing.kind, (sheet(drawing, view, f"{i}/{total}"),))
        for i, drawing in enumerate(drawings, 1)
    ]
    return [*sheets, Sheet("calculation", calculation(drawings, view))]


def language_of(mechanism: Mechanism, language: str | None) -> Words:
    """The words of a language. Raises SceneError for one that is not there."""
    code = language or mechanism.scene.sheet.language
    if code not in LANGUAGES:
        raise SceneError(
            Problem("sheet.language", f'"{code}" is not a language', " or ".join(LANGUAGES))
        )
    return words(code)


def proved(mechanism: Mechanism, solution: Solution) -> Verdict:
    """The witness's verdict. Raises WitnessError when it does not agree, or cannot be trusted."""
    if solution.margin < FAIR:
        raise WitnessError(
            Problem(
                "position",
                f"the flattest crossing has a sine of {solution.margin:.1e}",
                f"at least {FAIR:g}",
                "the position is nearly singular: choose another driver angle",
            )
        )
    verdict = mechanism.witness(solution)
    if not verdict.agrees:
        raise WitnessError(
            Problem(
                verdict.quantity,
                f"construction and vector loops differ by {verdict.largest_difference:.1e}",
                f"at most {verdict.limit:.1e}",
                "; ".join(verdict.branches) or "no sheet is handed out",
            )
        )
    return verdict


def drawings_of(mechanism: Mechanism, verdict: Verdict, spoken: Words) -> list[Drawing]:
    """The material of each sheet, all at the same scale."""
    chosen = scales(mechanism)
    drawings = [
        drawing(mechanism, kind, found, chosen, verdict, spoken)
        for kind in WANTED
        if (found := targets_of(mechanism, kind))
    ]
    drawings[1:] = [replace(later, again=True) for later in drawings[1:]]
    if not drawings:
        raise SceneError(
            Problem("ask", "asks for nothing that is drawn", "velocities, accelerations, centres …")
        )
    return drawings


def targets_of(mechanism: Mechanism, kind: str) -> tuple[Target, ...]:
    """What is asked on one sheet, with the whole mechanism; nothing when nothing is asked."""
    asked = [target for target in mechanism.asked() if target[0] in WANTED[kind]]
    if not asked:
        return ()
    positions = [target for target in mechanism.program.targets if target[0] == "position"]
    return (*positions, *asked)


def scales(mechanism: Mechanism) -> Scales:
    """The one set of scale factors at which every sheet's drawings fit their fields."""
    crank = the_crank(mechanism)
    seconds = 1 / crank if crank else natural_seconds(mechanism)
    nobody = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    needs = []
    asked = {kind: targets_of(mechanism, kind) for kind in WANTED}
    if not any(asked.values()):
        asked = {kind: tuple(mechanism.program.targets) for kind in WANTED}
    for kind, found in asked.items():
        if found:
            trial = drawing(mechanism, kind, found, Scales(1.0, seconds), nobody, words("en"))
            needs.append((trial.mechanism_extent(), trial.plan_extent()))
    kL = fitting_scale(needs, WIDTH, HEIGHT)
    if mechanism.scene.sheet.scale is not None:
        kL = kept_scale(float(mechanism.scene.sheet.scale.number(mechanism.scene.values)), kL)
    if crank:
        return Scales(kL, seconds)
    return Scales(kL, kL / next(preferred(kL / seconds)), from_driver=False)


def the_crank(mechanism: Mechanism) -> float:
    """Speed in rad/s of the one crank that drives alone; 0 where there is none or it stands."""
    drivers = mechanism.scene.drivers
    if len(drivers) != 1 or drivers[0].kind != "turn":
        return 0.0
    return abs(float(drivers[0].speed.si(mechanism.scene.values)))


def natural_seconds(mechanism: Mechanism) -> float:
    """kL/kv that draws the plans about as large as the mechanism, where no crank says it."""
    points = mechanism.solve().points.values()
    places = extent_of([complex(point.position) for point in points if point.position is not None])
    size = max(places.width, places.height)
    fastest = max((abs(point.velocity or 0) for point in points), default=0.0)
    hardest = max((abs(point.acceleration or 0) for point in points), default=0.0)
    slowest = max(fastest / size, (hardest / size) ** 0.5)
    return 1 / slowest if slowest else 1.0


def drawing(
    mechanism: Mechanism,
    kind: str,
    targets: tuple[Target, ...],
    scales: Scales,
    verdict: Verdict,
    spoken: Words,
) -> Drawing:
    """The material of one sheet: everything a hand draws for it."""
    trace = mechanism.trace(targets, by_hand=True, seconds=scales.seconds)
    return Drawing(kind, mechanism.scene, trace, scales, verdict, spoken)
