"""The assembly mode of each group, as the scene states it: sides, ways and closure numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence

from msgspec.structs import replace

from graphkin.scene.model import FRAME, LEADING, Branch, Closure, Scene, Side, Way
from graphkin.structure.groups import (
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    OnTwoPins,
    Spun,
    Stretched,
)
from graphkin.structure.pairs import Pin, parallel_sets
from graphkin.text.errors import (
    NO_WORDS,
    Message,
    Problem,
    StructureError,
    TakenOut,
    Written,
    both,
    either,
    joined,
    message,
    verbatim,
)

WAYS = '"forward"', '"backward"'
"""The larger and the smaller coordinate along a guide, as a scene writes them."""
MISSING = message("is missing")
"""The wording for a branch that is not written."""


def choosing(groups: tuple[Group, ...]) -> list[str]:
    """The names under which a scene may state a branch: pins, blocks, links of higher groups."""
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


def pins_choosing(groups: tuple[Group, ...]) -> list[str]:
    """The pins under which a scene may state the way of a dyad with a slide or a track."""
    dyads = (group.dyad if isinstance(group, Stretched) else group for group in groups)
    pins = (led_pin(dyad) for dyad in dyads if isinstance(dyad, Dyad))
    return [pin for pin in pins if pin is not None]


def led_pin(dyad: Dyad) -> str | None:
    """The inner pin of a dyad that a slide or a track closes in two ways; None if it has none."""
    return dyad.inner.point if has_two_ways(dyad) and isinstance(dyad.inner, Pin) else None


def key_of(scene: Scene, group: Group) -> str | None:
    """The name under which a scene states how a group closes; None where there is no choice.

    Where several guides lead one block, the pins of its dyads are used instead.
    """
    group = group.dyad if isinstance(group, Stretched) else group
    if not isinstance(group, Dyad):
        return next((name for name in scene.links if name in choosing((group,))), None)
    pin = led_pin(group)
    if pin is not None:
        shared = len(scene.links[block_of(group)].paths) > 1
        stated = isinstance(scene.branches.get(pin), Way)
        return pin if stated or shared else block_of(group)
    return next(iter(choosing((group,))), None)


def refuse_unstated(scene: Scene, group: Group) -> None:
    """Raise StructureError where the scene does not state how a group closes."""
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


def unused_branches(
    scene: Scene, groups: tuple[Group, ...], known: Collection[str] = ()
) -> list[Problem]:
    """A problem for each branch that no group can use, except those in ``known``."""
    allowed = choosing(groups)
    return [
        Problem(
            f"branches.{name}",
            why_no_choice(scene, groups, name),
            message("branches of {allowed}", allowed=", ".join(sorted(allowed)))
            if allowed
            else message("no branches"),
            joined("; ", (message("take it out"), only_way(scene, groups, name))),
            (TakenOut(),),
        )
        for name, branch in scene.branches.items()
        if name not in allowed and name not in known
        if not (isinstance(branch, Way) and name in pins_choosing(groups))
    ]


def why_no_choice(scene: Scene, groups: tuple[Group, ...], name: str) -> Message:
    """Why a link or a point needs no branch."""
    match group_of(scene, groups, name):
        case Crank(driver=driver) | Driven(driver=driver) | Spun(driver=driver):
            return message(
                "link {link} is driven: nothing is left to choose at {place}",
                link=driver.link,
                place=called(scene, name),
            )
        case Dyad() as dyad if not (dyad.type == "RRR" or has_two_ways(dyad)):
            return message(
                "links {links} with their slides close in one way only ({title})",
                links=both(dyad.links),
                title=dyad.title,
            )
        case Geared() as wheel:
            return wheel.one_way
    return message("no group has a choice at {place}", place=called(scene, name))


def only_way(scene: Scene, groups: tuple[Group, ...], name: str) -> Message:
    """A hint that names the key of the group's branch, where it has another name."""
    group = group_of(scene, groups, name)
    names = choosing((group,)) if group is not None else []
    if not names:
        return NO_WORDS
    return message("the branch of its group is that of {name}", name=names[0])


def group_of(scene: Scene, groups: tuple[Group, ...], name: str) -> Group | None:
    """The first group that contains a link or a point."""
    for group in groups:
        if name in group.links or any(name in scene.links[k].points for k in group.links):
            return group
    return None


def called(scene: Scene, name: str) -> Message:
    """A link or a point in words."""
    return message("link {on}", on=name) if name in scene.links else verbatim(name)


def stray(scene: Scene, groups: tuple[Group, ...], group: Group) -> list[str]:
    """The branches written under names of a group that have no choice to make."""
    allowed = choosing(groups)
    own = {*group.links, *(point for link in group.links for point in scene.links[link].points)}
    allowed += [name for name in pins_choosing(groups) if isinstance(scene.branches.get(name), Way)]
    return [name for name in scene.branches if name in own and name not in allowed]


def in_place_of(scene: Scene, problem: Problem, names: Sequence[str]) -> Problem:
    """The problem of a missing branch, with the branches probably written in its place."""
    if problem.found != MISSING or not names:
        return problem
    lines = both(f'{name} = "{scene.branches[name]}"' for name in names)
    own = problem.place.partition(".")[2]
    ways = [each for each in problem.changes if isinstance(each, Written)]
    expected = either(f"{own} = {each.value}" for each in ways)
    if len(ways) == 1:  # a closure: any number is accepted
        expected = problem.expected
    return replace(
        problem,
        found=message(
            "is missing, while {lines} chooses nothing"
            if len(names) == 1
            else "is missing, while {lines} choose nothing",
            lines=lines,
        ),
        expected=message("{expected} in place of {lines}", expected=expected, lines=lines),
        changes=tuple(replace(each, instead=names[0]) for each in problem.changes)
        if len(names) == 1
        else problem.changes,
    )


def side_of(scene: Scene, dyad: Dyad) -> int:
    """The stated side of a dyad's inner pin.

    +1 is left of the line from the dyad's left pin to its right pin.
    """
    assert isinstance(dyad.inner, Pin) and isinstance(dyad.left, Pin)
    assert isinstance(dyad.right, Pin)
    ends = (dyad.left.place, dyad.right.place)
    branch = scene.branches.get(dyad.inner.point)
    if isinstance(branch, Side) and (branch.first, branch.second) == ends:
        return branch.side
    if isinstance(branch, Side) and (branch.second, branch.first) == ends:
        return -branch.side
    line = "-".join(ends)
    sides = f'"left of {line}"', f'"right of {line}"'
    raise StructureError.at(
        f"branches.{dyad.inner.point}",
        MISSING if branch is None else message("does not name the two known pins of its dyad"),
        either(sides),
        message(
            "{point} can lie on either side of the line {line}; the scene says which",
            point=dyad.inner.point,
            line=line,
        ),
        tuple(map(Written, sides)),
    )


def block_of(dyad: Dyad) -> str:
    """The block, wheel or link on two pins under which the scene states the way of a dyad."""
    if isinstance(dyad, OnTwoPins):
        return dyad.inner.named
    slide = next(p for p in (dyad.right, dyad.inner, dyad.left) if not isinstance(p, Pin))
    return slide.links[0]


def way_of(scene: Scene, dyad: Dyad) -> int:
    """The stated way of a sliding link: +1 for the larger slide coordinate, -1 for the smaller.

    It is written under the link, or under the dyad's pin where several guides lead the link.
    """
    key = key_of(scene, dyad) or block_of(dyad)
    branch = scene.branches.get(key, scene.branches.get(block_of(dyad)))
    if isinstance(branch, Way):
        return branch.way
    hint = message("the arc cuts the guide twice; forward is the larger coordinate along the guide")
    if isinstance(dyad, OnTwoPins):
        pin, start = dyad.inner.pins
        hint = message(
            "link {rail} can lie either way round: forward puts {pin} ahead of {start}",
            rail=dyad.rail,
            pin=pin,
            start=start,
        )
    elif dyad.type == "RPR":
        hint = message(
            "the bar can point either way; forward is the larger coordinate along the guide"
        )
    raise StructureError.at(
        f"branches.{key}",
        MISSING
        if branch is None
        else message('"{branch}" for a link that {leading}', branch=branch, leading=LEADING),
        either(WAYS),
        hint,
        tuple(map(Written, WAYS)),
    )


def leads_later(scene: Scene, group: Higher, name: str) -> bool:
    """Whether the stated way of a block of a group belongs to a slide on a link placed later."""
    if not isinstance(scene.branches[name], Way):
        return False
    before = {*group.links, *(link for pair in group.placing for link in pair.links)}
    slides = scene.links[name].slides
    return bool(slides) and before.isdisjoint(slide.on for slide in slides)


def closure_of(scene: Scene, group: Higher) -> int:
    """The stated closure number of a higher group, counted from one."""
    stated = {
        name: scene.branches[name]
        for name in group.links
        if name in scene.branches and not leads_later(scene, group, name)
    }
    numbers = [branch.number for branch in stated.values() if isinstance(branch, Closure)]
    if numbers and len(stated) == 1:
        return numbers[0]
    first = next(name for name in scene.links if name in group.links)
    link = next(iter(stated), first)
    hint = message("they close together in several ways; graphkin check lists them")
    found = MISSING
    if len(numbers) > 1:
        found = message("is given twice")
    elif stated:
        lines = both(f'{name} = "{branch}"' for name, branch in stated.items())
        found = message("{lines} for one {title}", lines=lines, title=group.title)
        hint = message(
            "they close together in several ways; graphkin check lists them; if two of them "
            "should close by themselves, a guide or a pin is on the wrong link"
        )
    raise StructureError.at(
        f"branches.{link}",
        found,
        message(
            '{link} = "closure 1", or another number, for the links {links}',
            link=link,
            links=", ".join(group.links),
        ),
        hint,
        (Written('"closure 1"'),),
    )


def may_be_numbered(scene: Scene) -> bool:
    """Whether a scene may number the closure of links that are grouped otherwise now.

    Links that slide on two others, or sides besides where parallel bars may make one idle.
    """
    kinds = {type(branch) for branch in scene.branches.values()}
    if Closure not in kinds:
        return False
    ends = ((link.name, slide.on) for link in scene.links.values() for slide in link.slides)
    slides = Counter(end for pair in ends for end in pair if end != FRAME)
    return max(slides.values(), default=0) > 1 or (Side in kinds and bool(parallel_sets(scene)))


def translated(written: Mapping[str, Branch], read: Mapping[str, Branch]) -> list[str]:
    """What branches mean in present words; nothing where they are read as written."""
    before = [f"{name} = {each}" for name, each in written.items() if read.get(name) != each]
    now = [f"{name} = {each}" for name, each in read.items() if written.get(name) != each]
    return [f"{', '.join(before)} is {', '.join(now)}"] if before else []
