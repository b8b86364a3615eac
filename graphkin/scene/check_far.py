"""A mechanism so far from the origin that its coordinates do not hold its lengths."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.scene.findings import Findings
from graphkin.scene.model import FRAME, At, Scene
from graphkin.scene.quantity import Quantity, shortest
from graphkin.text.errors import SceneError

FARTHEST = 1e9
"""Lengths of the shortest bar beyond which coordinates of 16 digits are too coarse for it."""
BESIDE = 1e3
"""Lengths of the whole mechanism beyond which it lies far from the origin."""


def check_far(scene: Scene, findings: Findings) -> None:
    """Note a frame that stands so far away that less than seven digits are left for its bars."""
    if findings.problems:
        return
    try:
        bars = [abs(metres(scene, length)) for length in bar_lengths(scene)]
        places = [(metres(scene, x), metres(scene, y)) for x, y in fixed_places(scene)]
    except SceneError:
        return
    bars = [bar for bar in bars if bar]
    if not bars or not places:
        return
    far = min(max(abs(x), abs(y)) for x, y in places)
    if far > FARTHEST * min(bars) and far > BESIDE * sum(bars):
        findings.add(
            "frame",
            f"it lies {written(far)} m from the origin, and the shortest length is "
            f"{written(min(bars))} m: coordinates of 16 digits are too coarse for that",
            f"at most {written(FARTHEST * min(bars))} m",
            "put the origin near the mechanism",
        )


def bar_lengths(scene: Scene) -> Iterator[Quantity]:
    """Every length of a bar that the scene states."""
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            yield from (length for _, _, length in placing.lengths())


def fixed_places(scene: Scene) -> Iterator[tuple[Quantity, Quantity]]:
    """The coordinates of the frame's points and of guides and tracks through coordinates."""
    for placing in scene.frame.placings:
        if isinstance(placing, At):
            yield placing.x, placing.y
    for link in scene.links.values():
        for joint in link.paths:
            if joint.on == FRAME and isinstance(joint.through, tuple):
                yield joint.through


def metres(scene: Scene, length: Quantity) -> float:
    """A length in metres."""
    return float(length.si(scene.values))


def written(length: float) -> str:
    """A length in few digits."""
    return shortest(float(f"{length:.3g}"))
