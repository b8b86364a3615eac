"""Every sheet of both shipped labs and of other mechanisms can be read: nothing on anything."""

from __future__ import annotations

from collections import Counter
from math import hypot

import numpy as np
import pytest
import shapely

from graphkin.paper.marks import Circle, Line, Polyline, Text, reach
from graphkin.paper.symbols import SHORT
from tests.paper.sheet_tools import (
    EVERY,
    KINDS,
    OTHERS,
    PAPER,
    Drawn,
    drawn,
    half_width,
    is_label,
    is_vector,
    kind_of,
    labels_of,
    length_of,
    outline,
    told,
    within,
)

FIELDS = ("mechanism", "plan")
FRAME = (20.0, 10.0, 410.0, 287.0)
HEAD = 0.45
"""Longest arrowhead, in parts of its vector."""
NEAR = 4.0
"""Farthest a label without a leader stands from what it names, in mm."""

SHEETS = [(lab, n, kind) for lab, n in EVERY for kind in KINDS]
SHEETS += [(name, None, kind) for name in OTHERS for kind in KINDS]


@pytest.fixture(params=SHEETS, ids=lambda p: "-".join(str(part) for part in p if part is not None))
def page(request) -> Drawn:
    return drawn(*request.param)


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
    assert not faults


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
    assert not faults


def test_every_vector_point_and_pin_has_one_label_of_its_name(page):
    faults = []
    for field in FIELDS:
        names = Counter(label.text.name for label in page.labels(field))
        subjects = Counter(
            mark.name
            for mark in page.marks[field]
            if is_vector(mark)
            or (isinstance(mark, Circle) and kind_of(mark) in ("point", "pole", "pin", "centre"))
        )
        assert subjects
        faults += [f"{field}: {name} is there {k} times" for name, k in subjects.items() if k > 1]
        faults += [f"{field}: {names[name]} labels {name}" for name in subjects if names[name] != 1]
        faults += [f"{field}: a mark without a name" for name in subjects if not name]
    assert not faults


def test_every_link_has_its_number_in_a_ring(page):
    links = page.drawing.scene.links
    rings = Counter(label.text.markup for label in page.labels("mechanism") if label.ring)
    assert rings == Counter(links)


def test_every_label_stands_by_what_it_names_or_leads_to_it(page):
    faults = []
    for field in FIELDS:
        subjects = [
            mark
            for mark in page.marks[field]
            if mark.name and not isinstance(mark, Text) and not is_label(mark)
        ]
        for label in page.labels(field):
            own = [outline(mark) for mark in subjects if mark.name == label.text.name]
            if not own:
                continue
            near = shapely.union_all(own)
            if label.leader:
                end = shapely.Point(label.leader.x2, label.leader.y2)
                start = shapely.Point(label.leader.x1, label.leader.y1)
                if end.distance(near) > 0.7 or start.distance(label.ink()) > 0.7:
                    faults.append(f"the leader of {told(label.text)} leads elsewhere")
            elif label.ink().distance(near) > NEAR:
                faults.append(f"{told(label.text)} stands apart")
    assert not faults


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
    assert not faults


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


def test_every_mark_of_a_drawing_has_a_class_that_is_not_of_the_paper(page):
    for field in FIELDS:
        strange = [told(mark) for mark in page.marks[field] if kind_of(mark) in PAPER]
        assert all(" caption " in words for words in strange), strange
