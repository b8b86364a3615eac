"""What a notebook shows: the sheet itself, and plans in matplotlib's axes to scale."""

from pathlib import Path

import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.textpath import TextPath

from graphkin import load
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet_documents import drawings_of, language_of, proved
from graphkin.drawing.richtext import size_for
from graphkin.drawing.style import BLUE, STYLES
from graphkin.text.errors import PageError, SceneError
from graphkin.writers.axes import face
from tests.chosen import EVERY

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


@pytest.mark.parametrize("n", [1, 7, 30])
def test_the_velocities_of_the_plan_stand_in_millimetres(n):
    """v over kv is as long as the arrow, and points the same way: y runs up in axes."""
    mechanism = load("pump", n=n)
    drawn = lines(mechanism.plot(axes(), "velocity"), BLUE, STYLES["velocity"].width)
    spoken = language_of(mechanism, None)
    (first, _) = drawings_of(mechanism, proved(mechanism, sheet_motion(mechanism)), spoken)
    solution = mechanism.solve()
    for name in ("A", "B", "C", "D"):
        wanted = 1000 * solution.points[name].velocity / first.scales.kv
        assert min(abs(each - wanted) for each in drawn) < 1e-6


@pytest.mark.parametrize("which", ["mechanism", "velocity", "acceleration"])
def test_the_axes_hold_all_that_is_drawn(which):
    ax = load("pump", n=7).plot(axes(), which)
    inside = ax.get_window_extent()
    for patch in ax.patches:
        box = patch.get_path().get_extents(patch.get_transform())
        assert inside.x0 - 1e-6 <= box.x0 and box.x1 <= inside.x1 + 1e-6
        assert inside.y0 - 1e-6 <= box.y0 and box.y1 <= inside.y1 + 1e-6
    assert ax.get_aspect() == 1


SIGN = TextPath((0, 0), "⊥", size=size_for(2.5), prop=face(italic=False)).get_extents()


def signs(ax):
    """The sizes in mm of the signs ⊥, which stand in every plan."""
    found = []
    for patch in ax.patches:
        box = patch.get_path().get_extents(patch.get_transform())
        letter = not patch.get_linewidth() and len(patch.get_path().vertices) == 10
        if letter and abs(box.width / box.height - SIGN.width / SIGN.height) < 1e-3:
            found.append(box.height / ax.figure.dpi * 25.4)
    return found


def heads(ax):
    """The lengths in mm of the arrowheads: filled triangles without an edge."""
    found = []
    for patch in ax.patches:
        corners = patch.get_transform().transform(patch.get_path().vertices)
        if len(corners) == 4 and not patch.get_linewidth():
            tip, *back = (complex(*corner) for corner in corners[:3])
            found.append(abs(tip - sum(back) / 2) / ax.figure.dpi * 25.4)
    return found


@pytest.mark.parametrize("later", [False, True] if EVERY else [True])
def test_letters_and_arrowheads_of_all_drawings_in_a_figure_are_of_one_size(later):
    """Capitals are 2.5 mm high and heads 3.2 mm long, as on the sheets, in axes of every size."""
    names = (str(SCENES / f"{name}.toml") for name in ("oscillating-slide", "gears-planet"))
    figure = Figure((9, 7))
    for row, name in zip(figure.subplots(2, 2), names, strict=True):
        for ax, which in zip(row, ("velocity", "acceleration"), strict=True):
            load(name).plot(ax, which, language="en")
    for ax in figure.axes:
        box = ax.get_position()
        if later:
            ax.set_position((box.x0, box.y0, 1.3 * box.width, 0.9 * box.height))
            ax.apply_aspect()
        assert max(heads(ax)) == pytest.approx(3.2)
        assert signs(ax)
        assert signs(ax) == pytest.approx([SIGN.height] * len(signs(ax)))


def test_signs_stay_at_their_places_where_one_looks_closer():
    """Pins and points, round ones, keep their size, and lie where the lines that meet there do."""
    ax = load("pump", n=7).plot(axes(), "mechanism")

    def boxes():
        every = (patch.get_path().get_extents(patch.get_transform()) for patch in ax.patches)
        return [(complex(*(box.min + box.max) / 2), box.width, box.height) for box in every]

    before, place = boxes(), ax.transData.inverted()
    kept = [complex(*place.transform((z.real, z.imag))) for z, _, _ in before]
    (low, high), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    ax.set(xlim=(low, (low + high) / 2), ylim=(bottom, (bottom + top) / 2))
    round_ones = 0
    for (z, wide, high), (_, *size), at in zip(boxes(), before, kept, strict=True):
        if (wide, high) == pytest.approx((*size,)) and wide == pytest.approx(high):
            assert abs(complex(*ax.transData.transform((at.real, at.imag))) - z) < 1e-6
            round_ones += 1
    assert round_ones >= 6


def test_axes_too_small_for_the_letters_are_refused():
    ax = Figure((1.2, 1)).subplots()
    with pytest.raises(PageError, match="axes of 24 × 20 mm are too small: does not fit"):
        load("pump", n=7).plot(ax, "acceleration")


def test_axes_with_room_for_most_letters_are_drawn():
    """The rest are noted, as at the foot of a sheet: d′ in axes of 39 × 29 mm."""
    ax = Figure((2, 1.5)).subplots()
    assert load("pump", n=7).plot(ax, "acceleration").patches


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
