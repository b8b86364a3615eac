"""Cams by their law: v = s'ω and a = s"ω² + s'ε, by two routes; the profile is the envelope."""

import csv
import io
from fractions import Fraction
from itertools import cycle as in_turn
from itertools import product
from math import cos, pi, radians
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.accuracy.certified import Certifier
from graphkin.cli.report.cycle_report import cycle_table
from graphkin.construction.cams import cam_centre
from graphkin.construction.core.cam_profiles import CamProfile, profiles_of
from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import cycle
from graphkin.numbers.cam_motions import MOTIONS
from graphkin.scene.quantity import exact
from graphkin.scene.read_scene import read_scene, read_text
from graphkin.text.errors import ClosureError
from tests.chosen import EVERY
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

CAMS = [f"cam-{name}" for name in ("roller", "knife", "flat", "rocker", "lever", "table")]
SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
PEAKS = {
    "uniform": (1, 0),
    "parabolic": (2, 4),
    "harmonic": (np.pi / 2, np.pi**2 / 2),
    "cycloidal": (2, 2 * np.pi),
    "3-4-5": (15 / 8, 10 / np.sqrt(3)),
    "4-5-6-7": (35 / 16, 84 / np.sqrt(125)),
    "modified trapezoid": (2, 8 * np.pi / (2 + np.pi)),
    "modified sine": (4 * np.pi / (4 + np.pi), 4 * np.pi**2 / (4 + np.pi)),
}
"""The largest velocity and acceleration of each motion, as the textbooks' factors C_v and C_a."""


def turning(rng, motion, size, base):
    """What cams of random size have in common."""
    speed = 10 ** rng.uniform(-2, 3) * rng.choice([-1, 1])
    return {
        "at": rng.uniform(-180, 180), "O": [size * rng.uniform(-3, 3), size * rng.uniform(-3, 3)],
        "base": size * base, "start": rng.uniform(-180, 180), "clock": bool(rng.integers(2)),
        "speed": speed, "push": speed**2 * rng.uniform(-2, 2),
        "motion": motion, "back": str(rng.choice(list(MOTIONS))),
    }  # fmt: skip


def drawn(rng, tip, motion):
    """A cam of random size, from a micrometre to kilometres, and what it is made of."""
    size, base = 10 ** rng.uniform(-3, 6), rng.uniform(0.5, 1.5)
    data = turning(rng, motion, size, base) | {
        "arm": size * rng.uniform(0.1, 1),
        "lean": rng.uniform(-180, 180),
        "offset": 0 if tip == "flat" else size * base * rng.uniform(-0.4, 0.4),
        "rise": size * rng.uniform(0.1, 0.4),
        "roller": size * rng.uniform(0.1, 0.3) if tip == "roller" else None,
    }
    text = scene_text("construction/cam", tip=tip, fall=-data["rise"], **data)
    return read_text(text, "cam"), data


def drawn_lever(rng, tip, motion):
    """A lever of random size on either side of its cam, and what it is made of."""
    size, way = 10 ** rng.uniform(-3, 6), rng.uniform(-np.pi, np.pi)
    apart, radius = size * rng.uniform(1.8, 2.6), size * rng.uniform(0.1, 0.3)
    data = turning(rng, motion, size, rng.uniform(0.5, 0.8)) | {
        "arm": apart * rng.uniform(0.8, 1.1),
        "side": str(rng.choice(["left", "right"])),
        "rise": rng.uniform(5, 25),
        "roller": radius if tip == "roller" else None,
        "face": radius if tip == "flat" else None,
    }
    data["Q"] = [data["O"][0] + apart * np.cos(way), data["O"][1] + apart * np.sin(way)]
    text = scene_text("construction/cam-with-a-lever", tip=tip, fall=-data["rise"], **data)
    return read_text(text, "lever"), data


def by_hand(data, at):
    """s' and s" (m by radian of the cam, counter-clockwise) of the law of ``TEXT``, by itself."""
    sense = -1 if data["clock"] else 1
    angle = np.radians((sense * (at - data["start"])) % 360)
    low, high, rise, motion = 0.0, 0.0, 0.0, "uniform"
    pieces = ((110, data["rise"], data["motion"]), (170, 0, "uniform"))
    pieces += ((310, -data["rise"], data["back"]), (360, 0, "uniform"))
    for to, lift, name in pieces:
        if angle < np.radians(to):
            high, rise, motion = np.radians(to), lift / 1000, name
            break
        low = np.radians(to)
    found, span = MOTIONS[motion](float((angle - low) / (high - low))), high - low
    return sense * rise * found.rate / span, rise * found.bend / span**2


@pytest.mark.parametrize("name", MOTIONS)
def test_a_motion_rises_from_zero_to_one_and_its_derivatives_are_right(name):
    motion, step = MOTIONS[name], 1e-5
    assert motion(0.0).at == pytest.approx(0, abs=1e-12)
    assert motion(1.0).at == pytest.approx(1, abs=1e-12)
    for u in np.linspace(0.0137, 0.9911, 60):
        before, here, after = (motion(float(u + k * step)) for k in (-1, 0, 1))
        assert (after.at - before.at) / (2 * step) == pytest.approx(here.rate, abs=1e-7)
        assert (after.rate - before.rate) / (2 * step) == pytest.approx(here.bend, abs=1e-5)


@pytest.mark.parametrize("name", PEAKS)
def test_the_largest_velocity_and_acceleration_are_those_of_the_textbooks(name):
    found = MOTIONS[name](np.linspace(0, 1, 48_001))
    peaks = abs(found.rate).max(), abs(found.bend).max()
    assert peaks == pytest.approx(PEAKS[name], rel=1e-6)
    assert set(PEAKS) == set(MOTIONS)


TIPS = ("roller", "knife", "flat")
PAIRS = list(product(TIPS, MOTIONS) if EVERY else zip(in_turn(TIPS), MOTIONS))
"""Each motion on each tip, or on one of them in turn."""


@pytest.mark.parametrize(("tip", "motion"), PAIRS)
def test_both_routes_and_the_law_agree_all_the_way_round(tip, motion):
    """At 8 positions: v = s'ω and a = s"ω² + s'ε, by the equivalent linkage and by the loops."""
    rng = np.random.default_rng([len(tip), len(motion), list(MOTIONS).index(motion)])
    scene, data = drawn(rng, tip, motion)
    for at in np.linspace(-180, 180, 8, endpoint=False) + 3.3:
        here = replace(scene, values={**scene.values, "at": Fraction(float(at))})
        mechanism = Mechanism(here)
        solution = mechanism.solve()
        slide = solution.slides["follower"]
        rate, bend = by_hand(data, at)
        pushed = data["rise"] / 1000 * data["speed"] ** 2
        assert slide.speed == pytest.approx(rate * data["speed"], abs=1e-9 * pushed / 1e-3)
        expected = bend * data["speed"] ** 2 + rate * data["push"]
        assert slide.acceleration == pytest.approx(expected, rel=1e-8, abs=1e-9 * pushed)
        assert mechanism.witness(solution).agrees


@pytest.mark.parametrize(("tip", "motion"), PAIRS)
def test_a_lever_swings_by_its_law_all_the_way_round(tip, motion):
    """At 8 positions: ω = ψ'ω₁ and ε = ψ"ω₁² + ψ'ε₁ away from the cam, by both routes."""
    rng = np.random.default_rng([7, len(tip), list(MOTIONS).index(motion)])
    scene, data = drawn_lever(rng, tip, motion)
    away = -1 if data["side"] == "left" else 1
    swung = {**data, "rise": np.radians(data["rise"]) * 1000}  # by_hand divides by it
    for at in np.linspace(-180, 180, 8, endpoint=False) + 3.3:
        mechanism = Mechanism(replace(scene, values={**scene.values, "at": Fraction(float(at))}))
        solution = mechanism.solve()
        lever = solution.links["lever"]
        rate, bend = by_hand(swung, at)
        size = abs(data["speed"])
        assert lever.omega == pytest.approx(away * rate * data["speed"], rel=1e-8, abs=1e-8 * size)
        expected = away * (bend * data["speed"] ** 2 + rate * data["push"])
        assert lever.epsilon == pytest.approx(expected, rel=1e-7, abs=1e-8 * size**2)
        assert mechanism.witness(solution).agrees


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_lever_stands_on_the_side_that_is_written(side):
    text = (SCENES / "cam-rocker.toml").read_text(encoding="utf-8")
    scene = read_text(text.replace('side = "left"', f'side = "{side}"'), "cam")
    places = {name: each.position for name, each in Mechanism(scene).solve().points.items()}
    pin, tip = places["Q"] - places["O"], places["B"] - places["O"]
    assert ((pin.conjugate() * tip).imag > 0) is (side == "left")


def test_on_the_base_circle_a_lever_rests_at_its_radius():
    rocker = load(SCENES / "cam-rocker.toml", angle=0).solve().points
    assert abs(rocker["B"].position) == pytest.approx(0.042, abs=1e-15)
    lever = load(SCENES / "cam-lever.toml", angle=0).solve().points
    bar = lever["B"].position - lever["Q"].position
    beside = (bar.conjugate() * lever["Q"].position).imag / abs(bar)
    assert abs(beside) == pytest.approx(0.044, abs=1e-15)


@pytest.mark.parametrize("face", [0, 1, 2])
@pytest.mark.parametrize(
    "scene", ["cam-roller", "cam-rocker", "cam-lever", "cam-plate", "cam-plate-lever", "cam-fixed"]
)
def test_a_wrong_law_in_the_construction_does_not_pass_the_witness(face, scene, monkeypatch):
    plate = ("plate_lift", "plate_rate", "plate_bend")
    name = (plate if "plate" in scene else ("lift", "lift_rate", "lift_bend"))[face]
    right = getattr(cam_centre, name)
    wrong = replace(right, value=lambda *args: right.value(*args) * 1.001)
    monkeypatch.setattr(cam_centre, name, wrong)
    mechanism = load(SCENES / f"{scene}.toml")
    assert not mechanism.witness(mechanism.solve()).agrees


@pytest.mark.parametrize("angle", [0, 40, 95, 200, 300])
def test_an_eccentric_disc_by_its_law_is_the_disc(angle):
    """A flat face on a harmonic cam moves as on a disc, whose centre is that of curvature."""
    law = load(SCENES / "cam-flat.toml", angle=angle).solve()
    disc = load(SCENES / "mobility-cam.toml", angle=angle).solve()
    for ours, other in (("F", "F"), ("K", "E")):
        assert law.points[ours].position == pytest.approx(disc.points[other].position, abs=1e-12)
    assert law.points["F"].velocity == pytest.approx(disc.points["F"].velocity, abs=1e-12)
    assert law.points["F"].acceleration == pytest.approx(disc.points["F"].acceleration, abs=1e-11)


@pytest.mark.parametrize("name", CAMS)
def test_the_profile_is_the_envelope_of_the_follower(name):
    """Seen from the cam the tip always touches the outline, and never cuts into it."""
    mechanism = load(SCENES / f"{name}.toml")
    profile = CamProfile(mechanism.scene, "2", 3600)
    for number in range(0, 3600, 150):
        turn = np.exp(1j * profile.angles[number])
        outline = profile.outline * turn
        if profile.cam.is_flat:
            normal = profile.flat.normal * np.ones(3600)
            gap = (profile.flat.gap - (outline * np.conj(normal[number])).real.max())[number]
        else:
            gap = abs(outline - profile.tip.place[number]).min() - profile.roller
        assert gap == pytest.approx(0, abs=1e-6)


def test_a_dwell_has_its_centre_of_curvature_at_the_pivot():
    mechanism = load(SCENES / "cam-roller.toml", angle=150)
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    assert solution.points["K"].position == pytest.approx(0, abs=1e-15)
    assert solution.points["B"].velocity == pytest.approx(0, abs=1e-14)


def test_a_cam_with_too_small_a_base_circle_is_undercut():
    text = (SCENES / "cam-roller.toml").read_text(encoding="utf-8")
    small = text.replace("base = 40", "base = 12").replace("to = 120", "to = 40")
    for written, sharp in ((text, False), (small, True)):
        profile = CamProfile(read_text(written, "cam"), "2")
        assert (profile.sharpest[0] <= 0) is sharp


@pytest.mark.parametrize("angle", [0, 20, 90, 120, 150, 180, 230, 270, 300])
def test_balls_decide_on_which_piece_a_cam_stands(angle):
    """Nothing fails in them, not even at the borders of the pieces."""
    mechanism = load(SCENES / "cam-roller.toml", angle=angle)
    balls = Certifier.of(mechanism).run(120, narrowed=False)
    assert not balls.blame
    assert float(balls.trace.value("slide", "2").rad()) < 1e-30


def test_the_pressure_angle_is_that_of_the_closed_form():
    """tan α = |s' - e| / (s + sqrt(r² - e²)), the offset e to the right of a guide upwards."""
    mechanism = load(SCENES / "cam-roller.toml")
    profile = CamProfile(mechanism.scene, "2")
    reach = np.sqrt(0.05**2 - 0.01**2) + profile.rise.at
    expected = np.degrees(np.arctan(abs(profile.rise.rate - 0.01) / reach))
    assert profile.pressure == pytest.approx(expected, abs=1e-9)


def test_the_table_of_a_cycle_has_the_pressure_angle_and_the_radius_of_curvature():
    """tan α of the row's angle; the mean radius of a disc about its own centre is its radius."""
    rows = list(csv.DictReader(io.StringIO(cycle_table(cycle(load(SCENES / "cam-roller.toml"))))))
    assert len(rows) > 300
    for row in rows[::20]:
        solved = load(SCENES / "cam-roller.toml", angle=Fraction(row["phi [deg]"])).solve()
        normal = solved.points["B"].position - solved.points["K"].position
        slope = abs(np.degrees(np.arctan2(normal.real, normal.imag)))
        assert float(row["pressure_2 [deg]"]) == pytest.approx(slope, abs=1e-9)
        rho = abs(normal) - 0.01
        assert float(row["radius_2 [m]"]) == pytest.approx(rho, rel=1e-9)


def test_the_table_has_the_pressure_angle_of_a_cam_that_a_gear_turns():
    """The gear goes half as fast and back: the same angles as of the cam turned there by hand."""
    text = (SCENES / "cam-roller.toml").read_text(encoding="utf-8")
    frame = "[frame]\nO = [0, 0]\n"
    drive = '[links.drive]\nG = [0, 0]\nwheel = { centre = "G", radius = 30 }\n'
    gear = 'wheel = { centre = "O", radius = 60 }\nrolls = { on = "drive" }\n'
    text = text.replace(frame, f"{frame}G = [90, 0]\n{drive}")
    text = text.replace("[links.1] ", f"[links.1]\n{gear}# ")
    geared = Mechanism(read_text(text.replace("turn = 1", 'turn = "drive"'), "geared"))
    rows = csv.DictReader(io.StringIO(cycle_table(cycle(geared, steps=24))))
    direct = load(SCENES / "cam-roller.toml").scene
    for row in rows:
        profile = CamProfile(direct, "2", given=np.radians([-float(row["phi [deg]"]) / 2]))
        assert float(row["pressure_2 [deg]"]) == pytest.approx(profile.pressure[0], abs=1e-9)
        assert float(row["radius_2 [m]"]) == pytest.approx(profile.radius[0], rel=1e-9)


def turned_tables(text, table):
    """The scene of a cam with its law by another table."""
    begin, end = text.index("law = ["), text.index("[[drivers]]")
    return text[:begin] + f"law = {table}\n\n" + text[end:]


def by_second_derivatives(x, y):
    """The periodic spline through points as a function: its value and both derivatives.

    Its second derivatives at the points are the unknowns of a full system (Press, Numerical
    Recipes, section 3.3).
    """
    count, h = len(x) - 1, np.diff(x)
    system, right = np.zeros((count, count)), np.zeros(count)
    for i in range(count):
        system[i, i - 1] += h[i - 1] / 6
        system[i, i] += (h[i - 1] + h[i]) / 3
        system[i, (i + 1) % count] += h[i] / 6
        right[i] = (y[i + 1] - y[i]) / h[i] - (y[i] - y[i - 1 if i else count - 1]) / h[i - 1]
    bends = np.linalg.solve(system, right)
    bends = np.append(bends, bends[0])

    def spline(at):
        i = min(int(np.searchsorted(x, at, side="right")) - 1, count - 1)
        a, b = (x[i + 1] - at) / h[i], (at - x[i]) / h[i]
        cubes = (a**3 - a) * bends[i] + (b**3 - b) * bends[i + 1]
        squares = (3 * b * b - 1) * bends[i + 1] - (3 * a * a - 1) * bends[i]
        value = a * y[i] + b * y[i + 1] + cubes * h[i] ** 2 / 6
        rate = (y[i + 1] - y[i]) / h[i] + squares * h[i] / 6
        return value, rate, a * bends[i] + b * bends[i + 1]

    return spline


def test_a_table_moves_the_follower_by_the_periodic_spline_through_it():
    """The spline by its second derivatives, at 20 positions, between the points and at them."""
    rng = np.random.default_rng(24)
    text = (SCENES / "cam-table.toml").read_text(encoding="utf-8")
    angles = [0, *sorted(rng.choice(np.arange(12, 350), 11, replace=False).tolist())]
    lifts = [0, *rng.uniform(0, 25, 11).round(2).tolist()]
    table = [[angle, lift] for angle, lift in zip(angles, lifts, strict=True)]
    scene = read_text(turned_tables(text, table).replace("base = 40", "base = 400"), "cam")
    radians = np.radians([*angles, 360])
    spline = by_second_derivatives(radians, np.array([*lifts, 0]) / 1000)
    omega = 200 * np.pi / 30
    for at in [*rng.uniform(0, 360, 8), *angles]:
        here = replace(scene, values={**scene.values, "angle": Fraction(float(at))})
        mechanism = Mechanism(here)
        solution = mechanism.solve()
        lift, rate, bend = spline(np.radians(at) % (2 * np.pi))
        slide = solution.slides["2"]
        assert slide.position - 0.408 == pytest.approx(lift, abs=1e-12)
        assert slide.speed == pytest.approx(rate * omega, abs=1e-10)
        assert slide.acceleration == pytest.approx(bend * omega**2, abs=1e-8)
        assert mechanism.witness(solution).agrees


@pytest.mark.parametrize("slides", [False, True])
def test_the_second_roller_touches_the_conjugate_profile_all_the_way_round(slides):
    """Its circle keeps its radius from the profile, and is nowhere nearer; the motion stays."""
    text = (SCENES / "cam-conjugate.toml").read_text(encoding="utf-8")
    if slides:
        roller = (SCENES / "cam-roller.toml").read_text(encoding="utf-8")
        text = roller.replace("B = [0, 0]", "B = [0, 0]\nC = [-110, 6]", 1)
        text = text.replace("law = [", 'conjugate = { at = "C", roller = 12 }\nlaw = [', 1)
    scene = read_text(text, "cam")
    (follower,) = scene.cams
    both = profiles_of(scene, follower, 1440)
    radius = both[1].roller
    for at in range(0, 360, 30):
        here = Mechanism(replace(scene, values={**scene.values, "angle": Fraction(at)}))
        solution = here.solve()
        cam = np.exp(1j * np.radians(at))
        place = (solution.points["C"].position - solution.points["O"].position) / cam
        away = abs(both[1].outline - place)
        assert away.min() == pytest.approx(radius, rel=2e-3)
        single = read_text(text.replace("conjugate = ", "# "), "cam")
        alone = Mechanism(replace(single, values=here.scene.values)).solve()
        assert alone.points["B"].acceleration == solution.points["B"].acceleration


def test_where_the_pitch_curve_is_straight_the_centre_lies_at_infinity():
    """Between hollow and hump r² + 2r'² = r r", where K runs to infinity: told, never made up."""
    numbers = {"at": 340.2436726472059, "O": [0, 0], "arm": 20, "lean": 90, "offset": 0}
    numbers |= {"base": 30, "roller": 8, "start": 0, "rise": 30, "fall": -30, "speed": 5, "push": 0}
    words = {"tip": "roller", "motion": "3-4-5", "back": "3-4-5", "clock": True}
    text = scene_text("construction/cam", **numbers, **words).replace("to = 110", "to = 60")
    straight = r"K lies at infinity: the pitch curve of link cam is straight at the contact"
    with pytest.raises(ClosureError, match=straight):
        Mechanism(read_text(text, "straight")).solve()


def test_lifts_of_a_table_may_be_expressions():
    """The spline is linear in its lifts: with parameters it moves as with their values."""
    rng, text = np.random.default_rng(5), (SCENES / "cam-table.toml").read_text(encoding="utf-8")
    angles = [0, *sorted(rng.choice(np.arange(12, 350), 7, replace=False).tolist())]
    lifts = [Fraction(0), *(Fraction(int(n), 7) for n in rng.integers(1, 160, 7))]
    written = [0.0, *map(float, lifts[1:4]), '"h/7"', '"3*h/7 - 1"', *map(float, lifts[6:])]
    lifts[4], lifts[5] = Fraction(55, 7), Fraction(165, 7) - 1
    table = ", ".join(f"[{at}, {lift}]" for at, lift in zip(angles, written, strict=True))
    table = f"[{table}]"
    plain = [[at, float(lift)] for at, lift in zip(angles, lifts, strict=True)]
    scene = read_text(
        turned_tables(text, table).replace("[parameters]", "[parameters]\nh = 55"), "cam"
    )
    other = read_text(turned_tables(text, plain), "cam")
    for at in (0, 47, 133, 201, 300, 359):
        solutions = [
            Mechanism(replace(each, values={**each.values, "angle": Fraction(at)})).solve()
            for each in (scene, other)
        ]
        one, same = (solution.slides["2"] for solution in solutions)
        assert one.position == pytest.approx(same.position, rel=1e-14)
        assert one.speed == pytest.approx(same.speed, rel=1e-12, abs=1e-13)
        assert one.acceleration == pytest.approx(same.acceleration, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("name", ["cam-on-a-gear", "cam-on-a-rocker"])
def test_a_cam_that_any_link_turns_lifts_by_its_law(name):
    """v = s'ω and a = s"ω² + s'ε with ω and ε of the cam's own link, and both routes agree."""
    scene = read_scene(Path(__file__).parent / "scenes" / f"{name}.toml")
    (follower,) = scene.cams
    cam = scene.cams[follower]
    for at in np.linspace(0, 360, 12, endpoint=False) + 7.1:
        turned = replace(scene.drivers[0], position=exact(Fraction(float(at)), "deg"))
        mechanism = Mechanism(replace(scene, drivers=(turned,)))
        trace, solution = mechanism.trace(), mechanism.solve()
        shaft = solution.links[cam.on]
        rise = cam.displacement(trace.value("axis", cam.on), scene.values)
        if cam.lever:
            found, away = solution.links[follower], -cam.lever.side
            rates = found.omega, found.epsilon
        else:
            slide, away = solution.slides[follower], 1
            rates = slide.speed, slide.acceleration
        bent = rise.bend * shaft.omega**2 + rise.rate * shaft.epsilon
        assert rates[0] == pytest.approx(away * rise.rate * shaft.omega, rel=1e-10, abs=1e-12)
        assert rates[1] == pytest.approx(away * bent, rel=1e-9, abs=1e-9)
        assert mechanism.witness(solution).agrees


CURVED = sorted(MOTIONS.keys() - {"uniform"})


def plate(rng, motion, *, swings):
    """A plate of random size under a follower of either kind, and what it is made of."""
    size, base, way = 10 ** rng.uniform(-3, 6), rng.uniform(0.2, 0.5), rng.uniform(-np.pi, np.pi)
    roller = size * rng.uniform(0.05, 0.1) if rng.integers(2) else None
    place, e = size * complex(*rng.uniform(-3, 3, 2)), np.exp(1j * way)
    beside, up = size * rng.uniform(-0.5, 0.5), 1j * e * rng.choice([-1, 1])
    arm = size * rng.uniform(0.6, 0.9)
    pin = place + 1j * e * beside + e * size * rng.uniform(-1, 1)
    pin += up * (size * base + (roller or 0) + arm * rng.uniform(0.2, 0.6))
    speed = size * 10 ** rng.uniform(-2, 3) * rng.choice([-1, 1])
    rise = rng.uniform(5, 20) if swings else size * rng.uniform(0.1, 0.3)
    data = {
        "O": [place.real, place.imag], "way": np.degrees(way), "beside": beside,
        "base": size * base, "roller": roller, "tip": "roller" if roller else "knife",
        "start": size * rng.uniform(-2, 2), "back": bool(rng.integers(2)), "motion": motion,
        "first": size * rng.uniform(0.8, 1.2), "second": size * rng.uniform(1.7, 2.1),
        "rise": rise, "fall": -rise * rng.uniform(0.3, 1),
        "speed": speed, "push": speed**2 / size * rng.uniform(-2, 2),
    }  # fmt: skip
    lean, side = np.angle(up, deg=True) + rng.uniform(-40, 40), ("left", "right")[rng.integers(2)]
    at = [pin.real, pin.imag]
    swung = {"Q": at, "arm": arm, "side": side}, {"B": [0, 0], "guide": at, "lean": lean}
    data |= dict.fromkeys(key for some in swung for key in some) | swung[not swings]
    return read_text(scene_text("construction/cam-plate", **data), "plate"), data


def along_plate(data, x):
    """s' and s" of the law of ``PLATE`` at a coordinate x, in its own units."""
    sense = -1 if data["back"] else 1
    way = sense * (x - data["start"])
    low, high, rise, name = 0.0, data["first"], data["rise"], data["motion"]
    if way > high:
        low, high, rise, name = high, data["second"], data["fall"], "harmonic"
    found, span = MOTIONS[name]((way - low) / (high - low)), high - low
    return sense * rise * found.rate / span, rise * found.bend / span**2


@pytest.mark.parametrize(
    ("motion", "swings"),
    [*product(CURVED, [False, True])] if EVERY else [*zip(CURVED, in_turn([False, True]))],
)
def test_a_plate_lifts_and_swings_by_its_law(motion, swings):
    """v = s'ẋ and a = s"ẋ² + s'ẍ, ω = ψ'ẋ and ε = ψ"ẋ² + ψ'ẍ, by both routes along the law."""
    rng = np.random.default_rng([11, swings, CURVED.index(motion)])
    scene, data = plate(rng, motion, swings=swings)
    sense, away = -1 if data["back"] else 1, -1 if data["side"] == "left" else 1
    unit = np.pi / 180 if swings else 1e-3
    for share in (0.06, 0.17, 0.36, 0.44, 0.63, 0.81, 0.94):
        x = data["start"] + sense * share * data["second"]
        mechanism = Mechanism(replace(scene, values={**scene.values, "at": Fraction(float(x))}))
        solution = mechanism.solve()
        rate, bend = along_plate(data, x)
        speed, push = data["speed"], data["push"]
        expected = np.array([rate * speed, bend * speed**2 + rate * push]) * unit * away
        moved = solution.links["follower"] if swings else solution.slides["follower"]
        found = (moved.omega, moved.epsilon) if swings else (moved.speed, moved.acceleration)
        scale = abs(data["rise"] * unit / data["first"] * speed)
        assert found[0] == pytest.approx(expected[0], rel=1e-8, abs=1e-8 * scale)
        pushed = scale * abs(speed) / data["first"]
        assert found[1] == pytest.approx(expected[1], rel=1e-7, abs=1e-7 * pushed)
        assert mechanism.witness(solution).agrees


@pytest.mark.parametrize("swings", [False, True])
def test_the_profile_of_a_plate_is_the_envelope_of_its_roller(swings):
    """Set at any coordinate, the profile touches the roller, and does not cut into it."""
    for seed in range(6):
        scene, _ = plate(np.random.default_rng([5, seed, swings]), "cycloidal", swings=swings)
        profile = CamProfile(scene, "follower", 4000)
        outline, size = profile.outline[:-2], float(np.ptp(profile.angles))
        if profile.sharpest[0] <= 0:
            continue
        for number in range(600, 3400, 400):
            at = profile.plate.along * (outline + profile.angles[number])
            gap = abs(at - profile.tip.place[number]).min() - profile.roller
            assert gap == pytest.approx(0, abs=1e-4 * size)


def test_a_plate_is_level_before_and_past_its_law_where_no_circle_stands_for_it():
    scene = load(SCENES / "cam-plate.toml").scene
    for x in (-3, 170):
        beside = replace(scene, values={**scene.values, "x": Fraction(x)})
        with pytest.raises(ClosureError, match=r"straight at the contact.*a guide on the plate"):
            Mechanism(beside).solve()
    profile = CamProfile(scene, "2", 2000)
    assert profile.outline[0].imag == pytest.approx(0.015, abs=1e-12)
    assert profile.outline[1999].imag == pytest.approx(0.015, abs=1e-12)
    assert max(profile.outline.imag) == pytest.approx(0.040, abs=1e-6)


def test_the_pressure_angle_of_a_plate_is_the_slope_of_its_pitch_curve():
    """tan α = s' where the guide stands square to the path, as on any wedge."""
    profile = CamProfile(load(SCENES / "cam-plate.toml").scene, "2")
    expected = np.degrees(np.arctan(abs(profile.rise.rate)))
    assert profile.pressure == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("name", ["cam-fixed", "cam-fixed-lever", "cam-carried"])
def test_an_arm_sees_the_cam_move_as_its_law_says(name):
    """v = s'ω and a = s"ω² + s'ε with the cam's rates against the arm, by both routes."""
    text = (SCENES / f"{name}.toml").read_text(encoding="utf-8")
    fixed = "fixed" in name
    data = {"start": 0.0, "clock": fixed, "rise": 1000.0}
    data |= {"motion": "cycloidal", "back": "3-4-5"}
    begin, end = text.index("law = ["), text.index("[[drivers]]")
    rise = {"cam-fixed": 20, "cam-fixed-lever": 20, "cam-carried": 10}[name]
    law = f"""law = [{{ to = 110, rise = {rise}, motion = "cycloidal" }}, {{ to = 170 }},
      {{ to = 310, rise = -{rise}, motion = "3-4-5" }}, {{ to = 360 }}]\n"""
    text = text[:begin] + law + text[end:]
    for angle in range(5, 360, 40):
        mechanism = Mechanism(read_text(text, "cam", None, {"angle" if fixed else "alpha": angle}))
        solution = mechanism.solve()
        assert mechanism.witness(solution).agrees
        arm = solution.links["1"]
        own = solution.links["2"]
        cam = (0.0, 0.0, 0.0) if fixed else (angle + 50, own.omega, own.epsilon)
        at, speed, push = (a - b for a, b in zip(cam, (angle, arm.omega, arm.epsilon), strict=True))
        rate, bend = by_hand(data, at)
        first, second = rate * speed, bend * speed**2 + rate * push
        if name == "cam-fixed-lever":
            unit, size = np.radians(20), 1.0
            found = arm.omega - own.omega, arm.epsilon - own.epsilon
        else:
            unit = 0.02 if fixed else 0.01
            slide = solution.slides["2" if fixed else "3"]
            found, size = (slide.speed, slide.acceleration), 0.01
        assert found[0] == pytest.approx(first * unit, rel=1e-9, abs=1e-9 * size)
        assert found[1] == pytest.approx(second * unit, rel=1e-9, abs=1e-8 * size)


@pytest.mark.parametrize("name", ["cam-plate", "cam-plate-lever", "cam-fixed", "cam-fixed-lever"])
def test_the_table_of_a_cycle_has_the_pressure_angle_of_such_a_cam(name):
    """Of the bar K-B with the way on which the follower's guide or pin leads B."""
    scene, follower = load(SCENES / f"{name}.toml").scene, "4" if "plate-" in name else "2"
    (key,), checked = scene.parameters, 0
    rows = csv.DictReader(io.StringIO(cycle_table(cycle(Mechanism(scene), steps=24))))
    for row in rows:
        value = float(next(iter(row.values()))) * (1000 if key == "x" else 1)
        values = {**scene.values, key: Fraction(value)}
        try:
            points = Mechanism(replace(scene, values=values)).solve().points
        except ClosureError:
            continue  # straight there
        tip = points["B"].position
        ways = {"cam-plate": 1j, "cam-fixed": tip}
        way = ways[name] if name in ways else 1j * (tip - points["Q"].position)
        slope = abs(np.degrees(np.angle((tip - points["K"].position) / way)))
        slope = min(slope, 180 - slope)
        assert float(row[f"pressure_{follower} [deg]"]) == pytest.approx(slope, abs=1e-6)
        checked += 1
    assert checked > 14


LEVER_ON_A_BAR = scene_text("construction/cam-lever-on-a-bar")


def test_a_lever_may_be_a_block_on_a_bar_that_comes_later():
    """It swings about its pin on the cam's carrier all the same, by its law alone: 5° of rise
    in half a turn, cycloidal."""
    lever = Mechanism(read_text(LEVER_ON_A_BAR, "lever"))
    found = lever.solve()
    assert lever.scene.cams["2"].lever is not None
    assert lever.witness(found).agrees
    share = 70 / 180
    rate = radians(5) / pi * (1 - cos(2 * pi * share)) * 5
    assert abs(found.links["2"].omega) == pytest.approx(rate, rel=1e-9)


TAKEN = scene_text("construction/cam-beside-a-letter")


def test_a_centre_of_curvature_takes_a_letter_that_no_point_has():
    """Its name is none of the scene's business: the motion is that without a point K."""
    own, other = mechanism_of(TAKEN), mechanism_of(TAKEN.replace("K =", "P ="))
    assert [cam.centre for cam in own.scene.cams.values()] == ["K1"]
    assert [cam.centre for cam in other.scene.cams.values()] == ["K"]
    found, expected = own.solve(), other.solve()
    assert found.points["B"] == expected.points["B"]
    assert own.witness(found).agrees
