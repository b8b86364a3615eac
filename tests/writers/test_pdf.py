import io
import math
import re

import pypdf
import pytest

from graphkin.drawing.frame import TitleBlock, sheet_frame
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Page, Text
from graphkin.text.errors import PageError
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import number

MM = 72 / 25.4
LINES = tuple(
    LineMark(
        200, 140, 200 + 100 * math.cos(k / 7), 140 + 100 * math.sin(k / 7), "velocity", f"ray {k}"
    )
    for k in range(44)
)
TEXTS = (
    Text(50, 50, "Mișcarea mecanismului: ăâîșț ĂÂÎȘȚ", "label", 3.5),
    Text(50, 60, "*ω*_1 · *a*_{BA}^{ν} ⊥ BA", "label", 3.5),
    Text(50, 70, "αβγδ ε φ τ", "label", 3.5, rotate=20),
)
A3 = Page(420, 297, sheet_frame(TitleBlock(title="Mecanism patrulater")), "Planul", "ro")


def read(*pages, **options):
    return pypdf.PdfReader(io.BytesIO(write_pdf(pages, **options)))


def content(page):
    return read(page).pages[0].get_contents().get_data().decode("latin-1")


def places(code, pattern):
    """Give the numbers of each match in mm on the page, y down."""
    for match in re.finditer(pattern, code):
        values = [float(value) / MM for value in match[0].split() if value[-1].isdigit()]
        yield [297 - value if i % 2 else value for i, value in enumerate(values)]


def test_lines_come_back_to_two_thousandths_of_a_millimetre_and_equal_the_svg():
    found = list(places(content(Page(420, 297, LINES)), r"\S+ \S+\nm\n\S+ \S+\nl\nS"))
    assert len(found) == len(LINES)
    for line, read_back in zip(LINES, found, strict=True):
        wanted = [line.x1, line.y1, line.x2, line.y2]
        assert read_back == pytest.approx(wanted, abs=0.002)
        assert read_back == pytest.approx([float(number(value)) for value in wanted], abs=0.002)


@pytest.mark.parametrize(
    "mark", [CircleMark(200, 140, 130, "compass"), Arc(200, 140, 99, 20, -170, "compass")]
)
def test_curves_leave_their_circle_by_less_than_two_thousandths(mark):
    code = content(Page(420, 297, (mark,)))
    (start,) = places(code, r"\S+ \S+\nm")
    here = start
    worst = 0.0
    for four in places(code, r"\S+ \S+\n\S+ \S+\n\S+ \S+\nc"):
        knots = [here, four[:2], four[2:4], four[4:]]
        for t in (0.1, 0.211, 0.5, 0.789, 1.0):
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
            x, y = (sum(w * k[i] for w, k in zip(weights, knots, strict=True)) for i in (0, 1))
            worst = max(worst, abs(math.hypot(x - mark.cx, y - mark.cy) - mark.r))
        here = knots[3]
    assert worst < 0.002
    if isinstance(mark, Arc):
        assert here == pytest.approx(mark.at(mark.end), abs=0.002)


def test_texts_stand_where_the_page_says():
    code = content(Page(420, 297, TEXTS[:1]))
    ((_, _, _, _, x, y),) = (
        [float(value) for value in match[0].split()[:6]]
        for match in re.finditer(r"1 0 0 1 \S+ \S+ Tm", code)
        for match in [re.match(r"(\S+ ){6}", match[0])]
    )
    assert (x / MM, 297 - y / MM) == pytest.approx((50, 50), abs=0.002)


def test_the_print_is_not_scaled_and_the_document_is_named():
    reader = read(A3, title="Foaia 1")
    assert reader.trailer["/Root"]["/ViewerPreferences"]["/PrintScaling"] == "/None"
    assert reader.trailer["/Root"]["/Lang"] == "ro"
    assert reader.metadata.title == "Foaia 1"


def test_a_page_that_cannot_be_drawn_is_refused():
    with pytest.raises(PageError):
        write_pdf([Page(420, 297, (LineMark(0, 0, 500, 1, "link", "too long"),))])
