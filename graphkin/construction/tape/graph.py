"""The computations of a run as a graph of real operations.

Equal operations are shared and constants are folded. Traced numbers fill the graph (traced.py), and
it is emitted as source in emitted.py and javascript.py. The graph depends on neither.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple


class Node(NamedTuple):
    """One operation on earlier nodes; ``value`` is a constant's, ``name`` an input's."""

    op: str
    args: tuple[int, ...] = ()
    value: float = 0.0
    name: str = ""


def whole(rounding: Callable[[float], int], a: float) -> float:
    """A number rounded to a whole one; unchanged where it is infinite or NaN."""
    return float(rounding(a)) if math.isfinite(a) else a


def quotient(a: float, b: float) -> float:
    """A quotient as numpy has it: division by zero gives infinity or NaN."""
    if b:
        return a / b
    return a * math.copysign(math.inf, b)


class Operation(NamedTuple):
    """An operation: its value on numbers, and how each language writes it.

    ``array`` is its function of numpy, ``loop`` its expression in a compiled loop. JavaScript has a
    ``sign`` for it, or a ``call`` of Math. An operator that ``binds`` more strongly needs no
    brackets as an argument. ``commutes``: its arguments may be swapped. ``decides``: it gives or
    uses a condition.
    """

    value: Callable[..., Any]
    array: str
    loop: str
    sign: str = ""
    call: str = ""
    binds: int = 0
    commutes: bool = False
    decides: bool = False


OPERATIONS: dict[str, Operation] = {
    "add": Operation(operator.add, "add", "{} + {}", "{}+{}", binds=2, commutes=True),
    "sub": Operation(operator.sub, "subtract", "{} - {}", "{}-{}", binds=2),
    "mul": Operation(operator.mul, "multiply", "{} * {}", "{}*{}", binds=3, commutes=True),
    "over": Operation(lambda a: quotient(1.0, a), "divide", "1.0 / {}", "1/{}", binds=3),
    "neg": Operation(operator.neg, "negative", "-{}", "-{}"),
    "abs": Operation(abs, "absolute", "abs({})", call="abs"),
    "sqrt": Operation(
        lambda a: math.sqrt(a) if a >= 0 else math.nan, "sqrt", "sqrt({})", call="sqrt"
    ),
    "min": Operation(min, "minimum", "{0} if {0} <= {1} else {1}", call="min", commutes=True),
    "max": Operation(max, "maximum", "{1} if {0} <= {1} else {0}", call="max", commutes=True),
    "round": Operation(lambda a: whole(round, a), "rint", "rint({})", call="round"),
    "floor": Operation(lambda a: whole(math.floor, a), "floor", "floor({})", call="floor"),
    "cos": Operation(math.cos, "cos", "cos({})", call="cos"),
    "sin": Operation(math.sin, "sin", "sin({})", call="sin"),
    "sin45": Operation(math.sin, "sin", "sin45({})", call="sin"),
    "atan2": Operation(math.atan2, "arctan2", "atan2({}, {})", call="atan2"),
    "less": Operation(operator.lt, "less", "{} < {}", "{}<{}", binds=1, decides=True),
    "at_most": Operation(operator.le, "less_equal", "{} <= {}", "{}<={}", binds=1, decides=True),
    "equal": Operation(operator.eq, "equal", "{} == {}", "{}=={}", commutes=True, decides=True),
    "both": Operation(
        lambda a, b: bool(a) and bool(b),
        *("logical_and", "{} & {}", "{}&&{}"),
        commutes=True,
        decides=True,
    ),
    "either": Operation(
        lambda a, b: bool(a) or bool(b),
        *("logical_or", "{} | {}", "{}||{}"),
        commutes=True,
        decides=True,
    ),
    "not": Operation(operator.not_, "logical_not", "not {}", "!{}", decides=True),
    "choose": Operation(
        lambda condition, yes, no: yes if condition else no,
        *("where", "{1} if {0} else {2}", "{}?{}:{}"),
        decides=True,
    ),
}
"""Every operation of a graph."""


class Graph:
    """Operations in the order in which they were added; a node is identified by its number.

    Equal operations are stored once. ``known`` maps operations, in their simplest form and with the
    nodes that they use, to nodes; it identifies constants by all their bits and inputs by name.
    ``squares`` are the nodes that cannot be negative. ``units`` are the pairs of nodes that are the
    parts of a unit vector. ``now`` gives the value of a node at the drawn position, by which marks
    are chosen.
    """

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self.known: dict[tuple[str, object], int] = {}
        self.constants: dict[int, float] = {}
        self.squares: set[int] = set()
        self.units: set[tuple[int, int]] = set()
        self.now: Callable[[int], Any] | None = None

    def put(self, op: str, args: tuple[int, ...]) -> int:
        """The number of an operation on earlier nodes."""
        key = (op, args)
        if key not in self.known:
            self.known[key] = len(self.nodes)
            self.nodes.append(Node(op, args))
        return self.known[key]

    def number(self, value: float) -> int:
        """The node of a constant."""
        key = ("number", value.hex())
        if key not in self.known:
            self.known[key] = place = len(self.nodes)
            self.nodes.append(Node("number", value=value))
            self.constants[place] = value
        return self.known[key]

    def input(self, name: str) -> int:
        """The node of a number that differs from variant to variant."""
        key = ("input", name)
        if key not in self.known:
            self.known[key] = len(self.nodes)
            self.nodes.append(Node("input", name=name))
        return self.known[key]

    def constant(self, number: int) -> float | None:
        """The value of a constant node; None for other nodes."""
        return self.constants.get(number)

    def do(self, op: str, *args: int) -> int:
        """The node of an operation on earlier nodes, in its simplest form.

        A simplification may change the last bits and the sign of a zero. Zero times anything is
        zero, even where the other factor cannot be computed.
        """
        key = (op, args)
        found = self.known.get(key)
        if found is None:
            found = self.known[key] = self.simplest(op, args)
        return found

    def simplest(self, op: str, args: tuple[int, ...]) -> int:
        """The node of a new operation, in its simplest form."""
        known = self.constants
        own = OPERATIONS[op]
        if not own.decides and all(arg in known for arg in args):
            return self.number(float(own.value(*(known[arg] for arg in args))))
        simpler = SIMPLER.get(op)
        found = simpler(self, *args) if simpler else None
        if found is not None:
            return found
        return self.put(op, tuple(sorted(args)) if own.commutes else args)

    def sum_of_squares(self, a: int, b: int) -> int:
        """a² + b²; a common factor is taken out, so that equal lengths share nodes."""
        found = self.common_factor(a, b)
        if found is None:
            total = self.do("add", self.do("mul", a, a), self.do("mul", b, b))
        else:
            factor, first, second = found
            total = self.do(
                "mul", self.do("mul", factor, factor), self.sum_of_squares(first, second)
            )
        self.squares.add(total)
        return total

    def common_factor(self, a: int, b: int) -> tuple[int, int, int] | None:
        """A common factor of two products and the rest of each, without signs, or None."""
        first, second = (self.nodes[self.unsigned(each)] for each in (a, b))
        if first.op == second.op == "mul" and a != b:
            for place, factor in enumerate(first.args):
                if factor in second.args:
                    other = second.args[1 - second.args.index(factor)]
                    return factor, first.args[1 - place], other
        return None

    def unsigned(self, number: int) -> int:
        """A node, or the node of which it is the negative."""
        turned = self.negated(number)
        return number if turned is None else turned

    def negated(self, number: int) -> int | None:
        """The node of which a node is the negative; None for other nodes."""
        node = self.nodes[number]
        return node.args[0] if node.op == "neg" else None

    def needed(self, outputs: Iterable[int]) -> list[int]:
        """The nodes on which the outputs depend, in order."""
        wanted = set(outputs)
        for number in range(max(wanted, default=-1), -1, -1):
            if number in wanted:
                wanted.update(self.nodes[number].args)
        return sorted(wanted)


def simpler_sum(graph: Graph, a: int, b: int) -> int | None:
    """x + 0 is x; x + (-y) is x - y."""
    for one, other in ((a, b), (b, a)):
        if graph.constant(one) == 0:
            return other
        turned = graph.negated(one)
        if turned is not None:
            return graph.do("sub", other, turned)
    return None


def simpler_difference(graph: Graph, a: int, b: int) -> int | None:
    """x - 0 is x, 0 - x is -x, x - (-y) is x + y; y - x is the negative of a known x - y."""
    if graph.constant(b) == 0:
        return a
    if graph.constant(a) == 0:
        return graph.do("neg", b)
    of_a, of_b = graph.negated(a), graph.negated(b)
    if of_b is not None:
        return graph.do("add", a, of_b) if of_a is None else graph.do("sub", of_b, of_a)
    if of_a is not None:
        return graph.do("neg", graph.do("add", of_a, b))
    turned = graph.known.get(("sub", (b, a)))
    return None if turned is None else graph.do("neg", turned)


def simpler_product(graph: Graph, a: int, b: int) -> int | None:
    """x·1 is x, x·0 is 0; a minus sign moves out, so that equal products are shared.

    A square root times itself loses the root.
    """
    for one, other in ((a, b), (b, a)):
        node, inner = graph.nodes[one], graph.nodes[other]
        if node.op == "number":
            if node.value in (0, 1):
                return other if node.value else graph.number(0.0)
            if node.value < 0:
                return graph.do("neg", graph.do("mul", graph.number(-node.value), other))
        if node.op == "neg":
            return graph.do("neg", graph.do("mul", node.args[0], other))
        if inner.op == "mul":
            found = of_two_factors(graph, one, *inner.args)
            if found is not None:
                return found
    return square_of_root(graph, a) if a == b else None


def of_two_factors(graph: Graph, one: int, first: int, second: int) -> int | None:
    """l·(l·x) is l²·x without its root, and constants are multiplied together."""
    for same, rest in ((first, second), (second, first)):
        if same == one:
            squared = square_of_root(graph, one)
            return None if squared is None else graph.do("mul", squared, rest)
        if graph.constant(one) is not None and graph.constant(same) is not None:
            return graph.do("mul", graph.do("mul", one, same), rest)
    return None


def square_of_root(graph: Graph, number: int) -> int | None:
    """The square of a distance, or of its inverse, without the root; None for other nodes."""
    node = graph.nodes[number]
    if node.op == "over":
        below = square_of_root(graph, node.args[0])
        return None if below is None else graph.do("over", below)
    under = node.args[0] if node.op == "sqrt" else None
    return under if under in graph.squares else None


def simpler_negative(graph: Graph, a: int) -> int | None:
    """-(-x) is x, and -(x - y) is y - x where that is known."""
    node = graph.nodes[a]
    if node.op == "neg":
        return node.args[0]
    return graph.known.get(("sub", node.args[::-1])) if node.op == "sub" else None


def simpler_inverse(graph: Graph, a: int) -> int | None:
    """1/(-x) is -(1/x)."""
    turned = graph.negated(a)
    return None if turned is None else graph.do("neg", graph.do("over", turned))


def simpler_size(graph: Graph, a: int) -> int | None:
    """|-x| is |x|."""
    turned = graph.negated(a)
    return None if turned is None else graph.do("abs", turned)


def of_squares(op: str) -> Callable[[Graph, int, int], int | None]:
    """A rule that compares two square roots by their arguments."""

    def simpler(graph: Graph, a: int, b: int) -> int | None:
        first, second = graph.nodes[a], graph.nodes[b]
        if first.op == second.op == "sqrt":
            return graph.do(op, first.args[0], second.args[0])
        return None

    return simpler


def simpler_choice(graph: Graph, condition: int, yes: int, no: int) -> int | None:
    """A choice between equal nodes is that node; the smaller or larger of two is min or max."""
    if yes == no:
        return yes
    test = graph.nodes[condition]
    if test.op in ("less", "at_most") and set(test.args) == {yes, no}:
        return graph.do("min" if test.args == (yes, no) else "max", yes, no)
    return None


SIMPLER: dict[str, Callable[..., int | None]] = {
    "add": simpler_sum,
    "sub": simpler_difference,
    "mul": simpler_product,
    "neg": simpler_negative,
    "over": simpler_inverse,
    "abs": simpler_size,
    "less": of_squares("less"),
    "at_most": of_squares("at_most"),
    "choose": simpler_choice,
}
"""The simplification rule of each operation."""
