"""A lab to start from: a folder whose scene and rule are sound, with a word beside each key."""

from __future__ import annotations

import re
from pathlib import Path

from graphkin.classroom.lab.fair_ranges import space_of
from graphkin.classroom.lab.fair_ranges_words import variants_lines
from graphkin.classroom.lab.items import asked_fields
from graphkin.classroom.lab.meanings import fields_of, slips
from graphkin.classroom.lab.proposed_ranges import COURSE
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import Problem, SceneError
from graphkin.writers.files import RESERVED, write_all

START = Path(__file__).parent / "start"
FILES = ("scene.toml", "lab.toml")
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,59}")


def new_lab(name: str, folder: Path, *, force: bool = False) -> list[Path]:
    """Make the folder of a new lab within another, and tell which files it has.

    Raises SceneError for a name that makes no folder everywhere, PageError for files in the way.
    """
    if not NAME.fullmatch(name) or name.upper() in RESERVED:
        expected = "letters, digits, - and _, at most 60, such as crank-lab"
        hint = "-o DIR says in which folder it is made"
        raise SceneError(Problem(f'"{name}"', "is no name for a lab", expected, hint))
    texts = {file: (START / file).read_text(encoding="utf-8") for file in FILES}
    texts["lab.toml"] = explained(
        texts["lab.toml"], Mechanism(read_text(texts["scene.toml"], name))
    )
    files = {file: text.replace("NAME", name).encode("utf-8") for file, text in texts.items()}
    return write_all(folder / name, files, force)


def rules_for(mechanism: Mechanism) -> str:
    """Rules to start from for any scene: data from all that its parameters allow, the usual limits,
    a point for each field that is asked.

    Raises SceneError where no parameter of the scene has both ends.
    """
    start = (START / "lab.toml").read_text(encoding="utf-8")
    limits, rubric = start.index("[fair]"), start.index("[marks]")
    first = start.index("\n", rubric) + 1
    more = start.index("# What is not asked", first)
    head = ["graphkin = 1", "", *variants_lines(space_of(mechanism.scene), COURSE), "", ""]
    fields = "".join(f"{name} = 1\n" for name in asked_fields(mechanism))
    return explained("\n".join(head) + start[limits:first] + fields + start[more:], mechanism)


def explained(text: str, mechanism: Mechanism) -> str:
    """A rubric with every field of a mechanism and every slip, and what each means."""
    fields = fields_of(mechanism)
    stated = {line.partition(" =")[0] for line in text.splitlines()}
    lines = []
    for line in text.splitlines():
        name = line.partition(" =")[0]
        if line == "# FIELDS":
            more = ((f"# {each} = 1", told) for each, told in fields.items() if each not in stated)
            lines += [beside(*pair) for pair in more]
        elif line == "# SLIPS":
            lines += [beside(f"# {each} = 0.5", told) for each, told in slips().items()]
        else:
            lines.append(beside(line, fields[name]) if name in fields else line)
    return "\n".join(lines) + "\n"


def beside(line: str, told: str) -> str:
    """A line with what it means beside it."""
    return f"{line:32} # {told}"
