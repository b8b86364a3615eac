"""Decomposition into driven links and Assur groups, in an order in which each can be constructed.

Assur: a mechanism is its frame and drivers, to which groups of links without freedom of their own
are joined one after the other. The smallest, two links and three pairs, is the dyad.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Cam, Driver, Scene
from graphkin.structure.groups import Group, Unresolved
from graphkin.structure.joints import Joints
from graphkin.structure.link_axes import body, guide_line, metres
from graphkin.structure.next_group import (
    left_by,
    next_driven,
    next_group,
    next_on_two_pins,
    next_stretched,
    next_tie,
    settle,
)
from graphkin.structure.wheel_groups import next_coupled, tracks_held, wedged_wheels
from graphkin.text.errors import Problem, StructureError

ALONG = 1e-9
"""Sine of the angle below which a follower's guide lies along the path of a plate."""


def decompose(scene: Scene) -> tuple[Group, ...]:
    """The groups in order of construction. StructureError: a follower that misses its cam."""
    refuse_far_guides(scene)
    joints = Joints(scene)
    known = {FRAME}
    waiting = list(scene.drivers)
    groups: list[Group] = []
    while len(known) <= len(scene.links):
        group = (
            next_driven(joints, known, waiting)
            or next_group(joints, known)
            or next_stretched(joints, known, waiting)
            or next_tie(joints, known)
            or next_on_two_pins(joints, known, waiting)
            or next_tried(joints, known, waiting)
            or unresolved(joints, known, waiting)
        )
        groups.append(group)
        settle(group, known, waiting)
        joints = left_by(group, joints)
    return tuple(groups)


def next_tried(joints: Joints, known: Collection[str], waiting: list[Driver]) -> Group | None:
    """The next group of higher class; what finds these is loaded where the others end.

    First without the bars that parallel ones make idle: they would seem to close a group.
    """
    from graphkin.structure.parallel_bars import idle_bars

    if idle := {*idle_bars(joints.scene)} - {*known}:
        found = tried(joints.leaving(idle), known, waiting)
        if found is not None:
            return found
    return tried(joints, known, waiting)


def tried(joints: Joints, known: Collection[str], waiting: list[Driver]) -> Group | None:
    """The next group that closes after some of its links have been tried."""
    from graphkin.structure.higher_groups import next_higher

    return (
        next_coupled(joints, known)
        or next_higher(joints, known, waiting)
        or next_coupled(joints, known, idle=True)
        or next_higher(joints, known, waiting, by_wheels=True)
    )


def unresolved(joints: Joints, known: Collection[str], waiting: Sequence[Driver]) -> Unresolved:
    """What is left, and what there is in it that no construction takes."""
    from graphkin.structure.touching_wheels import asked_of

    links = tuple(joints.unknown(known))
    driven = tuple(each for each in waiting if {each.link, each.against} & {*links})
    held, wedged = tracks_held(joints, links), wedged_wheels(joints, known, links)
    return Unresolved(links, driven, held, wedged, asked_of(joints.scene, held))


def refuse_far_guides(scene: Scene) -> None:
    """Raise StructureError for each follower that cannot rest on the cam's prime circle."""
    problems = []
    for follower, cam in scene.cams.items():
        refuse = far_from_plate if cam.slides else far_lever if cam.lever else far_guide
        problem = refuse(scene, follower, cam)
        if problem is not None:
            problems.append(problem)
    if problems:
        raise StructureError(problems)


def far_from_plate(scene: Scene, follower: str, cam: Cam) -> Problem | None:
    """The error for a follower that a plate cannot lift: along its path, or out of a lever's
    reach."""
    slide = scene.link(cam.on).slides[0]
    plate = guide_line(scene, slide)
    if cam.lever is None:
        guide = guide_line(scene, scene.link(follower).slides[0])
        if abs(cross(plate.along, guide.along)) > ALONG:
            return None
        found = f"link {follower} slides along the path of link {cam.on}"
        return Problem(f"links.{follower}.slides.angle", found, "a guide that crosses this path")
    fixed, own = body(scene, cam.carrier), body(scene, follower)
    above = abs(
        cross(plate.along, fixed[cam.lever.pin] - plate.point) - metres(scene, slide.offset)
    )
    arm = abs(own[cam.point] - own[cam.lever.pin])
    prime = metres(scene, cam.base) + metres(scene, cam.roller)
    if above > ALONG * arm and abs(above - prime) < arm:
        return None
    bar = f"{cam.lever.pin}-{cam.point}"
    found = (
        f"{cam.lever.pin} stands {1e3 * above:.6g} mm from the path of {cam.pivot}, "
        f"{bar} is {1e3 * arm:.6g} mm long"
    )
    expected = f"a pin beside this path, from which {bar} reaches {1e3 * prime:.6g} mm above it"
    return Problem(f"links.{follower}.cam.base", found, expected)


def far_guide(scene: Scene, follower: str, cam: Cam) -> Problem | None:
    """The error for a guide that passes beside the prime circle."""
    slide = scene.link(follower).slides[0]
    line, pivot = guide_line(scene, slide), body(scene, slide.on)[cam.pivot]
    aside = abs(cross(line.along, line.point - pivot) + metres(scene, slide.offset))
    prime = metres(scene, cam.base) + metres(scene, cam.roller)
    if cam.is_flat or aside < prime:
        return None
    found = f"the follower passes {1e3 * aside:.6g} mm beside {cam.pivot}"
    expected = f"less than base and roller together, {1e3 * prime:.6g} mm"
    return Problem(f"links.{follower}.cam.base", found, expected)


def far_lever(scene: Scene, follower: str, cam: Cam) -> Problem | None:
    """The error for a lever that does not reach the prime circle, or whose face cannot touch it."""
    lever, fixed, own = cam.lever, body(scene, cam.carrier), body(scene, follower)
    assert lever is not None
    apart = abs(fixed[lever.pin] - fixed[cam.pivot])
    prime = metres(scene, cam.base) + metres(scene, cam.roller)
    pins = f"{cam.pivot} and {lever.pin} stand {1e3 * apart:.6g} mm apart"
    place = f"links.{follower}.cam.base"
    if cam.is_flat:
        gap = prime + metres(scene, lever.face)
        if abs(gap) < apart:
            return None
        expected = f"more than base and face together, {1e3 * gap:.6g} mm"
        return Problem(place, pins, expected)
    arm = abs(own[cam.point] - own[lever.pin])
    if abs(apart - arm) < prime < apart + arm:
        return None
    bar = f"{lever.pin}-{cam.point}"
    found = f"{pins}, {bar} is {1e3 * arm:.6g} mm long"
    expected = f"a triangle of these and base and roller together, {1e3 * prime:.6g} mm"
    return Problem(place, found, expected)
