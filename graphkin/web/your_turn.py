"""Your turn: what the page knows of the moves that a student makes, and whose score sheet it is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.registry import PALETTE, SAID_FIRST
from graphkin.drawing.field import Field
from graphkin.numbers.plane import Circle, Line, Ratio, Vector
from graphkin.text import Words
from graphkin.web.palette_moves import PLANES, PaletteMove, Pick, YourTurn
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.writers.html_markup import marked_up

SAID = (
    "turn.say.saved",
    "turn.say.arc",
    "turn.say.again",
    "turn.say.sure",
    "turn.say.choose",
    "turn.say.count",
    "turn.say.which",
    "turn.say.right",
    "turn.say.already",
    "turn.say.own",
    "turn.say.nowhere",
    "turn.say.other_cut",
    "turn.say.other_lay_off",
    "turn.say.other_turned",
    "turn.say.hint",
    "turn.say.helped",
    "turn.say.complete",
    "turn.say.part_drawn",
    "turn.say.score",
    "turn.say.alone",
    "turn.say.with_hint",
    "turn.say.with_help",
    "turn.say.wrong",
)
"""The sentences that the script says, whatever the palette holds."""


class TurnOwner(Struct, frozen=True):
    """Whose a turn is: the ``stem`` of the names of saved files; in a class the id and the opaque
    code of the variant, by which a saved score sheet is sealed.
    """

    stem: str = "graphkin"
    id: str = ""
    code: str = ""


def palette(turn: YourTurn, words: Words) -> list[tuple[str, list[str]]]:
    """The actions that a construction has use for, each with the words for its inputs."""
    used = {move.action for move in turn.moves.values()}
    if turn.alike:
        used.add("similar")
    return [
        (action, [words(f"turn.slot.{slot}") for slot, _ in each.slots])
        for action, each in PALETTE.items()
        if action in used
    ]


NOBODY = TurnOwner()


def record(
    sheets: Sequence[ScreenSheet], turn: YourTurn, owner: TurnOwner = NOBODY
) -> dict[str, object]:
    """What the script of a student's turn has to know."""
    words = sheets[0].drawing.words
    used = [action for action, _ in palette(turn, words)]
    return {
        "palette": {action: [kinds for _, kinds in PALETTE[action].slots] for action in used},
        "moves": {move.step: written_move(turn, move) for move in turn.moves.values()},
        "picks": {key: written_pick(turn, key, pick) for key, pick in turn.picks.items()},
        "along": turn.along,
        "places": turn.places,
        "shares": [
            [PLANES.index(turn.planes[step]), turn.values[step], needs]
            for step, needs in turn.shares.items()
        ],
        "owner": [owner.stem, owner.id, owner.code],
        "seconds": seconds(sheets, turn),
        "fields": [
            [plane_of(sheet), *map(frame, (sheet.layout.mechanism, sheet.layout.plan))]
            for sheet in sheets
        ],
        "words": {
            key.rpartition(".")[2]: words.sentences[key]
            for key in (*SAID, *(key for action in used for key in reasons(action, words)))
        }
        | beginning(sheets),
    }


def beginning(sheets: Sequence[ScreenSheet]) -> dict[str, str]:
    """What is said first, with the plan of a scene that the page draws."""
    words = sheets[0].drawing.words
    begin = words("turn.say.begin")
    if more := SAID_FIRST.get(sheets[0].drawing.scene.sheet.plan):
        begin += f" {words(more)}"
    return {"begin": begin}


def reasons(action: str, words: Words) -> Iterator[str]:
    """Why an input of an action is wrong, in sentences; inputs that are alike have one."""
    own = PALETTE[action]
    keys = (f"turn.say.{own.said_as or own.key}_{place}" for place in range(len(own.slots)))
    yield from (key for key in keys if words.has(key))


def seconds(sheets: Sequence[ScreenSheet], turn: YourTurn) -> float:
    """kL/kv, by which vectors are set on the mechanism."""
    step = sheets[0].drawing.trace.program.seconds
    return float(turn.values.get(step, 1.0)) if step is not None else 1.0


def plane_of(sheet: ScreenSheet) -> int:
    """The number of the plan of a sheet."""
    return PLANES.index(sheet.drawing.plane)


def frame(field: Field) -> list[float]:
    """How a field places a value: the place of its middle, the middle, millimetres to a unit."""
    return [*field.at, field.middle.real, field.middle.imag, field.mm]


def written_move(turn: YourTurn, move: PaletteMove) -> dict[str, object]:
    """A move as data; the script finds by itself what its inputs say of it."""
    found: dict[str, object] = {
        "action": move.action,
        "inputs": move.inputs,
        "at": move.at,
        "plane": PLANES.index(turn.planes[move.step]),
        "value": written(turn.values[move.step]),
    }
    if not PALETTE[move.action].named:
        found["name"] = marked_up(move.name)
    if move.about != move.name and move.action != "lay_off":
        found["about"] = marked_up(move.about)
    if move.action == "divide":
        found["needs"] = move.needs
    if move.goal:
        found["goal"] = 1
    if move.turns:
        found["turns"] = [*map(marked_up, move.turns)]
    return found


def written_pick(turn: YourTurn, key: str, pick: Pick) -> dict[str, object]:
    """Something to be picked as data; what a move gives, or two points do, is told by these."""
    found: dict[str, object] = {"kind": pick.kind}
    if key.isdigit() and int(key) in turn.moves:
        return found
    if pick.kind != "bar":
        found |= {"name": marked_up(pick.name), "plane": PLANES.index(pick.plane)}
    if pick.kind not in ("bar", "arrow"):
        found["needs"] = pick.needs
    if pick.value is not None:
        found["value"] = written(pick.value)
    if pick.on:
        found["on"] = pick.on
    if pick.by:
        found["by"] = pick.by
    return found


def written(value: Any) -> object:
    """A value as data: a number, a point [x, y], a line or vector of two, a circle {c, r}."""
    match value:
        case Ratio():
            return written(complex(value.start + value.shift / value.size))
        case Line() | Vector():
            return [written(complex(part)) for part in value]
        case Circle():
            return {"c": written(complex(value.centre)), "r": float(value.radius)}
        case complex():
            return [value.real, value.imag]
        case _:
            return float(value)
