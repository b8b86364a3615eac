"""``graphkin ranges``: where in the space of its parameters a lab is fair."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.console import complain
from graphkin.cli.folder_options import FolderType
from graphkin.cli.options import force_option, tell

if TYPE_CHECKING:
    from graphkin.classroom.lab.fair_ranges import FairRanges
    from graphkin.classroom.lab.lab_model import Lab


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
    from graphkin.classroom.lab.read_lab import read_lab
    from graphkin.text.plain_table import labelled
    from graphkin.writers.files import refuse_folder, write_all

    lab = read_lab(name)
    if folder is not None:
        refuse_folder(folder)
    found = fair_ranges(lab)
    tell(range_lines(lab, found))
    if not lab.rule.draws:
        tell(labelled("formula", formula_lines(lab)))
    tell(["", *proposed(lab, found)])
    if folder is not None:
        from graphkin.classroom.lab.fair_ranges_pictures import pictures

        files = dict(pictures(found, lab.name, lab.name))
        tell(["", *map(str, write_all(folder, files, force))])


def formula_lines(lab: Lab) -> list[str]:
    """To which numbers a formula is unfair, why, and what mends that."""
    from graphkin.classroom.lab.fair_ranges_words import mending_lines
    from graphkin.classroom.lab.proposed_ranges import formula_faults

    found = formula_faults(lab)
    return mending_lines(found.unfair, found.mending)


def proposed(lab: Lab, found: FairRanges) -> list[str]:
    """The ranges as text, and how many students they keep apart."""
    from graphkin.classroom.lab.fair_ranges_words import variants_lines
    from graphkin.classroom.lab.proposed_ranges import proposed_ranges

    new = proposed_ranges(lab, found)
    if new is None:
        complain("no ranges were found in which all is fair")
        return []
    room = f"{new.kept} of {new.of} students"
    if new.kept == new.of:
        room = f"all {new.of} students of a class"
    told = f"# {new.count} different data; at apart = {new.apart:g} they keep {room} apart"
    again = "the others are drawn again"
    coarse = [f"# a pencil draws {100 * new.exact:.0f} % of these exactly enough, {again}"]
    return [told, *(coarse if new.exact < 1 else ()), *variants_lines(new.ranges, new.course)]
