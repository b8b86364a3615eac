"""How profiles follow: each arc stays about its contact, which goes along both of its edges."""

from __future__ import annotations

from math import pi

from graphkin.construction.links.profile_symbols import Edge, edge_arc, edges_of, half_span
from graphkin.web.field_binder import Binding, FieldBinder, Told


def of_edges(binder: FieldBinder) -> Told:
    """The profiles of all links."""
    edges = edges_of(binder.places.drawing)
    return {edge_arc(binder.field, edge): of_edge(binder, edge) for edge in edges}


def of_edge(binder: FieldBinder, edge: Edge) -> Binding:
    """One profile, from its centre and its contact as they move."""
    about, through = edge.profile
    centre = binder.tape.lifted(binder.places.positions[about])
    way = binder.tape.lifted(binder.places.positions[through]) - centre
    middle = way.imag.do("atan2", way.real) * (180 / pi)
    half = half_span(abs(way) * binder.field.mm)
    return binder.arc(centre, abs(way), (middle - half, middle + half))
