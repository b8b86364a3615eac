"""The board of a task page: the data of its script, which hold only what the task states."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.board import BESIDE, BOARD, Thing, board_given
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
    "turn.say.undone",
    "turn.say.redone",
    "turn.say.hint",
    "turn.say.sure",
    "board.begin",
    "board.drawn",
    "board.already",
    "board.nothing",
    "board.which_letter",
    "board.full",
    "board.broken",
)
"""The messages of the script; the later one of two with one name counts."""


def palette(words: Words) -> list[tuple[str, list[str]]]:
    """The actions of the board, each with the words for its inputs."""
    return [
        (key, [words(f"turn.slot.{slot}") for slot, _ in each.free or each.slots])
        for key, each in BOARD.items()
    ]


def board_record(sheets: Sequence[ScreenSheet]) -> dict[str, object]:
    """The data for the script of the board."""
    drawings = [sheet.drawing for sheet in sheets]
    given, words = board_given(drawings), drawings[0].words
    slots = {key: each.free or each.slots for key, each in BOARD.items()}
    return {
        "palette": {key: [kinds for _, kinds in own] for key, own in slots.items()},
        "beside": {
            key: names.index(BESIDE)
            for key, own in slots.items()
            if BESIDE in (names := [name for name, _ in own])
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
    }


def written_thing(thing: Thing) -> dict[str, object]:
    """A given thing as data."""
    return {
        "kind": thing.kind,
        "plane": thing.plane,
        "name": marked_up(thing.name),
        "value": written(thing.value),
        "needs": [],
    }
