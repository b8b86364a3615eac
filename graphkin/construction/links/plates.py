"""The bodies of links: bars whose points lie in line, plates around the others."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.guides.rails import places_of
from graphkin.numbers.arithmetic import phase
from graphkin.numbers.plane import cross
from graphkin.scene.model import Link

FLAT = 1e-6
"""How far beside a bar, in parts of its length, a point still counts as on it."""


def farthest(places: list[complex]) -> tuple[complex, complex]:
    """The two places that are farthest apart."""
    return max(
        ((p, q) for i, p in enumerate(places) for q in places[i + 1 :]),
        key=lambda ends: abs(ends[1] - ends[0]),
    )


def corners_of(drawing: Drawing, link: Link) -> list[complex] | None:
    """The corners of a plate in order around it; None for a bar, whose points lie in line."""
    places = places_of(drawing, link.name)
    if len(places) < 3 or is_all_wheel(drawing, link.name):
        return None
    first, last = farthest(places)
    along = last - first
    if all(abs(cross(along, p - first)) <= FLAT * abs(along) ** 2 for p in places):
        return None
    around = hull(places)
    start = min(range(len(around)), key=lambda i: phase(around[i] - sum(around) / len(around)))
    return around[start:] + around[:start]


def is_all_wheel(drawing: Drawing, link: str) -> bool:
    """True for a link whose points all lie on one of its wheels: it needs no bar or plate."""
    places = places_of(drawing, link)
    return any(
        all(abs(place - disc.centre) <= disc.radius * (1 + 1e-6) for place in places)
        for disc in drawing.standing.discs
        if disc.link == link and not disc.wheel.inside
    )


def hull(places: list[complex], flat: float = FLAT) -> list[complex]:
    """The corners of the convex figure around places, in order around it, but for those nearly in
    line with others (``flat``, in parts of its size); two where all lie in line."""
    ordered = sorted(places, key=lambda p: (p.real, p.imag))
    ordered = [p for i, p in enumerate(ordered) if not i or p != ordered[i - 1]]
    least = flat * max(abs(p - ordered[0]) for p in ordered) ** 2
    around: list[complex] = []
    for half in (ordered, ordered[::-1]):
        chain: list[complex] = []
        for p in half:
            while len(chain) > 1 and cross(chain[-1] - chain[-2], p - chain[-1]) <= least:
                chain.pop()
            chain.append(p)
        around += chain[:-1]
    return around
