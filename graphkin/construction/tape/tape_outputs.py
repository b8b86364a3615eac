"""The numbers that a moving page computes at each position of the driver: a graph's outputs.

The same graph gives their values at the scene's own position, so that they can be compared with
what is drawn there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from graphkin.construction.tape.graph import OPERATIONS, Graph, Node
from graphkin.construction.tape.traced import TracedNumber, Truth, entered
from graphkin.numbers.arithmetic import np

NOWHERE = -1
"""The index of an output that does not exist."""


class TapeOutputs:
    """The outputs of a graph: numbers and points by their first index, without duplicates."""

    def __init__(self, graph: Graph, inputs: Mapping[str, float]) -> None:
        self.graph, self.inputs = graph, dict(inputs)
        self.outputs: list[int] = []
        self.places: dict[tuple[int, ...], int] = {}
        self.values: list[Any] = []
        self.pages: dict[Any, TracedNumber] = {}
        """Places on the page by field and point, each computed once."""

    def lifted(self, value: Any) -> TracedNumber:
        """A number or point of the graph, made from a plain one if needed."""
        return entered(self.graph, value)

    def number(self, value: Any) -> int:
        """The index of a number among the outputs."""
        return self.put(self.lifted(value).node)

    def point(self, value: Any) -> int:
        """The index of a point's x among the outputs; its y comes next."""
        point = self.lifted(value)
        return self.put(point.node, point.imag.node)

    def put(self, *nodes: int) -> int:
        """The index of some consecutive nodes."""
        if nodes not in self.places:
            self.places[nodes] = len(self.outputs)
            self.outputs.extend(nodes)
        return self.places[nodes]

    def now(self, value: Any) -> Any:
        """A number, point or condition at the scene's position; a plain value unchanged."""
        if isinstance(value, Truth):
            return self.value(value.node)
        if not isinstance(value, TracedNumber):
            return value
        if value.down is None:
            return self.value(value.node)
        return complex(self.value(value.node), self.value(value.down))

    @contextmanager
    def choosing(self) -> Iterator[None]:
        """A context in which marks are chosen as at the scene's own position."""
        before, self.graph.now = self.graph.now, self.value
        try:
            yield
        finally:
            self.graph.now = before

    def value(self, number: int) -> Any:
        """The value of a node at the scene's own position."""
        if number >= len(self.values):
            for node in self.graph.nodes[len(self.values) : number + 1]:
                self.values.append(value_of(node, self.values, self.inputs))
        return self.values[number]


def value_of(node: Node, values: Sequence[Any], inputs: Mapping[str, float]) -> Any:
    """The value of a node from the values before it; NaN where it is undefined."""
    if node.op == "number":
        return node.value
    if node.op == "input":
        return inputs[node.name]
    args = [values[arg] for arg in node.args]
    try:
        return OPERATIONS[node.op].value(*args)
    except (ValueError, OverflowError):
        return math.nan


def runner(graph: Graph, outputs: Sequence[int]) -> Callable[[Mapping[str, Any]], list[Any]]:
    """Some outputs as a function of arrays of inputs, all of the same length."""
    known = {op: each.array for op, each in OPERATIONS.items()} | {"over": "reciprocal"}
    order = [(number, graph.nodes[number]) for number in graph.needed(outputs)]
    calls = [
        (number, node, getattr(np, known[node.op]) if node.op in known else None)
        for number, node in order
    ]

    def found(inputs: Mapping[str, Any]) -> list[Any]:
        values: dict[int, Any] = {}
        with np.errstate(all="ignore"):
            for number, node, call in calls:
                if call is not None:
                    values[number] = call(*[values[arg] for arg in node.args])
                else:
                    values[number] = inputs[node.name] if node.name else np.float64(node.value)
        return [values[number] for number in outputs]

    return found
