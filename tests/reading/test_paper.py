"""The map from paper to a picture, and where lines on it cross, held against other routes."""

from __future__ import annotations

import cmath
from math import radians

import cv2
import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.printing.personal import PITCH, places, square
from graphkin.drawing.field import A3
from graphkin.drawing.marks import LineMark, Page
from graphkin.reading.drawn_ink import InkLine
from graphkin.reading.paper_map import (
    BENDS,
    COUNT,
    CROSSED,
    LEAST,
    LENS,
    PLAIN,
    Offsets,
    PaperMap,
    bendings,
    creasings,
    prior,
    ripple_of,
    without,
)
from graphkin.reading.point_search import (
    BREAK,
    along_way,
    are_crossing,
    distinct,
    in_fields,
    is_parted,
    is_same,
    met,
    sine,
    through,
    unbroken,
)
from graphkin.reading.registration import (
    MeasuredLines,
    PrintedLines,
    SheetSearch,
    crosses_off,
    least_stretch,
    peaks,
    printed_lines,
    profiles,
    square_of,
    ticks_found,
)

SIZE = (2000, 1500)
SHEET = np.stack(np.meshgrid(np.linspace(0, 420, 13), np.linspace(0, 297, 9)), axis=-1)
CAMERA = (0.7, 0.05, 0.02, -0.04, 0.72, -0.03, 0.11, -0.07)


def paper_map(*camera: float, lens: float = 0.0, bent: dict[int, float] | None = None) -> PaperMap:
    """A map with a perspective, a lens and some bendings."""
    found = np.zeros(COUNT)
    found[: len(camera)], found[LENS] = camera, lens
    for place, size in (bent or {}).items():
        found[PLAIN + place] = size
    return PaperMap(*SIZE, tuple(found))


def test_a_perspective_is_a_collineation():
    """By homogeneous coordinates (Hartley & Zisserman, 2.3); the middle of the sheet, seen
    straight, is the middle of the picture, whose pixels' centres are whole numbers."""
    unit = (SHEET - (210, 148.5)) / 210
    homogeneous = np.append(unit, np.ones((*unit.shape[:-1], 1)), axis=-1)
    seen = homogeneous @ np.array([*CAMERA, 1.0]).reshape(3, 3).T
    half, middle = np.hypot(*SIZE) / 2, (np.array(SIZE) - 1) / 2
    expected = seen[..., :2] / seen[..., 2:] * half + middle
    assert paper_map(*CAMERA)(SHEET) == pytest.approx(expected)
    assert paper_map(1, 0, 0, 0, 1, 0, 0, 0)(np.array([210, 148.5])) == pytest.approx(middle)


@pytest.mark.parametrize("lens", [-0.08, 0.05])
def test_a_lens_moves_places_along_their_rays_from_the_middle(lens):
    """By k r² of their distance r in half diagonals (Brown 1966)."""
    half, middle = np.hypot(*SIZE) / 2, (np.array(SIZE) - 1) / 2
    plain, bulged = (paper_map(*CAMERA, lens=k)(SHEET) - middle for k in (0.0, lens))
    far = np.hypot(*np.moveaxis(plain, -1, 0))[..., None] / half
    assert bulged == pytest.approx(plain * (1 + lens * far**2))


def test_bendings_are_products_of_legendres_polynomials():
    """Square to one another over the sheet, flat beyond it; held small by their degree."""
    u, v = (SHEET - (210, 148.5)).reshape(-1, 2).T / 210
    down = v * 210 / 148.5
    for k, (i, j) in enumerate(BENDS):
        assert 2 <= i + j <= 5
        expected = np.polynomial.legendre.legval(u, np.eye(6)[i]) * np.polynomial.legendre.legval(
            down, np.eye(6)[j]
        )
        assert bendings(u, v)[:, k] == pytest.approx(expected)
    assert len(set(BENDS)) == 18
    assert bendings(np.array(3.0), np.array(0.2)) == pytest.approx(
        bendings(np.array(1.05), np.array(0.2))
    )
    sizes = prior(2.1)
    for k, (i, j) in enumerate(BENDS):
        bent = 0.01 * 0.4 ** (i + j - 2)
        assert sizes[PLAIN + 2 * k : PLAIN + 2 * k + 2] == pytest.approx([bent, bent])


def test_the_quarters_of_a_folded_sheet_meet_at_its_creases():
    """Each quarter is smooth by itself; across a crease only the slope changes."""
    step = 1e-4
    for u, v in ((0.4, 0.2), (-0.3, 0.5), (0.2, -0.6)):
        for across, along in (((step, 0), (0, v)), ((0, step), (u, 0))):
            at = np.array(along, dtype=float)
            low, high = (creasings(*(at + side * np.array(across))) for side in (-1, 1))
            middle = creasings(*at)
            assert low == pytest.approx(middle, abs=3 * step)
            assert high == pytest.approx(middle, abs=3 * step)
            assert abs(high + low - 2 * middle).max() > step  # a crease
        quarter = [creasings(u + shift, v) for shift in (-step, 0, step)]
        assert abs(quarter[0] + quarter[2] - 2 * quarter[1]).max() < 3 * step**2


def test_bent_paper_is_seen_where_its_places_are_shifted_to():
    plain = paper_map(*CAMERA, lens=0.03)
    for place in (0, 1, 7, 20):
        bent = paper_map(*CAMERA, lens=0.03, bent={place: 0.004})
        unit = (SHEET - (210, 148.5)) / 210
        shift = np.zeros_like(unit)
        shift[..., place % 2] = 0.004 * bendings(unit[..., 0], unit[..., 1])[..., place // 2]
        assert bent(SHEET) == pytest.approx(plain(SHEET + 210 * shift))


def test_the_scale_is_the_root_of_the_area_that_a_square_millimetre_takes_up():
    found = paper_map(*CAMERA, lens=0.03, bent={3: 0.002})
    for place in ((20.0, 30.0), (210.0, 148.5), (400.0, 20.0)):
        square = np.array(place) + np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
        x, y = found(square).T
        area = abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) / 2
        assert found.scale(place) == pytest.approx(area**0.5, rel=1e-4)


def line(angle: float, through: complex = 0j, aside: float = 0.0, **more: float) -> InkLine:
    """A line at an angle in degrees, beside a place, to the left seen along it, in mm."""
    way = cmath.rect(1, radians(angle))
    start = through + 1j * aside * way - 11 * way
    own = {"cover": 0.9, "error": 0.1} | more
    return InkLine(start, start + 25 * way, **own)


@pytest.mark.parametrize("turn", [0.0, 77.0, 211.0])
def test_lines_meet_where_they_cross_unless_too_flatly(turn):
    """Within 6.9° of one another they tell no place."""
    place = 30 + 12j
    for angle in (8, 40, 90, 150, 172):
        one, other = line(turn, place), line(turn + angle, place)
        assert met(one, other) == pytest.approx(place)
        assert sine(one.way, other.way) == pytest.approx(np.sin(radians(angle)))
        assert are_crossing([place + 3 * one.way, place - 8 * other.way], place)
    for angle in (0, 6, 174, 180):
        one, other = line(turn, place), line(turn + angle, place)
        assert met(one, other) is None
        assert not are_crossing([place + 3 * one.way, place - 8 * other.way], place)
    assert not are_crossing([place + 1], place)


@pytest.mark.parametrize("back", [0, 180])
@pytest.mark.parametrize(
    ("turn", "aside", "same"),
    [(0, 0, True), (1.1, 0.25, True), (-1.1, 0, True), (1.3, 0, False), (0, 0.35, False)],
)
def test_a_line_that_is_found_twice_counts_once(turn, aside, same, back):
    """Whichever of its ends is the first: as near as 1.2° and 0.3 mm it is one stroke."""
    place = 5 + 2j
    one, other = line(20, place), line(20 + turn + back, place, aside)
    assert is_same(one, other, place) is is_same(other, one, place) is same
    assert distinct([[one], [other]], place) == ([[one]] if same else [[one], [other]])
    assert distinct([[one, other], [one]], place) == [[one, other]]


def test_through_a_place_is_the_point_nearest_to_all_its_lines():
    """Least squares of what the lines are off, each by its error; two cross there exactly."""
    place = 40 - 7j
    true = place + 0.2 - 0.1j
    found = through(place, [[line(10, true)], [line(80, true)]])
    assert found is not None
    assert (found.place, found.count) == (pytest.approx(true), 2)
    lines = [line(10, true, 0.1, error=0.2), line(80, true, -0.1), line(130, true, 0.05, cover=0.6)]
    found = through(place, [[each] for each in lines])
    assert found is not None
    rows = [[-each.way.imag / each.error, each.way.real / each.error] for each in lines]
    offs = [-each.off(place) / each.error for each in lines]
    shift, *_ = np.linalg.lstsq(np.array(rows), np.array(offs), rcond=None)
    assert found.place == pytest.approx(place + complex(*shift))
    covariance = np.linalg.inv(np.array(rows).T @ np.array(rows)) + np.eye(2) * 0.08**2 / 2
    assert found.error == pytest.approx(covariance)
    assert (found.count, found.cover) == (3, pytest.approx(0.9))


def test_lines_beside_a_place_faint_ones_and_flat_crossings_tell_no_point():
    place = 3 + 4j
    good, more = line(10, place), line(80, place)
    assert through(place, [[good]]) is None
    assert through(place, [[good], [line(80, place, 0.46)]]) is None
    assert through(place, [[good], [line(80, place, 0.44)]]) is not None
    assert through(place, [[good], [replace(more, cover=0.49)]]) is None
    assert through(place, [[good], [line(16, place)]]) is None
    assert through(place, [[good], [line(18, place)]]) is not None
    near = through(place, [[good], [line(80, place, 0.4, cover=0.9), line(80, place, 0.1)]])
    assert near is not None and near.place == pytest.approx(met(good, line(80, place, 0.1)))


@pytest.mark.parametrize("angle", [0, 35, 120])
def test_a_place_along_a_way_is_known_less_along_it_than_across(angle):
    way = cmath.rect(1, radians(angle))
    found = along_way(way, 2.0, 0.3)
    along, across = (np.array([each.real, each.imag]) for each in (way, 1j * way))
    assert along @ found @ along == pytest.approx(4.0)
    assert across @ found @ across == pytest.approx(0.09 + 0.08**2 / 2)
    assert along @ found @ across == pytest.approx(0.0, abs=1e-12)


def test_printed_lines_are_measured_every_3_mm_within_their_ends():
    """0.8 mm from the ends, at four places at least; each with its normal; short ones are not."""
    marks = [
        LineMark(10, 20, 10 + length * x, 20 + length * y, "frame")
        for length, x, y in ((4.4, 1, 0), (4.6, 1, 0), (16.0, 0.6, 0.8), (62.0, 0, 1))
    ]
    found = printed_lines(Page(420, 297, tuple(marks)))
    for (length, count), (x, y), rows in zip(
        ((4.6, 4), (16.0, 4), (62.0, 20)),
        ((1, 0), (0.6, 0.8), (0, 1)),
        (slice(0, 4), slice(4, 8), slice(8, 28)),
        strict=True,
    ):
        step = (length - 1.6) / count
        along = (found.places[rows] - (10, 20)) @ (x, y)
        assert along == pytest.approx(0.8 + step * (np.arange(count) + 0.5))
        assert abs((found.places[rows] - (10, 20)) @ (-y, x)).max() < 1e-9
        assert found.normals[rows] == pytest.approx(np.tile((-y, x), (count, 1)))
    assert len(found.places) == 28 and found.shared.all()
    assert set(found.dark) == {0.10}


def test_the_square_of_a_page_is_the_box_of_its_code():
    page = Page(420, 297, (LineMark(0, 0, 9, 9, "frame"),))
    assert square_of(page) is None
    code = Page(420, 297, square("TZHG6MXPZY", 300.0, 200.0))
    assert square_of(code) == pytest.approx(
        np.array([[300, 200], [320, 200], [320, 220], [300, 220]])
    )


@pytest.mark.parametrize("width", [0.25, 0.5, 0.7])
def test_a_printed_line_is_found_where_its_ink_is(width):
    """By the middle of what is dark, a few hundredths of a mm near; nothing at the profile's ends
    nor on an even shade."""
    across = np.arange(-3.0, 3.05, 0.1)
    middles = np.array([-1.23, -0.4, 0.0, 0.77, 1.5])
    dark = 0.4 / (1 + np.exp((abs(across - middles[:, None]) - width / 2) / 0.04))
    centre, most = peaks((0.1 + dark).astype(np.float32), across, width, 2.0)
    assert centre == pytest.approx(middles, abs=0.03)
    assert (most > 0.15).all()
    _, shade = peaks(np.full((2, len(across)), 0.3, np.float32), across, width, 2.0)
    assert abs(shade).max() < 1e-6
    _, outside = peaks((0.1 + dark[3:4]).astype(np.float32), across, width, 0.74)
    assert outside[0] == 0.0
    for beyond in (-0.15, 0.15):  # what lies beyond where it is looked for is not found at its ends
        for reach in (2.0, 1.1, 1.05):
            middle = np.sign(beyond) * (reach + abs(beyond))
            profile = 0.4 * np.exp(-(((across[None] - middle) / width) ** 2))
            assert peaks(profile.astype(np.float32), across, width, reach)[1][0] == 0.0


def test_a_side_and_a_stretch_are_as_sure_as_their_least_share_that_is_found():
    """Of frame and border along each 100 mm of an edge, wherever these begin; what is not in the
    picture counts for nothing, and too few places tell nothing."""
    x = np.arange(5.0, 415.0, 2.0)
    places = np.array([(each, 5.0) for each in x] + [(each, 150.0) for each in x])
    count = len(places)
    across = np.tile([0.0, 1.0], (count, 1))
    lines = PrintedLines(places, across, np.ones(count), np.ones(count, bool), np.ones(count))
    found = (places[:, 0] < 200) | (places[:, 0] % 4 < 2)
    seen = places[:, 0] < 300
    last = MeasuredLines(lines, np.zeros(count), found, seen)
    assert least_stretch(last, lines) == pytest.approx(0.5, abs=0.03)
    assert least_stretch(MeasuredLines(lines, last.off, found, places[:, 0] < 200), lines) == 1.0
    covered = (places[:, 0] < 60) | (places[:, 0] > 140)  # 60 mm of the first and of the second 100
    last_of = MeasuredLines(lines, last.off, covered, np.ones(count, bool))
    assert least_stretch(last_of, lines) == pytest.approx(0.2, abs=0.03)
    assert ticks_found(last, places[:, 0] >= 200) == pytest.approx(0.5, abs=0.02)
    assert ticks_found(last, places[:, 0] >= 300) == 1.0


def waves(at: np.ndarray) -> np.ndarray:
    """Ripples with waves of 60 and 90 mm, 0.2 mm high, seen from the left."""
    x, y = at.T
    high = 0.2 * (np.sin((x + y) / 13.5) + np.sin((x - 2 * y) / 32))
    return np.stack([high * (0.4 + x / 600), 0.3 * high], axis=-1)


def offsets_at(at: np.ndarray, off: np.ndarray) -> Offsets:
    """How far places lie off to the right and down."""
    ways = np.tile(np.eye(2), (len(at), 1))
    return Offsets(np.repeat(at, 2, axis=0), ways, off.ravel(), np.full(2 * len(at), CROSSED))


def test_a_matrix_without_rows_is_inverted_from_the_inverse_of_the_whole():
    rng = np.random.default_rng(5)
    root = rng.normal(size=(9, 9))
    whole, some = root @ root.T + np.eye(9), np.arange(9) % 4 == 1
    expected = np.linalg.inv(whole[np.ix_(~some, ~some)])
    assert without(np.linalg.inv(whole), some) == pytest.approx(expected)


def test_crosses_tell_the_ripples_between_them():
    """To a third of the waves' height or better wherever they lie among crosses, though one of
    these strays; without them the fields are known as well as if nothing were measured.
    """
    at = np.array(list(places()))
    frame = np.array([(x, y) for y in (10.0, 287.0) for x in np.arange(22.0, 408.0, 3.0)])
    lines = Offsets(frame, np.tile([0.0, 1.0], (len(frame), 1)), waves(frame)[:, 1], 0.05)
    lines = replace(lines, errors=np.full(len(frame), 0.05))
    rng = np.random.default_rng(1)
    off = waves(at) + rng.normal(0, CROSSED, at.shape)
    off[77] += (0.6, -0.5)
    found = ripple_of(lines, offsets_at(at, off))
    between = at[(at[:, 0] < 380) & (at[:, 1] < 180)] + PITCH / 2
    height = np.sqrt((waves(between) ** 2).mean())
    left = np.sqrt(((found(between) - waves(between)) ** 2).mean())
    assert left < height / 3 and left < 2 * found.deviation < height
    bare = ripple_of(lines, offsets_at(at[:0], off[:0]))
    assert abs(bare(between)).max() < 0.05
    flat = ripple_of(replace(lines, off=0 * lines.off), offsets_at(at, 0 * off))
    assert abs(flat(SHEET)).max() == 0.0 and flat.deviation <= LEAST


def test_a_cross_is_found_where_it_is_printed_unless_a_line_hides_it():
    """A few hundredths of a mm near, off its place as far as the paper ripples; one through which a
    hand drew is left out, and paper without crosses has none.
    """
    at, off = np.array([[50.0, 50.0], [70.0, 50.0], [50.0, 70.0], [70.0, 70.0]]), (0.35, -0.65)
    x, y = np.meshgrid(np.arange(1000) / 10, np.arange(1000) / 10)
    dark = np.zeros(x.shape)
    for place in at:
        u, v = abs(x - place[0] - off[0]), abs(y - place[1] - off[1])
        lines = ((u < 0.09) & (v < 1)) | ((v < 0.09) & (u < 1))
        dark = np.maximum(dark, 0.6 * lines)
    dark = np.where(abs(x + y - 140.3) < 0.6, 0.7, dark)  # through the last of them
    picture = cv2.GaussianBlur(np.round(220 * (1 - dark)).astype(np.uint8), (0, 0), 1.2)
    scale = 10 * 210 / np.hypot(500, 500)
    middle = (np.array(A3.middle) * 10 - 499.5) / np.hypot(500, 500)
    over = PaperMap(1000, 1000, (scale, 0, middle[0], 0, scale, middle[1], *[0.0] * (COUNT - 6)))
    assert over(at) == pytest.approx(10 * at)
    found, share = crosses_off(picture, over, at)
    assert share == 0.75 and found.off == pytest.approx(np.tile(off, 3), abs=0.04)
    assert crosses_off(np.full_like(picture, 220), over, at)[1] == 0.0


def from_above(*marks: LineMark) -> tuple[np.ndarray, PaperMap]:
    """Lines of 0.5 mm on white paper, seen straight from above at 4 pixels a mm; the map."""
    picture = np.full((1188, 1680), 230, np.uint8)
    for each in marks:
        ends = np.rint(4 * np.array([[each.x1, each.y1], [each.x2, each.y2]]) - 0.5).astype(int)
        cv2.line(picture, *ends, color=40, thickness=2)
    scale = 4 * A3.half / (np.hypot(*picture.shape) / 2)
    return picture, PaperMap(1680, 1188, (scale, 0, 0, 0, scale, 0, *[0.0] * (COUNT - 6)))


def test_a_sheet_with_lines_of_another_and_some_more_is_not_taken_for_it(monkeypatch):
    """All lines of the lesser are found on the picture of either: on the other's, so are those that
    it lacks."""
    lines = [LineMark(x, 60, x, 200, "panel") for x in (100, 160, 220, 280)]
    less, whole = (Page(420, 297, tuple(some)) for some in (lines[:2], lines))
    for seen, other, likely in ((whole, less, 0.0), (less, whole, 0.5)):
        picture, over = from_above(*seen.marks)
        search = SheetSearch(picture, None)
        monkeypatch.setattr(search, "frame", lambda page, bent, over=over: over)
        assert search.likeness(seen, [other]) == pytest.approx(1.0, abs=0.02)
        assert search.likeness(other, [seen]) == pytest.approx(likely, abs=0.02)


def test_a_profile_is_the_mean_over_a_mm_to_both_sides_of_its_place():
    """A line that begins 1.3 mm farther on is not in it, of one that begins at the place half is,
    and one that passes by is in it whole."""
    _, over = from_above()
    x, y = np.meshgrid(np.arange(1680) / 4, np.arange(1188) / 4)
    across = np.arange(-2.0, 2.05, 0.1)
    for turned in (False, True):
        along, aside = (y - 148.5, x - 210.0) if turned else (x - 210.0, y - 148.5)
        normal = (1.0, 0.0) if turned else (0.0, 1.0)
        one = PrintedLines(
            np.array([A3.middle]), np.array([normal]), np.ones(1), np.ones(1, bool), np.ones(1)
        )
        darkest = []
        for begins in (-2.0, 0.15, 1.3):
            ink = (abs(aside) < 0.5) & (along > begins)
            dark, inside = profiles(np.where(ink, 50, 200).astype(np.uint8), over, one, across)
            assert inside.all()
            darkest.append(dark.max())
        assert darkest == pytest.approx([0.75, 0.75 * 2 / 5, 0.0], abs=0.05)


def test_a_ray_goes_on_over_a_gap_that_is_shorter_than_a_break():
    drawn = np.ones((3, 60), bool)
    drawn[0, 20 : 20 + BREAK - 1] = drawn[1, 20 : 20 + BREAK] = False
    drawn[2, :5] = False
    whole, broken, late = unbroken(drawn)
    assert whole.all() and late.all()
    assert broken.sum() == 20 + BREAK - 1


@pytest.mark.parametrize("turn", [0.0, 130.0])
def test_a_ray_beside_another_one_is_its_stroke(turn):
    """Within 0.6 mm of it as far as that goes, or in about its direction."""
    way = cmath.rect(1, radians(turn))
    for far, parted in (
        (20 + 0.0j, False),
        (5 + 0.5j, False),
        (5 - 0.5j, False),
        (5 + 1.5j, True),
        (-5 + 0.5j, True),
        (0.2 - 9j, True),
    ):
        assert is_parted(far * way, way, 12.0) is parted
    assert is_parted(3 + 0.5j, 1 + 0j, 2.0) and not is_parted(3 + 0.5j, 1 + 0j, 4.0)
    left, top, right, _ = A3.fields
    some = np.array([left + top * 1j, 200 + 150j, right + 150j, 200 + 296j])
    inside = in_fields(some, A3.fields)
    assert list(inside) == [False, True, False, False]
