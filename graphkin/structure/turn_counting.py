"""The turns of links since the start of their wheels: the angle near which each counts.

Pins show the direction of a link but not its number of turns, on which its wheels depend. The angle
is taken within half a turn of a reference: its start, plus the whole turns that the scene adds.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from graphkin.scene.expression import CONSTANT, Name, Number, Pair, Tree
from graphkin.scene.findings import numbered
from graphkin.scene.model import FRAME, Rolling, Scene
from graphkin.scene.phrases import place_of
from graphkin.scene.quantity import Quantity, exact
from graphkin.structure.pairs import contacts
from graphkin.text.errors import Problem, StructureError, message

WHOLE: Mapping[str, Tree] = {
    "deg": Number(Fraction(360)),
    "rad": Pair("*", Number(Fraction(2)), Name(CONSTANT)),
}
"""A full turn in the units of angles."""


def counted_near(scene: Scene) -> Mapping[str, Quantity]:
    """The angle of each link within half a turn of which its angle is taken.

    It counts from the start of the rolling that states its turns, else of the first rolling. Raises
    StructureError where two rollings state turns of one link.
    """
    found = {link: near(rolling, link) for link, rolling in counting(scene).items()}
    return {**found, **scene.near}


def counting(scene: Scene) -> Mapping[str, Rolling]:
    """The rolling that counts the angle of each wheel's, track's and arm's link."""
    found: dict[str, Rolling] = {}
    for contact in contacts(scene):
        for link in (*contact.links, *([contact.arm] if contact.arm else [])):
            found.setdefault(link, contact.rolling)
            for driver in scene.drivers:
                if driver.kind == "turn" and driver.link == link:
                    found.setdefault(driver.against, contact.rolling)
    found.pop(FRAME, None)
    return found | stated_rolling(scene)


def stated_rolling(scene: Scene) -> dict[str, Rolling]:
    """The rolling that states the turns of a link, by link."""
    found: dict[str, Rolling] = {}
    problems = []
    for each in scene.every_link:
        for rolling in each.rolls:
            for link, count in rolling.turns.items():
                if link in found:
                    first = found[link].turns[link].place
                    problems.append(
                        Problem(
                            count.place,
                            message("{first} states them too", first=first),
                            message("one of both"),
                        )
                    )
                found.setdefault(link, rolling)
    if problems:
        raise StructureError(problems)
    return found


def near(rolling: Rolling, link: str) -> Quantity:
    """The angle of a link at the start, plus the stated whole turns."""
    start = rolling.start.get(link, exact(0, "deg"))
    if link not in rolling.turns:
        return start
    turns = rolling.turns[link]
    tree: Tree = Pair("+", start.tree, Pair("*", turns.tree, WHOLE[start.unit]))
    return Quantity(f"({start.text}) + ({turns.text}) turns", tree, start.unit, turns.place)


def place_of_turns(scene: Scene, link: str) -> str:
    """The key of the rolling that counts the angle of a link."""
    rolling = counting(scene).get(link)
    return next(
        numbered(f"{place_of(each.name)}.rolls", n, len(each.rolls))
        for each in scene.every_link
        for n, own in enumerate(each.rolls)
        if own is rolling or rolling is None
    )
