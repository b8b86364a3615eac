"""Which way a group closes, as the scene states it: sides, ways and numbers of closures."""

from __future__ import annotations

from graphkin.errors import Problem, StructureError
from graphkin.scene.model import Closure, Scene, Side, Way
from graphkin.structure.graph import Pin
from graphkin.structure.groups import (
    Dyad,
    Group,
    Higher,
    Stretched,
)


def choosing(groups: tuple[Group, ...]) -> list[str]:
    """The names under which the scene may state a branch: pins, blocks, links of higher groups."""
    names: list[str] = []
    for group in groups:
        match group.dyad if isinstance(group, Stretched) else group:
            case Dyad(inner=Pin(point=pin), type="RRR"):
                names.append(pin)
            case Dyad() as dyad if has_two_ways(dyad):
                names.append(block_of(dyad))
            case Higher(links=links):
                names += links
    return names


def refuse_unstated(scene: Scene, group: Group) -> None:
    """Raise StructureError where the scene does not say in which way a group closes."""
    match group:
        case Dyad(type="RRR"):
            side_of(scene, group)
        case Dyad() if has_two_ways(group):
            way_of(scene, group)
        case Stretched(dyad=dyad):
            refuse_unstated(scene, dyad)
        case Higher():
            closure_of(scene, group)


def has_two_ways(dyad: Dyad) -> bool:
    """Whether a dyad with a slide or a track closes in two ways."""
    return dyad.type in ("RRP", "RPR", "RRW")


def unused_branches(scene: Scene, groups: tuple[Group, ...]) -> list[Problem]:
    """A problem for each branch that no group has a choice for."""
    allowed = choosing(groups)
    return [
        Problem(
            f"branches.{name}",
            "no group has a choice here",
            "branches of " + (", ".join(sorted(allowed)) or "nothing"),
            "take it out, or graphkin check shows which groups there are",
        )
        for name in scene.branches
        if name not in allowed and not harmless(scene, name)
    ]


def harmless(scene: Scene, name: str) -> bool:
    """A way stated for a block whose group closes in one way only: not demanded, not refused."""
    return isinstance(scene.branches[name], Way) and bool(
        name in scene.links and scene.links[name].slides
    )


def side_of(scene: Scene, dyad: Dyad) -> int:
    """The stated side of a dyad's inner pin: +1 left of the way from one known pin to the other."""
    assert isinstance(dyad.inner, Pin) and isinstance(dyad.left, Pin)
    assert isinstance(dyad.right, Pin)
    ends = (dyad.left.point.partition("@")[0], dyad.right.point)
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


def block_of(dyad: Dyad) -> str:
    """The block, or the wheel, by which the scene names the way of a dyad."""
    slide = next(p for p in (dyad.right, dyad.inner, dyad.left) if not isinstance(p, Pin))
    return slide.links[0]


def way_of(scene: Scene, dyad: Dyad) -> int:
    """The stated way of a sliding link: +1 the larger slide coordinate, -1 the smaller."""
    block = block_of(dyad)
    branch = scene.branches.get(block)
    if isinstance(branch, Way):
        return branch.way
    hint = "the arc cuts the guide twice; forward is the larger coordinate along the guide"
    if dyad.type == "RPR":
        hint = "the bar can point either way; forward is the larger coordinate along the guide"
    raise StructureError(
        Problem(
            f"branches.{block}",
            "is missing" if branch is None else "is not the branch of a sliding link",
            '"forward" or "backward"',
            hint,
        )
    )


def closure_of(scene: Scene, group: Higher) -> int:
    """The stated number of a higher group's closure, counted from one."""
    stated = [scene.branches[name] for name in group.links if name in scene.branches]
    numbers = [branch.number for branch in stated if isinstance(branch, Closure)]
    if numbers and len(stated) == 1:
        return numbers[0]
    link = next((name for name in group.links if name in scene.branches), None)
    link = link or first_written(scene, group)
    found = "is missing"
    if stated:
        found = "is given twice" if len(stated) > 1 else 'is not "closure 1" or another number'
    raise StructureError(
        Problem(
            f"branches.{link}",
            found,
            f'{link} = "closure 1", or another number, for the links {", ".join(group.links)}',
            "they close together in several ways; graphkin check lists them",
        )
    )


def first_written(scene: Scene, group: Higher) -> str:
    """The link of a group that is written first."""
    return next(name for name in scene.links if name in group.links)
