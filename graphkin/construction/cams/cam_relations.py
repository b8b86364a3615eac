"""What the law of a cam gives, and the centre of curvature that follows from it, in figures."""

from __future__ import annotations

from collections.abc import Container, Iterator

from graphkin.construction.cams.cam_centre import CurvatureCentre
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import constructions
from graphkin.construction.core.relation import Relation, as_read, length_of
from graphkin.drawing.richtext import words_of
from graphkin.drawing.symbol_markup import bar, escape, symbol

POLES = tuple("PSTUVWXYZ") + tuple(f"P{k}" for k in range(1000))
"""What the point may be called in which a cam and its follower move alike."""


def of_cams(drawing: Drawing, used: Container[tuple[str, str]] = ()) -> Iterator[Relation]:
    """The displacement of each follower and its derivatives, how the centre of curvature follows
    from them, and how far that lies from the pivot of its cam, where this length is ``used``.
    """
    for centre in constructions(drawing.trace.program, CurvatureCentre):
        if centre.point in drawing.trace.values:
            yield from of_law(drawing, centre)
            how = how_found(drawing, centre)
            if how:
                first, *more = words_of(how)
                yield Relation(first, more=tuple(more))
            if (centre.start, centre.name) in used:
                yield of_distance(drawing, centre)


def of_law(drawing: Drawing, centre: CurvatureCentre) -> Iterator[Relation]:
    """The displacement and its two derivatives."""
    words = drawing.words
    key = (
        "calculation.law_plate"
        if drawing.scene.cams[centre.follower].slides
        else "calculation.law_cam"
    )
    for name, number, unit in centre.law_values(drawing):
        yield Relation(name, "", "", number, unit, words(key, g=escape(centre.link)))


def how_found(drawing: Drawing, centre: CurvatureCentre) -> str:
    """How the centre follows from the law by hand; nothing for what no short formula gives.

    With t = w′ - iw the tangent of the pitch curve in the axes of the cam and m = w″ - 2iw′ - w the
    tip w is |t|³/(m×t) from the centre, on the normal, which passes through the point in which cam
    and follower move alike (Norton, Cam Design and Manufacturing Handbook, ch. 7).
    """
    cam, words = drawing.scene.cams[centre.follower], drawing.words
    if cam.slides or (cam.is_flat and cam.lever):
        return ""
    k, o, b, link = (
        symbol(centre.name),
        symbol(centre.start),
        symbol(cam.point),
        escape(centre.follower),
    )
    fields = {"k": k, "o": o, "b": b, "link": link, "ok": bar(centre.start, centre.name)}
    fields["bk"] = bar(cam.point, centre.name)
    fields["pole"] = symbol(next(each for each in POLES if each not in drawing.scene.points))
    if cam.lever:
        pin = cam.lever.pin
        return words(
            "calculation.centre_lever",
            q=symbol(pin),
            oq=bar(centre.start, pin),
            qb=bar(pin, cam.point),
            sign="+" if cam.lever.side > 0 else "−",
            **fields,
        )
    return words(
        "calculation.centre_face" if cam.is_flat else "calculation.centre_guided", **fields
    )


def of_distance(drawing: Drawing, centre: CurvatureCentre) -> Relation:
    """How far the centre lies from the pivot, as it is measured."""
    size = drawing.on_paper(length_of(drawing, centre.start, centre.name))
    told = as_read(drawing, size, drawing.scales.kL / 1000)
    remark = drawing.words("calculation.measured")
    ends = centre.start, centre.name
    return Relation(bar(*ends), "", *told, "m", remark, over=(ends,))
