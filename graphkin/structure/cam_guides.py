"""Whether the guide of a cam's follower passes near enough to the cam."""

from __future__ import annotations

from graphkin.numbers.plane import cross
from graphkin.scene.model import Scene
from graphkin.structure.link_axes import body, guide_line, metres
from graphkin.text.errors import Problem, StructureError


def refuse_far_guides(scene: Scene) -> None:
    """Raise StructureError for each follower whose path misses the cam's prime circle."""
    problems = []
    for follower, cam in scene.cams.items():
        slide = scene.link(follower).slides[0]
        line, pivot = guide_line(scene, slide), body(scene, slide.on)[cam.pivot]
        aside = abs(cross(line.along, line.point - pivot) + metres(scene, slide.offset))
        prime = metres(scene, cam.base) + metres(scene, cam.roller)
        if not cam.is_flat and aside >= prime:
            found = f"the follower passes {1e3 * aside:.6g} mm beside {cam.pivot}"
            expected = f"less than base and roller together, {1e3 * prime:.6g} mm"
            problems.append(Problem(f"links.{follower}.cam.base", found, expected))
    if problems:
        raise StructureError(problems)
