"""The plan of forces in words: data, requests, sentences, relations and tables of its sheet."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import Datum, of_driver
from graphkin.construction.core.kind import Sentence, construction
from graphkin.construction.core.program import Part
from graphkin.construction.core.quantities import number_of, quantity_text
from graphkin.construction.core.relation import Relation, answer
from graphkin.construction.forces.force_drawing import ForceDrawing
from graphkin.construction.forces.loads import (
    InertiaForce,
    InertiaMoment,
    Weight,
    load_names,
    moment_name,
)
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.scene.forces import ByDriver, Directed, Load, Size
from graphkin.scene.link_points import lettered


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


def force_data(drawing: Drawing, *, solved: bool) -> list[Datum]:
    """The motion of drivers, masses, moments of inertia, gravity and loads as data."""
    scene, words = drawing.scene, drawing.words
    forces = scene.forces
    assert forces is not None
    found = [
        piece
        for driver in scene.drivers
        for piece in of_driver(scene, words, driver, solved=solved, laws=True)
    ]
    remarks = []
    for link, mass in forces.masses.items():
        if mass.mass.is_zero():
            continue
        found.append(valued(f"m_{link}", quantity_text(scene, words, mass.mass)))
        if mass.inertia is not None and not mass.inertia.is_zero():
            found.append(valued(f"J_{link}", quantity_text(scene, words, mass.inertia)))
        fields = {"k": escape(link), "s": symbol(mass.centre)}
        remarks.append(Datum(words("page.centre_of_mass", **fields)))
    if forces.gravity is not None:
        pair = (number_of(scene, words, each) for each in forces.gravity)
        found.append(Datum(name="*g*", value=f"{words.place(*pair)} m/s^2"))
    for load, name in zip(forces.loads, load_names(forces.loads), strict=True):
        if load.force is not None:
            found += force_datum(drawing, load, name)
        if load.moment is not None:
            size = given_size(drawing, load.moment, moment_name(load, name), "N·m")
            found.append(valued(moment_name(load, name), size))
    for number, spring in enumerate(forces.springs, 1):
        own = str(number) if len(forces.springs) > 1 else ""
        ends = bar(*map(lettered, spring.ends))
        found.append(
            valued(f"c_{own}" if own else "c", quantity_text(scene, words, spring.stiffness))
        )
        found.append(valued(f"l_0{own}", quantity_text(scene, words, spring.free)))
        remarks.append(Datum(words("page.spring", bar=ends, c=symbol(f"c_{own}" if own else "c"))))
    return [*found, *remarks]


def force_datum(drawing: Drawing, load: Load, name: str) -> Iterator[Datum]:
    """A given force: its components, or its size with its direction."""
    scene, words, force = drawing.scene, drawing.words, load.force
    assert force is not None
    if not isinstance(force, Directed):
        x, y = (number_of(scene, words, each) for each in force)
        yield valued(f"P_{name}", f"{words.place(x, y)} N")
        return
    size = given_size(drawing, force.size, f"P_{name}", "N")
    if not force.sense:
        yield valued(f"P_{name}", f"{size}, {quantity_text(scene, words, force.angle)}")
        return
    key = "step.force-along" if force.sense > 0 else "step.force-against"
    v = symbol(f"v_{lettered(load.at)}")
    yield Datum(words(key, p=symbol(f"P_{name}"), size=size, v=v))


def given_size(drawing: Drawing, size: Size, name: str, unit: str) -> str:
    """A given number with its unit; one of a table as it is in this position."""
    if not isinstance(size, ByDriver):
        return quantity_text(drawing.scene, drawing.words, size)
    assert isinstance(drawing, ForceDrawing)
    return f"{answer(drawing, drawing.by_table[name])} {unit}"


def valued(name: str, value: str) -> Datum:
    """A datum by the name of its symbol."""
    return Datum(name=symbol(name), value=value)


def forces_asked(drawing: Drawing) -> list[str]:
    """The requests of a sheet of forces, in words."""
    words, forces = drawing.words, drawing.scene.forces
    assert forces is not None
    found: list[str] = []
    keys = (
        ("ask.reactions", "ask.reactions_many", False),
        ("ask.guide_reactions", "ask.guide_reactions_many", True),
    )
    for one, many, blocks in keys:
        names = [e for e in forces.reactions if (e in drawing.scene.links) is blocks]
        if names:
            symbols = (escape(n) if blocks else symbol(lettered(n)) for n in names)
            mentioned = words("list_mark").join(symbols)
            found.append(words(many if len(names) > 1 else one, list=mentioned))
    if forces.balance:
        lever = isinstance(drawing, ForceDrawing) and drawing.extents.lever is not None
        found.append(words("ask.balance_lever" if lever else "ask.balance"))
    return found


def checked(drawing: Drawing) -> str:
    """The line on the check of a sheet of forces."""
    assert isinstance(drawing, ForceDrawing)
    words = drawing.words
    worst = words.significant(drawing.verdict.largest_difference, 2)
    said = words("page.forces_verified", difference=worst)
    for each in drawing.lever_balances():
        difference = words.significant(each.difference(drawing), 2) if each.size(drawing) else "0"
        said += "; " + words("page.lever_verified", difference=difference)
    return said
