"""Why the points of a link cannot be placed, or are placed twice, in words that help to mend it."""

from __future__ import annotations

from graphkin.scene.findings import Findings, listed, nearest
from graphkin.scene.link_keys import LinkKeys
from graphkin.scene.model import Side
from graphkin.text.errors import Hint


def explain(sketch: LinkKeys, waiting: list[str], placed: set[str], findings: Findings) -> None:
    """Note, for each point left over, what it lacks; points that only wait for those are passed."""
    before = len(findings.problems)
    for point in waiting:
        found, expected, hint = missing(sketch, point, placed)
        if found:
            findings.add(f"{sketch.place}.{point}", found, expected, hint)
    if len(findings.problems) == before:
        names = ", ".join(waiting)
        findings.add(
            sketch.place,
            f"nothing places {names}",
            "each point by points written before it",
            "give coordinates [x, y], or lengths and a side",
        )


def missing(sketch: LinkKeys, point: str, placed: set[str]) -> tuple[str, str, Hint]:
    """What one point lacks: found, expected and hint; empty when it only waits for another."""
    polar, words = sketch.polars.get(point), sketch.words.get(point)
    if polar is not None:
        return unknown(sketch, "from", [polar.start])
    if words is not None:
        return missing_lengths(sketch, point, placed)
    bare = bare_turn(sketch, point, placed) or bare_base(sketch, point, placed)
    if bare:
        return (f"the length {bare} is missing", f"{bare} = …", "")
    ends = [end for end in sketch.points if end in placed and sketch.between(end, point)]
    if len(ends) >= 2:
        a, b = ends[:2]
        return (
            f"{point} has the lengths {a}-{point} and {b}-{point} but no side",
            f'{point} = "left of {a}-{b}" or "right of {a}-{b}"',
            "",
        )
    if len(ends) == 1:
        bar = f"{ends[0]}-{point}"
        base = any({ends[0], point} == {on.first, on.second} for on in sketch.words.values())
        return (
            f"one length, {bar}, does not place {point}",
            "a second length and a side, an angle, or coordinates [x, y]",
            f"write {bar} above the other lengths, for they begin with it" if base else "",
        )
    return ("", "", "")


def bare_turn(sketch: LinkKeys, point: str, placed: set[str]) -> str:
    """The length that an angle of this point wants, where it is not written."""
    for first, vertex, last in sketch.angles:
        ready = point in (first, last) and {first, vertex, last} - {point} <= placed
        if ready and sketch.between(vertex, point) is None:
            return f"{vertex}-{point}"
    return ""


def bare_base(sketch: LinkKeys, point: str, placed: set[str]) -> str:
    """The length of the first two points, on which other points are built, where it is missing."""
    for first, vertex, last in sketch.angles:
        for arm in (first, last):
            ends = {arm, vertex}
            if point in ends and ends & placed and sketch.between(arm, vertex) is None:
                return f"{vertex}-{arm}"
    for words in sketch.words.values():
        ends = {words.first, words.second}
        if point in ends and ends & placed and sketch.between(words.first, words.second) is None:
            return f"{words.first}-{words.second}"
    return ""


def missing_lengths(sketch: LinkKeys, point: str, placed: set[str]) -> tuple[str, str, Hint]:
    """What a point with a side or a line lacks."""
    words = sketch.words[point]
    ends = (words.first, words.second)
    lost = unknown(sketch, f"{words.first}-{words.second}", ends)
    if lost[0]:
        return lost
    if any(end not in placed for end in ends):
        return ("", "", "")
    bare = [f"{end}-{point}" for end in ends if sketch.between(end, point) is None]
    if isinstance(words, Side):
        return (f"{point} has a side but not the length {' and '.join(bare)}", "both lengths", "")
    return (f"{point} is on a line but nothing says how far", f"the length {' or '.join(bare)}", "")


def unknown(
    sketch: LinkKeys, what: str, ends: tuple[str, ...] | list[str]
) -> tuple[str, str, Hint]:
    """A point named in a placing that this link does not have."""
    for end in ends:
        if end not in sketch.points:
            hint = nearest(end, sketch.points)
            return (f"{what} names {end}, no point of this link", listed(sketch.points), hint)
    return ("", "", "")


def spare(
    sketch: LinkKeys, used: set[frozenset[str] | tuple[str, str, str]], findings: Findings
) -> None:
    """Note each length and angle that no placing needs: what it says is settled already."""
    left = [(pair, quantity) for pair, quantity in sketch.lengths.items() if pair not in used]
    turns = [(three, quantity) for three, quantity in sketch.angles.items() if three not in used]
    for _, quantity in (*left, *turns):
        findings.add(
            quantity.place,
            "one measure too many: its points are placed without it",
            "as many measures as place each point once",
            "leave it out, or leave out another",
        )
