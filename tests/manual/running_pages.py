"""The examples on a page of the manual, and how each is run.

The first word after the fence is the language, the second names a file:

- ``toml``: a whole scene, or a part of the last whole scene above it; ``toml lab``: a part of the
  lab that ``graphkin new lab`` makes. Both must be read; a scene must be right by both routes.
- ``toml my.toml``, ``text class.csv``: a file that later commands on the page use.
- ``console``: commands after ``$``, each with what it prints; ``…`` stands for lines left out.
- ``sh``: commands that are only parsed: they open a page, or take long.
- ``text``: what ``check`` prints for the last whole scene above it.
- ``python``: a program; numbers in the comment after a ``print`` are what it prints.
"""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import click
from pytest import MonkeyPatch

from graphkin.classroom.lab.read_lab import lab_of
from graphkin.cli.main import app
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.examples.document import VERSION, Block, blocks_in, with_part
from tests.manual.made import MANUAL, PART, ROOT, root
from tests.running import ran

START = ROOT / "graphkin" / "classroom" / "lab" / "start"
FIRST = MANUAL / "scene" / "links.md"
"""The page whose first scene the parts on other pages belong to, above their first whole scene."""
LEFT_OUT = "…"
PRINTED = re.compile(r"^\s*print\(.*?\)\s+# (.+)$", re.MULTILINE)


def by_hand(path: Path) -> str:
    """A page without the parts that the program writes; their lines stay, empty."""
    return PART.sub(lambda found: "\n" * found[0].count("\n"), path.read_text(encoding="utf-8"))


def examples(path: Path) -> list[Block]:
    """The examples of a page in order."""
    return blocks_in(by_hand(path))


def run(path: Path) -> None:
    """Run every example of a page in the current folder; the first that fails raises."""
    whole = next(each.text for each in examples(FIRST) if each.text.startswith(VERSION))
    for block in examples(path):
        if block.language == "toml" and not block.name and block.text.startswith(VERSION):
            whole = block.text
        try:
            run_block(block, whole)
        except Exception as error:
            raise AssertionError(f"{path.name}, line {block.line}: {error}") from error


def run_block(block: Block, whole: str) -> None:
    """Run one example; ``whole`` is the last whole scene above it."""
    match block.language, block.name:
        case "toml", "lab":
            must_be_a_lab(block.text)
        case "toml", "":
            is_whole = block.text.startswith(VERSION)
            must_solve(block.text if is_whole else with_part(whole, block.text))
        case "console", "":
            for command, answer in commands(block.text):
                must_answer(command, answer)
        case "sh", "":
            for line in block.text.splitlines():
                must_parse(line)
        case "text", "":
            Path("shown.toml").write_text(whole, encoding="utf-8")
            must_have(ran("check", "shown.toml").stdout, f"{LEFT_OUT}\n{block.text}{LEFT_OUT}\n")
        case "python", "":
            must_print(block.text)
        case _, name if name:
            Path(name).parent.mkdir(parents=True, exist_ok=True)
            Path(name).write_text(block.text, encoding="utf-8")
        case language, _:
            raise ValueError(f"a block of {language or 'no language'}")


def must_solve(text: str) -> None:
    """A scene must be read, and both routes must agree on it."""
    mechanism = Mechanism(read_text(text, "my"))
    assert mechanism.witness(mechanism.solve()).agrees


def must_be_a_lab(part: str) -> None:
    """The lab to start from must be read with a part of it written otherwise."""
    scene = (START / "scene.toml").read_text(encoding="utf-8")
    scene = scene[scene.index(VERSION) :].replace("NAME", "Slider-crank")
    rules = (START / "lab.toml").read_text(encoding="utf-8")
    rules = rules[rules.index(VERSION) :]
    lab_of(with_part(rules, part), START, Mechanism(read_text(scene, "scene")), "start")


def commands(text: str) -> Iterator[tuple[str, str]]:
    """The commands of a console block, each with what it prints."""
    for piece in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, answer = piece.partition("\n")
        yield command, answer


def must_answer(command: str, answer: str) -> None:
    """A command must print what the page says, on standard output or standard error."""
    name, *words = shlex.split(command)
    assert name == "graphkin", command
    found = ran(*words)
    assert found.exception is None or isinstance(found.exception, SystemExit), found.exception
    must_have(found.output, answer)


def must_have(said: str, told: str) -> None:
    """A text must be what is told, where ``…`` stands for any lines."""
    parts = re.split(rf"^{LEFT_OUT}\n", told, flags=re.MULTILINE)
    pattern = r"(?:.*\n)*".join(map(re.escape, parts))
    assert re.fullmatch(pattern, said), f"prints\n{said}\nnot\n{told}"


def must_parse(line: str) -> None:
    """A command must exist with these options; it is not run."""
    name, *words = shlex.split(line.partition("  #")[0])
    if name != "graphkin":
        return
    command: click.Command = app
    context = root()
    while isinstance(command, click.Group) and words:
        found = command.get_command(context, words.pop(0))
        assert found is not None, line
        command = found
    command.make_context(line, words, parent=context, resilient_parsing=False).close()


def must_print(program: str) -> None:
    """A program must run in the current folder, and print the numbers that its comments say."""
    said = io.StringIO()
    with MonkeyPatch.context() as patch, contextlib.redirect_stdout(said):
        patch.syspath_prepend(str(Path.cwd()))
        exec(compile(program, "manual", "exec"), {"__name__": "__main__"})
    for line, told in zip(said.getvalue().splitlines(), PRINTED.findall(program), strict=False):
        for number in re.findall(r"-?\d+\.\d+|True|False", told):
            assert number in line, f"prints {line!r}, not {told!r}"
