"""Whatever one thing a scene asks, each view of its sheets and each page comes out and fits."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

import pytest
from msgspec.structs import replace

from graphkin.classroom.page_documents import hand_out_page
from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import Mechanism, load
from graphkin.scene.model import FRAME, Ask, Scene

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
TESTED = ("four-bar-change-point", "offset-slider-crank", "gears-rack")
"""A four-bar as wide as the sheet, a block on a fixed guide, wheels."""
VIEWS = ("key", "task", "steps", "overlay", "page", "task page")
POINTS = ("velocity", "acceleration", "curves")
LINKS = ("omega", "epsilon", "poles", "centres", "centrodes", "inflection")


def single_asks(scene: Scene) -> Iterator[Ask]:
    """Each point, link and pair of links of a scene asked alone for all that can be asked of it."""
    links = (scene.frame, *scene.links.values())
    for key in POINTS:
        for point in dict.fromkeys(point for link in links for point in link.points):
            yield Ask(**{key: (point,)})
    for name, link in scene.links.items():
        for key in (*LINKS, *(["slides"] if link.slides else [])):
            yield Ask(**{key: (name,)})
    for pair in combinations((FRAME, *scene.links), 2):
        yield Ask(pairs=("-".join(pair),))


@pytest.mark.parametrize(
    ("name", "view"),
    [*((TESTED[1], view) for view in VIEWS), (TESTED[0], "key"), (TESTED[2], "key")],
)
def test_every_single_thing_that_is_asked_comes_out_in_every_view(name, view):
    scene = load(str(SCENES / f"{name}.toml")).scene
    for ask in single_asks(scene):
        mechanism = Mechanism(replace(scene, ask=ask))
        if not mechanism.asked() and not (ask.curves or ask.centrodes):
            continue  # of a link that only slides there is no centre or pole
        if "page" in view:
            assert hand_out_page(mechanism, name, name, "task" if "task" in view else "key")
        else:
            pages = [page for sheet in hand_out(mechanism, view) for page in sheet.pages]
            assert pages
            for page in pages:
                page.check()
