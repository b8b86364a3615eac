"""The files say what the trace says: true size, true ends, names, the same bytes every time."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path
from xml.etree import ElementTree as ET

import pypdf
import pytest

from graphkin.construction.core.program import Plane
from graphkin.construction.core.too_short import TINY
from graphkin.construction.normal_component.normal_component import NormalComponent
from graphkin.drawing.marks import LineMark, Text
from graphkin.numbers.plane import Vector
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg
from tests.documents.sheet_tools import (
    KINDS,
    OTHERS,
    VECTORS,
    Drawn,
    both,
    calculations,
    drawn,
    kind_of,
    named,
)
from tests.mechanisms import SHIPPED

ROOT = Path(__file__).resolve().parents[2]
MM = 72 / 25.4
TRUE = 0.01
"""Farthest a line in a file may lie from where it should, in mm."""
SVG = "{http://www.w3.org/2000/svg}"

WHICH = [(lab, n, kind) for lab in SHIPPED for n in (7,) for kind in KINDS]
WHICH += [(name, None, kind) for name in list(OTHERS)[1:3] for kind in KINDS]


@pytest.fixture(params=WHICH, ids=named)
def page(request) -> Drawn:
    return drawn(*request.param)


@cache
def tree_of(page: Drawn) -> ET.Element:
    """The SVG file of a sheet, read again."""
    return ET.fromstring(write_svg(page.page))


def elements(tree: ET.Element) -> list[ET.Element]:
    """The elements of the marks: texts, lines, circles, polygons, paths."""
    kinds = ("line", "circle", "polyline", "polygon", "path", "text")
    return [e for e in tree if e.tag in {SVG + kind for kind in kinds}]


def ends(element: ET.Element) -> tuple[complex, complex]:
    """Both ends of a line in mm, y up."""
    x1, y1, x2, y2 = (float(element.get(key, "nan")) for key in ("x1", "y1", "x2", "y2"))
    return complex(x1, -y1), complex(x2, -y2)


def centre(tree: ET.Element, cls: str, name: str) -> complex:
    """The middle of the only circle of a class and name, in mm, y up."""
    (found,) = (
        e
        for e in tree.iter(f"{SVG}circle")
        if e.get("class", "").split()[0] == cls and e.get("data-name") == name
    )
    return complex(float(found.get("cx", "nan")), -float(found.get("cy", "nan")))


def expected_vectors(page: Drawn) -> dict[tuple[str, str], tuple[complex, complex]]:
    """Tail and tip of each vector as the trace and the scales give them, from pole or first pin.

    In mm, y up; keyed by field and name.
    """
    drawing, scales = page.drawing, page.drawing.scales
    kL, kv, ka = scales.kL, scales.kv, scales.ka
    k = kv if drawing.kind == "velocity" else ka
    origin = next(iter(drawing.scene.frame.points))
    found = {}
    for _, step, value in drawing.steps(drawing.plane):
        if isinstance(value, Vector):
            found["plan", step.name] = (1000 * value.tail / k, 1000 * value.tip / k)
    start = drawing.positions[origin]
    for point, here in drawing.positions.items():
        quantity = "velocity" if drawing.kind == "velocity" else "acceleration"
        motion = drawing.trace.value(quantity, point)
        tail = 1000 * (here - start) / kL
        if motion is not None:
            found["mechanism", f"{quantity[0]}_{point}"] = (tail, tail + 1000 * motion / k)
    for _, step, value in drawing.steps(Plane.NUMBERS):
        if isinstance(step.of, NormalComponent) and step.role == "vector":
            p, q, index = step.of.p, step.of.q, step.of.index
            tail = 1000 * (drawing.positions[q] - start) / kL
            relative = drawing.trace.value("velocity", q) - drawing.trace.value("velocity", p)
            found["mechanism", f"v_{index}"] = (tail, tail + 1000 * relative / kv)
            found["mechanism", f"a_{index}^ν"] = (tail, tail + 1000 * value / ka)
    return found


def test_the_svg_is_well_formed_and_has_the_size_of_a3(page):
    tree = tree_of(page)
    assert tree.tag == f"{SVG}svg"
    assert tree.get("width") == "420mm"
    assert tree.get("height") == "297mm"
    assert tree.get("viewBox") == "0 0 420 297"


def test_the_pdf_has_the_size_of_a3(page):
    (sheet,) = pypdf.PdfReader(io.BytesIO(write_pdf([page.page]))).pages
    assert [float(v) / MM for v in sheet.mediabox] == pytest.approx([0, 0, 420, 297], abs=TRUE)
    assert not sheet.get("/Rotate")
    assert sheet.get("/UserUnit", 1) == 1


def test_every_vector_in_the_svg_has_the_ends_that_the_trace_and_the_scales_give(page):
    tree, drawing = tree_of(page), page.drawing
    first = next(iter(drawing.scene.frame.points))
    zero = {
        "plan": centre(tree, "pole", drawing.pole),
        "mechanism": centre(tree, "pin", first),
    }
    wanted = expected_vectors(page)
    border = page.layout.plan.rect[0]
    seen = set()
    for element in tree.iter(f"{SVG}line"):
        classes = element.get("class", "").split()
        if classes[0] not in VECTORS or "detail" in classes:
            continue
        tail, tip = ends(element)
        field = "plan" if tail.real > border else "mechanism"
        key = field, element.get("data-name", "")
        assert key not in seen, key
        seen.add(key)
        for end, true in zip((tail, tip), wanted[key], strict=True):
            assert abs(end - zero[field] - true) <= TRUE, key
        assert abs(abs(tip - tail) - abs(wanted[key][1] - wanted[key][0])) <= TRUE
    assert {name for name in wanted if name[0] == "plan"} <= seen
    if drawing.kind == "acceleration":
        numbers = drawing.steps(Plane.NUMBERS)
        normals = [(s.of, v) for _, s, v in numbers if s.role == "vector"]
        triangles = [s for s, v in normals if 1000 * abs(v) / drawing.scales.ka >= TINY]
        assert normals
        assert {("mechanism", f"v_{s.index}") for s in triangles} <= seen
        assert {("mechanism", f"a_{s.index}^ν") for s in triangles} <= seen


def test_every_line_in_the_pdf_lies_where_the_mark_and_the_svg_have_it(page):
    (sheet,) = pypdf.PdfReader(io.BytesIO(write_pdf([page.page]))).pages
    code = sheet.get_contents().get_data().decode("latin-1")
    path = re.compile(r"(?<![lc\d.])\s(\S+) (\S+)\nm\n(\S+) (\S+)\nl\nS\b")
    found = [tuple(map(float, match.groups())) for match in path.finditer(code)]
    lines = [mark for mark in page.page.marks if isinstance(mark, LineMark)]
    drawn_lines = [ends(e) for e in tree_of(page).iter(f"{SVG}line")]
    assert len(found) == len(lines) == len(drawn_lines)
    assert sum(kind_of(line) in VECTORS for line in lines) >= 4
    for (x1, y1, x2, y2), line, (tail, tip) in zip(found, lines, drawn_lines, strict=True):
        back = [x1 / MM, 297 - y1 / MM, x2 / MM, 297 - y2 / MM]
        assert back == pytest.approx([line.x1, line.y1, line.x2, line.y2], abs=TRUE)
        read = [tail.real, -tail.imag, tip.real, -tip.imag]
        assert read == pytest.approx(back, abs=TRUE)


def test_no_matrix_moves_or_scales_the_lines_of_the_pdf(page):
    (sheet,) = pypdf.PdfReader(io.BytesIO(write_pdf([page.page]))).pages
    code = sheet.get_contents().get_data().decode("latin-1")
    matrices = re.findall(r"((?:\S+ ){6})cm\b", code)
    assert {tuple(map(float, m.split())) for m in matrices} <= {(1, 0, 0, 1, 0, 0)}
    assert not re.search(r"transform=\"(?!rotate)", write_svg(page.page))


def test_every_mark_is_in_the_svg_with_its_class_name_and_step(page):
    found = [
        (e.get("class"), e.get("data-name", ""), e.get("data-step"))
        for e in elements(tree_of(page))
    ]
    wanted = [(m.cls, m.name, None if m.step is None else str(m.step)) for m in page.page.marks]
    assert found == wanted
    assert all(cls for cls, _, _ in found)


def test_every_class_has_a_rule_in_the_style_sheet(page):
    tree = tree_of(page)
    rules = "".join(tree.itertext())
    for element in elements(tree):
        kind, classes = element.tag.removeprefix(SVG), element.get("class", "").split()
        assert f"{kind}.{'.'.join(classes)}{{" in rules


def test_the_points_of_the_plans_and_poles_are_named_in_the_svg():
    velocity, acceleration = (tree_of(sheet) for sheet in both("pump", 7))
    names = {e.get("data-name") for e in elements(velocity)}
    assert {"o", "a", "b", "c", "d", "oa", "ab", "od", "A", "B", "O1", "I3"} <= names
    names = {e.get("data-name") for e in elements(acceleration)}
    prime = "\N{PRIME}"
    assert {f"{letter}{prime}" for letter in "oabcd"} <= names
    assert {f"o{prime}a{prime}", "a_BA^ν", "a_BA^τ", "J3", "J4"} <= names


def test_the_svg_reaches_for_nothing_outside_itself(page):
    text = write_svg(page.page)
    addresses = set(re.findall(r"https?://[^\"'\s<>)]+", text))
    assert addresses <= {
        "http://www.w3.org/2000/svg",
        "http://www.w3.org/1999/xlink",
        "http://www.w3.org/2001/xml-events",
    }
    assert not re.search(r"(?:href|src)\s*=", text)
    assert all(match.startswith("data:") for match in re.findall(r"url\(([^)]*)", text))
    assert not re.search(r"@import|<script|<!ENTITY|<!DOCTYPE", text)


def test_the_pdf_embeds_its_fonts_and_its_text_can_be_searched():
    sheets = [sheet.page for sheet in both("pump", 7, language="ro")]
    pages = pypdf.PdfReader(io.BytesIO(write_pdf([*sheets, *calculations("pump", 7)]))).pages
    for page in pages:
        for font in page["/Resources"]["/Font"].values():
            assert "/FontFile2" in font.get_object()["/FontDescriptor"]
    assert "Planul vitezelor" in pages[0].extract_text()
    assert "Planul accelerațiilor" in pages[1].extract_text()


BYTES = """
import hashlib
from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import load
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg
for view in ("key", "task"):
    for sheet in hand_out(load("pump-collinear", n=7), view):
        for data in (*(write_svg(page).encode() for page in sheet.pages), write_pdf(sheet.pages)):
            print(sheet.kind, hashlib.sha256(data).hexdigest())
"""


def test_two_processes_write_the_same_bytes():
    runs = []
    for seed in ("0", "4711"):
        around = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONHASHSEED": seed}
        command = [sys.executable, "-c", BYTES]
        runs.append(subprocess.Popen(command, env=around, stdout=subprocess.PIPE))
    first, second = (run.communicate()[0] for run in runs)
    assert len(first.splitlines()) >= 12
    assert first == second


def test_no_text_of_a_file_is_lost():
    sheet = drawn("pump", 7, "velocity", "key", "ro")
    tree = tree_of(sheet)
    texts = ["".join(e.itertext()) for e in tree.iter(f"{SVG}text")]
    assert len(texts) == sum(isinstance(mark, Text) for mark in sheet.page.marks)
    assert any("Mecanism de pompă" in text for text in texts)
