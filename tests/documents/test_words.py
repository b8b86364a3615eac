"""The sentences: the same in every language, each of them used, none of them missing."""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from string import Formatter

import pytest
from click.testing import CliRunner

import graphkin
from graphkin.classroom.lab.fairness import WORDS as LIMITS
from graphkin.classroom.lab.lab_model import NAMES as CAUSES
from graphkin.cli.main import app
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import variant
from graphkin.construction.core.quantities import CENTRES, STROKE, OnPaper, in_mm
from graphkin.construction.registry import BOARD, PALETTE
from graphkin.construction.result_tables import WIDTHS
from graphkin.documents import VIEWS
from graphkin.documents.calculation import calculation
from graphkin.documents.centre_tables import centre_words, pole_words
from graphkin.documents.relations import travel_words
from graphkin.documents.sheet import Moved, asked_words
from graphkin.documents.sheet_documents import (
    CALCULATED,
    by_itself,
    drawings_of,
    drawn_sheets,
    proved,
    with_forces,
)
from graphkin.drawing.marks import Page, Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.cam_motions import MOTIONS
from graphkin.numbers.plane import Ratio
from graphkin.reading.desk_app import SAID
from graphkin.scene.read_scene import read_text
from graphkin.studio.session import MOVING
from graphkin.text import LANGUAGES, Words, flattened, untranslated, words
from graphkin.text.errors import PageError
from graphkin.web.your_turn import reasons
from tests.chosen import CHOSEN, FOLDER, SCENES
from tests.documents.centre_scenes import ASKING
from tests.documents.sheet_tools import (
    HEAD,
    KINDS,
    OTHERS,
    attempt,
    calculations,
    mechanism_named,
    named,
    texts,
)
from tests.mechanisms import SHIPPED
from tests.scene_files import scene_texts

CODE = Path(graphkin.__file__).parent
FORCES = Path(__file__).parents[1] / "scenes" / "forces"
MARKS = {language: "." if language == "en" else "," for language in LANGUAGES}
OTHER_LANGUAGES = [language for language in LANGUAGES if language != "en"]

RARE = scene_texts("documents/rare")
"""Scenes that use what the others do not."""


class Recording(Words):
    """Words that remember which keys were asked for."""

    def __call__(self, key: str, **fields: object) -> str:
        USED.add(key)
        return super().__call__(key, **fields)

    def has(self, key: str) -> bool:
        found = super().has(key)
        USED.update([key] * found)
        return found


USED: set[str] = set()


def every_page(mechanism: Mechanism, spoken: Words, views: Sequence[str] = ("key",)) -> list[Page]:
    """All pages of a mechanism in some views, and what its task asks; what does not fit is left
    out."""
    verdict = proved(mechanism, mechanism.solve())
    drawings = with_forces(mechanism, drawings_of(mechanism, verdict, spoken))
    pages: list[Page] = []
    for drawing in drawings:
        asked_words(drawing)
        travel_words(drawing)
    for view in views:
        made = [partial(calculation, drawings, view)]
        made += [partial(one_page, drawing, view) for drawing in drawings]
        for make in made:
            try:
                pages += make()
            except PageError as error:
                assert "does not fit" in str(error)
    return pages


def one_page(drawing: Drawing, view: str) -> list[Page]:
    """One sheet, of several pages where it grows or goes on."""
    if view in CALCULATED:
        return [page for sheet in drawn_sheets([drawing], view) for page in sheet.pages]
    return list(by_itself(drawing, view, "1/1"))


RARE |= ASKING
RARE |= {
    f"four-bar with {sheet}": f"[sheet]\n{sheet}\n" + OTHERS["four-bar-with-a-coupler-point"]
    for sheet in ("enlarge = 1.5", "ka = 0.4")
}
RARE["only a path is asked"] = (
    OTHERS["parallelogram"].partition("[ask]")[0]
    + """
[ask]
curves = ["B"]
"""
)


def rare(name: str) -> Mechanism:
    """A scene that uses what the others do not."""
    return Mechanism(read_text(HEAD.format(title=name) + RARE[name], name, None, {}))


def fields(sentence: str) -> set[str]:
    """The names of the gaps of a sentence."""
    return {name for _, name, _, _ in Formatter().parse(sentence) if name is not None}


def literals() -> set[str]:
    """Every string that stands in the code by itself, and those that a template puts together."""
    pages = [*CODE.rglob("*.html"), *(CODE / "studio").rglob("*.js")]
    text = "\n".join(path.read_text(encoding="utf-8") for path in pages)
    quoted = set(re.findall(r'"([\w. -]+)"', text))
    begun = [each for each in quoted if each.endswith((".", "_"))]
    begun += re.findall(r"`([\w.]+)\$\{", text)
    found = quoted | {first + last for first in begun for last in quoted}
    for path in CODE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.add(node.value)
    return found


def palette_keys() -> set[str]:
    """The keys of the actions of the palette, of what they start from, and of what is wrong."""
    every = PALETTE | BOARD
    slots = {f"turn.slot.{name}" for own in every.values() for name, _ in own.free or own.slots}
    actions = {f"turn.action.{action}" for action in every} | {f"turn.ask.{key}" for key in PALETTE}
    return slots | actions | {key for each in PALETTE for key in reasons(each, words("en"))}


def spoken_keys() -> set[str]:
    """Every string that stands in the code of the pages as the key of words(...)."""
    found = set()
    rooms = (CODE / room for room in ("drawing", "construction", "documents"))
    for path in (path for room in rooms for path in room.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        found |= set(re.findall(r'\bwords\(\s*"([^"{}]+)"', text))
    return found - set(LANGUAGES)


@pytest.mark.parametrize("language", OTHER_LANGUAGES)
def test_these_languages_have_every_sentence(language):
    assert not untranslated(language)


@pytest.mark.parametrize("language", OTHER_LANGUAGES)
def test_no_language_has_a_sentence_that_is_not_asked_for(language):
    assert words(language).sentences.keys() <= words("en").sentences.keys()


def test_a_sentence_that_a_language_lacks_is_the_english_one_and_is_listed(monkeypatch):
    german = words("de")
    lacking = {key: german.sentences[key] for key in ("class.title", "desk.open")}
    for key in lacking:
        monkeypatch.delitem(german.sentences, key)
        assert german.open(key) == words("en").open(key)
        assert german.has(key)
    assert not german.has("page.no such sentence")
    with pytest.raises(KeyError):
        german("page.no such sentence")
    listed = CliRunner().invoke(app, ["words", "de", "--missing"])
    assert dict(flattened(tomllib.loads(listed.output))) == untranslated("de")
    assert untranslated("de").keys() == lacking.keys()


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_apostrophe_is_the_typographic_one(language):
    assert not {key for key, said in words(language).sentences.items() if "'" in said}


def test_titles_and_notes_of_shipped_scenes_have_the_typographic_apostrophe():
    for name in (*SCENES, *SHIPPED):
        scene = mechanism_named(name, 7 if name in SHIPPED else None).scene
        said = [scene.title, *scene.titles.values(), *scene.notes.values()]
        assert "'" not in " ".join(said), name


@pytest.mark.parametrize("language", OTHER_LANGUAGES)
def test_every_sentence_has_the_same_gaps_in_every_language(language):
    english, others = words("en").sentences, words(language).sentences
    differing = [key for key in others if fields(english[key]) != fields(others[key])]
    assert not differing


@pytest.mark.parametrize("language", OTHER_LANGUAGES)
def test_no_sentence_is_left_in_english(language):
    english, others = words("en").sentences, words(language).sentences
    same = {key for key in others if english[key] == others[key]}
    long = {key for key in same if re.search(r"[a-z]{4,}", re.sub(r"\{.*?\}", "", english[key]))}
    assert long <= {
        "class.percent_axis",
        "desk.point",
        "desk.points",
        "page.constant",
        "page.guide_of",
        "page.axis_guide",
        "positions.number",
        "curves.point",
        "curves.positions",
        "curves.forces",
        "studio.angle",
        "sheet.positions_view",
        "calculation.structure",
        "feedback.earned",
        "form.points",
        "screen.centre",
        "screen.pause",
        "screen.position",
        "table.segment",
        "turn.action.perpendicular",
        "turn.palette",
        "turn.slot.angle",
        "turn.slot.image",
        "turn.slot.point",
        "turn.slot.vector",
        "calculation.vector_mark",
        "desk.verdict",
        "studio.student",
        "studio.limit_segment",
    }


def test_the_german_word_of_a_side_is_followed_by_what_it_governs():
    """It ends with its preposition, so that no "davon" can follow: "links von davon"."""
    spoken = words("de")
    sides = [spoken(f"page.{side}") for side in ("left", "right", "above", "below")]
    for key in ("page.guide_beside", "page.slot_beside"):
        for side in sides:
            gaps = dict.fromkeys(("point", "line", "offset", "way", "positive"), "")
            assert f"{side} dieser Geraden" in spoken(key, side=side, **gaps)


def test_the_german_pressure_angle_of_a_cam_is_not_that_of_teeth():
    spoken = words("de")
    gaps = dict.fromkeys(("most", "u", "at", "limit", "k", "g"), "")
    for key in ("cam_caption", "pressure_kept", "pressure_beyond"):
        said = spoken(f"diagrams.{key}", **gaps)
        assert "Pressungswinkel" in said and "Eingriff" not in said


def test_every_key_in_the_code_has_a_sentence():
    assert len(spoken_keys()) > 20
    assert spoken_keys() <= words("en").sentences.keys()


TELLING = (
    *("crank-slot", "roller with its inflection circle", "instant-centres", "belts-arm"),
    *("only a path is asked", "gears-kutzbach", "centrodes-roller"),
    *("block on a lever with its centre", "slider-crank-at-its-dead-point-set-in-motion"),
    *("cam-knife", "flat-plate-poles", "gears with their centre", "parallelogram"),
    *("excavator-relative", "four-bar at rest with all its centres", "plank-axle"),
    *("parallelogram with all its centres", "mobility-cam", "cam-plate-lever"),
    *("inflection-cardan", "lever-with-its-block-behind-its-pivot", "cam-flat"),
    *("block-closes-class-iii", "five-bar with all its centres", "klein-engine"),
    *("four-bar with more of each", "belts-crossed", "slider-crank-at-rest-guide-below"),
    *("too-short-to-be-drawn", "slider-crank-at-its-dead-point", "bar-on-drum", "platform-3rpr"),
    *("stephenson-2-ternary", "cam-plate", "four-bar with all its centres"),
    *("pinion-driven-by-a-rack", "cam-rocker", "roller-plates", "trammel with all its centres"),
    *("coupler point with its centre of curvature", "slider-crank with centres of curvature"),
    *("strokes-of-lever-and-ram", "stroke-of-a-ram"),
)
"""Scenes that say all that any says but for plates-ring; all others come after them."""


RARELY_SAID = {
    *(f"page.belt{kind}" for kind in ("_alike", "_fixed", "_fixed_alike", "_crossed_fixed")),
    *("page.slot", "page.slot_beside", "step.trial-2-near", "step.trial-in-2-near"),
    *(f"step.trial-in-{number}-on" for number in (1, 2)),
    *("ask.strokes_many", "ask.swings_many"),
}
"""Put together of what they say: of wheels, pins in slots and plans that few scenes have."""


def test_every_sentence_is_used():
    USED.clear()
    spoken = Recording("en")
    every_page(mechanism_named(SHIPPED[0], 7), spoken, ("key", "task", "steps", "overlay"))
    for name in ("ram", "roller", "gears", "shaper", "belt-on-arm"):
        every_page(load(FORCES / f"{name}.toml"), spoken)
    waiting = (
        words("en").sentences.keys()
        - literals()
        - {f"{t}.{n}" for t in ("cause", "shows") for n in CAUSES}
        - palette_keys()
    )
    waiting -= {f"page.{each.value}" for each in Moved} | {f"desk.{key}" for key in SAID}
    waiting -= {f"page.motion_{name.replace(' ', '_')}" for name in MOTIONS}
    waiting -= {f"studio.limit_{limit}" for limit in LIMITS} | {f"studio.{view}" for view in VIEWS}
    waiting -= {f"screen.{kind}" for kind in WIDTHS}
    waiting -= {f"animation.{kind}" for kind in ("dead", "change")}
    waiting -= {f"legend.{each.target}" for each in CENTRES}
    waiting -= {f"sheet.{STROKE.kind}"} | {f"studio.page_{page}" for page in MOVING}
    waiting -= {key for key in waiting if key.startswith("curves.")}  # tests/motion draws them
    assert waiting >= RARELY_SAID
    waiting -= RARELY_SAID
    for name in dict.fromkeys((*TELLING, "plates-ring", *RARE, *OTHERS, *CHOSEN)):
        if waiting <= USED:
            break
        every_page(rare(name) if name in RARE else mechanism_named(name), spoken)
    assert waiting <= USED, " ".join(sorted(waiting - USED))


PAGES = [(lab, n, language) for lab in SHIPPED for n in (7,) for language in LANGUAGES]


@pytest.fixture(params=PAGES, ids=named)
def spoken(request) -> tuple[str, list[Text]]:
    name, n, language = request.param
    pages: list[Page] = []
    for view in ("key", "task"):
        tried = [attempt(name, n, kind, view, language)[1] for kind in KINDS]
        pages += [page for page in tried if isinstance(page, Page)]
        pages += calculations(name, n, view, language)
    return language, texts(pages)


def test_no_gap_is_left_open(spoken):
    _, found = spoken
    assert not [mark.markup for mark in found if re.search(r"[{}]|None|nan\b", plain(mark.markup))]


def test_decimals_are_written_in_the_language_of_the_page(spoken):
    language, found = spoken
    wrong = ({".", ","} - {MARKS[language]}).pop()
    both = [mark.markup for mark in found if re.search(rf"\d{re.escape(wrong)}\d", mark.markup)]
    assert not both
    right = [m for m in found if re.search(rf"\d{re.escape(MARKS[language])}\d", m.markup)]
    assert len(right) > 10


def test_a_true_minus_stands_before_negative_numbers(spoken):
    _, found = spoken
    assert not [m.markup for m in found if re.search(r"(?:^|[\s(;])-\d", m.markup)]


def test_every_text_says_something(spoken):
    _, found = spoken
    assert not [mark for mark in found if not plain(mark.markup).strip()]


@pytest.mark.parametrize("language", LANGUAGES)
def test_zero_is_printed_as_0_and_rounding_never(language):
    spoken = words(language)
    for number in (0.0, -0.0, 4e-16, -1e-17, 0.004):
        assert spoken.fixed(number, 2) == "0"
    assert spoken.fixed(-0.006, 2) == f"−0{spoken.sentences['decimal_mark']}01"
    assert in_mm(spoken, OnPaper(3e-14)) == "0"
    assert in_mm(spoken, OnPaper(0.001)).startswith("<")


@pytest.mark.parametrize("slip", [6e-17, -6e-17, 0.0])
def test_a_direction_is_told_without_its_rounding(slip):
    """Along the x axis it is 0°, neither 3.86018e-15° nor 180°."""
    parallel = Ratio(0j, complex(1.0, slip), 0.0)
    assert centre_words(parallel, 1.0) == "at infinity, in direction 0°"


def test_a_pole_is_told_without_its_rounding():
    """Rounding errors of a mechanism one metre broad are zeros, and not a place beside O."""
    turning = Ratio(0j, complex(-3e-18, 3e-17), 1.0)
    assert centre_words(turning, 1.0) == pole_words(turning, 1j, 1.0) == "(0, 0)"
    assert centre_words(turning, 1e-16) == "(-3.00000e-18, 3.00000e-17)"


def test_a_parameter_called_as_its_unit_is_told_without_it():
    """No sheet says rpm = 50 rev/min."""
    text = (FOLDER / "crank-rocker.toml").read_text(encoding="utf-8")
    text = text.replace("[parameters]", "[parameters]\nrpm = { value = 50, min = 10, max = 90 }")
    text = text.replace("speed = 10", 'speed = "rpm + 10"').replace('"rad/s"', '"rev/min"')
    assert "*rpm* = 50" in variant(read_text(text, "r", None, {}), words("en"))
