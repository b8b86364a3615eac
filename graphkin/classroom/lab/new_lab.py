"""Makes a lab to start from: a sound scene and rule, with each key, field and cause explained."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from msgspec import Struct

from graphkin.classroom.lab.cause_names import GRADES, NAMES
from graphkin.classroom.lab.fair_ranges import FairRanges, fair_ranges, space_of
from graphkin.classroom.lab.items import (
    all_fields,
    arrow_items,
    asked_fields,
    force_items,
    place_items,
    plain,
    rate_items,
    slide_items,
    vector_items,
)
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.lab.proposed_ranges import (
    APART,
    COURSE,
    ProposedRanges,
    proposed_ranges,
    variants_lines,
)
from graphkin.classroom.lab.read_lab import LAB, SCENE, lab_of
from graphkin.construction.core.plan_vector import PlanVector
from graphkin.construction.core.quantities import (
    BY_TARGET,
    CENTRES,
    CLOCKWISE,
    FORCES,
    RATES,
    SHEETS,
    VECTORS,
    Whose,
)
from graphkin.drawing.richtext import plain as text_of
from graphkin.drawing.style import COMPONENTS
from graphkin.mechanism import Mechanism
from graphkin.scene.file_limits import decoded, read_bytes
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.text.errors import Problem, SceneError, message
from graphkin.text.tables import Say
from graphkin.writers.files import RESERVED, refuse_folder, write_all

COMPONENT = {kind.sign: words("en")(kind.legend).partition(":")[0] for kind in COMPONENTS}
"""The name of each component of an acceleration, by its sign."""
FORCE_NAMES = ("R_23", "F_b5", "M_b1")
"""The symbols of a reaction, a balancing force and a balancing moment."""
SHEET = {sheet[0]: sheet for sheet in SHEETS}
"""The sheet for the first letter of an arrow's symbol."""


def fields_of(mechanism: Mechanism) -> Mapping[str, str]:
    """Every field that a rubric of a mechanism may name, with its meaning."""
    return {name: meaning(item) for name, item in all_fields(mechanism).items()}


def kinds() -> Mapping[str, str]:
    """Every kind of field with its meaning, by its names for point B, link 3 and block 2."""
    return {item.field: meaning(item) for item in examples()}


def examples() -> Iterator[Item]:
    """A field of each kind, for point B, link 3 and block 2."""
    names: Mapping[Whose, str] = {"points": "B", "links": "3", "slides": "2"}
    for vector in VECTORS:
        yield from vector_items(vector, names[vector.whose])
    for rate in RATES:
        yield from rate_items(rate, names[rate.whose])
    yield from slide_items(names["slides"], "0")
    for centre in CENTRES:
        yield from place_items(centre, names[centre.whose])
    for force, name in zip(FORCES, FORCE_NAMES, strict=True):
        yield from force_items(force, name)
    for quantity in VECTORS:
        for sign in ("", *COMPONENT) if quantity.kind == "acceleration" else ("",):
            yield from arrow_items(PlanVector(quantity.letter, "BA", sign=sign), quantity.unit)


def meaning(item: Item) -> str:
    """The meaning of a field, in a few words."""
    of = thing(item)
    if item.what == "sense":
        ways = "counter-clockwise or clockwise"
        ways = ways if item.quantity in CLOCKWISE else "along the guide as the data say, or against"
        return f"sense of the {of}: {ways}"
    if item.what == "segment":
        return f"{of}: its length in the plan, {item.unit}"
    if item.what == "place":
        way = "to the right" if item.axis == "x" else "up"
        return f"{of}: {item.axis} on paper from the first fixed pivot, {way}, {item.unit}"
    return f"{of}, {item.unit}"


def thing(item: Item) -> str:
    """The object of a field: a quantity, or an arrow of a plan by its letters."""
    vector = item.vector
    if vector is None:
        return BY_TARGET[item.quantity].of(item.of)
    name = f"{vector.letter}_{plain(vector.index)}"
    whole = f"vector {name} of the {SHEET[vector.letter]} plan"
    return f"{COMPONENT[vector.sign]} of {name}" if vector.sign in COMPONENT else whole


def causes() -> Mapping[str, str]:
    """Every cause by name, with what the student did."""
    spoken = words("en")
    return {name: text_of(spoken(f"cause.{name}")) for name in NAMES}


START = Path(__file__).parent / "start"
FILES = (SCENE, LAB)
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,59}")


def new_lab(name: str, folder: Path, *, force: bool = False) -> list[Path]:
    """Make the folder of a new lab within another folder, and return the files in it.

    Raises SceneError for a name that is no folder name on some system, and PageError for files in
    the way.
    """
    check_name(name)
    texts = {file: (START / file).read_text(encoding="utf-8") for file in FILES}
    texts[LAB] = explained(texts[LAB], Mechanism(read_text(texts[SCENE], name)))
    files = {file: text.replace("NAME", name).encode("utf-8") for file, text in texts.items()}
    return write_all(folder / name, files, force)


def check_name(name: str) -> None:
    if not NAME.fullmatch(name) or name.upper() in RESERVED:
        expected = message("letters, digits, - and _, at most 60, such as crank-lab")
        hint = message("-o DIR says in which folder it is made")
        raise SceneError(Problem(f'"{name}"', message("is no name for a lab"), expected, hint))


class OwnLab(Struct, frozen=True):
    """A lab made from a scene: its files, where its parameters are fair, and what it draws from.

    ``proposed`` is None where no ranges were found in which all is fair. The lab then draws from
    all that the scene allows.
    """

    files: list[Path]
    found: FairRanges
    proposed: ProposedRanges | None


def lab_from(
    scene: Path, name: str, folder: Path, *, force: bool = False, say: Say = lambda words: None
) -> OwnLab:
    """Make the folder of a lab for a scene, with the ranges in which all its variants are fair.

    The scene is copied unchanged; ``say`` receives how far the work is. Raises SceneError for a
    scene with a problem or without a
    parameter that has both ends, and for a name that is no folder name on some system; PageError
    for files in the way.
    """
    check_name(name)
    refuse_folder(folder / name, FILES, force=force)
    data = read_bytes(scene)
    mechanism = Mechanism(read_text(decoded(data), name))
    with TemporaryDirectory() as tried:
        place = Path(tried)
        (place / SCENE).write_bytes(data)
        lab = lab_of(rules_for(mechanism), place, mechanism, name)
        found = fair_ranges(lab, say)
        say("counting for how many students the ranges have room")
        proposed = proposed_ranges(lab, found)
    rules = lab.text if proposed is None else rules_for(mechanism, proposed)
    files = write_all(folder / name, {SCENE: data, LAB: rules.encode("utf-8")}, force)
    return OwnLab(files, found, proposed)


def rules_for(mechanism: Mechanism, proposed: ProposedRanges | None = None) -> str:
    """The text of a lab.toml to start from, for any scene.

    It draws from the proposed ranges, or else from all that the parameters allow. No student's
    right values may earn another more than half of the points. Each asked field earns a point.
    Raises SceneError where no parameter of the scene has both ends.
    """
    start = (START / "lab.toml").read_text(encoding="utf-8")
    limits, rubric = start.index("[fair]"), start.index("[marks]")
    first = start.index("\n", rubric) + 1
    more = start.index("# What is not asked", first)
    ranges = space_of(mechanism.scene) if proposed is None else proposed.ranges
    head = ["graphkin = 1", "", *variants_lines(ranges, COURSE), "", ""]
    fair = re.sub(r"(?m)^# apart = \S+", lambda line: f"apart = {APART:<5}", start[limits:first])
    fields = "".join(f"{name} = 1\n" for name in asked_fields(mechanism))
    return explained("\n".join(head) + fair + fields + start[more:], mechanism)


def explained(text: str, mechanism: Mechanism) -> str:
    """The text of a lab.toml with all fields of a mechanism and all causes, and their meanings."""
    fields = fields_of(mechanism)
    stated = {line.partition(" =")[0] for line in text.splitlines()}
    lines = []
    for line in text.splitlines():
        name = line.partition(" =")[0]
        if line == "# FIELDS":
            more = ((f"# {each} = 1", note) for each, note in fields.items() if each not in stated)
            lines += [beside(*pair) for pair in more]
        elif line == "# CAUSES":
            lines += [beside(f'# {n} = "{GRADES[n]}"', note) for n, note in causes().items()]
        else:
            lines.append(beside(line, fields[name]) if name in fields else line)
    return "\n".join(lines) + "\n"


def beside(line: str, note: str) -> str:
    return f"{line:32} # {note}"
