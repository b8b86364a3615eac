"""Where the text of a scene names points and links: found, named anew, and forgotten."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from typing import Any

from tomlkit.items import SingleKey

from graphkin.scene.link_points import ends_of
from graphkin.scene.model import JOINED, KEYWORDS
from graphkin.studio.sketch import table_of

ASKED = ("velocity", "acceleration", "omega", "epsilon", "slides", "centres", "poles")
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


def named_anew(ask: Any, gone: str, kept: str) -> None:
    """Ask of a point under its other name, and once."""
    for key in [key for key in ASKED if isinstance(ask.get(key), list)]:
        said = {str(each) for each in ask[key]}
        for n in reversed(range(len(ask[key]))):
            point, at, link = str(ask[key][n]).partition("@")
            if point != gone:
                continue
            if f"{kept}{at}{link}" in said:
                del ask[key][n]
            else:
                ask[key][n] = f"{kept}{at}{link}"


def says(point: str, key: str, value: object) -> bool:
    """Whether a key of a link, or what it says, names a point."""
    if key in JOINED and isinstance(value, Mapping):
        named = (str(value.get(each, "")) for each in ("along", "centre", "through"))
        return any(point in each.split("-") for each in named)
    phrase = raw(value)
    words = phrase.replace("-", " ").split()[1:] if isinstance(phrase, str) else []
    return point in key.split("-") or point in words


def forget(document: Any, known: Collection[str]) -> None:
    """Take out drivers, branches and wishes about what is no longer among points and links."""
    drivers = document.get("drivers", [])
    for n in reversed(range(len(drivers))):
        if str(drivers[n].get("turn", drivers[n].get("slide"))) not in known:
            del drivers[n]
    if "drivers" in document and not len(drivers):
        document.pop("drivers")
    branches, ask = (table_of(document, key) for key in ("branches", "ask"))
    for key in list(branches):
        if key not in known or not set(str(branches[key]).replace("-", " ").split()[2:]) <= {
            *known
        }:
            branches.pop(key)
    for key in [key for key in ASKED if isinstance(ask.get(key), list)]:
        for n in reversed(range(len(ask[key]))):
            if not {ends_of(str(ask[key][n]))[0]} <= {*known}:
                del ask[key][n]


def raw(value: object) -> object:
    """A value without the style in which it is written."""
    return value.unwrap() if hasattr(value, "unwrap") else value
