"""The scenes of the tests, each a file with a name."""

from __future__ import annotations

import json
import re
from pathlib import Path

FOLDER = Path(__file__).parent / "scenes"
GAP = re.compile(r'"\$(\w+)"')


def scene_text(name: str, **filled: object) -> str:
    """The text of ``scenes/NAME.toml``: a whole scene, or one that lacks its head or its driver.

    Values take the places of ``"$key"`` in it; a line of which the value is None is left out.
    """
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    if filled:
        lines = [line for line in text.splitlines(keepends=True) if not dropped(line, filled)]
        text = GAP.sub(lambda gap: json.dumps(filled[gap[1]], ensure_ascii=False), "".join(lines))
    return text


def dropped(line: str, filled: dict[str, object]) -> bool:
    """Whether a value of a line is None."""
    return any(filled[key] is None for key in GAP.findall(line))


def scene_texts(folder: str) -> dict[str, str]:
    """The texts of all scenes of a folder by their names."""
    paths = sorted((FOLDER / folder).glob("*.toml"))
    return {path.stem: path.read_text(encoding="utf-8") for path in paths}
