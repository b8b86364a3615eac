"""A traced program as source: numpy functions, a compiled loop with its batches, or JavaScript.

An expression that is used once is written inside its user. Every other expression, and a long
number that is used more than once, has a short name.

Tracing a program and writing its source takes some milliseconds, once for each request; compiling
takes a second or more. So small batches run step by step. The choice depends only on the size of
the batch, not on earlier runs; the results differ by rounding alone.

A moving page computes the outputs of a graph at each position of the driver. The same graph gives
their values at the scene's own position, so that they can be compared with what is drawn there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from importlib.util import find_spec
from typing import Any, Literal

from msgspec import Struct, field

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import Trace, Values, is_array, run_batch, run_blocks
from graphkin.construction.core.solution import with_least_margin
from graphkin.construction.tape.graph import OPERATIONS, Graph, Node
from graphkin.construction.tape.traced import (
    TracedNumber,
    Truth,
    UntraceableError,
    entered,
    parts_named,
    traced,
)
from graphkin.numbers.arithmetic import batch_kind, np
from graphkin.numbers.plane import Circle, Line, Ratio, Vector

LOOP = {op: each.loop for op, each in OPERATIONS.items()}
"""The expression of an operation in a loop over single numbers."""
CALLS = frozenset({"cos", "sin", "atan2"})
"""Operations that call a library for each number: a compiler cannot vectorize them."""
Column = tuple[int, ...]
"""The nodes of one output array: one for real numbers, two for points."""
STRIP = 64
"""Variants in one strip of a compiled loop, so that its scratch stays in the nearest cache."""


def last_uses(graph: Graph, order: Sequence[int]) -> dict[int, int]:
    """For each node, the last node that uses it."""
    last = {number: number for number in order}
    for number in order:
        last |= dict.fromkeys(graph.nodes[number].args, number)
    return last


def shown(node: Node) -> str:
    return repr(node.value)


# --- numpy ---------------------------------------------------------------------------------------


def numpy_source(graph: Graph, outputs: Sequence[int]) -> tuple[str, int]:
    """Source of ``block(x, y, t)`` on arrays, and the number of scratch arrays t that it needs.

    ``x`` are the inputs by name, ``y`` the arrays to be filled with the outputs.
    """
    order = graph.needed(outputs)
    scratch = ScratchArrays(graph, order, outputs)
    body = [line for number in order for line in scratch.written(number)]
    opening = [f"t{number} = t[{number}]" for number in range(scratch.count)]
    opening += [f"y{place} = y[{place}]" for place in range(len(outputs))]
    constants = [f"{name} = array({value})" for value, name in scratch.constants.items()]
    lines = ["def block(x, y, t):", *(f"    {line}" for line in (*opening, *body, "return"))]
    lines = [*constants, *lines]
    return "\n".join(lines) + "\n", scratch.count


class ScratchArrays:
    """Scratch arrays, each reused once the node in it is no longer needed."""

    def __init__(self, graph: Graph, order: Sequence[int], outputs: Sequence[int]) -> None:
        self.graph = graph
        self.count = 0
        self.free: list[int] = []
        self.name: dict[int, str] = {}
        self.constants: dict[str, str] = {}
        self.places: dict[int, list[int]] = {}
        for place, number in enumerate(outputs):
            self.places.setdefault(number, []).append(place)
        self.dying: dict[int, list[int]] = {}
        for number, end in last_uses(graph, order).items():
            self.dying.setdefault(end, []).append(number)

    def take(self, number: int) -> str:
        """A scratch array for a node, or the output array of a node that is only an output."""
        if number in self.dying.get(number, ()):
            return f"y{self.places[number].pop(0)}"
        if not self.free:
            self.free.append(self.count)
            self.count += 1
        return f"t{self.free.pop()}"

    def constant(self, value: str) -> str:
        """The name of a constant: numpy is faster with a one-number array than a plain number."""
        return self.constants.setdefault(value, f"k{len(self.constants)}")

    def written(self, number: int) -> list[str]:
        """The lines that compute a node and copy it to its outputs."""
        node = self.graph.nodes[number]
        lines = []
        if node.op == "number":
            self.name[number] = self.constant(shown(node))
        elif node.op == "input":
            self.name[number] = f"x[{node.name!r}]"
        else:
            lines.append(self.statement(number, node))
        places = self.places.get(number, ())
        lines += [f"copyto(y{place}, {self.name[number]})" for place in places]
        for dead in self.dying.get(number, ()):
            if self.name[dead].startswith("t"):
                self.free.append(int(self.name[dead][1:]))
        return lines

    def statement(self, number: int, node: Node) -> str:
        """The call that computes a node."""
        args = [self.name[arg] for arg in node.args]
        own = OPERATIONS[node.op]
        if own.decides:
            self.name[number] = name = f"{'w' if node.op == 'choose' else 'c'}{number}"
            return f"{name} = {own.array}({', '.join(args)})"
        self.name[number] = array = self.take(number)
        if node.op == "over":
            args.insert(0, self.constant("1.0"))
        return f"{own.array}({', '.join(args)}, out={array})"


# --- a loop over single numbers ------------------------------------------------------------------


def loop_source(graph: Graph, columns: Sequence[Column], inputs: Sequence[str]) -> str:
    """Source of ``loop(size, x…, y…)``: a strip of variants at a time through a small scratch.

    All intermediate values are in one array at known offsets. A compiler then sees that nothing
    overlaps, and vectorizes the loop. Operations that call a library come first.
    """
    outputs = [number for column in columns for number in column]
    order = graph.needed(outputs)
    early = graph.needed([number for number in order if graph.nodes[number].op in CALLS])
    kept = rows_of(graph, order, set(early), outputs)
    xs = [f"x{place}" for place in range(len(inputs))]
    ys = [f"y{place}" for place in range(len(columns))]
    names = dict(zip(inputs, xs, strict=True))
    lines = [f"def loop({', '.join(('size', *xs, *ys))}):"]
    lines += [f"    s = zeros({len(kept) * STRIP})", f"    for start in range(0, size, {STRIP}):"]
    lines += [f"        part = min({STRIP}, size - start)"]
    for number, row in kept.items():
        if graph.nodes[number].op == "input":
            lines += each("part", f"{at(row)} = {names[graph.nodes[number].name]}[start + i]")
    late = [number for number in order if number not in set(early)]
    for phase, bound in ((early, "part"), (late, STRIP)):
        lines += each(bound, *statements(graph, phase, kept))
    for y, column in zip(ys, columns, strict=True):
        parts = [at(kept[number]) for number in column]
        whole = parts[0] if len(parts) == 1 else f"complex({', '.join(parts)})"
        lines += [f"        z = {y}[start : start + part]", *each("part", f"z[i] = {whole}")]
    return "\n".join(lines) + "\n"


def rows_of(
    graph: Graph, order: Sequence[int], early: set[int], outputs: Iterable[int]
) -> dict[int, int]:
    """The nodes with a row of the scratch: inputs, outputs, and values that pass between loops."""
    wanted = set(outputs)
    for number in order:
        node = graph.nodes[number]
        if node.op == "input":
            wanted.add(number)
        if number not in early:
            wanted |= {arg for arg in node.args if arg in early}
    rows = [n for n in order if n in wanted and graph.nodes[n].op != "number"]
    constants = [n for n in set(outputs) if graph.nodes[n].op == "number"]
    return {number: row for row, number in enumerate((*rows, *sorted(constants)))}


def statements(graph: Graph, phase: Sequence[int], kept: dict[int, int]) -> list[str]:
    """One statement for each node of a loop, after reads of the values from another loop."""
    mine = set(phase)
    used = {arg for number in phase for arg in graph.nodes[number].args}
    lines = [f"v{arg} = {at(kept[arg])}" for arg in sorted(used - mine) if arg in kept]
    for number in phase:
        node = graph.nodes[number]
        if node.op == "input":
            lines.append(f"v{number} = {at(kept[number])}")
        elif node.op != "number":
            args = [value(graph, arg) for arg in node.args]
            lines.append(f"v{number} = {LOOP[node.op].format(*args)}")
        if number in kept and node.op != "input":
            lines.append(f"{at(kept[number])} = {value(graph, number)}")
    return lines


def value(graph: Graph, number: int) -> str:
    """A node in an expression."""
    node = graph.nodes[number]
    return f"({shown(node)})" if node.op == "number" else f"v{number}"


def at(row: int) -> str:
    """The place of a row in the scratch."""
    return f"s[{row * STRIP} + i]"


def each(bound: int | str, *body: str) -> list[str]:
    """A loop over the variants of a strip."""
    if not body:
        return []
    return [f"        for i in range({bound}):", *(f"            {line}" for line in body)]


# --- running it -----------------------------------------------------------------------------------


BLOCK = 8192
"""Variants in one numpy call: few enough for the cache, enough to repay the call."""
RECORDS = (Ratio, Line, Circle, Vector)


class Emitted(Struct, frozen=True, dict=True):
    """A traced program: its graph, and the kept values and margins as traced numbers."""

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
        """The nodes of all leaves: one for a number, two for a point."""
        return tuple(node for column in self.columns for node in column)

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """The nodes of each leaf: one for a number, two for a point."""
        return tuple(
            (leaf.node,) if leaf.down is None else (leaf.node, leaf.down) for leaf in self.leaves
        )

    @cached_property
    def by_numpy(self) -> tuple[Callable[..., None], int]:
        """The numpy source as a function, and the number of scratch arrays that it needs."""
        import numpy

        source, rooms = numpy_source(self.graph, self.outputs)
        names: dict[str, Any] = {**vars(numpy), "inf": math.inf, "nan": math.nan}
        exec(compile(source, "<emitted for numpy>", "exec"), names)
        return names["block"], rooms

    @cached_property
    def by_numba(self) -> Callable[..., None]:
        """The loop source as a function that numba compiles at its first call."""
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
        """Fill the arrays by numpy, one block at a time."""
        flat = [(y.real, y.imag) if y.dtype.kind == "c" else (y,) for y in filled]
        columns = [part for parts in flat for part in parts]
        block, rooms = self.by_numpy
        scratch = np.empty((rooms, min(size, BLOCK)))
        for start in range(0, size, BLOCK):
            part = slice(start, min(start + BLOCK, size))
            here = {name: array[part] for name, array in arrays.items()}
            block(here, [y[part] for y in columns], scratch[:, : part.stop - start])


def rooms_for(columns: Sequence[Column], size: int) -> list[Any]:
    """An array for each column, with all arrays of a kind in one block of memory for speed."""
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
    """A value with an array in place of each traced number."""
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


SIGNS = {op: each.sign for op, each in OPERATIONS.items() if each.sign}
"""Operations written with operators; each argument is a name, a number or in brackets."""
JS_CALLS = {op: each.call for op, each in OPERATIONS.items() if each.call}
"""Operations that are functions of JavaScript's Math."""
MATH = "const {" + ",".join(sorted(set(JS_CALLS.values()))) + "}=Math;"
"""The line that declares those functions by name."""
DEEP = 40
"""Maximum nesting of operations: parsers have limits."""
LONG = 6
"""Number of characters from which a repeated number gets a name."""
BRACKETED = 4
"""Precedence of an operator whose arguments have brackets if they have any operator."""
SIGNS_OF_NAMES = "abcdefghijklmnopqrstuvwz$_ABCDEFGHIJKLMNOPQRSTUVWXYZ"
"""What names begin with."""


def script_source(
    graph: Graph, outputs: Sequence[int], inputs: Mapping[str, int], name: str
) -> str:
    """Source of ``function name(x,y)``: it sets y[i] to output i; x holds the inputs.

    ``inputs`` maps each input's name to its index in x. The source needs the line ``MATH`` before
    it.
    """
    body = "\n".join(Writer(graph, outputs, inputs).lines())
    return f"function {name}(x,y){{\n{body}\n}}\n"


class Writer:
    """The text of each node: its own name, or its expression where it is used only once."""

    def __init__(self, graph: Graph, outputs: Sequence[int], inputs: Mapping[str, int]) -> None:
        self.graph, self.outputs, self.inputs = graph, outputs, inputs
        self.order = graph.needed(outputs)
        self.uses = dict.fromkeys(self.order, 0)
        for number in (*outputs, *(arg for n in self.order for arg in graph.nodes[n].args)):
            self.uses[number] += 1
        self.text: dict[int, str] = {}
        self.depth: dict[int, int] = {}
        """Nesting depth of the operations in each node's text; a name has depth 0."""

    def lines(self) -> Iterator[str]:
        """The constants of the function in order, then its outputs."""
        named: list[str] = []
        for number in self.order:
            node = self.graph.nodes[number]
            text = self.expression(node) if node.args else self.plain(node)
            deep = 1 + max([self.depth[arg] for arg in node.args], default=-1)
            again = self.uses[number] > 1 and (node.args or len(text) >= LONG)
            if again or deep >= DEEP:
                name = short_name(len(named))
                named.append(f"{name}={text}")
                text, deep = name, 0
            self.text[number], self.depth[number] = text, deep
        if named:
            yield "const " + ",".join(named) + ";"
        results = ",".join([self.text[number] for number in self.outputs])
        yield f"[{results}].forEach((v,i)=>{{y[i]=+v}});"

    def plain(self, node: Node) -> str:
        """A number or an input; a negative number has brackets, as two signs must not meet."""
        return written(node.value) if node.op == "number" else f"x[{self.inputs[node.name]}]"

    def expression(self, node: Node) -> str:
        """An operation, in terms of the texts of its arguments."""
        if node.op in JS_CALLS:
            return f"{JS_CALLS[node.op]}({','.join([self.text[arg] for arg in node.args])})"
        last = len(node.args) - 1
        parts = [self.signed(arg, node.op, place == last) for place, arg in enumerate(node.args)]
        return SIGNS[node.op].format(*parts)

    def signed(self, number: int, op: str, last: bool) -> str:
        """The text of a node as an argument of another operator, in brackets where needed.

        Products and sums are evaluated from the left, as in the graph, so that rounding does not
        change.
        """
        text, own = self.text[number], self.graph.nodes[number].op
        if not self.depth[number] or own not in SIGNS:
            return text
        holds, wants = OPERATIONS[own].binds, OPERATIONS[op].binds or BRACKETED
        return text if holds > wants or (holds == wants and not last) else f"({text})"


def written(value: float) -> str:
    """A constant with all its digits."""
    if not math.isfinite(value):
        return "NaN" if math.isnan(value) else f"({'-' if value < 0 else ''}Infinity)"
    text = repr(value).removesuffix(".0")
    return f"({text})" if text.startswith("-") else text


def short_name(number: int) -> str:
    """The name of a constant: one sign and digits, so that it is never a keyword, x or y."""
    rest, sign = divmod(number, len(SIGNS_OF_NAMES))
    return f"{SIGNS_OF_NAMES[sign]}{rest or ''}"


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


# --- the outputs of a moving page -----------------------------------------------------------------


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
