"""The text of check on how a mechanism is put together: pairs, count, loops, drivers, groups."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.scene.model import FRAME, Driver, Scene, joined_words, link_words
from graphkin.scene.quantity import SI
from graphkin.structure.driver_count import count
from graphkin.structure.grashof import FourBar, Loop, SliderCrank, single_loops
from graphkin.structure.groups import Group
from graphkin.structure.pairs import all_pairs, sharers
from graphkin.text.plain_table import labelled, listed

MOST_LOOPS = 24
"""Rings of four links that are told."""
NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight")


def structure(scene: Scene) -> Iterator[str]:
    """Links, pairs, the count of freedoms, and the drivers.

    Raises StructureError for wheels that do not touch, after the links.
    """
    bare = scene.bare
    moving = listed(bare.links)
    yield from labelled("links", [f"{len(bare.links)} moving ({moving}), and the frame"])
    joined = all_pairs(bare)
    yield from labelled("pairs", [f"{len(joined)}:", *(pair.words for pair in joined)])
    counted = count(scene)
    yield from labelled("count", [f"{counted.words}, mobility by the count", *count_notes(bare)])
    yield from labelled("loops", loop_lines(scene))
    drivers = [driver_words(scene, driver) for driver in scene.drivers] or ["none"]
    yield from labelled("drivers", drivers)
    yield from labelled("put in", list(keeper_lines(scene)))


def keeper_lines(scene: Scene) -> Iterator[str]:
    """Each link that the scene does not have, put in to keep a wheel on its track.

    And each guide that it does not have, put in for rollers of one size.
    """
    for name, link in scene.links.items():
        for slide in (each for each in link.slides if each.rollers):
            rollers = joined_words(slide.rollers)
            kept = f"{rollers}, wheels of one size, keep it parallel to {link_words(slide.on)}"
            yield f"slide of {link_words(name)} on {link_words(slide.on)}: {kept}"
    for name, (wheel, path) in scene.keepers.items():
        link = scene.links[name]
        what = f"{link.points[0]}, a block on the parallel to the track through the centre"
        if path.through is None:
            what = f"{'-'.join(link.points)}, the line of centres"
        pair = f"the wheel of {link_words(wheel)} on {link_words(path.on)}"
        yield f"link {name}: {what}; it keeps {pair} and takes nothing from the motion"


# --- pairs and the count -------------------------------------------------------------------------


def count_notes(scene: Scene) -> Iterator[str]:
    """What is easily counted wrong: pins of several links, pairs that take one freedom, springs."""
    for point, links in sharers(scene).items():
        if len(links) > 2:
            many = dict(enumerate(NUMBERS)).get(len(links) - 1, len(links) - 1)
            yield f"pin {point} of {joined_words(links)} counts as {many} pairs"
    singles = [pair for pair in all_pairs(scene) if pair.taken == 1]
    if singles:
        one = "the wheel" if len(singles) == 1 else "each wheel"
        yield f"{one} whose distance is kept takes one freedom, every other pair two"


# --- closed loops --------------------------------------------------------------------------------


def loop_lines(scene: Scene) -> list[str]:
    """How many closed loops are independent, and what turns fully in each single one."""
    loops = count(scene).loops
    if loops <= 0:
        return ["none: an open chain"]
    noun = "closed loop" if loops == 1 else "independent closed loops"
    lines = [f"{loops} {noun}"]
    single = [loop for loop in single_loops(scene) if not scene.unseen & {*loop.links}]
    for loop in single[:MOST_LOOPS]:
        lines += single_loop_lines(scene, loop)
    if len(single) > MOST_LOOPS:
        lines.append(f"and {len(single) - MOST_LOOPS} more rings of four links")
    return lines


def single_loop_lines(scene: Scene, loop: Loop) -> list[str]:
    """A loop of four links: its class, the rule that decides it, and what that means."""
    head = four_bar_words(scene, loop) if isinstance(loop, FourBar) else slider_words(scene, loop)
    verdicts = [words for driver in scene.drivers if (words := driver_turn(loop, driver))]
    return [head, *(f"  {words}" for words in verdicts)]


def four_bar_words(scene: Scene, loop: FourBar) -> str:
    """Grashof's rule with the numbers of a loop: s + l against p + q."""
    short, *middle, long = sorted(loop.lengths)
    sign = {"triple rocker": ">", "change point": "="}.get(loop.kind, "<")
    numbers = [written(scene, length) for length in (short, long, *middle)]
    rule = f"{numbers[0]} + {numbers[1]} {sign} {numbers[2]} + {numbers[3]} {unit(scene)}"
    kind = f" ({loop.kind})" if FRAME in loop.links or not loop.slack else ""
    return f"four-bar {ring(loop)}: {rule}, {turning_words(loop)}{kind}"


def slider_words(scene: Scene, loop: SliderCrank) -> str:
    """The rule r + |d| against c with the numbers of a loop."""
    short, long = loop.lengths
    sign = {1: "<", 0: "=", -1: ">"}[loop.slack]
    left = f"{written(scene, short)} + {written(scene, abs(loop.offset))}"
    rule = f"{left} {sign} {written(scene, long)} {unit(scene)}"
    if FRAME not in loop.links:
        kind = "loop with a slide"
    else:
        kind = "slider-crank" if loop.guide == FRAME else "inverted slider-crank"
    return f"{kind} {ring(loop)}: {rule}, {turning_words(loop)}"


def turning_words(loop: Loop) -> str:
    """Which links turn all the way round against the others."""
    if not loop.turning:
        return "no link turns fully"
    if FRAME in loop.turning and loop.slack:
        return "every link turns fully against the frame"
    if len(loop.turning) == 1:
        words = f"{link_words(*loop.turning)} turns fully"
    else:
        words = f"{joined_words(loop.turning)} turn fully"
    if loop.slack:
        return f"{words} against the others"
    return f"{words}, but with the bars in line both closures meet"


def driver_turn(loop: Loop, driver: Driver) -> str:
    """Whether a turning driver within a loop turns fully there; empty where it is not in it."""
    ends = {driver.link, driver.against}
    if driver.kind != "turn" or not ends <= set(loop.links):
        return ""
    against = "" if driver.against == FRAME else f" against link {driver.against}"
    name = f"in this loop the driver of link {driver.link}{against}"
    if ends.isdisjoint(loop.turning):
        return f"{name} cannot turn fully: dead points end its range"
    return f"{name} turns fully"


def ring(loop: Loop) -> str:
    """The links of a loop, one after the other."""
    return "–".join(loop.links)


def written(scene: Scene, length: float) -> str:
    """A length (m) as a number in the unit of the scene."""
    return f"{length / float(SI[unit(scene)][0]):.6g}"


def unit(scene: Scene) -> str:
    """The unit of lengths of the scene."""
    return scene.units["length"]


# --- drivers and groups --------------------------------------------------------------------------


def driver_words(scene: Scene, driver: Driver) -> str:
    """What a driver does, in the units of the scene, at these parameters."""
    found = [
        f"{quantity.written(scene.values)} {quantity.unit}".strip()
        for quantity in (driver.position, driver.speed, driver.acceleration)
    ]
    at = f"at {found[0]}, speed {found[1]}"
    at += "" if driver.acceleration.is_zero() else f", acceleration {found[2]}"
    return f"link {driver.link} {driver.kind}s against {link_words(driver.against)}: {at}"


def group_lines(groups: tuple[Group, ...]) -> list[str]:
    """The groups in the order of construction."""
    return [f"{i}. {group.words}" for i, group in enumerate(groups, 1)]
