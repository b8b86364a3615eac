"""A mechanism as one function of its driver's coordinate and parameters, in another language.

The function is the traced program, one statement for each operation, and uses only the standard
library of its language.

A mechanism's formula as a workbook that computes: arguments, results, and a cell for each step.

A constant is a cell of its own, because a number within a formula of a cell keeps 15 digits only.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.core.quantities import OF_POINTS, RATES, motion_value
from graphkin.construction.core.run import made_ready, run_moving
from graphkin.construction.core.solution import Solution, gathered
from graphkin.construction.links.rolled_turn import counted_link
from graphkin.construction.tape.emitted import JS_CALLS, LOOP, SIGNS
from graphkin.construction.tape.graph import Graph, Node
from graphkin.construction.tape.traced import TracedNumber, UntraceableError, entered, traced_kind
from graphkin.mechanism import Mechanism
from graphkin.motion.driving import stated_motion
from graphkin.motion.events import once_round
from graphkin.motion.pieces import reachable_ranges
from graphkin.motion.sweep import law_of_time, sweep_of
from graphkin.scene.expression import TIME
from graphkin.scene.model import Driver, Scene
from graphkin.text.errors import Message, Problem, SceneError, message
from graphkin.text.tables import Cell
from graphkin.web.page_driver import driven_by, time_of
from graphkin.writers.workbook import Computed, workbook

TIME_INPUT = "time"
"""The letter before x and y in the name of a part of a vector."""
C_SIGNS = {
    **{op: sign for op, sign in SIGNS.items() if op != "over"},
    "over": "1.0/{}",
    **{op: f"{call}({{}})" for op, call in JS_CALLS.items() if op not in ("min", "max", "atan2")},
    "abs": "fabs({})",
    "round": "rint({})",
    "atan2": "atan2({}, {})",
    "min": "{0} <= {1} ? {0} : {1}",
    "max": "{0} <= {1} ? {1} : {0}",
}
JAVASCRIPT_SIGNS = {
    **SIGNS,
    **{op: f"Math.{call}({{}})" for op, call in JS_CALLS.items()},
    **{op: f"Math.{op}({{}}, {{}})" for op in ("min", "max", "atan2")},
}
PYTHON_SIGNS = {
    **LOOP,
    **{op: f"_{op}({{}})" for op in ("over", "sqrt", "round", "floor", "cos", "sin")},
    "sin45": "_sin({})",
    "both": "{} and {}",
    "either": "{} or {}",
}
MATLAB_SIGNS = {
    **C_SIGNS,
    **{op: f"{call}({{}})" for op, call in JS_CALLS.items() if op not in ("min", "max", "atan2")},
    "sqrt": "root({})",
    "not": "~{}",
    "choose": "pick({}, {}, {})",
    "min": "pick({0} <= {1}, {0}, {1})",
    "max": "pick({0} <= {1}, {1}, {0})",
}
Assignments = list[tuple[str, str]]


class Argument(Struct, frozen=True):
    """An argument of the function: its input of the graph, its value in the scene, its meaning."""

    name: str
    input: str
    value: float
    note: str


class Formula(Struct, frozen=True):
    """A graph as a function: its name and title, arguments, and results by name.

    ``others`` are the owners of results whose names are no identifiers, by the identifier.
    ``changes`` are the places of the first argument beyond which the motion takes other closures.
    """

    name: str
    title: str
    graph: Graph
    arguments: Sequence[Argument]
    results: Mapping[str, int]
    others: Mapping[str, str] = {}
    changes: Sequence[float] = ()

    @property
    def notes(self) -> list[str]:
        """What the arguments and results are, a line each."""
        return [
            " ".join(self.title.split()),
            *(f"{each.name}: {each.note}; {each.value!r} in the scene" for each in self.arguments),
            "x_A, y_A: position of point A in m; vx_A, vy_A: velocity in m/s;",
            "ax_A, ay_A: acceleration in m/s2; omega_2, epsilon_2: angular velocity in rad/s",
            "and angular acceleration in rad/s2 of link 2, counter-clockwise positive.",
            *(f"{made} in a result stands for {owner}." for made, owner in self.others.items()),
            "Results are NaN or infinite where the mechanism cannot be assembled or is singular.",
            *self.warnings(),
        ]

    def warnings(self) -> Iterator[str]:
        """That the motion passes change points, which a function of one position does not know."""
        if self.changes:
            places = ", ".join(f"{at:.6g}" for at in self.changes)
            yield f"The closure is that of the scene. Beyond {self.arguments[0].name} = {places}"
            yield "the mechanism moves on in another closure."

    def statements(
        self, signs: Mapping[str, str], numbers: Mapping[str, str], prefix: str = "_"
    ) -> tuple[Assignments, Assignments]:
        """The computed nodes in order, then the results, each a name and an expression.

        ``signs`` writes the operations, and ``numbers`` infinity and what is no number. The name of
        a computed node is its number behind the ``prefix``.
        """
        text: dict[int, str] = {}
        names = {each.input: each.name for each in self.arguments}
        found: Assignments = []
        for number in self.graph.needed(self.results.values()):
            node = self.graph.nodes[number]
            if node.op == "number":
                text[number] = literal(node.value, numbers)
            elif node.op == "input":
                text[number] = names[node.name]
            else:
                text[number] = f"{prefix}{number}"
                args = [text[arg] for arg in node.args]
                found.append((text[number], signs[node.op].format(*args)))
        return found, [(name, text[node]) for name, node in self.results.items()]


def literal(value: float, numbers: Mapping[str, str]) -> str:
    """A constant with all its digits, a negative one in brackets."""
    if math.isnan(value):
        return numbers["nan"]
    text = numbers["inf"] if math.isinf(value) else repr(abs(value))
    return f"(-{text})" if math.copysign(1, value) < 0 else text


# --- from a mechanism -----------------------------------------------------------------------------


def formula_of(mechanism: Mechanism) -> Formula:
    """The function of a mechanism. Raises SceneError where no straight line of formulas gives it.

    Such are groups closed by trial, links whose turns are counted along the motion, and steps
    whose course depends on a value.
    """
    scene, program = mechanism.scene, mechanism.program
    driven = driven_by(scene)
    if driven is None:
        raise refusal(message("the mechanism has no driver"))
    if mechanism.is_of_higher_class:
        raise refusal(message("a group of class III or higher is closed by trial"))
    if any(counted_link(step) is not None for step in program.steps):
        raise refusal(message("the turns of a link are counted along the motion"))
    graph = Graph()
    arguments = [*coordinates(scene), *parameters(scene)]
    inputs = {each.input: TracedNumber(graph, graph.input(each.input)) for each in arguments}
    known = {name: inputs[f"parameter {name}"] for name in scene.parameters}
    known |= {TIME: inputs[TIME_INPUT]} if TIME_INPUT in inputs else {}
    needed = program.needed(program.answers)
    try:
        overrides: dict[int, Any] = {}
        for number, (driver, drive) in enumerate(zip(scene.drivers, program.drives, strict=True)):
            if TIME_INPUT in inputs:
                place, speed, push = at_time(driver, scene, inputs[TIME_INPUT], known)
                overrides |= {drive.speed: speed, drive.acceleration: push}
            else:
                place = inputs[f"driver {number}"] * metres_of(driver, scene)
            overrides |= driven.placed(drive, driver, place)
        overrides = {number: value for number, value in overrides.items() if number in needed}
        ready = made_ready(program, needed, known, needed, frozenset(overrides))
        trace = run_moving(ready, known, traced_kind(), overrides=overrides)
    except UntraceableError as error:
        raise refusal(message("the course of a step depends on a value")) from error
    name = f"motion_of_{identifier(scene.name)}"
    solution = gathered(trace, scene.links)
    points, links = identifiers(solution.points), identifiers(solution.links)
    results = results_of(graph, solution, points, links)
    others = {made: owner for owner, made in [*points.items(), *links.items()] if made != owner}
    used = {graph.nodes[number].name for number in graph.needed(results.values())}
    arguments = [each for each in arguments if each.input in used]
    return Formula(name, scene.title, graph, arguments, results, others, change_places(scene))


def change_places(scene: Scene) -> list[float]:
    """The change points of the only driver, in its unit; none for several, or by the time."""
    if len(scene.drivers) != 1 or law_of_time(scene):
        return []
    path = reachable_ranges(sweep_of(scene))
    ends = (end for piece in path.ranges[0] for end in (piece.low, piece.high))
    places = {once_round(path, end.at) for end in ends if end.kind == "change"}
    return sorted(at / metres_of(scene.drivers[0], scene) for at in places)


def refusal(why: Message) -> SceneError:
    """The error of a mechanism that is no straight line of formulas."""
    expected = message("a mechanism that one line of formulas gives")
    return SceneError([Problem("export", why, expected)])


def coordinates(scene: Scene) -> list[Argument]:
    """The coordinate of each driver, or the time where a driver has a law of time."""
    if law_of_time(scene):
        return [Argument("t_s", TIME_INPUT, time_of(scene), "time, in s")]
    found = []
    for number, driver in enumerate(scene.drivers):
        letter, unit = ("phi", "deg") if driver.kind == "turn" else ("s", scene.units["length"])
        name = f"{letter}{number + 1 if len(scene.drivers) > 1 else ''}_{unit}"
        note = f"coordinate of the driver of link {driver.link}, in {unit}"
        start = stated_motion(driver, scene)[0] / metres_of(driver, scene)
        found.append(Argument(name, f"driver {number}", start, note))
    return found


def metres_of(driver: Driver, scene: Scene) -> float:
    """The length of one unit of a sliding driver's coordinate; 1 for degrees."""
    return 1.0 if driver.kind == "turn" else scene.unit_length


def at_time(
    driver: Driver, scene: Scene, time: TracedNumber, known: Mapping[str, Any]
) -> tuple[Any, Any, Any]:
    """Position (degrees or metres), speed and acceleration of a driver at a traced time.

    A driver without a law has its stated position at the time of the scene, as on the moving page.
    """
    law = TIME in driver.position.uses()
    kind = traced_kind()
    place, speed, push = (
        quantity.si(known, kind)
        for quantity in (driver.position, driver.speed, driver.acceleration)
    )
    if not law:
        since = time - time_of(scene)
        place, speed = place + (speed + push * since / 2) * since, speed + push * since
    return place * (180 / math.pi if driver.kind == "turn" else 1.0), speed, push


def parameters(scene: Scene) -> list[Argument]:
    """The parameters of a scene; their prefix keeps them from being keywords of any language."""
    return [
        Argument(f"p_{name}", f"parameter {name}", float(scene.values[name]), f"parameter {name}")
        for name in scene.parameters
    ]


def results_of(
    graph: Graph, solution: Solution, points: Mapping[str, str], links: Mapping[str, str]
) -> dict[str, int]:
    """The node of each part of the points' and links' motion, by a valid identifier."""
    found: dict[str, int] = {}
    for point, motion in solution.points.items():
        for quantity in OF_POINTS:
            value = motion_value(motion, quantity)
            if value is not None:
                part, letter = entered(graph, value), quantity.letter
                found[f"{letter}x_{points[point]}"] = part.node
                found[f"{letter}y_{points[point]}"] = part.below()
    for link, turning in solution.links.items():
        for quantity in RATES:
            value = motion_value(turning, quantity)
            if value is not None:
                found[f"{quantity.target}_{links[link]}"] = entered(graph, value).node
    return found


def identifiers(names: Iterable[str]) -> dict[str, str]:
    """An identifier for each name: its own if it is one, such as A_3, else as near as is free."""
    found: dict[str, str] = {}
    for name in sorted(names, key=lambda each: identifier(each) != each):
        made = identifier(name)
        while made in found.values():
            made += "_"
        found[name] = made
    return found


def identifier(name: str) -> str:
    """A name with letters, digits and underscores only."""
    return re.sub(r"\W", "_", name, flags=re.ASCII)


# --- the languages --------------------------------------------------------------------------------


PYTHON_TOP = """from math import atan2, copysign, cos, floor, inf, isfinite, nan, sin, sqrt


def _over(x):
    return 1.0 / x if x else copysign(inf, x)


def _sqrt(x):
    return sqrt(x) if x >= 0 else nan


def _round(x):
    return float(round(x)) if isfinite(x) else nan


def _floor(x):
    return float(floor(x)) if isfinite(x) else nan


def _cos(x):
    return cos(x) if isfinite(x) else nan


def _sin(x):
    return sin(x) if isfinite(x) else nan
"""


def python(formula: Formula) -> str:
    """The function as Python; it returns a dict."""
    body, results = formula.statements(PYTHON_SIGNS, {"inf": "inf", "nan": "nan"})
    given = ", ".join(f"{each.name}={each.value!r}" for each in formula.arguments)
    lines = [*(f"# {line}" for line in formula.notes), PYTHON_TOP, ""]
    lines += [f"def {formula.name}({given}):"]
    lines += [f"    {name} = {text}" for name, text in body]
    lines += ["    return {", *(f'        "{name}": {text},' for name, text in results), "    }"]
    return "\n".join(lines) + "\n"


def javascript(formula: Formula) -> str:
    """The function as JavaScript; it returns an object."""
    body, results = formula.statements(JAVASCRIPT_SIGNS, {"inf": "Infinity", "nan": "NaN"})
    given = ", ".join(f"{each.name} = {each.value!r}" for each in formula.arguments)
    lines = [*(f"// {line}" for line in formula.notes), f"function {formula.name}({given}) {{"]
    lines += [f"  const {name} = {text};" for name, text in body]
    lines += ["  return {", *(f"    {name}: {text}," for name, text in results), "  };", "}"]
    lines += [f'if (typeof module !== "undefined") module.exports = {{ {formula.name} }};']
    return "\n".join(lines) + "\n"


def c(formula: Formula) -> str:
    """The function as C99; it returns a struct."""
    body, results = formula.statements(C_SIGNS, {"inf": "INFINITY", "nan": "NAN"})
    given = ", ".join(f"double {each.name}" for each in formula.arguments)
    record = f"struct {formula.name}_result"
    lines = [*(f"// {line}" for line in formula.notes), "#include <math.h>", "", f"{record} {{"]
    lines += [f"    double {name};" for name, _ in results]
    lines += ["};", "", f"{record} {formula.name}({given})", "{", f"    {record} result;"]
    lines += [f"    const double {name} = {text};" for name, text in body]
    lines += [f"    result.{name} = {text};" for name, text in results]
    return "\n".join([*lines, "    return result;", "}"]) + "\n"


MATLAB_END = """
function y = root(x)
if x >= 0
    y = sqrt(x);
else
    y = NaN;
end
end

function y = pick(condition, yes, no)
if condition
    y = yes;
else
    y = no;
end
end
"""


def matlab(formula: Formula) -> str:
    """The function as MATLAB, for a file of its own name; it returns a struct."""
    body, results = formula.statements(MATLAB_SIGNS, {"inf": "Inf", "nan": "NaN"}, "t")
    given = ", ".join(each.name for each in formula.arguments)
    lines = [f"function result = {formula.name}({given})"]
    lines += [f"% {line}" for line in formula.notes]
    for number, each in enumerate(formula.arguments, 1):
        lines += [f"if nargin < {number}", f"    {each.name} = {each.value!r};", "end"]
    lines += [f"{name} = {text};" for name, text in body]
    lines += [f"result.{name} = {text};" for name, text in results]
    return "\n".join([*lines, "end", MATLAB_END])


LANGUAGES = {"python": python, "javascript": javascript, "c": c, "matlab": matlab}
"""The languages of a formula; tests hold the numbers of each to ``solve``."""


CELLS = {
    **SIGNS,
    **{op: f"{call.upper()}({{}})" for op, call in JS_CALLS.items()},
    "round": "ROUND({},0)",
    "floor": "INT({})",
    "atan2": "IF(AND({0}=0,{1}=0),0,ATAN2({1},{0}))",
    "min": "IF({0}<={1},{0},{1})",
    "max": "IF({0}<={1},{1},{0})",
    "equal": "{}={}",
    "both": "AND({},{})",
    "either": "OR({},{})",
    "not": "NOT({})",
    "choose": "IF({},{},{})",
}
MOTION, STEPS = "Motion", "Steps"
"""The sheet that people read, and the sheet of the single operations."""
TOP = 3
"""The row of the first argument."""


def formula_workbook(formula: Formula) -> bytes:
    """An XLSX workbook in which a change of an argument computes all results again.

    A result is an error value where the mechanism cannot be assembled. Raises PageError without
    openpyxl.
    """
    inputs = {each.input: f"{MOTION}!$B${TOP + i}" for i, each in enumerate(formula.arguments)}
    order = formula.graph.needed(formula.results.values())
    places = {number: f"{STEPS}!$B${row}" for row, number in enumerate(order, 2)}
    nodes = [formula.graph.nodes[number] for number in order]
    places |= {
        number: inputs[node.name]
        for number, node in zip(order, nodes, strict=True)
        if node.op == "input"
    }
    steps: list[Sequence[Cell]] = [["operation", "value"]]
    steps += [
        [node.op, value_of(node, [places[arg] for arg in node.args], inputs)] for node in nodes
    ]
    return workbook({MOTION: list(motion_rows(formula, places)), STEPS: steps})


def motion_rows(formula: Formula, places: dict[int, str]) -> Iterator[Sequence[Cell]]:
    yield [" ".join(formula.title.split()), "", ""]
    yield ["argument", "value", "meaning"]
    for each in formula.arguments:
        yield [each.name, each.value, each.note]
    yield []
    yield ["result", "value", "SI units"]
    for name, node in formula.results.items():
        yield [name, Computed(f"={places[node]}"), ""]
    yield []
    for line in formula.notes[1 + len(formula.arguments) :]:
        yield [line]


def value_of(node: Node, args: Sequence[str], inputs: dict[str, str]) -> Cell:
    """A constant, or the formula of an operation; an infinite constant divides by zero."""
    if node.op == "number":
        return node.value if abs(node.value) < float("inf") else Computed("=1/0")
    return Computed(
        "=" + (inputs[node.name] if node.op == "input" else CELLS[node.op].format(*args))
    )
