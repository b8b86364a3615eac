"""The names of a scene's links in each language of the sheets."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import astuple, replace

from graphkin.scene.findings import Findings, Table, shown
from graphkin.scene.known_names import known_link
from graphkin.scene.model import Ask, Driver, Scene
from graphkin.scene.phrases import FRAME_WORD, LONGEST_NAME
from graphkin.text import LANGUAGES
from graphkin.text.errors import message

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
                    "a letter, then letters, digits or _, at most {most}",
                    most=LONGEST_NAME,
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
