"""What a lab's rules make of a scene, worked out in a process beside the studio.

Both texts need not be saved: they are read as a lab of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Any, TypeVar

from msgspec import Struct

from graphkin.classroom.lab.fair_ranges import FairRanges, fair_ranges
from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.lab.lab_trial import LabTrial, tried
from graphkin.classroom.lab.proposed_ranges import (
    FormulaFaults,
    ProposedRanges,
    formula_faults,
    proposed_ranges,
)
from graphkin.classroom.lab.read_lab import LAB, SCENE, read_lab
from graphkin.text.errors import GraphkinError, Problem

POLL = 0.05
"""Seconds between two looks whether what is worked out is still wanted."""
ONE_AT_A_TIME = Lock()
Found = TypeVar("Found")


class LabTexts(Struct, frozen=True):
    """The texts of a scene and of its lab.toml, and what the lab is called."""

    scene: str
    rules: str
    name: str

    @contextmanager
    def lab(self) -> Iterator[Lab]:
        """The lab that they state. Raises SceneError as its reading does."""
        with TemporaryDirectory() as folder:
            for name, text in ((SCENE, self.scene), (LAB, self.rules)):
                (Path(folder) / name).write_text(text, encoding="utf-8")
            yield read_lab(folder, self.name)


class LabProblems(Struct, frozen=True):
    """Why a lab cannot be tried: what is wrong with its rules, or with its scene."""

    rules: tuple[Problem, ...]
    scene: tuple[Problem, ...]


class LabProposal(Struct, frozen=True):
    """Where a lab is fair, what is proposed to it, and of a formula to whom it is unfair."""

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
    formula = None if lab.rule.draws else formula_faults(lab)
    return LabProposal(found, proposed_ranges(lab, found), formula)


def answered(texts: LabTexts, work: Callable[[Lab], Found]) -> Found | LabProblems:
    """What comes of a lab, or why nothing does."""
    try:
        with texts.lab() as lab:
            return work(lab)
    except GraphkinError as error:
        own = tuple(each for each in error.problems if each.file == LAB)
        return LabProblems(own, tuple(each for each in error.problems if each.file != LAB))


def beside(work: Callable[[LabTexts], Any], texts: LabTexts, go_on: Callable[[], None]) -> Any:
    """What comes of a piece of work in a process of its own, one after another.

    ``go_on`` is called while waiting and may raise, which ends the process.
    """
    from graphkin.classroom.printing.workers import fresh_processes

    while not ONE_AT_A_TIME.acquire(timeout=POLL):
        go_on()
    try:
        context = fresh_processes()
        receiving, sending = context.Pipe(duplex=False)
        process = context.Process(target=told, args=(work, texts, sending), daemon=True)
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


def told(work: Callable[[LabTexts], Any], texts: LabTexts, sending: Any) -> None:
    """Work something out, and tell it to the studio."""
    from graphkin.classroom.printing.workers import begin

    begin()
    sending.send(work(texts))
