"""The words of wheels on the mechanism: their tracks, how far they have come and turned."""

from __future__ import annotations

from math import degrees

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.sentence import Sentence, together
from graphkin.drawing.richtext import escape
from graphkin.drawing.symbol_markup import symbol

UNTURNED = 0.05
"""A wheel that has turned by less, in degrees, is drawn as at the start."""


def turned_by(drawing: Drawing, link: str) -> str:
    """By how many degrees a wheel has turned since the start; nothing for what rolls nowhere."""
    since = turned_since(drawing, link)
    return "" if since is None else drawing.words.fixed(since, 1)


def turned_since(drawing: Drawing, link: str) -> float | None:
    """The same in degrees; None for what rolls nowhere."""
    targets, values = drawing.trace.program.targets, drawing.trace.values
    ends = [targets.get((what, link), -1) for what in ("turned", "turned from")]
    if not all(number in values for number in ends):
        return None
    now, start = (float(values[number]) for number in ends)
    return degrees(now - start)


def with_starts_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The points of each wheel that stands as at the start said in one sentence: as given."""
    steps = drawing.trace.program.steps
    alike: dict[tuple[str, str], list[Sentence]] = {}
    for said in found:
        step = steps[said.step] if said.step >= 0 else None
        if step is not None and step.action is not None and step.action.key == "beside":
            link, start = step.says["g"], step.says["p"]
            since = turned_since(drawing, link)
            if since is not None and abs(since) < UNTURNED:
                alike.setdefault((link, start), []).append(said)
    for (link, start), some in alike.items():
        names = drawing.words("list_mark").join(symbol(steps[said.step].name) for said in some)
        fields = {"g": escape(link), "p": symbol(start), "list": names}
        found = together(found, some, drawing.words("step.beside-start", **fields))
    return found
