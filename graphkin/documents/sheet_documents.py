"""The sheets of a mechanism, each verified before it is drawn and handed out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.crossings import letter_of
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import variant
from graphkin.construction.core.layout import lay_out, lowered, mechanism_field
from graphkin.construction.core.naming import name_of_sheet
from graphkin.construction.core.quantities import SHEETS
from graphkin.construction.core.solution import FAIR, Solution, Verdict
from graphkin.construction.result_tables import unread
from graphkin.diagnosis.assembly_failure import beside_dead_point
from graphkin.documents.detail import with_detail
from graphkin.documents.scaling import drawing, scales, sheet_motion, targets_of
from graphkin.documents.sheet import boards, parts_of, sheet_heading, title_of, weight_of
from graphkin.documents.view_names import MOTION_VIEWS
from graphkin.drawing.field import Rect
from graphkin.drawing.frame import fitting
from graphkin.drawing.marks import LineMark, Mark, Page, Text
from graphkin.drawing.richtext import extent
from graphkin.drawing.scale import Scales
from graphkin.drawing.style import BARE, TINTS, style_of
from graphkin.mechanism import Mechanism
from graphkin.motion.motion_curves import curves_of
from graphkin.scene.model import Scene
from graphkin.text import LANGUAGES, Words, words
from graphkin.text.errors import Problem, SceneError, Sought, WitnessError, either, message

CALCULATED = ("key", "task")
"""The views that come with calculation pages."""


class SheetDocument(Struct, frozen=True):
    """The pages of one document: velocity, acceleration or calculation.

    ``unread`` says which quantities it asks for but does not allow to be read off.
    """

    kind: str
    pages: tuple[Page, ...]
    unread: tuple[str, ...] = ()


def hand_out(
    mechanism: Mechanism, view: str = "key", language: str | None = None
) -> list[SheetDocument]:
    """The sheets that a scene asks for, in a language (None: the scene's own).

    Raises WitnessError when the independent route disagrees, and PageError when a page does not
    fit.
    """
    from graphkin.documents.calculation import calculation

    if view in MOTION_VIEWS:  # in metres, whatever the unit of results
        from graphkin.documents.motion_sheets import motion_sheets

        mechanism = mechanism.spoken(language)
        spoken = language_of(mechanism, language)
        return [SheetDocument(*part) for part in motion_sheets(mechanism, view, spoken)]
    mechanism = mechanism.spoken(language).measured
    spoken = language_of(mechanism, language)
    if mechanism.scene.sheet.sheets != len(SHEETS):
        raise SceneError(
            Problem(
                "sheet.sheets",
                message("one sheet for both plans is not drawn yet"),
                message("2, or left out"),
            )
        )
    drawings = drawn_of(mechanism, spoken)
    sheets = [
        replace(each, unread=tuple(unread(drawing)) if drawing.kind in SHEETS else ())
        for each, drawing in zip(drawn_sheets(drawings, view), drawings, strict=True)
    ]
    if view not in CALCULATED:
        return sheets
    return [*sheets, SheetDocument("calculation", calculation(drawings, view))]


def calculation_text(mechanism: Mechanism, view: str = "key", language: str | None = None) -> str:
    """The calculation of a scene as a LaTeX document. Raises as ``hand_out`` does."""
    from graphkin.documents.calculation_tex import calculation_tex

    mechanism = mechanism.spoken(language).measured
    return calculation_tex(drawn_of(mechanism, language_of(mechanism, language)), view)


def drawn_of(mechanism: Mechanism, spoken: Words) -> list[Drawing]:
    """The drawings of all sheets, proved by the independent route."""
    verdict = proved(mechanism, sheet_motion(mechanism))
    return with_forces(mechanism, drawings_of(mechanism, verdict, spoken))


def with_forces(mechanism: Mechanism, drawings: list[Drawing]) -> list[Drawing]:
    """The drawings, with that of the forces where the scene asks for reactions or the balance."""
    given = mechanism.scene.forces
    if given is None or not given.asked:
        return drawings
    from graphkin.documents.force_sheets import force_drawing

    return [*drawings, force_drawing(mechanism, drawings)]


def drawn_sheets(drawings: Sequence[Drawing], view: str) -> list[SheetDocument]:
    """The numbered sheets of a mechanism's drawings in a view.

    Parts that do not fit on a key or a task go to continuation sheets.
    """
    if view in CALCULATED:
        from graphkin.documents.continuation import as_pages, rest
        from graphkin.documents.sheet import sheet, writing

        every = [(drawing, writing(drawing, view)) for drawing in drawings]
        more = [rest(drawing, view, written.moved, written.said) for drawing, written in every]
        total = sum(1 + len(sheets) for sheets in more)
        found, number = [], 0
        for (drawing, written), sheets in zip(every, more, strict=True):
            number += 1
            pages = [*sheet(drawing, view, f"{number}/{total}", written=written)]
            for marks in sheets:
                number += 1
                pages += as_pages(drawing, view, f"{number}/{total}", marks)
            found.append(SheetDocument(drawing.kind, tuple(pages)))
        return found
    total = len(drawings)
    return [
        SheetDocument(drawing.kind, by_itself(drawing, view, f"{i}/{total}"))
        for i, drawing in enumerate(drawings, 1)
    ]


def by_itself(drawing: Drawing, view: str, number: str) -> tuple[Page, ...]:
    """The pages of one drawing, step by step or as an overlay."""
    if view == "steps":
        from graphkin.documents.continuation import as_pages, rest
        from graphkin.documents.sheet import sheet_heading
        from graphkin.documents.step_pages import growing

        moved = frozenset(sheet_heading(drawing)[1])
        more = (as_pages(drawing, view, number, marks) for marks in rest(drawing, view, moved))
        return (*growing(drawing, number), *chain.from_iterable(more))

    return overlay(drawing, number)


def language_of(mechanism: Mechanism, language: str | None) -> Words:
    """The words of a language with the scene's signs. Raises SceneError if it is unknown."""
    code = language or mechanism.scene.sheet.language
    if code not in LANGUAGES:
        raise SceneError(
            Problem(
                "sheet.language",
                message('"{code}" is not a language', code=code),
                either(LANGUAGES),
            )
        )
    return words(code, mechanism.scene.sheet.signs, mechanism.scene.base)


def proved(mechanism: Mechanism, solution: Solution) -> Verdict:
    """The verdict of the independent route. Raises WitnessError if it fails or is unreliable."""
    if solution.margin < FAIR:
        raise WitnessError(nearly_singular(mechanism))
    verdict = mechanism.witness(solution)
    if not verdict.agrees:
        raise WitnessError(disagreements(mechanism.scene, verdict))
    if verdict.unsure:
        raise WitnessError(lost(verdict))
    return verdict


def lost(verdict: Verdict) -> Problem:
    """The problem of quantities without a reliable digit; its place is the first of them."""
    return Problem(
        verdict.unsure[0],
        message(
            "no digit of it is sure: the rounding of doubles, which flat crossings and "
            "angles of many turns enlarge, exceeds it"
        ),
        message("crossings that are less flat, one after the other"),
        message("move the driver; no sheet is handed out"),
    )


def disagreements(scene: Scene, verdict: Verdict) -> Iterator[Problem]:
    """The reasons why the independent route disagrees: the numbers, the branches, or both."""
    refused = message("no sheet is handed out")
    if verdict.differs:
        difference = f"{verdict.largest_difference:.1e}"
        found = message(
            "construction and vector loops differ by {difference}", difference=difference
        )
        yield Problem(
            verdict.quantity, found, message("at most {limit:.1e}", limit=verdict.limit), refused
        )
    if verdict.branches:
        found = message(
            "{branches} does not hold by the vector loops",
            branches=verdict.not_as_stated(scene.branches),
        )
        yield Problem("branches", found, message("a construction that closes as stated"), refused)


def nearly_singular(mechanism: Mechanism) -> Problem:
    """The problem of lines that cross too flatly to be drawn: where, and what is nearly in line."""
    targets = dict.fromkeys(t for kind in SHEETS for t in targets_of(mechanism, kind))
    margins = mechanism.trace(targets or None).margins
    number = min(margins, key=lambda step: float(margins[step]))
    return Problem(
        "position",
        message(
            "the lines at {point} cross at a sine of {sine:.1e}, nearly singular",
            point=letter_of(mechanism.program, number),
            sine=float(margins[number]),
        ),
        message("at least {least:g}", least=FAIR),
        beside_dead_point(mechanism.scene, mechanism.program, number),
        about=(Sought(),),
        file=mechanism.scene.name,
    )


def drawings_of(
    mechanism: Mechanism, verdict: Verdict, spoken: Words, held: Scales | None = None
) -> list[Drawing]:
    """The drawings of all sheets, at one scale and with the mechanism at one place.

    The scale factors are those ``held``, whose layout is kept as well, or else those that fit best.
    """
    curves = curves_of(mechanism)
    chosen = held or scales(mechanism, curves)
    drawings = [
        drawing(mechanism, kind, found, chosen, verdict, spoken, curves)
        for kind in SHEETS
        if (found := targets_of(mechanism, kind))
    ]
    if not drawings:
        raise SceneError(
            Problem(
                "ask",
                message("asks for nothing that is drawn"),
                message("velocities, accelerations, centres …"),
            )
        )
    stand = None if held else mechanism_field(drawings)
    return [replace(each, stand=stand, again=i > 0) for i, each in enumerate(drawings)]


# --- the key on a transparent ground --------------------------------------------------------------


HALF, GAP, STROKE = 3.0, 2.0, 3.0
"""Half the size of a cross, the gap outside it, and the stroke beyond the gap, in mm."""
FOOT = 10.0
"""Distance of the title above the frame's lower edge, where the task sheet has no words."""


def overlay(drawing: Drawing, number: str) -> tuple[Page, ...]:
    """Mechanism and plan of the key at the places and scale of the task sheet.

    Labels that the task sheet has are left out, since their places may differ on the key. Crosses
    mark the corners of the task sheet's frame, with crop marks outside them. The caption names the
    variant of the mechanism.
    """
    layout = lowered(lay_out(drawing), sheet_heading(drawing, "task")[2])
    words, paper = drawing.words, drawing.paper
    tasks = boards(drawing, layout, "task")
    labels = (label for task in tasks for label in task.labels)
    known = {(label.name, cls) for label in labels for cls in (label.look, label.leader_look)}
    name = f"{title_of(drawing)} – {words('sheet.' + name_of_sheet(drawing))}"
    set_to = "".join(f", {each}" for each in variant(drawing.scene, words))
    rest = f"{set_to}, {words('sheet.overlay')} {number}, {words.decimal(drawing.scales.words)}"
    left, _, right, low = paper.areas[0]
    room = right - left - 24 - extent(rest, 2.5)[0]
    (first,), height = fitting("title", name, room, 2.5, 2.5)
    titles = [
        Text(own[0] + 12, low - FOOT, first + rest, "caption", height, name="title")
        for own in paper.areas
    ]
    marks = (
        *(
            untinted(mark)
            for mark in with_detail(*boards(drawing, layout, "key"))
            if (mark.name, mark.cls) not in known
        ),
        *(mark for own in paper.areas for mark in crop_marks(own)),
        *titles,
    )
    return tuple(
        Page(paper.across, paper.height, part, name, words.language, weight=weight_of(drawing))
        for part in parts_of(paper, marks)
    )


def untinted(mark: Mark) -> Mark:
    """A mark without its light tint, which would cover the drawing below."""
    if style_of(mark.cls).fill not in TINTS:
        return mark
    return replace(mark, cls=f"{mark.cls} {BARE}")


def crop_marks(rect: Rect) -> Iterator[Mark]:
    """A cross on each corner of a frame, with two strokes outside it that remain after a cut."""
    for x, outward in ((rect[0], -1), (rect[2], 1)):
        for y, down in ((rect[1], -1), (rect[3], 1)):
            near, far = HALF + GAP, HALF + GAP + STROKE
            yield LineMark(x - HALF, y, x + HALF, y, "border", "corner")
            yield LineMark(x, y - HALF, x, y + HALF, "border", "corner")
            yield LineMark(x + outward * near, y, x + outward * far, y, "border", "crop")
            yield LineMark(x, y + down * near, x, y + down * far, "border", "crop")
