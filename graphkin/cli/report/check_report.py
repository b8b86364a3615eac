"""The text of check: the parts of a scene, how it closes, and how well it can be drawn.

What check says of a house.toml: the conventions that it states.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import combinations, islice
from math import degrees, isinf, pi

from msgspec.structs import fields, replace

from graphkin.cli.report.solution_record import (
    crossing,
    flat_words,
    heading,
    is_flat,
    verdict_words,
)
from graphkin.construction.compile import write
from graphkin.construction.core.branches import translated
from graphkin.construction.core.cam_profiles import CamProfile, profiles_of
from graphkin.construction.core.crossings import crossings
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import gathered
from graphkin.construction.links.rolled_turn import counted_link
from graphkin.diagnosis.closures import Choice, choices
from graphkin.diagnosis.ranges import ClosingRanges, closing, reached_words
from graphkin.loops.assemble import true_mobility
from graphkin.mechanism import Mechanism
from graphkin.scene.house import PLAIN, House
from graphkin.scene.model import FRAME, Cam, Driver, Scene, joined_words, link_words
from graphkin.scene.quantity import LENGTHS, METRES, SI, exact
from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import count, driver_problem
from graphkin.structure.grashof import FourBar, Loop, SliderCrank, single_loops
from graphkin.structure.groups import Group, Higher, Tie
from graphkin.structure.pairs import all_pairs, sharers
from graphkin.structure.wheel_groups import place_of_turns
from graphkin.text.errors import ClosureError, GraphkinError, Problem, StructureError, WitnessError
from graphkin.text.school_signs import NAMES, USUAL
from graphkin.text.tables import labelled, listed, table

Places = Mapping[str, complex]
AT_MOST = 10
"""The most idle links and pairs that are listed; each takes a count of its own."""
NUDGE = Fraction(1, 50)
"""The step of the drivers away from a singular position, in radians or longest bars."""


class Rank:
    """The true mobility of a mechanism at its position, compared with the count.

    Raises ClosureError if the position does not close, and StructureError if the vector loops do
    not cover a pair.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism, self.scene = mechanism, mechanism.scene
        self.places = places_of(mechanism)
        self.ties = [group for group in mechanism.groups if isinstance(group, Tie)]
        self.here = true_mobility(self.scene, self.places)
        self.counted = count(self.scene).mobility
        self.moving = self.here
        if self.here > self.counted:
            self.moving = min(self.here, nearby(mechanism, self.places) or self.here)

    def lines(self) -> Iterator[str]:
        """The true mobility, and why it differs from the count."""
        if self.here == self.counted:
            yield f"{self.here}, true mobility by the rank of the constraints, as the count says"
            return
        yield f"{self.here}, true mobility by the rank of the constraints"
        if self.here > self.moving:
            yield f"singular position: beside it the constraints leave {self.moving}"
        if self.moving > self.counted:
            yield from self.idle_lines(self.moving - self.counted)

    def idle_lines(self, surplus: int) -> Iterator[str]:
        """The constraints that remove a freedom already removed by others."""
        many = "one constraint is" if surplus == 1 else f"{surplus} constraints are"
        yield f"{surplus} more than the count: {many} idle, taking what others take already"
        found = list(islice(self.idle(), AT_MOST + 1))
        if not found:
            return
        first, *others = found[:AT_MOST]
        if len(found) > AT_MOST:
            others.append("others")
        also = f" (or {listed(others)})" if others else ""
        right = ", and the count is right" if surplus == 1 else ""
        yield f"without {first}{also} the motion is the same{right}"

    def idle(self) -> Iterator[str]:
        """The parts that can be removed without adding a freedom, the idle groups first."""
        ties = [tie.link for tie in self.ties]
        for link in (*ties, *(name for name in self.scene.links if name not in ties)):
            if spare(self.scene, link) and self.same_without(without_link(self.scene, link)):
                yield f"link {link}"
        for name, part in parts_without(self.scene):
            if self.same_without(part):
                yield name

    def same_without(self, part: Scene) -> bool:
        """Whether a part of the mechanism moves as the whole does, though its count is larger."""
        try:
            more = count(part).mobility > self.counted
            return more and true_mobility(part, self.places) == self.here
        except StructureError:
            return False


def places_of(mechanism: Mechanism) -> dict[str, complex]:
    """The positions of the points (m), computed without any velocity."""
    positions = [target for target in mechanism.program.targets if target[0] == "position"]
    points = gathered(mechanism.trace(positions)).points.items()
    return {name: motion.position for name, motion in points if motion.position is not None}


def nearby(mechanism: Mechanism, places: Places) -> int | None:
    """True mobility with the drivers moved a little; None if that cannot be constructed."""
    spread = [abs(p - q) for p in places.values() for q in places.values()]
    for sense in (1, -1):
        moved = Mechanism(nudged(mechanism.scene, sense, max(spread, default=1.0)))
        try:
            return true_mobility(moved.scene, places_of(moved))
        except GraphkinError:
            continue
    return None


def nudged(scene: Scene, sense: int, size: float) -> Scene:
    """The scene with every driver moved a little further, each by a different amount."""
    drivers = []
    for number, driver in enumerate(scene.drivers, 1):
        whole = 1.0 if driver.kind == "turn" else size
        drivers.append(further(scene, driver, float(NUDGE) * sense * number * whole))
    return replace(scene, drivers=tuple(drivers))


def further(scene: Scene, driver: Driver, step: float) -> Driver:
    """A driver with its position increased by ``step`` (rad, m)."""
    position = driver.position
    factor, of_pi = SI[position.unit]
    written = Fraction(step) / factor / (Fraction(pi) if of_pi else 1)
    value = Fraction(position.number(scene.values)) + written
    return replace(driver, position=exact(value, position.unit, position.place))


def spare(scene: Scene, name: str) -> bool:
    """Whether a link could be left out: no driver moves it, and it guides no other link."""
    driven = {end for driver in scene.drivers for end in (driver.link, driver.against)}
    links = scene.links.values()
    carriers = {path.on for link in links for path in link.paths}
    return name not in driven | carriers | {FRAME}


def without_link(scene: Scene, name: str) -> Scene:
    """The mechanism without a link and without drivers, for counting only."""
    links = {other: link for other, link in scene.links.items() if other != name}
    return replace(scene, links=links, drivers=())


def parts_without(scene: Scene) -> Iterator[tuple[str, Scene]]:
    """The mechanism without one spare path and without drivers, with the name of that path.

    A spare path is the track of a wheel, or a further guide of a block.
    """
    for link in scene.links.values():
        for path in link.spare_paths:
            links = {**scene.links, link.name: link.without(path)}
            yield path.named(link.name), replace(scene, links=links, drivers=())


# --- the text of check on how a mechanism is put together: pairs, count, loops, drivers, groups ---


MOST_LOOPS = 24
"""The most rings of four links listed."""
NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight")


def structure(scene: Scene) -> Iterator[str]:
    """Links, pairs, the count of freedoms, and the drivers.

    Raises StructureError, after the links, for wheels that do not touch.
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
    yield from labelled("put in", [*keeper_lines(scene), *module_lines(scene)])


def keeper_lines(scene: Scene) -> Iterator[str]:
    """A line for each guide and each link that the program added to the scene.

    A guide is added for rollers of one size, a link to keep a wheel on its track.
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


def module_lines(scene: Scene) -> Iterator[str]:
    """A line for each module that the teeth and a distance give, or that the program proposes."""
    found: dict[tuple[str, str], list[str]] = {}
    for link in scene.every_link:
        for wheel in link.wheels:
            if wheel.sized and wheel.radius is not None and wheel.teeth is not None:
                size = 2 * wheel.radius.number(scene.values) / wheel.teeth.number(scene.values)
                module = f"{float(size):.6g} {wheel.radius.written_unit}"
                whose = link_words(link.name)
                teeth = wheel.teeth.written(scene.values)
                found.setdefault((wheel.sized, module), []).append(f"{teeth} ({whose})")
    for (sized, module), wheels in found.items():
        many = f"the wheels with {listed(wheels)} teeth"
        if sized == "distance":
            yield f"module {module} of {many}: it follows from the distance of the centres"
        else:
            yield f"module {module} of {many}: proposed, as the scene has no length for them;"
            yield "  angular velocities do not depend on it, velocities of points do"


# --- pairs and the count -------------------------------------------------------------------------


def count_notes(scene: Scene) -> Iterator[str]:
    """Cases that are easily miscounted: pins of several links, and pairs that take one freedom."""
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
    """The number of independent closed loops, and the links that turn fully in each single one."""
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
    """A loop of four links: its class, the rule that decides it, and what it means for drivers."""
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
    """The links that turn fully against the others."""
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
    """Whether a turning driver of a loop turns fully there; empty if it is not in the loop."""
    ends = {driver.link, driver.against}
    if driver.kind != "turn" or not ends <= set(loop.links):
        return ""
    against = "" if driver.against == FRAME else f" against link {driver.against}"
    name = f"in this loop the driver of link {driver.link}{against}"
    if ends.isdisjoint(loop.turning):
        return f"{name} cannot turn fully: dead points end its range"
    return f"{name} turns fully"


def ring(loop: Loop) -> str:
    return "–".join(loop.links)


def written(scene: Scene, length: float) -> str:
    """A length (m) as a number in the unit of the scene."""
    return f"{length / float(SI[unit(scene)][0]):.6g}"


def unit(scene: Scene) -> str:
    return scene.units["length"]


# --- drivers and groups --------------------------------------------------------------------------


def driver_words(scene: Scene, driver: Driver) -> str:
    """The motion of a driver, in the units of the scene, with these parameters."""
    found = [
        f"{quantity.written(scene.values)} {quantity.unit}".strip()
        for quantity in (driver.position, driver.speed, driver.acceleration)
    ]
    at = f"at {found[0]}, speed {found[1]}"
    at += "" if driver.acceleration.is_zero() else f", acceleration {found[2]}"
    return f"link {driver.link} {driver.kind}s against {link_words(driver.against)}: {at}"


def group_lines(groups: tuple[Group, ...]) -> list[str]:
    return [f"{i}. {group.words}" for i, group in enumerate(groups, 1)]


# --- the text of check: what a scene is made of, how it closes, how well it can be drawn ----------


WORST = 3
"""The number of flattest crossings shown."""


class Checking:
    """The check of a mechanism, part by part.

    Problems are collected, and the parts that can be checked are still shown.
    """

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
            yield from labelled(
                "branches", translated(self.mechanism.written.branches, scene.branches)
            )
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
            yield from labelled("forces", self.forces())
            yield from labelled("travel", self.travel())
            self.scale_factors()
        except GraphkinError as error:
            self.problems += error.problems

    def forces(self) -> list[str]:
        """How far the other routes are from the constructed forces; a difference is a doubt."""
        given = self.mechanism.scene.forces
        found = self.mechanism.forces() if given is not None and given.asked else None
        if found is None:
            return []
        from graphkin.cli.report.force_report import force_verdict_words, witness_of_forces

        words = force_verdict_words(witness_of_forces(found[1]))
        self.doubts += [] if found[1].agrees else [words]
        return [words]

    def travel(self) -> list[str]:
        """The strokes, swings and time ratios that the scene asks for."""
        ask = self.mechanism.scene.ask
        if not (ask.strokes or ask.time_ratios):
            return []
        from graphkin.cli.report.cycle_report import length_words
        from graphkin.construction.core.quantities import BY_TARGET
        from graphkin.motion.follower_limits import travels
        from graphkin.motion.sweep import sweep_of

        sweep, lines = sweep_of(self.mechanism.scene), list[str]()
        for (quantity, name), found in travels(self.mechanism).items():
            unit = BY_TARGET[quantity].unit
            size = length_words(sweep, found.value) if unit == "m" else f"{found.value:.5g}{unit}"
            lines.append(f"{quantity} of link {name}: {size}")
        return lines

    def closing(self) -> Iterator[str]:
        """Closures of the dyads, and the driver's angles at which the mechanism closes."""
        mechanism = self.mechanism
        lines: list[str] = []
        try:
            groups, program = mechanism.laid
        except StructureError:  # the stated closure may have no room for an idle link
            groups = mechanism.groups
            program = write(mechanism.scene, groups, fitted=False)
        for choice in choices(mechanism.scene, groups, program, proving=True):
            lines += closure_lines(choice, mechanism.scene)
        stated = any(line.startswith("*") for line in lines)
        legend = ["(* as the scene says)"] if stated else []
        lines = lines or ["nothing to choose"]
        yield from labelled("closures", [*lines, *legend])
        if program is mechanism.program:  # the program raises where an idle link has no room
            yield from labelled("range", range_lines(mechanism))

    def rank(self) -> list[str]:
        """The true mobility in words; a wrong number of drivers for it is a problem.

        If nothing closes, the cause may be more drivers than the count leaves freedoms.
        """

        try:
            rank = Rank(self.mechanism)
        except ClosureError as error:
            doubt = driver_problem(self.mechanism.scene)
            raise ClosureError([*error.problems, *([doubt] if doubt else [])]) from error
        problem = driver_problem(self.mechanism.scene, rank.moving)
        self.problems += [problem] if problem else []
        return list(rank.lines())

    def witness(self, trace: Trace) -> str:
        """The verdict of the independent check; records a doubt if it does not agree."""
        try:
            verdict = self.mechanism.witness(gathered(trace))
        except WitnessError as error:
            self.doubts.append(f"the independent route cannot judge: {error}")
            return f"could not judge: {error}"
        if not verdict.agrees:
            self.doubts.append("the independent route does not agree with the construction")
        return verdict_words(verdict, self.mechanism.scene)

    def scale_factors(self) -> None:
        """Raise GraphkinError for scale factors in [sheet] that no sheet can keep.

        They are not checked if there are doubts, because then no sheet is handed out.
        """
        sheet = self.mechanism.scene.sheet
        states = sheet.scale or sheet.enlarge or sheet.ka or sheet.rule == "lab"
        if states and not self.doubts:
            from graphkin.documents.scaling import scales

            scales(self.mechanism)


DECIMALS = {"mm": 3, "cm": 4, "m": 6, "in": 3, "ft": 4}
"""The decimals of coordinates, by the unit of lengths."""


def closure_lines(choice: Choice, scene: Scene) -> list[str]:
    """Both closures of a dyad, with a mark on the chosen one."""
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
            unit = scene.units["length"]
            one, parts = 1 / float(LENGTHS[unit]), (closure.place.real, closure.place.imag)
            x, y = (f"{one * part + 0.0:.{DECIMALS[unit]}f}" for part in parts)
            where = f"({x}, {y}) {unit}"
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
    """The positions of the driver at which the mechanism closes, for a single driver."""
    if len(mechanism.scene.drivers) != 1:
        return ["not swept: it is for mechanisms with one driver"]
    found = closing(mechanism.scene)
    if found.tried:
        return [found.bound]
    return [range_words(mechanism, found), *([found.bound] if found.bound else [])]


def range_words(mechanism: Mechanism, found: ClosingRanges) -> str:
    """The ranges of the only driver in which the mechanism closes."""
    scene, ranges = mechanism.scene, found.ranges
    turns = scene.drivers[0].kind == "turn"
    what = "angle" if turns else "position"
    if found.followed:
        reach = (
            "a whole turn" if turns and ranges == [(0.0, 360.0)] else reached_words(scene, ranges)
        )
        return f"the motion goes from the position of the scene through {reach} of the driver"
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
    """The angles assumed for links whose pins leave whole turns open."""
    found = []
    for step in trace.program.steps:
        link = counted_link(step)
        if link is None or (link in scene.unseen and scene.links[link].slides):
            continue
        angle, near = degrees(trace.value("turned", link)), degrees(trace.values[step.args[-1]])
        found += [
            f"link {link} is at {angle:.2f}°, the angle within half a turn of {near:g}°",
            "  its pins do not show how often it went round since the start of "
            f"{place_of_turns(scene, link)};",
            f"  turns = {{ {link} = … }} there says how many whole turns are to be added",
        ]
    return found


def crossing_lines(trace: Trace) -> list[str]:
    """The flattest crossings on paper: angle, part of the work, and point.

    ``trace`` holds the construction by hand of what is asked, including figures of components,
    plates and poles.
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
"""The largest pressure angle that textbooks advise for a sliding follower, in degrees."""
STEEP_LEVER = 45.0
"""The same for an oscillating follower."""


def cam_lines(scene: Scene) -> Iterator[str]:
    """The pressure angle and least radius of curvature of each cam, with a note on undercutting."""
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

    A flat follower has no pressure angle, unless it swings about a pivot off its face.
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
    """A place of a law: the angle in degrees, or the coordinate of a plate (given in m)."""
    return f"{at / METRES[unit]:.4g} {unit} of the law" if cam.slides else f"{at:.1f}° of the law"


def remedy(tip: str) -> str:
    """The remedy for undercutting."""
    smaller = " or a smaller roller" if tip == "roller" else ""
    return f"a larger base circle{smaller} mends it"


NEAR = 1e-9
"""The distance below which two pins coincide, as a fraction of the largest distance."""


def fallen_together(scene: Scene, trace: Trace) -> list[str]:
    """A sentence for each two pins that coincide though no link keeps them together.

    This closure is seldom the intended one, because a bar then lies on another. It also occurs
    where the scene has two names for one pin, so that its links are not joined.
    """
    places = pin_places(scene, trace)
    size = max((abs(p - q) for p, q in combinations(places.values(), 2)), default=0.0)
    return [
        sentence(scene, one, other)
        for one, other in combinations(places, 2)
        if abs(places[one] - places[other]) <= NEAR * size and not kept(scene, one, other)
    ]


def pin_places(scene: Scene, trace: Trace) -> dict[str, complex]:
    """The positions of the points that join links."""
    pins = [point for point, links in sharers(scene).items() if len(links) > 1]
    found = {pin: trace.value("position", pin) for pin in pins}
    return {pin: complex(place) for pin, place in found.items() if place is not None}


def kept(scene: Scene, one: str, other: str) -> bool:
    """Whether one link has both points."""
    every = scene.every_link
    return any(one in link.points and other in link.points for link in every)


def sentence(scene: Scene, one: str, other: str) -> str:
    """A sentence that two pins coincide, with their links and what to do."""
    owners = sharers(scene)
    who = [f"{pin} of {listed(map(link_words, owners[pin]))}" for pin in (one, other)]
    return (
        f"{who[0]} falls on {who[1]} in this closure; "
        "if that is not meant, take another closure or another position of the driver"
    )


def house_lines(house: House) -> Iterator[str]:
    """The conventions that differ from the usual ones, by their keys."""
    settings = list(stated(house))
    for name, value in settings:
        yield from labelled(name, [value], 9)
    if not settings:
        yield "all conventions are the usual ones"


def stated(house: House) -> Iterator[tuple[str, str]]:
    """The name and the value of each convention that is stated."""
    for each in fields(House):
        value = getattr(house, each.name)
        if value == getattr(PLAIN, each.name) or each.name in ("text", "signs"):
            continue
        if house.logo is not None and each.name == "logo":
            yield "logo", house.logo.name
        elif isinstance(value, tuple):
            yield (
                each.name,
                "; ".join(f"{one:g}" if isinstance(one, float) else one for one in value),
            )
        elif isinstance(value, dict):
            yield each.name, ", ".join(f"{key}: {label}" for key, label in value.items())
        else:
            yield each.name, str(value)
    own = [(name, getattr(house.signs, name)) for name in NAMES]
    changed = [f"{name} {sign}" for name, sign in own if sign != getattr(USUAL, name)]
    if changed:
        yield "signs", ", ".join(changed)
