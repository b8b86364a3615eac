"""Idle links: bars that no step lays off, because their pins are found without them."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence, construction, constructions
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.links.mechanism_symbols import face_words
from graphkin.drawing.symbol_markup import bar, escape

IDLE = "idle"
"""The name of a sentence about an idle link."""


def points_of(step: Step) -> set[str]:
    """The points that the sentence of a step names."""
    kind = construction(step)
    return {step.name, *(kind.points if kind is not None else ())}


def idle_sentences(drawing: Drawing) -> Iterator[Sentence]:
    """Sentences for each bar that no step lays off, because its pins are placed without it.

    A bar at which a group is closed is not idle: it is tried until it fits. Links that represent a
    cam have their own sentences.
    """
    point_sets = [
        points_of(step)
        for _, step, _ in drawing.steps(Plane.MECHANISM, Plane.NUMBERS)
        if step.part is Part.POSITION
    ]
    groups = constructions(drawing.trace.program, ClosedGroup)
    closing = {link for group in groups for link in group.cut_off}
    for link in drawing.scene.links.values():
        points = set(link.points)
        if words := face_words(drawing, link):
            yield Sentence(-1, IDLE, words, link=link.name)
        laid = link.name in closing or any(len(points & names) > 1 for names in point_sets)
        if len(points) > 1 and not laid and not link.slides and not link.wheels:
            names = {"bar": bar(*link.points[:2]), "k": escape(link.name)}
            key = "step.cam-link" if link.name in drawing.scene.cam_links else "step.idle"
            yield Sentence(-1, IDLE, drawing.words(key, **names), link=link.name)
