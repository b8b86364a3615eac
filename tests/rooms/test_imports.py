"""The house keeps to its plan: rooms import only from rooms before them, and never in a circle."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from graphkin import SERVICES, service
from tests.rooms.sources import HOUSE, ROOT, source

ORDER = (
    "numbers",
    "text",
    "scene",
    "structure",
    "drawing",
    "writers",
    "construction",
    "loops",
    "mechanism",
    "motion",
    "diagnosis",
    "accuracy",
    "documents",
    "importing",
    "web",
    "classroom",
    "manual",
    "studio",
    "reading",
    "cli",
)
"""The rooms, each of which may import from those before it."""
FACES = {"__init__", "__main__"}
"""What stands before the rooms: the public names, loaded where they are first used, and the
command line."""
BESIDE = {"__pycache__", "py.typed"}
"""Entries that are no room."""
MOST = 22
"""Entries of the package that one takes in at a glance."""


def modules(house: Path = HOUSE) -> dict[str, Path]:
    """Every module by its dotted name below graphkin; the house itself is "__init__"."""
    found = {}
    for path in sorted(house.rglob("*.py")):
        parts = path.relative_to(house).with_suffix("").parts
        if len(parts) > 1 and parts[-1] == "__init__":
            parts = parts[:-1]
        found[".".join(parts)] = path
    return found


def module_of(name: str, among: Iterable[str]) -> str:
    """The module in which a dotted name is looked up: the longest that begins it."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        if (module := ".".join(parts[:length])) in among:
            return module
    return "__init__"


def arrows(house: Path = HOUSE) -> dict[str, set[str]]:
    """The modules that each module imports, the house itself left out: it holds no work."""
    every = modules(house)
    return {
        module: {module_of(name, every) for _, name in source(path, house).imports}
        - FACES
        - {module}
        for module, path in every.items()
        if module not in FACES
    }


def upward(found: Mapping[str, set[str]]) -> set[tuple[str, str]]:
    """The imports from a room that stands later in the order."""
    rank = {room: number for number, room in enumerate(ORDER)}
    return {
        (module, other)
        for module, others in found.items()
        for other in others
        if rank[module.partition(".")[0]] < rank[other.partition(".")[0]]
    }


def circle(found: Mapping[str, set[str]]) -> list[str]:
    """The modules of one circle, in the order of their imports; none where there is no circle."""
    try:
        TopologicalSorter(found).prepare()
    except CycleError as error:
        return list(reversed(error.args[1]))
    return []


def without(found: Mapping[str, set[str]], left_out: Iterable[str]) -> dict[str, set[str]]:
    """The imports but for some, written "module -> other"."""
    return {
        module: {other for other in others if f"{module} -> {other}" not in left_out}
        for module, others in found.items()
    }


def test_one_takes_in_the_house_at_a_glance():
    entries = {path.name for path in HOUSE.iterdir() if path.name not in BESIDE}
    assert len(entries) <= MOST, sorted(entries)
    assert {entry.removesuffix(".py") for entry in entries} == {*ORDER, *FACES}


def test_each_room_imports_only_from_rooms_before_it():
    assert upward(arrows()) == set()


def test_no_modules_import_one_another_in_a_circle():
    assert circle(arrows()) == []


def test_who_renders_a_service_is_there():
    """The package itself says what upper rooms do for lower ones: no lower room names them."""
    import graphkin  # noqa: F401

    assert all(callable(service(name)) for name in SERVICES)
    with pytest.raises(LookupError, match="nobody renders 'tea'"):
        service("tea")


@pytest.mark.parametrize(
    ("room", "statement", "found"),
    [
        ("scene", "from graphkin.motion.sweep import Sweep", "motion.sweep.Sweep"),
        ("scene", "def f():\n    import graphkin.motion.sweep", "motion.sweep"),
        ("scene", "from graphkin import mechanism", "mechanism"),
        ("scene", "from ..motion import sweep", "motion.sweep"),
        (
            "loops",
            "if TYPE_CHECKING:\n    from graphkin.web.player import gif",
            "web.player.gif",
        ),
    ],
)
def test_no_way_of_importing_passes_unseen(tmp_path, room, statement, found):
    path = tmp_path / room / "module.py"
    path.parent.mkdir()
    path.write_text(statement, encoding="utf-8")
    ((_, name),) = source(path, tmp_path).imports
    assert name == found
    other = module_of(name, modules())
    assert upward({f"{room}.module": {other}}) == {(f"{room}.module", other)}


def test_a_circle_is_found_and_named():
    around = {"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}
    assert sorted(set(circle(around))) == ["a", "b", "c"]
    assert circle(without(around, {"c -> a"})) == []


def loaded_by(code: str) -> set[str]:
    """The modules that a fresh interpreter has loaded after some code."""
    shown = f"{code}\nimport sys\nprint(*sys.modules)"
    command = [sys.executable, "-c", shown]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return set(run.stdout.split())


HEAVY = {
    "numpy",
    "shapely",
    "matplotlib",
    "reportlab",
    "svgwrite",
    "jinja2",
    "markdown_it",
    "pikepdf",
    "filelock",
}


def test_importing_graphkin_loads_none_of_the_heavy_libraries():
    assert not HEAVY & loaded_by("import graphkin")


def test_solving_a_shipped_mechanism_loads_none_of_them_either():
    code = "import graphkin\nassert graphkin.load('pump', n=7).solve().margin > 0.8"
    assert not HEAVY & loaded_by(code)


def test_the_command_solve_loads_nothing_that_delays_its_start():
    """Beside numpy and click, which it needs, each of these takes a twentieth of its time."""
    run = "with suppress(SystemExit):\n    app(['solve', 'pump'])"
    found = loaded_by(f"from contextlib import suppress\nfrom graphkin.cli.main import app\n{run}")
    assert "graphkin.loops.witness" in found
    delays = {"pathlib", "dataclasses", "json", "locale", "unicodedata"}
    assert not (HEAVY - {"numpy"} | delays) & found
