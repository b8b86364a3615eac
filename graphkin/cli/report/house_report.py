"""What check says of a house.toml: the conventions that it states."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import fields

from graphkin.scene.house import PLAIN, House
from graphkin.text.school_signs import NAMES, USUAL
from graphkin.text.tables import labelled


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
