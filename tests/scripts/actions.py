"""The actions of the palette as modules of the page, written from the registry of Python."""

from __future__ import annotations

import json
from collections.abc import Mapping

from graphkin.construction.core.palette import PaletteAction
from graphkin.construction.registry import BOARD, PALETTE
from graphkin.drawing.style import DRAWN

HEAD = """\
// {what}, as graphkin.construction.registry has them. Made by `python -m tests.scripts`.

/** Shape of each result, its drawing (0 mechanism, 1 velocities, 2 accelerations, 3 numbers), and
 * the input whose drawing it shares; only where it is no point beside its first input.
 * @type {{Record<string, [string, number | null, number]>}} */
export const ACTIONS = {actions};

/** The signs and words by which each action is typed.
 * @type {{Record<string, string[]>}} */
export const TYPED = {typed};

/** What each action draws from the keys of its picks: a list of results.
 * @param {{any}} given
 * @returns {{Record<string, (...keys: any[]) => any[]>}} */
export const drawn_by = ({{ {helpers} }}) => ({{
{drawn}
}});
"""
HELPERS = (
    "plus", "minus", "scaled", "quarter", "long", "dot", "cross", "times", "over", "cuts",
    "value_of", "way", "places_of", "reach", "normal", "picks", "shares", "seconds", "all_done",
)  # fmt: skip
"""What the palette of the page lends to the actions."""
STROKES = """
/** The marks that a pen draws. */
export const STROKES = {strokes};
"""
FILES = {"page_actions.js": PALETTE, "board_actions.js": BOARD}
"""The written modules with their actions: of your turn, and of the board of a task page."""


def modules() -> dict[str, str]:
    """The text of each written module."""
    found = {
        name: written("The actions " + what, actions)
        for (name, actions), what in zip(
            FILES.items(), ("of your turn", "of the board"), strict=True
        )
    }
    looks = json.dumps(",".join(f".{look}" for look in (*DRAWN, "link", "outline")))
    found["page_actions.js"] += STROKES.format(strokes=looks)
    return found


def written(what: str, actions: Mapping[str, PaletteAction]) -> str:
    """A module of some actions."""
    shapes = {key: [each.shape, each.plane, each.lies_with] for key, each in actions.items()}
    drawn = [f"  {key}: {each.script.strip()}," for key, each in actions.items()]
    return HEAD.format(
        what=what,
        actions=table({key: one for key, one in shapes.items() if one != ["point", None, 0]}),
        typed=table({key: list(each.typed) for key, each in actions.items()}),
        helpers=", ".join(each for each in HELPERS if any(each in one for one in drawn)),
        drawn="\n".join(drawn),
    )


def table(rows: Mapping[str, object]) -> str:
    """An object with one row a line."""
    lines = [f"  {key}: {json.dumps(row, ensure_ascii=False)}," for key, row in rows.items()]
    return "\n".join(("{", *lines, "}"))
