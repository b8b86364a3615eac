"""The whole comparison of one scene: rows of methods, the way to a dead point, cost by scope."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain
from time import perf_counter

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.agreement import Agreement, agreement
from graphkin.accuracy.compared_answers import Reference, answers_of, reference_of
from graphkin.accuracy.compared_positions import approach, ground_of, places_around
from graphkin.accuracy.effort import Effort
from graphkin.accuracy.flattening import Flattening, flattened
from graphkin.accuracy.methods import Method, MethodRow, own_methods
from graphkin.accuracy.other_routes import other_methods
from graphkin.accuracy.pencil_rows import pencil_rows, pencilled
from graphkin.accuracy.scope import Scope, scopes
from graphkin.construction.core.timing import Clock, Stopwatch
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.course import Reals
from graphkin.text.errors import GraphkinError

Say = Callable[[str], None]


class Study(Struct, frozen=True, eq=False):
    """What was found of a scene.

    ``flattening`` is None where the driver cannot move, or nothing on the way can be certified;
    ``pencil`` are measures (G,) and errors (G, 3) of a pencil on that way.
    """

    mechanism: Mechanism
    reference: Reference
    agreement: Agreement
    rows: tuple[MethodRow, ...]
    flattening: Flattening | None
    pencil: tuple[Reals, Reals]
    scopes: tuple[Scope, ...]

    def row(self, method: str) -> MethodRow:
        """The row of a method."""
        return next(row for row in self.rows if row.method == method)


def study(
    mechanism: Mechanism,
    scales: Scales | None,
    effort: Effort | None = None,
    *,
    say: Say = lambda words: None,
    clock: Clock = perf_counter,
) -> Study:
    """Compare every method on one scene; ``say`` is told what is being measured.

    ``scales`` are those of the scene's sheets, for the pencil; without them it is left out. Raises
    ClosureError where the scene closes nowhere, WitnessError where nothing can be certified.
    """
    effort = effort or Effort()
    watch = effort.watch(clock, say)
    say("positions and certified reference")
    ground = ground_of(mechanism.scene)
    answers = answers_of(ground.sweep.scene, ground.piece.course.program)
    reference = reference_of(places_around(ground, effort.places), answers)
    methods = []
    for method in chain(own_methods(reference, effort), other_methods(reference, effort)):
        say(method.row.method)
        methods.append(method)
    rows = timed(methods, watch)
    if scales is not None:
        say("the pencil")
        rows += pencil_rows(mechanism, reference, scales)
    say("the way to a dead point")
    flattening, pencil = None, (np.array([]), np.zeros((0, 3)))
    try:
        flattening = flattened(approach(ground, effort.groups, effort.each), answers)
    except GraphkinError:
        say("no way to a dead point")
    if flattening is not None and scales is not None:
        pencil = pencilled(ground, answers, scales, flattening, effort.drawn)
    say("cost by scope")
    costs = scopes(mechanism, reference, effort, watch)
    return Study(mechanism, reference, agreement(reference), tuple(rows), flattening, pencil, costs)


def timed(methods: Sequence[Method], watch: Stopwatch) -> list[MethodRow]:
    """The rows of methods with their times."""
    works = [(method.work, method.positions) for method in methods if method.work is not None]
    times = iter(watch.times(works))
    return [
        method.row if method.work is None else replace(method.row, time=next(times))
        for method in methods
    ]
