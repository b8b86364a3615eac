"""The command and its files: whole, the same bytes every time, never over other files."""

from __future__ import annotations

import csv
import io
import re
from cmath import rect
from math import radians
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from graphkin.cli.report.cycle_report import (
    FOUR_BARS,
    cycle_lines,
    cycle_rows,
    cycle_table,
    extremes_rows,
)
from graphkin.construction.higher_class.following import FollowedClosure
from graphkin.construction.links.link_shapes import hull
from graphkin.drawing.marks import Polyline, Text
from graphkin.mechanism import Mechanism, load
from graphkin.motion.curves.charts import cut, numeral, ticks_of
from graphkin.motion.curves.over_driver import (
    indexed,
    moving_points,
    pictures,
    sampled,
    span_of,
)
from graphkin.motion.curves.plane_paths import box_of, dotted, figures, near_box, picture_files
from graphkin.motion.cycle import cycle
from graphkin.motion.extremes import all_extremes
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from tests.chosen import EVERY
from tests.chosen import SCENES as SHIPPED
from tests.motion.linkages import five_bar, four_bar, slider_crank
from tests.running import Run
from tests.scene_files import scene_text

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
PICTURES = {"positions", "velocities", "accelerations", "turning", "slides", "paths", "reach"}


def rows_of(text: str) -> tuple[list[str], np.ndarray]:
    """Heads and numbers of a table; empty cells are NaN."""
    heads, *rows = csv.reader(io.StringIO(text))
    return heads, np.array([[float(cell or "nan") for cell in row] for row in rows])


@pytest.mark.parametrize("name", ["pump", "examples/scenes/six-bar.toml"])
def test_the_table_read_again_is_what_was_computed(name):
    found = cycle(load(name), steps=72)
    heads, table = rows_of(cycle_table(found))
    assert len(set(heads)) == len(heads)
    columns = dict(zip(heads, table.T, strict=True))
    assert np.array_equal(columns["phi [deg]"], found.at)
    assert np.allclose(columns["phi [rad]"], np.radians(found.at))
    for point, motion in found.solution.points.items():
        if point not in found.scene.frame.points:
            assert np.array_equal(columns[f"x_{point} [m]"], motion.position.real)
            assert np.array_equal(columns[f"vy_{point} [m/s]"], motion.velocity.imag)
            assert np.array_equal(columns[f"ax_{point} [m/s^2]"], motion.acceleration.real)
    for link, motion in found.solution.links.items():
        assert np.allclose(columns[f"omega_{link} [rad/s]"], motion.omega, rtol=0, atol=0)
    assert not any(head.endswith("O1 [m]") for head in heads)


def test_a_centre_at_infinity_leaves_its_cell_empty():
    # at 90 degrees without offset the rod of a slider-crank is in translation
    heads, table = rows_of(cycle_table(cycle(slider_crank(2, 5), steps=4)))
    row = table[list(table[:, 0]).index(90.0)]
    columns = dict(zip(heads, row, strict=True))
    assert abs(columns["omega_2 [rad/s]"]) < 1e-15
    place = columns["Ix_2 [m]"]
    assert np.isnan(place) or abs(place) > 1e12 or abs(columns["Iy_2 [m]"]) > 1e12


def test_the_command_writes_everything_and_tells_what_it_found(run: Run, tmp_path: Path):
    result = run("cycle", "pump", "--set", "n=7", "-o", tmp_path, "--format", "svg", "--steps", 12)
    assert result.exit_code == 0, result.stderr
    names = {path.name for path in tmp_path.iterdir()}
    assert "pump-n7-cycle.csv" in names
    wanted = {*PICTURES, "centrodes-3", "centrodes-4"}
    assert {f"pump-n7-{name}.svg" for name in wanted} <= names
    assert not any(name.endswith((".png", ".part")) for name in names)
    heads, *rows = csv.reader(io.StringIO((tmp_path / "pump-n7-extremes.csv").read_text()))
    told = [dict(zip(heads, row, strict=True)) for row in rows]
    least = next(row for row in told if (row["of"], row["extreme"]) == ("D", "least"))
    assert (least["quantity"], least["value"], least["where"]) == ("velocity", "0.0", "inside")
    assert float(least["phi [deg]"]) == pytest.approx(27.809, abs=1e-3)  # as the block turns round
    for line in (
        "φ from -32.618° to 186.944°",
        "C-D square to the guide of 5 at φ = 186.944°: limit position of the driver",
        "block 5 goes 52.9547 cm",
        "|v_D|: least 0 m/s at φ = 27.809°; largest +∞ at the dead points φ = -32.618° and",
        "triple rocker",
        "agrees in every row",
    ):
        assert line in result.stdout
    more = ("-o", tmp_path, "--format", "svg", "--steps", 4)
    again = run("cycle", "pump", "--set", "n=7", *more)
    assert again.exit_code == 2
    assert "--force replaces it" in again.stderr
    assert not again.stdout


def test_a_mechanism_that_never_closes_is_a_message(run: Run, tmp_path: Path):
    scene = (SCENES / "crank-rocker.toml").read_text().replace("O1-A = 40", "O1-A = 4000")
    path = tmp_path / "never.toml"
    path.write_text(scene)
    result = run("cycle", path, "-o", tmp_path / "out")
    assert result.exit_code == 2
    assert "closes for no position of the driver" in result.stderr


@pytest.mark.parametrize(
    ("mechanism", "said"),
    [
        (
            four_bar(40, 90, 70, 100),
            [
                "every angle of the driver: it turns fully",
                "it is a crank-rocker",
                "link 3 (line O2-B) swings 70.553°: 81.787° (at φ = 32.204°)",
                "time ratio of its two strokes 1.0971: 188.3° of the driver to 152.340°, 171.7° to",
            ],
        ),
        (
            four_bar(40, 90, 70, 100, speed=-1),
            ["time ratio of its two strokes 1.0971: 171.7° of the driver to 152.340°, 188.3° to"],
        ),
        (
            four_bar(2, 4, 2, 4),
            [
                "A, B and O2 in line at φ = 180.000°: change point",
                "φ from 180.000° to 360.000°: B right of A-O2",
                "2 positions left out",
                "parallelogram",
            ],
        ),
        (slider_crank(2, 5, 1), ["crank + offset ≤ rod: the crank turns fully", "block 3 goes"]),
        (five_bar(), ["every driver moves with the time", "range      t from 0 s to "]),
    ],
)
def test_the_words_of_a_cycle(mechanism, said):
    text = "\n".join(cycle_lines(cycle(mechanism)))
    for line in said:
        assert line in text
    assert "DOES NOT AGREE" not in text


def test_an_arm_that_turns_on_and_on_does_not_swing():
    """Willis: the arm makes (120·100 - 60·50)/(120 + 60) = 50 rev/min, half a turn in 0.6 s."""
    scene = read_text(scene_text("motion/arm"), "arm")
    text = "\n".join(cycle_lines(cycle(Mechanism(scene))))
    words = "link arm (line O-P) turns one way by 180.000° within the window: 26.667° (at t = 0 s, "
    assert words + "an edge of the window) to 206.667°" in text
    assert "swings" not in text


def test_a_follower_between_dead_points_swings():
    """A driver that dead points stop goes to and fro, and what it moves with it."""
    text = "\n".join(cycle_lines(cycle(load(str(SCENES / "slider-crank-slider.toml")))))
    assert "link 1 (line O-A) swings 188.939°" in text


def test_words_along_a_line_stay_clear_of_the_curves():
    found = sampled(cycle(load("pump", n=7), steps=24), language="en")
    marks = pictures(found)["velocities"]().marks
    curves = [m for m in marks if isinstance(m, Polyline) and m.cls.startswith("curve")]
    assert len(curves) >= 3
    told = [m for m in marks if isinstance(m, Text) and m.name == "upright"]
    assert [m.markup for m in told] == ["dead point", "dead point", "scene’s position"]
    for text in told[:2]:  # no place beside the scene's position is as long as its words
        area = shapely.box(*shapely.MultiPoint(text.corners()).bounds)
        assert not any(shapely.LineString(curve.points).intersects(area) for curve in curves)


@pytest.mark.parametrize(("name", "unit", "most"), [("roller", "mm", 20), ("rocker", "°", 24)])
def test_a_picture_of_a_cam_shows_the_rise_of_its_law_in_its_unit(name, unit, most):
    """The rise of a slide in the unit of the scene, that of a lever in degrees."""
    found = sampled(cycle(load(f"{SCENES}/cam-{name}.toml"), steps=24))
    marks = pictures(found)["cams"]().marks
    units = [m.markup for m in marks if isinstance(m, Text) and m.name == "unit"]
    assert units == [unit, "°"]
    rise = read_off(marks, "*s*_{2}" if name == "roller" else "*ψ*_{2}")
    assert (rise.imag.min(), rise.imag.max()) == pytest.approx((0, most), abs=0.02)
    if name == "roller":  # base 40, roller 10, offset 10: tan α = (s' - e)/(s + √(50² - e²))
        lift = np.asarray(found.cycle.profiles["2"].rise.at) * 1000
        slope = np.gradient(lift, np.radians(found.at))
        angle = np.degrees(np.arctan((slope - 10) / (lift + np.sqrt(50**2 - 10**2))))
        drawn = read_off(marks, "*α*_{2}")
        expected = np.interp(drawn.real, found.at, abs(angle))
        assert drawn.imag == pytest.approx(expected, abs=0.15)


def read_off(marks, label):
    """The points of a curve as a reader takes them from its axes: u + 1j * value."""
    curve = [m for m in marks if isinstance(m, Polyline) and m.name == label]
    top, low = (
        min(y for m in curve for _, y in m.points),
        max(y for m in curve for _, y in m.points),
    )
    ticks = [m for m in marks if isinstance(m, Text) and m.name == "tick"]
    beside = [m for m in ticks if m.anchor == "end" and top - 9 < m.y < low + 9]
    below = [m for m in ticks if m.anchor == "middle"]

    def scale(texts, places):
        values = [float(m.markup.replace("−", "-").replace(",", ".")) for m in texts]
        return np.polynomial.Polynomial.fit(places, values, 1)

    across = scale(below, [m.x for m in below])
    upright = scale(beside, [m.y - 0.8 for m in beside])
    points = np.array([point for m in curve for point in m.points])
    return across(points[:, 0]) + 1j * upright(points[:, 1])


def test_a_curve_read_off_its_axes_is_what_was_computed():
    found = sampled(cycle(load("offset-slider-crank"), steps=24))
    drawn = read_off(pictures(found)["velocities"]().marks, "*v*_{B}")
    assert len(drawn) > 100
    speed = np.abs(found.solution.points["B"].velocity)
    assert np.abs(speed).max() == pytest.approx(drawn.imag.max(), rel=2e-3)


FIGURED = ("four-bar-crank-rocker", "gears-planet", "cam-flat", "cam-fixed-lever", "cam-carried")
"""Scenes with figures of every kind; cams reach beyond the points of their links."""


@pytest.mark.parametrize("name", SHIPPED if EVERY else FIGURED)
def test_every_figure_of_every_kind_is_a_page_within_its_edges(name):
    for _, drawn in figures(sampled(cycle(load(SCENES / f"{name}.toml"), steps=24), 90)):
        drawn().check()


def test_the_same_cycle_gives_the_same_bytes_in_both_formats():
    found = cycle(load("offset-slider-crank"), steps=24)
    once, again = (picture_files(found, "x", ("svg", "png")) for _ in range(2))
    assert once == again
    assert {name[-4:] for name in once} == {".svg", ".png"}
    assert all(
        data[:8] == b"\x89PNG\r\n\x1a\n" for name, data in once.items() if name[-3:] == "png"
    )


@pytest.mark.parametrize(
    ("own", "asked", "title"),
    [("en", "de", "Exzenter"), ("de", None, "Exzenter"), ("en", None, "E"), ("de", "ro", "E")],
)
def test_a_figure_has_the_title_of_its_language(own, asked, title):
    """As sheets have it: of the language asked for, else of the scene's, else the usual one."""
    scene = load("offset-slider-crank").scene
    scene = replace(scene, title="E", titles={"de": "Exzenter"})
    scene = replace(scene, sheet=replace(scene.sheet, language=own))
    found = cycle(Mechanism(scene), steps=24)
    pictures = picture_files(found, "x", ("svg",), asked).values()
    titles = [re.search(r"<title>(.*?)</title>", each.decode())[1] for each in pictures]
    assert titles and all(re.search(rf": {title}(,|$)", each) for each in titles)


IN_INCHES = Path(__file__).resolve().parents[1] / "scenes" / "motion" / "press.toml"


@pytest.mark.parametrize(
    ("results", "unit", "metres"), [("", "in/s", 0.0254), ("ft", "ft/s", 0.3048), ("SI", "m/s", 1)]
)
def test_pictures_are_in_the_unit_of_results(results, unit, metres):
    """An inch is 0.0254 m, a foot 0.3048 m; places stay in the scene's own unit."""
    mechanism = load(str(IN_INCHES))
    scene = replace(mechanism.scene, results=results)
    found = sampled(cycle(Mechanism(scene), steps=24), language="en")
    name, *_ = moving_points(scene, found.solution)
    marks = pictures(found)["velocities"]().marks
    assert next(m.markup for m in marks if isinstance(m, Text) and m.name == "unit") == unit
    drawn = read_off(marks, f"*v*_{{{name}}}")
    size = np.abs(found.solution.points[name].velocity) / metres
    assert drawn.imag == pytest.approx(np.interp(drawn.real, found.at, size), abs=5e-3 * size.max())
    marks = pictures(found)["positions"]().marks
    assert next(m.markup for m in marks if isinstance(m, Text) and m.name == "unit") == "in"


@pytest.mark.parametrize("kind", ["cycle", "extremes", "positions"])
def test_tables_are_in_si_units_unless_those_of_the_scene_are_asked_for(run, tmp_path, kind):
    """An inch is 0.0254 m; angles keep their units."""
    read = {}
    for units in ("SI", "scene"):
        more = ("--format", "csv", "--steps", 8, "--positions", 4)
        more += ("--units", "scene") if units == "scene" else ()
        result = run("cycle", IN_INCHES, "-o", tmp_path / units, *more)
        assert result.exit_code == 0, result.stderr
        (path,) = (tmp_path / units).glob(f"*-{kind}.csv")
        read[units] = list(csv.reader(io.StringIO(path.read_text())))
    (heads, *own), (others, *si) = read["scene"], read["SI"]
    sizes = {"in": 0.0254, "in/s": 0.0254, "in/s^2": 0.0254, "lbf": 4.4482216152605,
             "lbf·in": 4.4482216152605 * 0.0254}  # fmt: skip
    if kind == "extremes":
        unit, value = heads.index("unit"), heads.index("value")
        assert {row[unit] for row in own} & {*sizes} and not {row[unit] for row in si} & {*sizes}
        pairs = [
            (row[value], sizes.get(row[unit], 1), other[value])
            for row, other in zip(own, si, strict=True)
        ]
    else:
        assert "x_B [in]" in heads and "vx_B [in/s]" in heads and "ax_B [in/s^2]" in heads
        assert "x_B [m]" in others and "vx_B [m/s]" in others and "ax_B [m/s^2]" in others
        units = [head.partition("[")[2][:-1] for head in heads]
        pairs = [
            (cell, sizes.get(unit, 1), other)
            for row, line in zip(own, si, strict=True)
            for cell, unit, other in zip(row, units, line, strict=True)
        ]
    for cell, size, other in pairs:
        assert bool(cell) == bool(other)
        if cell:
            assert float(cell) * size == pytest.approx(float(other), rel=1e-12, abs=1e-300)


def test_places_of_a_sliding_driver_are_in_the_units_of_the_table():
    """A block that drives a crank: both tables have its coordinate in centimetres, or in metres."""
    found = cycle(load(f"{SCENES}/centrodes-cardan.toml"), steps=12)
    reached = all_extremes(found)
    for length, size in (("m", 1), ("cm", 0.01)):
        rows = extremes_rows(found, reached, length)
        at = next(i for i, head in enumerate(rows[0]) if head == f"s [{length}]")
        assert cycle_rows(found, length)[0][0] == f"s [{length}]"
        si = extremes_rows(found, reached)
        assert [row[at] * size for row in rows[1:]] == pytest.approx([row[at] for row in si[1:]])


FORCED = str(IN_INCHES.parents[1] / "forces" / "four-bar.toml")


def test_forces_of_a_cycle_are_in_pounds_force_where_results_are_in_inches():
    """A pound-force is 4.4482216 N."""
    scene = replace(load(FORCED).scene, results="in")
    found = sampled(cycle(Mechanism(scene), steps=12), fine=24)
    marks = pictures(found)["forces"]().marks
    units = [m.markup for m in marks if isinstance(m, Text) and m.name == "unit"]
    assert units == ["lbf", "lbf·in"]
    (what, name), value = next(iter(found.cycle.forces.values.items()))
    drawn = read_off(marks, indexed(*name.split("_", 1)))
    size = np.abs(value) / 4.4482216
    expected = np.interp(drawn.real, found.at, size)
    assert drawn.imag == pytest.approx(expected, abs=5e-3 * size.max()), what


SPOKEN = (
    *(f"{SCENES}/{name}.toml" for name in ("cam-roller", "crank-rocker", "slider-crank-slider")),
    FORCED,
)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_words_of_pictures_are_those_of_the_language(language):
    """No word of English is left in another language; numbers have the language's mark."""
    own, english = (
        {key: said for key, said in words(code).sentences.items() if key.startswith("curves.")}
        for code in (language, "en")
    )
    assert own.keys() == english.keys()
    said = []
    for name in SPOKEN:
        found = sampled(cycle(load(name), steps=24), 24, language)
        for _, drawn in figures(found):
            said += [m.markup for m in drawn().marks if isinstance(m, Text)]
    text = "\n".join(said)
    for key in ("velocities", "turning", "dead", "here", "fixed", "rolls", "ring"):
        assert own[f"curves.{key}"].partition(" {")[0] in text, key
    if language != "en":
        left = re.findall(r"\b(?:of|the|link|driver|deg|path|centrode|reach|point of)\b", text)
        assert not left
    if words(language)("decimal_mark") == ",":
        assert not [each for each in said if re.fullmatch(r"−?\d+\.\d+", each)]


def test_every_class_of_loop_has_its_name_in_the_pictures():
    known = {key for key in words("en").sentences if key.startswith("curves.loop.")}
    kinds = {f"curves.loop.{kind.replace(' ', '-')}" for kind in FOUR_BARS}
    assert known == kinds | {"curves.loop.slider-crank"}


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6))
def test_numbers_along_an_axis_are_few_and_round(low, size):
    found = ticks_of(low, low + size)
    assert 1 <= len(found) <= 7
    assert all(low - 1e-6 * size <= value <= low + size * (1 + 1e-6) for value in found)


def test_numbers_along_an_axis_have_one_zero_and_a_true_minus():
    assert [numeral(value) for value in (-0.0, 0.0, -2.5, 1e-7)] == ["0", "0", "−2.5", "1e−07"]
    for name in ("cam-roller", "gears-planet"):
        found = sampled(cycle(load(f"{SCENES}/{name}.toml"), steps=24), 90)
        for _, drawn in figures(found):
            ticks = [m.markup for m in drawn().marks if isinstance(m, Text) and m.name == "tick"]
            assert ticks and "−0" not in ticks


def test_an_area_is_cut_at_an_edge():
    """A square over the edge x = 1 loses its left half."""
    square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]
    found = shapely.Polygon(cut(square, 0, 1, 1.0))
    assert found.equals(shapely.box(1, 0, 2, 2))


def test_a_path_has_a_dot_at_every_twelfth_of_a_turn():
    found = sampled(cycle(load(f"{SCENES}/crank-rocker.toml"), steps=24), 24)
    dots = dotted(found, found.at + 0j)
    assert dots.real.tolist() == [
        30 * k for k in range(-40, 40) if 0 <= 30 * k - found.at[0] <= 360
    ]


@given(st.lists(st.complex_numbers(max_magnitude=1e3), min_size=2, max_size=9))
def test_a_picture_leaves_the_same_room_on_all_sides(places):
    """A part of its longer side; what has no place is left out."""
    z = np.array([*places, complex("nan")])
    x0, x1, y0, y1 = box_of([z[:1], z[1:]])
    x, y = np.array(places).real, np.array(places).imag
    room = 0.09 * max(np.ptp(x), np.ptp(y), 1e-9)
    found = (x.min() - x0, x1 - x.max(), y.min() - y0, y1 - y.max())
    assert found == pytest.approx((room,) * 4, abs=1e-9)
    assert max(x1 - x0, y1 - y0) == pytest.approx(max(np.ptp(x), np.ptp(y)) + 2 * room)


def test_of_curves_that_run_far_away_the_picture_shows_what_lies_near():
    """Within 1.6 breadths of the mechanism; a contact farther off is left out with them."""
    places, breadth = np.array([0j, 10 + 4j]), 10.0
    near, far = np.array([20 + 3j, -15 - 9j]), np.array([40 + 3j, 3 + 30j, -30j])
    for touch, more in ((5 + 12j, [5 + 12j]), (5 + 60j, [])):
        found = near_box(places, [np.concatenate([near, far])], breadth, touch)
        assert found == box_of([places, near, np.array(more, dtype=complex)])


def test_a_point_on_the_side_of_a_plate_is_none_of_its_corners():
    """However the plate is turned, though rounding puts the point a little aside."""
    for turn in range(0, 360, 7):
        places = [rect(1, radians(turn)) * place for place in (0, 0.3, 1, 0.4 + 0.5j)]
        assert {*hull(places)} == {*places} - {places[1]}
        assert hull(places[:3]) in (places[:3:2], places[2::-2])


WHOLE = st.integers(-9, 9)


@given(st.lists(st.builds(complex, WHOLE, WHOLE), min_size=2, max_size=9, unique=True))
def test_a_plate_is_drawn_as_the_convex_hull_of_its_points(places):
    """That of another library; a bar where they lie in line."""
    expected = shapely.MultiPoint([(z.real, z.imag) for z in places]).convex_hull
    found = [(z.real, z.imag) for z in hull(places)]
    if expected.geom_type == "Polygon":
        assert shapely.Polygon(found).equals(expected)
        assert len(found) == len(expected.exterior.coords) - 1
        assert shapely.LinearRing(found).is_ccw
    else:
        assert shapely.LineString(found).equals(expected)


@given(st.lists(st.floats(0.1, 3.0), min_size=1, max_size=7), st.integers(0, 10**6))
def test_what_is_followed_runs_between_places_as_the_polynomial_through_the_nearest(steps, seed):
    """A cubic is met everywhere, whatever the steps are; of fewer places one of lower degree."""
    at = np.cumsum([1.0, *steps])
    rng = np.random.default_rng(seed)
    rows = [np.polynomial.Polynomial(rng.normal(size=min(4, len(at)))) for _ in range(3)]
    wanted = rng.uniform(at[0], at[-1], 5)
    after = np.clip(np.searchsorted(at, wanted), 1, len(at) - 1)
    tried = np.array([row(at) for row in rows]).T
    found = FollowedClosure(at, tried, np.empty((len(at), 0))).between(wanted, after)
    expected = np.array([row(wanted) for row in rows]).T
    assert np.allclose(found, expected, atol=1e-6 * max(1.0, abs(expected).max()) * 100)


def test_curves_that_run_to_infinity_leave_the_axes_and_the_rest_of_them_stays_in_sight():
    """Five sixths of 1/x at least; what runs nowhere, and a peak on zero, are shown whole."""
    at = np.linspace(-1, 1, 400)
    low, high = span_of(at, [1 / at, np.sin(at)])
    inside = (low <= 1 / at) & (1 / at <= high)
    assert 5 / 6 < inside.mean() < 1
    assert high < 0.1 * max(1 / at)
    assert low <= np.sin(at).min() and np.sin(at).max() <= high
    assert span_of(at, [np.sin(at)]) is None
    assert span_of(at, [np.where(abs(at) < 0.01, 9.0, 0.0)]) is None
