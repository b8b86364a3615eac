"""Makes a lab to start from: a sound scene and rule, with each key, field and cause explained.

Proposes ranges in which a lab is fair to all, and a change that mends a formula.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from fractions import Fraction
from math import ceil, floor, log10, pi
from pathlib import Path
from tempfile import TemporaryDirectory

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.causes import Variants
from graphkin.classroom.grading.readings import FormFields
from graphkin.classroom.grading.standard import standard
from graphkin.classroom.lab.fair_ranges import FairRanges, ends, fair_ranges, space_of
from graphkin.classroom.lab.fairness import judged
from graphkin.classroom.lab.items import (
    all_fields,
    arrow_items,
    asked_fields,
    force_items,
    place_items,
    plain,
    rate_items,
    slide_items,
    travel_item,
    vector_items,
)
from graphkin.classroom.lab.lab_model import (
    ANOTHER,
    GRADES,
    NAMES,
    Item,
    Lab,
    LabRule,
    Range,
    Rubric,
    SeveralValues,
    ValueList,
    exact_text,
)
from graphkin.classroom.lab.lab_trial import CLASS, LabTrial, draw_words, limit_words, tried
from graphkin.classroom.lab.read_lab import LAB, SCENE, lab_of
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import assigned
from graphkin.construction.core.program import PlanVector
from graphkin.construction.core.quantities import (
    BY_TARGET,
    CENTRES,
    CLOCKWISE,
    FORCES,
    RATES,
    SHEETS,
    TRAVEL,
    VECTORS,
    Whose,
)
from graphkin.drawing.richtext import plain as text_of
from graphkin.drawing.style import COMPONENTS
from graphkin.mechanism import Mechanism
from graphkin.scene.file_limits import decoded, read_bytes
from graphkin.scene.model import DRIVEN, JOINED
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.text.errors import GraphkinError, SceneError, message
from graphkin.text.tables import Say, labelled, table
from graphkin.writers.files import RESERVED, refuse_folder, write_all

CHANGES = (1, 2, 3, 5, 8, 12)
"""The changes tried, in percent: the smallest first, up before down."""
NUMBER = re.compile(r"(?<![\w.\"-])\d+(?:\.\d+)?(?![\w.])")
SECTION = re.compile(r"\s*\[+\s*(\w+)")
CHANGED = ("frame", "links", "drivers")
"""The tables whose numbers are lengths, places and laws of the driver."""
VALUE = re.compile(r"\s*(?:\{\s*value\s*=\s*)?[\d.]+")
"""The value of a parameter where it is a plain number."""
FIXED = re.compile(rf"\s*({'|'.join(('on', 'against', *DRIVEN, *JOINED))})\s*=")
"""Keys whose numbers name links, or count teeth."""


class Mending(Struct, frozen=True):
    """A number of a scene, and what to change it to.

    ``line`` counts from 1 and ``column`` from zero. ``percent`` is the change from ``old`` to
    ``new``.
    """

    line: int
    column: int
    text: str
    old: str
    new: str
    percent: float


def mended(lab: Lab, outcome: LabTrial) -> Mending | None:
    """The smallest change that is fair to all numbers tried; None where none was found.

    One number is changed at a time, by some percent, and rounded to three digits.
    """
    text = lab.scene.read_text(encoding="utf-8")
    with TemporaryDirectory() as folder:
        path = Path(folder) / lab.scene.name
        for change in CHANGES:
            for mending, changed in candidates(text, change, lab.rule.settings):
                path.write_text(changed, encoding="utf-8")
                if is_fair(replace(lab, scene=path), outcome):
                    return mending
    return None


def is_fair(lab: Lab, outcome: LabTrial) -> bool:
    """Whether a scene is fair to all variants on which a lab was tried."""
    try:
        return bool(judged(lab, outcome.many).fair.all())
    except GraphkinError:
        return False


def candidates(
    text: str, change: float, given: Collection[str] = ()
) -> Iterator[tuple[Mending, str]]:
    """Every scene with one of its numbers larger or smaller by some percent.

    A parameter's value is changed too, unless the parameter is in ``given``, which each student
    gets.
    """
    lines, section = text.split("\n"), ""
    for row, line in enumerate(lines):
        if found := SECTION.match(line):
            section = found[1]
        key, equals, value = line.partition("=")
        shared = section == "parameters" and key.strip() not in given
        if not (section in CHANGED or shared) or not equals or FIXED.match(line):
            continue
        stated = value.partition("#")[0]
        if shared:
            found = VALUE.match(stated)
            stated = found[0] if found else ""
        for number in NUMBER.finditer(stated):
            for factor in (1 + change / 100, 1 - change / 100):
                old, new = number[0], f"{float(number[0]) * factor:.3g}"
                if float(new) == float(old):
                    continue
                start = len(key) + 1 + number.start()
                changed = line[:start] + new + line[start + len(old) :]
                percent = 100 * (float(new) / float(old) - 1)
                mending = Mending(row + 1, start, line.partition("#")[0].strip(), old, new, percent)
                yield mending, "\n".join([*lines[:row], changed, *lines[row + 1 :]])


# --- proposals ------------------------------------------------------------------------------------


APART = 0.5
"""The largest share that another's right values may earn, where the lab states none."""
COURSE = "mechanics 2026"
"""The course for which data are drawn, where the lab states none."""


class ProposedRanges(Struct, frozen=True):
    """Ranges to draw from for a course.

    ``count`` is the number of different data. ``kept`` is the number of sheets with fair data, of
    ``of`` in a class, at the limit ``apart``. ``exact`` is the share of data that a pencil draws
    accurately enough. ``positions`` are those of the lab, drawn from all that the scene allows.
    """

    ranges: Mapping[str, Range | ValueList]
    course: str
    count: int
    apart: float
    kept: int
    of: int
    exact: float = 1.0
    positions: SeveralValues | None = None

    @property
    def lines(self) -> list[str]:
        """The table ``[variants]`` that draws from them."""
        return variants_lines(self.ranges, self.course, self.positions)


def proposed_ranges(lab: Lab, found: FairRanges) -> ProposedRanges | None:
    """The ranges that were found, tried on a class; None where there are none."""
    if found.ranges is None:
        return None
    course = lab.rule.course or COURSE
    apart = lab.fair.apart if lab.fair.apart is not None else APART
    positions = lab.rule.positions
    own = "" if positions is None else positions.parameter
    ranges = {name: values for name, values in found.ranges.items() if name != own}
    rule = LabRule(course, ranges, positions=positions)
    new = replace(lab, rule=rule, fair=replace(lab.fair, apart=apart))
    students = [Student(i, f"{i:04d}", i) for i in range(1, CLASS + 1)]
    every = assigned(new, students)
    kept, of = sum(each.fair for each in every), len(every)
    return ProposedRanges(
        ranges, course, found.count, apart, kept, of, found.exact_inside, positions
    )


class FormulaFaults(Struct, frozen=True):
    """The numbers to which a formula is unfair, with reasons, and a change that mends it."""

    unfair: Mapping[str, str]
    mending: Mending | None = None


def formula_faults(lab: Lab) -> FormulaFaults:
    """The faults of a lab's formula, and the smallest change that mends them."""
    outcome = tried(lab)
    unfair = {
        number: "; ".join(map(str, outcome.fairness.faults(i)))
        for i, number in enumerate(outcome.names)
        if not outcome.fairness.fair[i]
    }
    return FormulaFaults(unfair, mended(lab, outcome) if unfair else None)


# --- the report on fair ranges, and the text for lab.toml -----------------------------------------


SHOWN = 6
"""The most limits listed."""
NUMBERS = 12
"""The most numbers for which the faults of a formula are listed."""


def range_lines(lab: Lab, found: FairRanges) -> Iterator[str]:
    """The whole report on where a lab is fair."""
    tried = found.tried
    draws = "all" if tried.complete else "draws"
    range_texts = (f"{name} {draw_words(values)}" for name, values in tried.space.items())
    yield from labelled("tried", [f"{len(tried.places)} {draws} of {', '.join(range_texts)}"])
    if found.left_alone:
        names = ", ".join(found.left_alone)
        yield from labelled("left", [f"{names}: no min and max in the scene, so left as written"])
    yield from labelled("limits", [limit_words(lab.fair)])
    fair = [f"{100 * tried.share:.0f} %"]
    if found.exact:
        share = f"{100 * sum(found.exact) / len(found.exact):.0f} %"
        fair.append(f"a pencil draws {share} of {len(found.exact)} of these exactly enough")
    yield from labelled("fair", fair)
    rows = [(limit, str(times)) for limit, times in tried.reasons()]
    more = [f"and {len(rows) - SHOWN} more limits"] if rows[SHOWN:] else []
    lines = [*table(("limit", "times"), rows[:SHOWN]), *more] if rows else ["none"]
    yield from labelled("unfair", lines)
    if tried.share < 1:
        guilt = sorted(((tried.guilt(name), name) for name in tried.space), reverse=True)
        shares = [f"{name} {100 * share:.0f} %" for share, name in guilt]
        yield from labelled("decides", [f"{', '.join(shares)} of what is fair and what is not"])
        for _, name in guilt:
            yield from labelled(name[:9], value_lines(found, name))


def value_lines(found: FairRanges, name: str) -> list[str]:
    """The fair share by the values of a parameter."""
    rows = []
    for first, last, share, _ in found.tried.by_value(name):
        ends = exact_text(first)
        if last != first:
            ends += f" to {exact_text(last)}"
        rows.append((ends, f"{100 * share:.0f}", "#" * round(20 * share)))
    return table(("value", "fair, %", ""), rows)


def variants_lines(
    ranges: Mapping[str, Range | ValueList], course: str, positions: SeveralValues | None = None
) -> list[str]:
    """The table ``[variants]`` that draws from some ranges, with the positions of a lab."""
    is_drawn = bool(ranges) or positions is None or bool(positions.count)
    lines = ["[variants]", *([f'course = "{course}"'] if is_drawn else [])]
    if positions is not None:
        formulas = ", ".join(f'"{each.text}"' for each in positions.formulas)
        several = f"[{formulas}]" if formulas else str(positions.count)
        lines.append(f"positions = {{ {positions.parameter} = {several} }}")
    draws = [f"{name} = {listed_alone(values)}" for name, values in ranges.items()]
    return [*lines, "[variants.draw]", *draws] if draws else lines


def listed_alone(values: Range | ValueList) -> str:
    """The values as TOML, a single value as a list: alone, it is no rule to draw by."""
    text = as_toml(values)
    return f"[{text}]" if isinstance(values, Range) and len(values) == 1 else text


def as_toml(values: Range | ValueList) -> str:
    """A range, or a list of ranges and values, as lab.toml writes it."""
    if isinstance(values, ValueList):
        return f"[{', '.join(map(as_toml, values.parts))}]"
    if len(values) == 1:
        return number_text(values.least)
    ends = {"min": values.least, "max": values.most, "step": values.step}
    return f"{{ {', '.join(f'{key} = {number_text(end)}' for key, end in ends.items())} }}"


def number_text(value: Fraction) -> str:
    """An exact number as TOML; in quotes where its decimals are infinite."""
    text = exact_text(value)
    return f'"{text}"' if "/" in text else text


def mending_lines(unfair: Mapping[str, str], mending: Mending | None) -> list[str]:
    """The numbers to which a formula is unfair, why, and the change that mends it."""
    if not unfair:
        return ["the formula is fair to every number"]
    lines = [f"number {number}: {why}" for number, why in [*unfair.items()][:NUMBERS]]
    if len(unfair) > NUMBERS:
        lines.append(f"and {len(unfair) - NUMBERS} numbers more, see graphkin check")
    if mending is None:
        return [*lines, "no change of one number of the scene by up to 12 % is fair to all"]
    change = f"{mending.old} to {mending.new} ({mending.percent:+.1f} %)"
    return [*lines, f"fair to all: scene.toml, line {mending.line}, {mending.text}: {change}"]


COMPONENT = {kind.sign: words("en")(kind.legend).partition(":")[0] for kind in COMPONENTS}
"""The name of each component of an acceleration, by its sign."""
FORCE_NAMES = ("R_23", "F_b5", "M_b1")
"""The symbols of a reaction, a balancing force and a balancing moment."""
SHEET = {sheet[0]: sheet for sheet in SHEETS}
"""The sheet for the first letter of an arrow's symbol."""


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
    for quantity in TRAVEL:
        yield travel_item(quantity, names[quantity.whose])
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
    return f"{of}, {item.unit}" if item.unit else of


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


def causes_of(mechanism: Mechanism) -> Mapping[str, str]:
    """The causes that can occur in a mechanism's fields, by name, with what the student did."""
    whole = standard(mechanism, all_fields(mechanism).values(), Rubric())
    found = {ANOTHER, *(cause.name for cause in FormFields(Variants((whole,))).causes)}
    return {name: said for name, said in causes().items() if name in found}


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
        raise SceneError.at(f'"{name}"', message("is no name for a lab"), expected, hint)


class OwnLab(Struct, frozen=True):
    """A lab made from a scene: its files, where its parameters are fair, and what it draws from.

    ``added`` is the parameter that the scene lacked, as its line in the lab's scene. ``proposed``
    is None where no ranges were found in which all is fair. The lab then draws from all that the
    scene allows.
    """

    files: list[Path]
    found: FairRanges
    proposed: ProposedRanges | None
    added: str = ""


def lab_from(
    scene: Path, name: str, folder: Path, *, force: bool = False, say: Say = lambda words: None
) -> OwnLab:
    """Make the folder of a lab for a scene, with the ranges in which all its variants are fair.

    The scene is copied. Where none of its parameters has both ends, the copy gets one for the
    position of its first driver. ``say`` receives the progress. Raises SceneError for a scene with
    a problem, for one whose position cannot vary so, and for a name that is no folder name on some
    system; PageError for files in the way.
    """
    check_name(name)
    refuse_folder(folder / name, FILES, force=force)
    data = read_bytes(scene)
    text, added = with_parameter(decoded(data), name)
    data, mechanism = text.encode("utf-8") if added else data, Mechanism(read_text(text, name))
    with TemporaryDirectory() as tried:
        place = Path(tried)
        (place / SCENE).write_bytes(data)
        lab = lab_of(rules_for(mechanism), place, mechanism, name)
        found = fair_ranges(lab, say)
        say("counting for how many students the ranges have room")
        proposed = proposed_ranges(lab, found)
    rules = lab.text if proposed is None else rules_for(mechanism, proposed)
    files = write_all(folder / name, {SCENE: data, LAB: rules.encode("utf-8")}, force)
    return OwnLab(files, found, proposed, added)


POSITION = re.compile(r"(?m)^\s*(angle|position)\s*=\s*([-+]?\d+(?:\.\d+)?)(?=\s*(?:#|$))")
TURNS = {"deg": (360.0, 5.0), "rad": (2 * pi, 0.1)}
"""A whole turn, and the step in which the angle of a driver varies, by the unit."""
SPREAD = 0.3
"""The share by which the position of a driver along a line varies."""
TABLE = re.compile(r"(?m)^\[")
PARAMETERS = re.compile(r"(?m)^\[parameters\].*\n")


def with_parameter(text: str, name: str) -> tuple[str, str]:
    """The text of a scene with a parameter for its first driver's position, and that line.

    A text whose parameters have both ends, or whose position is no plain number, stays as it is.
    """
    scene = read_text(text, name)
    first = text.find("[[drivers]]")
    found = POSITION.search(text, first) if first >= 0 else None
    ranged = any(ends(each) is not None for each in scene.parameters.values())
    if ranged or found is None or "[" in text[first + len("[[drivers]]") : found.start()]:
        return text, ""
    turns = scene.drivers[0].kind == "turn"
    letter, value = "phi" if turns else "s", float(found[2])
    names = (letter, *(f"{letter}_{i}" for i in range(1, len(scene.parameters) + 1)))
    own = next(each for each in names if each not in scene.parameters)
    if turns:
        turn, step = TURNS[scene.units["angle"]]
        value, low, high = value % turn, 0.0, turn - step / 2
    else:
        low, high = sorted((value * (1 - SPREAD), value * (1 + SPREAD))) if value else (-10.0, 10.0)
        step = 10 ** floor(log10((high - low) / 10))
    least, most = ceil(low / step), floor(high / step)
    here = min(round(value / step), most)
    value, low, high = (step * each for each in (here, least, most))
    line = f"{own} = {{ value = {value:g}, min = {low:g}, max = {high:g}, step = {step:g} }}"
    text = f'{text[: found.start(2)]}"{own}"{text[found.end(2) :]}'
    end = "\r\n" if "\r\n" in text else "\n"
    if table := PARAMETERS.search(text):
        return f"{text[: table.end()]}{line}{end}{text[table.end() :]}", line
    at = next(TABLE.finditer(text)).start()
    return f"{text[:at]}[parameters]{end}{line}{end}{end}{text[at:]}", line


def rules_for(mechanism: Mechanism, proposed: ProposedRanges | None = None) -> str:
    """The text of a lab.toml to start from, for any scene.

    It draws from the proposed ranges, or else from all that the parameters allow. No student's
    right values may earn another more than half of the points. Each asked field earns a point, a
    sense half of one, since one of two is right by chance.
    Raises SceneError where no parameter of the scene has both ends.
    """
    start = (START / "lab.toml").read_text(encoding="utf-8")
    limits, rubric = start.index("[fair]"), start.index("[marks]")
    first = start.index("\n", rubric) + 1
    more = start.index("# What is not asked", first)
    ranges = space_of(mechanism.scene) if proposed is None else proposed.ranges
    head = ["graphkin = 1", "", *variants_lines(ranges, COURSE), "", ""]
    fair = re.sub(r"(?m)^# apart = \S+", lambda line: f"apart = {APART:<5}", start[limits:first])
    fields = "".join(
        f"{name} = {points_of(item)}\n" for name, item in asked_fields(mechanism).items()
    )
    return explained("\n".join(head) + fair + fields + start[more:], mechanism)


def points_of(item: Item) -> str:
    """The points that a new lab gives a field."""
    return "0.5" if item.what == "sense" else "1"


def explained(text: str, mechanism: Mechanism) -> str:
    """The text of a lab.toml with all fields of a mechanism and its causes, and their meanings."""
    fields = all_fields(mechanism)
    stated = {line.partition(" =")[0] for line in text.splitlines()}
    lines = []
    for line in text.splitlines():
        name = line.partition(" =")[0]
        if line == "# FIELDS":
            more = (
                (f"# {each} = {points_of(item)}", meaning(item))
                for each, item in fields.items()
                if each not in stated
            )
            lines += [beside(*pair) for pair in more]
        elif line == "# CAUSES":
            own = causes_of(mechanism).items()
            lines += [beside(f'# {cause} = "{GRADES[cause]}"', said) for cause, said in own]
        else:
            lines.append(beside(line, meaning(fields[name])) if name in fields else line)
    return "\n".join(lines) + "\n"


def beside(line: str, note: str) -> str:
    return f"{line:32} # {note}"
