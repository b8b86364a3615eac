"""The vocabulary of a scene: names, and phrases such as "left of A-B" or "closure 1"."""

from __future__ import annotations

import re
from collections.abc import Collection

from msgspec import Struct

from graphkin.scene.findings import Findings, nearest, shown, shown_key
from graphkin.scene.link_points import ends_of, is_under, under
from graphkin.scene.model import FRAME, LINK_KEYS, Branch, Closure, Side, Way
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
