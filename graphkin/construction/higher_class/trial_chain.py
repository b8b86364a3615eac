"""The trial chain of a group of class III or higher on one scene, in any kind of number.

The secant through two trials leads to where it fits; in balls a change of sign proves that.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from graphkin.construction.core.run import StepFailed, run
from graphkin.numbers.arithmetic import Kind, is_ball, turn_by

LEAST = 4 * 1024
"""The power of a half that the interval of a proof has at least for its width."""
ROUNDS = 40
"""Most steps along the secant."""
WIDENED = 100
"""How many times the interval of a proof is widened before it is given up."""
WIDER = 1.25
"""How much wider each time."""


class TrialChain:
    """The trial chain of a group on one scene: its misfit at a trial value, in a kind."""

    def __init__(self, trying: Any, known: Sequence[Any], signs: Sequence[float], kind: Kind):
        self.trying, self.kind, self.signs = trying, kind, signs
        self.known = dict(zip(trying.inputs, known, strict=True))
        self.needed: dict[tuple[int, ...], tuple[int, ...]] = {}

    def misfit(self, tried: Any, known: dict[int, Any] | None = None) -> Any:
        """By how much the last link misses; ValueError where the chain cannot be drawn."""
        facing, misfit = self.trying.first.facing, self.trying.first.misfit
        wanted = (misfit,) if facing is None else (misfit, facing)
        found = self.drawn(tried, wanted, known)
        if facing is not None and not found[1] > 0:
            raise ValueError("the last link does not surely face the right way")
        return found[0]

    def middle_misfit(self, tried: Any) -> Any:
        """The middle of the misfit, in balls, of the middles of what is known."""
        middles = {number: middle(value) for number, value in self.known.items()}
        return middle(self.misfit(tried, middles))

    def axes(self, tried: Any) -> list[Any]:
        """The axes of the links in the order in which closures are numbered."""
        return self.drawn(tried, self.trying.axes)

    def locus(self, tried: Any) -> Any:
        """The point that moves as the link is tried."""
        return self.drawn(tried, (self.trying.first.locus,))[0]

    def reach(self, k: int, tried: Any) -> Any:
        """How far the dyad of a sign can be drawn, positive where it can: its middle, in balls."""
        _, reaches, args = self.trying.choices[k]
        return middle(reaches(*self.drawn(tried, args)))

    def drawn(
        self, tried: Any, wanted: tuple[int, ...], known: Mapping[int, Any] | None = None
    ) -> list[Any]:
        """The values of some steps at a trial value; ValueError where they cannot be drawn."""
        trying = self.trying
        overrides = dict(self.known if known is None else known)
        every = tried if trying.several else (tried,)
        for one, each in zip(trying.unknowns, every, strict=True):
            overrides[one.tried] = turn_by(each) if one.turns else each
        overrides |= dict(zip(trying.signs, self.signs, strict=True))
        if wanted not in self.needed:
            self.needed[wanted] = trying.program.behind(wanted)
        needed = self.needed[wanted]
        try:
            trace = run(trying.program, needed, trying.values, self.kind, overrides=overrides)
        except StepFailed as failed:
            raise ValueError("the chain of the trial cannot be drawn") from failed
        return [trace.values[n] for n in wanted]


def by_secant(misfit: Any, start: Any, step: Any) -> Any:
    """Where a misfit vanishes, near a start: until it no longer comes nearer to nought.

    The second trial lies a ``step`` away.
    """
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


def proved(chain: TrialChain, near: Any, step: Any) -> Any:
    """The ball about a value at whose ends the misfit surely has two signs, and none is missing.

    Between them the misfit is a continuous function, for it is finite on the whole ball.
    """
    from flint import arb

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
