"""solve --digits: every digit that is printed is the right one, and what is not decided is said."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from pathlib import Path

import pytest

from graphkin.accuracy.certified import DOUBLINGS, decimals, precisions
from graphkin.cli.report.certified_report import certified_text, certify
from graphkin.cli.report.solution_record import record
from graphkin.construction.core.solution import gathered
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.kinds import ball_kind, decimal_kind
from tests.chosen import HALVES
from tests.mechanisms import HEAD, mechanism_of
from tests.numbers.conftest import TOUCHING

COMPARED = ("position", "velocity", "acceleration", "omega", "epsilon")
SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
MECHANISMS = Path(__file__).parents[1] / "scenes"
CRANK = """
{time}
[frame]
O = [0, 0]
[links.1]
O-A = {radius}
[[drivers]]
turn = 1
angle = {angle}
"""


def certified(mechanism: Mechanism, digits: int, targets=None):
    """The record of a mechanism in certified digits."""
    trace = mechanism.trace(targets)
    found = record(mechanism.scene, gathered(trace), None, None)
    return certify(mechanism, found, digits, targets)


def leaves(value, path: str = "") -> Iterator[tuple[str, object]]:
    """Every number of a record, with its path."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from leaves(part, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for axis, part in zip("xy", value, strict=True):
            yield from leaves(part, f"{path}.{axis}")
    else:
        yield path, value


def digits_of(number, digits: int) -> Decimal:
    """A decimal of mpmath, rounded to so many digits by Python's own decimals."""
    wide = Context(prec=len(str(number)) + 10)
    return Context(prec=digits, rounding=ROUND_HALF_EVEN).plus(wide.create_decimal(str(number)))


# --- digits --------------------------------------------------------------------------------------


@pytest.mark.parametrize("digits", [1, 2, 5, 16, 30, 100])
@pytest.mark.parametrize("name", ["pump", "oscillating-slide", "stephenson-3-crank", "gears-ring"])
def test_every_digit_is_that_of_decimals_with_many_more(name, digits):
    mechanism = load("pump", n=7) if name == "pump" else load(SCENES / f"{name}.toml")
    found = certified(mechanism, digits)
    solution = gathered(mechanism.trace(kind=decimal_kind(digits + 60)))
    compared = 0
    for section in ("points", "links"):
        for path, text in leaves(found[section], section):
            _, item, key, *axis = path.split(".")
            if text is None or key not in COMPARED or item not in getattr(solution, section):
                continue
            value = getattr(getattr(solution, section)[item], key)
            if value is None:
                continue
            part = value if not axis else value.real if axis == ["x"] else value.imag
            if Decimal(text) == 0:
                assert abs(part) < 1e-50
                continue
            assert Decimal(text) == digits_of(part, digits), path
            assert significant(text) == digits, path
            compared += 1
    assert compared > 12


def significant(text: str) -> int:
    """How many significant digits are printed."""
    return len(text.lower().partition("e")[0].lstrip("-0.").replace(".", ""))


def test_a_thousand_digits_of_the_pump():
    mechanism = load("pump", n=7)
    found = certified(mechanism, 1000)
    assert found["undecided"] == {}
    assert found["bits"] == next(precisions(1000))[0]
    solution = gathered(mechanism.trace(kind=decimal_kind(1100)))
    expected = digits_of(solution.points["D"].velocity.real, 1000)
    assert Decimal(found["points"]["D"]["velocity"][0]) == expected


def test_what_is_exact_looks_exact():
    found = certified(load("pump", n=7), 30)
    assert found["points"]["O2"]["position"] == ["0", "-0.300000000000000000000000000000"]
    assert found["points"]["D"]["velocity"][1] == "0"
    assert found["links"]["1"]["epsilon"] == "0"
    assert found["links"]["5"]["instant_centre"] is None
    assert found["undecided"] == {}


def test_a_number_that_only_comes_to_zero_in_fractions_is_zero():
    """A plate stands 90 mm back and its wheel's zero 90 mm ahead: 0.09 is no binary number."""
    found = certified(load(SCENES / "roller-plates.toml"), 20)
    assert found["points"]["O"]["position"] == ["0", "0.10000000000000000000"]


@pytest.mark.parametrize(
    "name",
    [
        "centrodes-roller",
        "gears-pair",
        "gears-planet",
        "gears-rack",
        "gears-ring",
        "roller",
        "roller-plates",
    ],
)
def test_what_vanishes_by_construction_is_zero(name):
    """ε of gears that turn steadily, a rack across its track, a centre on the rail."""
    assert certified(load(SCENES / f"{name}.toml"), 20)["undecided"] == {}


def test_a_velocity_across_a_level_guide_is_zero():
    """Of the valve rod of a Walschaerts gear, whose links are all oblique."""
    found = certified(load(MECHANISMS / "walschaerts.toml"), 20)
    assert found["points"]["V"]["velocity"][1] == found["points"]["V"]["acceleration"][1] == "0"
    assert found["undecided"] == {}


@pytest.mark.parametrize("name", HALVES[0])
def test_every_scene_prints_and_tells_what_it_does_not_print(name):
    mechanism = load(SCENES / f"{name}.toml")
    usual = record(mechanism.scene, mechanism.solve(), None, None)
    found = certify(mechanism, usual, 20)
    told = found["undecided"]
    for section in ("points", "links", "slides"):
        plain = dict(leaves(usual[section], section))
        for path, text in leaves(found[section], section):
            if text is not None:
                assert path not in told
                if plain.get(path) is not None:
                    assert float(text) == pytest.approx(plain[path], rel=1e-8, abs=1e-9)
            elif plain.get(path) is not None:
                assert told[path].startswith("zero within ±1e-")
                assert abs(plain[path]) < 1e-9
    assert all(words.endswith("not decided") for words in told.values())
    assert certified_text(mechanism.scene, found, None).count("not decided") >= len(told)


# --- a ball and its digits -----------------------------------------------------------------------


def ball(middle: str, radius: str = "0"):
    """A ball of 400 bits about a decimal; one that ends in binary is exact."""
    from flint import arb

    with ball_kind(400).working():
        return arb(middle) + arb(0, radius) if radius != "0" else arb(middle)


@pytest.mark.parametrize(
    ("middle", "radius", "digits", "text"),
    [
        ("0", "0", 5, "0"),
        ("0.5", "0", 5, "0.50000"),
        ("0.3", "0", 5, "0.30000"),
        ("-0.3", "0", 1, "-0.3"),
        ("0.125", "0", 2, "0.12"),  # a tie of an exact number goes to the even digit
        ("0.375", "0", 2, "0.38"),
        ("9.9999", "0", 3, "10.0"),
        ("99999", "0", 3, "1.00e+05"),
        ("123456", "0", 6, "123456"),
        ("123456", "0", 3, "1.23e+05"),
        ("0.00001234", "0", 3, "0.0000123"),
        ("0.000001234", "0", 3, "1.23e-06"),
        ("7", "0", 1, "7"),
        ("1.2345", "0.0004", 3, "1.23"),
        ("1.23456", "0.0004", 3, "1.23"),
        ("-1.2349", "0.00001", 4, "-1.235"),
    ],
)
def test_a_ball_prints_where_both_ends_round_alike(middle, radius, digits, text):
    found = decimals(ball(middle, radius), digits)
    assert (found.text, found.doubt) == (text, "")


def test_digits_are_those_of_fractions():
    """The digits of a third, of a seventh and of their powers of ten, by long division."""
    from flint import arb

    for n in (3, 7, 11, 13):
        for power in (-30, -3, 0, 4, 25):
            value = Fraction(10) ** power / n
            with ball_kind(600).working():
                found = decimals(arb(10) ** power / n, 50)
            assert abs(Fraction(found.text) - value) <= value / 10**49 / 2


# --- what is not decided -------------------------------------------------------------------------


def test_a_dead_point_is_not_claimed_and_the_rest_is_told(touching):
    found = certified(touching, 12)
    words = found["undecided"]["points.B.position"]
    assert words == (
        "singular within the ball: position of B: B cannot be found: AB and PB are in line"
    )
    assert found["points"]["B"] == {"position": None, "velocity": None, "acceleration": None}
    assert found["points"]["A"]["velocity"] == ["-0.642787609687", "0.766044443119"]
    assert found["bits"] == next(precisions(12))[0] * 2**DOUBLINGS


def test_beside_a_dead_point_the_digits_are_right_that_floats_have_lost():
    """Two bars whose ends stand 1e-13 nearer than they reach: h² = 1 - (1 - d/2)²."""
    near = mechanism_of(TOUCHING.replace("length = 3", 'length = "3 - 1e-13"'))
    found = certified(near, 20)
    assert found["undecided"] == {}
    context = decimal_kind(60).pi.context
    half = (2 - context.mpf("1e-13")) / 2
    place = context.expj(context.radians(40)) * (1 + half + 1j * context.sqrt(1 - half**2))
    texts = found["points"]["B"]["position"]
    assert [Decimal(text) for text in texts] == [digits_of(p, 20) for p in (place.real, place.imag)]
    floats = near.solve().points["B"].position
    assert abs(floats.real - float(texts[0])) > 1e-12


def test_a_moment_that_is_no_fraction_is_not_rounded():
    """The crank stands at t = pi/7 seconds where its law says 100·t degrees."""
    text = CRANK.format(time='time = "pi/7"', radius=2, angle='"100*t"')
    found = certified(mechanism_of_law(text), 40)
    context = decimal_kind(80).pi.context
    place = 2 * context.expj(context.radians(100 * context.pi / 7))
    texts = found["points"]["A"]["position"]
    assert [Decimal(text) for text in texts] == [digits_of(p, 40) for p in (place.real, place.imag)]


def test_a_centre_is_at_infinity_only_where_the_link_surely_does_not_turn():
    """A crank that takes two hundred thousand years for a turn still turns about its pivot."""
    text = CRANK.format(time="", radius=2, angle="0\nspeed = 1e-12")
    found = certified(mechanism_of(text), 20)
    assert found["links"]["1"]["instant_centre"] == ["0", "0"]
    text = CRANK.format(time="", radius=2, angle="0\nspeed = 0")
    assert certified(mechanism_of(text), 20)["links"]["1"]["instant_centre"] is None


def mechanism_of_law(text: str) -> Mechanism:
    """A mechanism whose top says at which moment it is taken."""
    from graphkin.scene.read_scene import read_text

    return Mechanism(read_text(HEAD + text, "made", None, {}))


def test_an_irrational_length_is_not_rounded():
    text = CRANK.format(time="", radius='"sqrt(2)"', angle="90\nspeed = 1")
    found = certified(mechanism_of(text), 50)
    assert found["points"]["A"]["position"] == ["0", str(Context(prec=50).sqrt(Decimal(2)))]


# --- the command ---------------------------------------------------------------------------------


def test_the_command_prints_strings_and_leaves_with_zero(run):
    result = run("solve", "pump", "--set", "n=7", "--asked", "--digits", 30, "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    found = json.loads(result.stdout)
    assert found["points"]["D"]["velocity"] == ["-3.82684508950082935178471397749", "0"]
    assert (found["digits"], found["undecided"]) == (30, {})
    assert found["bits"] >= math.ceil(30 * math.log2(10))
    assert found["witness"]["agrees"] is True
    assert isinstance(found["witness"]["largest_difference"], float)


def test_the_text_has_a_line_for_each_number(run):
    result = run("solve", "pump", "--set", "n=7", "--asked", "--digits", 30)
    assert result.exit_code == 0
    assert "velocity x, m/s       -3.82684508950082935178471397749\n" in result.stdout
    assert "every one proved, by balls of 164 bits" in result.stdout


def test_what_is_not_decided_is_told_and_leaves_with_one(run):
    result = run("solve", SCENES / "rod-and-wheel.toml", "--digits", 30)
    assert result.exit_code == 1
    assert "graphkin: not certified: points.C.velocity.y, " in result.stderr
    assert "zero within ±1e-" in result.stdout


def test_what_is_not_asked_need_not_be_decided(run):
    scene = SCENES / "mobility-parallel-cranks.toml"
    assert "links.4.epsilon" in run("solve", scene, "--digits", 30).stderr
    asked = run("solve", scene, "--digits", 30, "--asked")
    assert asked.stderr == "graphkin: not certified: links.4.omega\n"


@pytest.mark.parametrize("digits", ["0", "1001", "-3", "many", "2.5"])
def test_digits_that_cannot_be_are_refused(run, digits):
    result = run("solve", "pump", "--digits", digits)
    assert result.exit_code == 2
    assert "--digits" in result.stderr
    assert "Traceback" not in result.stderr
