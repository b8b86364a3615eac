"""The parameters of a scene as a sheet prints them: once, with the unit that their use gives."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

from graphkin.construction.core.naming import angle_symbol, speed_symbol
from graphkin.construction.core.quantities import quantity_text, unit_words
from graphkin.drawing.symbol_markup import escape
from graphkin.scene.expression import CONSTANT, TIME
from graphkin.scene.model import Scene, lengths_of, quantities_within
from graphkin.scene.quantity import LENGTHS, Quantity, shortest
from graphkin.scene.read_scene import SPELLINGS
from graphkin.text import Words
from graphkin.text.errors import SceneError

LETTERS = (
    "alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi rho sigma tau",
    "phi psi omega",
)
GREEK = dict(zip(" ".join(LETTERS).split(), "αβγδεζηθκλμνξρστφψω", strict=True))
"""Greek letters by the names that a parameter may have."""


def parameters(scene: Scene, words: Words) -> list[str]:
    """The parameters that are put into an expression, as set; the data tell what others give."""
    return [parameter(scene, words, name) for name in scene.values if name in put_in(scene)]


def variant(scene: Scene, words: Words) -> list[str]:
    """The parameters that tell a variant from others: those with a range, and those put in.

    What is a driver's position or speed and nothing else has the letter that the sheet gives it.
    """
    ranged = {name for name, each in scene.parameters.items() if each.minimum is not None}
    put = put_in(scene)
    letters = {lone(scene, each.speed): speed_symbol(each) for each in scene.drivers}
    letters |= {lone(scene, each.position): angle_symbol(scene, each) for each in scene.drivers}
    told = ((name, *as_set(scene, words, name)) for name in scene.values if name in ranged | put)
    return [
        f"{letter if name in put else letters.get(name, letter)} = {value}"
        for name, letter, value in told
    ]


def other_parameters(scene: Scene, words: Words) -> list[tuple[str, str, str]]:
    """The parameters put into an expression that no driver or length shows by itself: each with
    its symbol and what it is set to."""
    shown = {name for quantity in shown_quantities(scene) if (name := lone(scene, quantity))}
    put = put_in(scene)
    return [(name, *as_set(scene, words, name)) for name in scene.values if name in put - shown]


def put_in(scene: Scene) -> set[str]:
    """The parameters that are put into an expression: those by which the drivers are reckoned."""
    rates = (q for d in scene.drivers for q in (d.position, d.speed, d.acceleration))
    return {name for rate in rates if not lone(scene, rate) for name in rate.uses()}


def parameter(scene: Scene, words: Words, name: str) -> str:
    """A parameter and what it is set to."""
    return " = ".join(as_set(scene, words, name))


def parameter_symbol(name: str) -> str:
    """A parameter's symbol: its name, or the Greek letter that it spells."""
    return f"*{escape(GREEK.get(name, name))}*"


def as_set(scene: Scene, words: Words, name: str) -> tuple[str, str]:
    """A parameter's symbol and what it is set to; t is the moment of laws of time, in seconds."""
    unit = "s" if name == TIME else unit_of(scene, name)
    says_it = SPELLINGS.get(name.lower(), name) == unit  # rpm = 50, not 50 rev/min of rpm
    printed = "" if says_it else unit_words(words, unit)
    space = " " if printed and printed != "°" else ""
    return parameter_symbol(name), words.decimal(shortest(scene.values[name])) + space + printed


def after_parameter(scene: Scene, words: Words, quantity: Quantity, letter: str = "") -> str:
    """A quantity as printed, after the parameter that it is where others hang on that: a = 80 mm.

    ``letter`` is the symbol that stands before it already.
    """
    name, text = lone(scene, quantity), quantity_text(scene, words, quantity).rstrip()
    told = name in put_in(scene) and name != letter
    return f"{parameter_symbol(name)} = {text}" if told else text


def lone(scene: Scene, quantity: Quantity) -> str:
    """The parameter that a quantity is without more; nothing where it is another expression."""
    return quantity.text if quantity.text in scene.values and quantity.text != TIME else ""


def has_own_relation(scene: Scene, quantity: Quantity) -> bool:
    """Whether a relation of its own tells how a driver's quantity follows from the parameters."""
    derived = is_derived(quantity) and not quantity.is_zero()
    return derived or (bool(quantity.uses()) and not lone(scene, quantity))


def expression(scene: Scene, words: Words, quantity: Quantity, *, values: bool) -> str:
    """The text of a quantity as markup, its parameters as symbols or as figures."""
    text = re.sub(r"^d\(d\((.*)\)/dt\)/dt$", r"d**2(\1)/dt**2", quantity.text).replace("**", "^")
    known = scene.values

    def replaced(match: re.Match[str]) -> str:
        name = match[0]
        if name not in known:
            return "π" if name == CONSTANT else name
        return words.decimal(shortest(known[name])) if values else parameter_symbol(name)

    parts = re.split(r"([A-Za-z_]\w*)", text)
    return "".join(
        re.sub(r"^\w+$", replaced, part) if i % 2 else spelled(words, part)
        for i, part in enumerate(parts)
    )


def spelled(words: Words, text: str) -> str:
    """Signs of an expression as they are printed."""
    plain = escape(words.decimal(text).replace("*", "·").replace(" · ", "·"))
    return re.sub(r"\\\^(\d)(?!\d)", r"^\1", plain)


def law(scene: Scene, words: Words, quantity: Quantity) -> str:
    """The expression of a quantity with its unit: 15·n°, (30 + 2·n) rev/min."""
    text, unit = expression(scene, words, quantity, values=False), quantity.unit
    unit = words(f"unit.{unit}") if words.has(f"unit.{unit}") else unit
    bare = re.sub(r"\([^()]*\)", "", text)
    text = f"({text})" if re.search(r"[^^(][+−-]", bare) else text
    return f"{text}{'' if unit == '°' else ' '}{unit}"


def is_derived(quantity: Quantity) -> bool:
    """Whether a rate follows from the law of time of a position or a speed."""
    return "/dt" in quantity.text


def shown_quantities(scene: Scene) -> Iterator[Quantity]:
    """The quantities of the data beside which their parameter is printed."""
    for driver in scene.drivers:
        yield driver.position
        for rate in (driver.speed, driver.acceleration):
            if driver.kind != "turn" or float(rate.si(scene.values)) > 0:
                yield rate  # of a turning that is negative the sense stands in words
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            yield from (length for _, _, length in lengths_of(placing))
        for wheel in link.wheels:
            size = wheel.teeth or wheel.radius
            yield from () if size is None else (size,)


def unit_of(scene: Scene, name: str) -> str:
    """The unit of a parameter, where what grows as it does has one; nothing for a mere number.

    A fixed length of which others are multiples has the unit of these, what is put into sines
    that of angles. What has a range and moves lengths and turns alike, as the number of a student
    may, is a mere number.
    """
    if any(is_angle(quantity.text, name) for quantity in quantities(scene)):
        return scene.units["angle"]
    fixed = name in scene.parameters and scene.parameters[name].minimum is None
    kinds = {
        quantity.unit.split("/")[0] in LENGTHS
        for quantity in quantities(scene)
        if name in quantity.uses() and quantity.unit and slope_of(scene, quantity, name)
    }
    if not fixed and len(kinds) > 1:
        return ""
    units = {
        quantity.unit
        for quantity in quantities(scene)
        if name in quantity.uses()
        and (grows_alike(scene, quantity, name) or (fixed and is_multiple(scene, quantity, name)))
    }
    return units.pop() if len(units) == 1 else ""


def is_angle(text: str, name: str) -> bool:
    """Whether an expression takes the sine, cosine or tangent of just a parameter."""
    return re.search(rf"\b(?:sin|cos|tan)\(\s*{re.escape(name)}\s*\)", text) is not None


def grows_alike(scene: Scene, quantity: Quantity, name: str) -> bool:
    """Whether a quantity grows, or shrinks, by as much as a parameter grows."""
    slope = slope_of(scene, quantity, name)
    return slope is not None and abs(slope) == 1


def is_multiple(scene: Scene, quantity: Quantity, name: str) -> bool:
    """Whether a length grows in proportion to a parameter."""
    slope = slope_of(scene, quantity, name)
    if slope is None or quantity.unit not in LENGTHS:
        return False
    whole = float(quantity.number(scene.values))
    value = float(Fraction(str(scene.values[name])))
    return abs(slope * value - whole) <= 1e-9 * abs(whole)


def slope_of(scene: Scene, quantity: Quantity, name: str) -> float | None:
    """By how much a quantity grows with a parameter; None where that cannot be told."""
    try:
        return float(quantity.derivative(name).number(scene.values))
    except SceneError:
        return None


def quantities(scene: Scene) -> Iterator[Quantity]:
    """Every quantity by which a scene says how its links, drivers and pairs are."""
    yield from quantities_within((scene.frame, *scene.links.values(), *scene.drivers))
