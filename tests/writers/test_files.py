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

from graphkin.construction.core.naming import TINY
from graphkin.construction.core.program import Plane
from graphkin.construction.normal_component import NormalComponent
from graphkin.drawing.marks import LineMark
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
    times = scales.times(drawing.kind)
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
            found["mechanism", f"{quantity[0]}_{point}"] = (tail, tail + 1000 * motion / k / times)
    for _, step, value in drawing.steps(Plane.NUMBERS):
        if isinstance(step.of, NormalComponent) and step.role == "vector":
            p, q, index = step.of.p, step.of.q, step.of.index
            tail = 1000 * (drawing.positions[q] - start) / kL
            relative = drawing.trace.value("velocity", q) - drawing.trace.value("velocity", p)
            found["mechanism", f"v_{index}"] = (tail, tail + 1000 * relative / kv / scales.larger)
            found["mechanism", f"a_{index}^ν"] = (tail, tail + 1000 * value / ka / times)
    return found


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
        long = [s for s, v in normals if 1000 * abs(v) / drawing.scales.ka >= TINY]
        triangles = [component for component in long if not component.is_hidden(drawing)]
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
from graphkin.writers.dxf import write_dxf
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg
for view in ("key", "task"):
    for sheet in hand_out(load("pump-collinear", n=7), view):
        single = (write(page) for page in sheet.pages for write in (write_svg, write_dxf))
        for data in (*single, write_pdf(sheet.pages)):
            data = data.encode() if isinstance(data, str) else data
            print(sheet.kind, hashlib.sha256(data).hexdigest())
"""


def test_two_processes_write_the_same_bytes():
    runs = []
    for seed in ("0", "12345"):
        around = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONHASHSEED": seed}
        command = [sys.executable, "-c", BYTES]
        runs.append(subprocess.Popen(command, env=around, stdout=subprocess.PIPE))
    first, second = (run.communicate()[0] for run in runs)
    assert len(first.splitlines()) >= 12
    assert first == second
