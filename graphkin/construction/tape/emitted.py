"""A traced program as something to run: its source as numpy functions, or as a compiled loop."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Struct

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import Trace
from graphkin.construction.tape.emit import Column, loop_source, numpy_source
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.traced import TracedNumber
from graphkin.numbers.arrays import np
from graphkin.numbers.plane import Circle, Line, Ratio, Vector

BLOCK = 8192
"""Variants run at once by numpy: few enough for the cache, enough to pay for each call."""
RECORDS = (Ratio, Line, Circle, Vector)


class Emitted(Struct, frozen=True, dict=True):
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
    def leaves(self) -> tuple[TracedNumber, ...]:
        """The traced numbers of all kept values, in order."""
        found: list[TracedNumber] = []
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
        import numpy

        source, rooms = numpy_source(self.graph, self.outputs)
        names: dict[str, Any] = {**vars(numpy), "inf": math.inf, "nan": math.nan}
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
    points = sum(len(column) == 2 for column in columns)
    of_points = iter(np.empty((points, size), complex))
    of_numbers = iter(np.empty((len(columns) - points, size)))
    return [next(of_points if len(column) == 2 else of_numbers) for column in columns]


def leaves_of(value: Any) -> list[TracedNumber]:
    """The traced numbers in a value."""
    if isinstance(value, RECORDS):
        return [leaf for part in value for leaf in leaves_of(part)]
    return [value] if isinstance(value, TracedNumber) else []


def refilled(value: Any, filled: Iterator[Any]) -> Any:
    """A value with an array in the place of each traced number."""
    if isinstance(value, RECORDS):
        return type(value)(*(refilled(part, filled) for part in value))
    return next(filled) if isinstance(value, TracedNumber) else value


def loop_names(numba: Any) -> dict[str, Any]:
    """The functions that an emitted loop calls."""
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
