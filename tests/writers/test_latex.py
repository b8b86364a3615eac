"""The drawings and relations as LaTeX: read again by parsers that share nothing with the writer."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree import ElementTree

import pytest
from matplotlib.mathtext import MathTextParser

from graphkin.documents.sheet_documents import calculation_text, hand_out
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Page, Text, polygon
from graphkin.drawing.richtext import TextPiece
from graphkin.mechanism import load
from graphkin.writers.latex import formula_of, latex, write_tikz
from graphkin.writers.svg import write_svg

PLACE = re.compile(r"\((-?[\d.]+),(-?[\d.]+)\)")
FORMULA = re.compile(r"\$([^$]*)\$|\\\[(.*?)\\\]")


def formulas(text: str) -> Iterator[str]:
    """The formulas of a document, with what matplotlib does not know put in its terms."""
    for found in FORMULA.finditer(text):
        said = found[1] or found[2]
        said = re.sub(r"\\(underline|underset\{\})", "", said)
        yield re.sub(r"\\text\b", r"\\mathrm", said)


@pytest.mark.parametrize(
    ("markup", "expected"),
    [
        ("*v*_{BA} = 11,06 m/s", r"$v_{\mathrm{BA}} = 11{,}06 $ m/s"),
        ("*a*_{B}^{ν}", r"$a_{\mathrm{B}}^{\nu }$"),
        ("*ω*_1^2·*O*_{1}*A*", r"$\omega _{1}^{2}\cdot O_{1}A$"),
        ("*B*″_{BA}", r"$B_{\mathrm{BA}}^{\prime\prime}$"),
        (r"fifty % & more\_", r"fifty \% \& more\_"),
        ("the *x* axis", "the $x$ axis"),
        ("1: links 2, 3 (RRR)", "$1$: links $ 2$, $3$ (RRR$)$"),
        ("2 : membre 1", "$2$ : membre $ 1$"),
    ],
)
def test_markup_is_text_with_mathematics(markup: str, expected: str) -> None:
    assert re.sub(r"\s+", " ", latex(markup)) == expected


@pytest.mark.parametrize(("name", "language"), [("pump", "ro"), ("shaper", "en"), ("pump", "it")])
def test_every_formula_of_a_calculation_is_one_that_another_parser_reads(name, language):
    text = calculation_text(load(name), language=language)
    assert text.count("{") == text.count("}") and text.count(r"\[") == text.count(r"\]") > 1
    parser, found = (
        MathTextParser("path"),
        [*formulas(re.sub(r"\\underset\{.*?\}(?=\{)", "", text))],
    )
    assert len(found) > 40
    for formula in found:
        if formula.strip():
            parser.parse(f"${formula}$")


def test_the_relations_have_the_numbers_of_the_calculation_page():
    mechanism = load("pump")
    pages = next(part for part in hand_out(mechanism) if part.kind == "calculation").pages
    printed = {
        mark.markup
        for page in pages
        for mark in page.marks
        if isinstance(mark, Text) and re.fullmatch(r"\(\d+\)", mark.markup)
    }
    text = calculation_text(mechanism)
    assert {f"({n})" for n in re.findall(r"\\hfill \((\d+)\)", text)} == printed
    task = calculation_text(mechanism, "task")
    assert r"\dotfill" in task and "underline" not in task


def test_lines_of_a_picture_are_where_the_svg_has_them():
    (first, *_) = next(part for part in hand_out(load("pump")) if part.kind == "velocity").pages
    root = ElementTree.fromstring(write_svg(first))
    left, top, right, low = first.drawn
    lines = set()
    for each in root.iter("{http://www.w3.org/2000/svg}line"):
        ends = tuple(float(each.get(side)) for side in ("x1", "y1", "x2", "y2"))
        across, down = ends[::2], ends[1::2]
        if left <= min(across) and max(across) <= right and top <= min(down) and max(down) <= low:
            lines.add(ends)
    written = {
        tuple(float(number) for place in PLACE.findall(line) for number in place)
        for line in write_tikz(first).splitlines()
        if line.startswith(r"\path") and "arc" not in line and line.count(" -- ") == 1
    }
    assert len(lines) > 40
    assert written == lines


def test_circles_arcs_and_texts_keep_their_places():
    marks = (
        CircleMark(30, 40, 2, "pin"),
        Arc(50, 50, 10, 20, 110, "construction"),
        LineMark(1, 2, 3, 4, "link"),
        polygon(((1, 1), (5, 1), (5, 5)), "plate"),
        Text(60, 70, "*A*", "label", 2.5, "middle", rotate=30),
        LineMark(150, 2, 160, 4, "frame"),
    )
    text = write_tikz(Page(200, 100, marks, drawn=(0, 0, 100, 100)))
    assert "(30,40) circle[radius=2]" in text
    start = marks[1].at(20)
    assert f"({start[0]:.4f},{start[1]:.4f}) arc[start angle=-20.0000, end angle=-110.0000" in text
    assert "rotate=30" in text and "at (60,70) {$A$}" in text
    assert "(150,2)" not in text  # the frame is not part of the drawings
    assert text.count(r"\path") == 4


def test_a_prime_within_a_phrase_is_a_superscript():
    """TeX sets a prime on the line of its letter as a large stroke."""
    parts = [TextPiece("b′ ", True, 0), TextPiece("o", True, 0)]
    assert formula_of(parts).startswith(r"b^{\prime}")
