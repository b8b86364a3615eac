"""The figure files of a cycle."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

from graphkin.motion.curves import over_driver, plane_paths
from graphkin.motion.curves.over_driver import Sampled, sampled
from graphkin.motion.cycle import Cycle
from graphkin.motion.single_loop import loop_of
from graphkin.writers import plot_style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("svg", "png")


def picture_files(cycle: Cycle, stem: str, formats: Sequence[str]) -> dict[str, bytes]:
    """Every figure of a cycle by its file name, in each of the formats svg and png."""
    drawn = ((f"{stem}-{name}", figure) for name, figure in figures(sampled(cycle)))
    return plot_style.picture_files(drawn, formats)


def figures(found: Sampled) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Every figure with its name, drawn when called."""
    yield from over_driver.pictures(found).items()
    if plane_paths.path_points(found):
        yield "paths", partial(plane_paths.paths, found)
    for link in plane_paths.centrode_links(found):
        yield f"centrodes-{link}", partial(plane_paths.both_centrodes, found, link)
    loop = loop_of(found.cycle)
    if loop is not None:
        yield "reach", partial(plane_paths.reach, found, loop)
