"""What the studio knows while it runs, and what it does for its page: one thing at a time."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Condition, Lock
from typing import Any

from msgspec import Struct, to_builtins

from graphkin.classroom.lab.new_lab import START, rules_for
from graphkin.classroom.page_documents import hand_out_page
from graphkin.construction.core.quantities import SHEETS
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.scene.file_limits import tables_of
from graphkin.scene.read_scene import read_text
from graphkin.structure.driver_count import driver_name
from graphkin.studio.building import KINDS, Act, built
from graphkin.studio.folder import (
    ENDING,
    MOST,
    Folder,
    example_text,
    examples,
    shipped,
    shipped_rules,
    shipped_text,
    stem_of,
    with_ending,
)
from graphkin.studio.guard import new_token
from graphkin.studio.lab_panel import lab_advice, lab_report
from graphkin.studio.lab_work import LabProblems, LabTexts, beside, proposal_of, trial_of
from graphkin.studio.look import Sight, look, spoken_in, told_in
from graphkin.studio.page_requests import PageRequest, PageRequestError
from graphkin.studio.panels import Memory, StaleError
from graphkin.studio.saving import (
    FORMATS,
    VIEWS,
    OwnRules,
    Saved,
    WantedSheets,
    mark_of_file,
    save_files,
    save_scene,
    sheets_of,
)
from graphkin.studio.scene_edits import edits
from graphkin.studio.sketch import sketch
from graphkin.text import LANGUAGES, Words, words
from graphkin.text.errors import GraphkinError, SceneError
from graphkin.text.markup import as_text

OPENED = ("lab", "example", "like", "empty", "scene")
"""What an address may ask to open, by its key."""
PICTURED = ("scene", "lab", "example")
"""What has a picture in the gallery."""
TABS = 8
"""Pages whose last drawing is remembered."""
EMPTY = """graphkin = 1
title = "New mechanism"
units = { length = "mm", angle = "deg", speed = "rev/min" }
"""
"""A scene in which nothing is built yet."""
FIRST = "graphkin ="
"""How the first line of a scene begins."""


def language_in(order: PageRequest) -> str:
    """The language of the page."""
    return order.choice("language", LANGUAGES)


def with_curves(mechanism: Mechanism, stem: str, language: str, driver: int | None) -> str:
    """The page of a cycle, of one driver or of all with the time: what moves together."""
    from graphkin.motion.cycle import cycle
    from graphkin.web.frames import motion
    from graphkin.web.player import player_page

    spoken = spoken_in(language)
    return player_page(motion(cycle(mechanism, driver=driver), spoken), spoken)


def step_by_step(mechanism: Mechanism, stem: str, language: str, driver: int | None) -> str:
    """The page that draws itself, whose pins are dragged, each driver's by its own handle."""
    return hand_out_page(mechanism, stem, stem, language=language)


MOVING_PAGES = {"curves": with_curves, "steps": step_by_step}
MOVING = tuple(MOVING_PAGES)


class Opened(Struct, frozen=True):
    """A text to begin with, and the name of the file as which it would be saved.

    ``mark`` identifies the content of that file; it is empty for a text that is in no file here.
    ``rules`` are the text of the lab.toml that belongs to it, ``rules_mark`` the same of that.
    ``gone``: there is no such file here, whatever a browser may keep of it.
    """

    name: str
    text: str
    mark: str = ""
    rules: str = ""
    rules_mark: str = ""
    gone: bool = False


class Session:
    """The folder, the language of the page, and what each open page last saw.

    Drawings are made by one thread at a time: their fonts and caches are shared, and a newer move
    of a slider makes an older one needless. Texts are saved without waiting for a drawing.
    """

    def __init__(self, folder: Folder, language: str | None = None) -> None:
        self.folder = folder
        self.language = language
        self.turns, self.writing = Condition(), Lock()
        self.busy = False
        self.newest: OrderedDict[str, int] = OrderedDict()
        self.memories: dict[str, Memory] = {}
        self.moving: OrderedDict[str, str] = OrderedDict()

    def words(self, text: str, chosen: str = "") -> Words:
        """The words of the page: those chosen on it or at the start, else the scene's own."""
        return spoken_in(chosen or self.language or language_of(text))

    def address_of(self, name: str) -> dict[str, str]:
        """How the page is told what to open: a shipped lab, or a scene of the folder, by its path;
        for what is named as a lab, its rules as well.

        Raises SceneError for what is neither, or lies outside the folder.
        """
        if not name:
            return {}
        lab = {"rules": "yes"} if scene_files.folder(name) else {}
        if name in scene_files.names() and not Path(name).exists():
            return {"lab": name, **lab}
        return {"scene": self.folder.name_of(Path(scene_files.find(name))), **lab}

    def open(self, name: str, kind: str) -> Opened:
        """The text of a scene here, or like it under another name; of a lab or another scene that
        comes with graphkin; an empty field; one to start from.

        Raises SceneError for a name that is none.
        """
        match kind:
            case "lab":
                return Opened(f"{name}{ENDING}", shipped_text(name), rules=shipped_rules(name))
            case "example":
                return Opened(f"{name}{ENDING}", example_text(name))
            case "like":
                return Opened(self.folder.free(name), self.folder.read(name))
            case "empty":
                return Opened(f"new{ENDING}", EMPTY)
            case "scene" if self.folder.path(name) and not self.folder.holds(name):
                return Opened(name, EMPTY, gone=True)
            case "scene":
                text, mark = self.folder.read(name), mark_of_file(self.folder.path(name))
                rules = self.folder.rules(name)
                own = mark_of_file(self.folder.lab_path(name)) if rules else ""
                return Opened(name, text, mark, rules, own)
        text = (START / "scene.toml").read_text(encoding="utf-8")
        start = text[text.index(FIRST) :].replace("NAME", "Slider-crank")
        return Opened(f"new{ENDING}", start)

    def listed(self, language: str) -> dict[str, Any]:
        """The scenes that can be opened: those here, and what comes with graphkin."""
        scenes = self.folder.scenes()
        more = len(scenes) - MOST
        return {
            "scenes": scenes[:MOST],
            "more": words(language)("studio.more_scenes", count=more) if more > 0 else "",
            "labs": shipped(language),
            "examples": examples(language),
        }

    def look(self, order: PageRequest) -> dict[str, Any]:
        """What is seen of a text; only that it is stale where a newer one was asked for since."""
        tab, number = order.text("tab"), order.number("number")
        sight = Sight(
            order.scene(),
            stem_of(order.text("name")),
            language_in(order),
            order.settings(),
            order.choice("mechanism", SHEETS),
            order.flag("quick"),
        )
        there = {"there": self.folder.holds(order.text("name"))}
        self.arrived(tab, number)
        try:
            with self.drawing(lambda: self.still_wanted(tab, number)):
                found = there | look(
                    sight, self.memory(tab), lambda: self.still_wanted(tab, number)
                )
                if order.flag("building"):
                    places = order.places()
                    seen = sketch(sight.text, sight.name, places, sight.settings)
                    found["sketch"] = seen and to_builtins(seen, enc_hook=as_text)
        except StaleError:
            found = {"stale": True}
        return found | {"number": number}

    @contextmanager
    def drawing(self, go_on: Callable[[], None] = lambda: None) -> Iterator[None]:
        """Wait until nothing else is drawn; ``go_on`` is called while waiting, and may raise."""

        def free() -> bool:
            go_on()
            return not self.busy

        with self.turns:
            self.turns.wait_for(free)
            self.busy = True
        try:
            yield
        finally:
            with self.turns:
                self.busy = False
                self.turns.notify_all()

    def arrived(self, tab: str, number: int) -> None:
        """Note the newest request of a page; pages not heard of for long are forgotten."""
        with self.turns:
            self.newest[tab] = max(number, self.newest.get(tab, 0))
            self.newest.move_to_end(tab)
            while len(self.newest) > TABS:
                gone, _ = self.newest.popitem(last=False)
                self.memories.pop(gone, None)
            self.turns.notify_all()

    def still_wanted(self, tab: str, number: int) -> None:
        """Raise StaleError where a page has asked for something newer."""
        if self.newest.get(tab, number) > number:
            raise StaleError

    def memory(self, tab: str) -> Memory:
        """What a page last saw."""
        return self.memories.setdefault(tab, Memory())

    def variants(self, order: PageRequest) -> dict[str, Any]:
        """A lab tried on a thousand variants and a class of thirty."""
        return self.of_lab(order, trial_of, lambda found, _, words: lab_report(found, words))

    def ranges(self, order: PageRequest) -> dict[str, Any]:
        """The ranges in which a lab is fair, and what mends its formula."""
        return self.of_lab(order, proposal_of, lab_advice)

    def of_lab(
        self,
        order: PageRequest,
        work: Callable[[LabTexts], Any],
        told_of: Callable[[Any, LabTexts, Words], Struct],
    ) -> dict[str, Any]:
        """What comes of a lab's texts in a process beside this one, as it is told on the page."""
        tab, number = f"{order.text('tab')} lab", order.number("number")
        texts = LabTexts(order.scene(), order.long_text("rules"), stem_of(order.text("name")))
        words = spoken_in(language_in(order))
        self.arrived(tab, number)
        try:
            found = beside(work, texts, lambda: self.still_wanted(tab, number))
        except StaleError:
            return {"stale": True, "number": number}
        if isinstance(found, LabProblems):
            wrong = told_in(found.rules, texts.rules, words.language)
            return {"problems": wrong, "scene_wrong": bool(found.scene), "number": number}
        known = to_builtins(told_of(found, texts, words), enc_hook=as_text)
        return {"problems": [], "scene_wrong": False, "number": number, **known}

    def student(self, order: PageRequest) -> dict[str, Any]:
        """The sheets of one student, or why they cannot be drawn."""
        text, name = order.scene(), with_ending(order.text("name"))
        language, view = language_in(order), order.choice("view", VIEWS)
        wanted = WantedSheets(text, name, order.settings(), language, view, ("svg",))

        def drawn() -> dict[str, Any]:
            with self.drawing():
                sheets = sheets_of(self.folder, wanted)
            return {"sheets": [data.decode("utf-8") for data in sheets.values()]}

        return told(drawn, text, language, sheets=[])

    def motion(self, order: PageRequest) -> dict[str, Any]:
        """Where the page of a mechanism that moves is found: with curves, or step by step."""
        text, stem = order.scene(), stem_of(order.text("name"))
        language, kind = language_in(order), order.choice("page", MOVING)
        settings, driver = order.settings(), order.number("driver")
        drivers: list[str] = []

        def made() -> dict[str, Any]:
            mechanism = Mechanism(read_text(text, stem, None, settings))
            drivers.extend(map(driver_name, mechanism.scene.drivers))
            moved = driver if len(drivers) > 1 and 1 <= driver <= len(drivers) else None
            with self.drawing():
                page = MOVING_PAGES[kind](mechanism, stem, language, moved)
            key = new_token()
            self.moving[key] = page
            while len(self.moving) > TABS:
                self.moving.popitem(last=False)
            return {"page": f"moving/{key}", "drivers": drivers}

        return told(made, text, language, page="", drivers=drivers)

    def begin(self, order: PageRequest) -> dict[str, Any]:
        """A lab.toml to start from, for any scene; or why there can be none."""
        text, stem = order.scene(), stem_of(order.text("name"))

        def made() -> dict[str, Any]:
            return {"rules": rules_for(Mechanism(read_text(text, stem)))}

        return told(made, text, language_in(order), rules="")

    def write(self, order: PageRequest) -> dict[str, Any]:
        """The changes of a text that put the values of the sliders into it, or why they cannot."""
        text, settings = order.scene(), order.settings()

        def made() -> dict[str, Any]:
            return {"edits": to_builtins(edits(text, settings), enc_hook=as_text)}

        return told(made, text, language_in(order), edits=[])

    def picture(self, order: PageRequest) -> dict[str, Any]:
        """The sketch of a scene in the gallery; none of one that cannot be read."""
        kind = order.choice("kind", PICTURED)
        try:
            with self.drawing():
                opened = self.open(order.text("name"), kind)
                seen = sketch(opened.text, stem_of(opened.name), {})
        except GraphkinError:
            return {"sketch": None}
        return {"sketch": seen and to_builtins(seen, enc_hook=as_text)}

    def build(self, order: PageRequest) -> dict[str, Any]:
        """The text after an act of the hand, or why it is impossible."""
        of, places = order.names("of"), order.places()
        act = Act(
            order.choice("kind", tuple(KINDS)),
            of,
            order.place("at"),
            places,
            order.text("words"),
            order.place("speed").real,
        )
        if act.kind != "pivot" and not of:
            raise PageRequestError("of")
        text = order.scene()

        def done() -> dict[str, Any]:
            with self.drawing():
                after = built(text, act)
            stand = {name: [at.real, at.imag] for name, at in after.places.items()}
            return {"text": after.text, "places": stand}

        return told(done, text, language_in(order), text=text)

    def save(self, order: PageRequest) -> dict[str, Any]:
        """Save the text of a scene, whatever is wrong with it."""
        name, mark, replace = order.text("name"), order.text("mark"), order.flag("replace")
        text, whole = order.scene(), with_ending(name)
        written = order.long_text("rules")
        rules = OwnRules(written, order.text("rules_mark")) if written else None

        def saved() -> Saved:
            with self.writing:
                return save_scene(self.folder, whole, text, mark, replace=replace, rules=rules)

        return saving(saved, text, language_in(order))

    def sheets(self, order: PageRequest) -> dict[str, Any]:
        """Draw and save the sheets of a text."""
        wanted = WantedSheets(
            order.scene(),
            with_ending(order.text("name")),
            order.settings(),
            language_in(order),
            order.choice("view", VIEWS),
            order.choices("formats", FORMATS),
        )
        replace = order.flag("replace")

        def saved() -> Saved:
            with self.drawing():
                files = sheets_of(self.folder, wanted)
            with self.writing:
                return save_files(self.folder, files, replace=replace)

        return saving(saved, wanted.text, order.choice("page_language", LANGUAGES))


def saving(work: Callable[[], Saved], text: str, language: str) -> dict[str, Any]:
    """What was written, what is in the way, or why nothing was written."""
    nothing = to_builtins(Saved())
    return told(lambda: to_builtins(work(), enc_hook=as_text), text, language, **nothing)


def told(
    work: Callable[[], dict[str, Any]], scene: str, language: str, /, **instead: Any
) -> dict[str, Any]:
    """What comes of a piece of work, with no problems, or what is there instead, with why."""
    try:
        return {**work(), "problems": []}
    except GraphkinError as error:
        return {**instead, "problems": told_in(error.problems, scene, language)}


def language_of(text: str) -> str:
    """The language that a scene names for its sheets, as far as its text can be read."""
    try:
        sheet = tables_of(text).get("sheet")
    except SceneError:
        return ""
    return str(sheet.get("language", "en")) if isinstance(sheet, dict) else "en"
