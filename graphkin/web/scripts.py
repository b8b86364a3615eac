"""The scripts of pages: short files that share their names, put together in a fixed order."""

from __future__ import annotations

import json
import re
from functools import lru_cache

from graphkin.construction.registry import PALETTE
from graphkin.drawing.style import DRAWN
from graphkin.web.offline_page import part

STEP_PAGE = (
    "page.js",
    "numbers.js",
    "sheets.js",
    "bars.js",
    "zoom.js",
    "view.js",
    "lettering.js",
    "halos.js",
    "highlights.js",
    "carried.js",
    "writing.js",
    "tracing.js",
    "sentences.js",
    "values.js",
    "stepping.js",
    "travel.js",
    "driver.js",
    "figures.js",
    "grab.js",
    "beginning.js",
    "room.js",
    "address.js",
    "playing.js",
    "palette.js",
    "turn_state.js",
    "picking.js",
    "checking.js",
    "your_turn.js",
    "aiming.js",
    "keys.js",
)
"""The script of a step page: at once, a file uses only what stands before it."""
PLAYER = ("numbers.js", "curves.js", "player.js")
"""The script of a cycle's page."""
MOVING = ("closing.js", "moving.js")
"""What lays out the marks that follow the driver."""
FORM = ("form.js",)
"""The script of a form for answers."""
WRITTEN_IN = {
    "$STROKES": json.dumps(",".join(f".{look}" for look in (*DRAWN, "link", "outline"))),
    "$ACTIONS": json.dumps(
        {
            key: [each.shape, each.plane, each.lies_with]
            for key, each in PALETTE.items()
            if (each.shape, each.plane, each.lies_with) != ("point", None, 0)
        },
        separators=(",", ":"),
    ),
    "...$DRAW,": "\n".join(
        f"{key}: {''.join(map(str.strip, each.script.splitlines(keepends=False)))},"
        for key, each in PALETTE.items()
    ),
}
"""What files leave to the kinds of lines and to the actions of the palette."""
REMARK = re.compile(r"(?<=[;,{}\])])\s+// [^\"'`]*$")
"""A remark at the end of a line, in which no text can stand."""
TEXT = re.compile("[\"'`/\\\\]")
"""What a line with a text, a pattern or a division holds."""
SIGN = re.compile(r" *([=<>?:,;{}()\[\]&|*]+) *")
"""Signs that need no blanks; two signs + or - must not meet."""
REMARKS = ("//", "/**")
"""How lines begin that only a reader of the files needs."""


def together(names: tuple[str, ...]) -> str:
    """Some files as one script, whose names nothing else on the page sees."""
    return "\n".join(("(() => {", '"use strict";', tight(joined(names)), "})();"))


def tight(script: str) -> str:
    """A script without blanks around signs, on the lines that hold no text and no division."""
    lines = script.split("\n")
    return "\n".join(line if TEXT.search(line) else SIGN.sub(r"\1", line) for line in lines)


@lru_cache(maxsize=4)
def joined(names: tuple[str, ...]) -> str:
    """Some files one after the other, without remarks."""
    lines = (REMARK.sub("", line.strip()) for name in names for line in part(name).splitlines())
    script = "\n".join(line for line in lines if line and not line.startswith(REMARKS))
    for place, what in WRITTEN_IN.items():
        script = script.replace(place, what)
    return script
