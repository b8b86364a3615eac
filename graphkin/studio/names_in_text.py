"""Where the text of a scene names points and links: found, named anew, and forgotten."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from tomlkit.items import SingleKey

from graphkin.construction.core.quantities import WHOSE, Whose
from graphkin.scene.link_points import ends_of
from graphkin.scene.model import DRIVEN, FRAME, JOINED, KEYWORDS
from graphkin.scene.phrases import FRAME_WORD
from graphkin.scene.requests import ALL
from graphkin.studio.sketch import links_of, points_of, table_of

LINES = ("along", "through", "centres", "about", "contact")
"""Keys of a joint that name one point or a line of two which other bodies may own."""
COUNTED = ("start", "turns")
"""Keys of a joint that hold a number for each of some links."""
NAMING = ("through", "along", "centre", "from", "of")
"""Keys under which one point or a line of two is named."""
PHRASES = ("left", "right", "on", "beyond")
"""How a text begins that says where a point lies."""


def renamed(table: Any, gone: str, kept: str) -> None:
    """Give a point another name, in the keys of a link or driver and in what they say."""
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
    """A line or phrase with another name for one of its points."""
    return re.sub(rf"\b{re.escape(gone)}\b", kept, words)


def asked_lists(ask: Any) -> Iterator[tuple[Whose, Any]]:
    """The lists of [ask], each with whose names it holds."""
    yield from ((whose, ask[key]) for key, whose in WHOSE.items() if isinstance(ask.get(key), list))


def names_asked(whose: Whose, item: object) -> dict[Whose, set[str]]:
    """The names in an item of such a list: A@3 names a point and a link, 2-4 two links."""
    words = str(item).replace(" ", "")
    if whose == "points":
        point, link = ends_of(words)
        return {"points": {point}, "links": {link} - {"", FRAME, FRAME_WORD}}
    return {whose: {*words.split("-")} - {ALL, FRAME, FRAME_WORD}}


def named_anew(ask: Any, gone: str, kept: str) -> None:
    """Ask of a point under its other name, and once."""
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
    """Whether a key of a link, or what it says, names a point."""
    if key in JOINED and isinstance(value, Mapping):
        named = (str(value.get(each, "")) for each in ("along", "centre", "through"))
        return any(point in each.split("-") for each in named)
    phrase = raw(value)
    words = phrase.replace("-", " ").split()[1:] if isinstance(phrase, str) else []
    return point in key.split("-") or point in words


def known_names(document: Any) -> dict[Whose, set[str]]:
    """The names of a text's points, of its moving links, and of those among them that slide."""
    links = links_of(document)
    bodies = (table_of(document, FRAME_WORD), *links.values())
    return {
        "points": {point for table in bodies for point in points_of(table)},
        "links": {*links},
        "slides": {name for name, table in links.items() if "slides" in table},
    }


def let_go(document: Any) -> None:
    """Take out of bodies what joins them to points and links that are gone."""
    names = known_names(document)
    for table in (table_of(document, FRAME_WORD), *links_of(document).values()):
        own = {*points_of(table)}
        for key in [key for key in table if key in KEYWORDS]:
            listed = table[key] if isinstance(table[key], list) else [table[key]]
            for n in reversed(range(len(listed))):
                if isinstance(listed[n], Mapping) and not is_joined(listed[n], own, names):
                    del listed[n]
            if not listed:
                table.pop(key)


def is_joined(record: Any, own: set[str], names: Mapping[Whose, set[str]]) -> bool:
    """Whether what a joint of a body names is there; it counts no more what is not.

    The centre of a wheel is one of its body's ``own`` points.
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
    """Take out drivers, branches, titles and wishes about what is no longer there."""
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
    """A value without the style in which it is written."""
    return value.unwrap() if hasattr(value, "unwrap") else value
