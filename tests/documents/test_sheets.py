"""Every sheet of both shipped labs and of other mechanisms can be read: nothing on anything."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from math import cos, dist, hypot, sin

import numpy as np
import pytest
import shapely
from shapely.geometry.base import BaseGeometry

from graphkin.construction.core.component import crowded_pins
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.naming import TINY as SHORTEST
from graphkin.construction.core.program import plan_vector
from graphkin.construction.guides.slide_symbols import RAIL
from graphkin.construction.result_tables import turning_links, vectors
from graphkin.documents.detail import far_places, inset, parted
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import HEADING, boards
from graphkin.documents.sheet import NAME as DATA
from graphkin.documents.signs import mechanism_signs, round_below, sign_of
from graphkin.drawing.field import A3
from graphkin.drawing.free_space import Space
from graphkin.drawing.labels import LETTERS, FieldContent
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline, Text, reach
from graphkin.drawing.richtext import CLEAR, plain, runs, signs
from graphkin.drawing.style import OWN_LINES, style_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import SHORT
from graphkin.text.errors import PageError
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import (
    KINDS,
    OTHERS,
    VARIANTS,
    Drawn,
    attempt,
    both,
    calculations,
    collisions,
    drawing_of,
    drawings,
    drawn,
    is_label,
    is_vector,
    kind_of,
    kinds_of,
    labels_of,
    length_of,
    named,
    off_fields,
    outline,
    outside,
    texts,
    told,
)
from tests.mechanisms import SHIPPED

FIELDS = ("mechanism", "plan")
HEAD = 0.41
"""Longest arrowhead, in parts of its vector."""
WIDER = 2.2
"""Least width of an arrowhead, in parts of its shaft's."""
NEAR = 6.0
"""Farthest a label without a leader stands from what it names, in mm."""
INSIDE = 1.1
"""Farthest a leader ends from the line it leads to, in mm: at the rim of a pin that stands on it,
or at a centre's cross."""
RAY = 20.0
"""How much of the ray to a centre off its field the centre's name belongs to, in mm."""
OFF = (0.8, 1.6)
"""Farthest a leader begins from its text, or from the corner of the box around a ring, in mm."""

SHEETS = [(lab, n, kind) for lab, n in VARIANTS for kind in KINDS]
NAMES = (*OTHERS, *CHOSEN, "stephenson-3-crank", "watt-1")
SHEETS += [(name, None, kind) for name in NAMES for kind in kinds_of(name)]


@pytest.fixture(params=SHEETS, ids=named)
def page(request) -> Drawn:
    _, made = attempt(*request.param, "key", "en")
    if isinstance(made, PageError):
        pytest.skip("another test says that this sheet cannot be made")
    return drawn(*request.param)


@pytest.mark.parametrize("which", dict.fromkeys(which[:2] for which in SHEETS), ids=named)
def test_a_scene_has_the_sheets_of_what_it_asks(which):
    assert kinds_of(*which) == tuple(drawing.kind for drawing in drawings(*which))


@pytest.mark.parametrize("which", SHEETS, ids=named)
def test_every_sheet_can_be_made_or_another_scene_is_clearly_refused(which):
    _, made = attempt(*which, "key", "en")
    shipped = which[0] not in OTHERS
    if isinstance(made, PageError):
        assert not shipped and "does not fit" in str(made), made


def test_no_label_touches_a_line_or_another_text(page):
    faults = collisions(page.page.marks)
    assert not faults, "\n".join(faults)


def test_nothing_leaves_the_frame_or_its_field(page):
    faults = [*outside(page.page.marks), *off_fields(page)]
    assert not faults, "\n".join(faults)


def test_every_vector_point_and_pin_has_one_label_that_says_its_name(page):
    """But for vectors that the foot lists, letters of triangles that no sentence says, a letter or
    two of small ones that stand at one pin with many, points of many trial plans, whose names the
    foot says to be moved, small letters that the foot lists, and pins named in a detail."""
    faults, left_out = [], []
    told_of = " ".join(each.markup for each in sentences(page.drawing))
    for field in FIELDS:
        subjects = named_marks(page, field)
        assert subjects
        faults += [f"{field}: {told(mark)} has no name" for mark in subjects if not mark.name]
        counts = Counter(mark.name for mark in subjects)
        faults += [f"{field}: {name} is there {k} times" for name, k in counts.items() if k > 1]
        labels: dict[str, list[str]] = {}
        for label in page.labels(field):
            for name, word in page.called(field, label).items():
                labels.setdefault(name, []).append(word)
        for mark in subjects:
            said, names = labels.get(mark.name, []), names_of(page, mark)
            noted = not said and any(name in page.notes(field) for name in names)
            noted |= kind_of(mark) == "pin" and not names.isdisjoint(in_details(page, field))
            if not said and mark.cls == "point construction":
                sayings = (re.escape(name) + "(?![_′″‴])" for name in names)
                left_out += [mark.name for each in sayings if re.search(each, told_of)]
            elif not (said or noted) and mark.cls == f"point {OWN_LINES}":
                assert page.drawing.words("page.trials_moved") in page.notes(field)
            elif not noted and (len(said) != 1 or said[0] not in names):
                faults.append(f"{field}: {told(mark)} is named {said}")
    assert not faults, "\n".join(faults)
    assert len(left_out) <= 2, left_out


def in_details(page: Drawn, field: str) -> set[str]:
    """What the details of a field say."""
    return {each.text.markup for each in labels_of(page.marks[field]) if not each.text.name}


def is_apart(mark):
    """True for a mark of an inset or of an enlarged detail."""
    return bool({"inset", "detail"} & {*mark.cls.split()})


def named_marks(page: Drawn, field: str) -> list[Mark]:
    """The vectors, points, poles, pins and centres of a field."""
    circles = ("point", "pole", "pin", "centre")
    return [
        mark
        for mark in page.marks[field]
        if is_vector(mark)
        or (isinstance(mark, CircleMark) and kind_of(mark) in circles and not is_apart(mark))
    ]


def taken_up(mark: Mark) -> BaseGeometry:
    """The middle line of a mark's stroke; of a plate all of it, for its number stands inside."""
    return shapely.Polygon(mark.points) if is_plate(mark) else outline(mark)


def is_plate(mark: Mark) -> bool:
    """True for the plate of a link."""
    return isinstance(mark, Polyline) and kind_of(mark) == "plate"


def test_the_number_of_a_plate_stands_inside_where_a_clear_place_is(page):
    """A circle of 2.3 mm has a clear place if its middle is 3.1 mm from sides and other lines."""
    marks = page.marks["mechanism"]
    plates = {mark.name: shapely.Polygon(mark.points) for mark in marks if kind_of(mark) == "plate"}
    others = [mark for mark in marks if not isinstance(mark, Text) and not is_label(mark)]
    lines = [outline(mark) for mark in others if kind_of(mark) != "plate"]
    for label in page.labels("mechanism"):
        if label.ring and label.text.name in plates:
            body = plates[label.text.name]
            clear = body.buffer(-3.2) - shapely.union_all(shapely.buffer(lines, 3.2))
            assert clear.is_empty or body.contains(label.ink()), label.text


def test_the_numbers_of_plates_are_set_before_other_labels_seek_places():
    """None waits for a place that is left; each stands 0.8 mm clear of all that is drawn."""
    drawing = drawing_of("platform-3rpr", None, "velocity")
    board = boards(drawing, lay_out(drawing), "key")[0]
    plates = {mark.name: shapely.Polygon(mark.points) for mark in board.marks if is_plate(mark)}
    assert plates and not {label.name for label in board.labels if label.ring} & plates.keys()
    lines = shapely.union_all([outline(mark) for mark in board.marks if isinstance(mark, LineMark)])
    rings = [mark for mark in board.marks if mark.cls.startswith("number") and mark.name in plates]
    assert {ring.name for ring in rings} == plates.keys()
    for ring in rings:
        middle, body = shapely.Point(ring.cx, ring.cy), plates[ring.name]
        assert body.contains(middle)
        assert middle.distance(body.exterior) > ring.r + 0.79
        assert middle.distance(lines) > ring.r + 0.79


def names_of(page: Drawn, mark: Mark) -> set[str]:
    """The markups that a mark may be called by."""
    names = {symbol(mark.name), symbol(mark.name.partition("_")[0])}
    if mark.step is not None and is_vector(mark):
        vector = plan_vector(page.drawing.trace.program.steps[mark.step])
        names = {symbol(vector.symbol if vector else mark.name)}
    return names


def test_every_label_stands_by_what_it_names_or_leads_to_it(page):
    faults = []
    for field in FIELDS:
        subjects = [
            mark
            for mark in page.marks[field]
            if mark.name and not isinstance(mark, Text) and not is_label(mark)
        ]
        blocks = [taken_up(mark).envelope for mark in subjects if kind_of(mark) == "slider"]
        for label in page.labels(field):
            own = [taken_up(mark) for mark in subjects if mark.name in page.called(field, label)]
            if not own:
                continue
            near = shapely.union_all(own)
            if any(block.contains(near) for block in blocks):  # a pin named outside its guide
                near = near.centroid.buffer(RAIL)
            if label.leader:
                end = shapely.Point(label.leader.x2, label.leader.y2)
                start = shapely.Point(label.leader.x1, label.leader.y1)
                off = OFF[label.ring is not None]
                inside = INSIDE + RAY * is_far(page, field, label.text.name)
                if end.distance(near) > inside or start.distance(label.ink()) > off:
                    faults.append(f"the leader of {told(label.text)} leads elsewhere")
            elif label.ink().distance(near) > NEAR + RAY * is_far(page, field, label.text.name):
                faults.append(f"{told(label.text)} stands apart")
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize("name", ["slider-crank", "toggle-press", "inflection-cardan"])
def test_the_name_of_a_slider_is_just_outside_the_hatching_of_its_guide(name):
    for kind in kinds_of(name):
        page = drawn(name, None, kind, "key")
        drawing, field = page.drawing, page.layout.mechanism
        for way in drawing.standing.guideways:
            pin = drawing.scene.links[way.block].points[0]
            (label,) = (each for each in page.labels("mechanism") if each.text.name == pin)
            off = label.ink().distance(shapely.Point(field(drawing.positions[pin])))
            assert RAIL < off < RAIL + 4.0 and label.leader is None


def is_far(page: Drawn, field: str, name: str) -> bool:
    """True for a centre or pole off its field: only a head at the field's edge points to it."""
    return {kind_of(m) for m in page.marks[field] if m.name == name} <= {
        "arrowhead",
        "ray",
        "label",
        "leader",
    }


def test_every_vector_has_one_head_at_its_tip_and_a_short_one_has_none(page):
    faults = []
    for field in FIELDS:
        heads = [
            mark
            for mark in page.marks[field]
            if isinstance(mark, Polyline) and kind_of(mark) == "arrowhead" and mark.name
        ]
        for line in page.vectors(field):
            own = [head for head in heads if head.name == line.name]
            if len(own) != (length_of(line) >= SHORT):
                faults.append(f"{len(own)} heads: {told(line)}, {length_of(line):.2f} mm long")
            faults += [f"{told(line)}: {why}" for head in own for why in misfits(line, head)]
    assert not faults, "\n".join(faults)


def misfits(line: LineMark, head: Polyline) -> list[str]:
    """Why a head does not belong to its line, or cannot be told from it."""
    tip, *back = head.points
    found = []
    if hypot(tip[0] - line.x2, tip[1] - line.y2) > 1e-6:
        found.append("head not at the tip")
    middle = sum(x for x, _ in back) / 2, sum(y for _, y in back) / 2
    size = hypot(tip[0] - middle[0], tip[1] - middle[1])
    if size > HEAD * length_of(line):
        found.append(f"head {size:.2f} mm long")
    if shapely.Point(middle).distance(outline(line)) > 1e-6:
        found.append("head askew")
    wide, shaft = dist(*back), style_of(line.cls).width
    if wide < WIDER * shaft:
        found.append(f"head {wide:.2f} mm wide on a shaft of {shaft} mm")
    return found


# --- the task view -------------------------------------------------------------------------------

TASKS = [(lab, n) for lab in SHIPPED for n in (7, 29)]
TASKS += [(name, None) for name in list(OTHERS)[1:3]]
GIVEN_CLASSES = {"fixed-pivot", "guide", "ground", "pin", "centre-line", "pole", "label", "link"}


@pytest.fixture(params=TASKS, ids=named)
def pair(request) -> list[tuple[Drawn, Drawn]]:
    tasks, keys = both(*request.param, "task"), both(*request.param, "key")
    return list(zip(tasks, keys, strict=True))


def test_a_task_shows_only_fixed_pivots_lines_of_guides_and_the_pole(pair):
    for task, _ in pair:
        frame = task.drawing.scene.frame.points
        assert {kind_of(mark) for mark in task.marks["plan"]} == {"pole", "label"}
        assert {mark.name for mark in task.marks["plan"]} == {task.drawing.pole}
        for mark in task.marks["mechanism"]:
            assert kind_of(mark) in GIVEN_CLASSES, told(mark)
            assert mark.step is None, told(mark)
            if kind_of(mark) in ("pin", "link", "label", "leader"):
                assert mark.name in frame, told(mark)
            elif kind_of(mark) == "centre-line":
                assert mark.name.startswith("guide "), told(mark)


def test_no_number_of_the_solution_stands_on_a_task(pair):
    task, _ = pair[0]
    name = task.drawing.scene.name
    n = next((int(v) for v in task.drawing.scene.values.values()), None)
    secret = solution_numbers([key.drawing for _, key in pair])
    for view, pages in (
        ("task", [*(t.page for t, _ in pair), *calculations(name, n, "task")]),
        ("key", [*(k.page for _, k in pair), *calculations(name, n, "key")]),
    ):
        words = [m.markup for m in texts(pages) if m.name not in ("data", "witness")]
        found = set(re.findall(r"\d+[.,]\d+(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?", " ".join(words)))
        assert bool(found & secret) == (view == "key"), found & secret


def solution_numbers(drawings: list[Drawing]) -> set[str]:
    """How the numbers of a solution may be printed, from three to six digits."""
    numbers = [drawings[0].scales.kv / 1000, drawings[0].scales.ka / 1000]
    for drawing in drawings:
        scale = drawing.scales.kv if drawing.kind == "velocity" else drawing.scales.ka
        for target, number in drawing.trace.program.targets.items():
            value = drawing.trace.values.get(number)
            if target[0] in ("velocity", "acceleration", "omega", "epsilon") and value:
                numbers += [abs(value), 1000 * abs(value) / scale]
    words = drawings[0].words
    printed = {words.significant(x, k) for x in numbers for k in range(3, 7) if x > 1e-9}
    printed |= {words.fixed(x, k) for x in numbers for k in (1, 2, 3)}
    return {text for text in printed if re.search(r"[1-9]\d*[.,]\d*[1-9]|[.,]\d*[1-9]", text)}


# --- segments of the plans -----------------------------------------------------------------------

LETTER = re.compile(r"\*\w+\*′?(?:_\{[^}]*\})?(?:\^\{[^}]*\})?")


def test_every_vector_has_a_segment_whose_letters_are_drawn(page):
    drawn_letters = {
        symbol(name) for text in texts([page.page]) for name in text.name.split() if text.name
    }
    drawn_letters |= {*LETTER.findall(page.notes("plan"))}
    for name, segment, length, _ in vectors(page.drawing):
        letters = LETTER.findall(segment)
        assert len(letters) == 2 and "".join(letters) == segment, name
        assert length < SHORTEST or drawn_letters.issuperset(letters), (name, letters)


def test_components_that_are_laid_off_and_those_that_close_the_way_share_their_foot():
    found = {name: segment for name, segment, *_ in vectors(drawings("crank-slot")[1])}
    ends = {name: LETTER.findall(segment) for name, segment in found.items()}
    assert ends["a_C2B^ν"][1] == ends["a_C2B^τ"][0] == symbol("n_C2B")
    assert ends["a_CC2^c"][0] == ends["a_CC2^r"][1] == symbol("k_CC2")


# --- enlarged details ----------------------------------------------------------------------------


INDICES = 1.8
"""Least height of indices in mm."""


def circles(page):
    """The circles of the details on a mechanism: the small ones and the large ones."""
    marks = page.marks["mechanism"]
    every = [m for m in marks if isinstance(m, CircleMark) and m.cls == "detail"]
    return [m for m in every if m.r < 4], [m for m in every if m.r > 4]


def test_each_small_circle_has_its_large_one_and_indices_there_can_be_read(page):
    small, large = circles(page)
    assert len(small) == len(large)
    for mark in (*page.marks["mechanism"], *page.marks["plan"]):
        if isinstance(mark, Text) and kind_of(mark) == "label" and not mark.name:
            sizes = [run.size for run in runs(mark.markup, mark.height)]
            assert mark.height * min(sizes) / max(sizes) > INDICES - 0.1, mark.markup


@pytest.mark.parametrize("name", ["gears-ravigneaux", "valve-train"])
@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
def test_letters_and_key_numbers_of_crowded_fields_are_not_too_small(name, kind):
    page = drawn(name, None, kind)
    texts = [m for some in page.marks.values() for m in some if isinstance(m, Text)]
    assert [m.markup for m in texts if m.height < LETTERS] == []


def test_a_pin_at_which_three_triangles_meet_is_shown_enlarged():
    page = drawn("stephenson-3-crank", None, "acceleration")
    (pin,) = crowded_pins(page.drawing, 3)
    small, _ = circles(page)
    assert small
    assert any(dist(page.layout.mechanism(pin), (m.cx, m.cy)) < m.r for m in small)


@pytest.mark.parametrize("length", [0.51, 0.65, 0.79, 0.8, 1.2, 1.99])
@pytest.mark.parametrize("angle", [0.3, 2.5])
def test_a_detail_holds_a_short_vector_as_many_times_as_long_as_it_says(length, angle):
    """Its circle is three to eight times as wide as the vector, and clear of what else is drawn."""
    board, way = FieldContent((0.0, 0.0, 140.0, 110.0)), (cos(angle), sin(angle))
    x, y = 40.0, 50.0
    board.marks = [
        LineMark(x, y, x + length * way[0], y + length * way[1], "velocity", "v_B"),
        *(LineMark(5.0, each, 90.0, each, "link") for each in (20.0, 70.0, 100.0)),
    ]
    (field,) = parted(board)
    (times,) = field.times
    (small,) = [m for m in field.marks if isinstance(m, CircleMark) and kind_of(m) == "detail"]
    (large,) = [m for m in field.details if isinstance(m, CircleMark) and kind_of(m) == "detail"]
    (shown,) = [m for m in field.details if is_vector_line(m)]
    (line,) = [m for m in field.details if isinstance(m, LineMark) and m.cls == "detail"]
    (said,) = [m for m in field.details if isinstance(m, Text) and m.markup == f"{times}:1"]
    assert large.r == pytest.approx(times * small.r)
    drawn_as = (shown.x2 - shown.x1, shown.y2 - shown.y1)
    assert drawn_as == pytest.approx([times * length * part for part in way])
    middle = (shown.x1 + shown.x2) / 2, (shown.y1 + shown.y2) / 2
    assert middle == pytest.approx((large.cx, large.cy))
    assert (small.cx, small.cy) == pytest.approx((x + length * way[0] / 2, y + length * way[1] / 2))
    assert 3 <= 2 * large.r / (times * length) <= 8.01
    assert dist((line.x1, line.y1), (small.cx, small.cy)) == pytest.approx(small.r)
    assert dist((line.x2, line.y2), (large.cx, large.cy)) == pytest.approx(large.r)
    disc = shapely.Point(large.cx, large.cy).buffer(large.r)
    assert not disc.intersects(shapely.box(*reach(said)))
    assert all(disc.distance(outline(m)) > 1 for m in board.marks if not isinstance(m, Text))
    assert shapely.box(*board.rect).contains(disc)


def is_vector_line(mark: Mark) -> bool:
    """True for the line of a vector in a detail."""
    return isinstance(mark, LineMark) and kind_of(mark) == "velocity"


def test_an_inset_has_bars_and_a_far_centre_as_small_as_it_says():
    """Bars of 50, 120 and 90 mm; the centre lies in line with the crank, and with the rocker."""
    page = drawn("four-bar-crank-rocker", None, "velocity")
    board = far_inset(page, page.marks["mechanism"])
    reduced = scale_of_inset(board)
    bars = [m for m in board if kind_of(m) == "link"]
    found = {round(length_of(bar) * reduced, 6) for bar in bars}
    assert found == {50, 120, 90}
    (centre,) = [m for m in board if kind_of(m) == "centre"]
    for length in (50, 90):
        bar = next(m for m in bars if round(length_of(m) * reduced, 6) == length)
        across = (bar.x2 - bar.x1) * (centre.cy - bar.y1) - (bar.y2 - bar.y1) * (centre.cx - bar.x1)
        assert across == pytest.approx(0, abs=1e-9)
    left, top, right, low = frame_of(board)
    points = [(m.cx, m.cy) for m in board if isinstance(m, CircleMark)]
    points += [(bar.x1, bar.y1) for bar in bars]
    assert all(left + 7.9 < x < right - 7.9 and top + 7.9 < y < low - 7.9 for x, y in points)


@pytest.mark.parametrize("lanes", [100.0, 60.0, 50.0, 45.0, 40.0, 30.0, 20.0])
def test_an_inset_is_as_large_as_there_is_room_for(lanes):
    """Between lines so many mm apart: 80 by 60 mm at most, and no smaller than 26; places are tried
    every 5 mm."""
    page = drawn("four-bar-crank-rocker", None, "velocity")
    left, top, right, low = page.layout.mechanism.rect
    heights = np.arange(top, low, lanes)
    lines = [LineMark(left, height, right, height, "link") for height in heights]
    ((kind, centre),) = far_places(page.drawing, page.layout.mechanism)
    field = page.layout.mechanism
    found = inset(page.drawing, kind, centre, field, Space(lines, field.rect))
    if found is None:
        assert lanes < 45
        return
    start, above, end, below = frame_of(found.marks)
    assert end - start <= 80 and below - above <= 60 and max(end - start, below - above) >= 26
    assert not any(above <= height <= below for height in heights)
    reduced = scale_of_inset(found.marks)
    step = {1: 2, 2: 2, 5: 2.5}[int(str(reduced)[0])]
    wide, high = ((size - 16) * step + 16 for size in (end - start, below - above))
    assert wide > 80 or high > 60 or hypot(wide, high) + 9 > lanes


def far_inset(page: Drawn, marks: Sequence[Mark]) -> list[Mark]:
    """The marks of the one inset of a field."""
    (frame,) = [m for m in marks if isinstance(m, Polyline) and kind_of(m) == "panel"]
    rect = shapely.Polygon(frame.points)
    inside = [m for m in marks if isinstance(m, Text) and rect.contains(shapely.box(*reach(m)))]
    return [frame, *(m for m in marks if "inset" in m.cls.split()), *inside]


def frame_of(marks: Sequence[Mark]) -> tuple[float, float, float, float]:
    """The edges of an inset."""
    (frame,) = [m for m in marks if isinstance(m, Polyline) and kind_of(m) == "panel"]
    return shapely.Polygon(frame.points).bounds


def scale_of_inset(marks: Sequence[Mark]) -> int:
    """How many times as small as the mechanism an inset says it is."""
    (said,) = [m.markup for m in marks if isinstance(m, Text) and re.fullmatch(r"1:\d+", m.markup)]
    return int(said.partition(":")[2])


# --- turning arrows and the bar of the plan's scale ----------------------------------------------


def senses(page):
    """The turning arrows of a sheet's links, each with the text that stands in it."""
    marks = page.marks["mechanism"]
    for i, mark in enumerate(marks):
        if isinstance(mark, Arc) and mark.cls == f"sense {page.drawing.kind}":
            text = next(later for later in marks[i:] if isinstance(later, Text))
            yield mark, text


def test_each_sense_is_that_of_the_link_that_it_names_and_touches_nothing(page):
    marks, letter = page.marks["mechanism"], page.drawing.rate.letter
    by_text = {symbol(f"{letter}_{link}"): link for link in page.drawing.scene.links}
    for arc, text in senses(page):
        rate = page.drawing.turning(by_text[text.markup])
        assert rate is not None and (arc.end - arc.start) * rate > 0
        disc = shapely.Point(arc.cx, arc.cy).buffer(arc.r)
        for mark in marks:
            if isinstance(mark, Text) and mark != text:
                assert not disc.intersects(shapely.box(*reach(mark))), mark
            elif isinstance(mark, LineMark) and kind_of(mark) in ("link", page.drawing.kind):
                assert not disc.intersects(outline(mark)), mark


def test_the_sense_of_each_link_that_the_table_has_is_on_the_mechanism(page):
    """By its own arrow, by its driver's, or in words at the foot of the field."""
    marks = [mark for mark in page.marks["mechanism"] if isinstance(mark, Text)]
    told_of = {text.markup for _, text in senses(page)}
    if page.drawing.kind == "velocity":
        labels = page.labels("mechanism")
        by_driver = (each for each in labels if each.text.name.startswith("omega"))
        told_of |= {page.meaning("mechanism", each) for each in by_driver}
    words = (each for m in marks if m.name == "senses" for each in m.markup.split("; "))
    told_of |= {each.partition(":")[0] for each in words}
    wanted = {name for name, rate in turning_links(page.drawing) if rate}
    assert told_of >= {symbol(f"{page.drawing.rate.letter}_{link}") for link in wanted}


def test_the_bar_of_a_plan_is_as_long_as_it_says(page):
    marks = [mark for mark in page.marks["plan"] if getattr(mark, "name", "") == "scale"]
    if not marks:
        return
    bar = max((m for m in marks if isinstance(m, LineMark)), key=lambda m: m.x2 - m.x1)
    numbers = [m.markup for m in marks if isinstance(m, Text)]
    says = max(float(each) for each in numbers if re.fullmatch(r"[\d.e+-]+", each))
    assert (bar.x2 - bar.x1) == pytest.approx(says * page.layout.plan.mm, rel=1e-6)


def test_data_stay_clear_of_captions_and_of_the_frame(page):
    marks = [mark for mark in page.page.marks if isinstance(mark, Text)]
    told = [mark for mark in marks if mark.name == DATA]
    if not told:  # they are on the continuation sheet
        assert any(page.drawing.words("page.moved") in mark.markup for mark in marks)
        return
    below = [sign for mark in marks if mark.name == HEADING for sign in inked(mark)]
    assert max(reach(mark)[2] for mark in told) < A3.fields[2]
    for left, _, right, foot in (sign for mark in told for sign in inked(mark)):
        for start, top, end, _ in below:
            assert right < start or end < left or foot + CLEAR < top


def inked(mark: Text) -> list[tuple[float, float, float, float]]:
    """The left, top, right and bottom of the ink of each sign of a line of text."""
    x = reach(mark)[0]
    return [
        (x + left, mark.y + top, x + right, mark.y + low)
        for left, right, top, low in signs(mark.markup, mark.height)
    ]


@pytest.mark.parametrize(
    ("lanes", "expected"), [(12.0, {""}), (5.0, {"senses"})], ids=["arrows", "words"]
)
def test_a_sense_that_finds_no_room_is_told_at_the_foot(lanes, expected):
    """A field full of lines, so many mm apart: arrows between them, or words in the last lane."""
    page = drawn("four-bar-crank-rocker", None, "velocity")
    assert len(list(senses(page))) == 2
    left, top, right, low = page.layout.mechanism.rect
    count = int((low - top - 8) / lanes)
    heights = (top + i * lanes for i in range(count + 1))
    lines = [LineMark(left, height, right, height, "link") for height in heights]
    signs = mechanism_signs(page.drawing, page.layout.mechanism, lines)
    said = [mark for mark in signs if isinstance(mark, Text)]
    assert {mark.name for mark in said} == expected
    for mark in said:
        assert not any(shapely.box(*reach(mark)).intersects(outline(line)) for line in lines)
    if expected == {"senses"}:
        assert [plain(m.markup) for m in said] == ["ω2: clockwise; ω3: counter-clockwise"]


def test_a_long_letter_stands_beside_an_arrow_that_is_small():
    """Its box is then not so high as the circle about it; that of a short letter stays one."""
    page = drawn("four-bar-crank-rocker", None, "velocity")
    short, long = (sign_of(page.drawing, name) for name in ("2", "connectingrod"))
    assert short.aside == short
    assert long.aside.half[1] < long.half[1] / 3
    arc, _, text = long.aside.put(Space([], (0, 0, 100, 100)), (50, 50), 1.0)
    (wide, high), (start, above, end, below) = long.aside.half, reach(text)
    assert arc.cx - arc.r == pytest.approx(50 - wide)
    assert arc.cx + arc.r < start and end <= 50 + wide + 0.01
    assert 50 - high - 0.5 < above and below < 50 + high + 0.5


def test_no_task_shows_a_sense_or_the_scale_of_its_plan():
    for kind in kinds_of("six-bar"):
        page = drawn("six-bar", None, kind, "task")
        assert not list(senses(page))
        assert not any(getattr(mark, "name", "") == "scale" for mark in page.marks["plan"])


@pytest.mark.parametrize(
    ("most", "value"), [(1.0, 1.0), (1.9, 1.0), (2.0, 2.0), (49.0, 20.0), (0.06, 0.05)]
)
def test_the_value_of_a_bar_is_the_largest_round_one(most, value):
    assert round_below(most)[0] == pytest.approx(value)
