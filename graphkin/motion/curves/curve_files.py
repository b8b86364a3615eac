"""The figure files of a cycle."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial

from graphkin.drawing.marks import Page
from graphkin.motion.curves import over_driver, plane_paths
from graphkin.motion.curves.over_driver import Sampled, sampled
from graphkin.motion.cycle import Cycle
from graphkin.motion.single_loop import loop_of


def picture_files(cycle: Cycle, stem: str, formats: Sequence[str]) -> dict[str, bytes]:
    """Every figure of a cycle by its file name, in each of the formats svg and png."""
    from graphkin.writers.svg import write_svg

    files: dict[str, bytes] = {}
    for name, drawn in figures(sampled(cycle)):
        page = drawn()
        if "svg" in formats:
            files[f"{stem}-{name}.svg"] = write_svg(page).encode("utf-8")
        if "png" in formats:
            from graphkin.writers.axes import write_png

            files[f"{stem}-{name}.png"] = write_png(page)
    return files


def figures(found: Sampled) -> Iterator[tuple[str, Callable[[], Page]]]:
    """Every figure with its name, drawn when called."""
    yield from over_driver.pictures(found).items()
    if plane_paths.path_points(found):
        yield "paths", partial(plane_paths.paths, found)
    for link in plane_paths.centrode_links(found):
        yield f"centrodes-{link}", partial(plane_paths.both_centrodes, found, link)
    loop = loop_of(found.cycle)
    if loop is not None:
        yield "reach", partial(plane_paths.reach, found, loop)
