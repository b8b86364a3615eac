"""The same in a real browser: what the page's own JavaScript writes, beside Python's drawing."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from itertools import combinations, product
from typing import Any

import pytest

from graphkin.construction.tape.emitted import MATH, runner, script_source
from graphkin.construction.tape.graph import Graph
from graphkin.drawing.marks import LineMark
from tests.web.test_moving import LIMIT, fields, page_of
from tests.web.written import ran, read, signed

SCENES = (
    "pump",
    "slotted-lever",
    "gears-ring",
    "gears-rack",
    "oscillating-slide",
    "rapid-return",
    "trammel",
    "excavator-relative",
)
"""Cranks, slides, gears, a rack, a group of class III, a driver that slides, a law of time."""
PLACES = (0.04, 0.2, 0.36, 0.52, 0.68, 0.84, 0.97)
RAN: dict[str, list[dict[str, Any]]] = {}
"""What the page of each scene did, once it has run."""
LARGER = """([source, x, times]) => {
  const motion = new Function(source + ';return graphkinMotion')();
  return [undefined, times].map((asked) => {
    const marks = {};
    motion.set(x, (id) => ({
      setAttribute: (name, value) => { (marks[id] = marks[id] || {})[name] = value; },
      removeAttribute: () => { marks[id] = marks[id] || {}; },
    }), asked);
    return marks;
  });
}"""
LABELS = """([source, x, sheet, side]) => {
  const motion = new Function(source + ';return graphkinMotion')();
  motion.read(0, x);
  return motion.labels(sheet, side).map(({ id, half, spots }) => [id, half, spots]);
}"""
"""The id of each label of a field, half its size, and where it may stand, its own place first."""
DRAWN = """([source, svg, x]) => {
  document.body.innerHTML = svg;
  const motion = new Function(source + ';return graphkinMotion')();
  motion.set(x, (id) => document.getElementById(id));
  const made = [...document.querySelectorAll('[id$=h]')];
  return made.map((mark) => [mark.id, mark.tagName, mark.getAttribute('class'),
    mark.previousElementSibling.id, mark.getAttribute('data-step'), mark.namespaceURI]);
}"""


def everywhere(page: Any, name: str) -> list[tuple[float, dict[str, Any]]]:
    """Some places within the range of a scene, that where it stands first, each with what the page
    does there; run once."""
    reach, driven = page_of(name)[1].reach, page_of(name)[1].driven
    places = [driven.start, *(reach.low + share * (reach.high - reach.low) for share in PLACES)]
    if name not in RAN:
        RAN[name] = ran(page, page_of(name)[1], places)
    return [*zip(places, RAN[name], strict=True)]


def texts(name: str, here: dict[str, Any]) -> Iterator[tuple[list[Any], complex]]:
    """The record of each text that shows and moves, and where the page has put its middle."""
    for record in page_of(name)[1].data["marks"]:
        mark_id, kind, *_ = record
        written = here["marks"][mark_id]
        if kind in "tb" and written.get("visibility") != "hidden":
            yield record, complex(*record[7:9]) + complex(*signed(written["transform"]))


@pytest.mark.parametrize("name", SCENES)
def test_a_text_goes_with_what_it_names(page, name):
    """A letter stands in the pose of its body as it was drawn, or just across; one beside a segment
    stays upright, its box as far off as it was drawn."""
    for _, here in everywhere(page, name):
        y = here["y"]
        for (_, kind, _, o, d, along, off, _, _, *box), middle in texts(name, here):
            pose = complex(y[d], y[d + 1])
            place = (middle - complex(y[o], y[o + 1])) / pose
            if kind == "t":
                drawn = complex(along, off)
                assert min(abs(place - drawn), abs(place + drawn)) < LIMIT
            else:
                width, height, room = box
                corners = (complex(u * width, v * height) for u, v in product((-1, 1), repeat=2))
                across = [(place + corner / pose).imag for corner in corners]
                assert place.real == pytest.approx(along, abs=LIMIT)
                assert min(abs(min(across) - room), abs(-max(across) - room)) < LIMIT


@pytest.mark.parametrize("name", ["pump", "slotted-lever", "gears-ring"])
def test_fewer_labels_lie_on_one_another(page, name):
    """Than if each kept its side: at most half as many of all places."""
    before = after = 0
    sides = [*product(range(len(page_of(name)[0])), (0, 1))]
    for x, here in everywhere(page, name)[1:]:
        shown = {record[0]: middle for record, middle in texts(name, here)}
        for sheet, side in sides:
            own = page.evaluate(LABELS, [page_of(name)[1].source, x, sheet, side])
            before += hits([(*spots[0], *half) for _, half, spots in own if spots])
            boxes = [(shown[i].real, shown[i].imag, *half) for i, half, _ in own if i in shown]
            after += hits(boxes)
    assert before > 12 and after < before / 2


def hits(boxes: Sequence[tuple[float, float, float, float]]) -> int:
    """How many pairs of boxes lie on one another by more than half a millimetre."""
    return sum(
        abs(a[0] - b[0]) < a[2] + b[2] - 0.5 and abs(a[1] - b[1]) < a[3] + b[3] - 0.5
        for a, b in combinations(boxes, 2)
    )


@pytest.mark.parametrize("name", ["pump", "slotted-lever", "gears-ring"])
def test_read_outs_and_margins_are_those_of_the_sheet(page, name):
    """Where the scene stands, values and sines are those that the construction has."""
    sheets, _ = page_of(name)
    _, found = everywhere(page, name)[0]
    for sheet in sheets:
        drawing = sheet.drawing
        what, letter = ("omega", "ω") if drawing.kind == "velocity" else ("epsilon", "ε")
        largest = max(abs(v) for v in drawing.all_of(what)) or 1.0
        for link in drawing.scene.links:
            value = drawing.trace.value(what, link)
            if value is not None:
                near = pytest.approx(value, rel=1e-9, abs=1e-8 * largest)
                assert found["values"][f"{letter}{link}"] == near
        for _, step, value in drawing.steps(drawing.plane):
            if step.arrow:
                size = abs(value.tip - value.tail)
                near = pytest.approx(size, rel=1e-9, abs=1e-8 * drawing.largest)
                assert found["values"][step.of.symbol] == near
        for number, sine in drawing.trace.margins.items():
            if str(number) in found["margins"]:
                assert found["margins"][str(number)] == pytest.approx(float(sine), abs=1e-9)


def test_beyond_its_range_nothing_is_touched(page):
    """Past a dead point the marks stay, and the page is told so."""
    reach = page_of("pump")[1].reach
    inside, beyond = ran(page, page_of("pump")[1], [reach.high - 1e-6, reach.high + 0.01])
    assert inside["ok"] and not beyond["ok"]
    assert not beyond["marks"] and not beyond["values"] and not beyond["margins"]


def test_what_is_too_short_where_the_scene_stands_is_made(page):
    """A vector that grows gets its head: a sibling, with the step of its line."""
    sheets, found = page_of("pump")
    assert found.data["more"]
    lines = "".join(
        f'<line id="{i}" data-step="{m.step}"/>'
        for i, m, _, _ in fields(sheets)
        if isinstance(m, LineMark)
    )
    svg = f"<svg>{lines}</svg>"
    x = found.reach.low + 0.7 * (found.reach.high - found.reach.low)
    made = page.evaluate(DRAWN, [found.source, svg, x])
    assert {row[0] for row in made} == set(found.data["more"])
    for mark_id, tag, cls, before, step, space in made:
        line, element, wanted = found.data["more"][mark_id]
        assert (tag, cls, before) == (element, wanted, line)
        assert step.isdigit() and space.endswith("svg")


def test_a_printed_graph_gives_what_numpy_gives(page):
    """Every operation of a graph, with conditions and choices, on numbers of either sign."""
    graph = Graph()
    a, b = graph.input("a"), graph.input("b")
    one = graph.do("add", graph.do("mul", a, b), graph.number(-1.25))
    two = graph.do("sub", graph.do("over", a), graph.do("neg", graph.do("abs", b)))
    three = graph.do("atan2", graph.do("sin", a), graph.do("cos", b))
    four = graph.do("min", graph.do("floor", one), graph.do("max", two, graph.do("sin45", a)))
    near = graph.do("both", graph.do("less", a, b), graph.do("not", graph.do("equal", a, one)))
    either = graph.do("either", near, graph.do("at_most", two, three))
    five = graph.do("choose", either, graph.do("sqrt", graph.do("mul", a, a)), graph.do("neg", a))
    six = graph.do("sub", graph.number(-2.0), graph.do("neg", graph.do("round", two)))
    outputs = [one, two, three, four, near, either, five, six]
    rows = [(0.3, -1.7), (-2.4, 0.9), (5.1, 5.2), (-0.7, -0.6), (1e-3, 7.75)]
    source = MATH + script_source(graph, outputs, {"a": 0, "b": 1}, "run")
    code = "([source, rows]) => { const run = new Function(source + ';return run')();"
    code += " return rows.map((row) => { const y = []; run(row, y); return y; }); }"
    found = page.evaluate(code, [source, rows])
    for row, values in zip(rows, found, strict=True):
        there = runner(graph, outputs)(dict(zip("ab", row, strict=True)))
        assert values == pytest.approx([float(value) for value in there], rel=1e-14)


def test_names_cannot_leave_the_script():
    """What is written into the data as text has no sign that could end a script."""
    source = page_of("pump")[1].source
    text = source[source.index("const data = ") + 13 : source.index(";\nreturn graphkinMoving(")]
    assert "<" not in text and json.loads(text)["name"] == "*φ*"


@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
def test_in_one_field_labels_stand_farther_off_and_heads_are_larger(page, name):
    """What keeps its size on the screen is drawn larger where a field is shown smaller; what is
    constructed stays, and so does every other field."""
    found = page_of(name)[1]
    x = found.reach.low + 0.7 * (found.reach.high - found.reach.low)
    plain, larger = page.evaluate(LARGER, [found.source, x, [[1, 1], [1, 3]]])
    first, off = (found.data["fields"][1][1][name] for name in ("first", "off"))
    heads = letters = 0
    for i, (mark, kind, _, *rest) in enumerate(found.data["marks"]):
        before, after = plain[mark], larger[mark]
        if i < first:
            assert before == after
        elif kind == "h" and "hidden" not in (before.get("visibility"), after.get("visibility")):
            ends = [read(None, written) for written in (before, after)]
            assert ends[0][:2] == ends[1][:2]
            assert long(ends[0]) <= long(ends[1]) <= 3 * long(ends[0]) + LIMIT
            heads += long(ends[1]) > long(ends[0])
        elif kind == "t" and i in off and before.get("transform") and after.get("transform"):
            a, b = rest[2:4]
            shift, farther = (signed(written["transform"]) for written in (before, after))
            more = abs(complex(*shift) - complex(*farther)) / abs(complex(a, b))
            assert min(abs(more - 2), abs(more - 4)) < 0.01  # 4 if it is now on the other side
            letters += 1
        elif kind in "lgfrx":
            assert before == after or i in off
    assert heads and letters


def long(points: Sequence[float]) -> float:
    """The length of an arrowhead."""
    (x, y), (a, b), (c, d) = zip(points[::2], points[1::2], strict=True)
    return abs(complex(x, y) - (complex(a, b) + complex(c, d)) / 2)
