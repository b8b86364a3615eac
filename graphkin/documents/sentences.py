"""The construction in words: one numbered sentence for each point that is found, in order."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from msgspec.structs import replace

from graphkin.construction.centres.instant_centre import set_before
from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.component import Component, component_ending_at, component_of
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import PlanPole, Sentence, construction
from graphkin.construction.core.pen import PRIME, image_name
from graphkin.construction.core.plan_vector import is_set_on, plan_vector
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.core.quantities import FORCE
from graphkin.construction.core.relation import beside_plan
from graphkin.construction.core.segments import TINY
from graphkin.construction.links.idle_links import idle_sentences
from graphkin.construction.rate_relations import finds_rates
from graphkin.construction.registry import TOGETHER
from graphkin.construction.step_sentences import point_sentence
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.scene.link_points import ends_of, lettered
from graphkin.text.markup import AND, names_in


class IndexNote(NamedTuple):
    """The meaning of an index: the kind of note, the names with the index, and its fields."""

    kind: str
    names: AbstractSet[str]
    fields: dict[str, str]


def with_indices(drawing: Drawing, found: Sequence[Sentence]) -> list[Sentence]:
    """The sentences; the first with an index of some kind explains it in brackets."""
    explained_once, kinds, every = list(found), set[str](), list(explained(drawing))
    for place, sentence in enumerate(found):
        for each in every:
            if each.kind not in kinds and each.names & names_in(sentence.markup):
                kinds.add(each.kind)
                note = drawing.words(f"step.index-{each.kind}", **each.fields)
                explained_once[place] = replace(
                    explained_once[place], markup=explained_once[place].markup + f" ({note})"
                )
    return explained_once


def explained(drawing: Drawing) -> Iterator[IndexNote]:
    """The indices in a sheet's letters: of a link, and of an image kept apart from the pole."""
    steps, images = drawing.trace.program.steps, drawing.kind
    prime = PRIME if images == "acceleration" else ""
    for (what, name), number in drawing.trace.program.targets.items():
        if what != images or number not in drawing.trace.values:
            continue
        image, known = steps[number].name, image_name(name, prime)
        is_own = image == str(known)
        own, (point, link) = lettered(name), ends_of(name)
        if link:
            called = {own, *vectors_of(drawing, own), *([image] if known.link and is_own else [])}
            fields = {
                "name": drawing.symbol(own),
                "k": escape(link),
                "p": symbol(lettered(point)),
            }
            yield IndexNote("link", called, fields)
        if known.apart and is_own:
            fields = {
                "name": drawing.symbol(image),
                "p": drawing.symbol(name),
                "pole": drawing.symbol(drawing.pole),
            }
            yield IndexNote("image", {image}, fields)


def vectors_of(drawing: Drawing, point: str) -> Iterator[str]:
    """The vectors with a point's letters as index, and the letters of their feet."""
    for step in drawing.trace.program.steps:
        vector = plan_vector(step)
        if vector is not None and point in (vector.q, vector.p):
            yield from filter(None, (vector.symbol, vector.foot))


# --- the construction in words: one numbered sentence for each point that is found, in order ------


TURNING = "turning"
"""The name of the last sentence where it reads off the rates of links."""
SET_ON = "set-on"
"""The name of a last sentence that only sets vectors on the mechanism."""


def sentences(drawing: Drawing) -> list[Sentence]:
    """The sentences of a sheet in the order of drawing, with the readings at the end."""
    return with_indices(drawing, unexplained(drawing))


def unexplained(drawing: Drawing) -> list[Sentence]:
    """The sentences of a sheet without the meanings of indices."""
    if drawing.kind == FORCE:
        from graphkin.documents.force_sentences import force_sentences

        return force_sentences(drawing)
    found: list[Sentence] = []
    if drawing.again:
        found.append(Sentence(-1, "again", drawing.words("step.again")))
    found += said_of_steps(drawing)
    if not drawing.again:
        steps = drawing.trace.program.steps
        place = sum(said.step >= 0 and steps[said.step].part is Part.POSITION for said in found)
        found[place:place] = idle_sentences(drawing)
    found += [
        Sentence(-1, curve.kind, drawing.words(f"step.{curve.kind}", of=symbol(curve.of)))
        for curve in drawing.curves
        if curve.kind not in ("fixed-centrode", "locus")
    ]
    last = list(read_off(drawing))
    for together in TOGETHER:
        found = together(drawing, found)
    return [*found, *last]


def read_off(drawing: Drawing) -> Iterator[Sentence]:
    """The readings at the end, if any; rates of links only where the sheet finds one."""
    words, velocity = drawing.words, drawing.kind == "velocity"
    turns = finds_rates(drawing)
    turning = words(f"step.read-{'omega' if velocity else 'epsilon'}") if turns else ""
    if markup := set_on_mechanism(drawing, turning):
        yield Sentence(-1, TURNING if turns else SET_ON, markup)


def set_on_mechanism(drawing: Drawing, turning: str, only: Collection[int] | None = None) -> str:
    """The sentence that sets vectors on the mechanism, followed by the reading of rates.

    ``only`` limits it to the vectors of some steps; None means all.
    """
    words, velocity = drawing.words, drawing.kind == "velocity"
    part = Part.VELOCITY if velocity else Part.ACCELERATION
    early = set_before(drawing)
    lengths = [
        (drawing.symbol(step.name), abs(arrow.tip - arrow.tail))
        for number, step, arrow in drawing.steps(Plane.MECHANISM)
        if is_set_on(step) and step.part is part
        if number not in early and (only is None or number in only)
    ]
    if not lengths:
        return turning
    turning = AND + turning if turning else ""
    set_on = [name for name, length in lengths if length * 1000 >= TINY * drawing.scales.kL]
    if names := dict.fromkeys(set_on):
        key = "step.read-off" if len(names) > 1 else "step.read-off-one"
        beside = beside_plan(drawing, drawing.kind)
        shorter = f", {beside}" if beside else ""
        listed = words("list_mark").join(names)
        return words(key, list=listed, shorter=shorter, turning=turning)
    metres = drawing.scales.pace(drawing.kind)
    zero = not any(drawing.settled(length / metres) for _, length in lengths)
    return words(f"step.read-{'none' if zero else 'short'}", turning=turning)


def said_of_steps(drawing: Drawing) -> Iterator[Sentence]:
    """The sentences of the steps of a sheet, in their order."""
    program, shown = drawing.trace.program, set[type[Component]]()
    for number, step, _ in drawing.steps(Plane.MECHANISM, drawing.plane, Plane.NUMBERS):
        component, laid = component_of(program, number), component_ending_at(program, number)
        if component is not None:
            first = type(component) not in shown and component.is_drawn(drawing)
            shown |= {type(component)} if first else set()
            said = component.sentence(drawing, first=first)
            if said.markup:
                yield Sentence(number, said.kind, said.markup)
        elif plan := auxiliary_plan(drawing, number):
            yield from plan.sentences(drawing, number)
        elif laid is not None:
            if is_own(drawing, step) and (markup := laid.sentence(drawing)):
                yield Sentence(number, step.role, markup)
        elif alone := said_alone(drawing, step):
            yield Sentence(number, step.role, alone)
        elif is_found_point(drawing, number, step) and not is_again(drawing, step):
            yield Sentence(number, step.name, point_sentence(drawing, step))


def is_again(drawing: Drawing, step: Step) -> bool:
    """Whether the previous sheet has shown a step: the mechanism itself."""
    return drawing.again and step.part is Part.POSITION


def said_alone(drawing: Drawing, step: Step) -> str:
    """The sentence of a construction for a step that finds no point."""
    kind = construction(step)
    if kind is None or not is_own(drawing, step):
        return ""
    return kind.sentence_alone(drawing, step.role)


def is_own(drawing: Drawing, step: Step) -> bool:
    """Whether a step belongs to this sheet, and was not found on the previous one."""
    found_before = (Part.POSITION, Part.VELOCITY) if drawing.kind == "acceleration" else ()
    return not is_again(drawing, step) and step.part not in found_before


def is_found_point(drawing: Drawing, number: int, step: Step) -> bool:
    """Whether a step finds a point, a pole or a centre of this sheet."""
    if step.action is None or not step.name or step.arrow or number in drawing.results:
        return False
    if step.plane is Plane.MECHANISM:
        wanted = Part.CENTRE if drawing.kind == "velocity" else Part.POLE
        return step.part in (Part.POSITION, wanted) and step.name not in drawing.scene.fixed_points
    return step.plane is drawing.plane and not isinstance(construction(step), PlanPole)
