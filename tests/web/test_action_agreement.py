"""Every action gives the same in Python and in the script of a page, to the last digits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from graphkin.construction.core.program import Step
from graphkin.construction.core.vocabulary import Action
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.construction.tape.emitted import MATH, script_source
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.traced import TracedNumber
from graphkin.mechanism import load
from tests.chosen import SCENES
from tests.documents.sheet_tools import mechanism_named

LABS = ("pump", "pump-collinear", "offset-slider-crank", "slotted-lever")
ULP = 2.0**-52
NEAR = 4 * ULP
CANCELLING = {"cam-lift"}
"""Polynomials whose terms cancel: four units in the last place of what they are made from."""
RUN = """([math, functions, inputs]) => functions.map((source, k) => {
  const run = new Function(math + source + ";return f")(), found = [];
  run(inputs[k], found);
  return found.map(value => Number.isFinite(value) ? value : null);
})"""


def uses() -> Iterator[tuple[Action, Step, tuple[Any, ...]]]:
    """Each action of the scenes that ship, with a step that it makes and what it is made from."""
    met = set[tuple[Any, ...]]()
    for name in (*LABS, *SCENES):
        mechanism = load(name) if name in LABS else mechanism_named(name)
        program, values = mechanism.program, mechanism.trace().values
        for step in program.steps:
            known = all(arg in values for arg in step.args)
            if step.action is None or closer_of(step) is not None or not known:
                continue
            args = tuple(values[arg] for arg in step.args)
            kind = step.action, step.extra, tuple(type(value) for value in args)
            if kind not in met:
                met.add(kind)
                yield step.action, step, args


def leaves(value: Any) -> list[Any]:
    """The numbers of a value, points as they are."""
    if isinstance(value, tuple):
        return [leaf for part in value for leaf in leaves(part)]
    return [value]


def entered(value: Any, graph: Graph, inputs: dict[str, float]) -> Any:
    """A value with traced numbers in the place of its floats, which are noted by their names."""
    if isinstance(value, tuple):
        parts = [entered(part, graph, inputs) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    if not isinstance(value, float | complex):
        return value
    parts = (value,) if isinstance(value, float) else (value.real, value.imag)
    names = [f"x{len(inputs) + k}" for k in range(len(parts))]
    inputs |= dict(zip(names, parts, strict=True))
    return TracedNumber(graph, *map(graph.input, names))


def traced(action: Action, step: Step, args: tuple[Any, ...]) -> tuple[str, Mapping[str, float]]:
    """The source of one action in JavaScript, and its inputs."""
    graph, inputs = Graph(), dict[str, float]()
    found = leaves(action.value(*(entered(arg, graph, inputs) for arg in args), *step.extra))
    outputs = []
    for leaf in found:
        if not isinstance(leaf, TracedNumber):
            parts = [complex(leaf).real, complex(leaf).imag]
            outputs += [graph.number(part) for part in parts]
        else:
            outputs += [leaf.node, graph.number(0.0) if leaf.down is None else leaf.down]
    places = {name: place for place, name in enumerate(inputs)}
    return script_source(graph, outputs, places, "f"), inputs


def test_every_action_gives_the_same_on_the_page(page: Any) -> None:
    """Within four units in the last place of its largest number."""
    every = list(uses())
    sources = [traced(*each) for each in every]
    written = [source for source, _ in sources], [list(inputs.values()) for _, inputs in sources]
    results = page.evaluate(RUN, [MATH, *written])
    far = {}
    for (action, step, args), numbers in zip(every, results, strict=True):
        meant = [complex(leaf) for leaf in leaves(action.value(*args, *step.extra))]
        found = [complex(x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
        from_what = args if action.key in CANCELLING else ()
        near = NEAR * max(abs(leaf) for leaf in (*meant, *leaves(from_what)))
        for one, other in zip(found, meant, strict=True):
            if abs(one - other) > near:
                far[action.key, action.value.__name__] = one, other
    assert len(every) > 100
    assert not far
