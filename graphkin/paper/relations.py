"""The relations of the calculation in the order of the work, read off the steps.

What was laid off, what was crossed, and what follows by length.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.paper.data import given
from graphkin.paper.drawing import Drawing
from graphkin.paper.outset import of_driver, of_scales
from graphkin.paper.relation import Relation, answer, figure, length_of
from graphkin.paper.symbolic import bar, symbol
from graphkin.paper.tables import segment_markup, sense
from graphkin.plane import Ratio, Vector
from graphkin.steps.program import Part, Plane, Step

Section = tuple[str, list[Relation]]


def relations(drawings: Sequence[Drawing]) -> list[Section]:
    """The sections of the calculation, in the order of the work."""
    first = drawings[0]
    sections: list[Section] = [
        ("data", [data_line(first)]),
        ("driver", [r for d in first.scene.drivers for r in of_driver(first, d)]),
        ("scales", list(of_scales(first))),
    ]
    for drawing in drawings:
        sections += sections_of(drawing)
    return sections


def sections_of(drawing: Drawing) -> list[Section]:
    """The sections of one sheet."""
    if drawing.kind == "velocity":
        return [
            ("velocities", [*of_equations(drawing), *read_off(drawing)]),
            ("turning", list(of_turning(drawing))),
            ("centres", list(of_centres(drawing))),
        ]
    return [
        ("normals", list(of_normals(drawing))),
        ("accelerations", [*of_equations(drawing), *read_off(drawing)]),
        ("spinning", list(of_turning(drawing))),
        ("poles", list(of_centres(drawing))),
    ]


def data_line(drawing: Drawing) -> Relation:
    """The data, as one relation that may be broken after each piece."""
    *pieces, last = given(drawing)
    first, *more = [f"{piece};" for piece in pieces] + [last]
    return Relation(first, more=tuple(more))


def of_equations(drawing: Drawing) -> Iterator[Relation]:
    """Euler's theorems for each motion about a pin, and the directions that guides give."""
    for _, step, _ in drawing.steps(drawing.plane):
        key = step.action.key if step.action else ""
        if key == "square-to":
            yield euler(drawing, step.says["p"], step.says["q"])
        elif key == "parallel-to":
            point = drawing.scene.links[step.says["g"]].points[0]
            name = symbol(f"{'v' if drawing.kind == 'velocity' else 'a'}_{point}")
            guide = drawing.words("page.guide_of", g=step.says["g"])
            yield Relation(drawing.words("calculation.along_guide", name=name, guide=guide))


def euler(drawing: Drawing, p: str, q: str) -> Relation:
    """Euler's theorem for the motion of a pin about another, or about a fixed pivot."""
    fixed = p in drawing.scene.frame.points
    index, letter = (q if fixed else q + p), "v" if drawing.kind == "velocity" else "a"
    key = f"calculation.{'about' if fixed else 'euler'}_{drawing.kind}"
    fields = {
        "whole": symbol(f"{letter}_{q}"),
        "start": symbol(f"{letter}_{p}"),
        "relative": symbol(f"v_{index}"),
        "normal": symbol(f"a_{index}^ν"),
        "tangential": symbol(f"a_{index}^τ"),
    }
    return Relation(drawing.words(key, bar=bar(p, q), p=symbol(p), q=symbol(q), **fields))


def read_off(drawing: Drawing) -> Iterator[Relation]:
    """Each vector that is read off the plan: scale factor times drawn length."""
    scale = drawing.scales.kv if drawing.kind == "velocity" else drawing.scales.ka
    k = "*k*_v" if drawing.kind == "velocity" else "*k*_a"
    unit = "m/s" if drawing.kind == "velocity" else "m/s^2"
    for _, step, value in drawing.steps(drawing.plane):
        if not step.arrow or not isinstance(value, Vector) or is_laid_off(drawing, step):
            continue
        size = drawing.settled(abs(value.tip - value.tail))
        name = step.says["symbol"]
        segment = (
            segment_markup(step.name)
            if step.name != name
            else drawing.words("calculation.segment", name=symbol(name))
        )
        figures = f"{figure(drawing, scale / 1000)}·{drawn(drawing, 1000 * size / scale)}"
        yield Relation(symbol(name), f"{k}·{segment}", figures, answer(drawing, size), unit)


def is_laid_off(drawing: Drawing, step: Step) -> bool:
    """True for a component that was not found by the plan but computed and laid off."""
    driven = {driver.link for driver in drawing.scene.drivers}
    bars = [drawing.scene.links[link].points for link in driven]
    of_driver = any({step.says["p"], step.says["q"]} <= set(points) for points in bars)
    return step.says.get("kind") == "ν" or (step.says.get("kind") == "τ" and of_driver)


def drawn(drawing: Drawing, millimetres: float) -> str:
    """A drawn length, to a thousandth of a millimetre or five digits."""
    return figure(drawing, millimetres if millimetres < 10 else round(millimetres, 3))


def of_normals(drawing: Drawing) -> Iterator[Relation]:
    """Each normal component: square of the relative velocity over the bar, and its drawn length."""
    ka = drawing.scales.ka
    for _, step, value in drawing.steps(Plane.NUMBERS):
        if step.action is None or step.action.key != "normal":
            continue
        p, q, i = step.says["p"], step.says["q"], step.says["i"]
        length, size = length_of(drawing, p, q), drawing.settled(abs(value))
        speed = (size * length) ** 0.5
        yield Relation(
            symbol(f"a_{i}^ν"),
            f"{symbol('v_' + i)}^2/{bar(p, q)}",
            f"{figure(drawing, speed)}^2/{figure(drawing, length)}",
            answer(drawing, size),
            "m/s^2",
            drawing.words(
                "calculation.laid_off",
                p=symbol(p),
                q=symbol(q),
                drawn=drawing.words.fixed(1000 * size / ka, 2),
            ),
        )


def of_turning(drawing: Drawing) -> Iterator[Relation]:
    """Angular velocities or accelerations: relative motion over length, with the sense."""
    velocity = drawing.kind == "velocity"
    key, letter, unit = ("omega", "ω", "rad/s") if velocity else ("epsilon", "ε", "rad/s^2")
    program = drawing.trace.program
    for link in drawing.scene.links:
        step = program.steps[program.targets.get((key, link), 0)]
        value = drawing.turning(link)
        if value is None or step.action is None or step.action.key != key:
            continue
        p, q = step.says["p"], step.says["q"]
        index = q if p in drawing.scene.frame.points else q + p
        relative = symbol(f"v_{index}" if velocity else f"a_{index}^τ")
        length = length_of(drawing, p, q)
        yield Relation(
            symbol(f"{letter}_{step.name}"),
            f"{relative}/{bar(p, q)}",
            f"{figure(drawing, abs(value) * length)}/{figure(drawing, length)}",
            answer(drawing, abs(value)),
            unit,
            sense(drawing.words, value),
        )


def of_centres(drawing: Drawing) -> Iterator[Relation]:
    """Where instantaneous centres and acceleration poles lie, in the axes of the frame."""
    part = Part.CENTRE if drawing.kind == "velocity" else Part.POLE
    unit, axes = drawing.scene.units["length"], drawing.words("calculation.axes")
    for _, step, value in drawing.mechanism_steps():
        if step.part is not part or not isinstance(value, Ratio) or not step.name:
            continue
        point = drawing.place(value)
        if point is None:
            key = "everywhere" if drawing.is_everywhere(value) else "at_infinity"
            yield Relation(symbol(step.name), result=drawing.words(f"calculation.{key}"))
        else:
            x, y = (answer(drawing, drawing.length(part)) for part in (point.real, point.imag))
            yield Relation(symbol(step.name), result=f"({x}; {y})", unit=unit, remark=axes)
