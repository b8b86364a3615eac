"""A traced graph as JavaScript source: straight-line code, for a page that moves by itself.

An expression that is used once is written inside its user. Every other expression, and a long
number that is used more than once, has a short name.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from graphkin.construction.tape.graph import Graph, Node

SIGNS = {
    "add": "{}+{}",
    "sub": "{}-{}",
    "mul": "{}*{}",
    "over": "1/{}",
    "neg": "-{}",
    "less": "{}<{}",
    "at_most": "{}<={}",
    "equal": "{}=={}",
    "both": "{}&&{}",
    "either": "{}||{}",
    "not": "!{}",
    "choose": "{}?{}:{}",
}
"""Operations written with operators; each argument is a name, a number or in brackets."""
CALLS = {
    "min": "min",
    "max": "max",
    "abs": "abs",
    "sqrt": "sqrt",
    "round": "round",
    "floor": "floor",
    "cos": "cos",
    "sin": "sin",
    "sin45": "sin",
    "atan2": "atan2",
}
"""Operations that are functions of JavaScript's Math."""
MATH = "const {" + ",".join(sorted(set(CALLS.values()))) + "}=Math;"
"""The line that declares those functions by name."""
DEEP = 40
"""Maximum nesting of operations: parsers have limits."""
LONG = 6
"""Number of characters from which a repeated number gets a name."""
BINDING = {"mul": 3, "over": 3, "add": 2, "sub": 2, "less": 1, "at_most": 1}
"""Precedence of operators; an argument with higher precedence needs no brackets."""
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
        if node.op in CALLS:
            return f"{CALLS[node.op]}({','.join([self.text[arg] for arg in node.args])})"
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
        holds, wants = BINDING.get(own, 0), BINDING.get(op, 4)
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
