"""How profiles follow: each arc stays about its contact, which goes along both of its edges."""

from __future__ import annotations

from math import pi

from graphkin.paper.edges import Edge, edge_arc, edges_of, half_span
from graphkin.screen.binding import Bench, Binding, Told


def of_edges(bench: Bench) -> Told:
    """The profiles of all links."""
    edges = edges_of(bench.places.drawing)
    return {edge_arc(bench.field, edge): of_edge(bench, edge) for edge in edges}


def of_edge(bench: Bench, edge: Edge) -> Binding:
    """One profile, from its centre and its contact as they move."""
    about, through = edge.profile
    centre = bench.shelf.lifted(bench.places.positions[about])
    way = bench.shelf.lifted(bench.places.positions[through]) - centre
    middle = way.imag.do("atan2", way.real) * (180 / pi)
    half = half_span(abs(way) * bench.field.mm)
    return bench.arc(centre, abs(way), (middle - half, middle + half))
