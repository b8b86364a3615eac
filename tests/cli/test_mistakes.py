"""Mistakes of newcomers: small scenes from textbooks with one thing written wrongly.

Each message names the place and says how to mend it, so that nobody looks for the fault elsewhere.
"""

from __future__ import annotations

import pytest

from tests.cli.test_bad_input import HEAD, Said, said  # noqa: F401
from tests.scene_files import scene_text

SLOTTED_LEVER = HEAD + scene_text("cli/slotted-lever")
"""Crank and slotted lever with a ram: T. Bevan, The Theory of Machines, chapter 3, example 7."""
TWO_SLIDERS = HEAD + scene_text("cli/two-sliders")
"""A crank that drives two sliders: Khurmi and Gupta, Theory of Machines, example 8.6."""
EPICYCLIC = HEAD + scene_text("cli/epicyclic")
"""An epicyclic pair: Khurmi and Gupta, Theory of Machines, example 13.4."""
ROCKER = HEAD + scene_text("cli/rocker")
YOKE = HEAD + scene_text("cli/yoke")


def changed(text: str, *changes: tuple[str, str]) -> str:
    """A scene with pieces of its text written otherwise; each piece must be there."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


@pytest.mark.parametrize("text", [SLOTTED_LEVER, TWO_SLIDERS, EPICYCLIC, ROCKER, YOKE])
def test_as_the_book_has_them_they_are_in_order(said: Said, text: str) -> None:  # noqa: F811
    assert said(text, status=0) == ""


GUIDE = 'slides = { on = "lever", along = "O-N" }\n'
ON_LINE = 'slides = { on = 0, through = "O2", angle = 0 }\n'

CASES = {
    # a guide on the wrong link
    "guide on the pinned link": (
        SLOTTED_LEVER,
        [('on = "lever", along = "O-N"', 'on = "crank", along = "C-P"')],
        "links.block.slides.on: link block slides on link crank and is pinned to it at P: it "
        "cannot move against it; expected a link that does not have P",
    ),
    "guide on the pinned link, a link hangs loose": (
        changed(
            SLOTTED_LEVER, ("[links.rod]\nN-R = 6\n", ""), ("[links.ram]\nR", "[links.ram]\nP")
        ),
        [('on = "lever", along = "O-N"', 'on = "crank", along = "C-P"')],
        'did you mean on = "lever"?',
    ),
    "guide on the frame": (
        ROCKER,
        [
            ("[links.4]\nB-C = 150\n[links.5]\nC =", "[links.5]\nA ="),
            (ON_LINE, ON_LINE),
            ("O2-B = 80", "O2-D = 80"),
            ("[links.2]\nA-B = 110\n", ""),
            ('B = "left of A-O2"\n', ""),
        ],
        "only one link has the points D (3); or, if the guide of block 5 lies on link 3, write "
        "on = 3",
    ),
    "guide along the link that slides": (
        SLOTTED_LEVER,
        [(GUIDE, ""), ("O-N = 15", 'O-N = 15\nslides = { on = "block", along = "P-N" }')],
        "links.lever.slides.along: N is a point of link lever, not of link block; expected P; to "
        'slide link block along this link, write slides in link block, with on = "lever"',
    ),
    "guide on a link that makes a group of class III": (
        SLOTTED_LEVER,
        [('on = "lever", along = "O-N"', 'on = "rod", along = "N-R"')],
        'branches.block: block = "forward" and ram = "forward" for one group of class III, order '
        '3; expected block = "closure 1", or another number, for the links block, lever, rod, '
        "ram; they close together in several ways; graphkin check lists them; if two of them "
        "should close by themselves, a guide or a pin is on the wrong link",
    ),
    "guide in the rod": (
        ROCKER,
        [(ON_LINE, ""), ("B-C = 150\n", f"B-C = 150\n{ON_LINE}")],
        "links.5: link 5 has the point C alone and no slides: nothing keeps it; expected "
        "slides = { on = …, … } for a block, or a second point for a bar; link 4 has slides: are "
        "they link 5's?",
    ),
    "guide through one coordinate": (
        SLOTTED_LEVER,
        [("[0, 13.75]", "13.75")],
        'links.ram.slides.through: "13.75"; expected the name of a point, "P", or two '
        "coordinates [x, y]",
    ),
    # a block without slides, or none
    "block without slides": (
        SLOTTED_LEVER,
        [(GUIDE, "")],
        "links.block: link block has the point P alone and no slides: nothing keeps it; expected "
        "slides = { on = …, … } for a block, or a second point for a bar",
    ),
    "pin in a slot without a block": (
        SLOTTED_LEVER,
        [
            (f"[links.block]\nP = [0, 0]\n{GUIDE}", ""),
            ("O-N = 15", 'O-N = 15\nO-P = 10.6\nP = "on O-N"'),
            ('block = "forward"\n', ""),
        ],
        "nothing can move; or a block is missing: a pin in a slot is a link of its own",
    ),
    "two links on the same pins": (
        SLOTTED_LEVER,
        [("[links.ram]\nR = [0, 0]", "[links.ram]\nN-R = 6")],
        "nothing can move: link rod and link ram share the pins N and R, so that they are one body",
    ),
    "block on the wrong pin": (
        TWO_SLIDERS,
        [("[links.5]\nD = ", "[links.5]\nC = ")],
        "while 4 hangs on no driver; expected a driver for each freedom; let a driver move link 4 "
        "instead, or add one if link 5 is idle; or a pin is missing: only one link has the points "
        "D (4)",
    ),
    # a side for a way, a way for a side
    "way for a side": (
        ROCKER,
        [('B = "left of A-O2"', '3 = "forward"')],
        'branches.B: is missing, while 3 = "forward" chooses nothing; expected B = "left of A-O2" '
        'or B = "right of A-O2" in place of 3 = "forward"',
    ),
    "side for a way": (
        ROCKER,
        [('5 = "forward"', 'C = "left of B-O2"')],
        'branches.5: is missing, while C = "left of B-O2" chooses nothing; expected 5 = "forward" '
        'or 5 = "backward" in place of C = "left of B-O2"',
    ),
    "way of the other link": (
        SLOTTED_LEVER,
        [('block = "forward"', 'lever = "forward"')],
        'branches.block: is missing, while lever = "forward" chooses nothing; expected '
        'block = "forward" or block = "backward" in place of lever = "forward"',
    ),
    "way for a point": (
        ROCKER,
        [('"left of A-O2"', '"forward"')],
        "branches.B: forward, backward or a closure for point B; expected "
        '"left of P-Q" or "right of P-Q"; P and Q are the outer pins of the two links that B joins',
    ),
    "side for a block": (
        ROCKER,
        [('5 = "forward"', '5 = "left of B-O2"')],
        'branches.5: a side for link 5; expected "forward", "backward", "closure 1"; link 5 '
        'slides or rolls: 5 = "forward" or "backward"; a side is for a pin',
    ),
    "number for a block": (
        ROCKER,
        [('5 = "forward"', '5 = "closure 1"')],
        'branches.5: "closure 1" for a link that slides or rolls; expected "forward" or "backward"',
    ),
    # a branch where there is no choice
    "way of a dyad with two slides": (
        YOKE + '[branches]\n2 = "backward"\n',
        [],
        "branches.2: links 2 and 3 with their slides close in one way only (dyad RPP); expected "
        "no branches; take it out",
    ),
    "way of a gear": (
        EPICYCLIC + '[branches]\nB = "forward"\n',
        [],
        "branches.B: link B follows from its contact in one way only; expected no branches; "
        "take it out",
    ),
    "way of a coupler beside its pin's side": (
        ROCKER,
        [("[branches]\n", '[branches]\n2 = "forward"\n')],
        "branches.2: no group has a choice at link 2; expected branches of 5, B; take it out; the "
        "branch of its group is that of B",
    ),
    # names
    "a letter more": (
        ROCKER,
        [("A-B = 110", "A-Bb = 110")],
        "only one link has the points Bb (2); did you mean B where link 2 has Bb?",
    ),
    "a digit less": (
        ROCKER,
        [("O1-A = 40", "O-A = 40")],
        "did you mean O1 where link 1 has O?",
    ),
    "a nought for a letter": (
        ROCKER,
        [('"left of A-O2"', '"left of A-02"')],
        "02 begins with a zero: did you mean O2, with the letter?",
    ),
    "a side misspelt": (ROCKER, [('"left of', '"lef of')], "did you mean left?"),
    "a way misspelt": (ROCKER, [('"forward"', '"forwards"')], "did you mean forward?"),
    # wheels
    "rolls on the arm": (
        EPICYCLIC,
        [('rolls = { on = "A" }', 'rolls = { on = "C" }')],
        "links.B.rolls: link C has no wheel to roll on; expected a wheel there, or through and "
        'angle for a straight track; did you mean on = "A"?',
    ),
    "an arm too short": (
        EPICYCLIC,
        [("O-P = 81", "O-P = 18")],
        "link C keeps O-P = 18 mm; expected the sum of the radii, O-P = 81 mm",
    ),
}


@pytest.mark.parametrize(("text", "changes", "words"), CASES.values(), ids=CASES)
def test_a_mistake_is_told_where_it_is(
    said: Said,  # noqa: F811
    text: str,
    changes: list[tuple[str, str]],
    words: str,
) -> None:
    found = said(changed(text, *changes))
    assert words in found
    assert len(found.splitlines()) == 1


def test_two_strays_are_told_at_once(said: Said) -> None:  # noqa: F811
    wrong = changed(TWO_SLIDERS, ('3 = "forward"\n5 = ', '2 = "forward"\n4 = '))
    lines = said(wrong).splitlines()
    assert [line.partition(";")[0] for line in lines] == [
        'branches.3: is missing, while 2 = "forward" chooses nothing',
        'branches.5: is missing, while 4 = "forward" chooses nothing',
    ]


@pytest.mark.parametrize(
    "link",
    [
        '[links.6]\nC = [0, 0]\nwheel = { centre = "C", radius = 5 }\n',
        "[links.6]\nC = [0, 0]\n[[drivers]]\nturn = 6\nangle = 0\nspeed = 1\n",
    ],
    ids=["a wheel", "a driven pointer"],
)
def test_a_link_on_one_pin_that_is_kept_otherwise_is_no_block(
    said: Said,  # noqa: F811
    link: str,
) -> None:
    wheel = "wheel" in link
    found = said(changed(ROCKER, ("[[drivers]]", f"{link}[[drivers]]")), status=2 if wheel else 0)
    assert "alone" not in found
