"""What is said of blocks with points beside their first one, and of sides, and where arcs lie."""

from __future__ import annotations

import pytest

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.core.program import plan_vector
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.marks import Arc, reach
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words

NEEDLE = """graphkin = 1
title = "Needle bar with an arc slot"
units = { length = "mm", angle = "deg", speed = "rev/min" }
[frame]
O = [0, 0]
[links.1]
O-A = 15
touches = { on = 2, centres = "A-K", radii = [4, 44], contact = "M", inside = true }
profiles = { about = "A", through = "M", arc = 360 }
[links.2]
N = [0, 0]
K = [40, 0]
profiles = { about = "K", through = "M", arc = 80 }
slides = { on = 0, through = [5, -60], angle = 90 }
[[drivers]]
turn = 1
angle = 60
speed = 900
[branches]
2 = "forward"
[ask]
velocity = ["N"]
"""
CYLINDER = """graphkin = 1
title = "Lifted bar"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
A = [0, 0]
G = [350, 0]
[links.1]
A-H = 800
[links.2]
G = [0, 0]
[links.3]
H = [0, 0]
slides = { on = 2, through = "G", angle = 0 }
[[drivers]]
slide = 3
against = 2
position = 522
speed = 60
[branches]
H = "left of A-G"
[ask]
velocity = ["H"]
omega = [1]
"""
BY_PARTS = """graphkin = 1
title = "Four-bar by parts"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
Q = [200, 120]
[links.1]
O-A = 100
[links.2]
A-M = 60
M-B = 60
M = "on A-B"
[links.3]
Q-B = 100
[[drivers]]
turn = 1
angle = 10
speed = 4
[branches]
B = "left of A-Q"
[ask]
velocity = ["M"]
"""


def velocities(text: str, language: str = "en") -> Drawing:
    mechanism = Mechanism(read_text(text, "made up", None, {}))
    return drawings_of(mechanism, proved(mechanism, mechanism.solve()), words(language))[0]


def told(drawing: Drawing) -> list[str]:
    return [plain(one.markup) for one in sentences(drawing)]


@pytest.mark.parametrize("language, said", [("en", "with K above A"), ("ro", "cu K mai sus de A")])
def test_the_data_tell_which_pin_of_a_block_stands_ahead(language, said):
    """The dyad finds K; the block's first point N stands 0.08 mm lower than A."""
    drawing = velocities(NEEDLE, language)
    assert drawing.positions["N"].imag < drawing.positions["A"].imag < drawing.positions["K"].imag
    (data,) = (plain(each) for each in given(drawing) if "N" in plain(each) and "60" in each)
    assert said in data


@pytest.mark.parametrize("y, shifted", [("0", ""), ("3", "6.00 mm")])
def test_a_guide_is_shifted_only_where_the_pin_stands_beside_it(y, shifted):
    """On the block's own line there is nothing to shift, as the scene writes it."""
    text = NEEDLE.replace("K = [40, 0]", f"K = [40, {y}]")
    drawing = velocities(text)
    (said,) = (one for one in told(drawing) if "it cuts the guide in K" in one)
    assert ("shift it by" in said) is bool(shifted)
    drawn = 1000 * float(y) / (1000 * drawing.scales.kL)
    assert not shifted or f"shift it by {drawn:.2f} mm to the left" in said


def test_a_point_of_a_block_is_laid_off_along_its_guide():
    """N stands 40 mm below K on the guide, which is upright; beside it at an angle."""
    assert "from K lay off KN along the guide of block 2, downwards: N" in told(velocities(NEEDLE))
    aside = told(velocities(NEEDLE.replace("K = [40, 0]", "K = [40, 3]")))
    assert any("from K lay off KN at " in one for one in aside)


@pytest.mark.parametrize("angle", range(0, 360, 30))
def test_the_field_of_the_mechanism_holds_its_profiles(angle):
    """The slot's arc reaches far beyond all pins."""
    drawing = velocities(NEEDLE.replace("angle = 60", f"angle = {angle}"))
    page = sheet(drawing, "key", "1/1")[0]
    arcs = [mark for mark in page.marks if isinstance(mark, Arc) and mark.cls == "profile"]
    assert arcs
    box = drawing.mechanism_extent()
    assert drawing.stand is not None
    left, top = drawing.stand(complex(box.left, box.top))
    right, bottom = drawing.stand(complex(box.right, box.bottom))
    for arc in arcs:
        x1, y1, x2, y2 = reach(arc)
        assert left - 0.01 <= x1 and x2 <= right + 0.01 and top - 0.01 <= y1 and y2 <= bottom + 0.01


def test_a_sentence_tells_the_side_of_the_line_that_the_data_name():
    """The arcs are drawn about G first; the scene says on which side of A to G their pin lies."""
    drawing = velocities(CYLINDER)
    assert "H left of A→G" in map(plain, given(drawing))
    assert any(one.endswith("they meet at H, left of A→G") for one in told(drawing))


def test_a_point_on_a_bar_that_is_given_by_its_parts_is_told_so():
    """M lies on AB; that B lies on AM produced would be true, and is not what the scene says."""
    data = [plain(each) for each in given(velocities(BY_PARTS))]
    assert "M on AB" in data and not [each for each in data if "produced" in each]


def test_a_cylinder_turns_by_the_vector_that_the_plan_shows():
    """One vector, one name: of H about the tube's point G3, over the bar from G3."""
    drawing = velocities(CYLINDER.replace("omega = [1]", "omega = [2]"))
    found = [r for _, section in relations([drawing]) for r in section]
    names = {plain(r.left) for r in found}
    (turning,) = {plain(r.symbols) for r in found if plain(r.left) in ("ω2", "ω3") and r.over}
    vector, over = turning.split("/")
    assert vector in names and over == "G3H"


ROCKER = """graphkin = 1
title = "Rocker produced"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
Q = [120, 0]
[links.1]
O-A = 40
[links.2]
A-B = 110
A-D = 30
D = "on A-B"
[links.3]
Q-B = 80
Q-C = 60
C = "beyond Q on Q-B"
Q-E = 70
B-E = 60
E = "left of Q-B"
[[drivers]]
turn = 1
angle = 60
speed = 4
[branches]
B = "left of A-Q"
[ask]
velocity = ["C", "D", "E"]
"""


def test_images_on_one_ray_of_a_rocker_are_not_joined():
    """Nobody needs v_CB beside v_C and v_B; v_EB is needed, and on the coupler both move."""
    drawing = velocities(ROCKER)
    found = (plan_vector(step) for _, step, _ in drawing.steps(drawing.plane))
    symbols = {vector.symbol for vector in found if vector}
    assert {"v_B", "v_C", "v_D", "v_DA", "v_E", "v_EB"} <= symbols and "v_CB" not in symbols
