"""Class folders to print: a manifest, a small lab, and students with any ids and names."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from tests.scene_files import scene_text

SCENE = scene_text("classroom/printed-lab")
LAB = """graphkin = 1
[variants]
set = { n = "number" }
[marks]
v_B_mm = 2
v_B = 1
omega_2 = 1
omega_2_sense = 0.5
"""
LEVER = scene_text("classroom/lever")
"""A mechanism that does not close at every angle."""
LEVER_LAB = 'graphkin = 1\n[variants]\nset = { n = "number" }\n'

Make = Callable[..., Path]


def write_class(
    folder: Path,
    ids: Sequence[str],
    *,
    names: Sequence[str] | None = None,
    numbers: Sequence[int] | None = None,
    scene: str = SCENE,
    lab: str = LAB,
    **more: object,
) -> Path:
    """A class folder as graphkin variants writes it."""
    (folder / "lab").mkdir(parents=True)
    (folder / "lab" / "scene.toml").write_text(scene, encoding="utf-8")
    (folder / "lab" / "lab.toml").write_text(lab, encoding="utf-8")
    hashes = {
        name: hashlib.sha256((folder / "lab" / name).read_bytes()).hexdigest()
        for name in ("scene.toml", "lab.toml")
    }
    names = names or [f"Ștefan Pop {i}" for i in range(1, len(ids) + 1)]
    numbers = numbers or range(1, len(ids) + 1)
    students = [
        {
            "id": id_,
            "name": name,
            "group": "331 A",
            "code": code_of(place),
            "parameters": {"n": str(number)},
            "compute": ["v_B_mm", "v_B"] if place == 1 and lab == LAB else [],
        }
        for place, (id_, name, number) in enumerate(zip(ids, names, numbers, strict=True))
    ]
    record = {"format": 1, "lab": "slider", "sha256": hashes, "students": students, **more}
    text = json.dumps(record, ensure_ascii=False)
    (folder / "manifest.json").write_text(text, encoding="utf-8")
    return folder


def code_of(place: int) -> str:
    """An opaque code, ten capitals and digits."""
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ234567"
    return "".join(letters[(place * 7 + i * i + place // 32) % 32] for i in range(8)) + (
        letters[place // 32] + letters[place % 32]
    )


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Make a class folder: make("331", ["0001", "0002"])."""

    def made(name: str, ids: Sequence[str], **options: object) -> Path:
        return write_class(tmp_path / name, ids, **options)

    return made


def tree(folder: Path) -> dict[str, bytes]:
    """All files of a folder by name."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}
