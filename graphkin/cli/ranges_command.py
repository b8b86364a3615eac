"""``graphkin ranges``: where in the space of its parameters a lab is fair."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec.structs import replace

from graphkin.cli.console import complain
from graphkin.cli.options import FolderType, force_option, tell

if TYPE_CHECKING:
    from graphkin.classroom.lab.fair_ranges import FairRanges
    from graphkin.classroom.lab.lab_model import Lab

CLASS = 60
"""Students of the class on which the proposal is tried."""
APART = 0.5
"""Most that another's right values may earn, where the lab says nothing."""


@click.command()
@click.argument("name", metavar="LAB")
@click.option("-o", "--output", "folder", metavar="DIR", type=FolderType(path_type=Path))
@force_option
def ranges(name: str, folder: Path | None, force: bool) -> None:
    """Find the ranges of a lab's parameters in which every variant is fair.

    LAB is the name of a shipped lab or a folder with scene.toml and lab.toml; the space is what the
    scene's parameters allow from min to max, the limits are those of [fair]. Tells what is fair by
    the values of each parameter, which parameter decides, and proposes [variants] to be pasted; of
    a formula to which numbers it is unfair, why, and the smallest change that mends it. With -o
    pictures of the fair share, by parameter and by pairs.

    \b
    Example:
      graphkin ranges crank-lab -o ranges
    """
    from graphkin.classroom.lab.fair_ranges import fair_ranges
    from graphkin.classroom.lab.fair_ranges_words import range_lines
    from graphkin.classroom.lab.lab_model import Formula
    from graphkin.classroom.lab.read_lab import read_lab
    from graphkin.text.plain_table import labelled

    lab = read_lab(name)
    found = fair_ranges(lab)
    tell(range_lines(lab, found))
    if isinstance(lab.rule, Formula):
        tell(labelled("formula", formula_lines(lab)))
    tell(["", *proposed(lab, found)])
    if folder is not None:
        from graphkin.classroom.lab.fair_ranges_pictures import pictures
        from graphkin.writers.files import write_all

        files = dict(pictures(found, lab.name, lab.name))
        tell(["", *map(str, write_all(folder, files, force))])


def formula_lines(lab: Lab) -> list[str]:
    """To which numbers a formula is unfair, why, and what mends that."""
    from graphkin.classroom.lab.fair_ranges_words import mending_lines
    from graphkin.classroom.lab.formula_mending import mended
    from graphkin.classroom.lab.lab_trial import tried

    trial = tried(lab)
    unfair = {
        number: "; ".join(map(str, trial.fairness.faults(i)))
        for i, number in enumerate(trial.names)
        if not trial.fairness.fair[i]
    }
    return mending_lines(unfair, mended(lab, trial) if unfair else None)


def proposed(lab: Lab, found: FairRanges) -> list[str]:
    """The ranges as text, and how many students they keep apart."""
    from graphkin.classroom.lab.fair_ranges_words import proposal
    from graphkin.classroom.lab.lab_model import Ranges
    from graphkin.classroom.roster.student import Student
    from graphkin.classroom.variants.assign import assigned

    if found.ranges is None:
        complain("no ranges were found in which all is fair")
        return []
    course = lab.rule.course if isinstance(lab.rule, Ranges) else "mechanics 2026"
    apart = lab.fair.apart if lab.fair.apart is not None else APART
    new = replace(lab, rule=Ranges(course, found.ranges), fair=replace(lab.fair, apart=apart))
    students = [Student(i, f"{i:04d}", i) for i in range(1, CLASS + 1)]
    kept = sum(each.fair for each in assigned(new, students))
    room = f"{kept} of {CLASS} students" if kept < CLASS else f"all {CLASS} students of a class"
    told = f"# {found.count} different data; at apart = {apart:g} they keep {room} apart"
    return [told, *proposal(found, course)]
