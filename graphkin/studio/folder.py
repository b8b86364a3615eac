"""The folder that the studio reads and writes; files outside it cannot be named.

A file, link or text of another program, brought into the studio as the text of a scene.
"""

from __future__ import annotations

import os
import re
import unicodedata
from base64 import b64decode
from binascii import Error
from collections.abc import Mapping
from functools import lru_cache
from itertools import count
from pathlib import Path, PurePath
from typing import Any

from msgspec import Struct

from graphkin.importing.figure import Completion
from graphkin.importing.formats import content, imported, is_drawing, text_of
from graphkin.importing.scene_text import scene_text
from graphkin.scene import scene_files
from graphkin.scene.file_limits import LARGEST, decoded, read_bytes, tables_of
from graphkin.text.errors import NO_WORDS, Message, SceneError, joined, message, verbatim
from graphkin.text.problems import spoken
from graphkin.writers.files import RESERVED

ENDING = ".toml"
SCENE = "scene.toml"
"""The scene of a lab, in its folder."""
MOST = 500
"""Largest number of scenes listed."""
LONGEST, DEEPEST = 200, 6
"""Largest number of characters and of parts of a name."""
FORBIDDEN = re.compile(r'[\x00-\x1f\x7f\\:*?"<>|]')
"""Characters that some file system treats in a special way."""
UNSEEN = frozenset(("Cc", "Cf", "Co", "Cn", "Zl", "Zp"))
"""Categories of characters that reverse, hide or break a text: a name must be as it looks."""
WORD = re.compile(r"\w[\w-]{0,60}")
"""A name that works on every file system."""
OTHERS = frozenset((scene_files.LAB, "pyproject.toml"))
"""Files that are not scenes: neither listed, read nor written."""


class Folder:
    """A folder with scenes, some of them in folders of their own."""

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()

    def path(self, name: str) -> Path:
        """The file of a name such as ``pump.toml`` or ``crank-lab/scene.toml``.

        A name has one file, whether its accents are composed (NFC) or decomposed (NFD). Raises
        SceneError for an invalid name and for a name that leads out of the folder.
        """
        problem = doubt(name)
        forms = [name, *(unicodedata.normalize(form, name) for form in ("NFC", "NFD"))]
        there = (form for form in forms if not problem and os.path.lexists(self.root / form))
        target = None if problem else (self.root / next(there, forms[1]))
        if target is None or not target.resolve().is_relative_to(self.root):
            expected = message(
                "a name within this folder, ending in {ending}, such as {name}",
                ending=ENDING,
                name=meant(name),
            )
            raise SceneError.at("file", problem or message("leads out of the folder"), expected)
        return target

    def lab_path(self, name: str) -> Path:
        """The lab.toml next to a scene, by the scene's name.

        Raises SceneError where the scene is not called scene.toml, or the file is outside the
        folder.
        """
        scene = self.path(name)
        if scene.name != SCENE:
            expected = message(
                "a folder with its scene and its rules, such as {name}/{scene}",
                name=stem_of(name),
                scene=SCENE,
            )
            raise SceneError.at(
                "file",
                message("{name} has no {lab}", name=scene.name, lab=scene_files.LAB),
                expected,
            )
        path = scene.with_name(scene_files.LAB)
        if not path.resolve().is_relative_to(self.root):
            found = message("the {lab} beside it leads out of the folder", lab=scene_files.LAB)
            raise SceneError.at("file", found, message("a file within this folder"))
        return path

    def rules(self, name: str) -> str:
        """The text of the lab.toml next to a scene.toml; empty if there is none."""
        if name.rpartition("/")[2] != SCENE or not self.lab_path(name).is_file():
            return ""
        return decoded(read_bytes(self.lab_path(name)))

    def scenes(self) -> list[str]:
        """The names of the scenes here and in the folders here, in alphabetical order."""
        found = [*self.root.glob(f"*{ENDING}"), *self.root.glob(f"*/{SCENE}")]
        names = sorted(path.relative_to(self.root).as_posix() for path in found)
        return [name for name in names if self.holds(name)]

    def holds(self, name: str) -> bool:
        """Whether a name is the name of a readable scene here."""
        try:
            return self.path(name).is_file()
        except SceneError:
            return False

    def free(self, name: str) -> str:
        """A name derived from a scene's, under which no file exists yet."""
        stem = stem_of(name)
        names = (f"{stem}-{n}{ENDING}" for n in count(2))
        return next(each for each in names if not os.path.lexists(self.root / each))

    def read(self, name: str) -> str:
        """The text of a scene. Raises SceneError where it is missing or unreadable."""
        path = self.path(name)
        scene_files.settle(path)
        if not path.is_file():
            raise SceneError.at(
                "file",
                message("there is no file {name} here", name=name),
                message("one that is listed"),
            )
        return decoded(read_bytes(path))

    def name_as_written(self, path: Path) -> str:
        """The name of a path that was made from a name."""
        return path.relative_to(self.root).as_posix()

    def name_of(self, path: Path) -> str:
        """The name of a file by its path. Raises SceneError for a file outside the folder."""
        found = path.resolve()
        if not found.is_relative_to(self.root):
            hint = message("start the studio in {parent}", parent=found.parent)
            raise SceneError.at(
                str(path), message("lies outside this folder"), verbatim(str(self.root)), hint
            )
        return found.relative_to(self.root).as_posix()


def meant(name: str) -> str:
    """A valid name as near as possible to a given one."""
    stem = name.replace("\\", "/").rpartition("/")[2].removesuffix(ENDING)
    near = f"{stem}{ENDING}"
    return near if WORD.fullmatch(stem) and near not in OTHERS else f"pump{ENDING}"


def with_ending(name: str) -> str:
    """A name with the ending of a scene, if it has no ending of its own."""
    last = name.rpartition("/")[2]
    return name if not last or "." in last else f"{name}{ENDING}"


def doubt(name: str) -> Message:
    """The error of a name in itself; empty for a valid one."""
    parts = name.split("/")
    if not name.endswith(ENDING) or name == ENDING:
        return message("the name does not end in {ending}", ending=ENDING)
    if len(name) > LONGEST or len(parts) > DEEPEST:
        return message("the name is too long")
    if parts[-1] in OTHERS:
        return message("{name} is no scene", name=parts[-1])
    return next((found for part in parts if (found := doubt_of_part(part))), NO_WORDS)


def doubt_of_part(part: str) -> Message:
    """The error of one part of a name."""
    if not part or part.startswith(".") or part != part.rstrip(" ."):
        return message("a part of the name is empty, or begins or ends with a dot")
    if FORBIDDEN.search(part):
        return message("the name holds a sign that file names do not have everywhere")
    if any(unicodedata.category(sign) in UNSEEN for sign in part):
        return message("the name holds a sign that cannot be seen")
    if part.partition(".")[0].upper() in RESERVED:
        return message("{name} is the name of a device", name=part)
    return NO_WORDS


def stem_of(name: str) -> str:
    """The name of a scene by its file, or by its folder for scene.toml."""
    *folders, file = name.split("/")
    return folders[-1] if folders and file == SCENE else file.removesuffix(ENDING)


@lru_cache(maxsize=8)
def shipped(language: str) -> list[tuple[str, str]]:
    """The labs that come with graphkin: names and titles."""
    shelf = scene_files.shelf()
    return [(name, title_in(shelf / name / SCENE, language)) for name in scene_files.names()]


@lru_cache(maxsize=8)
def examples(language: str) -> list[tuple[str, str]]:
    """The other scenes that come with graphkin: names and titles."""
    return [(name, title_in(path, language)) for name, path in scene_files.examples().items()]


def title_in(path: Path, language: str) -> str:
    """The title of a scene that comes with graphkin, in the given language where it has one."""
    tables = tables_of(decoded(read_bytes(path)))
    titles = tables.get("titles")
    own = titles.get(language) if isinstance(titles, dict) else None
    return str(own or tables.get("title", ""))


def shipped_text(name: str) -> str:
    """The text of the scene of a lab of graphkin. Raises SceneError for an unknown lab."""
    if name not in scene_files.names():
        raise SceneError.at(
            "lab", message("there is no lab {name}", name=name), joined(", ", scene_files.names())
        )
    return decoded(read_bytes(scene_files.shelf() / name / SCENE))


def example_text(name: str) -> str:
    """The text of another scene that comes with graphkin. Raises SceneError for an unknown name."""
    found = scene_files.examples().get(name)
    if found is None:
        raise SceneError.at(
            "scene", message("there is no scene {name}", name=name), message("one that is listed")
        )
    return decoded(read_bytes(found))


def shipped_rules(name: str) -> str:
    """The text of the lab.toml of a lab that comes with graphkin; empty if it has none."""
    path = scene_files.shelf() / name / scene_files.LAB
    return decoded(read_bytes(path)) if path.is_file() else ""


MOST_BYTES = 2 * LARGEST
"""Largest number of bytes of a file; its base 64 fits into a request."""


class Brought(Struct, frozen=True):
    """What the page sends: a file in base 64 with its name, or a pasted text, and what a drawing
    does not say.
    """

    file: str
    name: str
    pasted: str
    tracing: Completion

    def text(self) -> str:
        """The text that is imported. Raises SceneError where there is none."""
        if not self.file:
            link = self.pasted.strip()
            return content(link) if "://" in link[:10] else text_of(self.pasted.encode())
        try:
            return text_of(b64decode(self.file, validate=True))
        except Error:
            return ""


def brought(order: Brought, language: str) -> dict[str, Any]:
    """The text of the scene, the name of its file, and the notes. Raises GraphkinError."""
    found = scene_text(imported(order.text(), order.tracing), order.name)
    stem = PurePath(order.name or "imported").stem
    return {
        "text": found.text,
        "name": meant(f"{stem}{ENDING}") if order.name else f"imported{ENDING}",
        "notes": [spoken(note, language) for note in found.notes],
    }


def asks_more(order: Brought) -> bool:
    """Whether a text is a drawing, which does not say what is fixed."""
    try:
        return is_drawing(order.text())
    except Exception:  # the error of the import itself is reported
        return False


def tracing_of(fields: Mapping[str, str]) -> Completion:
    """What the page says of a drawing: fixed points, the driven bar, and sliding points."""
    slides = (word.partition("=") for word in fields["slides"].replace(",", " ").split())
    return Completion(
        tuple(fields["fixed"].replace(",", " ").split()),
        tuple(part.strip() for part in fields["drive"].split("-") if part.strip()),
        {name: angle or "0" for name, _, angle in slides},
    )
