"""Decomposition into driven links and Assur groups, in an order in which each can be constructed.

Assur: a mechanism is its frame and drivers, to which groups of links without freedom of their own
are joined one after the other. The smallest, two links and three pairs, is the dyad.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.structure.cam_guides import refuse_far_guides
from graphkin.structure.coupled_trains import next_coupled
from graphkin.structure.groups import Group, Unresolved
from graphkin.structure.higher_groups import next_higher
from graphkin.structure.joints import Joints
from graphkin.structure.next_group import next_driven, next_group, next_stretched, next_tie, settle
from graphkin.structure.pairs import Contact


def decompose(scene: Scene) -> tuple[Group, ...]:
    """The groups in order of construction. StructureError: a follower that misses its cam."""
    refuse_far_guides(scene)
    joints = Joints(scene)
    known = {FRAME}
    waiting = list(scene.drivers)
    groups: list[Group] = []
    while len(known) <= len(scene.links):
        group = (
            next_driven(joints, known, waiting)
            or next_group(joints, known)
            or next_stretched(joints, known, waiting)
            or next_tie(joints, known)
            or next_coupled(joints, known)
            or next_higher(joints, known, waiting)
            or unresolved(joints, known, waiting)
        )
        groups.append(group)
        settle(group, known, waiting)
    return tuple(groups)


def unresolved(joints: Joints, known: Collection[str], waiting: Sequence[Driver]) -> Unresolved:
    """What is left, and what there is in it that no construction takes."""
    links = tuple(joints.unknown(known))
    driven = tuple(each for each in waiting if {each.link, each.against} & {*links})
    rolled = (pair for link in links for pair in joints.others[link] if isinstance(pair, Contact))
    keepers = (None, *joints.scene.keepers)
    tracks = (pair.links[1] for pair in rolled if pair.track is None and pair.arm in keepers)
    return Unresolved(links, driven, tuple(dict.fromkeys(link for link in tracks if link in links)))
