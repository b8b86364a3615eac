"""Every sheet of both shipped labs and of other mechanisms can be read: nothing on anything."""

from __future__ import annotations

from collections import Counter
from math import hypot

import numpy as np
import pytest
import shapely

from graphkin.errors import PageError
from graphkin.paper.marks import Circle, Line, Mark, Polyline, Text, reach
from graphkin.paper.symbolic import symbol
from graphkin.paper.symbols import SHORT
from tests.paper.sheet_tools import (
    EVERY,
    KINDS,
    OTHERS,
    PAPER,
    Drawn,
    attempt,
    drawn,
    half_width,
    is_label,
    is_vector,
    kind_of,
    labels_of,
    length_of,
    named,
    outline,
    told,
    within,
)

FIELDS = ("mechanism", "plan")
FRAME = (20.0, 10.0, 410.0, 287.0)
HEAD = 0.45
"""Longest arrowhead, in parts of its vector."""
TINY = 0.5
"""Vectors shorter than this, in mm, are named at the foot of their field."""
NEAR = 6.0
"""Farthest a label without a leader stands from what it names, in mm."""
INSIDE = 1.0
"""Farthest a leader ends from the line it leads to: within a pin, or at a centre's cross, in mm."""
RAY = 20.0
"""How much of the ray to a centre off its field the centre's name belongs to, in mm."""
OFF = (0.8, 1.6)
"""Farthest a leader begins from its text, or from the corner of the box around a ring, in mm."""

SHEETS = [(lab, n, kind) for lab, n in EVERY for kind in KINDS]
SHEETS += [(name, None, kind) for name in OTHERS for kind in KINDS]


@pytest.fixture(params=SHEETS, ids=named)
def page(request) -> Drawn:
    _, made = attempt(*request.param, "key", "en")
    if isinstance(made, PageError):
        pytest.skip("another test says that this sheet cannot be made")
    return drawn(*request.param)


@pytest.mark.parametrize("which", SHEETS, ids=named)
def test_every_sheet_can_be_made_or_another_scene_is_clearly_refused(which):
    _, made = attempt(*which, "key", "en")
    shipped = which[0] not in OTHERS
    if isinstance(made, PageError):
        assert not shipped and "does not fit" in str(made), made


def test_no_label_touches_a_line_or_another_text(page):
    inked = [mark for mark in page.page.marks if not isinstance(mark, Text) and half_width(mark)]
    inked += [mark for mark in page.page.marks if kind_of(mark) == "arrowhead"]
    edges = np.array([outline(mark) for mark in inked])
    widths = np.array([half_width(mark) for mark in inked])
    labels = labels_of(page.page.marks)
    boxes = np.array([label.ink() for label in labels])
    tree = shapely.STRtree(edges)
    which, what = tree.query(boxes, predicate="dwithin", distance=widths.max())
    close = shapely.distance(boxes[which], edges[what]) <= widths[what]
    faults = [
        f"{told(labels[i].text)} on {told(inked[j])}"
        for i, j in zip(which[close], what[close], strict=True)
        if inked[j] not in (labels[i].leader, labels[i].ring)
    ]
    others = [mark for mark in page.page.marks if isinstance(mark, Text)]
    areas = np.array([shapely.box(*reach(mark)) for mark in others])
    which, what = shapely.STRtree(areas).query(boxes, predicate="intersects")
    faults += [
        f"{told(labels[i].text)} on {told(others[j])}"
        for i, j in zip(which, what, strict=True)
        if labels[i].text is not others[j]
    ]
    assert not faults, "\n".join(faults)


def test_nothing_leaves_the_frame_or_its_field(page):
    faults = [
        told(mark)
        for mark in page.page.marks
        if kind_of(mark) not in ("frame", "border", "field") and not within(mark, FRAME)
    ]
    faults += [
        f"{field}: {told(mark)}"
        for field in FIELDS
        for mark in page.marks[field]
        if not within(mark, page.rect(field))
    ]
    assert not faults, "\n".join(faults)


def test_every_vector_point_and_pin_has_one_label_that_says_its_name(page):
    faults = []
    for field in FIELDS:
        subjects = named_marks(page, field)
        assert subjects
        faults += [f"{field}: {told(mark)} has no name" for mark in subjects if not mark.name]
        counts = Counter(mark.name for mark in subjects)
        faults += [f"{field}: {name} is there {k} times" for name, k in counts.items() if k > 1]
        labels: dict[str, list[str]] = {}
        for label in page.labels(field):
            said = page.meaning(field, label).split(" ≡ ")
            for name, word in zip(label.names(), said, strict=True):
                labels.setdefault(name, []).append(word)
        for mark in subjects:
            said, names = labels.get(mark.name, []), names_of(page, mark)
            noted = any(name in page.notes(field) for name in names)
            tiny = is_vector(mark) and length_of(mark) < TINY and noted
            if not tiny and (len(said) != 1 or said[0] not in names):
                faults.append(f"{field}: {told(mark)} is named {said}")
    assert not faults, "\n".join(faults)


def named_marks(page: Drawn, field: str) -> list[Mark]:
    """The vectors, points, poles, pins and centres of a field."""
    circles = ("point", "pole", "pin", "centre")
    return [
        mark
        for mark in page.marks[field]
        if is_vector(mark)
        or (isinstance(mark, Circle) and kind_of(mark) in circles and "inset" not in mark.cls)
    ]


def names_of(page: Drawn, mark: Mark) -> set[str]:
    """The markups that a mark may be called by."""
    names = {symbol(mark.name), symbol(mark.name.partition("_")[0])}
    if mark.step is not None and is_vector(mark):
        said = page.drawing.trace.program.steps[mark.step].says
        names = {symbol(said["symbol"])} if "symbol" in said else {symbol(mark.name)}
    return names


def test_every_link_has_its_number_in_a_ring(page):
    links = page.drawing.scene.links
    rings = [label for label in page.labels("mechanism") if label.ring]
    found = Counter(label.text.markup for label in rings)
    assert found == Counter(list(links)), found
    assert all(label.text.name == label.text.markup for label in rings)


def test_every_label_stands_by_what_it_names_or_leads_to_it(page):
    faults = []
    for field in FIELDS:
        subjects = [
            mark
            for mark in page.marks[field]
            if mark.name and not isinstance(mark, Text) and not is_label(mark)
        ]
        for label in page.labels(field):
            own = [outline(mark) for mark in subjects if mark.name in label.names()]
            if not own:
                continue
            near = shapely.union_all(own)
            if label.leader:
                end = shapely.Point(label.leader.x2, label.leader.y2)
                start = shapely.Point(label.leader.x1, label.leader.y1)
                off = OFF[label.ring is not None]
                if end.distance(near) > INSIDE or start.distance(label.ink()) > off:
                    faults.append(f"the leader of {told(label.text)} leads elsewhere")
            elif label.ink().distance(near) > NEAR + RAY * is_far(page, field, label.text.name):
                faults.append(f"{told(label.text)} stands apart")
    assert not faults, "\n".join(faults)


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


def misfits(line: Line, head: Polyline) -> list[str]:
    """Why a head does not belong to its line."""
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
    return found
