"""The sheets of positions, measured on the paper: places, plans, dead points, the stroke."""

from __future__ import annotations

import re
from cmath import rect
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from math import cos, hypot, radians, sin, sqrt

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.documents.positions_plans import usual
from graphkin.documents.sheet_documents import SheetDocument, hand_out
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Page, Text, style_class
from graphkin.drawing.richtext import plain
from graphkin.drawing.scale import Extent
from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import cycle
from graphkin.motion.equal_positions import equal_places
from graphkin.scene.model import Ask, StatedPositions
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES
from graphkin.text.errors import SceneError
from tests.chosen import FOLDER, by_turns
from tests.documents.sheet_tools import mechanism_named
from tests.mechanisms import mechanism_of
from tests.motion.linkages import slider_crank
from tests.scene_files import FOLDER as SCENES
from tests.scene_files import scene_text

DRAWN = ("crank-rocker", "shaper", "cam-roller", "cam-lever", "gears-planet", "five-bar")


def posed(mechanism: Mechanism, **ways: object) -> Mechanism:
    """The mechanism with other positions of its sheets."""
    return Mechanism(replace(mechanism.scene, positions=StatedPositions(**ways)))


def pages(mechanism: Mechanism, language: str = "en") -> dict[str, Page]:
    """The sheets of positions by their kind."""
    return {part.kind: part.pages[0] for part in hand_out(mechanism, "positions", language)}


@cache
def sheets(name: str) -> dict[str, Page]:
    return pages(mechanism_named(name))


def circles(page: Page) -> dict[str, complex]:
    """The places on paper of pins and points of plans, by name; y upwards."""
    return {
        mark.name: complex(mark.cx, -mark.cy)
        for mark in page.marks
        if isinstance(mark, CircleMark) and style_class(mark) in ("pin", "point", "pole")
    }


def said(page: Page) -> Iterator[str]:
    return (mark.markup for mark in page.marks if isinstance(mark, Text))


def number_in(text: str, before: str) -> float:
    return float(text.partition(before)[2].split()[0].rstrip(");°"))


def test_pins_lie_where_the_closed_form_of_a_slider_crank_puts_them():
    """x = r cos φ + sqrt(l² - (e - r sin φ)²)."""
    r, rod, e = 2.0, 5.0, 1.0
    page = pages(slider_crank(r, rod, e, angle=17))["mechanism"]
    kL = number_in(next(text for text in said(page) if "*k*_L" in text), "= ")
    at = circles(page)
    for i in range(12):
        phi = radians(17 + 30 * i)
        x = r * cos(phi) + sqrt(rod**2 - (e - r * sin(phi)) ** 2)
        name = "B_0" if "B_0" in at else "B"
        pin = at[f"B_{i}"] if i else at.get(name, at["B"])
        assert (pin - at["O"]) * kL == pytest.approx(complex(x, e), abs=1e-6)
        crank = at[f"A_{i}"] if i else at["A"]
        assert (crank - at["O"]) * kL == pytest.approx(r * complex(cos(phi), sin(phi)), abs=1e-6)


def test_the_stroke_is_the_difference_of_both_positions_in_line():
    """sqrt((l+r)² - e²) - sqrt((l-r)² - e²)."""
    page = pages(slider_crank(2, 5, 1))["mechanism"]
    text = next(text for text in said(page) if text.startswith("*H*"))
    assert number_in(text, "= ") == pytest.approx(sqrt(48) - sqrt(8), abs=1e-3)
    ends = [
        mark
        for mark in page.marks
        if isinstance(mark, LineMark) and mark.name == "stroke 3" and mark.y1 == mark.y2
    ]
    (line,) = ends
    at = circles(page)
    limits = sorted(at[name].real for name in ("B_I", "B_II"))
    assert sorted((line.x1, line.x2)) == pytest.approx(limits, abs=1e-6)


@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
def test_every_plan_gives_what_the_mechanism_set_there_gives(kind: str):
    """The scene is set to each position by its own parameter and solved by itself."""
    page = sheets("crank-rocker")[kind]
    k = number_in(next(text for text in said(page) if "*k*" in text and "mm)" in text), "= ")
    at = circles(page)
    prime = "′" if kind == "acceleration" else ""
    for i in range(12):
        solved = load(str(FOLDER / "crank-rocker.toml"), n=(4 + 2 * i) % 24).solve()
        for point in ("A", "B", "P"):
            drawn = at[f"{point.lower()}{prime}_{i}"] - at[f"o{prime}_{i}"]
            true = getattr(solved.points[point], kind)
            assert drawn * k == pytest.approx(true, rel=1e-4, abs=1e-4 * abs(true))


def test_plans_from_one_pole_have_the_same_vectors_as_from_their_own():
    own = pages(posed(mechanism_named("shaper")))["velocity"]
    one = pages(posed(mechanism_named("shaper"), one_pole=True))["velocity"]
    scales = [
        number_in(next(t for t in said(page) if "*k*_v =" in t and "mm)" in t), "= ")
        for page in (own, one)
    ]
    first, second = circles(own), circles(one)
    for name in ("c", "b", "a"):
        for i in range(1, 12):
            alone = (first[f"{name}_{i}"] - first[f"o_{i}"]) * scales[0]
            together = (second[f"{name}_{i}"] - second["o"]) * scales[1]
            assert together == pytest.approx(alone, rel=1e-3, abs=1e-3)


def test_a_dead_point_of_the_driver_is_drawn_and_has_no_plan():
    found = pages(posed(load("pump", n=7), count=8, start="dead"))
    at = circles(found["mechanism"])
    assert {"A_0", "A_8", "D_0", "D_8"} <= at.keys()
    plans = {name for name in circles(found["velocity"]) if name.startswith("o_")}
    assert plans == {f"o_{i}" for i in range(1, 8)}
    assert any(text.endswith("0, 8") for text in said(found["velocity"]))


def test_a_plan_next_to_a_dead_point_has_its_scale_beside_its_number():
    """Crank 182.1°, 5° before the end of the range: five times the acceleration of the others."""
    mechanism = load("pump", n=12)
    page = pages(mechanism)["acceleration"]
    (text,) = (mark for mark in page.marks if isinstance(mark, Text) and mark.name == "scale_11")
    at, moved = circles(page), cycle(mechanism, steps=4)
    place = equal_places(moved, 12, "scene")[11]
    (true,) = moved.along([place]).solution.points["D"].acceleration
    drawn = at["d′_11"] - at["o′_11"]
    assert drawn * number_in(text.markup, "= ") == pytest.approx(true, rel=1e-3)
    assert any("other scales beside it" in each for each in said(page))
    usual = number_in(next(each for each in said(page) if "mm)" in each), "*k*_a = ")
    assert number_in(text.markup, "= ") / usual == pytest.approx(5, rel=1e-3)


def test_vectors_cut_off_at_the_edge_are_told():
    found = pages(posed(load("pump", n=12), one_pole=True))
    assert any("are longer" in each for each in said(found["acceleration"]))
    assert not any("are longer" in each for each in said(sheets("shaper")["velocity"]))


def test_only_the_asked_accelerations_are_drawn():
    found = pages(posed(mechanism_named("shaper"), accelerations=(2, 7)))
    names = {name for name in circles(found["acceleration"]) if name.startswith("o′")}
    assert names == {"o′_2", "o′_7"}
    assert "acceleration" not in pages(posed(mechanism_named("shaper"), accelerations=()))


@pytest.mark.parametrize("name", DRAWN)
def test_labels_are_clear_of_each_other_and_of_the_other_pins(name: str):
    for page in sheets(name).values():
        labels = [m for m in page.marks if isinstance(m, Text) and style_class(m) == "label"]
        boxes = [(box_of(label), label) for label in labels]
        for i, (one, label) in enumerate(boxes):
            for other, second in boxes[i + 1 :]:
                apart = (
                    one[2] <= other[0] + 0.05
                    or other[2] <= one[0] + 0.05
                    or one[3] <= other[1] + 0.05
                    or other[3] <= one[1] + 0.05
                )
                assert apart, (label.markup, second.markup)


def box_of(text: Text) -> tuple[float, float, float, float]:
    xs, ys = zip(*text.corners(), strict=True)
    return min(xs), min(ys), max(xs), max(ys)


@pytest.mark.parametrize("name", ["shaper", "crank-rocker"])
def test_every_moving_pin_has_its_number_at_every_position(name: str):
    page = sheets(name)["mechanism"]
    labels = [m for m in page.marks if isinstance(m, Text) and style_class(m) == "label"]
    told = [each for label in labels for each in label.name.split() if "_" in each]
    assert len(told) == len({*told})
    pins = {each for each in circles(page) if "_" in each}
    assert pins <= {*told}


@pytest.mark.parametrize(("name", "language"), by_turns(DRAWN, LANGUAGES))
def test_a_sheet_stays_within_its_frame_in_every_language(name: str, language: str):
    for page in pages(mechanism_named(name), language).values():
        page.check()
        assert page.lang == language


@pytest.mark.parametrize("name", ["shaper", "five-bar", "rapid-return-slider"])
def test_units_in_russian_tables_of_positions_are_in_cyrillic_letters(name: str):
    """GOST 8.417-2002, for a driver that turns, for time and for one that slides."""
    heads = [
        plain(mark.markup)
        for page in pages(mechanism_named(name), "ru").values()
        for mark in page.marks
        if isinstance(mark, Text) and mark.name == "positions"
    ]
    units = [unit for head in heads for unit in re.findall(r"\((.*)\)$", head)]
    assert units
    assert not [unit for unit in units if re.search("[A-Za-z]", unit)]


def test_followers_are_turned_back_on_the_cam_by_its_angle():
    at = circles(sheets("cam-roller")["mechanism"])
    own = at["B"] - at["O"]
    for i in range(1, 12):
        tip, back = at[f"B_{i}"] - at["O"], at[f"reversed 2_{i}"] - at["O"]
        assert abs(back) == pytest.approx(abs(tip), abs=1e-6)
        assert back / tip == pytest.approx(rect(1, -radians(30 * i)), abs=1e-6)
    assert abs(own) > 0


def test_the_stroke_of_a_cam_is_that_of_its_follower():
    """Not of the block of its equivalent linkage."""
    texts = list(said(sheets("cam-lever")["mechanism"]))
    assert any(text.startswith("*ψ* = 16.00°") for text in texts)


def test_every_mark_of_a_position_has_a_name_and_a_class():
    for page in sheets("shaper").values():
        for mark in page.marks:
            assert mark.cls
            if style_class(mark) in ("weak-link", "dead-link", "pin", "velocity", "trajectory"):
                assert mark.name, mark


@pytest.mark.parametrize("name", ["crank-rocker", "shaper"])
def test_the_sheet_explains_the_lines_of_those_components_that_its_plans_have(name):
    page = sheets(name)["acceleration"]
    drawn = {style_class(mark) for mark in page.marks}
    text = " ".join(said(page))
    words = {"normal": "normal", "tangential": "tangential", "coriolis": "Coriolis"}
    words["sliding"] = "along the guide"
    assert {look for look, word in words.items() if word in text} == drawn & {*words}


def test_the_longest_plan_decides_one_scale_for_all():
    """The crank's pin has one speed, so its vector has one length in all plans."""
    at = circles(sheets("shaper")["velocity"])
    lengths = [abs(at[f"a_{i}"] - at[f"o_{i}"]) for i in range(12)]
    assert lengths == pytest.approx([lengths[0]] * 12, rel=1e-9)


@pytest.mark.parametrize(("sizes", "deciding"), [((1, 1, 1, 1.6), 3), ((1, 1, 1.6, 1.6), 4)])
def test_one_plan_alone_does_not_make_all_others_small(sizes, deciding):
    boxes = [Extent(0.0, 0.0, size, 0.0) for size in sizes]
    assert usual(boxes) == boxes[:deciding]


SCENE = scene_text("documents/slider-crank") + "[positions]\n"


def test_all_mistakes_of_positions_are_told_at_once():
    wrong = 'count = 2\nstart = "deed"\nstrong = "x"\npoles = "two"\naccelerations = [0, 99]\n'
    with pytest.raises(SceneError) as told:
        mechanism_of(SCENE + wrong)
    places = {problem.place for problem in told.value.problems}
    expected = {"count", "start", "strong", "poles", "accelerations[1]"}
    assert places == {f"positions.{key}" for key in expected}
    assert "dead" in str(told.value)


def test_a_position_that_does_not_exist_is_refused():
    with pytest.raises(SceneError, match="there is no position 12") as told:
        pages(mechanism_of(SCENE + "strong = 12\naccelerations = [3, 40]\n"))
    assert len(told.value.problems) == 2


def test_positions_start_where_the_scene_says():
    page = pages(mechanism_of(SCENE + "start = 90\ncount = 4\n"))["mechanism"]
    at = circles(page)
    up = [name for name in ("A_0", "A") if name in at and abs(at[name].real - at["O"].real) < 1e-6]
    assert up
    texts = [m.markup for m in page.marks if isinstance(m, Text) and m.name == "positions"]
    assert {"90.0", "180.0", "270.0", "0"} <= {*texts}


def lines_of(marks: tuple[Mark, ...], name: str) -> float:
    return sum(
        hypot(m.x2 - m.x1, m.y2 - m.y1) for m in marks if isinstance(m, LineMark) and m.name == name
    )


def test_bars_keep_their_length_in_all_positions():
    marks = sheets("crank-rocker")["mechanism"].marks
    for link in ("1", "3"):
        lengths = [lines_of(marks, f"{link}_{i}") for i in range(1, 12)]
        assert lengths == pytest.approx([lengths[0]] * 11, rel=1e-9)


def in_results(view: str, results: str) -> list[SheetDocument]:
    """A whole motion of the shaper in inches, with results in a unit."""
    text = (FOLDER / "shaper.toml").read_text(encoding="utf-8")
    units = f'length = "in", results = "{results}"'
    return hand_out(Mechanism(read_text(text.replace('length = "mm"', units), "own")), view)


def test_positions_are_drawn_alike_in_every_unit_of_results():
    """Lines lie at the same places of the paper; an inch is 0.0254 m in every value of a table."""
    values: dict[str, list[list[str]]] = {"in": [], "SI": []}
    lines: dict[str, list[tuple[float, ...]]] = {"in": [], "SI": []}
    for results, found in values.items():
        for document in in_results("positions", results):
            for page in document.pages:
                found.append([m.markup for m in page.marks if isinstance(m, Text)])
                lines[results] += [
                    (m.x1, m.y1, m.x2, m.y2) for m in page.marks if isinstance(m, LineMark)
                ]
    assert np.array(lines["in"]) == pytest.approx(np.array(lines["SI"]), abs=1e-4)
    heads = {text for page in values["in"] for text in page}
    assert any(text.endswith("(in/s)") for text in heads)
    assert any(text.endswith(("(in/s^2)", "(in/s²)")) for text in heads)
    assert not any(re.search(r"\(m/s|\bm/mm", text) for text in heads)
    checked = 0
    for one, other in zip(values["in"], values["SI"], strict=True):
        for i, (mine, theirs) in enumerate(zip(one, other, strict=False)):
            if not mine.endswith("(in/s)") or not theirs.endswith("(m/s)"):
                continue
            for own, si in zip(one[i + 1 : i + 8], other[i + 1 : i + 8], strict=True):
                mine_si, theirs_si = (float(text.replace("−", "-")) for text in (own, si))
                rounded, there = (0.51 / 10.0 ** len(t.partition(".")[2]) for t in (own, si))
                off = rounded * 0.0254 + there
                assert mine_si * 0.0254 == pytest.approx(theirs_si, abs=off)
                checked += 1
    assert checked >= 7


def test_diagrams_are_in_the_unit_of_results():
    """Every axis and scale factor is in inches, none in metres."""
    every = [
        m.markup
        for document in in_results("diagrams", "in")
        for page in document.pages
        for m in page.marks
        if isinstance(m, Text)
    ]
    text = "\n".join(every)
    for unit in ("*v*, in/s", "*a*, in/s^2", " (in/s)/mm", " (in/s^2)/mm", ", in/s^3", " in/mm"):
        assert unit in text, unit
    assert not re.search(r"(?<![\w/])m/s|(?<![\w/])m/mm|, m$", text, re.M)


def test_the_table_of_the_most_positions_stays_above_the_foot_and_is_legible():
    """48 positions and three dead points; no number touches its neighbour."""
    mechanism = posed(load("pump"), count=48)
    for part in hand_out(mechanism, "positions", "en"):
        for page in part.pages:
            page.check()
            cells = [m for m in page.marks if isinstance(m, Text) and m.cls == "table"]
            cells = [m for m in cells if m.name == "positions" and m.anchor == "middle"]
            assert len(cells) >= 96
            rows: dict[float, list[Text]] = {}
            for cell in cells:
                rows.setdefault(round(cell.y, 3), []).append(cell)
            for row in rows.values():
                ends = [
                    (min(x for x, _ in c.corners()), max(x for x, _ in c.corners())) for c in row
                ]
                assert all(right < left for (_, right), (left, _) in pairwise(sorted(ends)))
            foot = next(m for m in page.marks if isinstance(m, Text) and m.name == "witness")
            above = [
                m for m in page.marks if isinstance(m, Text) and m.name in ("legend", "positions")
            ]
            assert max(m.corners()[2][1] for m in above) <= foot.corners()[0][1] + 0.3


@pytest.mark.parametrize(("kind", "scaled"), [("velocity", False), ("acceleration", True)])
def test_the_caption_of_plans_says_whether_all_have_one_scale(kind, scaled):
    texts = [mark for mark in sheets("five-bar")[kind].marks if isinstance(mark, Text)]
    (said,) = (mark.markup for mark in texts if "own pole" in mark.markup)
    assert any(mark.name.startswith("scale_") for mark in texts) is scaled
    assert ("all at one scale" in said) is not scaled


def test_data_without_room_are_said_to_be_elsewhere():
    """Three cylinders and eleven links need four lines; the sheet has room for two."""
    page = pages(load(SCENES / "documents/excavator-with-bucket.toml"))["mechanism"]
    assert "the data are on the sheets of a single position" in said(page)


@pytest.mark.parametrize("view", ["positions", "diagrams"])
def test_data_are_the_numbers_of_the_strong_position(view: str):
    """They are results: 44° in the place of the rule (30 + 2·n)° from which a student has it."""
    mechanism = load("pump", n=7)
    for part in hand_out(mechanism, view, "en"):
        data = [m.markup for m in part.pages[0].marks if isinstance(m, Text) and m.name == "data"]
        assert "44°" in data
        assert not any("*n*)" in each for each in data)


def rows_of(page: Page) -> dict[str, list[str]]:
    """The rows of the table of positions: their values by their heads."""
    texts = [mark for mark in page.marks if isinstance(mark, Text) and mark.name == "positions"]
    rows: dict[float, list[Text]] = {}
    for text in texts:
        rows.setdefault(text.y, []).append(text)
    ordered = [sorted(row, key=lambda text: text.x) for row in rows.values()]
    return {row[0].markup: [text.markup for text in row[1:]] for row in ordered}


def test_the_tables_have_the_way_and_the_asked_values_at_every_position():
    """s = x − x_min by the closed form, and the sizes that the mechanism set there gives."""
    r, rod, e = 2.0, 5.0, 1.0
    scene = slider_crank(r, rod, e, angle=17).scene
    mechanism = Mechanism(replace(scene, ask=Ask(velocity=("B",))))
    found = pages(mechanism)
    places = cycle(mechanism, steps=12).along(17 + 30.0 * np.arange(12)).solution
    way = rows_of(found["mechanism"])["*s*_{3} (m)"][:12]
    least = sqrt((rod - r) ** 2 - e**2)
    for i, text in enumerate(way):
        phi = radians(17 + 30 * i)
        x = r * cos(phi) + sqrt(rod**2 - (e - r * sin(phi)) ** 2)
        assert float(text) == pytest.approx(x - least, abs=6e-4)
    speeds = rows_of(found["velocity"])["*v*_{B} (m/s)"]
    for text, speed in zip(speeds, np.abs(places.points["B"].velocity), strict=True):
        assert float(text) == pytest.approx(speed, rel=6e-3, abs=6e-3)


def test_a_table_without_room_has_the_positions_alone():
    """48 positions take all rows; no row of values is cut off."""
    heads = {*rows_of(pages(posed(mechanism_named("shaper"), count=48))["velocity"])}
    assert heads == {"position", "*φ* (°)"}
