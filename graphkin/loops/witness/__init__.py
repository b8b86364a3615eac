"""The witness: a solution held against vector loops that share nothing with its construction.

Disagreement is the absolute difference over the largest magnitude of that quantity in the scene.
A scale never falls below a thousandth of what the other quantities make of it (v ≈ ω·L and so on),
nor, beside singular positions, below the share that rounding has in the limit, so that the rounding
of a quantity that is nought everywhere is not taken for a difference.
"""

from graphkin.loops.witness.differences import sure_of
from graphkin.loops.witness.examine import Check, compare, examine

__all__ = ["Check", "compare", "examine", "sure_of"]
