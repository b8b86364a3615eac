"""Simplified expressions as written by hand: numbers combined, like terms added; their text."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from graphkin.scene.expression import Call, Minus, Name, Number, Pair, Tree
from graphkin.scene.quantity import shortest

SUM, PRODUCT, POWER, ATOM = range(4)
"""How tightly the parts of an expression bind."""


class Product(Struct, frozen=True):
    """A number times some factors, divided by others."""

    number: Fraction
    above: tuple[Tree, ...] = ()
    below: tuple[Tree, ...] = ()


def simplified(tree: Tree) -> Tree:
    """A tree of the same value with numbers combined and like terms added."""
    match tree:
        case Pair("+" | "-"):
            return added(tree)
        case Pair("*" | "/") | Minus():
            return multiplied(product(tree))
        case Pair(sign, base, exponent):
            base, exponent = simplified(base), simplified(exponent)
            return base if exponent == Number(Fraction(1)) else Pair(sign, base, exponent)
        case Call(function, inner):
            return Call(function, simplified(inner))
    return tree


def added(tree: Tree) -> Tree:
    """The sum of the terms of a tree, with like terms combined, in their order."""
    found: dict[Product, Fraction] = {}
    for term in terms(tree):
        like = replace(term, number=Fraction(1))
        found[like] = found.get(like, Fraction(0)) + term.number
    total: Tree | None = None
    for like, number in found.items():
        if not number:
            continue
        if total is None:
            total = multiplied(replace(like, number=number))
        else:
            sign = "+" if number > 0 else "-"
            total = Pair(sign, total, multiplied(replace(like, number=abs(number))))
    return Number(Fraction(0)) if total is None else total


def terms(tree: Tree) -> Iterator[Product]:
    """The terms of a sum or difference, each with its sign."""
    match tree:
        case Pair("+", left, right):
            yield from terms(left)
            yield from terms(right)
        case Pair("-", left, right):
            yield from terms(left)
            yield from terms(Minus(right))
        case Minus(Pair("+" | "-" as sign, left, right)):
            yield from terms(Minus(left))
            yield from terms(right if sign == "-" else Minus(right))
        case _:
            yield product(tree)


def product(tree: Tree) -> Product:
    """A tree as one number times factors, divided by others."""
    match tree:
        case Number(value):
            return Product(value)
        case Minus(inner):
            found = product(inner)
            return replace(found, number=-found.number)
        case Pair("*", left, right):
            a, b = product(left), product(right)
            return Product(a.number * b.number, a.above + b.above, a.below + b.below)
        case Pair("/", left, right) if product(right).number:
            a, b = product(left), product(right)
            return Product(a.number / b.number, a.above + b.below, a.below + b.above)
        case Pair("+" | "-"):
            whole = added(tree)
            if not isinstance(whole, Pair) or whole.sign not in "+-":
                return product(whole)
            return Product(Fraction(1), (whole,))
    short = simplified(tree) if not isinstance(tree, Pair) or tree.sign == "**" else tree
    return product(short) if isinstance(short, Number | Minus) else Product(Fraction(1), (short,))


def multiplied(parts: Product) -> Tree:
    """The tree of a number times factors, divided by others."""
    number, above, below = parts.number, parts.above, parts.below
    if not number:
        return Number(Fraction(0))
    size, whole = abs(number), 1
    if below or not ends(size):
        size, whole = Fraction(size.numerator), size.denominator
    factors = [*([Number(size)] if size != 1 or not above else []), *above]
    under = [*([Number(Fraction(whole))] if whole != 1 else []), *below]
    tree = chained(factors)
    if under:
        tree = Pair("/", tree, chained(under))
    return tree if number > 0 else Minus(tree)


def chained(factors: list[Tree]) -> Tree:
    """The product of factors, from left to right."""
    tree, *rest = factors
    for factor in rest:
        tree = Pair("*", tree, factor)
    return tree


def ends(number: Fraction) -> bool:
    """Whether a number has a terminating decimal."""
    rest = number.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return rest == 1


def text_of(tree: Tree) -> str:
    """An expression as a lecturer writes it, with only the brackets it needs."""
    return spelled(tree, SUM)


def spelled(tree: Tree, least: int) -> str:
    """A tree as text, in brackets where it binds less tightly than required."""
    match tree:
        case Number(value):
            closeness, text = (ATOM if value >= 0 else SUM), shortest(value)
            if not ends(value):
                closeness, text = PRODUCT, f"{value.numerator}/{value.denominator}"
        case Name(name):
            closeness, text = ATOM, name
        case Call(function, inner):
            closeness, text = ATOM, f"{function}({text_of(inner)})"
        case Minus(inner):
            closeness, text = SUM, f"-{spelled(inner, PRODUCT)}"
        case Pair("+" | "-" as sign, left, right):
            closeness, text = SUM, f"{spelled(left, SUM)} {sign} {spelled(right, PRODUCT)}"
        case Pair("*" | "/" as sign, left, right):
            closer = POWER if sign == "/" else PRODUCT
            closeness, text = PRODUCT, f"{spelled(left, PRODUCT)}{sign}{spelled(right, closer)}"
        case Pair(_, base, exponent):
            closeness, text = POWER, f"{spelled(base, ATOM)}**{spelled(exponent, ATOM)}"
    return text if closeness >= least else f"({text})"
