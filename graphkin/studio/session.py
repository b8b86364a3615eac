"""The state of the studio while it runs, and its work for the page: one drawing at a time."""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import unified_diff
from fractions import Fraction
from functools import partial
from hashlib import sha256
from pathlib import Path
from threading import Condition, Lock
from typing import Annotated, Any, TypeVar

from msgspec import Meta, MsgspecError, Struct, json, to_builtins

from graphkin.classroom.lab.lab_model import exact_text
from graphkin.classroom.lab.new_lab import START, rules_for
from graphkin.classroom.sheet_files import hand_out_page, sheet_files
from graphkin.construction.core.quantities import SHEETS
from graphkin.documents import MOTION_VIEWS, VIEWS
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.scene.expression import TIME
from graphkin.scene.file_limits import LARGEST, decoded, read_bytes, tables_of, whole_file
from graphkin.scene.findings import Findings
from graphkin.scene.house import HOUSE, house_beside
from graphkin.scene.model import Scene
from graphkin.scene.parameters import of_setting, plain, rational
from graphkin.scene.quantity import shortest
from graphkin.scene.read_scene import read_text
from graphkin.scene.toml_spans import values
from graphkin.structure.driver_count import driver_name
from graphkin.studio.building import KINDS, Act, built
from graphkin.studio.folder import (
    ENDING,
    MOST,
    SCENE,
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
from graphkin.studio.look import Sight, look, problem_records, spoken_in
from graphkin.studio.mends import Edit, units
from graphkin.studio.panels import (
    LabProblems,
    LabTexts,
    Memory,
    StaleError,
    beside,
    lab_advice,
    lab_report,
    proposal_of,
    trial_of,
)
from graphkin.studio.sketch import sketch
from graphkin.text import LANGUAGES, Words, as_text, words
from graphkin.text.errors import GraphkinError, SceneError
from graphkin.writers.files import file_stem, write_all

PAGE = "html"
FORMATS = ("svg", "pdf", PAGE, "dxf", "pmks")
MOST_LINES = 12
"""Number of lines shown of the changes to an existing file."""


class Saved(Struct, frozen=True):
    """The result of saving: the names of the files written, or of existing files in the way.

    ``mark`` identifies the content of the written scene, ``rules_mark`` the content of its
    lab.toml. ``changes`` are the lines in which existing texts differ from those to be saved, as
    `difflib` writes them.
    """

    files: tuple[str, ...] = ()
    exist: tuple[str, ...] = ()
    mark: str = ""
    rules_mark: str = ""
    changes: tuple[str, ...] = ()


class OwnRules(Struct, frozen=True):
    """The text of a lab.toml, and the mark of the content that the page last read or saved."""

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
    """Write the text of a scene, and its lab.toml if given: both or neither.

    Existing files are kept unless ``replace`` is set. ``mark`` identifies the content that the page
    last read or saved under this name; a file that still holds it is replaced without asking.
    Raises SceneError for a name outside the folder, or of a scene that can have no lab.toml, and
    PageError where nothing can be written.
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
    """The first lines that saving a text would remove from a file (-) and add to it (+).

    Empty for a file that cannot be read.
    """
    try:
        before = decoded(read_bytes(path))
    except SceneError:
        return ()
    lines = list(unified_diff(before.splitlines(), text.splitlines(), lineterm="", n=0))[2:]
    return (*lines[:MOST_LINES], *(("…",) if len(lines) > MOST_LINES else ()))


def mark_of(data: bytes) -> str:
    """The hash that identifies the content of a file."""
    return sha256(data).hexdigest()


def mark_of_file(path: Path) -> str:
    """The hash of a file's content; empty for a file that cannot be read."""
    try:
        return mark_of(whole_file(path))
    except OSError:
        return ""


class WantedSheets(Struct, frozen=True):
    """The sheets to draw: text, name, values, language, view and formats."""

    text: str
    name: str
    settings: Mapping[str, str]
    language: str
    view: str
    formats: Sequence[str]


def sheets_of(folder: Folder, wanted: WantedSheets) -> dict[str, bytes]:
    """The files of a scene's sheets by name, as ``graphkin sheet`` writes and names them.

    Every parameter is set. Raises the errors of reading a scene and of hand_out.
    """
    name, settings, view, formats = wanted.name, wanted.settings, wanted.view, wanted.formats
    text, language = wanted.text, wanted.language
    house = house_beside(folder.root / HOUSE)
    mechanism = Mechanism(read_text(text, stem_of(name), None, settings, house))
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
    """The lab whose form belongs to a scene: its own folder, or an unchanged lab of graphkin.

    Without such a lab, the name of the scene's file.
    """
    if name.rpartition("/")[2] == SCENE:
        return str(folder.path(name).parent)
    lab = stem_of(name)
    return lab if lab in scene_files.names() and text == shipped_text(lab) else name


def save_files(folder: Folder, files: Mapping[str, bytes], *, replace: bool) -> Saved:
    """Write files, all or none; existing files are kept unless ``replace`` is set."""
    exist = tuple(name for name in files if os.path.lexists(folder.root / name))
    if exist and not replace:
        return Saved(exist=exist)
    write_all(folder.root, files, force=True)
    return Saved(files=tuple(files))


# --- the values of sliders put into the text of a scene, where it states its parameters -----------


LONGEST = 100
"""Largest number of characters of a written value."""


def edits(text: str, settings: Mapping[str, str]) -> list[Edit]:
    """The edits that give the parameters these values; the last place comes first.

    A value that the text already states needs no edit. Raises SceneError for a value that is no
    number.
    """
    known = values(text)
    found = []
    for name, value in settings.items():
        path = ("parameters", name)
        span = known.get((*path, "value")) or known.get(path)
        if span is None:
            continue
        before, after = text[slice(*span)], literal(name, value)
        if not same(before, after):
            start, end = (units(text[:at]) for at in span)
            found.append(Edit(start, end, after, name, before))
    return sorted(found, key=lambda edit: -edit.start)


def literal(name: str, value: str) -> str:
    """A value as TOML: a number if a decimal is exact, else a fraction in quotes.

    Raises SceneError for a value that is not a rational number.
    """
    findings = Findings()
    number = number_of(value, findings)
    if number is None:
        raise SceneError(of_setting(name, findings.problems))
    decimal = shortest(number)
    if Fraction(decimal) == number and "e" not in decimal:
        return decimal
    return f'"{number.numerator}/{number.denominator}"'


def same(before: str, after: str) -> bool:
    """Whether two TOML values are the same number."""
    one, other = (number_of(value.strip("\"'"), Findings()) for value in (before, after))
    return one is not None and one == other


def number_of(value: str, findings: Findings) -> Fraction | None:
    """The exact number of a text; None, with a problem recorded, if it is no number."""
    read = rational("", value[:LONGEST], findings)
    return None if read is None else plain(read)


# --- the pages of a moving mechanism --------------------------------------------------------------


MovingPage = Callable[[Mechanism, str, str, int | None], str]
"""A page of a moving mechanism, from the stem of its files, its language and the moved driver."""


def with_curves(mechanism: Mechanism, stem: str, language: str, driver: int | None) -> str:
    """The page of a cycle, with one driver moving or all drivers moving with the time."""
    from graphkin.motion.cycle import cycle
    from graphkin.web.frames import motion
    from graphkin.web.player import player_page

    spoken = spoken_in(language)
    return player_page(motion(cycle(mechanism, driver=driver), spoken), spoken)


def step_by_step(mechanism: Mechanism, stem: str, language: str, driver: int | None) -> str:
    """The step page, in which each driver's pins can be dragged by a handle."""
    return hand_out_page(mechanism, stem, stem, language=language)


def all_sheets(
    view: str, mechanism: Mechanism, stem: str, language: str, driver: int | None
) -> str:
    """The page of all sheets of a view of the whole motion."""
    return hand_out_page(mechanism, stem, stem, view, language)


MOVING_PAGES: Mapping[str, MovingPage] = {
    "curves": with_curves,
    "steps": step_by_step,
    **{view: partial(all_sheets, view) for view in MOTION_VIEWS},
}
MOVING = tuple(MOVING_PAGES)


# --- the requests of the page: every field must have its kind and size ----------------------------


MOST_BYTES = 4 * LARGEST
"""Largest number of bytes of a request.

It is the size of the largest scene with every character escaped, except the rarest characters.
"""
FARTHEST = 1e9
"""Largest distance of a point."""


class PageRequestError(Exception):
    """A request that the page does not make."""


def one_of(known: Iterable[str]) -> Meta:
    """The texts of a field that holds one of some words."""
    return Meta(pattern=rf"\A(?:{'|'.join(known)})\Z")


Name = Annotated[str, Meta(max_length=300)]
"""A name, a mark, or a few words."""
Said = Annotated[str, Meta(min_length=1, max_length=300)]
"""A name that is not empty."""
LongText = Annotated[str, Meta(max_length=MOST_BYTES)]
"""A text as long as a scene may be; the reader of scenes refuses one that is too large."""
Count = Annotated[int, Meta(ge=0, lt=2**53)]
Coordinate = Annotated[float, Meta(ge=-FARTHEST, le=FARTHEST)]
Place = tuple[Coordinate, Coordinate]
SliderValue = Annotated[str, Meta(min_length=1, max_length=100)]
"""The value of a slider."""


class PageRequest(Struct, frozen=True):
    """What the page asks, with the kind and size of each field; it leaves out what is not needed.

    ``tab`` and ``number`` tell the requests of open pages apart. ``places`` are those of points.
    """

    tab: Name = ""
    number: Count = 0
    text: LongText = ""
    name: Name = ""
    rules: LongText = ""
    mark: Name = ""
    rules_mark: Name = ""
    replace: bool = False
    language: Annotated[str, one_of(LANGUAGES)] = LANGUAGES[0]
    page_language: Annotated[str, one_of(LANGUAGES)] = LANGUAGES[0]
    settings: Annotated[dict[str, SliderValue], Meta(max_length=200)] = {}
    mechanism: Annotated[str, one_of(SHEETS)] = SHEETS[0]
    quick: bool = False
    building: bool = False
    places: Annotated[dict[Name, Place], Meta(max_length=500)] = {}
    kind: Name = ""
    of: Annotated[tuple[Said, ...], Meta(max_length=2)] = ()
    at: Place = (0.0, 0.0)
    speed: Place = (0.0, 0.0)
    words: Name = ""
    exact: bool = False
    view: Annotated[str, one_of(VIEWS)] = VIEWS[0]
    formats: tuple[Annotated[str, one_of(FORMATS)], ...] = ()
    page: Annotated[str, one_of(MOVING)] = MOVING[0]
    driver: Count = 0
    line: Count = 0
    column: Count = 0
    file: LongText = ""
    pasted: LongText = ""
    fixed: Name = ""
    drive: Name = ""
    slides: Name = ""


Request = TypeVar("Request")


def requested(data: bytes, kind: type[Request]) -> Request:
    """A request of a page on this computer. Raises PageRequestError for anything else."""
    try:
        return json.decode(data, type=kind)
    except (MsgspecError, UnicodeDecodeError, RecursionError) as error:
        raise PageRequestError(str(error)) from None


# --- the state of the studio while it runs --------------------------------------------------------


OPENED = ("lab", "example", "like", "empty", "scene")
"""The keys with which an address may open something."""
PICTURED = ("scene", "lab", "example")
"""The kinds of entries with a picture in the gallery."""
TABS = 8
"""Number of pages whose last drawing is remembered."""
EMPTY = """graphkin = 1
title = "New mechanism"
units = { length = "mm", angle = "deg", speed = "rev/min" }
"""
"""A scene in which nothing is built yet."""
FIRST = "graphkin ="
"""The start of the first line of a scene."""


class Opened(Struct, frozen=True):
    """A text to open, and the name of the file in which it would be saved.

    ``mark`` identifies the content of that file; it is empty for a text that is in no file here.
    ``rules`` is the text of the lab.toml that belongs to it, ``rules_mark`` its mark. ``gone`` says
    that the file does not exist here, whatever a browser may have stored of it.
    """

    name: str
    text: str
    mark: str = ""
    rules: str = ""
    rules_mark: str = ""
    gone: bool = False


class Session:
    """The folder, the language of the page, and the last state of each open page.

    Only one thread draws at a time: fonts and caches are shared, and a newer move of a slider makes
    an older one obsolete. Texts are saved without waiting for a drawing.
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
        """The words of the page: as chosen, else those of the scene's language."""
        return spoken_in(chosen or self.language or language_of(text))

    def address_of(self, name: str) -> dict[str, str]:
        """The query that opens a lab of graphkin, or a scene of the folder by its path.

        For a lab, the query opens its rules as well. Raises SceneError for a name that is neither,
        or outside the folder.
        """
        if not name:
            return {}
        lab = {"rules": "yes"} if scene_files.folder(name) else {}
        if name in scene_files.names() and not Path(name).exists():
            return {"lab": name, **lab}
        return {"scene": self.folder.name_of(Path(scene_files.find(name))), **lab}

    def open(self, name: str, kind: str) -> Opened:
        """The text to open, by its kind.

        It is a scene here, a copy of one under another name, a scene of graphkin, an empty scene,
        or by default a first scene. Raises SceneError for an unknown name.
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
        """The scenes that can be opened: those in the folder, and those of graphkin."""
        scenes = self.folder.scenes()
        more = len(scenes) - MOST
        return {
            "scenes": scenes[:MOST],
            "more": words(language)("studio.more_scenes", count=more) if more > 0 else "",
            "labs": shipped(language),
            "examples": examples(language),
        }

    def bring(self, order: PageRequest) -> dict[str, Any]:
        """A file, link or text of another program as the text of a scene."""
        from graphkin.studio.folder import Brought, asks_more, brought, tracing_of

        language = order.language
        tracing = tracing_of(order.fixed, order.drive, order.slides)
        given = Brought(order.file, order.name, order.pasted, tracing)
        found = or_problems(
            lambda: brought(given, language), "", language, text="", name="", notes=[]
        )
        return found | {"drawing": bool(found["problems"]) and asks_more(given)}

    def explain(self, order: PageRequest) -> dict[str, Any]:
        """The address of what the manual says about the key at a place of a text."""
        from graphkin.manual.pages import address_at

        line, column = order.line, order.column
        return {"address": f"manual/{address_at(order.text, line, column)}"}

    def look(self, order: PageRequest) -> dict[str, Any]:
        """The view of a text, or only that it is stale if a newer view has been requested."""
        tab, number = order.tab, order.number
        sight = Sight(
            order.text,
            stem_of(order.name),
            order.language,
            order.settings,
            order.mechanism,
            order.quick,
            str(self.folder.root),
        )
        there = {"there": self.folder.holds(order.name)}
        self.arrived(tab, number)
        try:
            with self.drawing(lambda: self.still_wanted(tab, number)):
                found = there | look(
                    sight, self.memory(tab), lambda: self.still_wanted(tab, number)
                )
                if order.building:
                    places = {name: complex(*at) for name, at in order.places.items()}
                    seen = sketch(sight.text, sight.name, places, sight.settings)
                    found["sketch"] = seen and to_builtins(seen, enc_hook=as_text)
        except StaleError:
            found = {"stale": True}
        return found | {"number": number}

    @contextmanager
    def drawing(self, go_on: Callable[[], None] = lambda: None) -> Iterator[None]:
        """Wait for other drawings to finish; ``go_on`` is called meanwhile and may raise."""

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
        """Record the newest request of a page; pages silent for long are forgotten."""
        with self.turns:
            self.newest[tab] = max(number, self.newest.get(tab, 0))
            self.newest.move_to_end(tab)
            while len(self.newest) > TABS:
                gone, _ = self.newest.popitem(last=False)
                self.memories.pop(gone, None)
            self.turns.notify_all()

    def still_wanted(self, tab: str, number: int) -> None:
        """Raise StaleError if a page has made a newer request."""
        if self.newest.get(tab, number) > number:
            raise StaleError

    def memory(self, tab: str) -> Memory:
        """The last state of a page."""
        return self.memories.setdefault(tab, Memory())

    def variants(self, order: PageRequest) -> dict[str, Any]:
        """A lab tried on a thousand variants and a class of thirty."""
        return self.of_lab(order, trial_of, lambda found, _, words: lab_report(found, words))

    def ranges(self, order: PageRequest) -> dict[str, Any]:
        """The ranges in which a lab is fair, and a correction of its formula."""
        return self.of_lab(order, proposal_of, lab_advice)

    def of_lab(
        self,
        order: PageRequest,
        work: Callable[[LabTexts], Any],
        made_record: Callable[[Any, LabTexts, Words], Struct],
    ) -> dict[str, Any]:
        """The result of work on a lab's texts in a separate process, as a record for the page."""
        tab, number = f"{order.tab} lab", order.number
        texts = LabTexts(order.text, order.rules, stem_of(order.name))
        words = spoken_in(order.language)
        self.arrived(tab, number)
        try:
            found = beside(work, texts, lambda: self.still_wanted(tab, number))
        except StaleError:
            return {"stale": True, "number": number}
        if isinstance(found, LabProblems):
            wrong = problem_records(found.rules, texts.rules, words.language)
            return {"problems": wrong, "scene_wrong": bool(found.scene), "number": number}
        known = to_builtins(made_record(found, texts, words), enc_hook=as_text)
        return {"problems": [], "scene_wrong": False, "number": number, **known}

    def student(self, order: PageRequest) -> dict[str, Any]:
        """The sheets of one student, or why they cannot be drawn."""
        text, name = order.text, with_ending(order.name)
        language, view = order.language, order.view
        wanted = WantedSheets(text, name, order.settings, language, view, ("svg",))

        def drawn() -> dict[str, Any]:
            with self.drawing():
                sheets = sheets_of(self.folder, wanted)
            return {"sheets": [data.decode("utf-8") for data in sheets.values()]}

        return or_problems(drawn, text, language, sheets=[])

    def motion(self, order: PageRequest) -> dict[str, Any]:
        """The address of a page of the motion: with curves, step by step, or of all sheets."""
        text, stem = order.text, stem_of(order.name)
        language, kind = order.language, order.page
        settings, driver = order.settings, order.driver
        drivers: list[str] = []

        def made() -> dict[str, Any]:
            house = house_beside(self.folder.root / HOUSE)
            mechanism = Mechanism(read_text(text, stem, None, settings, house))
            drivers.extend(map(driver_name, mechanism.scene.drivers))
            moved = driver if len(drivers) > 1 and 1 <= driver <= len(drivers) else None
            with self.drawing():
                page = MOVING_PAGES[kind](mechanism, stem, language, moved)
            key = new_token()
            self.moving[key] = page
            while len(self.moving) > TABS:
                self.moving.popitem(last=False)
            return {"page": f"moving/{key}", "drivers": drivers}

        return or_problems(made, text, language, page="", drivers=drivers)

    def begin(self, order: PageRequest) -> dict[str, Any]:
        """A first lab.toml for any scene, or why there can be none."""
        text, stem = order.text, stem_of(order.name)

        def made() -> dict[str, Any]:
            return {"rules": rules_for(Mechanism(read_text(text, stem)))}

        return or_problems(made, text, order.language, rules="")

    def write(self, order: PageRequest) -> dict[str, Any]:
        """The edits that put the values of the sliders into a text, or why there are none."""
        text, settings = order.text, order.settings

        def made() -> dict[str, Any]:
            return {"edits": to_builtins(edits(text, settings), enc_hook=as_text)}

        return or_problems(made, text, order.language, edits=[])

    def picture(self, order: PageRequest) -> dict[str, Any]:
        """The sketch of a scene in the gallery; none for an unreadable scene."""
        if order.kind not in PICTURED:
            raise PageRequestError("kind")
        try:
            with self.drawing():
                opened = self.open(order.name, order.kind)
                seen = sketch(opened.text, stem_of(opened.name), {})
        except GraphkinError:
            return {"sketch": None}
        return {"sketch": seen and to_builtins(seen, enc_hook=as_text)}

    def build(self, order: PageRequest) -> dict[str, Any]:
        """The text after an action of building, or why the action is impossible."""
        if order.kind not in KINDS or (order.kind != "pivot" and not order.of):
            raise PageRequestError("kind")
        places = {name: complex(*at) for name, at in order.places.items()}
        at, speed = complex(*order.at), order.speed[0]
        act = Act(order.kind, order.of, at, places, order.words, speed, order.exact)
        text = order.text

        def done() -> dict[str, Any]:
            with self.drawing():
                after = built(text, act)
            stand = {name: [at.real, at.imag] for name, at in after.places.items()}
            return {"text": after.text, "places": stand}

        return or_problems(done, text, order.language, text=text)

    def save(self, order: PageRequest) -> dict[str, Any]:
        """Save the text of a scene, whatever its mistakes."""
        name, mark, replace = order.name, order.mark, order.replace
        text, whole = order.text, with_ending(name)
        written = order.rules
        rules = OwnRules(written, order.rules_mark) if written else None

        def saved() -> Saved:
            with self.writing:
                return save_scene(self.folder, whole, text, mark, replace=replace, rules=rules)

        return saving(saved, text, order.language)

    def sheets(self, order: PageRequest) -> dict[str, Any]:
        """Draw and save the sheets of a text."""
        if not order.formats:
            raise PageRequestError("formats")
        wanted = WantedSheets(
            order.text,
            with_ending(order.name),
            order.settings,
            order.language,
            order.view,
            [each for each in FORMATS if each in order.formats],
        )
        replace = order.replace

        def saved() -> Saved:
            with self.drawing():
                files = sheets_of(self.folder, wanted)
            with self.writing:
                return save_files(self.folder, files, replace=replace)

        return saving(saved, wanted.text, order.page_language)


def saving(work: Callable[[], Saved], text: str, language: str) -> dict[str, Any]:
    """The written files, the existing files in the way, or why nothing was written."""
    nothing = to_builtins(Saved())
    return or_problems(lambda: to_builtins(work(), enc_hook=as_text), text, language, **nothing)


def or_problems(
    work: Callable[[], dict[str, Any]], scene: str, language: str, /, **instead: Any
) -> dict[str, Any]:
    """The result of a piece of work without problems, or ``instead`` with the problems."""
    try:
        return {**work(), "problems": []}
    except GraphkinError as error:
        return {**instead, "problems": problem_records(error.problems, scene, language)}


def language_of(text: str) -> str:
    """The language that a scene names for its sheets, as far as its text can be read."""
    try:
        sheet = tables_of(text).get("sheet")
    except SceneError:
        return ""
    return str(sheet.get("language", "en")) if isinstance(sheet, dict) else "en"
