"""The sentences: the same in every language, each of them used, none of them missing."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from string import Formatter

import pytest

import graphkin
from graphkin.classroom.grading.feedback_rows import SLIPS
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.calculation import calculation
from graphkin.documents.sheet_documents import drawings_of, drawn, proved
from graphkin.drawing.marks import Page, Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, Words, words
from graphkin.text.errors import PageError
from tests.chosen import SCENES
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

CODE = Path(graphkin.__file__).parent
MARKS = {"en": ".", "ro": ",", "it": ","}
OTHER_LANGUAGES = [language for language in LANGUAGES if language != "en"]

RARE = {
    "a block that swings on the frame closes a group of class III": """
[frame]
O1 = [0, 0]
O2 = [220, 60]
[links.1]
O1-A = 69
O1-B = 67
A-B = 93
B = "right of O1-A"
[links.2]
A-C = 119
[links.3]
B-D = 93
[links.4]
C-D = 112
[links.5]
O2 = [0, 0]
slides = { on = 4, along = "C-D" }
[[drivers]]
turn = 1
angle = 102
speed = 5
[branches]
2 = "closure 1"
[ask]
velocity = ["C", "D"]
acceleration = ["C", "D"]
omega = [4]
epsilon = [4]
""",
    "slider-crank at its dead point": """
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 200
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[[drivers]]
turn = 1
angle = 0
speed = 30
acceleration = 0
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
centres = [2]
poles = [2]
""",
    "slider-crank at its dead point, set in motion": """
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 200
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[[drivers]]
turn = 1
angle = 0
speed = 0
acceleration = 40
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
centres = [2]
poles = [2]
""",
    "slider-crank at rest, guide below": """
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 200
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 0, offset = -20 }
[[drivers]]
turn = 1
angle = 50
speed = 0
acceleration = 0
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
centres = [2]
poles = [2]
""",
    "pinion driven by a rack": """
[frame]
O = [0, 0]
[links.1]
R = [0, 0]
slides = { on = 0, through = [0, -60], angle = 0 }
[links.2]
O-A = 45
wheel = { centre = "O", teeth = 30, module = 4 }
rolls = { on = 1, through = "R", angle = 0 }
[[drivers]]
slide = 1
position = 30
speed = 200
[ask]
velocity = ["A"]
acceleration = ["A"]
omega = [2]
""",
    "frame point given by distance and angle": """
[frame]
O1 = [0, 0]
O2 = { from = "O1", length = 250, angle = 10 }
[links.1]
O1-A = 80
[links.2]
A-B = 230
A-E = 60
E = "beyond A on A-B"
[links.3]
O2-B = 160
B-O2-F = 40
O2-F = 90
[[drivers]]
turn = 1
angle = 65
speed = 12
[branches]
B = "left of A-O2"
[ask]
velocity = ["E", "F"]
acceleration = ["E"]
omega = [2, 3]
epsilon = [2, 3]
centres = [3]
""",
    "block with a second point, two cranks": """
[frame]
O1 = [0, 0]
O2 = [250, 0]
[links.1]
O1-A = 80
[links.2]
O2-E = 70
[links.3]
A-B = 150
[links.4]
E-B = 160
[links.5]
B-C = 150
[links.6]
C = [0, 0]
G = [25, 15]
slides = { on = 0, through = [0, 240], angle = 0 }
[[drivers]]
turn = 1
angle = 65
speed = 12
[[drivers]]
turn = 2
angle = 100
speed = -5
acceleration = 3
[branches]
B = "left of A-E"
6 = "backward"
[ask]
velocity = ["G"]
acceleration = ["G"]
omega = [3, 4]
epsilon = [3, 4]
""",
    "guide along two points of the frame, link in its own axes": """
[frame]
O = [0, 0]
P = [0, 40]
Q = [100, 40]
[links.1]
O = [0, 0]
A = [60, 10]
[links.2]
A-B = 200
[links.3]
B = [0, 0]
slides = { on = 0, along = "P-Q" }
[[drivers]]
turn = 1
angle = 50
speed = 60
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
poles = [2]
centres = [2, 1]
""",
    "link given by a distance and an angle": """
[frame]
O = [0, 0]
P = [260, 30]
[links.1]
O-A = 60
[links.2]
A-B = 200
C = { from = "A", length = 90, angle = 25 }
[links.3]
P-B = 140
[[drivers]]
turn = 1
angle = 50
speed = 20
[branches]
B = "left of A-P"
[ask]
velocity = ["C"]
acceleration = ["C"]
""",
    "flat plate, poles and centres of links about fixed pivots": """
[frame]
O = [0, 0]
P = [260, 30]
[links.1]
O-A = 60
[links.2]
A-B = 200
A-C = 120
B-C = 81
C = "right of A-B"
[links.3]
P-B = 140
[[drivers]]
turn = 1
angle = 50
speed = 20
[branches]
B = "left of A-P"
[ask]
velocity = ["C"]
acceleration = ["C"]
centres = [1, 2, 3]
poles = [1, 2, 3]
""",
    "crank on a corner of a plate that turns": """
[frame]
O = [0, 0]
[links.1]
O-A = 120
A-C = 60
O-C = 90
C = "left of O-A"
[links.2]
C-D = 70
[[drivers]]
turn = 1
angle = 40
speed = 5
[[drivers]]
turn = 2
against = 1
angle = 30
speed = 3
[ask]
velocity = ["D"]
""",
    "lever with its block behind its pivot": """
[frame]
O1 = [0, 0]
O2 = [0, -300]
[links.1]
O1-A = 120
[links.2]
A = [0, 0]
slides = { on = 3, along = "O2-B" }
[links.3]
O2-B = 200
[[drivers]]
turn = 1
angle = 40
speed = 5
[branches]
2 = "backward"
[ask]
velocity = ["B"]
""",
    "slider driven along a turning arm": """
[frame]
O = [0, 0]
[links.1]
O-A = 200
[links.2]
B = [0, 0]
slides = { on = 1, along = "O-A" }
[[drivers]]
turn = 1
angle = 40
speed = 5
[[drivers]]
slide = 2
against = 1
position = 120
speed = 300
acceleration = 900
[ask]
velocity = ["B"]
acceleration = ["B"]
slides = [2]
""",
    "sleeve driven along a turning bar": """
[frame]
O = [0, 0]
[links.1]
O-A = 200
slides = { on = 2, through = [0, 0], angle = 0 }
[links.2]
P = [0, 0]
Q = [60, 20]
[[drivers]]
turn = 1
angle = 40
speed = 5
[[drivers]]
slide = 1
against = 2
position = -90
speed = 300
acceleration = 900
[ask]
velocity = ["Q"]
acceleration = ["Q"]
""",
    "bar through a swivelling block that stands beside its pin": """
[frame]
O = [0, 0]
Q = [220, -30]
[links.1]
O-A = 70
[links.2]
A-B = 320
[links.3]
Q = [0, 0]
slides = { on = 2, along = "A-B", offset = 25 }
[[drivers]]
turn = 1
angle = 75
speed = 10
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
omega = [2]
slides = [3]
""",
    "rapid return whose upper guide turns": """
[frame]
O = [0, 0]
G = [0, 160]
[links.1]
O-A = 48
[links.2]
A = [0, 0]
slides = { on = 3, along = "P-Q" }
[links.3]
P-Q = 288
[links.4]
P = [0, 0]
slides = { on = 0, through = "O", angle = 90 }
[links.5]
Q = [0, 0]
slides = { on = 6, along = "G-H" }
[links.6]
G-H = 200
[[drivers]]
turn = 6
angle = 10
speed = 2
acceleration = 3
[[drivers]]
turn = 1
angle = 35
speed = 6
[branches]
2 = "closure 2"
[ask]
velocity = ["P", "Q"]
acceleration = ["P", "Q"]
omega = [3]
epsilon = [3]
""",
    "crank with its own axes": """
[frame]
O = [0, 0]
P = [260, 30]
[links.1]
A = [60, 5]
O = [2, 3]
[links.2]
A-B = 200
[links.3]
P-B = 140
[[drivers]]
turn = 1
angle = 50
speed = 20
[branches]
B = "left of A-P"
[ask]
velocity = ["B"]
acceleration = ["B"]
""",
}
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


def every_page(
    mechanism: Mechanism, spoken: Words, views: Sequence[str] = ("key", "task")
) -> list[Page]:
    """All pages of a mechanism in some views; what does not fit is left out."""
    verdict = proved(mechanism, mechanism.solve())
    drawings = drawings_of(mechanism, verdict, spoken)
    pages: list[Page] = []
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
    """One sheet, of several pages where it grows."""
    return list(drawn(drawing, view, "1/1"))


RARE |= ASKING
RARE |= {
    f"four-bar with {sheet}": f"[sheet]\n{sheet}\n" + OTHERS["four-bar with a coupler point"]
    for sheet in ("enlarge = 1.5", "ka = 0.4")
}
RARE["only a path is asked"] = (
    OTHERS["parallelogram"].partition("[ask]")[0]
    + """
[ask]
curves = ["B"]
"""
)
RARE["what is asked of a point is too short to be drawn"] = """
[frame]
O1 = [0, 0]
O2 = [120, 0]
[links.1]
O1-A = 60
[links.2]
A-B = 70
[links.3]
O2-B = 80
[[drivers]]
turn = 1
angle = 108.205
speed = 6
[branches]
B = "left of A-O2"
[ask]
acceleration = ["A"]
epsilon = [2]
"""


def rare(name: str) -> Mechanism:
    """A scene that uses what the others do not."""
    return Mechanism(read_text(HEAD.format(title=name) + RARE[name], name, None, {}))


def fields(sentence: str) -> set[str]:
    """The names of the gaps of a sentence."""
    return {name for _, name, _, _ in Formatter().parse(sentence) if name is not None}


def literals() -> set[str]:
    """Every string that stands in the code by itself, and those that a template puts together."""
    found = set()
    for path in CODE.rglob("*.html"):
        quoted = set(re.findall(r'"([\w. -]+)"', path.read_text(encoding="utf-8")))
        begun = [text for text in quoted if text.endswith(".")]
        found |= quoted | {first + last for first in begun for last in quoted}
    for path in CODE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.add(node.value)
    return found


def spoken_keys() -> set[str]:
    """Every string that stands in the code of the pages as the key of words(...)."""
    found = set()
    rooms = (CODE / room for room in ("drawing", "construction", "documents"))
    for path in (path for room in rooms for path in room.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        found |= set(re.findall(r'\bwords\(\s*"([^"{}]+)"', text))
    return found - set(LANGUAGES)


@pytest.mark.parametrize("language", OTHER_LANGUAGES)
def test_every_language_has_the_same_keys(language):
    english, others = words("en").sentences.keys(), words(language).sentences.keys()
    assert english == others, english ^ others


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
    differing = [key for key in english if fields(english[key]) != fields(others[key])]
    assert not differing


@pytest.mark.parametrize("language", OTHER_LANGUAGES)
def test_no_sentence_is_left_in_english(language):
    english, others = words("en").sentences, words(language).sentences
    same = {key for key in english if english[key] == others[key]}
    long = {key for key in same if re.search(r"[a-z]{4,}", re.sub(r"\{.*?\}", "", english[key]))}
    assert long <= {"page.constant", "table.segment"}


def test_every_key_in_the_code_has_a_sentence():
    assert len(spoken_keys()) > 20
    assert spoken_keys() <= words("en").sentences.keys()


def test_every_sentence_is_used():
    USED.clear()
    spoken = Recording("en", words("en").sentences)
    every_page(mechanism_named(SHIPPED[0], 7), spoken, ("key", "task", "steps", "overlay"))
    every = [mechanism_named(lab, 7) for lab in SHIPPED[1:]]
    every += [mechanism_named(name) for name in (*OTHERS, *SCENES)]
    every += [rare(name) for name in RARE]
    for mechanism in every:
        every_page(mechanism, spoken)
    unused = words("en").sentences.keys() - USED - literals() - {*SLIPS.values()}
    assert not unused, " ".join(sorted(unused))


@pytest.mark.parametrize("language", LANGUAGES)
def test_rare_ways_to_write_a_scene_have_their_sentences(language):
    """A third of them in each language."""
    for name in list(RARE)[LANGUAGES.index(language) :: len(LANGUAGES)]:
        assert every_page(rare(name), words(language)), name


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
