"""Every kind of construction has all of it: a scene, value, drawn way, and no face that is idle.

A kind is found by its class and has to be drawn by one of the scenes; a face of a kind that can be
taken away without anything changing is one that nobody looks at.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache, partial
from itertools import product
from pathlib import Path

import pytest

import graphkin.construction
from graphkin.accuracy.pencil import Pencil, forecast, original
from graphkin.cli.report.pencil_report import pencil_lines, step_words
from graphkin.cli.report.solution_record import place_words
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, Sentence
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.program import Step
from graphkin.construction.core.solution import Verdict
from graphkin.construction.forces.force_drawing import ForceDrawing
from graphkin.documents.force_fields import with_force_plan
from graphkin.documents.relations import relations
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import left_board, right_board, sheet
from graphkin.documents.sheet_documents import drawings_of, proved, with_forces
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.kinds import ball_kind
from graphkin.text import words
from graphkin.web.protocol import of_sentence, parted_sentences, reasons, telling
from graphkin.web.screen_sheets import screen_sheets
from graphkin.web.step_page import force_sheet
from graphkin.web.your_turn import record as turn_record
from graphkin.web.your_turn import your_turn
from tests.chosen import CHOSEN, EVERY, FOLDER
from tests.documents.test_words import RARE, rare

LABS = ("pump", "slotted-lever")
MORE = ("belts-arm", "cam-plate", "oscillating-slide", "rapid-return", "stephenson-2-binary")
"""Scenes that draw what those do not that stand for all."""
SPARED = (
    *("bar-on-roller", "belts-arm", "block on a lever with its centre", "crank-slot"),
    *("block-with-a-second-point-two-cranks", "crank-with-its-own-axes", "excavator-relative"),
    *("five-bar with all its centres", "flat-plate-poles", "four-bar with all its centres"),
    *("four-bar at rest with all its centres", "four-bar with enlarge = 1.5"),
    *("four-bar with ka = 0.4", "frame-point-given-by-distance-and-angle"),
    *("gears-three-planets", "jumper", "link-given-by-a-distance-and-an-angle"),
    *("pinion-driven-by-a-rack", "pump", "rapid-return-whose-upper-guide-turns", "six-bar"),
    *("slotted-lever", "stephenson-2-ternary", "too-short-to-be-drawn"),
)
"""Those that draw nothing by which a face shows that no smaller scene has."""
TESTS = Path(__file__).parents[1]
OWN = {
    f"{path.stem} with forces" if path.parent.name == "forces" else path.stem: path
    for path in (
        TESTS / "motion" / "scenes" / "planet-on-coupler.toml",
        TESTS / "scenes" / "construction" / "coupler-point-curvature.toml",
        TESTS / "scenes" / "construction" / "wheels-that-speed-up.toml",
        TESTS / "scenes" / "forces" / "class-three.toml",
        TESTS / "scenes" / "forces" / "gas-engine.toml",
        TESTS / "scenes" / "forces" / "gears.toml",
        TESTS / "scenes" / "forces" / "rack.toml",
        TESTS / "scenes" / "forces" / "ram.toml",
        TESTS / "scenes" / "forces" / "shaper.toml",
        TESTS / "scenes" / "structure" / "pins" / "rod-in-two-bushings.toml",
        TESTS / "scenes" / "structure" / "plate-on-parallel-bars.toml",
    )
}
"""Scenes of tests that draw what no example does."""
MARKING = {"slips", "sizes", "power_of", "as_measured", "proportions"}
"""Faces that only labs and marking look at: tests/classroom holds them."""
FAILING = {
    *("at_end", "between", "failing", "found_link", "guided", "in_line", "points", "reaching"),
    "runs",
    "undetermined",
}
"""Faces that only the words for what cannot be drawn look at: tests/diagnosis holds them."""
DECLARED = {"imaged", "laid_at", "pencil", "titled", "lines_before"}
"""Faces that a kind says by the roles that they have, without a method."""
PLANNING = {"absence", "cause", "comes_along", "draw", "lines_at"}
"""Faces of classes: how a program is written, and why ``explain`` leaves an effect out."""
WIDE = {
    *("GuideLine", "GuideThroughPins", "NormalComponent", "PerpendicularThrough", "RollingNormal"),
    "SetByCoordinate",
}
"""Kinds of which narrower ones exist that are drawn themselves."""
UNREACHED = {
    "AccelerationPole.mark_far",
    "InflectionPoint.places",
    "KleinComponent.room",
    "LadderAxis.pencil",
    "LaidOff.said_before",
    "RelativeCentre.needs_ray",
    "SpeedPole.pencil",
    "TurnedAcceleration.index_at",
    "TurnedVelocity.lines_before",
    "VelocityNormal.places",
}
"""Faces that none of the scenes here needs where it stands; each wants a scene, or to go."""


@cache
def mechanism(name: str) -> Mechanism:
    """A lab, an example, or a scene of the tests."""
    if name in RARE:
        return rare(name)
    if name in OWN:
        return load(OWN[name])
    return load(name if name in LABS else FOLDER / f"{name}.toml")


@cache
def materials(name: str, language: str = "en") -> list[Drawing]:
    """The sheets of a scene in a language."""
    one = mechanism(name)
    scales = materials(name)[0].scales if language != "en" else None
    return with_forces(one, drawings_of(one, verdict(name), words(language), scales))


def steps_of(name: str) -> tuple[Step, ...]:
    """The steps of a scene, with its plan of forces if it asks for one."""
    return materials(name)[-1].trace.program.steps


@cache
def verdict(name: str) -> Verdict:
    """What the loops say of a scene."""
    return proved(mechanism(name), sheet_motion(mechanism(name)))


@cache
def drawn(name: str) -> tuple[int, ...]:
    """The steps that the sheets of a scene draw."""
    numbers = (number for each in materials(name) for number in each.trace.values)
    return tuple(dict.fromkeys(numbers))


@cache
def homes() -> dict[type, list[str]]:
    """The scenes whose sheets draw each kind; of one that is never drawn those that compute it."""
    found: dict[type, list[str]] = {}
    written: dict[type, list[str]] = {}
    every = (*LABS, *CHOSEN, *MORE, *RARE, *OWN)
    for name in every if EVERY else (each for each in every if each not in SPARED):
        steps = steps_of(name)
        for kind in {type(steps[number].of) for number in drawn(name)}:
            found.setdefault(kind, []).append(name)
        for kind in {type(step.of) for step in steps}:
            written.setdefault(kind, []).append(name)
    return written | found


def below(kind: type[Construction]) -> Iterator[type[Construction]]:
    """The classes under a class that can be made."""
    for each in kind.__subclasses__():
        if not inspect.isabstract(each):
            yield each
        yield from below(each)


def kinds() -> list[type[Construction]]:
    """The kinds of constructions: the classes of which none is narrower, or that are drawn."""
    for module in pkgutil.walk_packages(graphkin.construction.__path__, "graphkin.construction."):
        importlib.import_module(module.name)
    found = {kind for kind in below(Construction) if kind.gives}
    made = (kind for kind in found if kind.__name__ in WIDE or not kind.__subclasses__())
    return sorted(made, key=lambda kind: kind.__name__)


KINDS = kinds()


def test_every_kind_that_is_drawn_is_one_of_them():
    assert {kind.__name__ for kind in homes() if kind.__subclasses__()} == WIDE


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_a_scene_draws_it_and_its_roles_are_its_own_steps(kind):
    assert kind in homes(), "no scene draws it"
    steps = steps_of(homes()[kind][0])
    records = {id(step.of): step.of for step in steps if type(step.of) is kind}
    for record in records.values():
        own = dict(record.given())
        assert own
        for role, number in own.items():
            assert (steps[number].of, steps[number].role) == (record, role)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_its_value_is_the_drawn_way_in_balls(kind):
    """The two ways of every step that has two overlap, in balls of 200 bits."""
    for name in homes()[kind][:2]:
        one = mechanism(name)
        trace = one.trace(one.asked(), by_hand=True, kind=ball_kind(200))
        for number, value in trace.values.items():
            step = trace.program.steps[number]
            own = type(step.of) is kind and step.by_hand in trace.values
            if own and hasattr(value, "overlaps"):
                assert value.overlaps(trace.values[step.by_hand]), step


def reported(name: str) -> object:
    """What a report says of the steps of a scene."""
    program = materials(name)[-1].trace.program
    return [(step_words(program, n), place_words(program, n)) for n in drawn(name)]


def said(name: str, language: str) -> object:
    """Sentences, reasons and relations in a language."""
    some = materials(name, language)
    why = [reasons(drawing, list(drawing.trace.values)) for drawing in some]
    parts = [parted_sentences(drawing) for drawing in some]
    told = [
        [list(of_sentence(drawing, Sentence(part.step, part.name, part.markup)))]
        for drawing, sheet_parts in zip(some, parts, strict=True)
        for whole in sheet_parts
        for part in whole.parts
    ]
    return [sentences(drawing) for drawing in some], parts, why, told, relations(some)


def marked(name: str) -> object:
    """The marks and labels of the fields of its sheets, before labels are placed."""
    found = []
    for drawing in materials(name):
        layout = lay_out(drawing)
        for board in (left_board(drawing, layout, "key"), right_board(drawing, layout, "key")):
            found.append((board.marks, board.labels))
    return found


def errors(name: str) -> object:
    """What a pencil does to it."""
    exact = original(*with_force_plan(mechanism(name), materials(name)[0].scales))
    return list(pencil_lines(forecast(exact, Pencil(0.25))))


def pages(name: str) -> object:
    """Its sheets, with every label in its place."""
    return [sheet(drawing, "key", "1/2")[0].marks for drawing in materials(name)]


def moves(name: str) -> object:
    """What its pages know of the moves that a student makes."""
    every = [screen_sheets(mechanism(name), "en")]
    if isinstance(materials(name)[-1], ForceDrawing):
        every.append([force_sheet(mechanism(name), "en")])
    return [turn_record(sheets, your_turn(sheets, telling(sheets))) for sheets in every]


COMES: tuple[Callable[[str], object], ...] = (
    reported,
    partial(said, language="en"),
    marked,
    errors,
    partial(said, language="it"),
    partial(said, language="ro"),
    pages,
    moves,
)
SHOWS = {
    "CarriedPlace.pencil": ("roller-plates", 3),
    "CentrePath.path_name": ("centrodes-roller", 7),
    "CoriolisComponent.laid_alone": ("rapid-return", 1),
    "CoriolisComponent.picked_from": ("slider-driven-along-a-turning-arm", 7),
    "CoriolisComponent.shown_between": ("slider-driven-along-a-turning-arm", 7),
    "CurvatureEdge.places": ("slider-crank with centres of curvature", 6),
    "DrivenSlide.slider": ("cylinders-two", 1),
    "DrivenSlide.tried_rate": ("platform-3rpr", 1),
    "GuideLine.path_name": ("trammel with all its centres", 7),
    "GuideThroughBlock.path_name": ("mobility-cam", 7),
    "ImageOfLink.errors": ("centrodes-roller", 7),
    "InflectionCircle.around": ("four-bar with more of each", 6),
    "InstantCentre.marks": ("roller-plates", 2),
    "InstantCentre.oddity": ("roller-plates", 1),
    "KleinComponent.shown_between": ("klein-engine", 7),
    "LaidOff.index_at": ("rapid-return", 1),
    "LineOfCentres.places": ("instant-centres", 6),
    "NormalComponent.formula": ("planet-on-coupler", 1),
    "NormalComponent.picked_from": ("roller with its inflection circle", 7),
    "NormalComponent.shown_between": ("roller with its inflection circle", 7),
    "NormalComponent.stands_at": ("stephenson-2-binary", 6),
    "ParallelThrough.errors": ("lever-with-its-block-behind-its-pivot", 7),
    "ParallelThrough.lines_before": ("oscillating-slide", 1),
    "PerpendicularThrough.errors": ("lever-with-its-block-behind-its-pivot", 7),
    "ShiftedGuide.path_name": ("slider-crank-at-rest-guide-below", 7),
    "TangentGuide.laid_at": ("block-beside-its-pin", 7),
    "TangentialDirection.errors": ("roller with its inflection circle", 7),
    "TurnedAcceleration.rate_taken": ("wheels-that-speed-up", 1),
    "TurnedAcceleration.tried_rate": ("rapid-return", 1),
    "TurnedVelocity.rate_taken": ("roller-plates", 1),
    "TurnedVelocity.tried_rate": ("rapid-return", 1),
    "TurningOfLink.source_of_rate": ("roller-plates", 1),
    "TwoTrials.reason": ("platform-3rpr", 1),
}
"""Where a face shows that few scenes show: the scene, and which part of what comes of it. It is
looked for there first."""
QUICK = 4
"""What comes of a scene, and how many of these are made for every scene before the others."""


@cache
def unchanged(name: str, part: int) -> object:
    """The same, with every face."""
    return COMES[part](name)


def own_faces(kind: type[Construction]) -> set[str]:
    """The faces that a class has of its own: methods, and what it declares."""
    return set(vars(kind)) - (set(kind.__annotations__) - DECLARED) - {"gives"}


TOLD: Counter[tuple[str, int]] = Counter()
"""How often a face of some name was told by each part of what comes of a scene."""
FACES = [
    pytest.param(kind, face, id=f"{kind.__name__}.{face}")
    for kind in KINDS
    for face in sorted(own_faces(kind) - MARKING - FAILING - PLANNING)
    if f"{kind.__name__}.{face}" not in UNREACHED
    if not face.startswith("_") and any(hasattr(base, face) for base in kind.__mro__[1:])
]


@pytest.mark.parametrize(("kind", "face"), FACES)
def test_no_face_is_idle(kind, face, monkeypatch):
    """Without it some page, table or report of a scene is another, or is not made at all."""
    parts = range(len(COMES))
    found = sorted(homes()[kind], key=lambda name: len(drawn(name)))  # the smallest first
    quick = sorted(parts[:QUICK], key=lambda part: -TOLD[face, part])
    shows = [SHOWS[each] for each in (f"{kind.__name__}.{face}",) if each in SHOWS]
    assert all(name in found for name, _ in shows)
    for name, part in (*shows, *product(found, quick), *product(found, parts[QUICK:])):
        kept = unchanged(name, part)
        with monkeypatch.context() as patch:
            patch.delattr(kind, face)
            try:
                changed = COMES[part](name) != kept
            except Exception:
                changed = True
        if changed:
            TOLD[face, part] += 1
            return
    pytest.fail("nothing changes without it")
