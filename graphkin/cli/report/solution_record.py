"""The JSON of solve: SI units, x right, y up, counter-clockwise positive, full precision."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import isfinite
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from graphkin.construction.core.quantities import (
    CENTRES,
    OF_POINTS,
    OF_SLIDES,
    RATES,
    SLIDING,
    Around,
    LinkMotion,
    MotionQuantity,
    PointMotion,
    SlideMotion,
    Whose,
    motion_value,
    names_asked,
    points_asked,
)
from graphkin.construction.core.solution import Solution, Verdict
from graphkin.documents.centre_tables import breadth_of, place_of, with_blocks
from graphkin.numbers.arithmetic import FLOAT, Kind
from graphkin.numbers.plane import Ratio
from graphkin.scene.link_points import ends_of, is_under
from graphkin.scene.model import Scene

if TYPE_CHECKING:
    from graphkin.drawing.scale import Scales

Record = dict[str, Any]
Wanted = Callable[[MotionQuantity, str], bool]
"""Whether to report a quantity of a point, link or block."""


def record(
    scene: Scene,
    solution: Solution,
    verdict: Verdict | None,
    scales: Scales | None,
    *,
    asked: bool = False,
) -> Record:
    """Everything that solve reports, under the names of the scene and in its order.

    Without ``scales`` the record has none: they belong to a drawing.
    """
    full, wanted = with_blocks(scene, solution), wanted_of(scene, asked)
    slides, breadth = as_given(scene, full.slides), breadth_of(full)
    return {
        "name": scene.name,
        "parameters": {name: plain(scene.values.get(name)) for name in scene.parameters},
        "points": named(
            point_names(scene, full), lambda n: point(n, motion_of(n, full), wanted, breadth)
        ),
        "links": named(scene.links, lambda n: link(n, full.links[n], wanted, breadth)),
        **centres(scene, full),
        "slides": named(
            filter(slides.__contains__, scene.links), lambda n: slide(n, slides[n], wanted)
        ),
        **drawn_at(scales, verdict),
        "witness": witness(verdict),
        "margin": real(solution.margin),
    }


def drawn_at(scales: Scales | None, verdict: Verdict | None) -> Record:
    """The scale factors of the sheets, if they were computed.

    Those of the plans are null if some numbers have no sure digit.
    """
    if scales is None:
        return {}
    sure = verdict is None or not verdict.unsure
    plans = {"kv": scales.kv, "ka": scales.ka} if sure else {"kv": None, "ka": None}
    return {"scales": {"kL": scales.kL * scales.metre, **plans}}


def wanted_of(scene: Scene, asked: bool) -> Wanted:
    """A test that accepts every quantity, or only what [ask] asks."""
    return lambda quantity, of: not asked or of in names_asked(scene.ask, quantity)


def point_names(scene: Scene, solution: Solution) -> list[str]:
    """The frame's points, the links' points as written, then points such as A@3."""
    written = [p for link in scene.every_link for p in link.points]
    asked = filter(is_under, points_asked(scene.ask))
    names = dict.fromkeys((*written, *asked, *solution.points))
    return [name for name in names if motion_of(name, solution) is not None]


def motion_of(name: str, solution: Solution) -> PointMotion | None:
    """The motion of a point; A@3 is A itself if A belongs to link 3."""
    return solution.points.get(name) or solution.points.get(ends_of(name)[0])


def named(names: Any, entry: Callable[[str], Record]) -> Record:
    """An entry for each name that has anything to report."""
    entries = ((name, entry(name)) for name in names)
    return {name: found for name, found in entries if found}


def point(name: str, motion: PointMotion | None, wanted: Wanted, breadth: float) -> Record:
    """Position, velocity and acceleration of a point, and its centres, if wanted and known."""
    found = {q.key: motion_value(motion, q) for q in OF_POINTS if wanted(q, name)}
    known = {key: pair(value) for key, value in found.items() if value is not None}
    return known | of_centres("points", name, motion, wanted, breadth)


def link(name: str, motion: LinkMotion, wanted: Wanted, breadth: float) -> Record:
    """Turning of a link, and its centres."""
    found = {q.key: real(motion_value(motion, q)) for q in RATES if wanted(q, name)}
    return found | of_centres("links", name, motion, wanted, breadth)


def of_centres(whose: Whose, name: str, motion: Any, wanted: Wanted, breadth: float) -> Record:
    """The centres of a link or a point, or null if they are at infinity.

    A centre with a circle is reported as that circle, if it is known.
    """
    found: Record = {}
    for q in CENTRES:
        if q.whose != whose or not wanted(q, name):
            continue
        value = motion_value(motion, q)
        if q.circle is None:
            found[q.key] = pair(place_of(value, breadth))
        elif value is not None:
            found[q.key] = circle(q.circle, motion, place_of(value, breadth), breadth)
    return found


def circle(around: Around, motion: Any, found: complex | None, breadth: float) -> Record | None:
    """The circle of a centre that was found; null if it has no finite radius."""
    start = getattr(motion, around.start)
    first = place_of(start, breadth) if isinstance(start, Ratio) else start
    if first is None or found is None:
        return None
    parts = around.parts(first, found)
    return {key: real(part) if key == "radius" else pair(part) for key, part in parts.items()}


def centres(scene: Scene, solution: Solution) -> Record:
    """The relative centres that are asked, or null if they are at infinity."""
    breadth = breadth_of(solution)
    known = [name for name in scene.ask.pairs if name in solution.centres]
    found = {name: pair(place_of(solution.centres[name], breadth)) for name in known}
    return {"centres": found} if found else {}


def as_given(
    scene: Scene, slides: Mapping[str, SlideMotion], kind: Kind = FLOAT
) -> dict[str, SlideMotion]:
    """Motions of blocks, in a number kind, with the values that drivers give along their guides.

    A measured value along the guide differs from the given one by rounding. Unknown values stay
    unknown.
    """
    found, values = dict(slides), scene.values if kind is FLOAT else scene.values_in(kind)
    for driver in scene.drivers:
        own = found.get(driver.link)
        if driver.kind != "slide" or own is None:
            continue
        if driver.against != scene.links[driver.link].slides[0].on:
            continue
        given = {
            key: getattr(driver, key).si(values, kind)
            for key in ("position", "speed", "acceleration")
            if (value := getattr(own, key)) is not None and kind.sound(value)
        }
        found[driver.link] = replace(own, **given)
    return found


def slide(name: str, motion: SlideMotion, wanted: Wanted) -> Record:
    """Motion of a block along its guide; the vector of a guide that does not turn is 0."""
    if not wanted(SLIDING["position"], name):
        return {}
    found = ((q, motion_value(motion, q)) for q in OF_SLIDES)
    return {
        q.attribute: real(value) if q.sort == "number" else pair(value or 0j) for q, value in found
    }


def witness(verdict: Verdict | None) -> Record:
    """The verdict of the independent check; without a verdict, ``agrees`` is false."""
    if verdict is None:
        return {"agrees": False, "largest_difference": None}
    return {
        "agrees": verdict.agrees,
        "largest_difference": real(verdict.largest_difference),
        "quantity": verdict.quantity,
        "limit": real(verdict.limit),
        "branches_not_held": list(verdict.branches),
        "digits": dict(verdict.digits),
        "unsure": list(verdict.unsure),
    }


def real(value: Any) -> float | None:
    """A finite float, never minus zero; None for an unknown or infinite value."""
    return float(value) + 0.0 if value is not None and isfinite(value) else None


def pair(value: complex | None) -> list[float | None] | None:
    """The two components of a point or vector."""
    return None if value is None else [real(value.real), real(value.imag)]


def plain(value: object) -> int | float | None:
    """A parameter's value, as an int if it is whole."""
    if isinstance(value, Fraction) and value.denominator == 1:
        return int(value)
    return real(value)


def heading(scene: Scene) -> str:
    """Title and name of a scene, and its parameters as set."""
    settings = settings_words({name: plain(scene.values.get(name)) for name in scene.parameters})
    return f"{scene.title} ({scene.name})" + (f", {settings}" if settings else "")


def settings_words(parameters: Mapping[str, Any]) -> str:
    """Parameters as set, such as n = 7."""
    return ", ".join(f"{name} = {value}" for name, value in parameters.items())
