"""The count of freedoms, in the plane and in space, and the check that drivers equal freedoms."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import combinations

from msgspec import Struct
from msgspec.structs import replace

from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Driver, Link, Scene, Slide, link_words
from graphkin.scene.phrases import quoted
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import (
    CamFollower,
    CoupledTrain,
    Crank,
    Driven,
    Group,
    Higher,
    Spun,
    Stretched,
    Tie,
    Unresolved,
)
from graphkin.structure.pairs import Pin, all_pairs, sharers
from graphkin.structure.turning import LEVEL, guide_line, metres
from graphkin.text.errors import (
    NO_WORDS,
    Change,
    DriverAdded,
    DriverTaken,
    Message,
    PointRenamed,
    Problem,
    StructureError,
    Written,
    joined,
    message,
)

APART = 1e-9
"""Distance of parallel guides (m) below which they count as one line."""


def impossible(scene: Scene) -> list[Problem]:
    """The problems of all guides, wheels and drivers that cannot work as written."""
    return [*wheels_alone(scene), *double_guides(scene), *unknown_leans(scene), *unturnable(scene)]


def wheels_alone(scene: Scene) -> Iterator[Problem]:
    """The problems of wheels without a contact; the module for them is loaded only for wheels."""
    if any(link.wheels for link in scene.every_link):
        from graphkin.structure.touching_wheels import lone_wheels

        yield from lone_wheels(scene)


def double_guides(scene: Scene) -> Iterator[Problem]:
    """Problems of blocks with two guides on one link, unless both lie on one line (one is idle)."""
    for link in scene.links.values():
        for first, second in combinations(link.slides, 2):
            if first.on == second.on and (hinders := between_guides(scene, first, second)):
                yield Problem(
                    f"links.{link.name}.slides",
                    hinders,
                    message("one guide on one link"),
                    message("leave one out, or give the other a block of its own"),
                )


def between_guides(scene: Scene, first: Slide, second: Slide) -> Message:
    """Why a block cannot move on two guides of one link; empty where the guides are one line."""
    one, other = guide_line(scene, first), guide_line(scene, second)
    on = link_words(first.on)
    if abs(cross(one.along, other.along)) > LEVEL:
        return message("two guides on {on} cross, so that the block is held fast", on=on)
    shifts = [metres(scene, slide.offset) for slide in (first, second)]
    sense = 1 if (one.along.conjugate() * other.along).real > 0 else -1
    gap = cross(one.along, other.point - one.point) + sense * shifts[1] - shifts[0]
    if abs(gap) <= APART:
        return NO_WORDS
    return message(
        "two guides on {on} are parallel, {gap:.6g} mm apart: no block is on both",
        on=on,
        gap=1e3 * abs(gap),
    )


def unknown_leans(scene: Scene) -> Iterator[Problem]:
    """Problems of further guides of a block, on links whose angle to the block is not stated."""
    for link in scene.links.values():
        for slide in link.slides[1:]:
            if slide.on in turning_with(scene, link.name, first=True):
                continue
            if slide.on == FRAME:
                expected = message("the guide on the frame first, the other from the other side")
            else:
                expected = message(
                    "the guide from the other side: slides = {{ on = {name}, through, angle }} "
                    "in links.{on}",
                    name=quoted(link.name),
                    on=slide.on,
                )
            yield Problem(
                f"links.{link.name}.slides",
                message(
                    "the angle between this block and {on} is not known, for a block's x "
                    "axis lies along its first guide",
                    on=link_words(slide.on),
                ),
                expected,
            )


def unturnable(scene: Scene) -> Iterator[Problem]:
    """Problems of drivers that turn a link against another that slides hold in direction."""
    for index, driver in enumerate(scene.drivers):
        if driver.kind == "turn" and driver.against in turning_with(scene, driver.link):
            link, own = scene.link(driver.link), quoted(driver.link)
            yield Problem(
                f"drivers[{index}].turn",
                message(
                    "link {link} cannot turn against {against}: slides join them",
                    link=driver.link,
                    against=link_words(driver.against),
                ),
                message("slide = {can}", can=own)
                if link.slides
                else message("a link that a pin joins"),
                changes=(Written(own, "slide", "turn"),) if link.slides else (),
            )


def turning_with(scene: Scene, name: str, *, first: bool = False) -> set[str]:
    """The links that slides join to a link, one by one, so that it cannot turn against them.

    ``first`` uses only the first guide of each block.
    """
    joined = [
        {link.name, slide.on}
        for link in scene.links.values()
        for slide in (link.slides[:1] if first else link.slides)
    ]
    found = {name}
    while more := {link for pair in joined if pair & found for link in pair} - found:
        found |= more
    return found


# --- the count of freedoms, in the plane and in space, and as many drivers as freedoms ------------


class Count(Struct, frozen=True):
    """Moving links, pairs that remove two freedoms, and pairs that remove one.

    ``pairs`` are pins, slides, and wheels held only by their track. ``singles`` are teeth, tracks,
    and wheels in contact at a distance that an arm already keeps.
    """

    moving: int
    pairs: int
    singles: int = 0

    @property
    def mobility(self) -> int:
        """Gruebler's mobility: three freedoms per moving link, less those that the pairs remove."""
        return gruebler(self.moving, self.pairs, self.singles)

    @property
    def loops(self) -> int:
        """Independent closed loops: pairs in excess of those in a tree of as many links."""
        return self.pairs + self.singles - self.moving

    @property
    def sum(self) -> str:
        """The sum as written, for example 3·5 − 2·7."""
        return f"3·{self.moving} − 2·{self.pairs}" + (
            f" − 1·{self.singles}" if self.singles else ""
        )

    @property
    def words(self) -> str:
        """The sum with its result, for example 3·5 − 2·7 = 1."""
        return f"{self.sum} = {self.mobility}".replace("= -", "= −")


def count(scene: Scene) -> Count:
    """Gruebler's count of a scene, in which a pin of k links counts as k - 1 pairs.

    Links added to keep wheels on their tracks count with the pair that they represent. Raises
    StructureError for wheels that do not touch.
    """
    bare = scene.bare
    every = all_pairs(bare)
    singles = sum(pair.taken == 1 for pair in every)
    return Count(len(bare.links), len(every) - singles, singles)


def gruebler(moving: int, lower: int, higher: int = 0) -> int:
    """Freedoms in the plane: 3 per moving link, less 2 per lower pair and 1 per higher pair.

    Lower pairs are pins and slides. Higher pairs are cams, teeth and belts. Springs remove nothing.
    """
    return 3 * moving - 2 * lower - higher


RANK = message("the rank of the constraints")


def refuse_drivers(scene: Scene, groups: Sequence[Group]) -> None:
    """Raise StructureError where the structure alone shows that the drivers are wrong.

    The cases are:

    - guides or wheels that cannot work as written;
    - too few drivers by the count, which never exceeds the true mobility;
    - drivers without which all links still follow;
    - two drivers for one motion, and none for others.

    Otherwise, a count below the number of drivers decides nothing, because a link may be idle. Then
    ``refuse_wrong_drivers`` decides by the rank.
    """
    wrong = impossible(scene)
    if wrong:
        raise StructureError(wrong)
    freedoms, drivers = count(scene).mobility, len(scene.drivers)
    if freedoms > drivers:
        refuse_wrong_drivers(scene)
    if freedoms < drivers and spare_drivers(scene):
        refuse_wrong_drivers(scene, enough(scene), message("the order of the groups"))
    ties = [group.link for group in groups if isinstance(group, Tie)]
    loose = [link for group in groups if isinstance(group, Unresolved) for link in group.links]
    if ties and loose:
        raise StructureError(misplaced(scene, ties, loose))
    known = {FRAME, *(link for group in groups for link in group.links)} - {*loose}
    idle = [each for each in unused(scene, groups) if {each.link, each.against} <= known]
    if idle and loose:
        raise StructureError([driven_twice(scene, driver, loose) for driver in idle])
    backwards = [] if loose else [*driven_cams(scene, groups)]
    if backwards:
        raise StructureError(backwards)


def driven_cams(scene: Scene, groups: Sequence[Group]) -> Iterator[Problem]:
    """The cams whose followers are placed before them: a law gives the follower from its cam."""
    parts = [
        each for one in groups for each in (one.members if isinstance(one, Higher) else (one,))
    ]
    for follower, cam in scene.cams.items():
        if any(isinstance(each, CamFollower) and follower in each.links for each in parts):
            continue
        mover, way = (cam.carrier if cam.on == FRAME else cam.on), "slide" if cam.slides else "turn"
        direct = [index for index, each in enumerate(scene.drivers) if each.link == follower]
        place, changes = f"links.{follower}.cam.on", tuple[Change, ...]()
        if direct:
            kind = scene.drivers[direct[0]].kind
            place, changes = f"drivers[{direct[0]}].{kind}", (Written(quoted(mover), way, kind),)
        yield Problem(
            place,
            message(
                "link {follower} is known before the law of its cam sets it", follower=follower
            ),
            message(
                "drivers that move the cam, which then moves link {follower}", follower=follower
            ),
            message("write {way} = {mover}", way=way, mover=quoted(mover)),
            changes,
        )


def refuse_wrong_drivers(scene: Scene, true: int | None = None, by: Message = RANK) -> None:
    """Raise StructureError unless there are as many drivers as freedoms.

    ``true`` is the true mobility, and ``by`` names its source, the rank. Without it the count
    decides.
    """
    problem = driver_problem(scene, true, by)
    if problem is not None:
        raise StructureError(problem)


def driver_problem(scene: Scene, true: int | None = None, by: Message = RANK) -> Problem | None:
    """The problem of a wrong number of drivers; None if it equals the freedoms."""
    counted = count(scene)
    freedoms = counted.mobility if true is None else true
    drivers = len(scene.drivers)
    if freedoms == drivers:
        return None
    sum_, mobility = counted.sum.replace("−", "-"), counted.mobility
    if freedoms != mobility:
        leaves = message("the count {sum} leaves {mobility}", sum=sum_, mobility=mobility)
        leaves = message(
            "{by} leaves {freedoms} ({leaves})", by=by, freedoms=freedoms, leaves=leaves
        )
    elif freedoms == 1:
        leaves = message("the count {sum} leaves 1 freedom", sum=sum_)
    else:
        leaves = message("the count {sum} leaves {mobility} freedoms", sum=sum_, mobility=mobility)
    about: tuple[tuple[str, ...], ...] = ()
    if freedoms > drivers:
        hint, changes = too_few_hint(scene)
        about = tuple(each.path for each in lone_points(scene)[:1])
    else:
        hint = too_many_hint(scene, freedoms, certain=true is not None)
        changes = too_many_changes(scene, freedoms)
    found = message("{drivers} given, but {leaves}", drivers=drivers, leaves=leaves)
    return Problem("drivers", found, message("as many drivers as freedoms"), hint, changes, about)


def too_few_hint(scene: Scene) -> tuple[Message, tuple[Change, ...]]:
    """Words for a driver to add, or for what seems to be missing, and the change that they name."""
    loose, alike = [each.words for each in lone_points(scene)], alike_points(scene)
    changes: tuple[Change, ...] = () if alike is None else (alike,)
    if loose or changes:
        reasons = [message("only one link has the points {names}", names=joined(", ", loose))]
        reasons = reasons if loose else []
        if alike is not None:
            reasons.append(
                message(
                    "did you mean {new} where link {link} has {old}?",
                    new=alike.new,
                    link=alike.link,
                    old=alike.old,
                )
            )
        said = message(
            "add a driver, or a pin is missing: {reasons}", reasons=joined("; ", reasons)
        )
        return said, changes
    free = drivable(scene)
    if not free:
        return message("add a driver"), ()
    line = f"turn = {quoted(free[0])}"
    return message("add a driver, such as {line}", line=line), (DriverAdded(line),)


def too_many_changes(scene: Scene, freedoms: int) -> tuple[Change, ...]:
    """The removal of each driver without which all links still follow, if there is one too many."""
    if freedoms <= 0 or len(scene.drivers) - freedoms != 1:
        return ()
    return tuple(DriverTaken(each.kind, quoted(each.link)) for each in spare_drivers(scene))


def too_many_hint(scene: Scene, freedoms: int, *, certain: bool) -> Message:
    """Words for the drivers of which some are to be removed; the count alone is not ``certain``."""
    if freedoms <= 0:
        twins = same_pins(scene)
        if twins:
            return message("nothing can move: {twins}", twins=twins)
        stuck = message("nothing can move, unless a constraint is idle")
        if certain:
            stuck = message("nothing can move")
        return message(
            "{stuck}; or a block is missing: a pin in a slot is a link of its own", stuck=stuck
        )
    names = [driver_name(driver) for driver in spare_drivers(scene) or scene.drivers]
    surplus = len(scene.drivers) - freedoms
    if surplus == len(names) == 1:
        return message("take {name} away: its motion follows from the rest", name=names[0])
    away = message("one driver") if surplus == 1 else message("{count} drivers", count=surplus)
    return message(
        "take {away} away, of {names}: its motion follows from the rest",
        away=away,
        names=joined(", ", names),
    )


def same_pins(scene: Scene) -> Message:
    """Words for two links that share two pins and so are one body; empty if there are none."""
    for one, other in combinations(scene.every_link, 2):
        shared = [point for point in one.points if point in other.points]
        if len(shared) > 1:
            return message(
                "{one} and link {other} share the pins {first} and {second}, so that they are one "
                "body",
                one=link_words(one.name),
                other=other.name,
                first=shared[0],
                second=shared[1],
            )
    return NO_WORDS


def spare_drivers(scene: Scene) -> list[Driver]:
    """The drivers without which all links still follow, dyad after dyad.

    Groups of higher class and coupled trains prove nothing: the link or pair that closes them, such
    as a second planet's, may be idle.
    """
    return [driver for driver in scene.drivers if follows(without(scene, driver))]


def enough(scene: Scene) -> int:
    """The number of drivers left when redundant ones are removed."""
    for driver in scene.drivers:
        rest = without(scene, driver)
        if follows(rest):
            return enough(rest)
    return len(scene.drivers)


def without(scene: Scene, driver: Driver) -> Scene:
    """The scene without one of its drivers."""
    return replace(scene, drivers=tuple(each for each in scene.drivers if each is not driver))


def follows(scene: Scene) -> bool:
    """Whether every link follows from the drivers by dyads and wheels."""
    proofless = CoupledTrain | Higher | Unresolved
    return not any(isinstance(group, proofless) for group in decompose(scene))


def misplaced(scene: Scene, ties: Sequence[str], loose: Sequence[str]) -> Problem:
    """The problem of a link that closes what is driven already, while other links are free."""
    from graphkin.structure.touching_wheels import keeper_hint

    drivers, points = len(scene.drivers), lone_points(scene)
    lone = joined(", ", (each.words for each in points))
    tie = (
        message("link {on}", on=ties[0])
        if len(ties) == 1
        else message("links {ties}", ties=", ".join(ties))
    )
    hints = [
        message(
            "let a driver move link {link} instead, or add one if {tie} is idle",
            link=loose[0],
            tie=tie,
        ),
        message("or a pin is missing: only one link has the points {lone}", lone=lone)
        if lone
        else NO_WORDS,
        guide_hint(scene, ties, loose),
        keeper_hint(scene, loose),
    ]
    return Problem(
        "drivers",
        message(
            "{drivers} given, but {tie} would join what is driven already, while {hanging}",
            drivers=drivers,
            tie=tie,
            hanging=hanging(loose),
        ),
        message("a driver for each freedom"),
        joined("; ", hints),
        about=tuple(each.path for each in points[:1]),
    )


def guide_hint(scene: Scene, ties: Sequence[str], loose: Sequence[str]) -> Message:
    """Words for a block whose guide was perhaps meant to lie on a free link."""
    block = next((name for name in ties if scene.links[name].slides), None)
    if block is None:
        return NO_WORDS
    where = quoted(loose[0])
    return message(
        "or, if the guide of block {block} lies on link {loose}, write on = {where}",
        block=block,
        loose=loose[0],
        where=where,
    )


def unused(scene: Scene, groups: Sequence[Group]) -> list[Driver]:
    """The drivers that belong to no group."""
    taken = list[Driver]()
    for group in groups:
        nested = group.nested if isinstance(group, Higher) else ()
        parts = group.members if isinstance(group, Higher) else (group,)
        taken += [part.driver for part in parts if isinstance(part, Crank | Driven | Spun)]
        taken += [each for part in parts if isinstance(part, Stretched) for each in part.drivers]
        taken += [each.last for each in nested if isinstance(each.last, Driver)]
    return [driver for driver in scene.drivers if driver not in taken]


def driven_twice(scene: Scene, driver: Driver, loose: Sequence[str]) -> Problem:
    """The problem of a driver whose link other drivers move already, while other links are free."""
    return Problem(
        f"drivers[{scene.drivers.index(driver)}]",
        message(
            "the other drivers move link {link} already, while {hanging}",
            link=driver.link,
            hanging=hanging(loose),
        ),
        message("one driver for each freedom"),
        message("let it move link {loose} instead", loose=loose[0]),
    )


def hanging(loose: Sequence[str]) -> Message:
    """Words for links that no driver moves."""
    if len(loose) == 1:
        return message("no driver moves link {name}", name=loose[0])
    return message("no driver moves links {names}", names=", ".join(loose))


def drivable(scene: Scene) -> list[str]:
    """Links that are pinned to the frame and not driven."""
    driven, scene = {driver.link for driver in scene.drivers}, scene.bare
    pinned = [
        link
        for point, links in sharers(scene).items()
        if point in scene.frame.points
        for link in links
        if link != FRAME and link not in driven
    ]
    return list(dict.fromkeys(pinned))


class LonePoint(Struct, frozen=True):
    """A point that belongs to one link only."""

    point: str
    link: str

    @property
    def words(self) -> Message:
        """The point with its link."""
        owner = message("the frame") if self.link == FRAME else self.link
        return message("{point} ({owner})", point=self.point, owner=owner)

    @property
    def path(self) -> tuple[str, ...]:
        """The point's key in a scene's text, after the table of its link."""
        return ("frame", self.point) if self.link == FRAME else ("links", self.link, self.point)


def lone_points(scene: Scene) -> list[LonePoint]:
    """The points at which a pin may be missing, each with its link.

    They are points of a single link that has only one joint and no driver, and unused points of the
    frame.
    """
    owners = sharers(scene)
    led = [pair for pair in all_pairs(scene) if not isinstance(pair, Pin)]
    joined = Counter(link for pair in led for link in pair.links)
    joined.update(link for links in owners.values() if len(links) > 1 for link in links)
    driven = {driver.link for driver in scene.drivers}
    ends = {name for name in scene.links if joined[name] < 2 and name not in driven}
    used = {name for link in scene.links.values() for name in points_used(link)}
    if ends:
        ends.add(FRAME)
    return [
        LonePoint(point, links[0])
        for point, links in owners.items()
        if len(links) == 1 and links[0] in ends and point not in used
    ]


def alike_points(scene: Scene) -> PointRenamed | None:
    """A suggested renaming of a point that seems to be a misspelling of another link's point.

    One name equals the other with one letter or digit added, and its link does not have the other
    point.
    """
    owners = sharers(scene)
    lone = [point for point, links in owners.items() if len(links) == 1]
    for point in lone:
        own = owners[point][0]
        others = [p for p in (*lone, *owners) if p not in scene.link(own).points]
        near = [p for p in others if begins(p, point) or begins(point, p)]
        if own != FRAME and near:
            return PointRenamed(own, point, near[0])
    return None


def begins(short: str, long: str) -> bool:
    """Whether a name equals another with one character more, ignoring case."""
    return len(long) == len(short) + 1 and long.lower().startswith(short.lower())


def points_used(link: Link) -> Iterator[str]:
    """The points that define a link's guides and tracks, and the centres of its wheels."""
    for joint in link.paths:
        if isinstance(joint.through, str):
            yield joint.through
        if isinstance(joint, Slide):
            yield from joint.along or ()
    for wheel in link.wheels:
        yield wheel.centre


def driver_name(driver: Driver) -> str:
    """A driver in short, as written: turn = 1."""
    return f"{driver.kind} = {quoted(driver.link)}"
