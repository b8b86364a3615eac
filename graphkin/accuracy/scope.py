"""What is asked decides what it costs: positions alone, with velocities, accelerations, centres."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import Struct

from graphkin.accuracy.compared_answers import Reference
from graphkin.accuracy.effort import Effort
from graphkin.accuracy.methods import batch_work, can_be_emitted, variants_of
from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import BY_TARGET, KINDS
from graphkin.construction.core.timing import Stopwatch, Timing, Work, one_position
from graphkin.construction.tape.batch_runner import Way
from graphkin.mechanism import Mechanism

SCOPES = dict(zip(KINDS, ("position", "+ velocity", "+ acceleration"), strict=True))
"""What each derivative adds to those before it."""
CENTRES = "+ centres, poles"
"""What is added last: the places in links."""
ASKED = "asked only"


class Scope(Struct, frozen=True):
    """What is wanted, how many steps that needs, and the time of a position in both ways."""

    name: str
    steps: int
    single: Timing
    batch: Timing


def scopes(
    mechanism: Mechanism, reference: Reference, effort: Effort, watch: Stopwatch
) -> tuple[Scope, ...]:
    """The cost of each scope, one position after the other and in a batch; of what is asked last.

    A scope that adds nothing, in a mechanism without centres, is left out.
    """
    program = reference.places.course.program
    wanted: list[Target] = []
    known: dict[str, tuple[Target, ...]] = {}
    for name in (*SCOPES.values(), CENTRES):
        new = [target for target in program.answers if scope_of(target) == name]
        wanted += new
        if new:
            known[name] = tuple(wanted)
    known[ASKED] = tuple(target for target in mechanism.asked() if target in program.targets)
    works = [work for some in known.values() for work in ways(some, reference, effort)]
    times = watch.times(works)
    pairs = zip(times[::2], times[1::2], strict=True)
    return tuple(
        Scope(name, len(program.needed(some)), *pair)
        for (name, some), pair in zip(known.items(), pairs, strict=True)
    )


def scope_of(target: Target) -> str | None:
    """The scope that adds a target; None for what is no quantity of a motion."""
    quantity = BY_TARGET.get(target[0])
    if quantity is None:
        return None
    in_link = quantity.whose == "links" and quantity.sort == "place"
    return CENTRES if in_link else SCOPES[quantity.kind]


def ways(
    targets: Sequence[Target], reference: Reference, effort: Effort
) -> Iterator[tuple[Work, int]]:
    """What runs some targets one position after the other, and what runs them in a batch."""
    places = reference.places
    program = places.course.program
    needed = program.needed(targets)

    singly = [one_position(program, needed, values) for values in reference.exact_values]
    yield lambda: [work() for work in singly], len(places.at)
    count = variants_of(reference, effort)
    way: Way = "numpy" if can_be_emitted(reference) else "steps"
    yield batch_work(program, targets, places.repeated(count), "float64", way), count
