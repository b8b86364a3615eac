"""The text of check: what a scene is made of, how it closes, how well it can be drawn."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from itertools import combinations
from math import degrees, isinf

from graphkin.cli.report.crossing_words import crossing
from graphkin.cli.report.motion_report import flat_words, is_flat, verdict_words
from graphkin.cli.report.solution_record import heading
from graphkin.cli.report.structure_report import group_lines, structure
from graphkin.construction.compile import write
from graphkin.construction.core.cam_profiles import CamProfile, profiles_of
from graphkin.construction.core.crossings import crossings
from graphkin.construction.core.drawn_scene import METRES
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import gathered
from graphkin.construction.links.counted_turn import counted_link
from graphkin.diagnosis.closures import Choice, choices
from graphkin.diagnosis.ranges import ClosingRanges, closing, reached_words
from graphkin.mechanism import Mechanism
from graphkin.scene.model import Cam, Scene, link_words
from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import driver_problem
from graphkin.structure.groups import Higher
from graphkin.structure.pairs import sharers
from graphkin.structure.turn_counting import place_of_turns
from graphkin.text.errors import (
    ClosureError,
    GraphkinError,
    Problem,
    StructureError,
    WitnessError,
)
from graphkin.text.plain_table import labelled, listed, table

WORST = 3
"""Flattest crossings shown."""


class Checking:
    """Looks at a mechanism part by part; what is wrong is kept, and what is known still shown."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.problems: list[Problem] = []
        self.doubts: list[str] = []

    def lines(self) -> Iterator[str]:
        """The whole report, line by line, as far as the scene allows."""
        scene = self.mechanism.scene
        yield from (heading(scene), "")
        try:
            yield from structure(scene)
            yield from labelled("groups", group_lines(decompose(scene)))
            yield from labelled("cams", list(cam_lines(scene)))
            yield from self.closing()
            yield from labelled("rank", self.rank())
            trace = self.mechanism.trace()
            yield from labelled("turns", turns_lines(trace, scene))
            by_hand = self.mechanism.trace(self.mechanism.asked(), by_hand=True)
            yield from labelled("crossings", crossing_lines(by_hand))
            yield from labelled("note", fallen_together(scene, trace))
            self.doubts += [flat_words(scene, trace)] if is_flat(trace) else []
            yield from labelled("witness", [self.witness(trace)])
            self.scale_factors()
        except GraphkinError as error:
            self.problems += error.problems

    def closing(self) -> Iterator[str]:
        """Closures of the dyads, and the driver's angles for which everything closes."""
        mechanism = self.mechanism
        lines: list[str] = []
        try:
            groups, program = mechanism.laid
        except StructureError:  # an idle link may have no room in the stated closure
            groups = mechanism.groups
            program = write(mechanism.scene, groups, fitted=False)
        for choice in choices(mechanism.scene, groups, program, proving=True):
            lines += closure_lines(choice)
        stated = any(line.startswith("*") for line in lines)
        legend = ["(* as the scene says)"] if stated else []
        lines = lines or ["nothing to choose"]
        yield from labelled("closures", [*lines, *legend])
        if program is mechanism.program:  # which raises where an idle link has no room
            yield from labelled("range", range_lines(mechanism))

    def rank(self) -> list[str]:
        """The true mobility in words; a wrong number of drivers for it is a problem.

        Where nothing closes, more drivers than the count leaves freedoms may be the cause.
        """
        from graphkin.cli.report.mobility_report import Rank

        try:
            rank = Rank(self.mechanism)
        except ClosureError as error:
            doubt = driver_problem(self.mechanism.scene)
            raise ClosureError([*error.problems, *([doubt] if doubt else [])]) from error
        problem = driver_problem(self.mechanism.scene, rank.moving)
        self.problems += [problem] if problem else []
        return list(rank.lines())

    def witness(self, trace: Trace) -> str:
        """The verdict of the independent route; a doubt where it does not agree."""
        try:
            verdict = self.mechanism.witness(gathered(trace))
        except WitnessError as error:
            self.doubts.append(f"the independent route cannot judge: {error}")
            return f"could not judge: {error}"
        if not verdict.agrees:
            self.doubts.append("the independent route does not agree with the construction")
        return verdict_words(verdict, self.mechanism.scene)

    def scale_factors(self) -> None:
        """Raise GraphkinError for scale factors that [sheet] states and no sheet can keep.

        A mechanism of which no sheet is handed out anyway is not asked for them.
        """
        sheet = self.mechanism.scene.sheet
        states = sheet.scale or sheet.enlarge or sheet.ka or sheet.rule == "lab"
        if states and not self.doubts:
            from graphkin.documents.scaling import scales

            scales(self.mechanism)


def closure_lines(choice: Choice) -> list[str]:
    """Both closures of a dyad, the picked one marked."""
    of = f"the angle of link {choice.pin}" if choice.is_turned else choice.pin
    lines = [f"{of} of links {listed(choice.links)}:"]
    if not choice.closures:
        lines.append("  none in this position")
    for closure in choice.closures:
        if closure.place is None:
            where = "cannot be drawn"
        elif choice.is_turned:
            where = f"{degrees(phase(closure.place)) + 0.0:.3f}°"
        else:
            x, y = (f"{1e3 * part + 0.0:.3f}" for part in (closure.place.real, closure.place.imag))
            where = f"({x}, {y}) mm"
        rest = f"then {closure.fails} cannot be drawn" if closure.fails else "the rest closes"
        if closure.unfit:
            rest = f"then link {closure.unfit} does not fit"
        if closure.place is None:
            rest = ""
        mark = "*" if closure.picked else " "
        lines.append(f"{mark} {closure.words:<18} {where:<26} {rest}".rstrip())
    if choice.is_complete is False:
        lines.append("  others may exist: no proof that the search found every closure")
    return lines


def range_lines(mechanism: Mechanism) -> list[str]:
    """The positions of the driver for which everything closes, for one driver."""
    if len(mechanism.scene.drivers) != 1:
        return ["not swept: it is for mechanisms with one driver"]
    found = closing(mechanism.scene)
    if found.tried:
        return [found.bound]
    return [range_words(mechanism, found), *([found.bound] if found.bound else [])]


def range_words(mechanism: Mechanism, found: ClosingRanges) -> str:
    """Where the only driver closes everything."""
    scene, ranges = mechanism.scene, found.ranges
    turns = scene.drivers[0].kind == "turn"
    what = "angle" if turns else "position"
    if any(isinstance(group, Higher) for group in mechanism.groups) and ranges:
        where = "every" if ranges == [(0.0, 360.0)] else "some"
        words = f"has the closure of that number for {where} {what} of the driver"
        if where == "some":
            words += f": {reached_words(scene, ranges)}"
        return f"{words}; numbers change hands at dead points: graphkin cycle follows the motion"
    if turns and ranges == [(0.0, 360.0)]:
        return "closes for every angle of the driver: it turns fully"
    if not ranges:
        return f"closes for no {what} of the driver"
    closes = "closes"
    if any(cam.slides for cam in scene.cams.values()):
        closes = "plans can be drawn, the plate being curved at the contact,"
    return f"{closes} for driver {what}s {reached_words(scene, ranges)}"


def turns_lines(trace: Trace, scene: Scene) -> list[str]:
    """Which angle links are taken to have, where their pins leave whole turns open."""
    found = []
    for step in trace.program.steps:
        link = counted_link(step)
        if link is None or (link in scene.unseen and scene.links[link].slides):
            continue
        angle, near = degrees(trace.value("turned", link)), degrees(trace.values[step.args[-1]])
        found += [
            f"link {link} stands at {angle:.2f}°, the angle within half a turn of {near:g}°",
            "  its pins do not show how often it went round since the start of "
            f"{place_of_turns(scene, link)};",
            f"  turns = {{ {link} = … }} there says how many whole turns are to be added",
        ]
    return found


def crossing_lines(trace: Trace) -> list[str]:
    """The flattest crossings on paper: the angle, the part of the work, and the point.

    ``trace`` holds the hand's way to what is asked: figures of components, plates and poles, too.
    """
    rows: dict[tuple[str, str], str] = {}
    for found in sorted(crossings(trace), key=lambda found: found.angle):
        rows.setdefault(crossing(trace.program, found.number), f"{degrees(found.angle):.2f}°")
        if len(rows) == WORST:
            break
    if not rows:
        return ["nothing crosses"]
    lines = [(angle, part, point) for (point, part), angle in rows.items()]
    return table(("angle", "part", "point (flattest crossings)"), lines)


STEEP = 30.0
"""Pressure angle of a sliding follower that textbooks advise not to exceed, in degrees."""
STEEP_LEVER = 45.0
"""The same of one that swings."""


def cam_lines(scene: Scene) -> Iterator[str]:
    """For each cam its pressure angle and its least radius of curvature; undercutting is told."""
    unit = scene.units["length"]
    for follower, cam in scene.cams.items():
        moves = "swings" if cam.lever else "lifts"
        yield f"{link_words(cam.on)} {moves} link {follower} by a {cam.tip} follower"
        for profile in profiles_of(scene, follower):
            if profile.second:
                yield "  and its second roller on the conjugate profile"
            yield from profile_lines(profile, unit)


def profile_lines(profile: CamProfile, unit: str) -> Iterator[str]:
    """The pressure angle of one profile, and its least radius of curvature.

    A flat follower has none, but where it swings about a pivot beside its face.
    """
    cam = profile.cam
    angle, at = profile.steepest
    if not profile.is_flat or (cam.lever and round(angle, 2)):
        steep = STEEP_LEVER if cam.lever else STEEP
        over = f", above the usual {steep:g}°" if angle > steep else ""
        yield f"  pressure angle at most {angle:.2f}° (at {law_place(cam, at, unit)}){over}"
    radius, at = profile.sharpest
    size = f"{radius / METRES[unit]:.4g} {unit}"
    place = law_place(cam, at, unit)
    if isinf(radius):
        yield "  no place of the profile is convex"
    elif radius <= 0:
        yield f"  undercut at {place}: radius {size}; {remedy(cam.tip)}"
    else:
        yield f"  convex profile's least radius {size} (at {place})"


def law_place(cam: Cam, at: float, unit: str) -> str:
    """A place of a law, by the angle in degrees or the coordinate (m) of a plate."""
    return f"{at / METRES[unit]:.4g} {unit} of the law" if cam.slides else f"{at:.1f}° of the law"


def remedy(tip: str) -> str:
    """What takes undercutting away."""
    smaller = " or a smaller roller" if tip == "roller" else ""
    return f"a larger base circle{smaller} mends it"


NEAR = 1e-9
"""Pins nearer to one another than this, in parts of the largest distance, lie on one place."""


def fallen_together(scene: Scene, trace: Trace) -> list[str]:
    """A sentence for each two pins that fall together though no link keeps them so.

    A closure in which they do is seldom the one that is meant, for a bar then lies on another; two
    names for what is one pin would leave its links apart.
    """
    places = pin_places(scene, trace)
    size = max((abs(p - q) for p, q in combinations(places.values(), 2)), default=0.0)
    return [
        sentence(scene, one, other)
        for one, other in combinations(places, 2)
        if abs(places[one] - places[other]) <= NEAR * size and not kept(scene, one, other)
    ]


def pin_places(scene: Scene, trace: Trace) -> dict[str, complex]:
    """Where the points stand that join links."""
    pins = [point for point, links in sharers(scene).items() if len(links) > 1]
    found = {pin: trace.value("position", pin) for pin in pins}
    return {pin: complex(place) for pin, place in found.items() if place is not None}


def kept(scene: Scene, one: str, other: str) -> bool:
    """Whether one link has both points."""
    every = scene.every_link
    return any(one in link.points and other in link.points for link in every)


def sentence(scene: Scene, one: str, other: str) -> str:
    """That two pins fall together, with their links, and what to do."""
    owners = sharers(scene)
    who = [f"{pin} of {listed(map(link_words, owners[pin]))}" for pin in (one, other)]
    return (
        f"{who[0]} falls on {who[1]} in this closure; "
        "if that is not meant, take another closure or another position of the driver"
    )
