"""Reads a lab from scene.toml and lab.toml in its folder.

All problems of lab.toml are reported at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import cast

from msgspec.structs import replace

from graphkin.classroom.lab.items import all_fields
from graphkin.classroom.lab.lab_model import NAMES as CAUSES
from graphkin.classroom.lab.lab_model import (
    NUMBER,
    SHARES,
    Fair,
    Lab,
    LabRule,
    OwnCause,
    Range,
    Rubric,
    SeveralValues,
    ValueList,
)
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.scene.expression import UnreadableError
from graphkin.scene.file_limits import decoded, read_bytes, tables_of
from graphkin.scene.findings import Findings, Table, listed, near_name, nearest, shown
from graphkin.scene.house import House, house_beside
from graphkin.scene.measures import FloatText, quantity
from graphkin.scene.model import Parameter, Scene
from graphkin.scene.parameters import optional, out_of_range, plain, rational
from graphkin.scene.quantity import Quantity, expression, shortest
from graphkin.scene.read_scene import check_version, read_scene
from graphkin.text import LANGUAGES
from graphkin.text.errors import NO_WORDS, Mend, Problem, SceneError, joined, message, verbatim

LAB, SCENE = scene_files.LAB, scene_files.SCENE
USUAL, LIMITS = Rubric(), Fair()
OPEN = -1.0
"""The value of a limit that is not written."""
MOST = {"follow": 1, "point": 10, "line": 10, "ruler": 10, "floor": 1, "cap": 1, "rounded": 1}
"""The largest value of each number in [marking]."""
MOST_TRIES = 10_000
MOST_DIGITS = 12
FEWEST, MOST_SHEETS = 2, 12
"""The fewest and the most positions of one student, each on a sheet of its own."""
MOST_VALUES = 10**9
"""The most values of a range."""


def read_lab(name: str | Path, called: str = "", house: House | None = None) -> Lab:
    """The lab of a shipped lab's name, of a folder with lab.toml, or of that file.

    It is named after its folder, unless ``called`` gives a name, as for a copy stored with a class.
    It has the conventions of the house.toml in its folder unless others are given.
    Raises SceneError with the problems of the scene or, where it has none, with every problem of
    lab.toml.
    """
    folder = find(name)
    house = house_beside(folder / LAB) if house is None else house
    scene = read_scene_of(folder, house)
    try:
        text = decoded(read_bytes(folder / LAB))
        return lab_of(text, folder, scene, called or folder.absolute().name)
    except SceneError as error:
        places = (placed(problem) for problem in error.problems)
        raise SceneError(places) from error


def read_scene_of(folder: Path, house: House) -> Mechanism:
    """The mechanism of a lab's scene. Raises SceneError, with the file in each problem."""
    try:
        return Mechanism(read_scene(folder / SCENE, house=house))
    except SceneError as error:
        raise SceneError(placed(problem, SCENE) for problem in error.problems) from error


def find(name: str | Path) -> Path:
    """The folder of a lab. Raises SceneError, with the nearest name, where there is none."""
    folder = scene_files.folder(name)
    if folder is not None:
        return folder
    path, known = Path(name), with_rules()
    if path.exists():
        beside = path if path.is_dir() else path.parent
        found = (
            message("is a scene without {lab}", lab=LAB)
            if (beside / "scene.toml").is_file()
            else message("is no lab")
        )
        hint = message("graphkin new lab NAME makes a lab to start from")
        raise SceneError.at(
            str(name), found, message("a folder with scene.toml and {lab}", lab=LAB), hint
        )
    near = near_name(str(name), known)
    hint = message("did you mean {new}?", new=near) if near else NO_WORDS
    expected = message(
        "a folder with scene.toml and {lab}, or one of {known}", lab=LAB, known=", ".join(known)
    )
    raise SceneError.at(str(name), message("is neither a folder nor a shipped lab"), expected, hint)


def with_rules() -> list[str]:
    """The shipped labs that have a lab.toml."""
    return [name for name in scene_files.names() if (scene_files.shelf() / name / LAB).is_file()]


def placed(problem: Problem, file: str = LAB) -> Problem:
    """The problem, with its file."""
    return replace(problem, file=file)


def lab_of(text: str, folder: Path, mechanism: Mechanism, name: str) -> Lab:
    """The lab that a text states for a scene. Raises SceneError with every problem found."""
    findings = Findings()
    top = Table("", tables_of(text, findings), findings)
    if not top.raw:
        raise SceneError.at(
            "", message("the file is empty"), message("graphkin = 1, then [variants]")
        )
    check_version(top, findings)
    rule = read_rule(top.table("variants"), mechanism.scene)
    fair = read_fair(top.table("fair"))
    rubric = read_rubric(top.table("marks"), top.table("marking"), mechanism)
    top.finish()
    findings.stop()
    scene = folder / "scene.toml"
    return Lab(name, folder, scene, rule, fair, rubric, text, mechanism.scene.house)


def read_rule(table: Table, scene: Scene) -> LabRule:
    """The rule that gives each student's data."""
    both = message(
        "set = {{ … }} with formulas of the number, course = … and draw = {{ … }} with ranges"
    )
    if not {"set", "draw", "positions"} & table.raw.keys():
        table.findings.add(table.place, message("no rule"), message("{both}, or both", both=both))
    positions = read_positions(table.table("positions"), scene) if "positions" in table else None
    of_number = "draw" not in table and not (positions is not None and positions.count)
    if of_number:
        rule = read_formula(table, scene, positions)
    else:
        rule = read_ranges(table, scene, positions)
    for key in ("course", "tries") if of_number else ():
        if key in table:
            table.take(key)
            table.wrong(
                key, message("belongs to ranges"), message("draw = {{ … }}, or leave it out")
            )
    table.known += ["set", "draw", "positions"]
    table.finish()
    if positions is not None and positions.parameter in {*rule.draws, *rule.settings}:
        table.findings.add(
            f"{table.at('positions')}.{positions.parameter}",
            message("set or draw gives {name} as well", name=positions.parameter),
            message("one of them"),
        )
    return rule


def read_positions(table: Table, scene: Scene) -> SeveralValues | None:
    """The parameter of which each student gets several values: how many, or a formula for each."""
    names = known_parameters(table, scene)
    if len(table.raw) > 1:
        table.findings.add(
            table.place,
            message("{count} parameters", count=len(table.raw)),
            message("one, such as positions = {{ p = 3 }}"),
        )
    if len(names) != 1 or len(table.raw) > 1:
        return None
    (name,) = names
    raw, place = table.take(name), table.at(name)
    if isinstance(raw, list) and FEWEST <= len(raw) <= MOST_SHEETS:
        read = [formula(f"{place}[{i}]", each, table.findings) for i, each in enumerate(raw)]
        found = tuple(each for each in read if each is not None)
        return SeveralValues(name, found) if len(found) == len(raw) else None
    values = whole_range(scene.parameters[name], place, table.findings)
    if isinstance(raw, int) and not isinstance(raw, bool) and values is not None:
        most = min(len(values), MOST_SHEETS)
        if FEWEST <= raw <= most:
            return SeveralValues(name, range=values, count=raw)
        expected = message("a whole number from {least} to {most}", least=FEWEST, most=most)
        table.findings.add(place, shown(raw), expected)
    elif values is not None:
        expected = message(
            "a count, such as {example}, or a list of {least} to {most} formulas of the number",
            example=3,
            least=FEWEST,
            most=MOST_SHEETS,
        )
        table.findings.add(place, shown(raw), expected)
    return None


def whole_range(parameter: Parameter, place: str, findings: Findings) -> Range | None:
    """All values of a parameter; None, with a problem noted, where the scene gives no steps."""
    least, most, step = parameter.minimum, parameter.maximum, parameter.step
    if least is None or most is None or step is None:
        findings.add(
            place,
            message("the scene gives no steps to choose from"),
            message("min, max and step in [parameters]"),
        )
        return None
    return Range(plain(least), plain(most), plain(step))


def read_formula(table: Table, scene: Scene, positions: SeveralValues | None) -> LabRule:
    """Read each parameter as an expression in the student's number."""
    several = positions.formulas if positions is not None else ()
    is_alone = "set" not in table and "positions" in table
    inner = table.table("positions" if is_alone else "set")
    settings = {} if is_alone else read_settings(inner, scene)
    uses = any(NUMBER in read.uses() for read in (*settings.values(), *several))
    if (settings or several) and not uses and not inner.findings.inside(inner.place):
        found = message("no formula uses {number}, so all students get the same", number=NUMBER)
        inner.findings.add(inner.place, found, message('such as n = "{number}"', number=NUMBER))
    return LabRule(settings=settings, positions=positions)


def read_settings(table: Table, scene: Scene) -> dict[str, Quantity]:
    """Parameters as numbers or expressions in the student's number, where readable."""
    read = {
        name: formula(table.at(name), table.raw[name], table.findings)
        for name in known_parameters(table, scene)
    }
    return {name: found for name, found in read.items() if found is not None}


def formula(
    place: str, raw: object, findings: Findings, known: Sequence[str] = (NUMBER,)
) -> Quantity | None:
    """A number, or an expression in ``known`` names; None, with a problem noted, otherwise.

    Only an expression in the student's number may divide round.
    """
    first = next(iter(known), NUMBER)
    try:
        if isinstance(raw, str) and not isinstance(raw, FloatText):
            read = expression(raw, "", place, counting=known == (NUMBER,))
        else:
            read = quantity(raw, "", place)
    except UnreadableError as error:
        findings.add(
            place,
            error.found,
            message('an expression in quotes, such as "{number}"', number=first),
            error.hint,
        )
        return None
    strangers = sorted(read.uses() - {*known})
    for name in strangers:
        hint = Mend(name, NUMBER) if known == (NUMBER,) else nearest(name, known)
        findings.add(
            place,
            message("{text} uses {name}", text=shown(read.text), name=name),
            message("only {number}", number=joined(", ", known)),
            hint,
        )
    return None if strangers else read


def read_ranges(table: Table, scene: Scene, positions: SeveralValues | None) -> LabRule:
    """Read each parameter as a range, and the course, whose name goes into the hash."""
    course = table.text("course").strip()
    if not course and not table.findings.inside(table.at("course")):
        expected = message('a text, such as course = "mechanics 2026", to draw anew each year')
        table.wrong("course", message("is missing"), expected)
    tries = whole(table, "tries", 100, 1, MOST_TRIES)
    inner = table.table("draw")
    names = known_parameters(inner, scene) if "draw" in table else []
    draws: dict[str, Range | ValueList] = {}
    for name in names:
        parameter = scene.parameters[name]
        found: Range | ValueList | None
        if isinstance(inner.raw[name], list):
            found = read_choice(inner, name, parameter)
        else:
            found = read_range(inner.table(name), parameter)
        if found is not None:
            draws[name] = found
    settings: dict[str, Quantity] = {}
    if "set" in table:
        fixed = table.table("set")
        settings = read_settings(fixed, scene)
        for name in settings.keys() & inner.raw.keys():
            place = fixed.at(name)
            fixed.findings.add(
                place,
                message("draw gives {name} as well", name=name),
                message("either set or draw"),
            )
    return LabRule(course, draws, tries, settings, positions)


def known_parameters(table: Table, scene: Scene) -> list[str]:
    """The keys that are parameters of the scene.

    Other keys are noted as problems, and so is an empty table.
    """
    for name in table.raw:
        if name not in scene.parameters:
            expected = listed(scene.parameters) or message("a parameter, and the scene has none")
            table.wrong(name, message("is no parameter"), expected, nearest(name, scene.parameters))
    if not table.raw and not table.findings.inside(table.place.partition(".")[0]):
        table.findings.add(table.place, message("sets no parameter"), listed(scene.parameters))
    return [name for name in table.raw if name in scene.parameters]


def read_choice(table: Table, name: str, parameter: Parameter) -> ValueList | None:
    """Read a list of values and ranges without overlap, so that all values are equally likely."""
    parts: list[Range] = []
    raw, place = cast("list[object]", table.take(name)), table.at(name)
    for i, part in enumerate(raw):
        at = f"{place}[{i}]"
        if isinstance(part, dict):
            found = read_range(Table(at, part, table.findings), parameter)
        else:
            found = read_value(at, part, parameter, table.findings)
        parts += [found] if found is not None else []
    if not raw:
        table.findings.add(
            place, message("an empty list"), message("values, or {{ min = …, max = …, step = … }}")
        )
    ordered = sorted(parts, key=lambda part: part.least)
    for before, part in pairwise(ordered):
        if part.least <= before.most:
            found_twice = message(
                "{least} lies within what is listed already", least=shortest(part.least)
            )
            table.findings.add(
                place, found_twice, message("values and ranges apart from one another")
            )
            return None
    return ValueList(tuple(parts)) if parts and len(parts) == len(raw) else None


def read_value(place: str, raw: object, parameter: Parameter, findings: Findings) -> Range | None:
    """A single value that the scene allows."""
    read = rational(place, raw, findings)
    if read is None:
        return None
    value = plain(read)
    wrong = out_of_range(parameter, value, place)
    findings.extend(wrong)
    return None if wrong else Range(value, value, Fraction(1))


def read_range(table: Table, parameter: Parameter) -> Range | None:
    """Read a range with min, max and step, within what the scene allows."""
    ends = {key: optional(table, key) for key in ("min", "max", "step")}
    missing = [key for key in ends if key not in table]
    for key in missing:
        table.wrong(key, message("is missing"), message("{{ min = …, max = …, step = … }}"))
    table.finish()
    if any(end is None for end in ends.values()):
        return None
    least, most, step = (plain(end) for end in ends.values() if end is not None)
    if step <= 0:
        table.wrong("step", verbatim(shortest(step)), message("a number above 0"))
    elif least > most:
        table.wrong(
            "min", message("{least} is above max", least=shortest(least)), message("at most max")
        )
    elif (most - least) / step >= MOST_VALUES:
        table.wrong(
            "step", message("makes too many values"), message("at most {most}", most=MOST_VALUES)
        )
    else:
        found = Range(least, most, step)
        second = found.value(1) if len(found) > 1 else least
        for key, value in (("min", least), ("max", found.value(len(found) - 1)), ("step", second)):
            wrong = out_of_range(parameter, value, table.at(key))
            if wrong:
                table.findings.extend(wrong)
                return None
        return found
    return None


def read_fair(table: Table) -> Fair:
    """The limits of fairness."""
    crossing = number(table, "crossing", LIMITS.crossing, 0, 89)
    segment = number(table, "segment", LIMITS.segment, 0, 1000)
    raw = table.take("triangle")
    triangle = LIMITS.triangle
    if raw is not None:
        ends = (
            [
                rational(f"{table.at('triangle')}[{i}]", end, table.findings)
                for i, end in enumerate(raw)
            ]
            if isinstance(raw, list) and len(raw) == 2
            else []
        )
        if not ends:
            table.wrong("triangle", shown(raw), message("two numbers [least, most] of v/l"))
        elif None not in ends:
            low, high = (float(plain(end)) for end in ends if end is not None)
            triangle = (low, high)
            if not 0 <= low < high:
                table.wrong(
                    "triangle", verbatim(f"[{low:g}, {high:g}]"), message("0 ≤ least < most")
                )
    shares = [number(table, key, OPEN, 0, 1) for key in ("apart", "pencil")]
    apart, pencil = (None if share == OPEN else share for share in shares)
    table.finish()
    return Fair(crossing, segment, triangle, apart, pencil)


def read_rubric(marks: Table, marking: Table, mechanism: Mechanism) -> Rubric:
    """Read the points by the fields of the form, and how marks are given."""
    points: dict[str, Fraction] = {}
    known = all_fields(mechanism) if marks.raw else {}
    for name, raw in marks.raw.items():
        if name not in known:
            expected = message("a field of the form: {known}", known=listed(known))
            marks.wrong(name, message("no field of this scene"), expected, nearest(name, known))
            continue
        read = rational(marks.at(name), raw, marks.findings)
        if read is not None and plain(read) < 0:
            marks.wrong(name, verbatim(read.text), message("points, not less than 0"))
        elif read is not None:
            points[name] = plain(read)
    grades = read_grades(marking.table("grades"))
    causes, own = read_causes(marking.table("causes"), mechanism.scene)
    given = {key: number(marking, key, getattr(USUAL, key), 0, most) for key, most in MOST.items()}
    digits = read_digits(marking)
    if given["floor"] > given["cap"]:
        marking.wrong(
            "floor", message("{given:g} is above cap", given=given["floor"]), message("at most cap")
        )
    hold, says_right = marking.flag("hold"), marking.flag("says_right")
    marking.finish()
    return Rubric(
        points=points,
        causes=causes,
        grades=grades,
        own=own,
        digits=digits,
        hold=hold,
        says_right=says_right,
        **given,
    )


def read_digits(table: Table) -> tuple[int, int] | None:
    """The fewest and the most significant digits of a value; None where the lab wants none."""
    raw = table.take("digits")
    if raw is None:
        return None
    ends = raw if isinstance(raw, list) else []
    whole = [end for end in ends if isinstance(end, int) and not isinstance(end, bool)]
    if len(whole) != 2 or len(ends) != 2 or not 1 <= whole[0] <= whole[1] <= MOST_DIGITS:
        expected = message("two whole numbers [fewest, most] from 1 to {most}", most=MOST_DIGITS)
        table.wrong("digits", shown(raw), expected)
        return None
    return whole[0], whole[1]


def read_grades(table: Table) -> dict[str, float]:
    """The share of all points that a slight, a moderate and a serious cause costs."""
    found = {grade: number(table, grade, share, 0, 1) for grade, share in SHARES.items()}
    table.finish()
    return found


def read_causes(table: Table, scene: Scene) -> tuple[dict[str, float | str], dict[str, OwnCause]]:
    """What causes cost by name, and the causes of this lab alone, which are tables."""
    found: dict[str, float | str] = {}
    own: dict[str, OwnCause] = {}
    for name, raw in table.raw.items():
        if isinstance(raw, dict) and name not in CAUSES:
            own[name] = read_own_cause(table.table(name), name, scene)
        elif name not in CAUSES:
            hint = nearest(name, CAUSES)
            table.wrong(name, message("no cause has this name"), joined(", ", CAUSES), hint)
        else:
            found[name] = read_cost(table, name, 0)
    return found, own


def read_cost(table: Table, key: str, default: float | str) -> float | str:
    """What a cause costs: a grade, or a share of all points."""
    raw = table.raw.get(key)
    if not isinstance(raw, str) or isinstance(raw, FloatText):
        return default if raw is None else number(table, key, 0, 0, 1)
    table.take(key)
    if raw in SHARES:
        return raw
    expected = message("{grades} or a number from 0 to 1", grades=joined(", ", tuple(SHARES)))
    table.wrong(key, shown(raw), expected, nearest(raw, SHARES))
    return default


def read_own_cause(table: Table, name: str, scene: Scene) -> OwnCause:
    """A cause of this lab: the data as they were taken, what it costs, and its sentence."""
    inner = table.table("set")
    known = tuple(scene.parameters)
    read = {
        each: formula(inner.at(each), inner.raw[each], inner.findings, known)
        for each in known_parameters(inner, scene)
    }
    cost = read_cost(table, "cost", "moderate")
    said = {each: text for each in LANGUAGES if (text := table.text(each).strip())}
    if not said:
        expected = message('a sentence, such as en = "the angle was measured from the vertical"')
        table.findings.add(table.place, message("no sentence says what it was"), expected)
    table.finish()
    return OwnCause(name, {k: v for k, v in read.items() if v is not None}, cost, said)


def number(table: Table, key: str, default: float, least: float, most: float) -> float:
    """A number between two bounds; the default where it is missing or wrong."""
    raw = table.take(key)
    if raw is None:
        return default
    read = rational(table.at(key), raw, table.findings)
    if read is None:
        return default
    value = float(plain(read))
    if not least <= value <= most:
        table.wrong(
            key,
            verbatim(read.text),
            message("a number from {least:g} to {most:g}", least=least, most=most),
        )
        return default
    return value


def whole(table: Table, key: str, default: int, least: int, most: int) -> int:
    """A whole number between two bounds; the default where it is missing or wrong."""
    value = number(table, key, default, least, most)
    if value != int(value):
        table.wrong(key, verbatim(f"{value:g}"), message("a whole number"))
    return int(value)
