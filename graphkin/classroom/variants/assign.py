"""Assign data to students: formulas give them directly, ranges are drawn until they are fair.

The record of a class's data, as JSON: enough to derive every sheet again years later.

The manifest holds the rule as written, the course, and the lab's name with the hash of its text,
which is copied into the same folder. For each student it holds the id, the opaque code, the exact
parameters as text, and the number of draws. Tests derive the parameters again from the manifest
alone.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import groupby
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.neighbours import (
    RightValues,
    pencil_fault,
    standards_of,
    without_doubles,
)
from graphkin.classroom.grading.standard import Standard
from graphkin.classroom.lab.fairness import Fairness, Fault, judged
from graphkin.classroom.lab.lab_model import (
    Lab,
    LabRule,
    Range,
    Settings,
    SeveralValues,
    ValueList,
    exact_text,
    settings,
    sheets,
)
from graphkin.classroom.roster.read_roster import Check
from graphkin.classroom.roster.students import Student
from graphkin.numbers.arithmetic import np
from graphkin.scene.parameters import misfit, range_words
from graphkin.scene.quantity import shortest
from graphkin.text.errors import InTable, Problem, RosterError, message, problems_of
from graphkin.text.tables import Say

VAIN = 300
"""Consecutive draws that find room for nobody, after which nobody is drawn again."""
BLOCK = 256
"""The number of students whose data are compared at once with those of earlier students."""
MOST = 5_000
"""The most students of a list whose data can all be compared with one another."""


class Assigned(Struct, frozen=True):
    """The data of one student, and how fair they are.

    ``attempt`` counts the earlier draws; ``faults`` are the limits exceeded, ``computed`` the
    fields computed because there is nothing to measure. ``flattest``, the flattest crossing, and
    ``rays``, the flattest of those that fix centres and poles, are in degrees, ``shortest`` is in
    mm. They are None where nothing of the kind can be drawn.
    """

    student: Student
    settings: Settings
    attempt: int = 0
    faults: tuple[Fault, ...] = ()
    computed: tuple[str, ...] = ()
    flattest: float | None = None
    shortest: float | None = None
    rays: float | None = None

    @property
    def fair(self) -> bool:
        """Whether the data keep all limits."""
        return not self.faults

    @property
    def status(self) -> str:
        """``fair``, ``unfair``, or ``undrawable`` if the mechanism does not close or fit."""
        if self.fair:
            return "fair"
        return "unfair" if self.flattest is not None else "undrawable"


def assigned(
    lab: Lab,
    students: Sequence[Student],
    roster: str = "roster",
    say: Say = lambda words: None,
) -> list[Assigned]:
    """The data of each student by the lab's rule, the whole class judged in one batch.

    ``say`` receives the progress.

    Data drawn from ranges are drawn again if they are unfair or too close to those of an earlier
    student, as often as the rule allows; the least unfair are kept.

    A student with several positions gets an entry for each, all with the same draws.

    Raises RosterError for numbers whose formula gives values outside the scene's ranges. Raises it
    too for more students than can be compared with one another, if a limit requires the comparison.
    """
    students = entries(lab, students, roster)
    if lab.fair.needs_keys and len(students) > MOST:
        found = message(
            "has {count} students, and [fair] of lab.toml limits apart or pencil",
            count=len(students),
        )
        hint = message("split the list, or take those limits out")
        raise RosterError.at(roster, found, message("at most {most}", most=MOST), hint)
    if lab.rule.counts:
        refuse_misfits(lab, students, roster)
    say(f"data of {len(students)} students")
    every = fairest(lab, students)
    return spaced(lab, every, say) if lab.fair.needs_keys else every


def entries(lab: Lab, students: Sequence[Student], roster: str) -> list[Student]:
    """An entry for each sheet of each student. Raises RosterError if two get the same id."""
    found = [each for student in students for each in sheets(lab.rule, student)]
    taken = {student.id for student in students}
    twins = [each for each in found if each.owner and each.id in taken]
    if twins:
        raise RosterError(
            Problem(
                InTable(roster, each.row).message,
                message(
                    'sheet {part} gets the id "{id}" of another student', part=each.part, id=each.id
                ),
                message("ids that do not end in a hyphen and a number"),
            )
            for each in twins
        )
    return found


def spaced(lab: Lab, every: list[Assigned], say: Say) -> list[Assigned]:
    """The data of each student, drawn again where pencil errors or a neighbour's answers matter.

    A pencil must draw everything as exactly as the limit demands. No student's correct values may
    earn too much on the sheet of an earlier student. Data from ranges that exceed these limits are
    drawn again until many draws find room for nobody. Data that still exceed a limit get that
    fault, and the students after them are not compared.
    """
    kept: list[tuple[Assigned, Standard]] = []
    known: dict[object, Standard] = {}
    vain = 0
    found, waiting = [*every], [i for i, each in enumerate(every) if each.fair]
    while waiting:
        room = list[Fault | None]()
        for start in range(0, len(waiting), BLOCK):
            say(f"comparing students, {len(kept)} of {len(every)} have data")
            block = [found[i] for i in waiting[start : start + BLOCK]]
            names = [(*each.settings.items(), each.computed) for each in block]
            new = {name: each for name, each in zip(names, block, strict=True) if name not in known}
            known |= zip(new, held_against(lab, list(new.values())), strict=True)
            held = [known[name] for name in names]
            room += with_room(lab, kept, list(zip(block, held, strict=True)))
            if lab.rule.is_drawn and lab.fair.apart is not None and longest(room):
                room += [Fault("room")] * (len(waiting) - len(room))
                break
        near = {i: fault for i, fault in zip(waiting, room, strict=True) if fault is not None}
        owners = {found[i].student.whose for i in near}
        again = [
            i
            for i, each in enumerate(found)
            if each.student.whose in owners and each.attempt + 1 < lab.rule.attempts
        ]
        vain = vain + len(waiting) if len(near) == len(waiting) else longest(room)
        if not again or vain >= VAIN:
            for i, fault in near.items():
                found[i] = replace(found[i], faults=(fault,))
            break
        since = [found[i].attempt + 1 for i in again]
        redrawn = fairest(lab, [found[i].student for i in again], since)
        waiting = []
        spoilt = {each.student.whose for each in redrawn if not each.fair}
        for i, each in zip(again, redrawn, strict=True):
            if each.student.whose not in spoilt:
                found[i] = each
                waiting.append(i)
            elif i in near:
                found[i] = replace(found[i], faults=(near[i],))
        for i in near.keys() - {*again}:
            found[i] = replace(found[i], faults=(near[i],))
    return found


def longest(room: Sequence[Fault | None]) -> int:
    """The longest run of students without room, if it is long enough to stop drawing; else zero."""
    runs = (sum(1 for _ in run) for full, run in groupby(room, bool) if full)
    most = max(runs, default=0)
    return most if most >= VAIN else 0


def with_room(
    lab: Lab, kept: list[tuple[Assigned, Standard]], tried: Sequence[tuple[Assigned, Standard]]
) -> list[Fault | None]:
    """The fault of each of some data, or None; data without fault are added to ``kept``."""
    limit, found = lab.fair.apart, list[Fault | None]()
    data, places = without_doubles([standard for _, standard in (*kept, *tried)])
    values, taken = RightValues.of(data), places[: len(kept)]
    own = places[len(kept) :]
    near = Nearness(values, own, [*taken, *own]) if limit is not None else None
    for place, each in zip(own, tried, strict=True):
        nearest, share = near.nearest(place, taken) if near is not None else (-1, 0.0)
        if (coarse := pencil_fault(lab, each[1])) is not None:
            found.append(coarse)
        elif limit is not None and share > limit:
            found.append(Fault("apart", kept[nearest][0].student.id, share, limit))
        else:
            taken.append(place)
            kept.append(each)
            found.append(None)
    return found


class Nearness:
    """The most that the correct values of some data and of others earn on each other's sheets."""

    def __init__(self, values: RightValues, own: Sequence[int], others: Sequence[int]) -> None:
        rows, columns = list(dict.fromkeys(own)), list(dict.fromkeys(others))
        self.row = {place: row for row, place in enumerate(rows)}
        self.column = {place: column for column, place in enumerate(columns)}
        here, there = values.rows(rows), values.rows(columns)
        self.shares = np.maximum(here.by_key(there), there.by_key(here).T)

    def nearest(self, place: int, among: Sequence[int]) -> tuple[int, float]:
        """The place in ``among`` nearest to ``place``, the first of several, and its share."""
        if not among:
            return -1, 0.0
        shares = self.shares[self.row[place], [self.column[other] for other in among]]
        found = int(np.argmax(shares))
        return found, float(shares[found])


def held_against(lab: Lab, every: Sequence[Assigned]) -> list[Standard]:
    """The standard against which each student's answers are graded; all data must be drawable."""
    asked = [(each.settings, each.computed) for each in every]
    return standards_of(lab, asked) if asked else []


def refuse_misfits(lab: Lab, students: Sequence[Student], roster: str) -> None:
    """Raise RosterError with the row of each number whose formula leaves the scene's ranges."""
    problems = [
        Problem(InTable(roster, student.row).message, p.found, p.expected, p.hint)
        for student in students
        for p in misfits(lab, student)
    ]
    if problems:
        raise RosterError(problems)


def check_of(lab: Lab) -> Check | None:
    """A check for numbers whose formula leaves the scene's ranges; None for a rule of ranges."""
    return partial(misfits, lab) if lab.rule.counts else None


def misfits(lab: Lab, student: Student) -> list[Problem]:
    """The problems of a formula's data for a student: values that the scene does not allow."""
    every: list[Settings] = []
    for sheet in sheets(lab.rule, student):
        try:
            every.append(settings(lab, sheet))
        except Exception as error:
            return list(problems_of(error))
    parameters = lab.mechanism.scene.parameters
    return [
        Problem(
            "",
            message(
                "number {number} gives {name} = {value}, which is {wrong}",
                number=student.number,
                name=name,
                value=shortest(value),
                wrong=wrong,
            ),
            range_words(each),
        )
        for name, value in dict.fromkeys(pair for given in every for pair in given.items())
        if (wrong := misfit(each := parameters[name], value))
    ]


def fairest(lab: Lab, students: Sequence[Student], since: Sequence[int] = ()) -> list[Assigned]:
    """The first fair data that the rule gives each student, else the least unfair of those tried.

    ``since`` are the attempts from which each student starts; all start from 0 if it is left out.
    """
    groups: dict[str, list[int]] = {}
    for i, student in enumerate(students):
        groups.setdefault(student.whose, []).append(i)
    found: dict[str, list[Assigned]] = {}
    attempts = list(since) or [0] * len(students)
    waiting = list(groups)
    while waiting:
        tried = [i for owner in waiting for i in groups[owner]]
        many = {i: settings(lab, students[i], attempts[i]) for i in tried}
        names = {i: tuple(each.items()) for i, each in many.items()}
        different = {names[i]: many[i] for i in tried}
        place = {name: index for index, name in enumerate(different)}
        fairness = judged(lab, list(different.values()))
        for owner in waiting:
            drawn = [
                one(students[i], many[i], attempts[i], fairness, place[names[i]])
                for i in groups[owner]
            ]
            found[owner] = min(found.get(owner, drawn), drawn, key=unfairness)
            for i in groups[owner]:
                attempts[i] += 1
        waiting = [
            owner
            for owner in waiting
            if not all(each.fair for each in found[owner])
            and attempts[groups[owner][0]] < lab.rule.attempts
        ]
    places = {i: found[owner][k] for owner, group in groups.items() for k, i in enumerate(group)}
    return [places[i] for i in range(len(students))]


def unfairness(every: Sequence[Assigned]) -> tuple[int, int]:
    """The sort key for the least unfair data: drawable first, then by number of faults."""
    return sum(each.flattest is None for each in every), sum(len(each.faults) for each in every)


def one(
    student: Student, given: Settings, attempt: int, fairness: Fairness, index: int
) -> Assigned:
    """The data of one student with the results of the batch for them."""
    drawn = bool(fairness.closes[index] and fairness.fits[index])
    shortest, rays = float(fairness.shortest[index]), float(fairness.flattest_rays[index])
    return Assigned(
        student,
        given,
        attempt,
        fairness.faults(index),
        fairness.computed(index),
        float(fairness.flattest[index]) if drawn else None,
        shortest if drawn and shortest != float("inf") else None,
        rays if drawn and rays != float("inf") else None,
    )


FORMAT = 1
"""The version of the manifest's format."""
MANIFEST, TABLE, COPY = "manifest.json", "variants.csv", "lab"
"""The files of a class folder, and the folder with the copy of its lab."""
CODE = 10
"""The length of an opaque code: 50 bits, so that two codes of a class agree once in 10⁹ classes."""


def manifest(
    lab: Lab,
    students: Sequence[Assigned],
    hashes: Mapping[str, str],
    roster: str,
    salt: str,
    language: str = "",
) -> dict[str, Any]:
    """The manifest of a class.

    ``hashes`` are those of scene.toml, lab.toml, the table and the roster. ``language`` is the
    language of the class's pages, if it is not the scene's.
    """
    import numpy

    from graphkin import __version__

    return {
        "format": FORMAT,
        "graphkin": __version__,
        "numpy": numpy.__version__,
        "lab": lab.name,
        "course": lab.rule.course,
        "rule": written_rule(lab.rule),
        "roster": roster,
        "sha256": dict(hashes),
        "salt": salt,
        **({"language": language} if language else {}),
        "students": [entry(each, salt) for each in students],
    }


def entry(each: Assigned, salt: str) -> dict[str, Any]:
    """The entry of one student in the manifest."""
    student = each.student
    return {
        "row": student.row,
        "number": student.number,
        "id": student.id,
        **({"owner": student.owner, "part": student.part} if student.owner else {}),
        "name": student.name,
        "group": student.group,
        "code": code(salt, student.id),
        "parameters": {name: exact_text(value) for name, value in each.settings.items()},
        "attempt": each.attempt,
        "status": each.status,
        "flattest_deg": rounded(each.flattest, 2),
        "shortest_mm": rounded(each.shortest, 2),
        "limits": [str(fault) for fault in each.faults],
        "compute": list(each.computed),
    }


def rounded(value: float | None, digits: int) -> float | None:
    """A rounded number, or None."""
    return None if value is None else round(value, digits)


def code(salt: str, student: str) -> str:
    """The opaque code of a student: ten base-32 digits of SHA-256 over salt and id."""
    digest = hashlib.sha256((salt + student).encode("utf-8")).digest()
    return base64.b32encode(digest).decode("ascii")[:CODE]


def written_rule(rule: LabRule) -> dict[str, Any]:
    """A rule as lab.toml writes it, numbers as exact texts."""
    formulas: dict[str, Any] = {
        "set": {name: formula.text for name, formula in rule.settings.items()}
    }
    if rule.positions is not None:
        formulas["positions"] = written_positions(rule.positions)
        if rule.is_drawn:
            formulas["tries"] = rule.tries
    if not rule.draws:
        return formulas
    draws = {name: written_draw(values) for name, values in rule.draws.items()}
    given = rule.settings or rule.positions is not None
    return {**(formulas if given else {}), "draw": draws, "tries": rule.tries}


def written_positions(several: SeveralValues) -> dict[str, Any]:
    """Several values of a parameter as lab.toml writes them, with the range from which they are."""
    if several.range is None:
        return {several.parameter: [each.text for each in several.formulas]}
    return {several.parameter: several.count, "of": written_draw(several.range)}


def written_draw(values: Range | ValueList) -> Any:
    """Drawn values as lab.toml writes them: the ends and step of a range, or a list of ranges."""
    if isinstance(values, ValueList):
        return [written_draw(part) for part in values.parts]
    ends = {"min": values.least, "max": values.most, "step": values.step}
    return {key: exact_text(end) for key, end in ends.items()}


def as_text(raw: Mapping[str, Any]) -> str:
    """A manifest as the text of its file."""
    return json.dumps(raw, indent=1, ensure_ascii=False) + "\n"
