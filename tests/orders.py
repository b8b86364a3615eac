"""Scenes written in another order: of links, of keys, of drivers, of whatever a table holds.

What the reference gives a meaning stays: the first two points of a link (its origin and x axis),
the elements of an array, and among the links of a group whose closures are numbered, which comes
first.
"""

from __future__ import annotations

import json
import tomllib
from random import Random
from typing import Any

from graphkin.mechanism import Mechanism
from graphkin.scene.model import KEYWORDS, Closure


class AsWritten(str):
    """A float as the scene writes it."""

    __slots__ = ()


def reordered(text: str, mechanism: Mechanism, seed: int) -> str:
    """The text of a mechanism's scene with everything shuffled whose order has no meaning."""
    random = Random(seed)
    tables = tomllib.loads(text, parse_float=AsWritten)
    links = {name: rekeyed(link, random) for name, link in tables.get("links", {}).items()}
    links = {name: links[name] for name in shuffled_links(mechanism, random) if name in links}
    tables["frame"] = shuffled(tables["frame"], random)
    for name in ("parameters", "branches", "units"):
        if name in tables:
            tables[name] = shuffled(tables[name], random)
    drivers = tables.get("drivers", [])
    random.shuffle(drivers)
    return written(shuffled(tables | {"links": links}, random))


def shuffled(table: dict[str, Any], random: Random) -> dict[str, Any]:
    """A table with its keys in another order."""
    return {key: table[key] for key in random.sample(list(table), len(table))}


def rekeyed(link: dict[str, Any], random: Random) -> dict[str, Any]:
    """The keys of a link in another order, those first that name its first two points."""
    first, points = list[str](), dict[str, None]()
    for key in link:
        if key not in KEYWORDS and len(points) < 2:
            first.append(key)
            points |= dict.fromkeys(key.split("-"))
    rest = [key for key in link if key not in first]
    random.shuffle(rest)
    keys = [*first, *rest]
    for word in KEYWORDS & link.keys():
        keys.remove(word)
        keys.insert(random.randint(0, len(keys)), word)
    return {key: link[key] for key in keys}


def shuffled_links(mechanism: Mechanism, random: Random) -> list[str]:
    """The links in another order, but for those among which closures are numbered."""
    links = list(mechanism.scene.links)
    names = random.sample(links, len(links))
    numbered = [k for k, each in mechanism.scene.branches.items() if isinstance(each, Closure)]
    for group in mechanism.groups:
        if set(numbered) & set(group.links):
            places = sorted(names.index(link) for link in group.links)
            kept = sorted(group.links, key=links.index)
            for place, link in zip(places, kept, strict=True):
                names[place] = link
    return names


def written(tables: dict[str, Any]) -> str:
    """Tables as TOML, what is no table first."""
    lines = [f"{key} = {value(raw)}" for key, raw in tables.items() if not is_table(raw)]
    for key, raw in tables.items():
        if key == "links":
            for name, link in raw.items():
                lines += [f"[links.{name}]", *(f"{k} = {value(v)}" for k, v in link.items())]
        elif isinstance(raw, dict):
            lines += [f"[{key}]", *(f"{k} = {value(v)}" for k, v in raw.items())]
        elif is_table(raw):
            for each in raw:
                lines += [f"[[{key}]]", *(f"{k} = {value(v)}" for k, v in each.items())]
    return "\n".join([*lines, ""])


def is_table(raw: Any) -> bool:
    """Whether a value is written under a head of its own."""
    return isinstance(raw, dict) or (isinstance(raw, list) and raw[:1] and isinstance(raw[0], dict))


def value(raw: Any) -> str:
    """A value as TOML writes it."""
    if isinstance(raw, AsWritten):
        return str(raw)
    if isinstance(raw, dict):
        return "{ " + ", ".join(f"{key} = {value(each)}" for key, each in raw.items()) + " }"
    if isinstance(raw, list):
        return "[" + ", ".join(map(value, raw)) + "]"
    return json.dumps(raw, ensure_ascii=False)
