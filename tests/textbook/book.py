"""Textbook examples: the answers of a scene, and how a printed number is held against them.

Every test keeps apart what the book prints and what is exact. A printed number that was computed
must agree to its digits (``rounds_to``), one that was read off a drawing within a share of itself
that the test states (``within``). The exact one comes from a closed form or from a recomputation in
40 digits.

What a book prints we know from quotations of it and from FOSSEE's Python Textbook Companions
(Khurmi, Bevan, Sarkar, Meriam, Hibbeler, McLean, Beer, Tayal), "our source" where a test says so;
most of the figures we have not seen.
"""

from __future__ import annotations

import math
from decimal import Decimal

from graphkin.construction.core.solution import Solution
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.laws.exact_forces import far_from_exact

IN, FT, CM = 0.0254, 0.3048, 0.01
"""Metres in the books' units of length."""
RPM = math.pi / 30
"""Radians per second in a revolution per minute."""
DRAWN = 0.03
"""Share of itself within which a value read off a good drawing is right."""
WITNESSED = 1e-10
"""Largest difference of the independent route that an example may show."""


def mechanism(text: str, **settings: object) -> Mechanism:
    """The mechanism of an example, from its scene without the line of the version."""
    return Mechanism(read_text(f'graphkin = 1\ntitle = "textbook"\n{text}', "book", None, settings))


def answers(text: str, **settings: object) -> Solution:
    """What the construction answers to an example; the witness and the branches agree."""
    example = mechanism(text, **settings)
    solution = example.solve()
    verdict = example.witness(solution)
    assert verdict.branches == (), f"not as the scene says: {verdict.branches}"
    assert verdict.largest_difference < WITNESSED, f"the witness: {verdict}"
    assert verdict.agrees, f"the witness: {verdict}"
    return solution


def within(found: float, printed: float, share: float = DRAWN) -> bool:
    """Whether a printed value is right to a share of itself; its sign counts."""
    return abs(found - printed) <= share * abs(printed)


def rounds_to(found: float, printed: str) -> bool:
    """Whether a value, rounded to the digits of the print, is the printed one."""
    number = Decimal(printed).as_tuple()
    assert isinstance(number.exponent, int)
    half = 10.0**number.exponent / 2
    return abs(found - float(printed)) <= half * (1 + 1e-6)


def exactly(found: complex, exact: complex, largest: float = 0.0) -> bool:
    """Whether a value is the exact one to 1e-10, of itself or of the largest of its kind."""
    return abs(found - exact) <= WITNESSED * max(abs(exact), largest)


# --- forces --------------------------------------------------------------------------------------

LB = 4.4482216152605
"""Newtons in a pound of force."""
TENTHS = 0.003
"""Share of itself by which a number of three figures rounds."""


class Held:
    """The forces of an example; construction, equations, power and fifty digits agree."""

    def __init__(self, text: str, **settings: object) -> None:
        example = mechanism(text, **settings)
        assert far_from_exact(example) < WITNESSED
        found = example.forces()
        assert found is not None
        self.solution, self.found = example.solve(), found[0]

    def on(self, name: str, link: object) -> complex:
        """The force on a link in a pin, guide or contact: on("A", 2), on("3-0", 3)."""
        pairs = self.found.reactions
        return next(e.force for e in pairs if (e.name, e.link) == (name, str(link)))

    def place(self, name: str) -> complex:
        """A point through which the force of a guide or contact passes."""
        found = next(e.at for e in self.found.reactions if e.name == name)
        assert found is not None
        return found

    def moment(self, driver: object = 1) -> float:
        """The balancing moment of a driver."""
        found = next(e.moment for e in self.found.balance if e.link == str(driver))
        assert found is not None
        return found

    def force(self, driver: object = 1) -> complex:
        """The balancing force of a driver."""
        found = next(e.force for e in self.found.balance if e.link == str(driver))
        assert found is not None
        return found
