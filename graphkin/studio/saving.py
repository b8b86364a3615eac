"""What the studio writes, and only when it is asked to: the scene, and the sheets of it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from difflib import unified_diff
from fractions import Fraction
from hashlib import sha256
from pathlib import Path

from msgspec import Struct

from graphkin.classroom.lab.rules import exact_text
from graphkin.classroom.sheet_files import sheet_files
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.scene.expression import TIME
from graphkin.scene.file_limits import decoded, read_bytes, whole_file
from graphkin.scene.model import Scene
from graphkin.scene.read_scene import read_text
from graphkin.studio.folder import SCENE, Folder, shipped_text, stem_of
from graphkin.text.errors import SceneError
from graphkin.writers.files import file_stem, write_all

VIEWS = ("key", "task", "steps", "overlay")
PAGE = "html"
FORMATS = ("svg", "pdf", PAGE, "dxf", "pmks")
MOST_LINES = 12
"""Lines that are shown of what saving would change in a file that is in the way."""


class Saved(Struct, frozen=True):
    """What became of it: the names of the files written, or of those that are in the way.

    ``mark`` identifies the content of the scene that was written, ``rules_mark`` that of its
    lab.toml; ``changes`` are the lines in which texts that are in the way differ from those to be
    saved, as `difflib` writes them.
    """

    files: tuple[str, ...] = ()
    exist: tuple[str, ...] = ()
    mark: str = ""
    rules_mark: str = ""
    changes: tuple[str, ...] = ()


class OwnRules(Struct, frozen=True):
    """The text of a lab.toml, and what identifies the content that the page last read or saved."""

    text: str
    mark: str = ""


def save_scene(
    folder: Folder,
    name: str,
    text: str,
    mark: str,
    *,
    replace: bool,
    rules: OwnRules | None = None,
) -> Saved:
    """Write the text of a scene, and its lab.toml with it, both or neither; not over files that are
    there, unless told to.

    ``mark`` identifies the content that the page last read or saved under this name: a file that
    still holds it is replaced without asking. Raises SceneError for a name that leads elsewhere,
    or of a scene that can have no lab.toml, PageError where nothing can be written.
    """
    texts = {folder.path(name): (text, mark)}
    if rules:
        texts[folder.lab_path(name)] = (rules.text, rules.mark)
    exist = [
        path
        for path, (_, own) in texts.items()
        if os.path.lexists(path) and (mark_of_file(path) or None) != own
    ]
    if exist and not replace:
        lines = [line for path in exist for line in changes(path, texts[path][0])]
        return Saved(exist=tuple(map(folder.name_as_written, exist)), changes=tuple(lines))
    data = {path.name: written.encode("utf-8") for path, (written, _) in texts.items()}
    write_all(folder.path(name).parent, data, force=True)
    own = [*map(mark_of, data.values()), ""]
    files = tuple(map(folder.name_as_written, texts))
    return Saved(files, mark=own[0], rules_mark=own[1])


def changes(path: Path, text: str) -> tuple[str, ...]:
    """The lines that saving a text would take from a file (-) and put into it (+), the first ones.

    None for a file that cannot be read.
    """
    try:
        before = decoded(read_bytes(path))
    except SceneError:
        return ()
    lines = list(unified_diff(before.splitlines(), text.splitlines(), lineterm="", n=0))[2:]
    return (*lines[:MOST_LINES], *(("…",) if len(lines) > MOST_LINES else ()))


def mark_of(data: bytes) -> str:
    """What tells one content of a file from another."""
    return sha256(data).hexdigest()


def mark_of_file(path: Path) -> str:
    """The same of a file; nothing of one that cannot be read."""
    try:
        return mark_of(whole_file(path))
    except OSError:
        return ""


class WantedSheets(Struct, frozen=True):
    """Which sheets are wanted: of which text under which name, in which language and form."""

    text: str
    name: str
    settings: Mapping[str, str]
    language: str
    view: str
    formats: Sequence[str]


def sheets_of(folder: Folder, wanted: WantedSheets) -> dict[str, bytes]:
    """The files of a scene's sheets by name, as ``graphkin sheet`` writes and names them where the
    value of every parameter is set.

    Raises as the reading of a scene and hand_out do.
    """
    name, settings, view, formats = wanted.name, wanted.settings, wanted.view, wanted.formats
    text, language = wanted.text, wanted.language
    mechanism = Mechanism(read_text(text, stem_of(name), None, settings))
    stem = file_stem(mechanism.scene.name, values_of(mechanism.scene))
    lab = lab_of(folder, name, text) if PAGE in formats else name
    return sheet_files(mechanism, lab, stem, view, language, formats)[0]


def values_of(scene: Scene) -> dict[str, str]:
    """The value of each parameter, as it is set from outside."""
    return {
        name: exact_text(Fraction(str(value)))
        for name, value in scene.values.items()
        if name != TIME
    }


def lab_of(folder: Folder, name: str, text: str) -> str:
    """The lab whose form belongs to a scene: that of its own folder, or a shipped one unchanged.

    The name of the scene's file, which is no lab, where there is none.
    """
    if name.rpartition("/")[2] == SCENE:
        return str(folder.path(name).parent)
    lab = stem_of(name)
    return lab if lab in scene_files.names() and text == shipped_text(lab) else name


def save_files(folder: Folder, files: Mapping[str, bytes], *, replace: bool) -> Saved:
    """Write files into the folder, all or none; not over others, unless told to."""
    exist = tuple(name for name in files if os.path.lexists(folder.root / name))
    if exist and not replace:
        return Saved(exist=exist)
    write_all(folder.root, files, force=True)
    return Saved(files=tuple(files))
