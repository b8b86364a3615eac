"""The folders of the shipped labs, and the scene file for a name or a path."""

from __future__ import annotations

import re
from contextlib import suppress
from typing import TYPE_CHECKING

from graphkin import service
from graphkin.scene.findings import near_file
from graphkin.scene.house import HOUSE
from graphkin.text import paths
from graphkin.text.errors import NO_WORDS, SceneError, joined, message
from graphkin.text.paths import within

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

HERE = paths.beside(paths.beside(__file__))
ABOVE = paths.beside(HERE)
SHELVES = (within(HERE, "sheets"), within(ABOVE, "sheets"))
"""The folder in the package (a wheel), then the one in the checkout (an editable install)."""
EXAMPLES = (within(HERE, "scenes"), within(ABOVE, "examples", "scenes"))
"""The folders with the example scenes, in the same order."""
LAB, SCENE, ENDING = "lab.toml", "scene.toml", ".toml"
"""The file that makes a scene a lab, the scene file of a folder, and the ending of both."""
BEGINS, HEAD = rb"(?m)^\s*graphkin\s*=", 4096
"""The first key of a scene, and the number of bytes in which it is searched for."""

UNFINISHED = ".graphkin-unfinished"
"""The folder, next to a scene or the files of a class, for files that are being written."""


def shipped() -> str:
    """The folder with the shipped labs. Raises SceneError when the installation lacks it."""
    for folder in SHELVES:
        if paths.is_folder(folder):
            return folder
    raise SceneError.at(
        "labs",
        message("the shipped labs are missing"),
        message("a complete install"),
        message("install graphkin again"),
    )


def shelf() -> Path:
    """The folder with the shipped labs, as a Path."""
    from pathlib import Path

    return Path(shipped())


def names() -> list[str]:
    """Names of the shipped labs, in alphabetical order."""
    folder = shipped()
    return [name for name in paths.in_folder(folder) if paths.is_file(within(folder, name, SCENE))]


def examples() -> dict[str, Path]:
    """The example scenes that are no labs, by name, in alphabetical order."""
    from pathlib import Path

    found = next((folder for folder in EXAMPLES if paths.is_folder(folder)), None)
    return {} if found is None else {path.stem: path for path in sorted(Path(found).glob("*.toml"))}


def settle(path: paths.Named) -> None:
    """Complete the writes of a killed run in the folder of a scene or a lab."""
    root = path if paths.is_folder(path) else paths.folder_of(path)
    if paths.is_folder(within(root, UNFINISHED)):
        service("settle")(root)


def folder(name: str | Path) -> Path | None:
    """The folder of a lab: a shipped lab's name, a folder with lab.toml, or that file itself.

    None where there is no lab.toml: a scene by itself is no lab.
    """
    from pathlib import Path

    settle(name)
    path = Path(name)
    if path.is_file():
        return path.parent if path.name == LAB else None
    if not path.is_dir() and str(name) in names():
        path = shelf() / path
    return path if (path / LAB).is_file() else None


def scenes_beside(path: str) -> Iterator[str]:
    """The scenes in the folder of a path: files that begin as a scene, and folders with a scene."""
    around = path[: len(path) - len(paths.name_of(path))]
    for other in paths.in_folder(around or "."):
        file = within(around, other, SCENE) if paths.is_folder(around + other) else around + other
        if file.endswith(ENDING) and other != HOUSE and paths.is_file(file):
            with suppress(OSError):
                if re.search(BEGINS, paths.first_bytes(file, HEAD)):
                    yield around + other


def find(name: str) -> str:
    """The scene file for a path, a folder with scene.toml, or a shipped lab's or scene's name."""
    path = name or "."
    settle(path)
    if paths.is_file(path) and paths.name_of(path) == LAB:
        path = paths.folder_of(path)
    if paths.is_file(path) and paths.name_of(path) == HOUSE:
        found = message("holds the conventions of a school, and is no scene")
        hint = message("graphkin check {file} reads it", file=path)
        raise SceneError.at(path, found, message("a scene"), hint)
    inside = within(path, SCENE)
    if paths.is_folder(path) and paths.is_file(inside):
        return inside
    if paths.is_file(path):
        return path
    if name in names():
        return within(shipped(), name, SCENE)
    if paths.is_folder(path):
        expected = message("a folder with scene.toml, a .toml file or the name of a lab")
        raise SceneError.at(path, message("is a folder without scene.toml"), expected)
    if name in (more := examples()):
        return str(more[name])
    shipped_names = (*names(), *more) if paths.name_of(path) == path else ()
    near = near_file(name, [*scenes_beside(path), *shipped_names])
    lists = message("graphkin list shows the labs, graphkin list --scenes all")
    hint = message("did you mean {new}?", new=near) if near else NO_WORDS
    raise SceneError.at(
        name,
        message("is neither a file nor a shipped lab"),
        message("a .toml file or one of {names}", names=", ".join(names())),
        joined(" ", (hint, lists)),
    )
