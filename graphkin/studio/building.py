"""Actions of building by hand in the field: each is one edit that keeps the text's comments."""

from __future__ import annotations

import re
from cmath import phase, rect
from collections.abc import Callable, Iterator, Mapping
from itertools import count, pairwise, product
from math import degrees, radians
from string import ascii_uppercase
from typing import Any

import tomlkit
from msgspec import Struct
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import SingleKey

from graphkin.construction.core.branches import block_of, choosing, pins_choosing
from graphkin.construction.core.quantities import WHOSE, Whose
from graphkin.mechanism import Mechanism
from graphkin.scene.file_limits import tables_of
from graphkin.scene.link_points import ends_of
from graphkin.scene.model import DRIVEN, FRAME, JOINED, KEYWORDS, link_words
from graphkin.scene.phrases import FRAME_WORD
from graphkin.scene.read_scene import read_text
from graphkin.scene.requests import ALL
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import Dyad, Group, Stretched
from graphkin.structure.pairs import Pin
from graphkin.studio.sketch import (
    GRIDS,
    DrawnWheel,
    Places,
    frame_places,
    is_number,
    is_place,
    links_of,
    points_of,
    solved,
    table_of,
    unit_of,
    wheels_of,
)
from graphkin.text.errors import NO_WORDS, GraphkinError, Problem, SceneError, both, message

TRIED = 64
"""Number of combinations of closures that are compared with the drawing."""


def drawn_closed(text: str, places: Places) -> str:
    """The text with its missing branches filled in, in the closure nearest to the drawing."""
    try:
        scene = read_text(text, "scene", None, {})
        groups = decompose(scene)
    except GraphkinError:
        return text
    document = tomlkit.parse(text)
    allowed = [*choosing(groups), *pins_choosing(groups)]
    kept = {name for name in scene.branches if name in allowed and fits(groups, name, document)}
    branches = table_of(document, "branches")
    for name in [name for name in branches if name not in kept]:
        branches.pop(name)
    wanted = {key: words for key, words in ways(groups) if key not in kept}
    if not wanted:
        return tomlkit.dumps(document)
    if "branches" not in document:
        document["branches"] = tomlkit.table()
    best, nearest = text, float("inf")
    for n, words in enumerate(product(*wanted.values())):
        if n == TRIED:
            break
        for key, each in zip(wanted, words, strict=True):
            document["branches"][key] = each
        tried = tomlkit.dumps(document)
        far = apart(tried, places)
        if far < nearest or best is text:
            best, nearest = tried, far
    return best


def ways(groups: tuple[Group, ...]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The possible words of each name that may state a branch."""
    for group in groups:
        for name in choosing((group,))[:1]:
            dyad = group.dyad if isinstance(group, Stretched) else group
            if isinstance(dyad, Dyad) and dyad.type == "RRR":
                yield name, tuple(f"{side} of {line_of(dyad)}" for side in ("left", "right"))
            elif isinstance(dyad, Dyad) and name == block_of(dyad):
                yield name, ("forward", "backward")
            else:
                yield name, ("closure 1",)


def line_of(dyad: Dyad) -> str:
    """The line between the two known pins of a dyad."""
    ends = (pair.place for pair in dyad.outer if isinstance(pair, Pin))
    return "-".join(ends)


def fits(groups: tuple[Group, ...], name: str, document: tomlkit.TOMLDocument) -> bool:
    """Whether a stated side still names the two known pins of its dyad."""
    words = str(table_of(document, "branches").get(name, ""))
    for group in groups:
        dyad = group.dyad if isinstance(group, Stretched) else group
        if isinstance(dyad, Dyad) and dyad.type == "RRR" and name in choosing((group,)):
            return {*line_of(dyad).split("-")} == {*words.rpartition(" ")[2].split("-")}
    return True


def apart(text: str, places: Places) -> float:
    """The total distance of a mechanism's points from their drawn places."""
    try:
        found = solved(Mechanism(read_text(text, "scene", None, {})))
    except GraphkinError:
        return float("inf")
    return sum(abs(at - places[name]) for name, at in found.items() if name in places)


# --- names of points and links in the text of a scene: found, renamed, and removed ----------------


LINES = ("along", "through", "centres", "about", "contact")
"""Keys of a joint that name a point, or a line of two points, possibly of other bodies."""
COUNTED = ("start", "turns")
"""Keys of a joint that hold one number for each of some links."""
NAMING = ("through", "along", "centre", "from", "of")
"""Keys that name a point or a line of two points."""
PHRASES = ("left", "right", "on", "beyond")
"""First words of a text that gives the place of a point."""


def renamed(table: Any, gone: str, kept: str) -> None:
    """Rename a point in the keys of a link or driver, and in the texts of these keys."""
    for key in list(table):
        value = table[key]
        if key in NAMING or (
            isinstance(raw(value), str)
            and str(value).split()[:1] != []
            and str(value).split()[0] in PHRASES
        ):
            table[key] = in_words(str(value), gone, kept)
        elif isinstance(raw(value), list):
            for each in value:
                if isinstance(raw(each), dict):
                    renamed(each, gone, kept)
        elif isinstance(raw(value), dict):
            renamed(value, gone, kept)
    body = table.value.body if hasattr(table.value, "body") else []
    for n, (key, value) in enumerate(body):
        if key is None or key.key in KEYWORDS or gone not in key.key.split("-"):
            continue
        shown = key.as_string()
        sep = shown[len(shown.rstrip()) :] + key.sep
        own = SingleKey(in_words(key.key, gone, kept), sep=sep)
        body[n] = (own, value)


def in_words(words: str, gone: str, kept: str) -> str:
    """A line or phrase with one of its points renamed."""
    return re.sub(rf"\b{re.escape(gone)}\b", kept, words)


def asked_lists(ask: Any) -> Iterator[tuple[Whose, Any]]:
    """The lists of [ask], each with the kind of names that it holds."""
    yield from ((whose, ask[key]) for key, whose in WHOSE.items() if isinstance(ask.get(key), list))


def names_asked(whose: Whose, item: object) -> dict[Whose, set[str]]:
    """The names in an item of such a list: A@3 names a point and a link, 2-4 two links."""
    words = str(item).replace(" ", "")
    if whose == "points":
        point, link = ends_of(words)
        return {"points": {point}, "links": {link} - {"", FRAME, FRAME_WORD}}
    return {whose: {*words.split("-")} - {ALL, FRAME, FRAME_WORD}}


def named_anew(ask: Any, gone: str, kept: str) -> None:
    """Rename a point in [ask], without repeating it in a list."""
    for listed in [listed for whose, listed in asked_lists(ask) if whose == "points"]:
        said = {str(each) for each in listed}
        for n in reversed(range(len(listed))):
            point, at, link = str(listed[n]).partition("@")
            if point != gone:
                continue
            if f"{kept}{at}{link}" in said:
                del listed[n]
            else:
                listed[n] = f"{kept}{at}{link}"


def says(point: str, key: str, value: object) -> bool:
    """Whether a key of a link, or its text, names a point."""
    if key in JOINED and isinstance(value, Mapping):
        named = (str(value.get(each, "")) for each in ("along", "centre", "through"))
        return any(point in each.split("-") for each in named)
    phrase = raw(value)
    words = phrase.replace("-", " ").split()[1:] if isinstance(phrase, str) else []
    return point in key.split("-") or point in words


def known_names(document: Any) -> dict[Whose, set[str]]:
    """The names of a text's points, of its moving links, and of the links that slide."""
    links = links_of(document)
    bodies = (table_of(document, FRAME_WORD), *links.values())
    return {
        "points": {point for table in bodies for point in points_of(table)},
        "links": {*links},
        "slides": {name for name, table in links.items() if "slides" in table},
    }


def let_go(document: Any) -> None:
    """Remove from bodies the joints to points and links that no longer exist."""
    names = known_names(document)
    for table in (table_of(document, FRAME_WORD), *links_of(document).values()):
        own = {*points_of(table)}
        for key in [key for key in table if key in KEYWORDS]:
            listed = table[key] if isinstance(table[key], list) else [table[key]]
            for n in reversed(range(len(listed))):
                if isinstance(listed[n], Mapping) and not has_all_named(listed[n], own, names):
                    del listed[n]
            if not listed:
                table.pop(key)


def has_all_named(record: Any, own: set[str], names: Mapping[Whose, set[str]]) -> bool:
    """Whether everything that a joint of a body names exists; removes counts of missing links.

    The centre of a wheel must be one of its body's ``own`` points.
    """
    links = names["links"] | {FRAME, FRAME_WORD}
    lines = (str(record[key]) for key in LINES if isinstance(raw(record.get(key)), str))
    points = {point for line in lines for point in line.split("-")}
    for counted in (record.get(key) for key in COUNTED):
        for link in {*(counted if isinstance(counted, dict) else ())} - links:
            counted.pop(link)
    turns = "radius" in record or "teeth" in record
    centred = not turns or "centre" not in record or str(record["centre"]) in own
    return str(record.get("on", FRAME)) in links and points <= names["points"] and centred


def forget(document: Any) -> None:
    """Remove drivers, branches, titles and requests about things that no longer exist."""
    names = known_names(document)
    known = names["points"] | names["links"]
    drivers = document.get("drivers", [])
    for n in reversed(range(len(drivers))):
        each = drivers[n]
        links = {str(each[key]) for key in (*DRIVEN, "against") if key in each}
        points = {*str(each["of"]).split("-")} if "of" in each else set()
        if not (links - {FRAME, FRAME_WORD} <= names["links"] and points <= names["points"]):
            del drivers[n]
    if "drivers" in document and not len(drivers):
        document.pop("drivers")
    for called in table_of(document, "names").values():
        for link in {*(called if isinstance(called, dict) else ())} - names["links"]:
            called.pop(link)
    branches, ask = (table_of(document, key) for key in ("branches", "ask"))
    for key in list(branches):
        if key not in known or not set(str(branches[key]).replace("-", " ").split()[2:]) <= known:
            branches.pop(key)
    for whose, listed in asked_lists(ask):
        for n in reversed(range(len(listed))):
            asked = names_asked(whose, listed[n])
            if any(named - names[of] for of, named in asked.items()):
                del listed[n]


def raw(value: object) -> object:
    """A value without its TOML style."""
    return value.unwrap() if hasattr(value, "unwrap") else value


# --- actions of building by hand in the field -----------------------------------------------------


TURN, GUIDE_TURN = 0.5, 5.0
"""The steps of drawn angles, and of those of guides, in degrees."""
FINE = 1e-4
"""The step of typed lengths and angles, in the unit of the scene and in degrees."""


class Act(Struct, frozen=True):
    """An action of the user: its kind, its objects, and its place.

    ``of`` names points and links; ``words`` is a chosen closure, ``speed`` the speed of a driver.
    With ``exact``, lengths and angles are typed: they are not rounded to the grid.
    """

    kind: str
    of: tuple[str, ...]
    at: complex
    places: Places
    words: str = ""
    speed: float = 0.0
    exact: bool = False


class Built(Struct, frozen=True):
    """The text after an action, and the places of points that the text does not give."""

    text: str
    places: Places


def built(text: str, act: Act) -> Built:
    """Carry out one action. Raises SceneError, with a message for the pointer, on failure."""
    try:
        tables = tables_of(text)
        document = tomlkit.parse(text)
    except TOMLKitError:
        raise SceneError.at(
            "text", message("is no TOML"), NO_WORDS, message("mend its mistakes first")
        ) from None
    refuse_shapes(tables)
    places = {**act.places, **frame_places(tables)}
    work = Builder(document, places, unit_of(tables), exact=act.exact)
    KINDS[act.kind](work, act)
    after = tomlkit.dumps(work.document)
    if act.kind != "close":
        after = drawn_closed(after, work.places)
    return Built(spaced(without_empty(after, "branches"), text), work.places)


def without_empty(text: str, table: str) -> str:
    """A text without the heading of an empty table."""
    document = tomlkit.parse(text)
    if document.get(table) == {}:
        document.pop(table)
    return tomlkit.dumps(document)


def spaced(text: str, before: str) -> str:
    """A text with a blank line above each new heading."""
    lines, known = text.split("\n"), {*before.split("\n")}
    found = lines[:1]
    for above, line in pairwise(lines):
        if line.startswith("[") and line not in known and above.strip():
            found.append("")
        found.append(line)
    return "\n".join(found)


def refuse_shapes(tables: Mapping[str, Any]) -> None:
    """Raise SceneError where links, points or drivers are not in tables."""
    wanted = {key: tables.get(key, {}) for key in ("units", "frame", "links", "branches", "ask")}
    links = wanted["links"]
    wanted |= {f"links.{k}": v for k, v in links.items()} if isinstance(links, dict) else {}
    drivers = tables.get("drivers", [])
    wanted |= dict.fromkeys(["drivers"], {} if isinstance(drivers, list) else drivers)
    if isinstance(drivers, list):
        wanted |= {f"drivers[{n}]": each for n, each in enumerate(drivers)}
    wrong = [place for place, value in wanted.items() if not isinstance(value, dict)]
    if wrong:
        raise SceneError(
            [Problem(place, message("is no table"), message("a table")) for place in wrong]
        )


class Builder:
    """Edits a text, and keeps the places of its points."""

    def __init__(
        self, document: tomlkit.TOMLDocument, places: Places, unit: str, *, exact: bool = False
    ) -> None:
        self.document = document
        self.places = dict(places)
        self.grid = FINE if exact else GRIDS[unit]
        self.turn = FINE if exact else TURN
        self.guide_turn = FINE if exact else GUIDE_TURN

    @property
    def links(self) -> dict[str, list[str]]:
        """The points of each moving link."""
        return {name: points_of(table) for name, table in links_of(self.document).items()}

    @property
    def fixed(self) -> list[str]:
        """The points of the frame."""
        return points_of(table_of(self.document, "frame"))

    def table(self, name: str, *, headed: bool = True) -> Any:
        """A table of the text, created if it is missing."""
        if name not in self.document:
            self.document[name] = tomlkit.table(is_super_table=not headed)
        return self.document[name]

    def point_name(self) -> str:
        """The first letter that no point has."""
        used = {*self.fixed, *(point for points in self.links.values() for point in points)}
        letters = (f"{letter}{n or ''}" for n in count() for letter in ascii_uppercase)
        return next(name for name in letters if name not in used and name[0] not in "IJO")

    def new_link(self) -> tuple[str, Any]:
        """A new link after all others: its name and its table."""
        used = self.links
        name = next(str(n) for n in count(1) if str(n) not in used)
        links = self.table("links", headed=False)
        links[name] = tomlkit.table()
        return name, links[name]

    def length(self, value: float) -> Any:
        """A length on the grid, at least one step."""
        return number(max(1, round(value / self.grid)) * self.grid)

    def pair(self, at: complex) -> Any:
        """Coordinates on the grid."""
        steps = (round(part / self.grid) * self.grid for part in (at.real, at.imag))
        found = tomlkit.array()
        found.extend(number(step) for step in steps)
        return found

    def place(self, point: str) -> complex:
        """The place of a point. Raises SceneError for a point that is not in the field."""
        if point not in self.places:
            raise SceneError.at(
                point, message("is at no known place"), message("a point that is drawn")
            )
        return self.places[point]

    def known_link(self, name: str) -> Any:
        """The table of a link. Raises SceneError for a missing link."""
        if name not in self.links:
            raise SceneError.at(link_words(name), message("is not there"), message("a moving link"))
        return self.document["links"][name]


def number(value: float) -> int | float:
    """A number as it is written, as an integer where possible."""
    rounded = round(value, 6)
    return int(rounded) if rounded == int(rounded) else rounded


def pivot(work: Builder, act: Act) -> None:
    """Add a fixed pin."""
    name = next(name for n in count(1) if (name := f"O{n}") not in work.fixed)
    work.table("frame")[name] = work.pair(act.at)


def bar(work: Builder, act: Act) -> None:
    """Add a link of two pins, from a pin to another pin or to a new one."""
    start, *rest = act.of
    if rest:
        end = rest[0]
        refuse_bar(work, start, end)
        length = work.length(abs(work.place(end) - work.place(start)))
    else:
        way, end = act.at - work.place(start), work.point_name()
        length = work.length(abs(way))
        work.places[end] = work.place(start) + rect(length, radians(turned(way, work.turn)))
    _, table = work.new_link()
    table[f"{start}-{end}"] = length


def refuse_bar(work: Builder, start: str, end: str) -> None:
    """Raise SceneError where two pins cannot be the ends of a bar."""
    line = f"{start}-{end}"
    if start == end:
        raise SceneError.at(line, message("begins and ends at one pin"), message("two pins"))
    for name, points in {FRAME: work.fixed, **work.links}.items():
        if start in points and end in points:
            found = message("both pins belong to {name}", name=link_words(name))
            raise SceneError.at(line, found, message("pins of two links"))


def plate(work: Builder, act: Act) -> None:
    """Add a pin to a link, by its distances to the first two pins or on their line."""
    table = work.known_link(act.of[0])
    points = work.links[act.of[0]]
    if len(points) == 1 and "wheel" in table:
        spoke(work, table, points[0], act.at)
        return
    if len(points) < 2:
        expected = message("a link with two pins at least")
        raise SceneError.at(link_words(act.of[0]), message("has one pin alone"), expected)
    first, second = points[:2]
    start, end = work.place(first), work.place(second)
    name, across = work.point_name(), (act.at - start) / (end - start)
    aside = across.imag * abs(end - start)
    if abs(aside) < work.grid:
        reach = work.length(abs(across.real) * abs(end - start))
        table[f"{first}-{name}"] = reach
        line = f"{first}-{second}"
        table[name] = f"on {line}" if across.real > 0 else f"beyond {first} on {line}"
        sign = 1 if across.real > 0 else -1
        work.places[name] = start + sign * reach * (end - start) / abs(end - start)
    else:
        table[f"{first}-{name}"] = work.length(abs(act.at - start))
        table[f"{second}-{name}"] = work.length(abs(act.at - end))
        table[name] = f"{'left' if aside > 0 else 'right'} of {first}-{second}"
        work.places[name] = act.at


def spoke(work: Builder, table: Any, centre: str, at: complex) -> None:
    """Add a pin to a wheel that had only its centre."""
    way, name = at - work.place(centre), work.point_name()
    table.pop(centre)
    length = table[f"{centre}-{name}"] = work.length(abs(way))
    work.places[name] = work.place(centre) + rect(length, radians(turned(way, work.turn)))
    turned_driver(work, next(link for link, held in work.links.items() if name in held), name)


def wheel(work: Builder, act: Act) -> None:
    """Add a wheel about a pin, which turns about a fixed pin or rolls.

    It rolls on a second wheel if one is given. Otherwise a wheel about a moving pin rolls on a
    straight track of the frame, which touches it.
    """
    centre, *rest = act.of
    at, table = work.place(centre), tomlkit.inline_table()
    if rest:
        other = meeting(work, rest[0], at)
        way = abs(at - work.place(other.centre))
        outside = way > other.radius
        table.update({"centre": centre, "radius": number(abs(way - other.radius))})
        if not outside and not other.inside:
            found = message(
                "{centre} lies inside the wheel of link {link}", centre=centre, link=other.link
            )
            raise SceneError.at("wheel", found, message("a centre outside it"))
        rolls: dict[str, Any] = {"on": key_of(other.link)}
    else:
        radius = work.length(abs(act.at - at))
        table.update({"centre": centre, "radius": radius})
        angle = turned((at - act.at) / 1j, GUIDE_TURN)
        through = work.pair(at - rect(1.0, radians(angle)) * 1j * radius)
        rolls = {"on": 0, "through": through, "angle": number(angle)}
    _, link = work.new_link()
    link[centre] = work.pair(0j)
    link["wheel"] = table
    if rest or centre not in work.fixed:
        link["rolls"] = tomlkit.inline_table()
        link["rolls"].update(rolls)


def meeting(work: Builder, link: str, at: complex) -> DrawnWheel:
    """The wheel of a link whose rim is nearest to a place. Raises SceneError if there is none."""
    all_wheels = [each for each in wheels_of(work.document.unwrap()) if each.link == link]
    placed = [each for each in all_wheels if each.centre in work.places]
    if not placed or any(abs(at - work.place(each.centre)) < work.grid for each in placed):
        found = message("cannot roll on link {link} from here", link=link)
        raise SceneError.at("wheel", found, message("a wheel about another centre"))
    return min(placed, key=lambda each: abs(abs(at - work.place(each.centre)) - each.radius))


def block(work: Builder, act: Act) -> None:
    """Add a block pinned at a point, on a fixed guide or in the slot of a link."""
    point, *rest = act.of
    slides = tomlkit.inline_table()
    if rest:
        work.known_link(rest[0])
        ends = work.links[rest[0]]
        if point in ends:
            found = message("{point} is a pin of link {name} itself", point=point, name=rest[0])
            raise SceneError.at("block", found, message("the guide of another link"))
        if len(ends) < 2:
            raise SceneError.at(
                "block", message("link {name} has no line", name=rest[0]), message("a bar")
            )
        slides.update({"on": key_of(rest[0]), "along": "-".join(ends[:2])})
    else:
        if point in work.fixed:
            hint = message("press on a moving pin")
            raise SceneError.at(
                "block", message("{point} is fixed", point=point), message("a pin that moves"), hint
            )
        at = work.place(point)
        slides.update(
            {
                "on": 0,
                "through": work.pair(at),
                "angle": number(turned(act.at - at, work.guide_turn)),
            }
        )
    tables = links_of(work.document)
    if any(
        "slides" in tables[name] and points[:1] == [point] for name, points in work.links.items()
    ):
        raise SceneError.at(
            "block",
            message("{point} has a block already", point=point),
            message("one block at a pin"),
        )
    _, table = work.new_link()
    table[point] = work.pair(0j)
    table["slides"] = slides


def driver(work: Builder, act: Act) -> None:
    """Drive a bar on a fixed pin from its drawn angle, or change the speed of a driven bar."""
    name = act.of[0]
    work.known_link(name)
    points = work.links[name]
    lone = len(points) < 2
    if not set(points) & set(work.fixed) or (lone and "wheel" not in work.document["links"][name]):
        hint = message("a bar that turns about a fixed pin can be driven")
        raise SceneError.at(
            link_words(name), message("is at no fixed pin"), message("a crank"), hint
        )
    if "drivers" not in work.document:
        work.document.add(tomlkit.nl())
        work.document["drivers"] = tomlkit.aot()
    drivers: Any = work.document["drivers"]
    known = next((each for each in drivers if str(each.get("turn")) == name), None)
    if known is not None:
        if known.get("speed") == number(act.speed) or not is_number(raw(known.get("speed"))):
            raise SceneError.at(
                link_words(name), message("is driven already"), message("another link")
            )
        known["speed"] = number(act.speed)
        return
    table = tomlkit.table()
    table["turn"] = key_of(name)
    table["angle"] = 0 if lone else number(turned(work.place(points[1]) - work.place(points[0])))
    table["speed"] = number(act.speed)
    drivers.append(table)


def move(work: Builder, act: Act) -> None:
    """Move a point: the numbers that place it follow."""
    point = act.of[0]
    work.place(point)
    if not moved(work, point, act.at):
        found = message("its place follows from expressions or from the rest")
        raise SceneError.at(point, found, message("a point whose lengths are numbers"))


def moved(work: Builder, point: str, at: complex) -> bool:
    """Change the numbers that place a point; returns whether there are any."""
    frame, changed = table_of(work.document, "frame"), False
    work.places[point] = at
    if point in frame:
        if not is_place(frame[point]):
            raise SceneError.at(
                f"frame.{point}", message("is written as an expression"), message("numbers")
            )
        frame[point] = work.pair(at)
        work.places[point] = complex(*frame[point])
        changed = True
    for name, table in links_of(work.document).items():
        for key in [key for key in table if key not in KEYWORDS and "-" in key]:
            ends = key.split("-")
            if point in ends and len(ends) == 2 and is_number(raw(table[key])):
                one, other = (work.place(end) for end in ends)
                table[key] = work.length(abs(other - one))
                changed = True
        changed |= turned_driver(work, name, point)
    return changed


def join(work: Builder, act: Act) -> None:
    """Join two pins into one. A fixed pin keeps its name; otherwise the second pin does."""
    first, second = act.of[0], act.of[-1]
    goal = work.place(second)
    work.place(first)
    refuse_join(work, first, second)
    moved(work, first, goal)
    gone, kept = (second, first) if first in work.fixed else (first, second)
    branches = table_of(work.document, "branches")
    for key in (gone, kept):
        branches.pop(key, None)
    for table in links_of(work.document).values():
        renamed(table, gone, kept)
    for driver in work.document.get("drivers", ()):
        renamed(driver, gone, kept)
    for key in list(branches):
        if {gone, kept} & {*str(branches[key]).replace("-", " ").split()}:
            branches.pop(key)
    named_anew(table_of(work.document, "ask"), gone, kept)
    work.places.pop(gone)
    work.document = tomlkit.parse(tomlkit.dumps(work.document))


def refuse_join(work: Builder, first: str, second: str) -> None:
    """Raise SceneError where two pins cannot be joined."""
    pins = both((first, second))
    if first == second:
        raise SceneError.at(first, message("is one pin already"), message("another pin"))
    bodies = {FRAME: work.fixed, **work.links}
    for name, points in bodies.items():
        if first in points and second in points:
            found = message("belong both to {name}", name=link_words(name))
            raise SceneError.at(pins, found, message("pins of two links"))
    tables = links_of(work.document)
    ones = [name for name, points in bodies.items() if first in points]
    others = [name for name, points in bodies.items() if second in points]
    for one, other in product(ones, others):
        if {*bodies[one]} & {*bodies[other]}:
            names = both((link_words(one), link_words(other)))
            found = message("{names} would share two pins and be one body", names=names)
            raise SceneError.at(pins, found, message("links that share one pin"))
        for block, guide in ((one, other), (other, one)):
            slides = raw(tables.get(block, {}).get("slides"))
            if isinstance(slides, Mapping) and str(slides.get("on")) == guide:
                found = message("the block {block} would be pinned to its own guide", block=block)
                raise SceneError.at(pins, found, message("a pin of another link"))


def turned_driver(work: Builder, link: str, point: str) -> bool:
    """Update the driver of a link whose point has moved; returns whether its angle is a number."""
    points, found = work.links[link], False
    for each in work.document.get("drivers", ()):
        if str(each.get("turn")) != link or point not in points[:2]:
            continue
        if is_number(raw(each.get("angle"))):
            each["angle"] = number(turned(work.place(points[1]) - work.place(points[0])))
            found = True
    return found


def delete(work: Builder, act: Act) -> None:
    """Delete a point or a link, with all that depends on it or loses its connection."""
    name, links = act.of[0], table_of(work.document, "links")
    if act.words == "link":
        links.pop(name, None)
    else:
        tables = [table_of(work.document, "frame"), *links_of(work.document).values()]
        for table in tables:
            for key in [key for key in table if says(name, key, table[key])]:
                table.pop(key)
    before = None
    while before != work.links:
        before = work.links
        let_go(work.document)
        drop_loose(work)
    for key in ("links", "frame"):
        if key in work.document and not table_of(work.document, key):
            work.document.pop(key)
    forget(work.document)


def drop_loose(work: Builder) -> None:
    """Remove links that are no longer bodies: single pins, and blocks that nothing touches."""
    links = table_of(work.document, "links")
    for link, points in work.links.items():
        others = {point for name, held in work.links.items() if name != link for point in held}
        lone = len(points) < 2 and not {"slides", "wheel", "wheels"} & set(links[link])
        if lone or ("slides" in links[link] and not others & set(points)):
            links.pop(link)


def close(work: Builder, act: Act) -> None:
    work.table("branches")[act.of[0]] = act.words


KINDS: Mapping[str, Callable[[Builder, Act], None]] = {
    each.__name__: each
    for each in (pivot, bar, plate, block, wheel, driver, move, join, delete, close)
}


def key_of(link: str) -> int | str:
    """The name of a link as a TOML value."""
    return int(link) if link.isdecimal() else link


def turned(way: complex, step: float = TURN) -> float:
    """The direction of a vector in degrees, on the grid of angles."""
    return round(degrees(phase(way)) / step) * step
