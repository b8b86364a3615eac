"""What the studio knows while it runs, and what it does for its page: one thing at a time."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from threading import Lock
from typing import Any

from graphkin import labs
from graphkin.errors import GraphkinError, SceneError
from graphkin.lab.new import START
from graphkin.scene.limits import tables_of
from graphkin.studio.folder import ENDING, Folder, shipped, shipped_text, stem_of
from graphkin.studio.look import Sight, look, mistakes, spoken_in, told
from graphkin.studio.orders import Order
from graphkin.studio.panels import Memory, StaleError
from graphkin.studio.places import marked
from graphkin.studio.saving import (
    FORMATS,
    VIEWS,
    Saved,
    Wanted,
    save_files,
    save_scene,
    sheets_of,
)
from graphkin.studio.written import edits
from graphkin.text import LANGUAGES, Words

TABS = 8
"""Pages whose last drawing is remembered."""
KINDS = ("velocity", "acceleration")
FIRST = "graphkin ="
"""How the first line of a scene begins."""


@dataclass(frozen=True, slots=True)
class Opened:
    """A text to begin with, and the name of the file as which it would be saved."""

    name: str
    text: str


class Desk:
    """The folder, the language of the page, and what each open page last saw.

    Drawings are made by one thread at a time: their fonts and caches are shared, and a newer move
    of a slider makes an older one needless.
    """

    def __init__(self, folder: Folder, language: str | None = None) -> None:
        self.folder = folder
        self.language = language
        self.alone, self.counting = Lock(), Lock()
        self.newest: OrderedDict[str, int] = OrderedDict()
        self.memories: dict[str, Memory] = {}

    def words(self, text: str, chosen: str = "") -> Words:
        """The words of the page: those chosen on it or at the start, else the scene's own."""
        return spoken_in(chosen or self.language or language_of(text))

    def address_of(self, name: str) -> dict[str, str]:
        """How the page is told what to open: a shipped lab, or a scene of the folder, by its path.

        Raises SceneError for what is neither, or lies outside the folder.
        """
        if not name:
            return {}
        if name in labs.names() and not Path(name).exists():
            return {"lab": name}
        return {"scene": self.folder.name_of(labs.find(name))}

    def open(self, scene: str, lab: str) -> Opened:
        """The text of a scene here, of a shipped lab, or one to start from.

        Raises SceneError for a name that is none.
        """
        if lab:
            return Opened(f"{lab}{ENDING}", shipped_text(lab))
        if scene:
            return Opened(scene, self.folder.read(scene))
        return Opened(f"new{ENDING}", start_text())

    def listed(self) -> dict[str, Any]:
        """The scenes that can be opened: those here, and the labs that come with graphkin."""
        return {"scenes": self.folder.scenes(), "labs": [list(lab) for lab in shipped()]}

    def look(self, order: Order) -> dict[str, Any]:
        """What is seen of a text; only that it is stale where a newer one was asked for since."""
        tab, number = order.text("tab"), order.number("number")
        sight = Sight(
            order.scene(),
            stem_of(order.text("name")),
            order.choice("language", LANGUAGES),
            order.settings(),
            order.choice("mechanism", KINDS),
            order.flag("quick"),
        )
        self.arrived(tab, number)
        with self.alone:
            try:
                self.still_wanted(tab, number)
                found = look(sight, self.memory(tab), lambda: self.still_wanted(tab, number))
            except StaleError:
                found = {"stale": True}
        return found | {"number": number}

    def arrived(self, tab: str, number: int) -> None:
        """Note the newest request of a page; pages not heard of for long are forgotten."""
        with self.counting:
            self.newest[tab] = max(number, self.newest.get(tab, 0))
            self.newest.move_to_end(tab)
            while len(self.newest) > TABS:
                gone, _ = self.newest.popitem(last=False)
                self.memories.pop(gone, None)

    def still_wanted(self, tab: str, number: int) -> None:
        """Raise StaleError where a page has asked for something newer."""
        if self.newest.get(tab, number) > number:
            raise StaleError

    def memory(self, tab: str) -> Memory:
        """What a page last saw."""
        return self.memories.setdefault(tab, Memory())

    def write(self, order: Order) -> dict[str, Any]:
        """The changes of a text that put the values of the sliders into it, or why they cannot."""
        text, settings = order.scene(), order.settings()
        try:
            return {"edits": [asdict(edit) for edit in edits(text, settings)], "problems": []}
        except GraphkinError as error:
            return {"edits": [], "problems": [told(mark) for mark in marked(error.problems, text)]}

    def save(self, order: Order) -> dict[str, Any]:
        """Save the text of a scene, whatever is wrong with it: what is so is told beside."""
        name, mark, replace = order.text("name"), order.text("mark"), order.flag("replace")
        text = order.scene()
        done = self.saving(lambda: save_scene(self.folder, name, text, mark, replace=replace), text)
        if not done["files"]:
            return done
        with self.alone:
            return done | {"mistakes": [told(each) for each in mistakes(text, stem_of(name))]}

    def sheets(self, order: Order) -> dict[str, Any]:
        """Draw and save the sheets of a text."""
        wanted = Wanted(
            order.scene(),
            order.text("name"),
            order.settings(),
            order.choice("language", LANGUAGES),
            order.choice("view", VIEWS),
            order.choices("formats", FORMATS),
        )
        replace = order.flag("replace")

        def saved() -> Saved:
            files = sheets_of(self.folder, wanted)
            return save_files(self.folder, files, replace=replace)

        return self.saving(saved, wanted.text)

    def saving(self, work: Callable[[], Saved], text: str) -> dict[str, Any]:
        """What was written, what is in the way, or why nothing was written."""
        try:
            with self.alone:
                return asdict(work()) | {"problems": []}
        except GraphkinError as error:
            problems = [told(mark) for mark in marked(error.problems, text)]
        return asdict(Saved()) | {"problems": problems}


def language_of(text: str) -> str:
    """The language that a scene names for its sheets, as far as its text can be read."""
    try:
        sheet = tables_of(text).get("sheet")
    except SceneError:
        return ""
    return str(sheet.get("language", "en")) if isinstance(sheet, dict) else "en"


def start_text() -> str:
    """A scene to start from: a slider-crank with a word beside each key."""
    text = (START / "scene.toml").read_text(encoding="utf-8")
    return text[text.index(FIRST) :].replace("NAME", "Slider-crank")
