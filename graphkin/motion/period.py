"""After how many turns of the driver a mechanism with wheels stands as before."""

from __future__ import annotations

from graphkin.motion.driving import TURN
from graphkin.motion.pieces import BACK, Path, Range, marched, misses, turns_back


def strangers(path: Path) -> tuple[str, ...]:
    """The links that stand otherwise after a whole turn of the driver, in the order written."""
    pieces = path.ranges[0]
    first, start = pieces[0].course, pieces[0].low.at
    missed = misses(pieces, start, start + TURN)
    return tuple(link for link in first.scene.links if missed.get(("axis", link), 0.0) > BACK)


def turns_to_return(path: Path) -> int | None:
    """How many whole turns of the driver bring every link back; None where no few do."""
    if path.returns:
        return 1
    longer = until_return(path)
    return round((longer[-1].high.at - longer[0].low.at) / TURN) if longer else None


def until_return(path: Path) -> Range | None:
    """The motion from the start of a path on until every link is back; None where no few turns do.

    The wheels' angles after one turn say how many it may be; the motion is followed so far.
    """
    pieces = path.ranges[0]
    first, start = pieces[0].course, pieces[0].low.at
    count = turns_back(pieces, start)
    if count is None or count == 1:
        return None
    way = marched(first, start, start + count * TURN)
    if way[-1].high.kind != "window":
        return None
    missed = misses(way, start, start + count * TURN)
    return way if max(missed.values()) <= BACK else None
