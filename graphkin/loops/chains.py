"""All chains of a mechanism as arrays, with their exact first and second derivatives.

Unknowns: the angle θ_k of every turning but the frame's (radians), then the coordinate s_j of every
slide (metres). All arrays carry the N settings of a batch first.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.loops.rigid_bodies import Complexes, Numbers, Reals
from graphkin.loops.vector_chains import Chain, Tree


class Linear(Struct, frozen=True, eq=False):
    """The vectors of all chains in one position, split by the unknown that moves them.

    ``turned`` (N, R, K) is the part of each chain that turns with θ_k, ``along`` (N, R, m) its
    derivative by s_j, ``place`` (N, R) its end, ``unknowns`` (N, K + m) those of the position.
    """

    place: Complexes
    turned: Complexes
    along: Complexes
    unknowns: Reals


class Chains(Struct, frozen=True, eq=False):
    """Many chains as arrays: ``fixed`` (N, R, K + 1) by turning, ``slid`` (R, m) by slide.

    ``guide`` (N, m) holds the slide directions in their turning ``carrier`` (m,).
    """

    fixed: Complexes
    slid: Reals
    guide: Complexes
    carrier: np.ndarray[Any, np.dtype[np.intp]]

    def at(self, unknowns: Reals) -> Linear:
        """Evaluate every chain at unknowns of shape (N, K + m)."""
        angles, slides = self.split(unknowns)
        turn = np.exp(1j * angles)
        along = self.slid * (self.guide * turn[:, self.carrier])[:, None, :]
        turned = self.fixed * turn[:, None, :]
        for j, k in enumerate(self.carrier):
            turned[:, :, k] += along[:, :, j] * slides[:, None, j]
        return Linear(turned.sum(axis=-1), turned[:, :, 1:], along, unknowns)

    def split(self, unknowns: Reals) -> tuple[Reals, Reals]:
        """Angles of all turnings, the frame's zero first, and slide coordinates."""
        moving = self.fixed.shape[-1] - 1
        frame = np.zeros((*unknowns.shape[:-1], 1))
        return np.concatenate([frame, unknowns[..., :moving]], axis=-1), unknowns[..., moving:]

    def second(self, linear: Linear, u: Reals, v: Reals) -> Complexes:
        """Second derivative of every chain in two directions of the unknowns: shape (N, R).

        Vectors that turn give -θ̇_u θ̇_v times themselves; a slide on a turning guide gives
        i(ṡ_u θ̇_v + ṡ_v θ̇_u) along itself, which for u = v comes of sliding on what turns.
        """
        (turn_u, slide_u), (turn_v, slide_v) = self.split(u), self.split(v)
        centripetal = linear.turned @ (turn_u * turn_v)[:, 1:, None]
        mixed = slide_u * turn_v[:, self.carrier] + slide_v * turn_u[:, self.carrier]
        return (1j * (linear.along @ mixed[:, :, None]) - centripetal)[:, :, 0]


def packed(rows: Sequence[Chain], tree: Tree, numbers: Numbers) -> Chains:
    """Chains as arrays."""
    turned, guides = tree.turned, tree.guides
    fixed = np.zeros((numbers.count, len(rows), turned.count), dtype=np.complex128)
    slid = np.zeros((len(rows), len(guides)))
    guide = np.zeros((numbers.count, len(guides)), dtype=np.complex128)
    for r, row in enumerate(rows):
        for k, vector in row.fixed.items():
            fixed[:, r, k] = vector
        for j, count in row.slid.items():
            slid[r, j] = count
    for j, line in enumerate(guides):
        guide[:, j] = turned.lean[line.on] * line.along
    carrier = np.array([turned.of[line.on] for line in guides], dtype=np.intp)
    return Chains(fixed, slid, guide, carrier)
