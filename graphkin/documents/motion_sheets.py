"""The sheets of a whole motion: the mechanism in its positions, their plans, and diagrams."""

from __future__ import annotations

from collections.abc import Callable

from graphkin.construction.core.quantities import SHEETS
from graphkin.documents.positions import PositionSet, positions_of
from graphkin.documents.positions_plans import plan_page
from graphkin.documents.positions_sheet import at_scale, positions_page
from graphkin.drawing.marks import Page
from graphkin.mechanism import Mechanism
from graphkin.text import Words

Part = tuple[str, tuple[Page, ...]]
"""A kind of sheet and its pages."""


def motion_sheets(mechanism: Mechanism, view: str, words: Words) -> list[Part]:
    """The sheets of a view of a whole motion. Raises as ``positions_of`` does."""
    found = positions_of(mechanism, words)
    kL = at_scale(found).alone.scales.kL
    made: list[tuple[str, Callable[[str], Page]]] = [
        ("mechanism", lambda number: positions_page(found, number))
    ]
    made += [(kind, plans(found, kind, kL)) for kind in SHEETS if found.planned(kind)]
    return [(kind, (page(f"{i}/{len(made)}"),)) for i, (kind, page) in enumerate(made, 1)]


def plans(found: PositionSet, kind: str, kL: float) -> Callable[[str], Page]:
    """The sheet of the plans of one kind, which waits for its number."""
    return lambda number: plan_page(found, kind, kL, number)
