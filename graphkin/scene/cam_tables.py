"""A cam's law by points of a table: the periodic cubic spline through them, exactly.

Between two points it is a cubic; both derivatives go on over every point, and over the end of the
turn (de Boor, A Practical Guide to Splines, chapter IV).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from graphkin.scene.expression import Number, Pair, Tree
from graphkin.scene.findings import numbered, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import CamPiece
from graphkin.scene.quantity import Quantity, exact

LEAST_POINTS = 4
MOST_POINTS = 72
TABLE = "table"


def is_table(raw: object) -> bool:
    """Whether a law is written as a table: a list of pairs."""
    return isinstance(raw, list) and bool(raw) and all(isinstance(each, list) for each in raw)


def read_table(
    place: str, raw: Sequence[object], measures: Measures, *, swings: bool
) -> tuple[CamPiece, ...]:
    """The cubics through points ``[angle, lift]``; the first is [0, 0], angles grow to the turn's
    end, which is not repeated."""
    findings, before = measures.findings, len(measures.findings.problems)
    if not LEAST_POINTS <= len(raw) <= MOST_POINTS:
        expected = f"{LEAST_POINTS} to {MOST_POINTS} points [angle, lift]"
        findings.add(place, f"{len(raw)} points", expected)
        return ()
    lifted = measures.angle if swings else measures.length
    angles, lifts = list[Fraction](), list[Quantity]()
    for index, pair in enumerate(raw):
        where = numbered(place, index, len(raw))
        if not isinstance(pair, list) or len(pair) != 2:
            findings.add(where, shown(pair), "two numbers [angle, lift]")
            continue
        read, lift = measures.angle(where, pair[0]), lifted(where, pair[1])
        if read.uses():
            findings.add(where, shown(pair), "an angle without parameters")
            continue
        angle = Fraction(read.number({}))
        if angles and angle <= angles[-1]:
            found = f"{float(angle):g} after {float(angles[-1]):g}"
            findings.add(where, found, "angles that grow")
        if lift.number(measures.values) < 0:
            hint = "the base circle is the smallest: let the table begin at the lowest place"
            findings.add(where, shown(pair), "a lift of 0 or more", hint)
        angles.append(angle)
        lifts.append(lift)
    if len(findings.problems) > before:
        return ()
    whole = Fraction(360) if measures.units["angle"] == "deg" else None
    if angles[0] != 0 or not lifts[0].is_zero():
        findings.add(numbered(place, 0, len(raw)), shown(raw[0]), "[0, 0]")
    if whole is None:
        findings.add(place, "a table with angles in rad", 'units = { angle = "deg", … }')
    elif angles[-1] >= whole:
        hint = "after a whole turn the table begins again"
        findings.add(numbered(place, len(raw) - 1, len(raw)), shown(raw[-1]), "less than 360", hint)
    if len(findings.problems) > before or whole is None:
        return ()
    return cubics(angles, lifts, whole, measures.units["angle" if swings else "length"])


def cubics(
    angles: Sequence[Fraction], lifts: Sequence[Quantity], whole: Fraction, unit: str
) -> tuple[CamPiece, ...]:
    """The pieces of the spline through the points, with ``unit`` that of lifts.

    All is linear in the lifts: what those with parameters add, each for itself, is an expression.
    """
    spans = [b - a for a, b in zip(angles, [*angles[1:], whole], strict=True)]
    known = [Fraction(0) if lift.uses() else Fraction(lift.number({})) for lift in lifts]
    plain = shares(spans, known)
    open_ = [(i, lift.tree) for i, lift in enumerate(lifts) if lift.uses()]
    added = [(shares(spans, [Fraction(i == k) for k in range(len(lifts))]), t) for i, t in open_]
    found = []
    for i, end in enumerate([*angles[1:], whole]):
        rise, begin, finish = (
            summed(plain[i][k], [(each[i][k], tree) for each, tree in added], unit)
            for k in range(3)
        )
        found.append(CamPiece(exact(end, "deg"), rise, TABLE, (begin, finish)))
    return tuple(found)


def shares(spans: Sequence[Fraction], lifts: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
    """Of each piece its rise, and its slopes at both ends times its angle."""
    rises = [b - a for a, b in zip(lifts, [*lifts[1:], lifts[0]], strict=True)]
    slopes = periodic_slopes(spans, rises)
    ends = zip(slopes, [*slopes[1:], slopes[0]], spans, strict=True)
    pairs = [(begin * span, finish * span) for begin, finish, span in ends]
    return [(rise, *pair) for rise, pair in zip(rises, pairs, strict=True)]


def summed(plain: Fraction, parts: Sequence[tuple[Fraction, Tree]], unit: str) -> Quantity:
    """A number and multiples of expressions as one quantity."""
    tree: Tree = Number(plain)
    for times, each in parts:
        if times:
            tree = Pair("+", tree, Pair("*", Number(times), each))
    return exact(plain, unit) if tree == Number(plain) else Quantity("", tree, unit)


def periodic_slopes(spans: Sequence[Fraction], rises: Sequence[Fraction]) -> list[Fraction]:
    """The derivatives at the points for which the second derivative goes on, too.

    The cyclic system is solved as one without its corners and a correction (Sherman and Morrison).
    """
    count = len(spans)
    near = [1 / span for span in spans]  # between point i and the next
    steep = [3 * rise / span**2 for rise, span in zip(rises, spans, strict=True)]
    right = [steep[i - 1] + steep[i] for i in range(count)]
    middle = [2 * (near[i - 1] + near[i]) for i in range(count)]
    corner = near[-1]
    middle[0] -= corner
    middle[-1] -= corner
    plain = tridiagonal(middle, near[:-1], right)
    ends = [Fraction(0)] * count
    ends[0] = ends[-1] = corner
    bent = tridiagonal(middle, near[:-1], ends)
    share = (plain[0] + plain[-1]) / (1 + bent[0] + bent[-1])
    return [one - share * other for one, other in zip(plain, bent, strict=True)]


def tridiagonal(
    middle: Sequence[Fraction], beside: Sequence[Fraction], right: Sequence[Fraction]
) -> list[Fraction]:
    """The solution of a symmetric system with one band beside its diagonal."""
    pivots, sides = [middle[0]], [right[0]]
    for i in range(1, len(middle)):
        factor = beside[i - 1] / pivots[-1]
        pivots.append(middle[i] - factor * beside[i - 1])
        sides.append(right[i] - factor * sides[-1])
    found = [sides[-1] / pivots[-1]]
    for i in range(len(middle) - 2, -1, -1):
        found.append((sides[i] - beside[i] * found[-1]) / pivots[i])
    return found[::-1]
