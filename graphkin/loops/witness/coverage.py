"""How much of a mechanism a solution speaks of: the witness need not look at the rest."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from graphkin.construction.core.quantities import QUANTITIES, held
from graphkin.construction.core.solution import LinkMotion, PointMotion, SlideMotion, Solution
from graphkin.loops.closing_groups import Group, stages
from graphkin.loops.equations import Equations
from graphkin.scene.model import FRAME, Scene, Side


def links_concerned(scene: Scene, loops: Equations, solution: Solution) -> frozenset[str] | None:
    """The links that a solution speaks of, and those on which they hang; None when that is all.

    A pin that several links share speaks of the one that is known first. All of them are taken
    where some link belongs to no group, for it may be idle and still hold the others.
    """
    spoken, moving = set(links_named(solution)), set(loops.links) - {FRAME}
    links_of = owners_of(loops)
    owners = [links_of.get(point, []) for point in points_named(solution)]
    if spoken.union(*(each for each in owners if len(each) == 1)) >= moving:
        return None
    order = stages(scene, loops)
    place = {link: n for n, group in enumerate(order) for link in group.links}
    if not place.keys() >= moving:
        return None
    firsts = (min(each, key=lambda link: place.get(link, -1)) for each in owners if each)
    wanted = {place[link] for link in spoken.union(firsts) if link in place}
    for n in range(len(order) - 1, -1, -1):
        if n in wanted:
            wanted |= {place[link] for link in hangs_on(order[n]) if link in place}
    return frozenset(link for n in wanted for link in order[n].links)


def hangs_on(group: Group) -> set[str]:
    """The links known before to which a group is joined, geared or driven."""
    joined = {link for joint in (*group.outer, *group.ties) for link in joint.links}
    return joined - set(group.links)


def links_named(solution: Solution) -> Iterator[str]:
    """Links and blocks of which anything is known, and those under a point such as A@3."""
    yield from (name for name, link in solution.links.items() if says_anything(link))
    yield from (name for name, slide in solution.slides.items() if says_anything(slide))
    for pair in solution.centres:
        yield from pair.split("-")
    yield from (link for name in solution.points if (link := name.partition("@")[2]))


def points_named(solution: Solution) -> Iterator[str]:
    """Points of which anything is known; of A@3 the point A."""
    return (name.partition("@")[0] for name, p in solution.points.items() if says_anything(p))


def says_anything(motion: PointMotion | LinkMotion | SlideMotion) -> bool:
    """Whether any quantity of a motion is known."""
    return any(getattr(motion, name) is not None for name in motion.__struct_fields__)


def owners_of(loops: Equations) -> dict[str, list[str]]:
    """The links that have each point."""
    found: dict[str, list[str]] = {}
    for link, body in loops.bodies.items():
        for point in body:
            found.setdefault(point, []).append(link)
    return found


def has_acceleration(solution: Solution) -> bool:
    """Whether a solution holds anything that hangs on accelerations."""
    return any(
        held(motion, quantity) is not None
        for quantity in QUANTITIES
        if quantity.kind == "acceleration"
        for motion in getattr(solution, quantity.whose.value).values()
    )


def scene_of(loops: Equations) -> Scene:
    """The scene of some equations, with the branches of what they hold and no others."""
    branches = {
        name: branch
        for name, branch in loops.scene.branches.items()
        if (
            {name, branch.first, branch.second} <= set(loops.points)
            if isinstance(branch, Side)
            else name in loops.links
        )
    }
    return replace(loops.scene, branches=branches)
