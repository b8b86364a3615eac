"""The times that a user waits, measured on one clock, and the accuracy of drawing and numbers.

``accuracy`` and ``explain`` end with this report.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import isfinite, isinf
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.accuracy.pencil import Pencil, forecast, original
from graphkin.construction.core.timing import Stopwatch, Timing
from graphkin.loops.witness import Check
from graphkin.text.errors import GraphkinError
from graphkin.text.tables import table

if TYPE_CHECKING:
    from graphkin.mechanism import Mechanism

WAITED_FOR = {
    "load": "the scene read, its construction planned",
    "solve": "what is asked: every step that it needs, with nothing kept",
    "check": "what is asked held against the vector loops, these written and closed anew",
    "page": "all sheets laid out and written as SVG",
}
"""What each time measures."""
USUAL = Stopwatch(rounds=9, patience=0.5, fewest=2)
"""How often each task is run; a page takes long."""


class Waits(Struct, frozen=True):
    """The times that a user waits, those that could be measured.

    ``drawing`` is the largest relative error of an answer read off the sheets, in 95 of 100
    drawings with marks within ``point`` mm. ``digits`` is the number of digits that are sure in
    doubles, for every number that is asked. Both are None if unknown; ``undrawn`` says why there is
    no page.
    """

    times: dict[str, Timing]
    drawing: float | None
    point: float
    digits: int | None
    undrawn: str = ""


def waits_of(new: Callable[[], Mechanism], watch: Stopwatch = USUAL) -> Waits:
    """Measure the times that a user waits for a mechanism; ``new`` reads its scene.

    Raises ClosureError if the mechanism does not close.
    """
    mechanism = new()
    solution = mechanism.solve(asked=True)
    verdict = None
    works: dict[str, Callable[[], object]] = {
        "load": lambda: new().program,
        "solve": lambda: solved_anew(mechanism),
    }
    drawing, undrawn, pencil = None, "", Pencil()
    try:
        verdict = mechanism.witness(solution)
        works["check"] = lambda: Check(mechanism.scene).compare(solution)
        from graphkin.documents.scaling import scales

        works["page"] = lambda: page_of(mechanism)
        page_of(mechanism)
        drawing = unsure_by_hand(mechanism, scales(mechanism), pencil)
    except GraphkinError as error:
        works.pop("page", None)
        undrawn = str(error.problems[0])
    times = watch.times([(work, 1) for work in works.values()])
    digits = min(verdict.digits.values(), default=None) if verdict else None
    return Waits(dict(zip(works, times, strict=True)), drawing, pencil.point, digits, undrawn)


def solved_anew(mechanism: Mechanism) -> object:
    """Solve the requested quantities, without anything kept from earlier drawings."""
    mechanism.drawings.clear()
    return mechanism.solve(asked=True)


def page_of(mechanism: Mechanism) -> list[str]:
    """The sheets with their solution, as SVG."""
    from graphkin.documents.scaling import sheet_motion
    from graphkin.documents.sheet_documents import drawings_of, drawn_sheets, language_of, proved
    from graphkin.writers.svg import write_svg

    verdict = proved(mechanism, sheet_motion(mechanism))
    drawings = drawings_of(mechanism, verdict, language_of(mechanism, None))
    return [write_svg(page) for one in drawn_sheets(drawings, "key") for page in one.pages]


def unsure_by_hand(mechanism: Mechanism, scales: Any, pencil: Pencil) -> float | None:
    """The largest relative error of an answer read off a drawing; None if none is read off.

    The error is infinite if a drawing may not close. Answers that are zero have no such error.
    """
    found = forecast(original(mechanism, scales), pencil).expected
    if any(isinf(each.error) for each in found):
        return float("inf")
    relative = [each.relative for each in found]
    return max((r for r in relative if r is not None and isfinite(r)), default=None)


def waits_lines(found: Waits) -> Iterator[str]:
    """The times as a table, then the accuracy of a lab sheet in one sentence."""
    rows = [
        (name, milli(time.median), f"{milli(time.low)} – {milli(time.high)}", WAITED_FOR[name])
        for name, time in found.times.items()
    ]
    yield from table(("you wait for", "ms", "quartiles", ""), rows)
    most = max(time.rounds for time in found.times.values())
    yield f"medians of up to {most} rounds on one clock, in a program that is running"
    if found.undrawn:
        yield f"no page is drawn: {found.undrawn}"
    yield ""
    yield sheet_words(found)


def sheet_words(found: Waits) -> str:
    """The accuracy of a lab sheet: the error of a drawing, and the number of sure digits."""
    by_hand = f"a drawing with marks within {found.point:g} mm"
    if found.drawing is None:
        drawn = "nothing that is asked is read off a drawing"
    elif isinf(found.drawing):
        drawn = f"{by_hand} may not close"
    else:
        drawn = f"{by_hand} is sure to {100 * found.drawing:.2g} %"
    digits = "no verdict on float64" if found.digits is None else f"{found.digits} digits"
    leaves = digits if found.digits is None else f"float64 leaves {digits}"
    return f"for a lab sheet: {drawn}; {leaves}"


def milli(seconds: float) -> str:
    """A time in milliseconds with three digits."""
    value = seconds * 1e3
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


def waits_record(found: Waits) -> dict[str, Any]:
    """The times as plain data, in seconds, and the accuracy of a sheet."""
    return {
        "waits": {name: time_record(time) for name, time in found.times.items()},
        "sheet": {
            "drawing": shortened(found.drawing),
            "marks_within_mm": found.point,
            "digits": found.digits,
        },
    }


def shortened(share: float | None) -> float | None:
    """A share with three digits; None if there is none, or no drawing closes."""
    return None if share is None or isinf(share) else float(f"{share:.3g}")


def time_record(time: Timing | None) -> dict[str, float] | None:
    """A time in seconds; None if nothing was run."""
    if time is None:
        return None
    return {"median": time.median, "low": time.low, "high": time.high, "rounds": time.rounds}
