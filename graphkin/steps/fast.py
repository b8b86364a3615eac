"""Many variants by emitted source: a program traced once, then run as numpy or as a numba loop."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib.util import find_spec
from typing import Any

from graphkin.arithmetic import batch_kind
from graphkin.plane import Circle, Line, Ratio, Vector
from graphkin.steps.batch import is_array, made_ready, run_batch, run_blocks, run_moving
from graphkin.steps.emit import Column, loop_source, numpy_source
from graphkin.steps.graph import Graph
from graphkin.steps.program import Program
from graphkin.steps.run import Trace, Values
from graphkin.steps.tracer import Number, UntraceableError, traced_kind

BLOCK = 8192
"""Variants run at once by numpy: few enough for the cache, enough to pay for each call."""
EMITTED_FROM = 2_000
"""Variants from which source is written: tracing costs about as much as they do."""
COMPILED_FROM = 100_000
"""Variants from which the compiled loop is used, where numba is installed."""
RECORDS = (Ratio, Line, Circle, Vector)

Overrides = Mapping[int, Any]
"""Values, or arrays of them, in place of those of steps."""


@dataclass(frozen=True)
class Emitted:
    """A traced program: its graph, and the kept values and margins in its numbers."""

    program: Program
    graph: Graph
    values: Mapping[int, Any]
    margins: Mapping[int, Any]

    @cached_property
    def inputs(self) -> tuple[str, ...]:
        """The names of the inputs, in order."""
        return tuple(node.name for node in self.graph.nodes if node.op == "input")

    @cached_property
    def leaves(self) -> tuple[Number, ...]:
        """The traced numbers of all kept values, in order."""
        found: list[Number] = []
        for value in (*self.values.values(), *self.margins.values()):
            found += leaves_of(value)
        return tuple(found)

    @cached_property
    def outputs(self) -> tuple[int, ...]:
        """The nodes of all leaves: one of a number, two of a point."""
        return tuple(node for column in self.columns for node in column)

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """The same, leaf by leaf."""
        return tuple(
            (leaf.node,) if leaf.down is None else (leaf.node, leaf.down) for leaf in self.leaves
        )

    @cached_property
    def by_numpy(self) -> tuple[Callable[..., None], int]:
        """The source for arrays as a function, and how many scratch arrays it wants."""
        import numpy as np

        source, rooms = numpy_source(self.graph, self.outputs)
        names: dict[str, Any] = {**vars(np), "inf": math.inf, "nan": math.nan}
        exec(compile(source, "<emitted for numpy>", "exec"), names)
        return names["block"], rooms

    @cached_property
    def by_numba(self) -> Callable[..., None]:
        """The source for single numbers as a loop that numba compiles at its first call."""
        import numba

        source = loop_source(self.graph, self.columns, self.inputs)
        names = loop_names(numba)
        exec(compile(source, "<emitted for numba>", "exec"), names)
        compiled: Callable[..., None] = numba.njit(error_model="numpy", fastmath={"contract"})(
            names["loop"]
        )
        return compiled

    def run(self, arrays: Mapping[str, Any], size: int, *, compiled: bool) -> Trace:
        """All kept values for all variants."""
        rooms = rooms_for(self.columns, size)
        if compiled:
            self.by_numba(size, *(arrays[name] for name in self.inputs), *rooms)
        else:
            self.in_blocks(arrays, rooms, size)
        filled = iter(rooms)
        values = {number: refilled(value, filled) for number, value in self.values.items()}
        margins = {number: refilled(value, filled) for number, value in self.margins.items()}
        return Trace(self.program, values, margins)

    def in_blocks(self, arrays: Mapping[str, Any], filled: Sequence[Any], size: int) -> None:
        """Fill arrays by numpy, a block at a time."""
        import numpy as np

        flat = [(y.real, y.imag) if y.dtype.kind == "c" else (y,) for y in filled]
        columns = [part for parts in flat for part in parts]
        block, rooms = self.by_numpy
        scratch = np.empty((rooms, min(size, BLOCK)))
        for start in range(0, size, BLOCK):
            part = slice(start, min(start + BLOCK, size))
            here = {name: array[part] for name, array in arrays.items()}
            block(here, [y[part] for y in columns], scratch[:, : part.stop - start])


def rooms_for(columns: Sequence[Column], size: int) -> list[Any]:
    """An array for each column, all those of a kind in one piece of memory: quickest to be had."""
    import numpy as np

    points = sum(len(column) == 2 for column in columns)
    of_points = iter(np.empty((points, size), complex))
    of_numbers = iter(np.empty((len(columns) - points, size)))
    return [next(of_points if len(column) == 2 else of_numbers) for column in columns]


def leaves_of(value: Any) -> list[Number]:
    """The traced numbers in a value."""
    if isinstance(value, RECORDS):
        return [leaf for part in value for leaf in leaves_of(part)]
    return [value] if isinstance(value, Number) else []


def refilled(value: Any, filled: Iterator[Any]) -> Any:
    """A value with an array in the place of each traced number."""
    if isinstance(value, RECORDS):
        return type(value)(*(refilled(part, filled) for part in value))
    return next(filled) if isinstance(value, Number) else value


def loop_names(numba: Any) -> dict[str, Any]:
    """The functions that an emitted loop calls."""
    import numpy as np

    within = numba.njit(error_model="numpy", inline="always")
    return {
        "zeros": np.zeros,
        "rint": np.rint,
        "sqrt": np.sqrt,
        "floor": np.floor,
        "cos": math.cos,
        "sin": math.sin,
        "atan2": math.atan2,
        "inf": math.inf,
        "nan": math.nan,
        "sin45": within(sin45),
    }


def sin45(x: float) -> float:
    """Sine of an angle of at most 45 degrees, in radians: Taylor's series to x^17, within 1 ulp."""
    z = x * x
    s = 1 / 355687428096000
    s = s * z - 1 / 1307674368000
    s = s * z + 1 / 6227020800
    s = s * z - 1 / 39916800
    s = s * z + 1 / 362880
    s = s * z - 1 / 5040
    s = s * z + 1 / 120
    s = s * z - 1 / 6
    return x + x * (z * s)


@dataclass
class Press:
    """Runs a program on many variants: by emitted source, made once for what is asked, or plainly.

    ``kept`` holds None for what source cannot follow.
    """

    program: Program
    kept: dict[tuple[Any, ...], Emitted | None] = field(default_factory=dict)

    def run(
        self,
        needed: Sequence[int],
        values: Values,
        keep: Sequence[int],
        *,
        margins: bool = False,
        overrides: Overrides | None = None,
        compiled: bool | None = None,
    ) -> Trace:
        """As run_blocks: what cannot be drawn is NaN; the caller wraps it in numpy's errstate.

        ``overrides`` gives arrays in place of the values of steps. ``compiled`` asks for numba or
        for none of it; None leaves that to the number of variants.
        """
        overrides = overrides or {}
        size = size_of((*values.values(), *overrides.values()))
        if compiled is None:
            compiled = size >= COMPILED_FROM and find_spec("numba") is not None
        if size >= EMITTED_FROM or compiled:
            emitted = self.emitted(needed, values, keep, margins, overrides)
            if emitted is not None:
                return emitted.run(inputs_of(values, overrides), size, compiled=compiled)
        if overrides:
            kind = batch_kind()
            return run_batch(
                self.program, needed, values, kind, keep, margins=margins, overrides=overrides
            )
        return run_blocks(self.program, needed, values, batch_kind(), keep, margins=margins)

    def emitted(
        self,
        needed: Sequence[int],
        values: Values,
        keep: Sequence[int],
        margins: bool,
        overrides: Overrides,
    ) -> Emitted | None:
        """The program emitted for some targets, inputs and constants; made once for each."""
        key = (tuple(needed), tuple(keep), margins, marked(values), marked(overrides))
        if key not in self.kept:
            try:
                found = traced(self.program, needed, values, keep, margins, overrides)
            except UntraceableError:
                self.kept[key] = None
            else:
                self.kept[key] = found
        return self.kept[key]


def size_of(values: Iterable[Any]) -> int:
    """How many variants there are."""
    return max((len(value) for value in values if is_array(value)), default=1)


def marked(values: Mapping[Any, Any]) -> tuple[Any, ...]:
    """Each name with its constant, or with the sort of array that it has."""
    return tuple((name, v.dtype.kind if is_array(v) else (v,)) for name, v in values.items())


def inputs_of(values: Values, overrides: Overrides) -> dict[str, Any]:
    """Plain arrays of floats for all inputs by name, two for a point."""
    import numpy as np

    found = {name: value for name, value in values.items() if is_array(value)}
    for number, array in overrides.items():
        if is_array(array):
            x, y = parts_named(number)
            found |= {x: array.real, y: array.imag} if array.dtype.kind == "c" else {x: array}
    return {name: np.ascontiguousarray(array, dtype=float) for name, array in found.items()}


def parts_named(number: int) -> tuple[str, str]:
    """Names of the inputs that stand for the value of a step; no parameter is called so."""
    return f"step {number}", f"step {number}, up"


def traced(
    program: Program,
    needed: Sequence[int],
    values: Values,
    keep: Sequence[int],
    margins: bool,
    overrides: Overrides,
) -> Emitted:
    """One run on traced numbers in the place of arrays: what it reckons, as a graph."""
    graph = Graph()
    ready = made_ready(program, needed, values, keep, frozenset(overrides))
    entered = {name: Number(graph, graph.input(name)) for name, v in values.items() if is_array(v)}
    given = {number: stand_in(graph, number, value) for number, value in overrides.items()}
    values = {**values, **entered}
    trace = run_moving(ready, values, traced_kind(), margins=margins, overrides=given)
    return Emitted(program, graph, trace.values, trace.margins)


def stand_in(graph: Graph, number: int, value: Any) -> Any:
    """The traced number that stands for a step's own value; a plain one stands for itself."""
    if not is_array(value):
        return value
    x, y = parts_named(number)
    return Number(graph, graph.input(x), graph.input(y) if value.dtype.kind == "c" else None)
