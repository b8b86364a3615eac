"""A run that writes down what it reckons, on traced numbers in the place of arrays."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from graphkin.construction.core.batch import is_array, made_ready, run_moving
from graphkin.construction.core.program import Program
from graphkin.construction.core.run import Trace, Values
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.traced import Traced, TracedNumber
from graphkin.numbers.arithmetic import Kind, nearest_quarter, quarter_turns
from graphkin.numbers.arrays import np


class TracedKind(Kind, frozen=True):
    """The number kind of a tracer: as a batch, but an angle in degrees is known to be reduced."""

    def direction(self, degrees: Any) -> Any:
        """Unit vector at an angle in degrees.

        Of an angle within 45 degrees the cosine follows from the sine without loss.
        """
        if not isinstance(degrees, TracedNumber):
            return Kind.direction(self, degrees)
        quarter = nearest_quarter(degrees)
        rest = (degrees - 90 * quarter) * (math.pi / 180)
        sine = rest.do("sin45")
        cosine = (1 - sine * sine).do("sqrt")
        found = rest.of(cosine, sine) * quarter_turns(quarter)
        found.graph.units.add((found.node, found.down))
        return found


def traced_kind() -> TracedKind:
    """Numbers that write down what is done to them."""

    def number(exact: Any) -> Any:
        return exact if isinstance(exact, Traced) else float(Fraction(exact))

    return TracedKind("traced", number, math.pi, np.cos, np.sin, np.sqrt)


def traced(
    program: Program,
    needed: Sequence[int],
    values: Values,
    keep: Sequence[int],
    overrides: Mapping[int, Any],
    *,
    margins: bool,
) -> tuple[Graph, Trace]:
    """One run on traced numbers in the place of arrays: a trace of nodes of the graph.

    Raises UntraceableError for a step whose way depends on a value.
    """
    graph = Graph()
    ready = made_ready(program, needed, values, keep, frozenset(overrides))
    entered = {
        name: TracedNumber(graph, graph.input(name)) for name, v in values.items() if is_array(v)
    }
    given = {number: stand_in(graph, number, value) for number, value in overrides.items()}
    values = {**values, **entered}
    return graph, run_moving(ready, values, traced_kind(), margins=margins, overrides=given)


def stand_in(graph: Graph, number: int, value: Any) -> Any:
    """The traced number that stands for a step's own value; a plain one stands for itself."""
    if not is_array(value):
        return value
    x, y = parts_named(number)
    return TracedNumber(graph, graph.input(x), graph.input(y) if value.dtype.kind == "c" else None)


def parts_named(number: int) -> tuple[str, str]:
    """Names of the inputs that stand for the value of a step; no parameter is called so."""
    return f"step {number}", f"step {number}, up"
