"""The text of list."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.quantities import CENTRES, RATES, VECTORS
from graphkin.scene import scene_files
from graphkin.scene.model import Ask, Scene
from graphkin.scene.parameters import range_words
from graphkin.text.tables import labelled, listed

ASKED = {
    **{each.asked_by[0]: f"{each.words} of" for each in (*VECTORS, *RATES)},
    "slides": "sliding of",
    CENTRES[0].asked_by[0]: f"{CENTRES[0].words}s of",
    "pairs": "relative centres of",
    **{q.asked_by[0]: f"{q.circle.words if q.circle else q.words}s of" for q in CENTRES[1:]},
    "centrodes": "centrodes of",
    "curves": "paths of",
    "strokes": "strokes of",
    "time_ratios": "time ratios of",
}
"""What each key of [ask] asks for, in words."""


def labs_lines() -> Iterator[str]:
    """Every shipped lab: its title, its parameters with their ranges, and what it asks."""
    from graphkin.scene.read_scene import read_scene

    for name in scene_files.names():
        yield from lab_lines(read_scene(scene_files.find(name)))
        yield ""


def scenes_lines() -> Iterator[str]:
    """The name and title of every shipped lab and scene."""
    from graphkin.scene.file_limits import decoded, read_bytes, tables_of

    titles = {
        name: str(tables_of(decoded(read_bytes(scene_files.find(name))))["title"])
        for name in (*scene_files.names(), *scene_files.examples())
    }
    width = max(map(len, titles))
    return (f"{name:{width}}  {title}" for name, title in titles.items())


def lab_lines(scene: Scene) -> list[str]:
    """The lines about one lab."""
    parameters = [
        f"{range_words(each)} ({each.value.written({})} unless set)"
        for each in scene.parameters.values()
    ]
    return [
        scene.name,
        *labelled("", [scene.titles.get("en", scene.title)], 2),
        *labelled("  set", parameters or ["nothing"], 9),
        *labelled("  asked", [ask_words(scene.ask)], 9),
    ]


def ask_words(ask: Ask) -> str:
    """What a scene asks for, in words."""
    wanted = [(words, getattr(ask, key)) for key, words in ASKED.items()]
    return "; ".join(f"{words} {listed(names)}" for words, names in wanted if names) or "nothing"
