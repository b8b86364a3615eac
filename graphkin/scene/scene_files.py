"""Where the shipped labs lie, and how a name or a path becomes the file of a scene."""

from __future__ import annotations

from pathlib import Path

from graphkin.text.errors import Problem, SceneError

HERE = Path(__file__).resolve().parents[1]
SHELVES = (HERE / "sheets", HERE.parent / "sheets")
"""The package's own shelf (a wheel), then the checkout's (an editable install)."""
EXAMPLES = (HERE / "scenes", HERE.parent / "examples" / "scenes")
"""The folders with the scenes that come with it, likewise."""
LAB = "lab.toml"
"""The file that makes a scene a lab."""


def shelf() -> Path:
    """The folder with the shipped labs. Raises SceneError when the installation lacks it."""
    for folder in SHELVES:
        if folder.is_dir():
            return folder
    raise SceneError(
        Problem(
            "labs", "the shipped labs are missing", "a complete install", "install graphkin again"
        )
    )


def names() -> list[str]:
    """Names of the shipped labs, in alphabetical order."""
    return sorted(path.parent.name for path in shelf().glob("*/scene.toml"))


def examples() -> dict[str, Path]:
    """The scenes that come with it and are no labs, by name, in alphabetical order."""
    found = next((folder for folder in EXAMPLES if folder.is_dir()), None)
    return {} if found is None else {path.stem: path for path in sorted(found.glob("*.toml"))}


def folder(name: str | Path) -> Path | None:
    """The folder of a lab: a shipped lab's name, a folder with lab.toml, or that file itself.

    None where there is no lab.toml: a scene by itself is no lab.
    """
    path = Path(name)
    if path.is_file():
        return path.parent if path.name == LAB else None
    if not path.is_dir() and str(name) in names():
        path = shelf() / path
    return path if (path / LAB).is_file() else None


def find(name: str) -> Path:
    """The scene file of a path, of a folder with a scene.toml, or of a shipped lab's name."""
    path = Path(name)
    if path.is_file() and path.name == LAB:
        path = path.absolute().parent
    if path.is_dir() and (path / "scene.toml").is_file():
        return path / "scene.toml"
    if path.is_file():
        return path
    if name in names():
        return shelf() / name / "scene.toml"
    if path.is_dir():
        expected = "a folder with scene.toml, a .toml file or the name of a lab"
        raise SceneError(Problem(name, "is a folder without scene.toml", expected))
    beside = [str(path.with_name(other.name)) for other in path.parent.glob("*.toml")]
    from difflib import get_close_matches

    near = get_close_matches(name, [*beside, *names()], n=1)
    hint = f"did you mean {near[0]}? " if near else ""
    raise SceneError(
        Problem(
            name,
            "is neither a file nor a shipped lab",
            "a .toml file or one of " + ", ".join(names()),
            hint + "graphkin list shows the labs",
        )
    )
