"""What a notebook shows: the sheet itself, and plans in matplotlib's axes to scale."""

from pathlib import Path

import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch

from graphkin import load
from graphkin.errors import SceneError
from graphkin.handout import drawings_of, hand_out, language_of, proved
from graphkin.paper.style import BLUE, STYLES
from graphkin.paper.svg import write_svg
from graphkin.scaling import shown

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


def lines(ax, colour, width):
    """Both ends of every straight stroke of a look, as complex numbers in the axes' units."""
    found = []
    for patch in ax.patches:
        assert isinstance(patch, PathPatch)
        ends = patch.get_path().vertices
        wide = abs(patch.get_linewidth() - width * 72 / 25.4) < 1e-9
        if len(ends) == 2 and wide and to_hex(patch.get_edgecolor()) == colour:
            found.append(complex(*ends[1]) - complex(*ends[0]))
    return found


def axes():
    return Figure().subplots()


def test_a_mechanism_shows_itself_as_its_first_sheet():
    mechanism = load("pump", n=7)
    shown_ = mechanism._repr_svg_()
    assert shown_ == write_svg(hand_out(mechanism)[0].pages[0])
    assert "<svg" in shown_ and 'data-name="oa"' in shown_


@pytest.mark.parametrize("n", [1, 7, 30])
def test_the_velocities_of_the_plan_stand_in_millimetres(n):
    """v over kv is as long as the arrow, and points the same way: y runs up in axes."""
    mechanism = load("pump", n=n)
    drawn = lines(mechanism.plot(axes(), "velocity"), BLUE, STYLES["velocity"].width)
    spoken = language_of(mechanism, None)
    (first, _) = drawings_of(mechanism, proved(mechanism, shown(mechanism)), spoken)
    solution = mechanism.solve()
    for name in ("A", "B", "C", "D"):
        wanted = 1000 * solution.points[name].velocity / first.scales.kv
        assert min(abs(each - wanted) for each in drawn) < 1e-6


def test_black_ink_and_another_language():
    ax = load("pump", n=7).plot(axes(), "acceleration", ink="black", language="en")
    colours = {patch.get_edgecolor()[:3] for patch in ax.patches if patch.get_linewidth()}
    assert colours == {(0.0, 0.0, 0.0)}


def test_the_axes_hold_all_that_is_drawn():
    ax = load("pump", n=7).plot(axes(), "mechanism")
    for patch in ax.patches:
        low, high = patch.get_path().get_extents().get_points()
        assert ax.get_xlim()[0] <= low[0] and high[0] <= ax.get_xlim()[1]
        assert ax.get_ylim()[0] <= low[1] and high[1] <= ax.get_ylim()[1]
    assert ax.get_aspect() == 1


def test_a_plan_of_which_nothing_is_asked_is_refused(tmp_path):
    text = (SCENES / "crank-rocker.toml").read_text(encoding="utf-8")
    asked = 'acceleration = ["B", "P"]\nomega = [2, 3]\nepsilon = [2, 3]\n'
    assert asked in text
    path = tmp_path / "velocities.toml"
    path.write_text(text.replace(asked, ""), encoding="utf-8")
    with pytest.raises(SceneError, match="nothing of the acceleration plan is asked"):
        load(str(path)).plot(axes(), "acceleration")


@pytest.mark.parametrize("which", ["vel", None, 3])
def test_what_is_no_drawing_is_said_to_be_none(which):
    with pytest.raises(
        SceneError, match="is no drawing; expected mechanism, velocity, acceleration"
    ):
        load("pump", n=7).plot(axes(), which)
