"""The board of a task page: the data of its script, which hold only what the task states."""

from __future__ import annotations

from collections.abc import Sequence
from hashlib import pbkdf2_hmac, sha256

from graphkin.construction.board import BESIDE, BoardGiven, Thing, board_given
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.registry import BOARD
from graphkin.numbers.plane import Ratio
from graphkin.text import Words
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.web.your_turn import frame, last_part, plane_of, written
from graphkin.writers.templates import marked_up

SAID = (
    "turn.say.arc",
    "turn.say.choose",
    "turn.say.which",
    "turn.say.either",
    "turn.say.unread",
    "turn.say.undrawn",
    "turn.say.unfit",
    "turn.say.undone",
    "turn.say.redone",
    "turn.say.hint",
    "turn.say.sure",
    "board.begin",
    "board.by_keys",
    "board.saved",
    "board.opened",
    "board.no_drawing",
    "board.drawn",
    "board.already",
    "board.nothing",
    "board.apart",
    "board.parallel",
    "board.unmet",
    "board.unlettered",
    "board.askew",
    "board.which_letter",
    "board.full",
    "board.broken",
    "board.right",
    "board.elsewhere",
)
"""The messages of the script."""


def palette(words: Words) -> list[tuple[str, list[str]]]:
    """The actions of the board, each with the words for its inputs."""
    return [
        (key, [words(f"turn.slot.{slot}") for slot, _ in each.free or each.slots])
        for key, each in BOARD.items()
    ]


GRID = 2.0
"""The grid of what a page may tell of a point, in mm of paper."""
ROUNDS, SHORT = 100_000, 16
"""The rounds of a digest, and the hexadecimal digits of it that a page holds."""


def digests(drawings: Sequence[Drawing], given: BoardGiven) -> dict[str, object]:
    """What lets a page say that a point is right: for each letter the digest of its grid cell.

    A digest takes a browser some 30 ms (PBKDF2 of SHA-256), and its salt differs from page to page.
    """
    values = {n: value for each in drawings for n, value in each.trace.values.items()}
    salt = sha256(repr([*given.things.items()]).encode()).hexdigest()[:SHORT]
    found = {}
    for key, letter in given.letters.items():
        value = values.get(letter.step)
        place = drawings[0].place(value) if isinstance(value, Ratio) else value
        if isinstance(place, complex):
            cell = place / given.millimetre[letter.plane] / GRID
            text = f"{key} {round(cell.real)} {round(cell.imag)}".encode()
            found[key] = pbkdf2_hmac("sha256", text, salt.encode(), ROUNDS).hex()[:SHORT]
    return {"salt": salt, "grid": GRID, "rounds": ROUNDS, "of": found}


def board_record(sheets: Sequence[ScreenSheet], *, says_right: bool = False) -> dict[str, object]:
    """The data for the script of the board; with ``says_right`` also the digests of right cells."""
    drawings = [sheet.drawing for sheet in sheets]
    given, words = board_given(drawings), drawings[0].words
    slots = {key: each.free or each.slots for key, each in BOARD.items()}
    return {
        "palette": {key: [kinds for _, kinds in own] for key, own in slots.items()},
        "beside": {
            key: found
            for key, own in slots.items()
            if (found := [place for place, (name, _) in enumerate(own) if name == BESIDE])
        },
        "picks": {key: written_thing(each) for key, each in given.things.items()},
        "letters": {
            key: {"name": marked_up(each.name), "plane": each.plane, "of": each.of}
            for key, each in given.letters.items()
        },
        **{
            what: {key: [*ends, marked_up(name)] for key, (*ends, name) in pairs.items()}
            for what, pairs in (("bars", given.bars), ("arrows", given.arrows))
        },
        "millimetre": given.millimetre,
        "fields": [
            [plane_of(sheet), *map(frame, (sheet.layout.mechanism, sheet.layout.plan))]
            for sheet in sheets
        ],
        "bounds": [[place, place] for place in range(len(sheets))],
        "mark": words("decimal_mark"),
        "words": {last_part(key): words.sentences[key] for key in SAID},
    } | ({"digests": digests(drawings, given)} if says_right else {})


def written_thing(thing: Thing) -> dict[str, object]:
    """A given thing as data."""
    return {
        "kind": thing.kind,
        "plane": thing.plane,
        "name": marked_up(thing.name),
        "value": written(thing.value),
    }
