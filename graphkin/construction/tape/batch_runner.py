"""Batches of variants run the fastest way: step by step, by emitted numpy, or by a numba loop.

Tracing a program and writing its source takes some milliseconds, once for each request; compiling
takes a second or more. So small batches run step by step. The choice depends only on the size of
the batch, not on earlier runs; the results differ by rounding alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from typing import Any, Literal

from msgspec import Struct, field

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import Trace, Values, is_array, run_batch, run_blocks
from graphkin.construction.core.solution import with_least_margin
from graphkin.construction.tape.emitted import Emitted
from graphkin.construction.tape.traced import UntraceableError, parts_named, traced
from graphkin.numbers.arithmetic import batch_kind, np

EMITTED_FROM = 2_000
"""Number of variants from which source is written: a few such batches repay the cost."""
COMPILED_FROM = 100_000
"""Number of variants from which source is compiled by numba: it takes seconds per process."""

LEAST: Literal["least"] = "least"
Margins = bool | Literal["least"]
Overrides = Mapping[int, Any]
"""Values, or arrays of values, that replace those of steps."""
Way = Literal["steps", "numpy", "numba"]
"""Step by step on arrays, by emitted numpy, or by the compiled loop."""


class BatchRequest(Struct, frozen=True):
    """A request to a program: the steps to run, the input values, and the results to keep."""

    needed: Sequence[int]
    values: Values
    keep: Sequence[int]
    margins: Margins
    overrides: Overrides

    def key(self) -> tuple[Any, ...]:
        """The part of the request on which its source depends: all but the arrays' numbers."""
        marks = marked(self.values), marked(self.overrides)
        return (tuple(self.needed), tuple(self.keep), self.margins, *marks)

    def size(self) -> int:
        """The number of variants."""
        every = (*self.values.values(), *self.overrides.values())
        return max((len(value) for value in every if is_array(value)), default=1)

    def inputs(self) -> dict[str, Any]:
        """Plain arrays of floats for all inputs by name, two for a point."""
        found = {name: value for name, value in self.values.items() if is_array(value)}
        for number, array in self.overrides.items():
            if is_array(array):
                x, y = parts_named(number)
                found |= {x: array.real, y: array.imag} if array.dtype.kind == "c" else {x: array}
        return {name: np.ascontiguousarray(array, dtype=float) for name, array in found.items()}


class BatchRunner(Struct):
    """Runs a program on many variants; ``kept`` holds None for a request that cannot be traced."""

    program: Program
    kept: dict[tuple[Any, ...], Emitted | None] = field(default_factory=dict)

    def run(
        self,
        needed: Sequence[int],
        values: Values,
        keep: Sequence[int],
        *,
        margins: Margins = False,
        overrides: Overrides | None = None,
        way: Way | None = None,
    ) -> Trace:
        """As ``run_blocks``: NaN where the mechanism cannot be drawn; call under numpy's errstate.

        ``overrides`` replaces the values of steps by arrays. ``way`` selects the method; None
        selects it by the number of variants. A request that cannot be traced runs step by step.
        ``margins`` asks for all margins, or for the least of each variant.
        """
        order = BatchRequest(needed, values, keep, margins, overrides or {})
        chosen = way or best_way(order.size())
        emitted = None if chosen == "steps" else self.emitted(order)
        if emitted is None:
            return self.by_steps(order)
        return emitted.run(order.inputs(), order.size(), compiled=chosen == "numba")

    def by_steps(self, order: BatchRequest) -> Trace:
        """Run the steps one after another on arrays."""
        args = self.program, order.needed, order.values, batch_kind(), order.keep
        asked = bool(order.margins)
        if order.overrides:
            trace = run_batch(*args, margins=asked, overrides=order.overrides)
        else:
            trace = run_blocks(*args, margins=asked)
        return with_least_margin(trace) if order.margins == LEAST else trace

    def emitted(self, order: BatchRequest) -> Emitted | None:
        """The program emitted for a request, cached; None where it cannot be traced."""
        key = order.key()
        if key not in self.kept:
            self.kept[key] = emitted_for(self.program, order)
        return self.kept[key]


def best_way(variants: int) -> Way:
    """The fastest way for a number of variants."""
    if variants >= COMPILED_FROM and find_spec("numba") is not None:
        return "numba"
    return "numpy" if variants >= EMITTED_FROM else "steps"


def marked(values: Mapping[Any, Any]) -> tuple[Any, ...]:
    """Each name with its constant, or with the kind of its array."""
    return tuple((name, v.dtype.kind if is_array(v) else (v,)) for name, v in values.items())


def emitted_for(program: Program, order: BatchRequest) -> Emitted | None:
    """The program traced for a request, ready to be emitted; None where it cannot be traced."""
    asked = order.needed, order.values, order.keep, order.overrides
    try:
        graph, trace = traced(program, *asked, margins=bool(order.margins))
        if order.margins == LEAST:
            trace = with_least_margin(trace)
    except UntraceableError:
        return None
    return Emitted(program, graph, trace.values, trace.margins)
