"""The house keeps to its plan: each room imports only from the rooms that the table allows."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

HOUSE = Path(__file__).resolve().parents[2] / "graphkin"
BASE = {"errors", "arithmetic", "kinds", "plane"}
NUMERIC = {
    "scene",
    "structure",
    "steps",
    "plans",
    "loops",
    "witness",
    "freedom",
    "ranges",
    "alignment",
    "reach",
    "mechanism",
    "labs",
}
TABLE: dict[str, set[str]] = {
    "errors": set(),
    "arithmetic": set(),
    "kinds": {"arithmetic"},
    "plane": set(),
    "text": set(),
    "scene": set(),
    "steps": set(),
    "labs": set(),
    "structure": {"scene"},
    "loops": {"scene"},
    "plans": {"scene", "structure", "steps"},
    "freedom": {"scene", "structure", "loops"},
    "witness": {"scene", "steps", "loops"},
    "ranges": {"scene", "motion"},
    "exact": set(),
    "formal": {"exact"},
    "meeting": {"scene", "steps", "exact"},
    "alignment": {"scene", "steps", "ranges"},
    "reach": {"scene", "steps", "ranges", "meeting", "alignment"},
    "mechanism": {"scene", "structure", "steps", "plans", "witness", "reach", "labs", "notebook"},
    "notebook": {"paper", "handout", "scaling", "mechanism"},
    "paper": {"scene", "steps", "text"},
    "loci": {"steps", "mechanism", "motion"},
    "scaling": {"scene", "steps", "text", "paper", "mechanism", "loci"},
    "handout": {
        "alignment",
        "scene",
        "steps",
        "text",
        "paper",
        "mechanism",
        "witness",
        "loci",
        "scaling",
    },
    "effects": NUMERIC,
    "closures": NUMERIC,
    "certified": NUMERIC | {"formal"},
    "motion": NUMERIC,
    "curves": NUMERIC | {"motion"},
    "pencil": NUMERIC,
    "accuracy": NUMERIC | {"motion", "curves", "pencil"},
    "report": NUMERIC
    | {"accuracy", "certified", "pencil", "effects", "closures", "motion", "paper.scale"},
    "lab": NUMERIC | {"paper", "loci", "scaling", "roster", "report.table"},
    "roster": {"scene"},
    "variants": NUMERIC | {"lab", "roster", "paper", "report.table", "__version__"},
    "options": {"mechanism", "labs", "scene", "scaling", "paper.scale", "console"},
    "cli_draw": NUMERIC
    | {
        "options",
        "console",
        "accuracy",
        "curves",
        "motion",
        "report",
        "paper",
        "handout",
        "scaling",
        "screen",
    },
    "cli_class": {"options", "console", "lab", "roster", "variants"},
    "screen": NUMERIC
    | {
        "motion",
        "paper",
        "handout",
        "scaling",
        "loci",
        "text",
        "lab",
        "grading.numbers",
        "printing.form",
    },
    "printing": NUMERIC
    | {"text", "paper", "scaling", "handout", "lab", "roster", "variants", "screen", "__version__"},
    "cli_print": {"options", "printing", "paper", "console"},
    "grading": NUMERIC
    | {
        "pencil",
        "scaling",
        "handout",
        "paper",
        "text",
        "curves.style",
        "lab",
        "roster",
        "printing",
    },
    "studio": NUMERIC
    | {
        "handout",
        "lab.new",
        "paper",
        "report.centres",
        "scaling",
        "screen",
        "text",
        "__version__",
    },
    "cli_studio": {"options", "console", "studio"},
    "cli_grade": {"grading", "printing", "handout", "paper", "text", "console"},
    "console": set(),
    "__init__": {"mechanism"},
    "__main__": {"cli"},
}
"""What each room may import besides errors, arithmetic, plane and itself; cli may import all.

A name with a dot allows one module of a room.
"""
ALL = "cli"


def room_of(path: Path) -> str:
    """The room of a module: its folder in the house, or its own name."""
    return path.relative_to(HOUSE).parts[0].removesuffix(".py")


def modules() -> list[Path]:
    """Every module of the house."""
    return sorted(HOUSE.rglob("*.py"))


def imports(path: Path, house: Path = HOUSE) -> Iterator[tuple[int, str]]:
    """Line and dotted name, below graphkin, of every import in a module, also inside functions."""
    package = ("graphkin", *path.relative_to(house).parent.parts)
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) - node.level + 1] if node.level else ()
            base = ".".join((*start, *filter(None, [node.module])))
            names = [f"{base}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in names:
            if name.partition(".")[0] == "graphkin":
                yield node.lineno, name.partition(".")[2]


def allowed(room: str, name: str) -> bool:
    """Whether a room may import a dotted name."""
    first, _, rest = name.partition(".")
    if room == ALL or first in TABLE[room] | BASE | {room}:
        return True
    return f"{first}.{rest.partition('.')[0]}" in TABLE[room]


def test_every_room_is_in_the_table():
    new = {room_of(path) for path in modules()} - set(TABLE) - {ALL}
    assert not new, f"{sorted(new)} are not in the table: say there what these rooms may import"


@pytest.mark.parametrize("path", modules(), ids=lambda path: str(path.relative_to(HOUSE)))
def test_a_module_imports_only_what_its_room_may(path):
    room = room_of(path)
    if room not in TABLE and room != ALL:
        pytest.fail(f"room {room} is not in the table")
    strangers = [f"line {line}: {name}" for line, name in imports(path) if not allowed(room, name)]
    assert not strangers, f"{room} may not import {strangers}"


@pytest.mark.parametrize(
    ("room", "statement", "found"),
    [
        ("scene", "from graphkin.plans.pen import Pen", "plans.pen.Pen"),
        ("scene", "def f():\n    import graphkin.plans.pen", "plans.pen"),
        ("scene", "from graphkin import mechanism", "mechanism"),
        ("scene", "from ..plans import pen", "plans.pen"),
        ("paper", "from graphkin.plans.position import CLEAR", "plans.position.CLEAR"),
        ("report", "from graphkin.paper.svg import text", "paper.svg.text"),
        ("loops", "if TYPE_CHECKING:\n    from graphkin.steps.run import Trace", "steps.run.Trace"),
    ],
)
def test_no_way_of_importing_passes_unseen(tmp_path, room, statement, found):
    path = tmp_path / room / "module.py"
    path.parent.mkdir()
    path.write_text(statement, encoding="utf-8")
    ((_, name),) = imports(path, tmp_path)
    assert name == found
    assert not allowed(room, name)


@pytest.mark.parametrize(
    ("room", "name"),
    [("report", "paper.scale.Scales"), ("scene", "errors.Problem"), ("paper", "paper.svg")],
)
def test_what_the_table_allows_passes(room, name):
    assert allowed(room, name)


def loaded_by(code: str) -> set[str]:
    """The modules that a fresh interpreter has loaded after some code."""
    shown = f"{code}\nimport sys\nprint(*sys.modules)"
    command = [sys.executable, "-c", shown]
    run = subprocess.run(command, cwd=HOUSE.parent, capture_output=True, text=True, check=True)
    return set(run.stdout.split())


HEAVY = {"numpy", "shapely", "matplotlib", "reportlab", "svgwrite"}


def test_importing_graphkin_loads_none_of_the_heavy_libraries():
    assert not HEAVY & loaded_by("import graphkin")


def test_solving_a_shipped_mechanism_loads_none_of_them_either():
    code = "import graphkin\nassert graphkin.load('pump', n=7).solve().margin > 0.8"
    assert not HEAVY & loaded_by(code)
