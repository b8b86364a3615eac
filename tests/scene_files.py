"""The scenes of the tests, each a file with a name."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parent / "scenes"


def scene_text(name: str) -> str:
    """The text of ``scenes/NAME.toml``: a whole scene, or one that lacks its head or its driver."""
    return (FOLDER / f"{name}.toml").read_text(encoding="utf-8")


def scene_texts(folder: str) -> dict[str, str]:
    """The texts of all scenes of a folder by their names."""
    paths = sorted((FOLDER / folder).glob("*.toml"))
    return {path.stem: path.read_text(encoding="utf-8") for path in paths}
