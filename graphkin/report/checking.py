"""The text of check: what a scene is made of, how it closes, how well it can be drawn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import asin, degrees

from graphkin.closures import Choice, choices
from graphkin.errors import GraphkinError, Problem, WitnessError
from graphkin.mechanism import Mechanism
from graphkin.reach import closing_ranges
from graphkin.report.motion import verdict_words
from graphkin.report.record import plain, settings_words
from graphkin.report.table import crossing, labelled, listed, table
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.steps.gather import gathered
from graphkin.steps.run import Trace
from graphkin.structure.graph import Pair, Pin, Sliding, pairs
from graphkin.structure.groups import Crank, Dyad, Group
from graphkin.structure.mobility import count

WORST = 3
"""Flattest crossings shown."""


class Checking:
    """Looks at a mechanism part by part; what is wrong is kept, and what is known still shown."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.problems: list[Problem] = []
        self.agrees = True

    def lines(self) -> Iterator[str]:
        """The whole report, line by line, as far as the scene allows."""
        scene = self.mechanism.scene
        yield from title(scene)
        yield from structure(scene)
        try:
            yield from labelled("groups", group_lines(self.mechanism.groups))
            yield from self.closing()
            trace = self.mechanism.trace()
            yield from labelled("rank", [true_words(scene, trace)])
            yield from labelled("crossings", crossing_lines(trace))
            yield from labelled("witness", [self.witness(trace)])
        except GraphkinError as error:
            self.problems += error.problems

    def closing(self) -> Iterator[str]:
        """Closures of the dyads, and the driver's angles for which everything closes."""
        mechanism = self.mechanism
        lines: list[str] = []
        for choice in choices(mechanism.scene, mechanism.groups, mechanism.program):
            lines += closure_lines(choice)
        legend = ["(* as the scene says)"] if lines else ["nothing to choose"]
        yield from labelled("closures", [*lines, *legend])
        yield from labelled("range", [range_words(mechanism)])

    def witness(self, trace: Trace) -> str:
        """The verdict of the independent route."""
        try:
            verdict = self.mechanism.witness(gathered(trace))
        except WitnessError as error:
            self.agrees = False
            return f"could not judge: {error}"
        self.agrees = verdict.agrees
        return verdict_words(verdict)


def title(scene: Scene) -> list[str]:
    """Title, name and parameters."""
    settings = settings_words({name: plain(scene.values.get(name)) for name in scene.parameters})
    return [f"{scene.title} ({scene.name})" + (f", {settings}" if settings else ""), ""]


def structure(scene: Scene) -> list[str]:
    """Links, pairs, the count of freedoms, and the drivers."""
    counted = count(scene)
    joined = pairs(scene)
    moving = listed(scene.links)
    freedoms = f"3·{counted.moving} − 2·{counted.pairs} = {counted.mobility}, mobility by the count"
    drivers = [driver_words(scene, driver) for driver in scene.drivers] or ["none"]
    return [
        *labelled("links", [f"{len(scene.links)} moving ({moving}), and the frame"]),
        *labelled("pairs", [f"{len(joined)}:", *map(pair_words, joined)]),
        *labelled("count", [freedoms]),
        *labelled("drivers", drivers),
    ]


def pair_words(pair: Pair) -> str:
    """A pair with the links that it joins."""
    if isinstance(pair, Pin):
        return f"pin {pair.point} of {joined_words(pair.links)}"
    if isinstance(pair, Sliding):
        return f"slide of block {pair.block} on {link_words(pair.links[1])}"
    return f"{type(pair).__name__.lower()} of {joined_words(pair.links)}"


def link_words(name: str) -> str:
    """A link by its name, link 0 as the frame."""
    return "the frame" if name == FRAME else f"link {name}"


def joined_words(names: Sequence[str]) -> str:
    """Several links by their names, the frame apart."""
    if FRAME in names:
        return listed(map(link_words, names))
    return f"links {listed(names)}"


def driver_words(scene: Scene, driver: Driver) -> str:
    """What a driver does, in the units of the scene, at these parameters."""
    what = {"turn": "turns", "slide": "slides", "roll": "rolls"}[driver.kind]
    found = [
        f"{quantity.written(scene.values)} {quantity.unit}".strip()
        for quantity in (driver.position, driver.speed, driver.acceleration)
    ]
    at = f"at {found[0]}, speed {found[1]}"
    at += "" if driver.acceleration.is_zero() else f", acceleration {found[2]}"
    return f"link {driver.link} {what} against {link_words(driver.against)}: {at}"


def group_lines(groups: tuple[Group, ...]) -> list[str]:
    """The groups in the order of construction."""
    return [f"{i}. {group_words(group)}" for i, group in enumerate(groups, 1)]


def group_words(group: Group) -> str:
    """A group by its kind, its links and what it hangs on."""
    if isinstance(group, Crank):
        return f"crank {group.link} about {group.pivot} (class I)"
    if isinstance(group, Dyad):
        outer = listed(map(pair_name, (group.left, group.right)))
        inner = pair_name(group.inner)
        of = f"dyad {group.type} (class II) of links {listed(group.links)}"
        return f"{of}, inner {inner}, outer {outer}"
    links = getattr(group, "links", None) or (getattr(group, "link", ""),)
    kind = type(group).__name__.lower()
    if kind == "unresolved":
        kind = "not a crank or a dyad (class III or higher, or without a driver):"
    return f"{kind} of links {listed(links)}".replace(": of", ":")


def pair_name(pair: Pair) -> str:
    """A pair in short: pin B, slide of 5 on the frame."""
    if isinstance(pair, Pin):
        return f"pin {pair.point}"
    return pair_words(pair)


def closure_lines(choice: Choice) -> list[str]:
    """Both closures of a dyad, the picked one marked."""
    lines = [f"{choice.pin} of links {listed(choice.links)}:"]
    for closure in choice.closures:
        if closure.place is None:
            where = "cannot be drawn"
        else:
            x, y = (f"{1e3 * part + 0.0:.3f}" for part in (closure.place.real, closure.place.imag))
            where = f"({x}, {y}) mm"
        rest = f"then {closure.fails} cannot be drawn" if closure.fails else "the rest closes"
        if closure.place is None:
            rest = ""
        mark = "*" if closure.picked else " "
        lines.append(f"{mark} {closure.words:<18} {where:<26} {rest}".rstrip())
    return lines


def range_words(mechanism: Mechanism) -> str:
    """The driver's angles for which everything closes, for one turning driver."""
    drivers = mechanism.scene.drivers
    if len(drivers) != 1 or drivers[0].kind != "turn":
        return "not swept: it is for mechanisms with one driver, which turns"
    program = mechanism.program
    found = closing_ranges(program, program.needed(program.targets), mechanism.scene)
    if found == [(0.0, 360.0)]:
        return "closes for every angle of the driver: it turns fully"
    turned = sorted((low - 360 * (high > 360), high - 360 * (high > 360)) for low, high in found)
    words = ", ".join(f"{low:.2f}° to {high:.2f}°" for low, high in turned)
    return f"closes for driver angles {words}" if words else "closes for no angle of the driver"


def true_words(scene: Scene, trace: Trace) -> str:
    """True mobility, from the rank of the constraints, and what a difference means."""
    from graphkin.freedom import true_mobility

    solution = gathered(trace)
    places = {n: p.position for n, p in solution.points.items() if p.position is not None}
    true, counted = true_mobility(scene, places), count(scene).mobility
    words = f"{true}, true mobility by the rank of the constraints"
    if true > counted:
        words += f": {true - counted} more than the count (idle constraints or a singular position)"
    return words


def crossing_lines(trace: Trace) -> list[str]:
    """The flattest crossings: the angle, the part of the work, and the point."""
    program = trace.program
    drawn = [(s, n) for n, s in trace.margins.items() if not program.steps[n].hand]
    flattest = sorted(drawn)[:WORST]
    rows = []
    for sine, step in flattest:
        point, part = crossing(program, step)
        rows.append((f"{degrees(asin(min(1.0, sine))):.2f}°", part, point))
    if not rows:
        return ["nothing crosses"]
    return table(("angle", "part", "point (flattest crossings)"), rows)
