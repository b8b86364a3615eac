"""The construction and the plan of forces in words, and the line about the flattest crossing."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from collections.abc import Set as AbstractSet
from itertools import product
from math import degrees
from typing import NamedTuple

from msgspec.structs import replace

from graphkin.construction.centres.instant_centre import set_before
from graphkin.construction.core.component import (
    Component,
    TriangleComponent,
    component_ending_at,
    component_of,
    is_hidden,
)
from graphkin.construction.core.crossings import Crossing, crossings, flattest
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import Datum, of_driver, other_parameters
from graphkin.construction.core.kind import (
    PlanPole,
    Sentence,
    auxiliary_plan,
    construction,
    falls_on_sources,
)
from graphkin.construction.core.naming import TINY
from graphkin.construction.core.pen import PRIME, image_name
from graphkin.construction.core.program import Part, Plane, Step, is_set_on, plan_vector
from graphkin.construction.core.quantities import FORCE, number_of, quantity_text, request
from graphkin.construction.core.relation import Relation, answer, beside_plan, figure
from graphkin.construction.forces.force_drawing import ForceDrawing
from graphkin.construction.forces.line_force import belt_letter
from graphkin.construction.forces.loads import (
    InertiaForce,
    InertiaMoment,
    Weight,
    load_names,
    moment_name,
)
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.links.idle_links import idle_sentences
from graphkin.construction.rate_relations import finds_rates
from graphkin.construction.registry import TOGETHER
from graphkin.construction.step_marks import point_sentence
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import extent
from graphkin.drawing.symbol_markup import bar, escape, symbol, without_index
from graphkin.scene.forces import ByDriver, Components, Directed, Load, Size
from graphkin.scene.link_points import ends_of, lettered
from graphkin.scene.model import Link, Scene
from graphkin.scene.quantity import Quantity, size_in_si
from graphkin.text import names_in


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
    turning = words("clause_mark") + turning if turning else ""
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


HEIGHT = 2.5
"""Height of the lettering in mm."""
APART = 2.5
"""Room in mm between this line and the text before it."""
BESIDE = 22.0
"""Distance in mm of the line's end from the title block, clear of the centring mark."""
OWN = {
    "velocity": (Part.POSITION, Part.VELOCITY, Part.CENTRE),
    "acceleration": (Part.POSITION, Part.NORMAL, Part.ACCELERATION, Part.POLE),
    FORCE: (Part.FORCE,),
}
"""The parts of the work that are drawn on each sheet."""


def flattest_line(drawing: Drawing, start: float) -> Iterator[Mark]:
    """The flattest crossing of a sheet, its angle, and the effect of a millimetre of pencil error.

    ``start`` is where the free room begins, in mm. Where the room is too short, the name is
    shortened, then the effect is left out. Empty where no lines cross. Crossings drawn on the sheet
    before this one are not counted again.
    """
    worst = flattest(crossings_on(drawing))
    if worst is None:
        return
    paper = drawing.paper
    end = paper.left[2] if paper.is_leaf else paper.tables[0] - BESIDE
    forms = "page.flattest", "page.flattest_angle"
    for form, name in product(forms, names_of_crossing(drawing, worst)):
        text = drawing.words(
            form,
            name=name,
            angle=drawing.words.fixed(degrees(worst.angle), 0),
            factor=drawing.words.significant(worst.factor, 2),
        )
        if end - extent(text, HEIGHT)[0] >= start + APART:
            yield Text(end, paper.below[3] + 0.4, text, "caption", HEIGHT, "end", name="flattest")
            return


def crossings_on(drawing: Drawing) -> tuple[Crossing, ...]:
    """The lettered crossings that a sheet itself draws and uses."""
    parts = [part for part in OWN[drawing.kind] if not (drawing.again and part is Part.POSITION)]
    return tuple(
        crossing
        for crossing in crossings(drawing.trace)
        if crossing.name and crossing.part in parts and crossing.number in drawing.trace.values
        if not falls_on_sources(drawing, crossing.number)
        if not is_hidden(drawing, crossing.number)
    )


def group_closed(drawing: Drawing, crossing: Crossing) -> ClosedGroup | None:
    """The group of higher class that a crossing closes; None for any other crossing."""
    kind = construction(drawing.trace.program.steps[crossing.number])
    return kind if isinstance(kind, ClosedGroup) else None


def is_gap(drawing: Drawing, crossing: Crossing) -> bool:
    """Whether two loci close a group where they are a bar apart, rather than where they cross."""
    group = group_closed(drawing, crossing)
    return group is not None and len(group.traced) > 1


def names_of_crossing(drawing: Drawing, crossing: Crossing) -> tuple[str, str]:
    """Markup of the name of a crossing, and a shorter form.

    The name is the letter as drawn. A crossing that closes a group has the letter of its locus. A
    triangle whose corners no sentence names is called by its component.
    """
    group, step = group_closed(drawing, crossing), drawing.trace.program.steps[crossing.number]
    kind, letter = construction(step), step.name or crossing.name
    if group is not None and group.locus:
        letter = group.locus
    elif isinstance(kind, TriangleComponent):
        letter = kind.letter(drawing, step.role)
        if not any(drawing.symbol(letter) in said.markup for said in sentences(drawing)):
            return (drawing.words("page.crossing_for", a=kind.symbol(drawing)),) * 2
    return drawing.symbol(letter), drawing.symbol(without_index(letter))


def force_sentences(drawing: Drawing) -> list[Sentence]:
    """The sentences of the plan of forces, in the order of the work."""
    found = [Sentence(-1, "again", drawing.words("step.force-again"))]
    for number, step in enumerate(drawing.trace.program.steps):
        kind = construction(step)
        if step.part is not Part.FORCE or kind is None or number not in drawing.trace.values:
            continue
        if said := kind.sentence_alone(drawing, step.role):
            found.append(Sentence(number, step.role, said))
    return found


def force_relations(drawing: Drawing) -> list[tuple[str, list[Relation]]]:
    """The relations of the plan of forces: those of the loads, then those of the reactions."""
    loads: list[Relation] = []
    others: list[Relation] = []
    for number, step in enumerate(drawing.trace.program.steps):
        kind = construction(step)
        if step.part is Part.FORCE and kind is not None and number in drawing.trace.values:
            own = loads if isinstance(kind, InertiaForce | InertiaMoment | Weight) else others
            own += kind.equations(drawing, step.role)
    return [("loads", list(dict.fromkeys(loads))), ("forces", list(dict.fromkeys(others)))]


def force_data(drawing: Drawing, *, solved: bool, by_table: str = "") -> list[Datum]:
    """The parameters, the motion of drivers, and the data of forces, as ``load_data`` has them."""
    scene, words = drawing.scene, drawing.words
    found = [
        Datum(name=name, value=value, parameters=(of,))
        for of, name, value in other_parameters(scene, words)
    ]
    found += [
        piece
        for driver in scene.drivers
        for piece in of_driver(scene, words, driver, solved=solved, laws=True)
    ]
    return [*found, *load_data(drawing, by_table)]


def load_data(drawing: Drawing, by_table: str = "") -> list[Datum]:
    """Masses, moments of inertia, gravity, loads, springs and tensions of belts.

    ``by_table`` replaces the values of loads that a table gives, which are those of this position.
    """
    scene, words = drawing.scene, drawing.words
    forces = scene.forces
    assert forces is not None
    found, remarks = list[Datum](), list[Datum]()
    for link, mass in forces.masses.items():
        if mass.mass.is_zero():
            continue
        found.append(valued(f"m_{link}", worked(drawing, mass.mass, "kg")))
        if mass.inertia is not None and not mass.inertia.is_zero():
            found.append(valued(f"J_{link}", worked(drawing, mass.inertia, "kg·m²")))
        fields = {"k": escape(link), "s": symbol(mass.centre)}
        remarks.append(Datum(words("page.centre_of_mass", **fields)))
    if forces.gravity is not None:
        pair = (number_of(scene, words, each) for each in forces.gravity)
        more = worked_pair(drawing, forces.gravity, "m/s^2")
        unit = words.spelled(forces.gravity[0].written_unit.replace("²", "^2"))
        found.append(Datum(name="*g*", value=f"{words.place(*pair)} {unit}{more}"))
    for load, name in zip(forces.loads, load_names(forces.loads), strict=True):
        if load.force is not None:
            found += force_datum(drawing, load, name, by_table)
        if load.moment is not None:
            size = given_size(drawing, load.moment, moment_name(load, name), "N·m", by_table)
            found.append(valued(moment_name(load, name), size))
    for number, spring in enumerate(forces.springs, 1):
        own = str(number) if len(forces.springs) > 1 else ""
        ends = bar(*map(lettered, spring.ends))
        found.append(valued(f"c_{own}" if own else "c", worked(drawing, spring.stiffness, "N/m")))
        found.append(valued(f"l_0{own}", quantity_text(scene, words, spring.free)))
        remarks.append(Datum(words("page.spring", bar=ends, c=symbol(f"c_{own}" if own else "c"))))
    for name, rolling in scene.belts:
        belt = rolling.belt
        if belt is not None and belt.tension is not None:
            letter, between = belt_letter(scene, belt), {"one": rolling.on, "other": name}
            found.append(valued(letter, quantity_text(scene, words, belt.tension.number)))
            fields = {"t": symbol(letter), **{end: escape(e) for end, e in between.items()}}
            remarks.append(Datum(words(f"page.belt_{belt.tension.key}", **fields)))
    return [*found, *remarks]


def force_datum(drawing: Drawing, load: Load, name: str, by_table: str) -> Iterator[Datum]:
    """A given force: its components, or its size with its direction."""
    scene, words, force = drawing.scene, drawing.words, load.force
    assert force is not None
    if not isinstance(force, Directed):
        x, y = (number_of(scene, words, each) for each in force)
        unit = words.spelled(force[0].written_unit)
        yield valued(f"P_{name}", f"{words.place(x, y)} {unit}{worked_pair(drawing, force, 'N')}")
        return
    size = given_size(drawing, force.size, f"P_{name}", "N", by_table)
    if not force.sense:
        yield valued(f"P_{name}", f"{size}, {quantity_text(scene, words, force.angle)}")
        return
    key = "step.force-along" if force.sense > 0 else "step.force-against"
    v = symbol(f"v_{lettered(load.at)}")
    yield Datum(words(key, p=symbol(f"P_{name}"), size=size, v=v))


def given_size(drawing: Drawing, size: Size, name: str, unit: str, by_table: str) -> str:
    """A given number with its unit; one of a table as it is in this position."""
    if not isinstance(size, ByDriver):
        return worked(drawing, size, unit)
    if by_table:
        return by_table
    assert isinstance(drawing, ForceDrawing)
    return f"{answer(drawing, drawing.by_table[name])} {drawing.words.unit(unit)}"


def worked(drawing: Drawing, quantity: Quantity, unit: str) -> str:
    """A number with its unit, and with that of the results where this is another one.

    ``unit`` is its unit in newtons, kilograms and metres.
    """
    said = quantity_text(drawing.scene, drawing.words, quantity)
    if size_in_si(quantity.unit)[0] == 1:
        return said
    value = float(quantity.si(drawing.scene.values))
    return f"{said} = {figure(drawing, value)} {drawing.words.unit(unit)}"


def worked_pair(drawing: Drawing, pair: Components, unit: str) -> str:
    """Two components after a sign of equality in the unit of results, where that is another one."""
    if size_in_si(pair[0].unit)[0] == 1:
        return ""
    x, y = (figure(drawing, float(each.si(drawing.scene.values))) for each in pair)
    return f" = {drawing.words.place(x, y)} {drawing.words.unit(unit)}"


def valued(name: str, value: str) -> Datum:
    """A datum by the name of its symbol."""
    return Datum(name=symbol(name), value=value)


def forces_asked(drawing: Drawing) -> list[str]:
    """The requests of a sheet of forces, in words."""
    words, forces = drawing.words, drawing.scene.forces
    assert forces is not None
    found: list[str] = []
    for key, names in asked_by_pair(drawing.scene, forces.reactions).items():
        if names:
            found.append(request(words, key, names))
    if forces.balance:
        lever = isinstance(drawing, ForceDrawing) and drawing.extents.lever is not None
        found.append(words("ask.balance_lever" if lever else "ask.balance"))
    return found


def asked_by_pair(scene: Scene, asked: Sequence[str]) -> dict[str, list[str]]:
    """The pins and the links whose reactions are asked, by the request for their kind of pair."""
    links = {name: scene.links[name] for name in asked if name in scene.links}
    kinds: dict[str, Callable[[Link], bool]] = {
        "ask.guide_reactions": lambda link: bool(link.slides),
        "ask.contact_reactions": lambda link: (
            any(not each.belt for each in link.rolls) or link.name in scene.cams
        ),
        "ask.belt_reactions": lambda link: any(each.belt for each in link.rolls),
    }
    pins: list[str] = [symbol(lettered(name)) for name in asked if name not in links]
    found = {"ask.reactions": pins}
    for key, has in kinds.items():
        found[key] = [escape(name) for name, link in links.items() if has(link)]
    return found


def checked(drawing: Drawing) -> Iterator[str]:
    """What a sheet of forces says on its checks: the equations, then each lever."""
    assert isinstance(drawing, ForceDrawing)
    words = drawing.words
    worst = words.significant(drawing.verdict.largest_difference, 2)
    yield words("page.forces_verified", difference=worst)
    for each in drawing.lever_balances():
        difference = words.significant(each.difference(drawing), 2) if each.size(drawing) else "0"
        yield words("page.lever_verified", difference=difference)
