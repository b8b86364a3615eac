"""Emitted source gives the values of the batch run, NaN where nothing can be drawn, and says no
where it cannot follow."""

from __future__ import annotations

import importlib.util
import math
from pathlib import Path

import numpy as np
import pytest

from graphkin.construction.core.program import Part, Plane, Program, Step
from graphkin.construction.core.run import run_batch, run_blocks
from graphkin.construction.core.solution import smallest_margin
from graphkin.construction.core.vocabulary import action
from graphkin.construction.tape.emitted import (
    BLOCK,
    EMITTED_FROM,
    BatchRunner,
    loop_names,
    loop_source,
    numpy_source,
    sin45,
)
from graphkin.construction.tape.graph import OPERATIONS, Graph
from graphkin.construction.tape.traced import TracedNumber, UntraceableError
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.arithmetic import batch_kind, pick
from graphkin.numbers.plane import Ratio
from tests.chosen import EVERY, HALVES

SCENES = Path(__file__).resolve().parents[3] / "examples" / "scenes"
HAS_NUMBA = importlib.util.find_spec("numba") is not None
WAYS = [
    "numpy",
    pytest.param("numba", marks=pytest.mark.skipif(not HAS_NUMBA, reason="numba is an extra")),
]
TOLERANCE = 1e-13
SIZE = BLOCK + 17
"""More than a strip and a block, and a whole number of neither."""
POSITIONS = 500


def swept(tmp_path: Path, name: str, driver: str, span: tuple[float, float]) -> Mechanism:
    """A scene that we ship, its crank's angle made a parameter."""
    text = (SCENES / f"{name}.toml").read_text(encoding="utf-8")
    assert driver in text
    text = text.replace(driver, 'angle = "phi"')
    parameter = f"phi = {{ value = 40, min = {span[0]}, max = {span[1]} }}\n"
    head, mark, rest = text.partition("[parameters]\n")
    text = head + mark + parameter + rest if mark else f"{text}\n[parameters]\n{parameter}"
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return load(path)


def case(tmp_path: Path, name: str) -> tuple[Mechanism, dict[str, np.ndarray]]:
    """A mechanism and a sweep of a parameter of it."""
    if name in ("pump", "pump-collinear"):
        return load(name), {"n": np.linspace(1, 30, SIZE)}
    driver = {
        "six-bar": "angle = 50",
        "engine": "angle = -45",
        "crank-rocker": 'angle = "15*n"',
        "offset-slider-crank": 'angle = "30 + 2*n"',
    }[name]
    return swept(tmp_path, name, driver, (-400, 400)), {"phi": np.linspace(-400, 400, SIZE)}


def both(
    mechanism: Mechanism, arrays: dict[str, np.ndarray], *, way: str, margins: bool = False
) -> tuple[list[tuple[int, np.ndarray]], list[tuple[int, np.ndarray]]]:
    """All values, and margins, of the emitted run and of the plain one, as real columns."""
    program, values = mechanism.program, {**mechanism.scene.values, **arrays}
    targets = mechanism.asked() if way == "numba" else program.answers
    needed, keep = program.needed(targets), [program.targets[target] for target in targets]
    press = BatchRunner(program)
    with np.errstate(all="ignore"):
        ours = press.run(needed, values, keep, margins=margins, way=way)
        plain = run_blocks(program, needed, values, batch_kind(), keep, margins=margins)
    assert list(press.kept.values()) != [None], "the program was not traced at all"
    assert ours.values.keys() == plain.values.keys()
    assert ours.margins.keys() == plain.margins.keys()
    return flat(ours), flat(plain)


def flat(trace) -> list[tuple[int, np.ndarray]]:
    """The parts of all values of a trace, each with its step."""
    found = []
    for values in (trace.values, trace.margins):
        for number, value in values.items():
            parts = value if isinstance(value, Ratio) else (value,)
            found += [(number, part) for part in parts]
    return found


def nowhere(columns: list[tuple[int, np.ndarray]]) -> dict[int, np.ndarray]:
    """Where a value has a part that is NaN: the centre of a link that turns about a fixed pin that
    is nowhere itself is zero times something over NaN, and so is nowhere."""
    found: dict[int, np.ndarray] = {}
    for number, values in columns:
        found[number] = found.get(number, False) | np.isnan(values)
    return found


def assert_same(ours, plain, steps) -> None:
    """Equal to a few units in the last place of the largest of its kind, NaN at the same places."""
    for (number, mine), (_, theirs) in zip(ours, plain, strict=True):
        step = steps[number]
        np.testing.assert_array_equal(np.isnan(mine), np.isnan(theirs), err_msg=str(step))
        largest = np.nanmax(np.abs(theirs), initial=0)
        away = np.nanmax(np.abs(np.subtract(mine, theirs)), initial=0)
        assert away <= TOLERANCE * largest, step


@pytest.mark.parametrize(
    ("name", "way"),
    [
        *((name, "numpy") for name in ("pump", "six-bar", "engine")),
        pytest.param("pump", "numba", marks=WAYS[1].marks),
    ],
)
def test_emitted_source_gives_the_values_of_the_batch_run(tmp_path, name, way):
    mechanism, arrays = case(tmp_path, name)
    assert_same(*both(mechanism, arrays, way=way), mechanism.program.steps)


CLEAR = 0.1
"""Sine of the flattest crossing where the last bits still say nothing."""


def driven(mechanism: Mechanism) -> dict[int, np.ndarray]:
    """Arrays for the given positions of all drivers, from where the scene has them."""
    trace, way = mechanism.trace(), np.linspace(0, 1, POSITIONS)
    found: dict[int, np.ndarray] = {}
    for drive in mechanism.program.drives:
        here = trace.values.get(drive.position)
        if isinstance(here, complex):
            found[drive.position] = here * np.exp(1j * way)
        elif here is not None:
            found[drive.position] = here * (1 + 0.1 * way)
        if drive.angle in trace.values:
            found[drive.angle] = trace.values[drive.angle] + way
    return found


def peak(values: object, where: np.ndarray) -> float:
    """The largest magnitude among some of the values."""
    return float(np.max(np.broadcast_to(np.abs(values), where.shape), where=where, initial=0))


@pytest.mark.parametrize("name", HALVES[1][:: 1 if EVERY else 2])
def test_a_scene_that_can_be_followed_runs_the_same_by_source(name):
    """Driven by arrays of positions, as a cycle is; a group that is closed by iteration cannot."""
    mechanism = load(SCENES / f"{name}.toml")
    program, arrays = mechanism.program, driven(mechanism)
    targets = program.answers
    needed, keep = program.needed(targets), [program.targets[target] for target in targets]
    arrays = {number: array for number, array in arrays.items() if number in needed}
    values, press = mechanism.scene.values, BatchRunner(program)
    with np.errstate(all="ignore"):
        ours = press.run(needed, values, keep, margins=True, overrides=arrays, way="numpy")
        plain = run_batch(
            program, needed, values, batch_kind(), keep, margins=True, overrides=arrays
        )
    closes = any(step.action and step.action.key == "part" for step in program.steps)
    assert closes or None not in press.kept.values(), "not followed"
    clear = np.broadcast_to(smallest_margin(plain) > CLEAR, POSITIONS)
    turning = max((peak(plain.value(*t), clear) for t in targets if t[0] == "omega"), default=0)
    moving = max(
        (peak(plain.value(*t), clear) for t in targets if t[0] == "acceleration"), default=0
    )
    least = {"omega": turning, "epsilon": turning**2, "slide acceleration": moving}
    targets = [target for target in targets if not isinstance(plain.value(*target), tuple)]
    for what in {what for what, _ in targets}:
        pairs = [(t, ours.value(*t), plain.value(*t)) for t in targets if t[0] == what]
        largest = max(least.get(what, 0), *(peak(theirs, clear) for _, _, theirs in pairs))
        for target, mine, theirs in pairs:
            assert peak(mine - theirs, clear) <= 1e-12 * largest, target


@pytest.mark.parametrize("way", WAYS)
def test_what_cannot_be_drawn_is_nan_in_both(tmp_path, way):
    """A coupler too short to reach round: the linkage closes only on a part of the turn."""
    mechanism, arrays = case(tmp_path, "crank-rocker")
    arrays |= {"L": np.linspace(20, 100, SIZE)}
    ours, plain = both(mechanism, arrays, way=way)
    lost = [np.isnan(values).mean() for _, values in plain if np.ndim(values)]
    assert 0.05 < max(lost) < 0.95
    masks, others = nowhere(ours), nowhere(plain)
    for number, mask in masks.items():
        same = mask == others[number]
        assert np.all(same), mechanism.program.steps[number]


@pytest.mark.parametrize("way", WAYS if EVERY else WAYS[:1])
def test_a_value_given_as_an_array_takes_the_place_of_a_step(way):
    mechanism = load("pump")
    program = mechanism.program
    turn = next(n for n, s in enumerate(program.steps) if s.given and s.given.form == "direction")
    targets = [("position", "D"), ("velocity", "D"), ("acceleration", "D")]
    needed, keep = program.needed(targets), [program.targets[target] for target in targets]
    ways = {turn: np.exp(1j * np.linspace(0.5, 1.5, SIZE))}
    values = mechanism.scene.values
    ours = BatchRunner(program).run(needed, values, keep, overrides=ways, way=way)
    plain = run_batch(program, needed, values, batch_kind(), keep, overrides=ways)
    assert_same(flat(ours), flat(plain), program.steps)


def test_the_sine_of_the_loop_is_good_to_the_last_digit():
    for degrees in np.linspace(-45, 45, 1001):
        angle = math.radians(degrees)
        assert abs(sin45(angle) - math.sin(angle)) <= 2 * math.ulp(math.sin(angle))


def run_loop(expression, *columns: np.ndarray) -> np.ndarray:
    """A function of traced numbers as an emitted loop, run uncompiled."""
    graph = Graph()
    inputs = [f"p{place}" for place in range(len(columns))]
    found = expression(*(TracedNumber(graph, graph.input(name)) for name in inputs))
    source = loop_source(graph, [(found.node,)], inputs)

    class Still:
        """What a compiler would be."""

        @staticmethod
        def njit(**_):
            return lambda function: function

    names = loop_names(Still)
    exec(source, names)
    result = np.empty(columns[0].size)
    names["loop"](columns[0].size, *columns, result)
    return result


def test_a_loop_calls_the_library_before_the_rest():
    """cos of a sum, and then more of it: two loops through the same scratch."""
    a, b = np.linspace(0, 20, 150), np.linspace(3, 9, 150)
    found = run_loop(lambda p, q: q * np.cos(p + q) + np.arctan2(p, q) * p, a, b)
    np.testing.assert_allclose(found, b * np.cos(a + b) + np.arctan2(a, b) * a, rtol=1e-14)


def test_plain_numbers_of_numpy_go_into_a_loop_on_either_side():
    """A number of numpy's asks its own function what it makes with a traced one."""
    a, two = np.linspace(1, 3, 100), np.float64(2)
    found = run_loop(lambda p: two * p - (two - p) / (two + p) + np.subtract(p, two), a)
    np.testing.assert_allclose(found, 2 * a - (2 - a) / (2 + a) + a - 2, rtol=1e-15, atol=1e-15)


def test_a_choice_is_made_for_each_variant():
    a, b = np.linspace(-1, 1, 100), np.linspace(1, -1, 100)
    found = run_loop(lambda p, q: pick((p < q) | (p > 0.9), p, 2 * q), a, b)
    np.testing.assert_array_equal(found, np.where((a < b) | (a > 0.9), a, 2 * b))


def rule(expression) -> str:
    """How the graph puts an expression of x and y down, as one line."""
    graph = Graph()
    x, y = (TracedNumber(graph, graph.input(name)) for name in "xy")
    found = expression(x, y)

    def read(number: int) -> str:
        node = graph.nodes[number]
        if node.op in ("input", "number"):
            return node.name or f"{node.value:g}"
        parts = [read(arg) for arg in node.args]
        return f"{node.op}({', '.join(sorted(parts) if OPERATIONS[node.op].commutes else parts)})"

    return read(found.node)


@pytest.mark.parametrize(
    ("expression", "plainest"),
    [
        (lambda x, y: x + 0, "x"),
        (lambda x, y: x * 1, "x"),
        (lambda x, y: x * 0 + y, "y"),
        (lambda x, y: 0 - (-x), "x"),
        (lambda x, y: x + (-y), "sub(x, y)"),
        (lambda x, y: (-x) * (-y), "mul(x, y)"),
        (lambda x, y: 2 * (3 * x), "mul(6, x)"),
        (lambda x, y: (1j * x).imag, "x"),
        (lambda x, y: abs((x + 1j * y) * 1j), "sqrt(add(mul(x, x), mul(y, y)))"),
        (lambda x, y: abs(x + 1j * y) ** 2, "add(mul(x, x), mul(y, y))"),
        (lambda x, y: pick(abs(x) <= y, abs(x), y), "min(abs(x), y)"),
        (lambda x, y: pick(x < y, x, x), "x"),
        (lambda x, y: np.cos(x) * 0 + np.sqrt(4 * (y * 0 + 1)), "2"),
    ],
)
def test_what_is_reckoned_is_put_down_in_its_simplest_form(expression, plainest):
    assert rule(expression) == plainest


def test_what_is_no_longer_needed_makes_room_for_what_comes():
    """However long a chain, two values of it at a time are kept."""
    graph = Graph()
    value = x = TracedNumber(graph, graph.input("x"))
    for _ in range(40):
        value = np.cos(value) * x
    _, scratch = numpy_source(graph, [value.node])
    assert scratch <= 2


def test_a_root_that_need_not_exist_keeps_its_nan():
    """sqrt(x)·sqrt(x) is not x where x is negative; of a square it is."""
    assert rule(lambda x, y: np.sqrt(x) * np.sqrt(x)) == "mul(sqrt(x), sqrt(x))"


@pytest.mark.parametrize(
    "looks",
    [
        lambda x: 1 if x > 0 else 2,
        float,
        lambda x: [1, 2][x],
        lambda x: x[0],
        lambda x: x.max(),
        np.asarray,
        np.linalg.norm,
        np.exp,
        lambda x: x**0.3,
        lambda x: x + "1",
    ],
)
def test_a_step_that_looks_at_a_value_is_refused(looks):
    graph = Graph()
    with pytest.raises(UntraceableError):
        looks(TracedNumber(graph, graph.input("x")))


def test_a_program_that_cannot_be_followed_runs_as_before():
    """A step with a loop over the variants: no source, the same values."""

    @action("stubborn")
    def stubborn(x):
        return np.array([2 * each for each in x])

    given = load("pump", n=7).program.steps
    first = next(n for n, s in enumerate(given) if s.given and "n" in s.given.uses())
    steps = (given[first], Step(stubborn, (0,), Part.SHAPE, Plane.NUMBERS))
    press = BatchRunner(Program(steps, {("twice", "n"): 1}))
    found = press.run((0, 1), {"n": np.linspace(1, 30, SIZE)}, (0, 1), way="numpy")
    assert list(press.kept.values()) == [None]
    np.testing.assert_array_equal(found.values[1], 2 * found.values[0])


def test_source_made_for_one_constant_is_not_used_for_another(tmp_path):
    mechanism, arrays = case(tmp_path, "crank-rocker")
    program, target = mechanism.program, ("position", "B")
    needed, keep = program.needed([target]), [program.targets[target]]
    press = BatchRunner(program)
    for length in (85.0, 105.0, 85.0):
        values = {**mechanism.scene.values, **arrays, "L": length}
        ours = press.run(needed, values, keep, way="numpy").value(*target)
        plain = press.run(needed, values, keep, way="steps").value(*target)
        np.testing.assert_allclose(ours, plain, rtol=1e-13)
    assert len(press.kept) == 2


def test_source_is_written_when_it_pays():
    """Small batches go step by step; for the same, source is written once."""
    mechanism = load("pump")
    mechanism.batch(n=np.linspace(1, 30, EMITTED_FROM - 1))
    assert not mechanism.press.kept
    for size in (EMITTED_FROM, EMITTED_FROM + 1):
        mechanism.batch(n=np.linspace(1, 30, size))
        assert len(mechanism.press.kept) == 1
