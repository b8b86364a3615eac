"""The sheets of a whole motion: the mechanism in its positions, their plans, and diagrams."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from graphkin.construction.core.quantities import FORCE, SHEETS
from graphkin.documents.positions import PositionSet, positions_of
from graphkin.documents.positions_plans import hodograph_page, hodographs, plan_page
from graphkin.documents.positions_sheet import at_scale, positions_page
from graphkin.drawing.marks import Page
from graphkin.mechanism import Mechanism
from graphkin.text import Words
from graphkin.text.errors import SceneError, message

Made = tuple[str, Callable[[str], Page]]
"""A kind of sheet, and a page that waits for its number."""


def motion_sheets(
    mechanism: Mechanism, view: str, words: Words
) -> list[tuple[str, tuple[Page, ...]]]:
    """The sheets of a view of a whole motion by kind. Raises as ``positions_of`` does."""
    found = positions_of(mechanism, words)
    made = [*(position_sheets(found) if view == "positions" else diagram_sheets(found))]
    if not made:
        raise SceneError.at(
            f"--view {view}",
            message("nothing follows the driver, and [ask] has no velocity or acceleration"),
            message("a link on the frame, a block, or a point that is asked for"),
        )
    pages: dict[str, tuple[Page, ...]] = {}
    for number, (kind, page) in enumerate(made, 1):
        pages[kind] = (*pages.get(kind, ()), page(f"{number}/{len(made)}"))
    return [*pages.items()]


def position_sheets(found: PositionSet) -> Iterator[Made]:
    """The mechanism in all positions, their plans, and their forces."""
    kL = at_scale(found).alone.scales.kL
    yield "mechanism", partial(positions_page, found)
    for kind in SHEETS:
        if found.planned(kind):
            yield kind, partial(plan_page, found, kind, kL)
    given = found.cycle.scene.forces
    if given is not None and given.asked:
        from graphkin.documents.positions_forces import force_pages

        for page in force_pages(found):
            yield FORCE, page


def diagram_sheets(found: PositionSet) -> Iterator[Made]:
    """Differentiation and integration, courses of all that is asked, cams, and the hodographs."""
    from graphkin.documents.diagram_numbers import motion_of
    from graphkin.documents.diagrams_sheet import (
        CHORDS,
        TANGENTS,
        course_pages,
        differentiation_page,
        integration_page,
    )

    motion = motion_of(found)
    if motion is not None:
        for method in (CHORDS, TANGENTS):
            yield "differentiation", partial(differentiation_page, motion, method)
        yield "integration", partial(integration_page, motion)
    for page in course_pages(found, motion):
        yield "courses", page
    if found.cycle.scene.cams:
        from graphkin.documents.cam_law_sheet import cam_law_pages

        for page in cam_law_pages(found):
            yield "cams", page
    kL = at_scale(found).alone.scales.kL
    for kind in SHEETS:
        if found.planned(kind) and hodographs(found, kind):
            yield "hodographs", partial(hodograph_page, found, kind, kL)
