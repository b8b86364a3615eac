"""A traced graph printed as JavaScript: the same straight line, for a page that moves by itself.

What is used once stands inside what uses it; everything else has a short name of its own.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from graphkin.steps.graph import Graph, Node

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
"""Operations written with signs; each argument is a name, a number or stands in brackets."""
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
"""Operations that are functions of JavaScript's own Math."""
TRUTHS = frozenset({"less", "at_most", "equal", "both", "either", "not"})
"""Operations that give a condition."""
MATH = "const {" + ",".join(sorted(set(CALLS.values()))) + "}=Math;"
"""The line by which those functions are known by their names."""
DEEP = 40
"""How many operations stand inside one another at most: parsers have their limits."""
DIGITS = "abcdefghijklmnopqrstuvwxyz"


def script_source(
    graph: Graph, outputs: Sequence[int], inputs: Mapping[str, int], name: str
) -> str:
    """Source of ``function name(x,y)``: y[i] becomes output i, x holds the inputs.

    ``inputs`` gives the place in x of each input of the graph by its name. Wants ``MATH`` before.
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

    def lines(self) -> Iterator[str]:
        """The constants of the function in order, then its outputs."""
        named = 0
        for number in self.order:
            node = self.graph.nodes[number]
            expression, plain = self.expression(node)
            deep = 1 + max((self.depth[arg] for arg in node.args), default=0)
            if plain or (self.uses[number] == 1 and deep < DEEP):
                self.text[number] = expression if plain else f"({expression})"
                self.depth[number] = 0 if plain else deep
                continue
            name, named = short_name(named), named + 1
            yield f"const {name}={expression};"
            self.text[number], self.depth[number] = name, 0
        for place, number in enumerate(self.outputs):
            whole = self.text[number]
            truth = self.graph.nodes[number].op in TRUTHS
            yield f"y[{place}]={whole}{'?1:0' if truth else ''};"

    def expression(self, node: Node) -> tuple[str, bool]:
        """A node in terms of the texts before it, and whether that needs neither name nor brackets.

        A number that is negative stands in brackets: two signs must not meet.
        """
        if node.op == "number":
            return written(node.value), True
        if node.op == "input":
            return f"x[{self.inputs[node.name]}]", True
        args = [self.text[arg] for arg in node.args]
        if node.op in CALLS:
            return f"{CALLS[node.op]}({','.join(map(bare, args))})", False
        return SIGNS[node.op].format(*args), False


def bare(text: str) -> str:
    """An argument between commas, without the brackets around all of it."""
    if not text.startswith("("):
        return text
    depth = 0
    for place, letter in enumerate(text):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if depth == 0:
            return text[1:-1] if place == len(text) - 1 else text
    return text


def written(value: float) -> str:
    """A constant with all its digits."""
    if not math.isfinite(value):
        return "NaN" if math.isnan(value) else f"({'-' if value < 0 else ''}Infinity)"
    text = repr(value).removesuffix(".0")
    return f"({text})" if text.startswith("-") else text


def short_name(number: int) -> str:
    """The name of a constant: one letter and digits, so that it is never a word of the language."""
    rest, letter = divmod(number, len(DIGITS))
    return f"{DIGITS[letter]}{rest or ''}" if DIGITS[letter] not in "xy" else f"_{letter}{rest}"
