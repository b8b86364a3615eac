"""An imported mechanism as the text of a scene, in the closure nearest to the drawing."""

from __future__ import annotations

import re
from cmath import phase, rect
from collections.abc import Iterator
from contextlib import contextmanager
from json import dumps
from math import degrees, inf
from pathlib import PurePath

from msgspec import Struct

from graphkin.construction.core.branches import key_of
from graphkin.diagnosis.closures import Choice, GroupClosure, choices
from graphkin.importing.record import (
    FARTHEST,
    DrawnGear,
    DrawnGuide,
    DrawnInput,
    DrawnLink,
    DrawnLoad,
    Imported,
    named,
    refused,
)
from graphkin.mechanism import Mechanism
from graphkin.scene.model import FRAME
from graphkin.scene.quantity import METRES
from graphkin.scene.read_scene import read_text
from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import count
from graphkin.structure.groups import Dyad, Group, Higher, Stretched
from graphkin.structure.pairs import Pin
from graphkin.text.errors import GraphkinError, Message, Problem, joined, message, verbatim

NAME = "import"
DIGITS = 9
"""Decimals of a number, so that lengths of a drawing close as it does."""
MOST_NAMES = 40
"""Names of the file in one error."""
SEEN = 20
"""Roundings of the file by which a closed position may differ from the drawing unnoticed."""


class SceneText(Struct, frozen=True):
    """A scene as text, and what of the mechanism has no counterpart in it."""

    text: str
    notes: tuple[Message, ...]


def scene_text(found: Imported, file: str = "") -> SceneText:
    """The scene of an imported mechanism; it names its notes in comments at its head.

    Its title is the name of its ``file``, or of the program where there is no file.

    Raises a GraphkinError where no scene can be made of it, with the file's names.
    """
    writer = SceneWriter(found, title_of(file) or f"Mechanism from {found.program}")
    with names_of_file(writer):
        branches = nearest_closures(writer)
        mechanism = Mechanism(read_text(writer.text(branches), NAME))
    notes = (*writer.notes, *moved(writer, mechanism))
    head = [f"# from {found.program}", *(f"# {named_whole(note)}" for note in notes)]
    return SceneText(writer.text(branches, head), notes)


LETTERED = 0x530
"""Latin, Greek and Cyrillic letters are below; the fonts of sheets have them."""


def title_of(file: str) -> str:
    """The name of a file as a title; empty where sheets could not letter it."""
    words = " ".join(PurePath(file).stem.replace("_", " ").split())
    is_lettered = all(sign.isprintable() and ord(sign) < LETTERED for sign in words)
    return f"{words[:1].upper()}{words[1:]}" if is_lettered else ""


@contextmanager
def names_of_file(writer: SceneWriter) -> Iterator[None]:
    """Add to an error of the scene which links and joints of the file its names are."""
    try:
        yield
    except GraphkinError as error:
        names = [
            message("{name} is {what}", name=name, what=verbatim(named(what)))
            for name, what in writer.names()
            if name != what
        ]
        if not names:
            raise
        legend = message("the names in the file: {names}", names=joined(", ", names[:MOST_NAMES]))
        raise type(error)((*error.problems, Problem(NAME, legend))) from None


def named_whole(note: Message) -> str:
    return "".join(sign for sign in note if sign.isprintable())


class SceneWriter:
    """The tables of a scene: points by the names of joints, links by numbers."""

    def __init__(self, found: Imported, title: str) -> None:
        self.found = found
        self.title = title
        self.notes = list(found.notes)
        self.guided = {guide.body for guide in found.guides}
        if len(self.guided) < len(found.guides):
            bodies = [guide.body for guide in found.guides]
            twice = next(own for own in bodies if bodies.count(own) > 1)
            raise refused(
                message("link {name} has two guides", name=named(found.bodies[twice].name)),
                message("one guide for each link"),
            )
        self.geared = {own for gear in found.gears for own in (gear.one, gear.other)}
        alone = self.guided | self.geared | {guide.on for guide in found.guides}
        fixed = {own for own, joint in found.joints.items() if joint.fixed}
        self.bodies: dict[str, DrawnLink] = {}
        for own, body in found.bodies.items():
            if len(fixed & {*body.joints}) > 1 and own not in self.guided:
                fixed |= {*body.joints}
            elif len(body.joints) > 1 or own in alone:
                self.bodies[own] = self.ordered(own, body, fixed)
            else:
                self.notes.append(
                    message("link {name} holds nothing and is left out", name=named(body.name))
                )
        if not self.bodies:
            raise refused(message("nothing in it moves"))
        self.leave_out_loose(fixed)
        for own in sorted(self.geared - self.bodies.keys()):
            raise refused(
                message("gear {name} does not move", name=named(found.bodies[own].name)),
                message("gears that turn"),
            )
        moving = {joint for body in self.bodies.values() for joint in body.joints}
        led = {j for g in found.guides if g.on not in self.bodies and g.along for j in g.along}
        self.fixed = [own for own in found.joints if own in fixed and own in moving | led]
        self.points = dict(
            point_names(found, [*self.fixed, *sorted(moving, key=[*found.joints].index)])
        )
        self.numbers = {own: str(number) for number, own in enumerate(self.bodies, 1)}
        self.at = {own: joint.at for own, joint in found.joints.items()}
        self.drivers = [each for each in found.inputs if each.body in self.bodies]
        self.loads = [each for each in found.loads if each.body in self.bodies]
        self.masses = {each.body: each for each in found.masses if each.body in self.bodies}
        if not self.drivers:
            self.drivers = self.some_drivers(fixed)

    def leave_out_loose(self, fixed: set[str]) -> None:
        """Leave out the links that hang together with nothing fixed, with a note for each."""
        ties = [
            {("link", own), *(("joint", joint) for joint in body.joints)}
            for own, body in self.bodies.items()
        ]
        ties += [{("link", guide.body), ("link", guide.on)} for guide in self.found.guides]
        ties += [{("link", gear.one), ("link", gear.other)} for gear in self.found.gears]
        held, rest = {("link", ""), *(("joint", joint) for joint in fixed)}, ties
        while joining := [tie for tie in rest if tie & held]:
            rest = [tie for tie in rest if not tie & held]
            held.update(*joining)
        loose = [own for own in self.bodies if ("link", own) not in held]
        for own in loose if len(loose) < len(self.bodies) else ():
            self.notes.append(
                message(
                    "link {name} is connected with nothing fixed and is left out",
                    name=named(self.bodies.pop(own).name),
                )
            )

    def ordered(self, own: str, body: DrawnLink, fixed: set[str]) -> DrawnLink:
        """A link with its sliding joint first, else its fixed one."""
        first = [guide.first for guide in self.found.guides if guide.body == own]
        joints = sorted(body.joints, key=lambda j: (j not in first, j not in fixed))
        return DrawnLink(body.name, tuple(joints))

    def some_drivers(self, fixed: set[str]) -> list[DrawnInput]:
        """As many drivers as freedoms, where the file has none: pivoted links before blocks."""
        pins = {own: [j for j in body.joints if j in fixed] for own, body in self.bodies.items()}
        free = [DrawnInput(own, 1.0, held[0]) for own, held in pins.items() if held]
        free += [DrawnInput(own, 1.0) for own in pins if own in self.guided and not pins[own]]
        if not free:
            raise refused(message("nothing in it is driven"))
        self.drivers = free[:1]
        freedoms = count(read_text(self.text({}), NAME)).mobility
        chosen = free[: max(1, freedoms)]
        for driver in chosen:
            self.notes.append(
                message(
                    "nothing is driven in the file; link {name} is, at speed 1",
                    name=self.numbers[driver.body],
                )
            )
        return chosen

    def names(self) -> Iterator[tuple[str, str]]:
        """The name in the scene and in the file of each link, then of each joint."""
        for own, number in self.numbers.items():
            yield number, self.bodies[own].name
        for own, point in self.points.items():
            yield point, self.found.joints[own].name

    def guide(self, own: str) -> DrawnGuide | None:
        return next((guide for guide in self.found.guides if guide.body == own), None)

    def way(self, guide: DrawnGuide) -> complex:
        """The direction of a guide as drawn, of length 1."""
        if guide.tube:
            return direction(self.at[guide.first] - self.at[guide.tube])
        if guide.along is None:
            return rect(1.0, guide.angle)
        one, other = guide.along
        return direction(self.at[other] - self.at[one])

    def axis(self, own: str) -> complex:
        """The direction of a link's x axis as drawn, of length 1."""
        if guide := self.guide(own):
            return self.way(guide)
        rod = (guide for guide in self.found.guides if guide.tube and guide.on == own)
        first, *others = self.bodies[own].joints
        if not others:
            return next(map(self.way, rod), 1 + 0j)
        second, *_ = others
        return direction(self.at[second] - self.at[first])

    def text(self, branches: dict[str, str], head: list[str] | None = None) -> str:
        """The text of the scene."""
        lines = [
            "graphkin = 1",
            *(head or []),
            f"title = {dumps(self.title, ensure_ascii=False)}",
            f'units = {{ length = "{self.found.unit}", angle = "deg", speed = "rev/min" }}',
            *(["gravity = true"] if self.found.gravity else []),
            "",
            "[frame]",
            *(f"{self.points[own]} = {pair(self.at[own])}" for own in self.fixed),
        ]
        for own in self.bodies:
            lines += ["", f"[links.{self.numbers[own]}]", *self.link(own), *self.mass(own)]
        for driver in self.drivers:
            lines += ["", "[[drivers]]", *self.driver(driver)]
        for load in self.loads:
            lines += ["", "[[loads]]", *self.load(load)]
        if branches:
            lines += ["", "[branches]", *(f'{key} = "{words}"' for key, words in branches.items())]
        return "\n".join([*lines, ""])

    def link(self, own: str) -> Iterator[str]:
        """The keys of a link: a bar by its length, others by coordinates in their own axes."""
        joints, guide = self.bodies[own].joints, self.guide(own)
        if guide is None and len(joints) == 2:
            one, other = joints
            length = plain(abs(self.at[other] - self.at[one]))
            yield f"{self.points[one]}-{self.points[other]} = {length}"
            yield from self.wheels(own)
            return
        axis = self.axis(own)
        for joint in joints:
            place = (self.at[joint] - self.at[joints[0]]) / axis
            if abs(place.imag) < self.found.rounding:
                place = complex(place.real, 0.0)
            yield f"{self.points[joint]} = {pair(place)}"
        yield from self.wheels(own)
        if guide is not None:
            yield f"slides = {{ {', '.join(self.slide(guide))} }}"

    def wheels(self, own: str) -> Iterator[str]:
        """The wheels of a link, and what they roll on."""
        gears = [gear for gear in self.found.gears if own in (gear.one, gear.other)]
        if sizes := self.sizes(own):
            centres = [f'{{ centre = "{self.points[c]}", radius = {plain(r)} }}' for c, r in sizes]
            yield f"wheels = [{', '.join(centres)}]"
        for kind, belt in (("rolls", False), ("belt", True)):
            if said := [
                self.contact(gear) for gear in gears if gear.belt is belt and own == gear.other
            ]:
                yield f"{kind} = [{', '.join(said)}]"

    def sizes(self, own: str) -> list[tuple[str, float]]:
        """The wheels of a link, each once, by their centres and radii."""
        gears = (gear for gear in self.found.gears if own in (gear.one, gear.other))
        return [*dict.fromkeys(self.wheel(gear, own) for gear in gears)]

    def wheel(self, gear: DrawnGear, own: str) -> tuple[str, float]:
        """The centre and the radius of one of two wheels.

        Gears touch between their centres. A belt leaves half of their distance between the larger
        wheel and a wheel of its size.
        """
        one, other = gear.sizes
        apart = abs(self.at[gear.centres[1]] - self.at[gear.centres[0]])
        unit = apart / (4 * max(one, other) if gear.belt else one + other)
        which = 0 if own == gear.one else 1
        return gear.centres[which], round(unit * gear.sizes[which], DIGITS)

    def contact(self, gear: DrawnGear) -> str:
        """The words of a wheel on another, as they are drawn."""
        starts = (
            f"{self.numbers[own]} = {plain(degrees(phase(self.axis(own))))}"
            for own in dict.fromkeys((gear.one, gear.other, *self.arm(gear)))
        )
        said = f"on = {self.numbers[gear.one]}, start = {{ {', '.join(starts)} }}"
        if gear.belt:
            owns = (gear.other, gear.one)
            which = [1 + self.sizes(own).index(self.wheel(gear, own)) for own in owns]
            said += f", wheels = {which}"
        return f"{{ {said} }}"

    def arm(self, gear: DrawnGear) -> list[str]:
        """The moving link that has both centres."""
        return [own for own, body in self.bodies.items() if {*gear.centres} <= {*body.joints}][:1]

    def slide(self, guide: DrawnGuide) -> Iterator[str]:
        """The words of a guide."""
        yield f"on = {self.numbers.get(guide.on, FRAME)}"
        if guide.tube:
            yield f'through = "{self.points[guide.tube]}"'
            yield "angle = 0"
            return
        if guide.along is None:
            origin, axis = 0j, 1 + 0j
            if guide.on in self.bodies:
                origin, axis = self.at[self.bodies[guide.on].joints[0]], self.axis(guide.on)
            yield f"through = {pair((self.at[guide.first] - origin) / axis)}"
            yield f"angle = {plain(degrees(phase(self.way(guide) / axis)))}"
            return
        one, other = guide.along
        yield f'along = "{self.points[one]}-{self.points[other]}"'
        off = self.aside(guide)
        if abs(off) > 2 * self.found.rounding:
            yield f"offset = {plain(off)}"

    def aside(self, guide: DrawnGuide) -> float:
        """How far to the left of its guide a joint is drawn."""
        assert guide.along is not None
        return ((self.at[guide.first] - self.at[guide.along[0]]) / self.way(guide)).imag

    def mass(self, own: str) -> Iterator[str]:
        """The keys of a link's mass."""
        if held := self.masses.get(own):
            yield f"mass = {held.mass:.{DIGITS}g}"
            yield f'centre = "{self.points[held.centre]}"'
            yield f"inertia = {held.inertia:.{DIGITS}g}"

    def load(self, load: DrawnLoad) -> Iterator[str]:
        """The keys of a load."""
        yield f'at = "{self.points[load.joint]}"'
        yield f"link = {self.numbers[load.body]}"
        yield f"force = {pair(load.force)}"

    def driver(self, driver: DrawnInput) -> Iterator[str]:
        """The keys of a driver."""
        number = self.numbers[driver.body]
        if driver.about:
            axis = self.axis(driver.body)
            yield f"turn = {number}"
            if driver.against in self.numbers:
                yield f"against = {self.numbers[driver.against]}"
                axis /= self.axis(driver.against)
            yield f"angle = {plain(degrees(phase(axis)))}"
        else:
            guide = self.guide(driver.body)
            assert guide is not None
            start = self.at[guide.tube or (guide.along[0] if guide.along else guide.first)]
            yield f"slide = {number}"
            yield f"position = {plain(((self.at[guide.first] - start) / self.way(guide)).real)}"
        yield f"speed = {plain(driver.speed)}"


def nearest_closures(writer: SceneWriter) -> dict[str, str]:
    """The branches of every group, chosen one group after another by the drawing."""
    scene = read_text(writer.text({}), NAME)
    branches = {}
    for group in decompose(scene):
        if key := key_of(scene, group):
            branches[key] = first_words(writer, group)
    known: set[str] = set()
    while True:
        mechanism = Mechanism(read_text(writer.text(branches), NAME))
        found = choices(mechanism.scene, *mechanism.laid)
        choice = next((c for c in found if c.key in branches and c.key not in known), None)
        if choice is None:
            return branches
        known.add(choice.key)
        if not choice.closures:
            continue
        best = min(choice.closures, key=lambda closure: distance(writer, choice, closure))
        branches[choice.key] = best.words


def first_words(writer: SceneWriter, group: Group) -> str:
    """A branch that a group may have; of three pins, that of the drawing."""
    group = group.dyad if isinstance(group, Stretched) else group
    if isinstance(group, Higher):
        return "closure 1"
    if isinstance(group, Dyad) and group.type == "RRR" and isinstance(group.inner, Pin):
        places = {writer.points[own]: writer.at[own] for own in writer.points}
        pins = [pair.point for pair in (group.left, group.right) if isinstance(pair, Pin)]
        outer = [point.partition("@")[0] for point in pins]  # P@2 of a cylinder's tube: at P
        if len(outer) == 2 and places[outer[0]] != places[outer[1]]:
            one, other = outer
            turn = (places[group.inner.point] - places[one]) / (places[other] - places[one])
            return f"{'left' if turn.imag > 0 else 'right'} of {one}-{other}"
    return "forward"


def distance(writer: SceneWriter, choice: Choice, closure: GroupClosure) -> float:
    """How far a closure is from the drawing, in the file's unit."""
    if closure.place is None:
        return inf
    metre = METRES[writer.found.unit]
    places = {writer.points[own]: writer.at[own] for own in writer.points}
    owns = {number: own for own, number in writer.numbers.items()}
    size = max(
        abs(one - writer.at[writer.fixed[0]]) if writer.fixed else abs(one)
        for one in places.values()
    )
    total = 0.0
    for (what, name), value in closure.placed.items():
        if what == "position" and name in places:
            total += abs(value / metre - places[name])
        elif what == "axis" and name in owns:
            total += size * abs(value - writer.axis(owns[name]))
    return total


def moved(writer: SceneWriter, mechanism: Mechanism) -> Iterator[Message]:
    """A note for each point that cannot be where it is drawn."""
    metre = METRES[writer.found.unit]
    solved = mechanism.solve().points
    for own, name in writer.points.items():
        point = solved.get(name)
        if point is None or point.position is None:
            continue
        off = abs(complex(point.position) / metre - writer.at[own])
        if off > SEEN * writer.found.rounding:
            yield message(
                "{name} closes {off} {unit} from where it is drawn",
                name=name,
                off=f"{off:.3g}",
                unit=writer.found.unit,
            )


def point_names(found: Imported, owns: list[str]) -> Iterator[tuple[str, str]]:
    """Names of points for joints: letters, digits and _, different also in small letters."""
    taken: set[str] = set()
    for own in dict.fromkeys(owns):
        base = re.sub(r"[^A-Za-z0-9_]", "_", named(found.joints[own].name)) or "P"
        base = base if base[0].isalpha() else f"P{base}"
        name, count = base, 1
        while name.lower() in taken:
            count += 1
            name = f"{base}_{count}"
        taken.add(name.lower())
        yield own, name


def direction(way: complex) -> complex:
    if abs(way) * FARTHEST < 1:
        raise refused(message("two joints of a link or a guide lie in one place"))
    return way / abs(way)


def pair(place: complex) -> str:
    return f"[{plain(place.real)}, {plain(place.imag)}]"


def plain(value: float) -> str:
    """A number in decimals, without idle zeros."""
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
