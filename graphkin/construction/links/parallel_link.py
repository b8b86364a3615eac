"""Links that parallel bars keep parallel to a known link: their direction and rates are its own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, Construction
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.guides.guides import axis, axis_by_guide, axis_with_guide
from graphkin.construction.links.link_shapes import local_place
from graphkin.drawing.symbol_markup import escape
from graphkin.scene.model import FRAME
from graphkin.structure.groups import KeptParallel

if TYPE_CHECKING:
    from graphkin.construction.group_images import GroupImages


class KeptDirection(Construction, frozen=True, kw_only=True):
    """The direction of a ``link`` that ``bars`` keep parallel to the link ``lead``."""

    reasons: ClassVar[Mapping[str, str]] = {"turn": "why.parallel"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"turn": ByHand.TURNED}
    titled: ClassVar[str] = "the direction of link {link}"

    link: str
    lead: str
    bars: tuple[str, ...]
    turn: OwnStep

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sentence that names the bars and the link to which they keep it parallel."""
        if role != "turn":
            return ""
        words = drawing.words
        listed = words("list_mark").join(map(escape, self.bars))
        key = "step.kept-still" if self.lead == FRAME else "step.kept-parallel"
        return words(key, k=escape(self.link), lead=escape(self.lead), list=listed)


def place(pen: Pen, group: KeptParallel) -> None:
    """Draw the direction of the link, from set to set of bars."""
    here = group.lead
    if not pen.turns(here):
        pen.shifting |= {group.link}
    turn = pen.given("one") if here == FRAME else axis(pen, here)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        for each in group.sets:
            near, far = each.links if each.links[0] == here else each.links[::-1]
            for link, draw in ((near, axis_with_guide), (far, axis_by_guide)):
                ends = (local_place(pen, link, point) for point in each.line_on(link))
                turn = pen.draw(draw, turn, *ends)
            here = far
    pen.make(KeptDirection(link=group.link, lead=group.lead, bars=group.bars, turn=turn))
    pen.want("axis", group.link, turn)


def move(images: GroupImages, pen: Pen, group: KeptParallel) -> None:
    """Draw nothing: the pin's image is known, and the other points turn with the known link."""
