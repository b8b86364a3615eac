"""A mechanism's formula as a workbook that computes: arguments, results, and a cell for each step.

A constant is a cell of its own, because a number within a formula of a cell keeps 15 digits only.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.tape.graph import Node
from graphkin.construction.tape.javascript import CALLS, SIGNS
from graphkin.text.tables import Cell
from graphkin.web.formula import Formula
from graphkin.writers.workbook import Computed, workbook

CELLS = {
    **SIGNS,
    **{op: f"{call.upper()}({{}})" for op, call in CALLS.items()},
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
