"""Checks of the names used in a scene against the names defined in it.

The names of a scene's links in each language of the sheets.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from msgspec.structs import astuple, replace

from graphkin.scene.findings import Findings, Table, listed, nearest, shown
from graphkin.scene.model import FRAME, Ask, Driver, GuideOrTrack, Link, Scene, Slide, link_words
from graphkin.scene.phrases import FRAME_WORD, LONGEST_NAME
from graphkin.text import LANGUAGES
from graphkin.text.errors import Message, message

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


def read_names(table: Table, findings: Findings) -> dict[str, Names]:
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
                findings.add(own.at(link), shown(name), expected)
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
