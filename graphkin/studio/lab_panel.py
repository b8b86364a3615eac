"""The page's view of a lab that was tried: fairness, neighbours, students, and proposals."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from cmath import isnan
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Any, TypeVar

import tomlkit
from msgspec import Struct, field

from graphkin.classroom.lab.fair_ranges import FairRanges, fair_ranges
from graphkin.classroom.lab.fairness_words import (
    broken_table,
    fault_words,
    scale_table,
    some,
    spread_table,
    spreads_of,
)
from graphkin.classroom.lab.lab_model import Lab, exact_text
from graphkin.classroom.lab.lab_trial import LabTrial, tried
from graphkin.classroom.lab.new_lab import (
    APART,
    FormulaFaults,
    Mending,
    ProposedRanges,
    formula_faults,
    proposed_ranges,
)
from graphkin.classroom.lab.read_lab import LAB, SCENE, read_lab
from graphkin.classroom.variants.assign import Assigned
from graphkin.drawing.symbol_markup import symbol
from graphkin.studio.mends import Edit, units
from graphkin.text import Words
from graphkin.text.errors import GraphkinError, Problem
from graphkin.writers.templates import tables_html

POLL = 0.05
"""Seconds between two checks whether a result is still wanted."""
ONE_AT_A_TIME = Lock()
Found = TypeVar("Found")


class LabTexts(Struct, frozen=True):
    """The texts of a scene and of its lab.toml, and the name of the lab."""

    scene: str
    rules: str
    name: str

    @contextmanager
    def lab(self) -> Iterator[Lab]:
        """The lab that the texts state. Raises SceneError for mistakes in them."""
        with TemporaryDirectory() as folder:
            for name, text in ((SCENE, self.scene), (LAB, self.rules)):
                (Path(folder) / name).write_text(text, encoding="utf-8")
            yield read_lab(folder, self.name)


class LabProblems(Struct, frozen=True):
    """Why a lab cannot be tried: problems of its rules, or of its scene."""

    rules: tuple[Problem, ...]
    scene: tuple[Problem, ...]


class LabProposal(Struct, frozen=True):
    """The fair ranges of a lab, the proposed ranges, and the faults of a formula."""

    found: FairRanges
    proposed: ProposedRanges | None
    formula: FormulaFaults | None


def trial_of(texts: LabTexts) -> LabTrial | LabProblems:
    """A lab tried on a thousand variants and a class."""
    return answered(texts, tried)


def proposal_of(texts: LabTexts) -> LabProposal | LabProblems:
    """The ranges in which a lab is fair."""
    return answered(texts, searched)


def searched(lab: Lab) -> LabProposal:
    """The search of a lab's whole space, and of a formula's faults."""
    found = fair_ranges(lab)
    formula = None if lab.rule.is_drawn else formula_faults(lab)
    return LabProposal(found, proposed_ranges(lab, found), formula)


def answered(texts: LabTexts, work: Callable[[Lab], Found]) -> Found | LabProblems:
    """The result of work on a lab, or the problems that prevent it."""
    try:
        with texts.lab() as lab:
            return work(lab)
    except GraphkinError as error:
        own = tuple(each for each in error.problems if each.file == LAB)
        return LabProblems(own, tuple(each for each in error.problems if each.file != LAB))


def beside(work: Callable[[LabTexts], Any], texts: LabTexts, go_on: Callable[[], None]) -> Any:
    """The result of a piece of work in a separate process; such processes run one after another.

    ``go_on`` is called while waiting and may raise, which ends the process.
    """
    from graphkin.classroom.printing.workers import fresh_processes

    while not ONE_AT_A_TIME.acquire(timeout=POLL):
        go_on()
    try:
        context = fresh_processes()
        receiving, sending = context.Pipe(duplex=False)
        process = context.Process(target=send_result, args=(work, texts, sending), daemon=True)
        process.start()
        sending.close()
        try:
            while not receiving.poll(POLL):
                go_on()
            return receiving.recv()
        finally:
            process.kill()
            process.join()
            receiving.close()
    finally:
        ONE_AT_A_TIME.release()


def send_result(work: Callable[[LabTexts], Any], texts: LabTexts, sending: Any) -> None:
    """Run a piece of work and send its result to the studio."""
    from graphkin.classroom.printing.workers import begin

    begin()
    sending.send(work(texts))


# --- the page's view of a lab that was tried ------------------------------------------------------


class StudentRow(Struct, frozen=True):
    """A student of the class: name, data, faults, and what makes the sheet hard.

    ``earns`` is the largest share, in percent, that another student's right values earn on this
    sheet; ``whose`` is that student. ``settings`` draw the sheet.
    """

    name: str
    data: str
    settings: Mapping[str, str]
    faults: str
    flattest: str
    shortest: str
    earns: str
    whose: str


class LabReport(Struct, frozen=True):
    """A lab that was tried: the number of fair variants, tables as HTML, and the students.

    ``shares`` has a row for each sheet: the percent that each student's right values earn on it (-1
    for the student's own). More than ``apart`` is too much. ``exact`` says how many of the fair
    variants a pencil draws with sufficient accuracy.
    """

    fair: int = 0
    count: int = 0
    tables: str = ""
    students: list[StudentRow] = field(default_factory=list)
    shares: list[list[int]] = field(default_factory=list)
    apart: int = 0
    closest: str = ""
    exact: str = ""


def lab_report(outcome: LabTrial, words: Words) -> LabReport:
    """The report on a lab that was tried, in the language of the page."""
    count, near = len(outcome.many), outcome.neighbours
    shares = [] if near is None else [[percent(share) for share in row] for row in near.exact]
    names = [each.student.id for each in outcome.compared]
    closest = ""
    if near is not None:
        own, other = near.closest()[0]
        gaps = {"own": names[own], "other": names[other], "share": str(shares[own][other])}
        closest = words("studio.closest", **gaps)
    rows = [student_row(i, each, shares, names, words) for i, each in enumerate(outcome.compared)]
    broken = broken_table(outcome, words, lambda at: outcome.symbols.get(at) or symbol(at))
    found = [broken, spread_table(spreads_of(outcome), words)]
    tables = str(tables_html([*found, scale_table(outcome, words)]))
    limit = outcome.lab.fair.apart
    apart = percent(APART if limit is None else limit)
    exact = ""
    if outcome.pencilled:
        drawn = outcome.pencilled - len(outcome.coarse)
        exact = words("studio.exact_of", count=drawn, of=outcome.pencilled)
    return LabReport(count - outcome.unfair, count, tables, rows, shares, apart, closest, exact)


def percent(share: float) -> int:
    """A share in percent; -1 for a student's own sheet."""
    return -1 if isnan(share) else round(100 * share)


def student_row(
    index: int, each: Assigned, shares: Sequence[Sequence[int]], names: Sequence[str], words: Words
) -> StudentRow:
    """A student of the class that was tried."""
    most = max(range(len(names)), key=lambda other: shares[index][other]) if shares else None
    settings = {name: exact_text(value) for name, value in each.settings.items()}
    return StudentRow(
        each.student.id,
        ", ".join(f"{name} = {value}" for name, value in settings.items()),
        settings,
        "; ".join(fault_words(fault, words) for fault in each.faults),
        "" if each.flattest is None else f"{words.fixed(each.flattest, 1)}°",
        "" if each.shortest is None else f"{words.fixed(each.shortest, 1)} mm",
        "" if most is None else f"{shares[index][most]} %",
        "" if most is None else names[most],
    )


class ParameterShares(Struct, frozen=True):
    """The fair share, in percent, by the values of a parameter, and the parameter's weight."""

    name: str
    decides: int
    parts: list[tuple[str, int]]


class LabAdvice(Struct, frozen=True):
    """Advice for a lab: its fair share by parameters, new ranges, and a corrected formula.

    ``shares`` has for each parameter the part of fairness that it decides and the fair share by its
    values. ``ranges`` is the text of the proposal and ``rules`` the whole lab.toml with it;
    ``mending`` is an edit of the scene.
    """

    fair: str
    shares: list[ParameterShares]
    ranges: str = ""
    rules: str = ""
    kept: str = ""
    formula: str = ""
    mending: Edit | None = None


def lab_advice(proposal: LabProposal, texts: LabTexts, words: Words) -> LabAdvice:
    """The report on a search for fair ranges, in the language of the page."""
    tried, new = proposal.found.tried, proposal.proposed
    guilt = sorted(((tried.guilt(name), name) for name in tried.space), reverse=True)
    shares = [
        ParameterShares(name, percent(decides), list(value_shares(proposal, name)))
        for decides, name in guilt
    ]
    fair = words("studio.fair_share", share=percent(tried.share), count=len(tried.places))
    formula, mending = formula_words(proposal, texts.scene, words)
    if new is None:
        return LabAdvice(
            fair, shares, kept=words("studio.no_ranges"), formula=formula, mending=mending
        )
    lines = new.lines
    gaps = {"count": new.count, "apart": f"{100 * new.apart:g}", "kept": new.kept, "of": new.of}
    rules = with_variants(texts.rules, lines)
    kept = words("studio.kept_apart", **gaps)
    if new.exact < 1:
        kept += f" {words('studio.exact_share', share=percent(new.exact))}"
    return LabAdvice(fair, shares, "\n".join(lines), rules, kept, formula, mending)


def value_shares(proposal: LabProposal, name: str) -> Iterator[tuple[str, int]]:
    """The fair share by the values of a parameter."""
    for first, last, share, _ in proposal.found.tried.by_value(name):
        ends = exact_text(first) if last == first else f"{exact_text(first)} … {exact_text(last)}"
        yield ends, percent(share)


def with_variants(rules: str, lines: Sequence[str]) -> str:
    """The text of a lab.toml with new [variants]; everything else stays as written."""
    document = tomlkit.parse(rules)
    document["variants"] = tomlkit.parse("\n".join([*lines, "", ""]))["variants"]
    return tomlkit.dumps(document)


def formula_words(proposal: LabProposal, scene: str, words: Words) -> tuple[str, Edit | None]:
    """The numbers for which a formula is unfair and the correction, in words and as an edit."""
    found = proposal.formula
    if found is None:
        return "", None
    if not found.unfair:
        return words("studio.formula_fair"), None
    unfair = words("studio.formula_unfair", names=some([*found.unfair]))
    mending = found.mending
    if mending is None:
        return f"{unfair} {words('studio.no_mending')}", None
    gaps = {"line": mending.line, "text": mending.text, "old": mending.old, "new": mending.new}
    change = edit_of(mending, scene)
    return f"{unfair} {words('studio.mending', **gaps)}", change


def edit_of(mending: Mending, scene: str) -> Edit:
    """The change of a scene's line as an edit of its text."""
    lines = scene.split("\n")
    start = sum(len(line) + 1 for line in lines[: mending.line - 1]) + mending.column
    end = start + len(mending.old)
    return Edit(units(scene[:start]), units(scene[:end]), mending.new, before=mending.old)
