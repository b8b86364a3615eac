"""What the plans need to know of a link: two of its points as a base, and the rest."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.errors import Problem, StructureError
from graphkin.scene.model import FRAME, Scene, Side, Way
from graphkin.structure.graph import Pin, Sliding
from graphkin.structure.groups import Crank, Dyad, Group, Unresolved


@dataclass(frozen=True, slots=True)
class Base:
    """Two points of a link that its group constructs, and the points that follow from them.

    A link in translation (a block on the frame) has ``end`` None: all its points move alike.
    """

    link: str
    start: str
    end: str | None
    others: tuple[str, ...]


def base_of(scene: Scene, link: str, start: str, end: str | None) -> Base:
    """The base of a link, with its other points in the order written."""
    points = scene.link(link).points
    return Base(link, start, end, tuple(p for p in points if p not in (start, end)))


def crank_tip(scene: Scene, crank: Crank) -> str:
    """The first point of a driven link beside its pivot, along the line whose angle is given."""
    points = scene.link(crank.link).points
    line = crank.driver.of or points[:2]
    for point in (*line, *points):
        if point != crank.pivot:
            return point
    raise StructureError(
        Problem(
            f"links.{crank.link}",
            f"has only the point {crank.pivot}",
            "a second point",
            "a crank is a bar: write a length such as O-A = 30",
        )
    )


def bases(scene: Scene, group: Group) -> tuple[Base, ...]:
    """The bases of a group's links. Raises StructureError for a group without construction."""
    if isinstance(group, Crank):
        if group.driver.against != FRAME:
            raise no_construction(group)
        return (base_of(scene, group.link, group.pivot, crank_tip(scene, group)),)
    if not isinstance(group, Dyad) or not isinstance(group.left, Pin):
        raise no_construction(group)
    if not isinstance(group.inner, Pin):
        raise no_construction(group)
    first, second = group.links
    left = base_of(scene, first, group.left.point, group.inner.point)
    if isinstance(group.right, Pin):
        side_of(scene, group)
        return left, base_of(scene, second, group.right.point, group.inner.point)
    if group.right.links != (second, FRAME):
        raise no_construction(group)
    way_of(scene, group)
    return left, base_of(scene, second, group.inner.point, None)


def no_construction(group: Group) -> StructureError:
    """The error for a group that this version reads and counts but does not construct."""
    links = group.links if not isinstance(group, Crank) else (group.link,)
    what = "a crank that turns against a moving link"
    if isinstance(group, Dyad):
        what = f"a dyad {group.type}" + moving_guide(group)
    elif isinstance(group, Unresolved):
        what = "a group of class III or higher, or moved by a driver that slides or rolls"
    return StructureError(
        Problem(
            "links." + ", ".join(links),
            f"are {what}, which this version reads but does not construct",
            "cranks on the frame, dyads RRR, and dyads RRP on a guide of the frame",
            "graphkin check names every group",
        )
    )


def unused_branches(scene: Scene, groups: tuple[Group, ...]) -> list[Problem]:
    """A problem for each branch that no group has a choice for."""
    dyads = [group for group in groups if isinstance(group, Dyad)]
    needed = {g.inner.point for g in dyads if isinstance(g.inner, Pin) and g.type == "RRR"}
    needed |= {g.right.block for g in dyads if isinstance(g.right, Sliding)}
    return [
        Problem(
            f"branches.{name}",
            "no group has a choice here",
            "branches of " + (", ".join(sorted(needed)) or "nothing"),
            "take it out, or graphkin check shows which groups there are",
        )
        for name in scene.branches
        if name not in needed
    ]


def moving_guide(dyad: Dyad) -> str:
    """Words for a guide that is not of the frame."""
    moving = any(isinstance(p, Sliding) and FRAME not in p.links for p in (dyad.left, dyad.right))
    return " on a guide that moves" if moving else ""


def side_of(scene: Scene, dyad: Dyad) -> int:
    """The stated side of a dyad's inner pin: +1 left of the way from one known pin to the other."""
    assert isinstance(dyad.inner, Pin) and isinstance(dyad.left, Pin)
    assert isinstance(dyad.right, Pin)
    ends = (dyad.left.point, dyad.right.point)
    branch = scene.branches.get(dyad.inner.point)
    if isinstance(branch, Side) and (branch.first, branch.second) == ends:
        return branch.side
    if isinstance(branch, Side) and (branch.second, branch.first) == ends:
        return -branch.side
    line = "-".join(ends)
    raise StructureError(
        Problem(
            f"branches.{dyad.inner.point}",
            "is missing" if branch is None else "does not name the two known pins of its dyad",
            f'"left of {line}" or "right of {line}"',
            f"{dyad.inner.point} can lie on either side of the line {line}; the scene says which",
        )
    )


def way_of(scene: Scene, dyad: Dyad) -> int:
    """The stated way of a sliding link: +1 the larger slide coordinate, -1 the smaller."""
    assert isinstance(dyad.right, Sliding)
    block = dyad.right.block
    branch = scene.branches.get(block)
    if isinstance(branch, Way):
        return branch.way
    raise StructureError(
        Problem(
            f"branches.{block}",
            "is missing" if branch is None else "is not the branch of a sliding link",
            '"forward" or "backward"',
            "the arc cuts the guide twice; forward is the larger coordinate along the guide",
        )
    )
