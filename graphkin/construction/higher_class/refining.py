"""A closure of a group of class III or higher in numbers of another kind than doubles.

Doubles tell which closure is meant. From there the secant through two trials leads to the value in
the kind asked for; in balls a change of sign proves it: what is cut cannot but fit in between.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import StepFailed, run
from graphkin.numbers.arithmetic import Kind, is_ball, phase, turn_by

LEAST = 4 * 1024
"""The power of a half that the interval of a proof has at least for its width."""
ROUNDS = 40
"""Most steps along the secant."""
APART = 2.0**-30
"""How far the second trial lies from the closure in doubles, in radians or parts of its size."""
SECANTS = 2
"""Steps along the secant that lead from a double to a longdouble."""
CONFUSED = 0.01
"""How near another closure is that one may be taken for, in radians or parts of its size."""
WIDENED = 100
"""How many times the interval of a proof is widened before it is given up."""
WIDER = 1.25
"""How much wider each time."""


class TrialChain:
    """The trial chain of a group on one scene: its misfit at a trial value, in a kind."""

    def __init__(self, trying: Any, known: Sequence[Any], signs: Sequence[float], kind: Kind):
        wanted = [n for n in (trying.misfit, trying.facing) if n is not None]
        self.trying, self.kind, self.signs = trying, kind, signs
        self.known = dict(zip(trying.inputs, known, strict=True))
        targets = {("step", str(n)): n for n in wanted}
        self.program = Program(trying.program.steps, targets)
        self.needed = self.program.needed(targets)

    def misfit(self, tried: Any, known: dict[int, Any] | None = None) -> Any:
        """By how much the last link misses; ValueError where the chain cannot be drawn."""
        trying = self.trying
        overrides = dict(self.known if known is None else known)
        overrides[trying.tried] = turn_by(tried) if trying.turns else tried
        overrides |= dict(zip(trying.signs, self.signs, strict=True))
        try:
            trace = run(self.program, self.needed, trying.values, self.kind, overrides=overrides)
        except StepFailed as failed:
            raise ValueError("the chain of the trial cannot be drawn") from failed
        if trying.facing is not None and not trace.values[trying.facing] > 0:
            raise ValueError("the last link does not surely face the right way")
        return trace.values[trying.misfit]


def closed_in(trying: Any, known: Sequence[Any], number: int, kind: Kind) -> tuple[Any, ...]:
    """Trial value, signs and the sine of crossing in one closure, in the kind of what is known.

    Raises ClosingError where doubles find no such closure, ValueError where a ball does not tell
    that the group closes.
    """
    doubles = [in_doubles(value) for value in known]
    found, *signs, sine = trying.closed(doubles, number)
    tried = phase(found) if trying.turns else found
    chain = TrialChain(trying, known, signs, kind)
    value = refined(chain, kind.number(tried))
    if kind.name == "ball":
        refuse_confused(chain, value, tried, trying.beside(doubles, number))
    rest = (kind.number(each) for each in (*signs, sine))
    return (turn_by(value) if trying.turns else value, *rest)


def refuse_confused(chain: TrialChain, value: Any, tried: float, others: Sequence[float]) -> None:
    """Closures with the signs of one are surely others, and on the side where doubles find them.

    Only those that lie so near that a secant might lead from one to the other are looked at.
    """
    for other in others:
        if abs(other - tried) < CONFUSED * (1 if chain.trying.turns else abs(tried) or 1):
            away = refined(chain, chain.kind.number(other)) - value
            if not (away > 0 if other > tried else away < 0):
                raise ValueError("the balls do not tell two closures apart")


def in_doubles(value: Any) -> Any:
    """The double, or the array of doubles, next to a number of any kind."""
    if hasattr(value, "shape") and value.shape:
        import numpy as np

        return value.astype(np.complex128 if value.dtype.kind == "c" else np.float64)
    if isinstance(value, complex | float | int):
        return value
    parts = float(value.real), float(value.imag)
    return complex(*parts) if is_complex(value) else parts[0]


def is_complex(value: Any) -> bool:
    """Whether a number of another kind than Python's is one of the plane."""
    return type(value).__name__.startswith(("mpc", "acb", "complex", "clongdouble"))


def refined(chain: TrialChain, start: Any) -> Any:
    """The trial value of a closure in the kind of a chain, from its double."""
    turns = chain.trying.turns
    if hasattr(start, "shape") and start.shape:
        return start if chain.kind.name == "float32" else by_secants(chain.misfit, start, turns)
    if chain.kind.name != "ball":
        return by_secant(chain.misfit, start, turns)
    middles = {number: middle(value) for number, value in chain.known.items()}
    near = by_secant(lambda tried: middle(chain.misfit(tried, middles)), start, turns)
    return proved(chain, near, turns)


def by_secants(misfit: Any, start: Any, turns: bool) -> Any:
    """As by_secant for an array; each step gains all the digits that the first double had."""
    import numpy as np

    old, new = start + APART * (1 if turns else np.maximum(abs(start), APART)), start
    before, after = misfit(old), misfit(new)
    for _ in range(SECANTS):
        flat = after == before
        trial = np.where(flat, new, new - after * (new - old) / np.where(flat, 1, after - before))
        old, new, before, after = new, trial, after, misfit(trial)
    return new


def by_secant(misfit: Any, start: Any, turns: bool) -> Any:
    """Where a misfit vanishes, near a start: until it no longer comes nearer to nought."""
    step = APART if turns else APART * (abs(start) or 1)
    old, new = start, start + step
    before, after = misfit(old), misfit(new)
    if abs(before) < abs(after):
        old, new, before, after = new, old, after, before
    for _ in range(ROUNDS):
        if after in (0, before):
            return new
        trial = middle(new - after * (new - old) / (after - before))
        value = misfit(trial)
        if not abs(value) < abs(after):
            return new
        old, new, before, after = new, trial, after, value
    return new


def proved(chain: TrialChain, near: Any, turns: bool) -> Any:
    """The ball about a value at whose ends the misfit surely has two signs, and none is missing.

    Between them the misfit is a continuous function, for it is finite on the whole ball.
    """
    from flint import arb

    step = APART if turns else APART * (abs(near) or 1)
    slope = (chain.misfit(near + step) - chain.misfit(near - step)) / (2 * step)
    width = abs(chain.misfit(near)).upper() / abs(slope).lower()
    if not width.is_finite():
        raise ValueError("the ball does not tell how the locus crosses")
    for _ in range(WIDENED):
        ball = arb(near, width.upper())
        ends = chain.misfit(near - width), chain.misfit(near + width)
        if (ends[0] < 0 and ends[1] > 0) or (ends[0] > 0 and ends[1] < 0):
            if bool(chain.misfit(ball).is_finite()):
                return ball
            break
        width = WIDER * width + arb(2) ** -LEAST
    raise ValueError("the ball does not tell whether the group closes")


def middle(value: Any) -> Any:
    """The middle of a ball; any other number as it is."""
    return value.mid() if is_ball(value) else value
