"""Install the lowest versions that pyproject.toml names, and draw the pump with them everywhere.

``python -m tests.lowest`` makes an environment of its own in a temporary folder, with what users
install: the program and its extras, without what only tests need.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXTRAS = ("cad", "class", "cluster", "fast", "logo", "read", "studio")
NEWEST = (3, 12)
"""The newest Python for which the lowest versions were published."""
REQUIREMENT = re.compile(r"([\w.-]+)>=([\w.]+)")
COMMANDS = (
    "sheet pump --set n=7 -o out --format svg,pdf,html,dxf",
    "cycle pump --set n=7 -o out --steps 24 --format svg,png,gif,html",
    "accuracy pump --quick -o out",
    "solve pump --set n=7 --digits 20 --json",
    "variants pump class.xlsx -o class",
    "print class --format pdf,svg,html --jobs 1",
    "grade class answers.xlsx --gradebook book.xlsx --column points",
)
TABLES = """
import openpyxl
for name, rows in {
    "class": (("number", "id"), (7, "0042")),
    "answers": (("id", "v_D"), ("0042", 3.8)),
    "book": (("id", "points"), ("0042", None)),
}.items():
    book = openpyxl.Workbook()
    for row in rows:
        book.active.append(row)
    book.save(f"{name}.xlsx")
"""
PICTURE = """
import pypdfium2
sheet = pypdfium2.PdfDocument("class/print/task/0042-task.pdf")[0]
sheet.render(scale=200 / 72).to_pil().convert("L").save("sheet.jpg")
"""
"""A sheet as a scanner sees it, which a library of the tests alone draws."""
READING = "read class sheet.jpg -o read --by-hand --jobs 1"
OTHERS = ROOT / "tests" / "lowest" / "uses.py"
"""What no command of these does."""


def lowest(pyproject: str) -> dict[str, str]:
    """The lowest version of each library by the text of pyproject.toml; ours are left out.

    Raises ValueError for a library without one.
    """
    project = tomllib.loads(pyproject)["project"]
    optional = project["optional-dependencies"]
    named = [*project["dependencies"], *(each for name in EXTRAS for each in optional[name])]
    found = {}
    for requirement in named:
        parts = REQUIREMENT.fullmatch(requirement)
        if parts is None:
            raise ValueError(f"{requirement}: no lowest version")
        found[parts[1]] = parts[2]
    return found


def interpreter() -> str | None:
    """A Python that is not too new for the lowest versions; None where there is none."""
    names = [sys.executable] if sys.version_info[:2] <= NEWEST else []
    names += [found for name in ("python3.11", "python3.12") if (found := shutil.which(name))]
    for name in names:
        if subprocess.run([name, "-c", ""], capture_output=True, check=False).returncode == 0:
            return name
    return None


def commands(home: Path) -> Iterator[list[str]]:
    """All that is run, one after the other, in a folder that is empty at first."""
    python = home / "venv" / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    constraints = home / "lowest.txt"
    lines = lowest((ROOT / "pyproject.toml").read_text(encoding="utf-8")).items()
    constraints.write_text("".join(f"{name}=={version}\n" for name, version in lines))
    pip = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    yield [*pip, "--constraint", str(constraints), f"{ROOT}[{','.join(EXTRAS)}]"]
    yield [str(python), "-c", TABLES]
    for command in COMMANDS:
        yield [str(python), "-m", "graphkin", *command.split()]
    yield [*pip, "pypdfium2"]
    yield [str(python), "-c", PICTURE]
    yield [str(python), "-m", "graphkin", *READING.split()]
    yield [str(python), str(OTHERS)]


def main() -> int:
    """Try the lowest versions; 0 when all of it works."""
    python = interpreter()
    if python is None:
        print("skipped: the lowest versions need a Python of at most 3.12")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        subprocess.run([python, "-m", "venv", str(home / "venv")], check=True)
        (home / "work").mkdir()
        for command in commands(home):
            run = subprocess.run(command, cwd=home / "work", capture_output=True, check=False)
            if run.returncode:
                print(f"with the lowest versions this fails: {' '.join(command)}")
                print((run.stdout + run.stderr).decode("utf-8", "replace")[-3000:])
                return 1
    print("the lowest versions draw, mark and serve")
    return 0


if __name__ == "__main__":
    sys.exit(main())
