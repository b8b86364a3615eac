"""The relations of a cam's law and of the centre of curvature that follows from it."""

from __future__ import annotations

import math
from collections.abc import Container, Iterator
from functools import partial

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.cams.cam_centre import CurvatureCentre
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import constructions
from graphkin.construction.core.naming import way_of
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.relation import Relation, as_read, bracketed, figure, length_of
from graphkin.drawing.richtext import words_of
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.cam_motions import BORDER, turned

FORMS = {
    "uniform": ("{h}·{x}", "{h}/{b}", "0"),
    "parabolic": ("2·{h}·{x}^2", "4·{h}·{x}/{b}", "4·{h}/{b}^2"),
    "parabolic-late": ("{h}·(1 − 2·(1 − {x})^2)", "4·{h}·(1 − {x})/{b}", "−4·{h}/{b}^2"),
    "harmonic": (
        "{h}·(1 − cos(180°·{x}))/2",
        "π·{h}·sin(180°·{x})/(2·{b})",
        "π^2·{h}·cos(180°·{x})/(2·{b}^2)",
    ),
    "cycloidal": (
        "{h}·({x} − sin(360°·{x})/(2·π))",
        "{h}·(1 − cos(360°·{x}))/{b}",
        "2·π·{h}·sin(360°·{x})/{b}^2",
    ),
    "3-4-5": (
        "{h}·(10·{x}^3 − 15·{x}^4 + 6·{x}^5)",
        "30·{h}·{x}^2·(1 − {x})^2/{b}",
        "60·{h}·{x}·(1 − {x})·(1 − 2·{x})/{b}^2",
    ),
    "4-5-6-7": (
        "{h}·(35·{x}^4 − 84·{x}^5 + 70·{x}^6 − 20·{x}^7)",
        "140·{h}·{x}^3·(1 − {x})^3/{b}",
        "420·{h}·{x}^2·(1 − {x})^2·(1 − 2·{x})/{b}^2",
    ),
}
"""Lift, first and second derivative of each motion, by rise h, fraction x and length b."""
POLES = tuple("PSTUVWXYZ") + tuple(f"P{k}" for k in range(1000))
"""Candidate names of the point in which the cam and its follower have the same velocity."""


def of_cams(drawing: Drawing, used: Container[tuple[str, str]] = ()) -> Iterator[Relation]:
    """The displacement and derivatives of each follower, and how its centre of curvature follows.

    The distance of the centre from the pivot of its cam is added where this length is in ``used``.
    """
    for centre in constructions(drawing.trace.program, CurvatureCentre):
        if centre.point in drawing.trace.values:
            yield from of_law(drawing, centre)
            yield from of_height(drawing, centre)
            how = how_found(drawing, centre)
            if how:
                first, *more = words_of(how)
                yield Relation(first, more=tuple(more))
            if (centre.start, centre.name) in used:
                yield of_distance(drawing, centre)


def of_law(drawing: Drawing, centre: CurvatureCentre) -> Iterator[Relation]:
    """The displacement and its two derivatives, by the formulas of the current piece."""
    words, slides = drawing.words, drawing.scene.cams[centre.follower].slides
    remark = words(f"calculation.law_{'plate' if slides else 'cam'}", g=escape(centre.link))
    piece = None if slides else piece_at(drawing, centre)
    found = list(of_piece(drawing, piece)) if piece else []
    yield from found[:-3]
    formulas = found[-3:] or [Relation("")] * 3
    for (name, number, unit), formula in zip(centre.law_values(drawing), formulas, strict=True):
        said = "" if formula.symbols else remark
        yield replace(formula, left=name, result=number, unit=unit, remark=said)


def of_height(drawing: Drawing, centre: CurvatureCentre) -> Iterator[Relation]:
    """The distance of a flat face on a guide from the pivot of its cam, along that guide."""
    cam, words, k = drawing.scene.cams[centre.follower], drawing.words, escape(centre.follower)
    if not cam.is_flat or cam.lever or cam.slides:
        return
    base = float(cam.base.si(drawing.scene.values))
    high = base + float(drawing.trace.values[centre.lift])
    lift, lifted, unit = next(centre.law_values(drawing))
    yield Relation(
        words("calculation.face_height", b=symbol(cam.point), o=symbol(centre.start), k=k)
    )
    drawn = in_mm(words, drawing.on_paper(high))
    remark = words("calculation.guide_drawn", guide=way_of(drawing, centre.follower), drawn=drawn)
    figures = f"{words.fixed(drawing.length(base), 3)} + {bracketed(lifted)}"
    result = words.fixed(drawing.length(high), 3)
    yield Relation(f"*h*_{{{k}}}", f"*r*_b + {lift}", figures, result, unit, remark)


class LawPiece(Struct, frozen=True):
    """A piece of a cam's law that moves the follower, in radians and the scene's own unit of lift.

    ``angle`` is the cam's angle from the start of the law. The piece begins at ``begin`` with the
    lift ``start``, has the length ``span`` and adds ``rise``. ``sense`` is the sense of the law.
    """

    motion: str
    letter: str
    angle: float
    begin: float
    span: float
    start: float
    rise: float
    sense: int


def piece_at(drawing: Drawing, centre: CurvatureCentre) -> LawPiece | None:
    """The piece of the law at the cam's angle; None in a dwell, and for tables."""
    cam, values = drawing.scene.cams[centre.follower], drawing.scene.values
    if cam.slopes:
        return None
    steps = drawing.trace.values
    axis, start = (steps[each] for each in drawing.trace.program.steps[centre.lift].args[:2])
    turn = axis * start.conjugate()
    angle = turned(turn if cam.sense > 0 else turn.conjugate())
    one = math.degrees(1) if cam.lever else drawing.length(1.0)
    begin = lifted = 0.0
    for piece in cam.law:
        end, rise = (float(each.si(values)) for each in (piece.to, piece.rise))
        if angle < end - BORDER:
            break
        begin, lifted = end, lifted + rise
    if not rise:
        return None
    letter = "ψ" if cam.lever else "s"
    found = (angle, begin, end - begin, lifted * one, rise * one)
    return LawPiece(piece.motion, letter, *found, cam.sense)


def of_piece(drawing: Drawing, piece: LawPiece) -> Iterator[Relation]:
    """The fraction of a piece covered, its length in radians, its lift and derivatives.

    The lift and the derivatives are formulas. Yields nothing for motions that are sums of several
    sines.
    """
    late = piece.motion == "parabolic" and piece.angle - piece.begin >= piece.span / 2
    forms = FORMS.get(piece.motion + ("-late" if late else ""))
    if forms is None:
        return
    put, words = partial(figure, drawing, digits=6), drawing.words
    degrees = drawing.scene.units["angle"] == "deg"
    angle, begin, span = (
        put(math.degrees(each) if degrees else each)
        for each in (piece.angle, piece.begin, piece.span)
    )
    share, radians = put((piece.angle - piece.begin) / piece.span), put(piece.span)
    yield Relation(words("calculation.law_piece", s=f"*{piece.letter}*_0"))
    yield Relation("*x*", "(*θ* − *θ*_0)/*β*", f"({angle} − {begin})/{span}", share)
    yield Relation("*β*", "", f"π·{span}/180" if degrees else "", radians, "rad")
    turned_rise = math.radians(piece.rise) if piece.letter == "ψ" else piece.rise
    if piece.letter == "ψ":
        yield Relation("*H*", "", f"π·{bracketed(put(piece.rise))}/180", put(turned_rise), "rad")
    for number, form in enumerate(forms):
        rise = turned_rise if number else piece.rise
        ahead = (
            ("", "")
            if number or not piece.start
            else (f"*{piece.letter}*_0 + ", f"{put(piece.start)} + ")
        )
        minus = "−" if number == 1 and piece.sense < 0 else ""
        symbols = form.format(h="*H*", x="*x*", b="*β*")
        figures = form.format(h=bracketed(put(rise)), x=share, b=radians)
        yield Relation("", f"{ahead[0]}{minus}{symbols}", f"{ahead[1]}{minus}{figures}")


def how_found(drawing: Drawing, centre: CurvatureCentre) -> str:
    """How the centre follows from the law by hand; empty where no short formula gives it.

    Let t = w′ - iw be the tangent of the pitch curve in the axes of the cam, and m = w″ - 2iw′ - w.
    The tip w is at the distance |t|³/(m×t) from the centre, on the normal. The normal passes
    through the point in which the cam and the follower have the same velocity. Source: Norton, Cam
    Design and Manufacturing Handbook, ch. 7.
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
    """The distance from the pivot to the centre, as measured."""
    size = drawing.on_paper(length_of(drawing, centre.start, centre.name))
    reading = as_read(drawing, size, drawing.scales.kL / 1000)
    remark = drawing.words("calculation.measured")
    ends = centre.start, centre.name
    return Relation(bar(*ends), "", *reading, "m", remark, over=(ends,))
