import os
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from graphkin.drawing.marks import Arc, CircleMark, LineMark, Page, Polyline, Text, polygon
from graphkin.text.errors import PageError
from graphkin.writers.svg import number, write_svg

NS = "{http://www.w3.org/2000/svg}"
MARKS = (
    LineMark(10.12345, 20, 30.5, 40.00004, "velocity", "v_A & co", 3),
    Polyline(((1, 2), (3, 4.25), (5, 6)), "construction"),
    polygon(((50, 50), (60, 50), (55, 60)), "arrowhead velocity", step=0),
    CircleMark(100, 100, 2, "pin"),
    Arc(100, 100, 20, 30, -60, "sense velocity"),
    Text(200, 100, "*a*_{BA}^{ν} < 3", "label acceleration", 3.5, "middle", "text", 2, 30),
    Text(200, 150, "așa", "label"),
)
PAGE = Page(420, 297, MARKS, "Planul vitezelor: ă & ț", "ro")


def read(page=PAGE, **options):
    return ElementTree.fromstring(write_svg(page, **options).encode())


def test_lines_come_back_to_a_ten_thousandth_of_a_millimetre():
    line = read().find(f"{NS}line")
    found = [float(line.get(key)) for key in ("x1", "y1", "x2", "y2")]
    assert found == pytest.approx([10.12345, 20, 30.5, 40.00004], abs=1e-4)
    assert line.get("y1") == "20"


@pytest.mark.parametrize(
    ("value", "text"), [(-0.00001, "0"), (-0.0, "0"), (-1.5, "-1.5"), (20.0, "20")]
)
def test_numbers_have_no_needless_zeros_and_zero_no_sign(value, text):
    assert number(value) == text


def test_what_has_no_width_is_not_stroked():
    assert "circle.qr{fill:#000000;stroke:none}" in write_svg(
        Page(9, 9, (CircleMark(4, 4, 1, "qr"),))
    )


def test_every_run_has_its_own_place_and_the_words_can_be_searched():
    first, second = read().findall(f"{NS}text")
    assert "".join(first.itertext()) == "aBAν < 3"
    assert all(span.get("x") and span.get("y") for span in first)
    assert (second.text, second.get("x"), second.get("y")) == ("așa", "200", "150")


def test_an_arc_runs_clockwise_when_its_end_is_less_than_its_start():
    paths = read().find(f"{NS}path").get("d")
    assert paths == "M117.3205 90A20 20 0 0 1 110 117.3205"


def test_fonts_are_embedded_only_where_used():
    assert write_svg(PAGE).count("@font-face") == 2
    assert write_svg(Page(420, 297, MARKS[-1:])).count("@font-face") == 1


def test_a_page_that_cannot_be_drawn_is_refused():
    with pytest.raises(PageError):
        write_svg(Page(420, 297, (LineMark(1, 1, float("nan"), 2, "link"),)))


def test_two_processes_write_the_same_bytes():
    code = (
        "from graphkin.drawing.frame import *\n"
        "from graphkin.drawing.marks import *\n"
        "from graphkin.writers.svg import write_svg\n"
        "marks = sheet_frame(TitleBlock(title='Mecanism'))\n"
        "marks += (Text(50, 50, '*a*_{BA}^{ν}', 'label velocity', name='a'),)\n"
        "print(write_svg(Page(420, 297, marks, 't', 'ro')))\n"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", code],
            env=os.environ
            | {
                "PYTHONHASHSEED": seed,
                "PYTHONPATH": os.pathsep.join(sys.path),
                "PYTHONIOENCODING": "utf-8",
            },
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(found) == 1


def test_laying_out_needs_no_heavy_library():
    code = (
        "import sys, graphkin.drawing.marks, graphkin.drawing.style, graphkin.drawing.richtext\n"
        "print([m for m in ('numpy', 'reportlab', 'svgwrite') if m in sys.modules])"
    )
    env = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, check=True)
    assert done.stdout.strip() == b"[]"
