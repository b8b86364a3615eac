"""The relations of the calculation, each as symbols, figures put in, and result with its unit.

They are read off the steps: what was laid off, what was crossed, and what follows by length.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from graphkin.paper.data import angle_symbol, given, written
from graphkin.paper.drawing import Drawing, place_of
from graphkin.paper.richtext import escape
from graphkin.paper.symbolic import bar, symbol
from graphkin.paper.tables import segment_markup, sense
from graphkin.plane import Ratio, Vector
from graphkin.scene.model import Driver
from graphkin.scene.quantity import Quantity
from graphkin.steps.program import Part, Plane

DIGITS = 5
"""Significant digits of figures put in, so that results of four digits follow from them."""


@dataclass(frozen=True, slots=True)
class Relation:
    """left = symbols = figures = result unit, remark; ``more`` are further words after ``left``."""

    left: str
    symbols: str = ""
    figures: str = ""
    result: str = ""
    unit: str = ""
    remark: str = ""
    more: tuple[str, ...] = ()

    def parts(self, *, solved: bool) -> list[str]:
        """The pieces between which a line may be broken."""
        pieces = [self.left, *self.more]
        if self.symbols:
            pieces.append(f"= {self.symbols}")
        if not self.result:
            return pieces
        if not solved:
            return [*pieces, "="]
        if self.figures:
            pieces.append(f"= {self.figures}")
        pieces.append(f"= {self.result} {self.unit}".rstrip())
        if self.remark:
            pieces.append(f"({self.remark})")
        return pieces


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
    *pieces, last = given(drawing.scene, drawing.words)
    first, *more = [f"{piece};" for piece in pieces] + [last]
    return Relation(first, more=tuple(more))


def figure(drawing: Drawing, value: float, digits: int = DIGITS) -> str:
    """A number as it is put into a relation, without noughts at its end."""
    text = drawing.words.significant(value, digits)
    mark = drawing.words("decimal_mark")
    return text.rstrip("0").rstrip(mark) if mark in text and "·" not in text else text


def answer(drawing: Drawing, value: float) -> str:
    """A number as it comes out of a relation."""
    return drawing.words.significant(value, 4)


# --- the driver and the scales -------------------------------------------------------------------


def of_driver(drawing: Drawing, driver: Driver) -> Iterator[Relation]:
    """Position and speed from the parameters, angular velocity, speed of the driven pin."""
    words, scene = drawing.words, drawing.scene
    index = f"_{{{escape(driver.link)}}}"
    angle = angle_symbol(scene, driver)
    for letter, quantity in ((angle, driver.position), (f"*n*{index}", driver.speed)):
        if quantity.uses():
            value = written(scene, words, quantity)
            amount, _, unit = value.partition(" ")
            yield Relation(
                letter,
                expression(drawing, quantity, values=False),
                expression(drawing, quantity, values=True),
                amount,
                unit,
            )
    if driver.kind != "turn":
        return
    omega = float(driver.speed.si(scene.values))
    if driver.speed.unit == "rev/min":
        turns = words.decimal(driver.speed.written(scene.values))
        yield Relation(
            f"*ω*{index}",
            f"π·*n*{index}/30",
            f"π·{turns}/30",
            answer(drawing, abs(omega)),
            "rad/s",
            sense(words, omega),
        )
    yield from of_pin(drawing, driver, abs(omega))


def of_pin(drawing: Drawing, driver: Driver, omega: float) -> Iterator[Relation]:
    """Velocity and acceleration of the driven pin."""
    index = f"_{{{escape(driver.link)}}}"
    for _, step, _ in drawing.steps(Plane.VELOCITIES):
        if step.action is None or step.action.key != "turned-velocity":
            continue
        p, q = step.says["p"], step.says["q"]
        length = length_of(drawing, p, q)
        w, bar_length = figure(drawing, omega), figure(drawing, length)
        yield Relation(
            symbol(f"v_{q}"),
            f"*ω*{index}·{bar(p, q)}",
            f"{w}·{bar_length}",
            answer(drawing, omega * length),
            "m/s",
            f"⊥ {bar(p, q)}",
        )
        yield Relation(
            symbol(f"a_{q}^ν"),
            f"*ω*{index}^2·{bar(p, q)}",
            f"{w}^2·{bar_length}",
            answer(drawing, omega * omega * length),
            "m/s^2",
            drawing.words("calculation.towards", p=symbol(p), q=symbol(q)),
        )


def expression(drawing: Drawing, quantity: Quantity, *, values: bool) -> str:
    """The text of a quantity as markup, its parameters as symbols or as figures."""
    text = quantity.text.replace("**", "^")
    known = drawing.scene.values

    def replaced(match: re.Match[str]) -> str:
        name = match[0]
        if name not in known:
            return name
        return drawing.words.decimal(str(known[name])) if values else f"*{escape(name)}*"

    parts = re.split(r"([A-Za-z_]\w*)", text)
    return "".join(
        re.sub(r"^\w+$", replaced, part) if i % 2 else spelled(drawing, part)
        for i, part in enumerate(parts)
    )


def spelled(drawing: Drawing, text: str) -> str:
    """Signs of an expression as they are printed."""
    return escape(drawing.words.decimal(text).replace("*", "·").replace(" · ", "·"))


def of_scales(drawing: Drawing) -> Iterator[Relation]:
    """kL, kv and ka, and the drawn length of the driven bar."""
    words, scales = drawing.words, drawing.scales
    number = words.decimal(f"{scales.kL:g}")
    yield Relation("*k*_L", "", "", number, "", words("calculation.scale", scale=scales.words))
    for p, q, length in drawn_bars(drawing):
        yield Relation(
            f"{bar(p, q)}/*k*_L",
            "",
            f"{figure(drawing, 1000 * length)}/{number}",
            figure(drawing, 1000 * length / scales.kL),
            "mm",
            words("calculation.drawn"),
        )
    yield from plan_scales(drawing, number)


def plan_scales(drawing: Drawing, number: str) -> Iterator[Relation]:
    """kv and ka: from the driving crank, or kv chosen and ka = kv²/kL."""
    scales = drawing.scales
    kv, ka = figure(drawing, scales.kv / 1000), figure(drawing, scales.ka / 1000)
    if not scales.from_driver:
        yield Relation("*k*_v", "", "", kv, "(m/s)/mm", drawing.words("calculation.chosen"))
        yield Relation("*k*_a", "*k*_v^2/*k*_L", f"1000·{kv}^2/{number}", ka, "(m/s^2)/mm")
        return
    w = figure(drawing, 1 / scales.seconds, DIGITS + 2)
    yield Relation("*k*_v", "*ω*·*k*_L", f"{w}·{number}/1000", kv, "(m/s)/mm")
    yield Relation("*k*_a", "*ω*^2·*k*_L", f"{w}^2·{number}/1000", ka, "(m/s^2)/mm")


def drawn_bars(drawing: Drawing) -> Iterator[tuple[str, str, float]]:
    """The bars whose lengths are given, one for each length, in metres."""
    seen = set()
    for link in drawing.scene.links.values():
        for placing in link.placings:
            for p, q, quantity in placing.lengths():
                length = float(quantity.si(drawing.scene.values))
                if length not in seen:
                    seen.add(length)
                    yield p, q, length


# --- vectors of the plans ------------------------------------------------------------------------


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
        if not step.arrow or not isinstance(value, Vector) or step.says.get("kind") == "ν":
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


def length_of(drawing: Drawing, p: str, q: str) -> float:
    """Length of a bar in metres."""
    return abs(drawing.positions[q] - drawing.positions[p])


def of_centres(drawing: Drawing) -> Iterator[Relation]:
    """Where instantaneous centres and acceleration poles lie, in the scene's unit of length."""
    part = Part.CENTRE if drawing.kind == "velocity" else Part.POLE
    for _, step, value in drawing.mechanism_steps():
        if step.part is part and isinstance(value, Ratio):
            yield Relation(symbol(step.name), "", "", coordinates(drawing, value), "")


def coordinates(drawing: Drawing, value: Ratio) -> str:
    """The coordinates of a centre, or words for infinity."""
    point: Any = place_of(value)
    if point is None:
        return drawing.words("calculation.at_infinity")
    x, y = (answer(drawing, drawing.length(part)) for part in (point.real, point.imag))
    return f"({x}; {y}) {drawing.scene.units['length']}"
