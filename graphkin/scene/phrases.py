"""The names of a scene: phrases such as "left of A-B" or "closure 1", and names that must exist."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping

from msgspec import Struct
from msgspec.structs import astuple, replace

from graphkin.scene.findings import Findings, Table, listed, nearest, shown, shown_key
from graphkin.scene.link_points import ends_of, is_under, under
from graphkin.scene.model import (
    FRAME,
    LINK_KEYS,
    Ask,
    Branch,
    Closure,
    Driver,
    GuideOrTrack,
    Link,
    Scene,
    Side,
    Slide,
    Way,
    link_words,
)
from graphkin.text import LANGUAGES
from graphkin.text.errors import NO_WORDS, Hint, Mend, Message, message

FRAME_WORD = "frame"
LONGEST_NAME = 40
SIDES = {"left": 1, "right": -1}
WAYS = {"forward": 1, "backward": -1}


def is_name(text: str) -> bool:
    """Whether a text is a letter followed by letters, digits or underscores, and not too long."""
    return (
        text.isascii() and text[:1].isalpha() and text.isidentifier() and len(text) <= LONGEST_NAME
    )


def is_link_name(text: str) -> bool:
    """Whether a text is a name, or a whole number without a leading zero."""
    digits = text.isascii() and text.isdigit() and text[0] != "0"
    return is_name(text) or (digits and len(text) <= LONGEST_NAME)


def line(text: str) -> tuple[str, str] | None:
    """The two points of ``P-Q``, or None if the text has another form."""
    first, _, second = text.partition("-")
    return (first, second) if is_name(first) and is_name(second) and first != second else None


class OnWords(Struct, frozen=True):
    """``"on A-B"``, or ``"beyond B on A-B"`` with ``beyond`` as one of the two ends.

    ``by_parts`` means that the scene places this end on a bar whose parts are given.
    """

    first: str
    second: str
    beyond: str | None = None
    by_parts: bool = False


def point_name(place: str, name: object, findings: Findings) -> str | None:
    """The name of a point; None, with a problem recorded, if it is not valid."""
    if isinstance(name, str) and is_name(name):
        if name.lower() == FRAME_WORD:
            findings.add(
                place,
                message("a point named {name}", name=name),
                message("a name that is not the frame's"),
            )
            return None
        return name
    if name is None:
        findings.add(place, message("is missing"), message("the name of a point"))
        return None
    findings.add(
        place,
        message("{name} is no name of a point", name=shown(name)),
        message("a letter, then letters, digits or _, at most {most}", most=LONGEST_NAME),
    )
    return None


NAME_OF_LINK = message("the name of a link")


def link_name(
    place: str, raw: object, findings: Findings, meant: Message = NAME_OF_LINK
) -> str | None:
    """The name of a link, written as text or whole number; ``frame`` and 0 are the frame."""
    if isinstance(raw, int) and not isinstance(raw, bool) and 0 <= raw < 10**6:
        return str(raw)
    if isinstance(raw, str):
        if raw in (FRAME, FRAME_WORD):
            return FRAME
        if is_link_name(raw):
            return raw
    if raw is None:
        findings.add(place, message("is missing"), meant)
    else:
        findings.add(
            place,
            message("{raw} is no name of a link", raw=shown(raw)),
            message("a number or a name, as in [links]"),
        )
    return None


def asked_point(place: str, raw: object, findings: Findings) -> str | None:
    """A requested point: ``A``, or ``A@3`` for the point of link 3 under A."""
    if isinstance(raw, str) and is_under(raw):
        point, link = ends_of(raw)
        of, own = point_name(place, point, findings), link_name(place, link, findings)
        return None if of is None or own is None else under(of, own)
    return point_name(place, raw, findings)


def line_words(place: str, raw: object, findings: Findings) -> tuple[str, str] | None:
    """``"P-Q"``: the line from one point to another."""
    ends = line(phrase(raw)[0]) if isinstance(raw, str) and len(phrase(raw)) == 1 else None
    if ends is not None:
        return ends
    found = message("is missing") if raw is None else shown(raw)
    findings.add(place, found, message('two points with a dash, such as "A-B"'))
    return None


def phrase(text: str) -> list[str]:
    """The words of a phrase; a line ``P - Q`` counts as one word."""
    return text.replace(" - ", "-").split()


def side_words(text: str) -> Side | None:
    """``"left of A-B"`` or ``"right of A-B"``; None for any other text."""
    match phrase(text):
        case ["left" | "right" as side, "of", word] if ends := line(word):
            return Side(*ends, SIDES[side])
    return None


def on_words(text: str) -> OnWords | None:
    """``"on B-C"`` or ``"beyond C on B-C"``; None for any other text."""
    match phrase(text):
        case ["on", word] if ends := line(word):
            return OnWords(*ends)
        case ["beyond", end, "on", word] if (ends := line(word)) and end in ends:
            return OnWords(*ends, end)
    return None


def branch_words(text: str) -> Branch | None:
    """A branch statement: a side, ``forward``, ``backward`` or ``closure 1``."""
    match phrase(text):
        case ["forward" | "backward" as way]:
            return Way(WAYS[way])
        case ["closure", number] if is_link_name(number) and number.isdigit() and len(number) < 5:
            return Closure(int(number))
    return side_words(text)


CLOSURE = "closure"
"""The first word of a branch statement with a closure number."""
PLACES = (*SIDES, "on", "beyond")
"""The first words of phrases that place a point of a link."""


def phrase_hint(raw: object, begins: Collection[str]) -> Hint:
    """A correction of a phrase that should begin with one of some words; empty if there is none."""
    words = phrase(raw) if isinstance(raw, str) else []
    if not words:
        return NO_WORDS
    ends = words[-1].split("-")
    for end in ends if len(words) == 3 and len(ends) == 2 else ():
        if re.fullmatch(r"0\w*", end) and is_name(f"O{end[1:]}"):
            meant = f"O{end[1:]}"
            advice = message(
                "{end} begins with a zero: did you mean {meant}, with the letter?",
                end=end,
                meant=meant,
            )
            return Mend(end, meant, advice)
    return NO_WORDS if words[0] in begins else nearest(words[0], begins)


def key_points(place: str, key: str, findings: Findings) -> tuple[str, ...] | None:
    """The points of a key ``P``, ``P-Q`` or ``P-Q-R``; None, with a problem, for other keys."""
    parts = key.split("-")
    if len(parts) > 3 or not all(is_name(part) for part in parts):
        findings.add(
            place,
            message("{key} is no key of a link", key=shown_key(key)),
            message("P, P-Q (a length), P-Q-R (an angle at Q), {link_keys}", link_keys=LINK_KEYS),
        )
        return None
    names = [point_name(place, part, findings) for part in parts]
    if None in names:
        return None
    if len(set(parts)) < len(parts):
        findings.add(
            place, message("{key} names one point twice", key=key), message("different points")
        )
        return None
    return tuple(parts)


THE_MECHANISM = message("the mechanism")


def known_link(
    scene: Scene, name: str, place: str, findings: Findings, *, moves: bool = False
) -> Link | None:
    """The link with a name; None, with a problem noted, when there is none.

    Of a link that ``moves``, the problem does not propose the frame.
    """
    if name == FRAME or name in scene.links:
        return scene.link(name)
    found = message("link {name} is not in [links]", name=name)
    names = tuple(scene.links) if moves else (FRAME, *scene.links)
    findings.add(place, found, listed(names), nearest(name, scene.links))
    return None


def known_point(
    name: str, points: Collection[str], where: Message, place: str, findings: Findings
) -> bool:
    """Whether a point is among those of ``where``; a problem is noted when it is not."""
    if name not in points:
        expected = listed(points) or message("a point that is written")
        findings.add(
            place,
            message("{name} is no point of {where}", name=name, where=where),
            expected,
            nearest(name, points),
        )
    return name in points


def place_of(name: str) -> str:
    """The place of a link in the file."""
    return "frame" if name == FRAME else f"links.{name}"


def quoted(link: str) -> str:
    """A link's name as a scene writes it as a value: 2, but "arm"."""
    return link if link.isdigit() else f'"{link}"'


def check_guide(
    scene: Scene, link: Link, joint: GuideOrTrack, place: str, findings: Findings
) -> None:
    """Note a guide or track on its own or an unknown link, or through points which that lacks."""
    if joint.on == link.name:
        findings.add(
            f"{place}.on", message("link {name} itself", name=link.name), message("another link")
        )
        return
    on = known_link(scene, joint.on, f"{place}.on", findings)
    if on is None:
        return
    where = link_words(joint.on)
    if isinstance(joint.through, str):
        known_point(joint.through, on.points, where, f"{place}.through", findings)
    if isinstance(joint, Slide) and joint.along:
        for point in joint.along:
            if point in on.points or point not in link.points:
                known_point(point, on.points, where, f"{place}.along", findings)
            else:
                found = message(
                    "{point} is a point of link {name}, not of {where}",
                    point=point,
                    name=link.name,
                    where=where,
                )
                if joint.on == FRAME:
                    hint = message(
                        "to slide {where} along this link, write slides in {where}", where=where
                    )
                else:
                    hint = message(
                        "to slide {where} along this link, write slides in {where}, "
                        "with on = {name}",
                        where=where,
                        name=quoted(link.name),
                    )
                findings.add(f"{place}.along", found, listed(on.points), hint)


def next_name(links: Collection[str]) -> str:
    """A name for an equivalent link: the next number after the others, or a new name in letters."""
    if all(name.isdigit() for name in links):
        return str(max(map(int, links)) + 1)
    letters = ("e", *(f"e{number}" for number in range(2, len(links) + 2)))
    return next(letter for letter in letters if letter not in links)


Names = Mapping[str, str]
"""Names for links, by their names in the scene."""


def read_names(table: Table) -> dict[str, Names]:
    """The names per language, from a table such as ``it = { boom = "braccio" }``."""
    found: dict[str, Names] = {}
    for language in (language for language in LANGUAGES if language in table):
        own = table.table(language)
        found[language] = {link: own.text(link) for link in own.raw}
        for link, name in found[language].items():
            if not is_printable_name(name):
                expected = message(
                    "a letter, then letters, digits or _, at most {most}", most=LONGEST_NAME
                )
                own.wrong(link, shown(name), expected)
    table.known.extend(LANGUAGES)
    table.finish()
    return found


def is_printable_name(text: str) -> bool:
    """Whether a text can name a link on a sheet; letters of any language are allowed."""
    named = text[:1].isalpha() and text.isidentifier() and len(text) <= LONGEST_NAME
    return named and text != FRAME_WORD


def check_names(scene: Scene, findings: Findings) -> None:
    """Note names for unknown links or the frame, and names already used by a point or a link."""
    for language, names in scene.names.items():
        used = {*scene.points, *(link for link in scene.links if link not in names)}
        for link, name in names.items():
            place = f"names.{language}.{link}"
            if known_link(scene, link, place, findings) is scene.frame:
                findings.add(
                    place,
                    message("the frame, which has no name on a sheet"),
                    message("a moving link"),
                )
            elif name in used:
                findings.add(
                    place,
                    message("{name} is another thing's name", name=shown(name)),
                    message("a name of its own"),
                )
            used.add(name)


def in_language(scene: Scene, language: str) -> Scene:
    """The same scene with its links renamed for a language."""
    names = scene.names.get(language, {})
    if not names:
        return scene
    links = [link.called(names) for link in scene.links.values()]
    return replace(
        scene,
        links={link.name: link for link in links},
        drivers=tuple(driven(driver, names) for driver in scene.drivers),
        branches={names.get(name, name): branch for name, branch in scene.branches.items()},
        ask=asked(scene.ask, names),
        names={},
        forces=None if scene.forces is None else scene.forces.called(names),
    )


def driven(driver: Driver, names: Names) -> Driver:
    """A driver with renamed links."""
    link, against = (names.get(name, name) for name in (driver.link, driver.against))
    return replace(driver, link=link, against=against)


def asked(ask: Ask, names: Names) -> Ask:
    """The requested results with renamed links: 2, 2-4, or a point A@2."""
    return Ask(*(tuple(by_parts(name, names) for name in each) for each in astuple(ask)))


def by_parts(name: str, names: Names) -> str:
    """A requested name with each link in it renamed."""
    point, at, link = name.rpartition("@")
    return point + at + "-".join(names.get(part, part) for part in link.split("-"))
