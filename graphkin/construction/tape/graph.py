"""What a run reckons, as a graph of real operations: equal ones shared, constants folded.

A tracer fills it (tracer.py); printers turn it into source (emit.py). It knows neither.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

COMMUTING = frozenset({"add", "mul", "min", "max", "equal", "both", "either"})
"""Operations whose arguments may change places."""


class Node(NamedTuple):
    """One operation on earlier nodes; ``value`` is that of a ``number``, ``name`` an input's."""

    op: str
    args: tuple[int, ...] = ()
    value: float = 0.0
    name: str = ""


def quotient(a: float, b: float) -> float:
    """A quotient as arrays have it: nothing raises, over nought it is infinite or NaN."""
    if b:
        return a / b
    return a * math.copysign(math.inf, b)


FOLD: dict[str, Callable[..., float]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "over": lambda a: quotient(1.0, a),
    "neg": lambda a: -a,
    "abs": abs,
    "sqrt": lambda a: math.sqrt(a) if a >= 0 else math.nan,
    "min": min,
    "max": max,
    "round": lambda a: float(round(a)) if math.isfinite(a) else a,
    "floor": lambda a: float(math.floor(a)) if math.isfinite(a) else a,
    "cos": math.cos,
    "sin": math.sin,
    "sin45": math.sin,
    "atan2": math.atan2,
}
"""The value of an operation on constants."""


class Graph:
    """Operations in the order in which they were met; a node is known by its number.

    The same is put down once: ``known`` has operations by what they do and to which nodes, each in
    its simplest form, numbers by all their bits, inputs by their names. ``squares`` are the nodes
    that cannot be negative, ``units`` the pairs of nodes that are the parts of a unit vector;
    ``now`` gives the value of a node where something is drawn, by which its marks are chosen.
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
        """A constant."""
        key = ("number", value.hex())
        if key not in self.known:
            self.known[key] = place = len(self.nodes)
            self.nodes.append(Node("number", value=value))
            self.constants[place] = value
        return self.known[key]

    def input(self, name: str) -> int:
        """A number that differs from variant to variant."""
        key = ("input", name)
        if key not in self.known:
            self.known[key] = len(self.nodes)
            self.nodes.append(Node("input", name=name))
        return self.known[key]

    def constant(self, number: int) -> float | None:
        """The value of a node that is a constant, or None."""
        return self.constants.get(number)

    def do(self, op: str, *args: int) -> int:
        """An operation on earlier nodes, in its simplest form.

        What is simplified keeps its value but for the last bits and for the sign of a nought;
        nought times anything is nought, even where that thing cannot be drawn.
        """
        key = (op, args)
        found = self.known.get(key)
        if found is None:
            found = self.known[key] = self.simplest(op, args)
        return found

    def simplest(self, op: str, args: tuple[int, ...]) -> int:
        """The node of an operation that was not met before."""
        known = self.constants
        if args[0] in known and op in FOLD and all(arg in known for arg in args):
            return self.number(float(FOLD[op](*(known[arg] for arg in args))))
        simpler = SIMPLER.get(op)
        found = simpler(self, *args) if simpler else None
        if found is not None:
            return found
        return self.put(op, tuple(sorted(args)) if op in COMMUTING else args)

    def sum_of_squares(self, a: int, b: int) -> int:
        """a² + b²; where both are t times something t is taken out, so that equal lengths meet."""
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
        """A factor of two products and what is left of each, signs aside; None without one."""
        first, second = (self.nodes[self.unsigned(each)] for each in (a, b))
        if first.op == second.op == "mul" and a != b:
            for place, factor in enumerate(first.args):
                if factor in second.args:
                    other = second.args[1 - second.args.index(factor)]
                    return factor, first.args[1 - place], other
        return None

    def unsigned(self, number: int) -> int:
        """A node, or that whose negative it is."""
        turned = self.negated(number)
        return number if turned is None else turned

    def negated(self, number: int) -> int | None:
        """The node whose negative a node is, or None."""
        node = self.nodes[number]
        return node.args[0] if node.op == "neg" else None

    def needed(self, outputs: Iterable[int]) -> list[int]:
        """The nodes on which the outputs hang, in order: all others are dead."""
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
    """x·1 is x, x·0 is 0; a minus is taken out, so that equal products meet; no l·l of a root."""
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
    """l·(l·x) is l²·x without the root in it, and constants go together."""
    for same, rest in ((first, second), (second, first)):
        if same == one:
            squared = square_of_root(graph, one)
            return None if squared is None else graph.do("mul", squared, rest)
        if graph.constant(one) is not None and graph.constant(same) is not None:
            return graph.do("mul", graph.do("mul", one, same), rest)
    return None


def square_of_root(graph: Graph, number: int) -> int | None:
    """The square of a distance, or of its inverse, without the root; None of anything else."""
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
    """The size of -x is that of x."""
    turned = graph.negated(a)
    return None if turned is None else graph.do("abs", turned)


def of_squares(op: str) -> Callable[[Graph, int, int], int | None]:
    """Two roots compare as what they are the roots of."""

    def simpler(graph: Graph, a: int, b: int) -> int | None:
        first, second = graph.nodes[a], graph.nodes[b]
        if first.op == second.op == "sqrt":
            return graph.do(op, first.args[0], second.args[0])
        return None

    return simpler


def simpler_choice(graph: Graph, condition: int, yes: int, no: int) -> int | None:
    """Between two equals there is no choice; the smaller or larger of two has a name of its own."""
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
"""The rules by which an operation becomes a simpler one."""
