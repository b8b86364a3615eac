"""Groups whose wheels are pinned at the instant where they touch their tracks."""

from __future__ import annotations

from graphkin.construction.core.bases import bases, leads_of, own_first
from graphkin.construction.core.pen import Pen
from graphkin.construction.higher_class.higher import Each
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.plans.group_images import GroupImages
from graphkin.construction.rolling.wheel_images import image_of_rim
from graphkin.structure.groups import Higher


def move_pinned(
    images: GroupImages, pen: Pen, shapes: LinkShapes, group: Higher, each: Each
) -> None:
    """A plan: where wheels touch their tracks they have one velocity, and their accelerations
    differ towards the centres only."""
    for wheel in group.wheels:
        image_of_rim(images.plan, pen, wheel.contact, wheel.own, wheel.known)
    for link in group.links:
        pen.leads.pop(link, None)
    for member in group.at_instant:
        found = tuple(map(own_first, bases(pen.scene, member)))
        pen.bases |= {base.link: base for base in found}
        pen.leads |= leads_of(member)
        each(pen, shapes, member, found)
