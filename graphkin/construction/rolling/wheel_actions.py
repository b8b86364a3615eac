"""Wheels that roll without slip: how far they have turned, and how far along their tracks."""

from __future__ import annotations

from graphkin.construction.core.vocabulary import action
from graphkin.numbers.arithmetic import Point, Real, phase, turn_by


@action("rolled-on-track")
def rolled_on_track(lead: Real, start: Real, coordinate: Real, radius: Real) -> Real:
    """Angle of a wheel that rolled a way from its start; ``radius`` is negative on the right."""
    return lead + start - coordinate / radius


@action("way-rolled")
def way_rolled(turn: Real, start: Real, radius: Real) -> Real:
    """How far along its track a wheel has rolled when it has turned to an angle against it."""
    return -(turn - start) * radius


@action("less-axis")
def less_axis(turn: Real, axis: Point) -> Real:
    """An angle less that of a link that keeps its direction."""
    return turn - phase(axis)


@action("opposite")
def opposite(number: Real) -> Real:
    """A number with the other sign."""
    return -number


@action("turned-to")
def turned_to(before: Real, angle: Real, here: Point, there: Point) -> Real:
    """The angle of a driven link, from that of one of its lines (here to there)."""
    return before + angle - phase(there - here)


@action("rolled-on-wheel")
def rolled_on_wheel(turn_arm: Real, turn_track: Real, track: Real, wheel: Real) -> Real:
    """How far a wheel has turned that rolls on another, both on one arm (Willis)."""
    return turn_arm - (turn_track - turn_arm) * (track / wheel)


@action("arm-between")
def arm_between(
    turn: Real,
    other_turn: Real,
    start: Real,
    other_start: Real,
    planet: Real,
    other_planet: Real,
    track: Real,
    other_track: Real,
    wheel: Real,
    other_wheel: Real,
) -> Real:
    """The angle of an arm whose planet rolls on two wheels that turned so far (Willis).

    Of both contacts: how far the track has turned, the arm's and the planet's angle at the start,
    radii of the track and of the planet's wheel, a ring's negative. Equal ratios leave the arm
    free: they raise ZeroDivisionError on a scalar.
    """
    first, second = track / wheel, other_track / other_wheel
    near = planet - (turn + start) * first - start
    far = other_planet - (other_turn + other_start) * second - other_start
    return (far - near) / (first - second)


@action("arm-rolled")
def arm_rolled(
    turn: Real, start: Real, track_turn: Real, arm_start: Real, track: Real, wheel: Real
) -> Real:
    """The angle of an arm whose wheel has turned so far on another (Willis).

    ``turn`` and ``start`` are the wheel's angles now and at the start, ``track_turn`` is how far
    the other has turned since; radii of the other and of the wheel, a ring's negative. Equal ones
    of a ring leave the arm free: they raise ZeroDivisionError on a scalar.
    """
    return arm_start + (turn - start + track_turn * (track / wheel)) / (1 + track / wheel)


@action("axis")
def axis_turned(turn: Real) -> Point:
    """Axis of a link at an angle in radians."""
    return turn_by(turn)
