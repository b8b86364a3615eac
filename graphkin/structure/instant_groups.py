"""Groups at an instant: a wheel turns on its track about the point in which it touches it.

Its place may have to be tried where its motion need not.
"""

from __future__ import annotations

from collections.abc import Collection

from msgspec.structs import replace

from graphkin.scene.model import Driver
from graphkin.structure.groups import Dyad, Group, Higher
from graphkin.structure.joints import Joints
from graphkin.structure.next_group import (
    next_driven,
    next_group,
    next_stretched,
    next_tie,
    settle,
)
from graphkin.structure.wheel_groups import pinned_wheels


def at_instant(
    joints: Joints, group: Higher, known: Collection[str], waiting: Collection[Driver]
) -> Higher:
    """A group with what constructs its plans, its wheels pinned where they touch.

    The same where no wheel of it touches a known track, or where one would have to be tried all the
    same; or where an arm and its wheel would close as a dyad, for its three pins lie in line.
    """
    wheels = pinned_wheels(joints, group.links, group.placing, known)
    if not wheels:
        return group
    pinned = joints.part(group.links).with_pins([(wheel.joint, wheel.rim) for wheel in wheels])
    left = [each for each in waiting if {each.link, each.against} & {*group.links}]
    in_line = [wheel.three for wheel in wheels]
    grown, found = {*known}, list[Group]()
    while not grown.issuperset(group.links):
        each = (
            next_driven(pinned, grown, left)
            or next_group(pinned, grown)
            or next_stretched(pinned, grown, left)
            or next_tie(pinned, grown)
        )
        if each is None:
            return group
        if isinstance(each, Dyad) and any({*each.links} <= three for three in in_line):
            return group
        found.append(each)
        settle(each, grown, left)
    return group if left else replace(group, wheels=wheels, at_instant=tuple(found))
