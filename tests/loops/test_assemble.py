"""Mechanisms assembled from nothing, in the closure that the scene states."""

from __future__ import annotations

from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.construction.core.quantities import PointMotion
from graphkin.construction.core.solution import Solution
from graphkin.loops.assemble import assemble, led_by, true_mobility
from graphkin.loops.rigid_bodies import half_angle
from graphkin.loops.witness import compare, examine
from graphkin.scene.model import Closure
from graphkin.text.errors import StructureError, WitnessError
from tests.loops.differences import agree, central, degrees, unit
from tests.loops.loops_alone import by_loops
from tests.scene_files import scene_text

FOUR_BAR = scene_text("loops/four-bar")


@pytest.mark.parametrize("name", ["pump", "pump-collinear"])
def test_the_pump_without_a_position(name, sheet, solved, pump_start):
    scene = sheet(name, n=7)
    found, expected = assemble(scene), solved(scene, **pump_start)
    for mine, its in zip(found.motion.points, expected.motion.points, strict=True):
        assert abs(mine - its).max() < 1e-11 * max(1, abs(its).max())


def test_a_batch_is_assembled_setting_by_setting(sheet):
    n = np.array([1.0, 7.0, 30.0])
    scene = sheet("pump")
    batch = by_loops(scene, {"n": n})
    for i, each in enumerate(n):
        one = by_loops(sheet("pump", n=each))
        assert batch.points["D"].velocity[i] == pytest.approx(one.points["D"].velocity)
    found = examine(scene, batch, {"n": n})
    differences, agrees = found.worst, found.agrees
    assert agrees.all()
    assert differences.max() < 1e-12


@pytest.mark.parametrize(("words", "sign"), [("left", 1), ("right", -1)])
def test_the_side_that_is_stated(words, sign, read):
    motion = assemble(read(FOUR_BAR + f'[branches]\nC = "{words} of B-D"\n')).motion
    b, c, d = (motion.point(name).place[0] for name in "BCD")
    assert abs(c - b) == pytest.approx(3.5)
    assert abs(c - d) == pytest.approx(3)
    assert sign * ((d - b).conjugate() * (c - b)).imag > 0


def test_two_closures_and_no_branch_are_told_with_both(read):
    with pytest.raises(StructureError, match=r"links 2, 3 close in 2 ways") as caught:
        assemble(read(FOUR_BAR))
    assert 'C = "left of B-D"' in str(caught.value)
    assert "closure 2: C (" in str(caught.value)


def test_links_that_nothing_drives_are_named(read):
    with pytest.raises(StructureError, match="nothing determines the motion of links 2, 3"):
        assemble(read(FOUR_BAR.replace("D = [4, 0]\n", "")))


def test_an_unknown_closure_number_is_told_with_those_that_are(read):
    with pytest.raises(WitnessError, match="closure 2") as caught:
        assemble(read(FOUR_BAR + '[branches]\n3 = "closure 5"\n'))
    assert "of which 0 fit" in str(caught.value)


@pytest.mark.parametrize(("number", "sign"), [(1, 1), (2, -1)])
def test_a_rod_of_driven_length_between_two_moving_links(number, sign, read):
    """The law of cosines; neither the barrel nor the rod is joined to anything driven."""

    def place(q):
        along = (q**2 + 16 - 4) / 8
        b = mpmath.mpc(along, sign * mpmath.sqrt(q**2 - along**2))
        near, far = mpmath.mpf("2.5"), mpmath.mpf(1)
        x = (near**2 + 4 - far**2) / 4
        c = 4 + mpmath.mpc(x, mpmath.sqrt(near**2 - x**2)) * (b - 4) / 2
        return {"B": b, "C": c}

    scene = read(scene_text("loops/cylinder").replace("NUMBER", str(number)))
    motion = assemble(scene).motion
    laws = [(mpmath.mpf("3.5"), mpmath.mpf("0.8"), mpmath.mpf("-1.7"))]
    agree(motion, central(place, laws))
    assert true_mobility(scene) == 1
    assert compare(scene, by_loops(scene)).agrees


def test_a_crank_driven_against_another_moving_link(read):
    """The angle at B is driven: the two bars are one of length f, then the law of cosines."""
    scene = read(scene_text("loops/relative"))
    motion = assemble(scene).motion

    def place(bend):
        base = mpmath.mpf(3) / 2 + mpmath.mpf(7) / 2 * unit(bend)
        far = abs(base)
        x = (far**2 + 16 - 9) / 8
        best = None
        for sign in (1, -1):
            c = mpmath.mpc(x, sign * mpmath.sqrt(far**2 - x**2))
            turned = mpmath.arg(c / base) % (2 * mpmath.pi)
            if best is None or turned < best[0]:
                best = turned, {"B": mpmath.mpf(3) / 2 * c / base, "C": c}
        return best[1]

    agree(motion, central(place, [(degrees(-50), 2, 1)]))


def test_what_no_position_tells_is_assembled_and_said(read):
    """A solution of the coupler's velocity alone is held against the stated closure."""
    for words in ("left", "right"):
        scene = read(FOUR_BAR + f'[branches]\nC = "{words} of B-D"\n')
        whole = by_loops(scene)
        speed = PointMotion(velocity=whole.points["C"].velocity)
        verdict = compare(scene, Solution({"C": speed}, {}))
        assert verdict.agrees
        assert verdict.guessed == ("2", "3")
        assert compare(scene, whole).guessed == ()
        wrong = PointMotion(velocity=whole.points["C"].velocity * (1 + 1e-6))
        assert not compare(scene, Solution({"C": wrong}, {})).agrees


def test_a_batch_without_positions_is_assembled_too(read):
    text = FOUR_BAR.replace("angle = 75", 'angle = "q"') + '[branches]\nC = "right of B-D"\n'
    scene = read("[parameters]\nq = 75\n" + text)
    q = {"q": np.array([10.0, 75.0, 200.0])}
    whole = by_loops(scene, q)
    bare = Solution({}, {name: whole.links[name] for name in "23"})
    assert examine(scene, bare, q).agrees.all()


def test_the_number_of_a_closure_is_held_in_a_batch(read):
    scene = read(scene_text("loops/rapid-return"))
    q = {"q": np.linspace(30, 40, 3)}
    solution = by_loops(scene, q)
    assert examine(scene, solution, q).agrees.all()
    other = replace(scene, branches={"2": Closure(2)})
    assert not examine(other, solution, q).agrees.any()
    found = [by_loops(replace(scene, branches={"2": Closure(n)})).points for n in (1, 2)]
    angles = [np.angle(each["Q"].position - each["P"].position) % (2 * np.pi) for each in found]
    assert angles[0] < angles[1]


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(("near", "far"), [(3.0, 4.0), (4.9, 9.7), (4.0, 1.2), (2.0, 3.0)])
def test_the_square_of_half_an_angle_is_the_direction_of_a_side(near, far, side):
    """By the law of cosines; five is the base. No triangle, no number."""
    cosine = (near**2 + 25 - far**2) / (10 * near)
    found = half_angle(near, far, 5.0, side)
    assert abs(found) == pytest.approx(1.0)
    assert found**2 == pytest.approx(complex(cosine, side * np.sqrt(1 - cosine**2)))
    with np.errstate(invalid="ignore"):
        assert np.isnan(half_angle(near, near + 5.1, 5.0, side))
        assert np.isnan(half_angle(near, abs(near - 5) - 0.1, 5.0, side))


def test_forward_is_told_by_the_guide_of_the_link_that_is_named():
    """Of a group with two guides, or of a link with the pin of that name; else by the first."""
    four, five = (SimpleNamespace(block=name, on="0", number=0, moved_by=None) for name in "45")
    group = SimpleNamespace(slides=[SimpleNamespace(slide=0), SimpleNamespace(slide=1)])
    bodies = {"0": {"A": 0j}, "4": {"B": 0j}, "5": {"C": 0j}}
    loops = SimpleNamespace(guides=[four, five])
    part = SimpleNamespace(guides=[five, four], bodies=bodies)
    assert [led_by(name, group, loops, part) for name in "549CB"] == [0, 1, 1, 0, 1]
