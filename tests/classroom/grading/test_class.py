"""A whole class: copies and wrong variants found, honest classes left in peace, processes alike."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from msgspec.structs import replace

from graphkin.classroom.grading.class_marking import Class, graded_class
from graphkin.classroom.grading.graded import Answer, Taker
from graphkin.classroom.roster.student import Student
from tests.classroom.grading.students import book_of, drawn, given, marker_of, row

CLASS = 300
GROUP = 30
FAIR = 0.4
"""The pencil of a usual student, in mm."""


def a_class(
    name: str, count: int = CLASS, seed: int = 1
) -> tuple[list[Taker], dict[str, dict[str, Answer]]]:
    """A class in half-groups of thirty, every fifth of which has some answers wrong."""
    random = np.random.Generator(np.random.PCG64(seed))
    takers, answers = [], {}
    each = -(-count // GROUP)
    sheets = {n: drawn(marker_of(name, n).standard, FAIR, each, seed + n) for n in range(1, 31)}
    for i in range(count):
        n = i % GROUP + 1
        who = f"s{i:03d}"
        takers.append(Taker(Student(i + 2, who, n), {"n": str(n)}))
        answers[who] = row(sheets[n], i // GROUP)
        if i % 5 == 0:
            answers[who] = spoiled(answers[who], random)
    return takers, answers


def spoiled(answers: Mapping[str, Answer], random: np.random.Generator) -> dict[str, Answer]:
    """Answers of which a third are wrong by any factor from a third to three."""
    wrong = {
        field: float(f"{answer.value * 3 ** random.uniform(-1, 1):.4g}")
        for field, answer in answers.items()
        if not field.endswith("_sense") and random.uniform() < 1 / 3
    }
    return {**answers, **given(wrong)}


def graded(name: str, takers: list[Taker], answers: dict[str, dict[str, Answer]]) -> Class:
    """The class, marked."""
    return graded_class(book_of(name), takers, answers)


def test_a_common_slip_is_no_copy():
    """Thirty who take rev/min for rad/s, each with the own variant and the own drawing."""
    takers, answers = a_class("pump", 60)
    for taker in takers[:GROUP]:
        standard = marker_of("pump", int(taker.settings["n"])).standard
        slip = next(s for s in marker_of("pump", 7).slips if s.name == "rpm_as_rad")
        mine = answers[taker.student.id]
        ratio = {f: slip.values[f] / marker_of("pump", 7).standard.key[f] for f in slip.values}
        assert standard.key.keys() >= ratio.keys()
        answers[taker.student.id] = {
            **mine,
            **given({f: mine[f].value * r for f, r in ratio.items()}),
        }
    assert not graded("pump", takers, answers).result.copies


def test_evidence_changes_no_mark():
    takers, answers = a_class("pump", 60)
    before = graded("pump", takers[:1], answers).result.graded[0]
    answers["s031"] = dict(answers["s000"])
    after = graded("pump", takers, answers).result.graded[0]
    assert before.marks == after.marks


def test_who_hands_in_nothing_is_absent_and_no_suspect():
    takers, answers = a_class("pump", 30)
    del answers["s003"]
    found = graded("pump", takers, answers).result
    assert [g.taker.student.id for g in found.graded if not g.present] == ["s003"]
    assert found.graded[3].earned == 0


def test_two_processes_mark_as_one_does():
    takers, answers = a_class("pump", 40)
    book = replace(book_of("pump"), markers={}, expected={})
    alone, two = graded_class(book, takers, answers), graded_class(book, takers, answers, jobs=2)
    assert alone.result == two.result
    assert [e.key for e in alone.expected] == [e.key for e in two.expected]
