"""Profiles on the mechanism: the edges by which links touch others, as arcs about their centres."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, pi
from typing import NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import APART
from graphkin.drawing.areas import MARGIN
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Arc, CircleMark
from graphkin.numbers.arithmetic import phase, smaller
from graphkin.scene.known_names import place_of
from graphkin.scene.model import Profile
from graphkin.text.errors import PageError, Problem

HALF = MARGIN
"""How far a profile is drawn to each side of its contact, in mm: as far as there is room for."""
WIDEST = 60.0
"""The same in degrees about its centre, at most."""
ALL_ROUND = 180.0
"""The same of a whole circle."""


class Edge(NamedTuple):
    """A profile of a link in the plane."""

    link: str
    profile: Profile
    centre: complex
    contact: complex


def draw_edges(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """The profiles of all links."""
    board.marks += (edge_arc(drawing, field, edge) for edge in edges_of(drawing))


def edges_of(drawing: Drawing) -> Iterator[Edge]:
    """The profiles whose points are placed. Raises PageError where one has no radius."""
    scene, places = drawing.scene, drawing.positions
    for link in (scene.frame, *scene.links.values()):
        for profile in link.profiles:
            if profile.about not in places or profile.through not in places:
                continue
            edge = Edge(link.name, profile, places[profile.about], places[profile.through])
            if abs(edge.contact - edge.centre) <= APART * drawing.standing.size:
                raise PageError(without_radius(edge))
            yield edge


def without_radius(edge: Edge) -> Problem:
    """The problem of a profile whose centre lies on it."""
    about, through = edge.profile.about, edge.profile.through
    found = f"{about} and {through} stand at one place"
    hint = "change the position, or leave the profile out"
    return Problem(f"{place_of(edge.link)}.profiles", found, "an arc with a radius", hint)


def edge_arc(drawing: Drawing, field: Field, edge: Edge) -> Arc | CircleMark:
    """The arc of a profile about its contact, as long as it is told to be, or its whole circle."""
    radius = abs(edge.contact - edge.centre) * field.mm
    middle = phase(edge.contact - edge.centre) * (180 / pi)
    if edge.profile.arc is None:
        half = smaller(degrees(HALF) / radius, WIDEST)
    else:
        half = degrees(float(edge.profile.arc.si(drawing.scene.values))) / 2
    if half >= ALL_ROUND:
        return CircleMark(*field(edge.centre), radius, "profile", edge.link)
    ends = middle - half, middle + half
    return Arc(*field(edge.centre), radius, *ends, "profile", edge.link)
