"""Vector equations: each says of every vector what is known, and all that is asked follows."""

import re
from itertools import pairwise

import pytest

from graphkin.construction.core.kind import construction
from graphkin.construction.core.naming import driver_index
from graphkin.construction.core.relation import Term, VectorEquation
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.rolling.wheel_images import RollingNormal
from graphkin.documents.calculation import calculation
from graphkin.documents.relations import of_equations, relations
from graphkin.drawing.marks import LineMark, Text
from graphkin.drawing.symbol_markup import symbol
from graphkin.scene.link_points import lettered, under
from tests.chosen import HALVES
from tests.documents.sheet_tools import drawings
from tests.mechanisms import SHIPPED

SLOTTED = ("shaper", "geneva-wheel", "cam-lever", "plank-hinged", "oscillating-slide")
"""Scenes in which a driven point slides on a link that turns."""
NAMES = dict.fromkeys(
    (*HALVES[0], *SLOTTED, "crank-slot", "platform-3rpr", "geneva-dwell", "cylinders-two")
)
WHICH = [*((name, None) for name in NAMES), *((lab, 7) for lab in SHIPPED)]
VECTOR = re.compile(r"\*[va]\*_\{[^}]*\}(?:\^\{[^}]*\})?")


def equations(drawing) -> list[VectorEquation]:
    """Those of a sheet that sum up vectors."""
    every = (relation.equation for _, relation in of_equations(drawing))
    return [each for each in every if each is not None and each.sums]


def terms_of(equation: VectorEquation) -> list[Term]:
    """All vectors of an equation."""
    return [equation.whole, *(term for terms in equation.sums for term in terms)]


def laid_off(drawing) -> set[str]:
    """The accelerations of points that are laid off by relations of their own: from known ones,
    and of what a driver slides from the pole."""
    steps = drawing.trace.program.steps
    kinds = ((step, construction(step)) for step in steps if step.plane is drawing.plane)
    ends = [
        step.letter.replace("′", "").partition("_")
        for step, kind in kinds
        if isinstance(kind, RollingNormal)
        or (isinstance(kind, DrivenSlide) and steps[kind.start].name == drawing.pole)
    ]
    points = (under(point.upper(), link) if link else point.upper() for point, _, link in ends)
    return {symbol(f"{drawing.vector.letter}_{lettered(point)}") for point in points}


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_lines_say_what_is_known_before_the_equation_is_solved(which):
    """Two lines: size and direction are known; one: direction; none: neither (Artobolevskii).

    Read as a student reads the pages, from their head: known is what a driver gives, what stands in
    a relation or an equation before, and what has both its direction and its size below it.
    """
    both = drawings(*which)
    known = set().union(*map(laid_off, both))
    for _, found in relations(both):
        for relation in found:
            equation = relation.equation
            if equation is None:
                known.update(VECTOR.findall(relation.left))
                continue
            for term in terms_of(equation) if equation.sums else ():
                told = term.known == 2 and any(s in term.note for s in (", ", "·", "= 0"))
                assert (term.known == 2) == (told or term.symbol in known), (term, equation.markup)
                assert bool(term.note) >= (term.known == 1), (term, equation.markup)
            names = [term.symbol for term in terms_of(equation) if equation.sums or term.known == 2]
            known.update(names)
            known.update(name.partition("^")[0] for name in names if re.search(r"\^\{[τr]", name))


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_each_equation_leaves_two_unknowns_for_each_sum(which):
    """Two sizes or directions can be found from one vector equation in the plane, never three.

    That points of contact differ in their accelerations along the common normal only, as is said
    after their equation, is another equation.
    """
    for drawing in drawings(*which):
        found = [relation for _, relation in of_equations(drawing)]
        for relation, after in zip(found, [*found[1:], None], strict=True):
            if relation.equation is None or not relation.equation.sums:
                continue
            touching = after is not None and after.equation is None and not after.symbols
            missing = sum(2 - term.known for term in terms_of(relation.equation))
            assert missing <= 2 * (len(relation.equation.sums) + touching), relation.left


@pytest.mark.parametrize("name", SLOTTED)
def test_a_driven_point_on_a_slotted_link_has_one_equation(name):
    """v_B = v_B3 + v_BB3 and a_B = a_B3^n + a_B3^t + a_BB3^c + a_BB3^r: what is known on the left,
    on the right two sizes are sought (Norton, Design of Machinery, 7.3; Artobolevskii, 4.3)."""
    velocity, acceleration = (
        next(
            each
            for each in equations(drawing)
            if each.whole.known == 2 and any(f"^{{{s}}}" in each.markup for s in signs) == bool(s)
        )
        for drawing, signs, s in zip(drawings(name), ((), ("c",)), ("", "c"), strict=True)
    )
    assert [[term.known for term in terms] for terms in velocity.sums] == [[1, 1]]
    assert [[term.known for term in terms] for terms in acceleration.sums] == [[2, 1, 2, 1]]
    across, along = (term.note for term in velocity.sums[0])
    assert across.startswith("⊥ ")
    assert along.startswith("∥ guide")


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_what_is_half_known_says_how(which):
    for drawing in drawings(*which):
        for each in equations(drawing):
            terms = (each.whole, *(term for some in each.sums for term in some))
            assert all(term.note for term in terms if term.known == 1), each.markup


def test_lines_stand_below_their_vectors_on_keys_and_nowhere_on_tasks():
    both = drawings("pump", 7)
    key, task = (
        [mark for page in calculation(both, view) for mark in page.marks]
        for view in ("key", "task")
    )
    lines = [mark for mark in key if isinstance(mark, LineMark) and mark.name == "known"]
    texts = [mark for mark in key if isinstance(mark, Text) and mark.cls == "caption equation"]
    for line in lines:
        assert any(abs(text.x - line.x1) < 1e-6 and 0 < line.y1 - text.y < 3 for text in texts)
    doubled = sum(a.x1 == b.x1 and b.y1 - a.y1 < 1 for a, b in pairwise(lines))
    known = [term for d in both for each in equations(d) for some in each.sums for term in some]
    assert doubled == sum(term.known == 2 for term in known)
    assert not [mark for mark in task if mark.name == "known"]
    assert [mark for mark in task if mark.name == "vector"]


LED = (
    *("platform-3rpr", "platform-six", "cylinders-two", "slider-crank-slider", "two-loops"),
    *("rod-and-wheel", "roller-plates"),
)
"""Scenes whose drivers slide: alone, in a tube that turns, within a group that is tried."""


@pytest.mark.parametrize("name", LED)
def test_a_vector_that_is_laid_off_is_drawn_from_where_it_begins(name):
    """Its name is that of the arrow there, so one that leads back would have the other sense."""
    (drawing, *_) = drawings(name)
    seen = 0
    for number, step, _ in drawing.steps(drawing.plane):
        kind = construction(step)
        if not isinstance(kind, DrivenSlide):
            continue
        tips = [number, *drawing.children.get(number, ())]
        assert not any((tip, kind.start) in drawing.joins for tip in tips), kind
        seen += 1
    assert seen


@pytest.mark.parametrize("name", LED)
def test_what_a_driver_gives_along_a_guide_is_told_once_and_as_given(name):
    """By its name among the data, with its size: nobody chooses it for a trial plan."""
    both = drawings(name)
    told = [r for _, found in relations(both) for r in found if r.equation is None]
    scene = both[0].scene
    tried = {scene.drivers[-1].link} if name.startswith("platform") else set()
    for driver in scene.drivers:
        if driver.kind == "turn" or driver.link in tried:
            continue
        for letter, rate in (("v", driver.speed), ("a", driver.acceleration)):
            size = abs(float(rate.si(scene.values)))
            if not size:
                continue
            found = [r for r in told if r.symbols == f"*{letter}*_{{{driver_index(driver)}}}"]
            assert [float(r.result) for r in found] == [pytest.approx(size, rel=1e-3)], found
            measured = [r for r in told if r.left == found[0].left and "*k*_" in r.symbols]
            assert tried or not measured  # trial plans are divided, and what they give read off


def test_the_acceleration_of_the_foot_of_a_cylinder_is_told_before_that_of_its_pin():
    """It is the sum of what is laid off for it, of which each has its size and direction."""
    _, drawing = drawings("cylinders-two")
    first, second, _ = equations(drawing)
    for found, name in ((first, "A2"), (second, "D4")):
        (terms,) = found.sums
        index = name + name[0]
        assert found.whole.symbol == symbol(f"a_{name}")
        assert [t.symbol for t in terms] == [symbol(f"a_{index}^{sign}") for sign in "cr"]
        assert [t.known for t in terms] == [2, 2] and symbol(f"v_{name}") in terms[0].note


@pytest.mark.parametrize("name", ["platform-3rpr", "platform-six"])
def test_about_the_foot_of_a_cylinder_one_vector_is_drawn(name):
    """v_EB4, of which ω and the normal component come; v_B4E beside it would be the same again."""
    for drawing in drawings(name):
        assert not any((tip, tail) in drawing.joins for tail, tip in drawing.joins)
