"""What helps to write a scene: the keys that each table may have, and where each name stands."""

from __future__ import annotations

from functools import lru_cache

from msgspec import Struct

from graphkin.scene.model import DRIVEN, JOINED, KEYWORDS
from graphkin.scene.read_scene import known_keys
from graphkin.studio.mends import units
from graphkin.studio.toml_spans import Span, spans

LINES = "\n"
EVERY = f"""
[parameters.n]
[frame]
O = {{ from = 0 }}
[links.1]
A = [0, 0]
P = {{ from = 0 }}
{LINES.join(f"{key} = {{}}" for key in JOINED)}
touches = {{}}
profiles = {{ about = "A" }}
cam = {{ law = [{{}}] }}
[links.2]
O-B = 1
cam = {{ tip = "roller" }}
{LINES.join(f"[[drivers]]{LINES}{kind} = 1" for kind in DRIVEN)}
[branches]
[ask]
[sheet]
[titles]
[names]
[notes]
"""
"""A table of each kind: the reader tells its keys also where a text has none of the kind yet."""


@lru_cache(maxsize=1)
def every_key() -> dict[str, list[str]]:
    """The keys of a table of each kind."""
    return known_keys(EVERY, "every")


class EditingHelp(Struct, frozen=True):
    """``keys`` are those that the reader knows, by the place of their table; ``points``, ``links``
    and ``parameters`` are the names that the text gives, ``spots`` where each stands, that of a bar
    AB at its key A-B: its start and end as a browser counts them.
    """

    keys: dict[str, list[str]]
    points: list[str]
    links: list[str]
    parameters: list[str]
    spots: dict[str, tuple[int, int]]


def editing_help(text: str, name: str) -> EditingHelp:
    """The help of a text, as far as it can be read."""
    found = spans(text)
    points, links, parameters = dict[str, Span](), dict[str, Span](), dict[str, Span]()
    bars: dict[str, Span] = {}
    for path, span in found.items():
        match path:
            case ("links", str(link)):
                links.setdefault(link, span)
            case ("parameters", str(parameter)):
                parameters.setdefault(parameter, span)
            case ("frame", str(key)) | ("links", str(_), str(key)) if key not in KEYWORDS:
                ends = key.split("-")
                for point in ends:
                    points.setdefault(point, span)
                bars.setdefault("".join(ends), span)
    every = {**parameters, **bars, **links, **points}
    spots = {each: (units(text[: at.start]), units(text[: at.end])) for each, at in every.items()}
    known = every_key() | known_keys(text, name)
    keys = {place: list(dict.fromkeys(own)) for place, own in known.items()}
    return EditingHelp(keys, [*points], [*links], [*parameters], spots)
