"""The words for groups that are cut until they close, and for links that fit by themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import angle_symbol
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import arc_span
from graphkin.construction.core.naming import way_of
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.core.sentence import Sentence
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Arc
from graphkin.drawing.richtext import escape
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.plane import Circle

IDLE = "idle "
"""What the name of a sentence that tells of an idle link begins with; the link's name follows."""


def closing_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """How the position of a group of class III or higher is found."""
    says = step.says
    fields = {key: escape(says[key]) for key in ("k", "n", "list")}
    if "d" in says:
        driver = next(d for d in drawing.scene.drivers if d.link == says["d"])
        fields["what"] = angle_symbol(drawing.scene, driver)
        return drawing.words("step.close-driver", **fields)
    drawn = links_drawn(drawing, says)
    key = "step.close-links" if len(drawn) > 1 else "step.close-link"
    fields["draw"] = drawing.words(key, list=escape(", ".join(drawn)))
    fields["q"] = symbol(says["q"])
    if "g" in says:
        return drawing.words("step.close-guide", guide=way_of(drawing, says["g"]), **fields)
    fixed, moving = ends_of_bar(drawing, number, step)
    fields |= {"p": symbol(fixed or says["p"]), "q": symbol(moving)}
    key = "step.close-bar" if fixed else "step.close-gap"
    return drawing.words(key, bar=bar(says["p"], says["q"]), **fields)


def ends_of_bar(drawing: Drawing, number: int, step: Step) -> tuple[str, str]:
    """The ends of the bar that a group is cut at: one that stands, if any does; a moving one."""
    first, second = step.says["p"], step.says["q"]
    stands = {p for p in (first, second) if drawing.trace.program.targets["position", p] < number}
    if second in stands:
        return second, first
    return first if first in stands else "", second


def draw_closing_arcs(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Of the arc that a locus is cut by, where a group closes, the part that finds the pin."""
    for number, step, _ in drawing.steps(Plane.NUMBERS):
        if (
            step.action is None
            or step.action.key != "close"
            or not {"d", "g"}.isdisjoint(step.says)
        ):
            continue
        fixed, moving = ends_of_bar(drawing, number, step)
        if fixed:
            centre, pin = drawing.positions[fixed], drawing.positions[moving]
            circle = Circle(centre, abs(pin - centre))
            span, name = arc_span(circle, [pin], field.mm), step.says["p"] + step.says["q"]
            radius = circle.radius * field.mm
            board.marks.append(Arc(*field(centre), radius, *span, "compass", name, number))


def links_drawn(drawing: Drawing, says: Mapping[str, str]) -> list[str]:
    """The links of a group that give the locus: all but the one that a pin or guide is cut off."""
    links, names = drawing.scene.links, says["list"].split(", ")
    ends = {says[end] for end in "pq" if end in says}
    near = [says["g"], *(slide.on for slide in links[says["g"]].slides)] if "g" in says else names
    cut = next(name for name in near if name in names and ends <= {*links[name].points})
    return [name for name in names if name != cut]


def points_of(step: Step) -> set[str]:
    """The points of which the sentence of a step speaks."""
    kind = construction(step)
    joined = (step.says.get(key, "") for key in "pqr") if kind is None else kind.points
    return {step.name, *joined}


def idle_sentences(drawing: Drawing) -> Iterator[Sentence]:
    """Each bar that no step lays off, because its pins stand without it: an idle link."""
    told = [
        points_of(step)
        for _, step, _ in drawing.steps(Plane.MECHANISM, Plane.NUMBERS)
        if step.part is Part.POSITION
    ]
    for link in drawing.scene.links.values():
        points = set(link.points)
        laid = any(len(points & names) > 1 for names in told)
        if len(points) > 1 and not laid and not link.slides and not link.wheels:
            names = {"bar": bar(*link.points[:2]), "k": escape(link.name)}
            yield Sentence(-1, IDLE + link.name, drawing.words("step.idle", **names))
