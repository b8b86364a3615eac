"""Numbers that are nodes of a graph instead of values: they record the operations on them.

They take the place of a batch's arrays and support numpy's functions, so a program runs on them
unchanged. Code that needs the value itself (an ``if``, an index) cannot be traced and raises an
error.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from numbers import Complex, Real
from typing import Any

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import Trace, Values, is_array, made_ready, run_moving
from graphkin.construction.tape.graph import OPERATIONS, Graph
from graphkin.numbers.arithmetic import Kind, nearest_quarter, np, quarter_turns


class UntraceableError(AttributeError, TypeError):
    """A step with a course that depends on a value, so that it has no straight-line source."""


def refused(self: Traced, *_: Any) -> Any:
    """Raise the error for a traced number that is used as a value."""
    raise UntraceableError("a step that looks at a value, other than by arithmetic.pick")


class Traced:
    """A value that a run computes for each variant; ``shape`` imitates an array of variants."""

    __slots__ = ("graph",)
    __hash__ = None  # type: ignore[assignment]
    shape = ()

    def __init__(self, graph: Graph) -> None:
        self.graph = graph

    __bool__ = __float__ = __complex__ = __int__ = __index__ = __array__ = refused
    __len__ = __iter__ = __getitem__ = refused

    def drawn(self, node: int) -> Any:
        """The value of a node where marks are drawn. Raises UntraceableError elsewhere."""
        return refused(self) if self.graph.now is None else self.graph.now(node)

    def __getattr__(self, name: str) -> Any:
        raise UntraceableError(f"a step that asks an array for {name}")

    def __array_ufunc__(self, function: Any, method: str, *args: Any, **options: Any) -> Any:
        """Apply numpy's functions of numbers."""
        known = UFUNCS.get(function.__name__)
        if known is None or method != "__call__" or options:
            raise UntraceableError(f"numpy's {function.__name__}")
        return known(self.graph, *args)

    def __array_function__(self, function: Any, _: Any, args: Any, options: Any) -> Any:
        """Apply numpy's ``where``, element by element, and the angle of a direction."""
        if function.__name__ == "where" and len(args) == 3 and not options:
            return chosen(self.graph, *args)
        if function.__name__ == "angle" and isinstance(self, TracedNumber) and not options:
            return self.imag.do("atan2", self.real)
        raise UntraceableError(f"numpy's {function.__name__}")


class Truth(Traced):
    """A condition, true or false for each variant; as a bool, it has its drawn value."""

    __slots__ = ("node",)

    def __init__(self, graph: Graph, node: int) -> None:
        super().__init__(graph)
        self.node = node

    def __bool__(self) -> bool:
        return bool(self.drawn(self.node))

    def __and__(self, other: Any) -> Any:
        return self.joined("both", other)

    def __or__(self, other: Any) -> Any:
        return self.joined("either", other)

    def __invert__(self) -> Truth:
        return Truth(self.graph, self.graph.do("not", self.node))

    def joined(self, op: str, other: Any) -> Any:
        """Two conditions as one; a plain bool decides at once."""
        if isinstance(other, Truth):
            return Truth(self.graph, self.graph.do(op, self.node, other.node))
        return self if bool(other) == (op == "both") else bool(other)

    __rand__, __ror__ = __and__, __or__


class TracedNumber(Traced):  # noqa: PLW1641
    """A real number of a graph, or a point of the plane as two of them."""

    __slots__ = ("down", "node")

    def __init__(self, graph: Graph, node: int, down: int | None = None) -> None:
        self.graph, self.node, self.down = graph, node, down

    def __complex__(self) -> complex:
        return complex(self.drawn(self.node), self.drawn(self.below()))

    def __int__(self) -> int:
        return int(self.drawn(self.node))

    @property
    def real(self) -> TracedNumber:
        """The part along the x axis."""
        return TracedNumber(self.graph, self.node)

    @property
    def imag(self) -> TracedNumber:
        """The part along the y axis."""
        return TracedNumber(self.graph, self.below())

    def below(self) -> int:
        """The node of the part along the y axis; zero for a real number."""
        return self.graph.number(0.0) if self.down is None else self.down

    def conjugate(self) -> TracedNumber:
        """The point reflected in the x axis."""
        if self.down is None:
            return self
        return TracedNumber(self.graph, self.node, self.graph.do("neg", self.down))

    def of(self, x: TracedNumber, y: TracedNumber) -> TracedNumber:
        """A point from its parts."""
        return TracedNumber(self.graph, x.node, y.node)

    def of_constant(self, value: float) -> TracedNumber:
        """A constant of the same graph."""
        return TracedNumber(self.graph, self.graph.number(value))

    def do(self, op: str, *others: TracedNumber) -> TracedNumber:
        """A real operation on this number and others."""
        return TracedNumber(
            self.graph, self.graph.do(op, self.node, *[each.node for each in others])
        )

    def __add__(self, other: Any) -> TracedNumber:
        return self.by_parts("add", entered(self.graph, other))

    def __sub__(self, other: Any) -> TracedNumber:
        return self.by_parts("sub", entered(self.graph, other))

    def __rsub__(self, other: Any) -> TracedNumber:
        return entered(self.graph, other).by_parts("sub", self)

    def by_parts(self, op: str, other: TracedNumber) -> TracedNumber:
        """A sum or a difference, by parts."""
        graph = self.graph
        along = graph.do(op, self.node, other.node)
        if self.down is None and other.down is None:
            return TracedNumber(graph, along)
        return TracedNumber(graph, along, graph.do(op, self.below(), other.below()))

    def __mul__(self, other: Any) -> TracedNumber:
        other, do = entered(self.graph, other), self.graph.do
        a, b, c, d = self.node, self.down, other.node, other.down
        if b is None:
            return TracedNumber(self.graph, do("mul", a, c), None if d is None else do("mul", a, d))
        if d is None:
            return TracedNumber(self.graph, do("mul", c, a), do("mul", c, b))
        along = do("sub", do("mul", a, c), do("mul", b, d))
        return TracedNumber(self.graph, along, do("add", do("mul", a, d), do("mul", b, c)))

    def __truediv__(self, other: Any) -> TracedNumber:
        below = entered(self.graph, other)
        if below.down is None:
            return self.__mul__(below.do("over"))
        return self.__mul__(below.conjugate()).__mul__(square(below).do("over"))

    def __rtruediv__(self, other: Any) -> TracedNumber:
        return entered(self.graph, other).__truediv__(self)

    def __pow__(self, exponent: Any) -> TracedNumber:
        if exponent == 0.5:
            return root(self.graph, self)
        if exponent != int(exponent) or exponent < 0:
            raise UntraceableError("a broken or negative power")
        found = self.of_constant(1.0)
        for _ in range(int(exponent)):
            found = found * self
        return found

    def __mod__(self, other: float) -> TracedNumber:
        return self - (self * (1 / other)).do("floor") * other

    def __neg__(self) -> TracedNumber:
        do = self.graph.do
        down = None if self.down is None else do("neg", self.down)
        return TracedNumber(self.graph, do("neg", self.node), down)

    def __pos__(self) -> TracedNumber:
        return self

    def __abs__(self) -> TracedNumber:
        if self.down is None:
            return self.do("abs")
        if (self.node, self.down) in self.graph.units:
            return self.of_constant(1.0)
        for part, other in ((self.real, self.imag), (self.imag, self.real)):
            if self.graph.constant(part.node) == 0:
                return abs(other)
        return square(self).do("sqrt")

    def compared(self, op: str, other: Any, *, turned: bool = False) -> Any:
        """A condition on two numbers; a plain bool for two constants."""
        pair = (self, entered(self.graph, other))
        first, second = pair[::-1] if turned else pair
        values = [self.graph.constant(each.node) for each in (first, second)]
        if None not in values:
            return OPERATIONS[op].value(*values)
        return Truth(self.graph, self.graph.do(op, first.node, second.node))

    def __lt__(self, other: Any) -> Any:
        return self.compared("less", other)

    def __le__(self, other: Any) -> Any:
        return self.compared("at_most", other)

    def __gt__(self, other: Any) -> Any:
        return self.compared("less", other, turned=True)

    def __ge__(self, other: Any) -> Any:
        return self.compared("at_most", other, turned=True)

    def __eq__(self, other: Any) -> Any:
        other = entered(self.graph, other)
        across = self.compared("equal", other)
        if self.down is None and other.down is None:
            return across
        return across & self.imag.compared("equal", other.imag)

    def __ne__(self, other: Any) -> Any:
        found = self == other
        return ~found if isinstance(found, Truth) else not found

    __radd__, __rmul__ = __add__, __mul__


def entered(graph: Graph, value: Any) -> TracedNumber:
    """A plain number as a constant of the graph; a traced one unchanged."""
    if isinstance(value, TracedNumber):
        return value
    if isinstance(value, (float, Real)):
        return TracedNumber(graph, graph.number(float(value)))
    if isinstance(value, (complex, Complex)):
        point = complex(value)
        return TracedNumber(graph, graph.number(point.real), graph.number(point.imag))
    raise UntraceableError(f"a {type(value).__name__} among traced numbers")


def square(point: TracedNumber) -> TracedNumber:
    """Square of a distance; lengths beyond 1e±150 would overflow or underflow."""
    return TracedNumber(point.graph, point.graph.sum_of_squares(point.node, point.below()))


def root(graph: Graph, value: Any) -> TracedNumber:
    return entered(graph, value).do("sqrt")


def chosen(graph: Graph, condition: Any, yes: Any, no: Any) -> TracedNumber:
    """One of two numbers or points, by a condition."""
    if not isinstance(condition, Truth):
        return entered(graph, yes if condition else no)
    first, second = entered(graph, yes), entered(graph, no)

    def one(x: TracedNumber, y: TracedNumber) -> TracedNumber:
        return TracedNumber(graph, graph.do("choose", condition.node, x.node, y.node))

    if first.down is None and second.down is None:
        return one(first, second)
    return first.of(one(first.real, second.real), one(first.imag, second.imag))


def plain(op: str) -> Callable[..., TracedNumber]:
    """A function of real numbers as an operation of the graph."""
    return lambda graph, *args: entered(graph, args[0]).do(
        op, *(entered(graph, each) for each in args[1:])
    )


def by_operator(function: Callable[..., Any]) -> Callable[..., Any]:
    """A Python operator on numbers entered in the graph."""
    return lambda graph, *args: function(
        *(each if isinstance(each, Traced) else entered(graph, each) for each in args)
    )


UFUNCS: dict[str, Callable[..., Any]] = {
    "sqrt": plain("sqrt"),
    "cos": plain("cos"),
    "sin": plain("sin"),
    "arctan2": plain("atan2"),
    "rint": plain("round"),
    "floor": plain("floor"),
    "absolute": by_operator(abs),
    "add": by_operator(operator.add),
    "subtract": by_operator(operator.sub),
    "multiply": by_operator(operator.mul),
    "divide": by_operator(operator.truediv),
}
"""Numpy's functions by their names."""


# --- a run on traced numbers in place of arrays ---------------------------------------------------


class TracedKind(Kind, frozen=True):
    """The number kind of a tracer: as a batch, except that angles in degrees are reduced first."""

    def direction(self, degrees: Any) -> Any:
        """Unit vector at an angle in degrees.

        For an angle within 45 degrees, the cosine follows from the sine without loss of digits.
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
    """The kind of numbers that record the operations on them."""

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
    """One run on traced numbers in place of arrays: the graph, and a trace of its nodes.

    Raises UntraceableError for a step whose course depends on a value.
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
    """The traced number that replaces a step's own array; a plain value unchanged."""
    if not is_array(value):
        return value
    x, y = parts_named(number)
    return TracedNumber(graph, graph.input(x), graph.input(y) if value.dtype.kind == "c" else None)


def parts_named(number: int) -> tuple[str, str]:
    """Names of the inputs for the value of a step; no parameter can have these names."""
    return f"step {number}", f"step {number}, up"
