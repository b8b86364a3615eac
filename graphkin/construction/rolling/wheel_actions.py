"""Wheels that roll without slip: contact points, turning, and the contact's image in the plans."""

from __future__ import annotations

from graphkin.construction.core.vocabulary import action
from graphkin.numbers.arithmetic import Point, Real, at, below, phase, pick, turn_by
from graphkin.numbers.plane import Line, dot

ROUND = 1e-9
"""Radians by which rounding may put half a turn on its other side."""


@action("contact-on-track")
def contact_on_track(line: Line, centre: Point) -> Point:
    """The foot of the perpendicular from a wheel's centre to its straight track."""
    unit = line.along / abs(line.along)
    return line.point + unit * dot(unit, centre - line.point)


@action("contact-of-wheels")
def contact_of_wheels(track_centre: Point, centre: Point, track: Real, wheel: Real) -> Point:
    """The point of the line of centres where two wheels touch; a ring's radius is negative."""
    return track_centre + (centre - track_centre) * (track / (track + wheel))


@action("radius-along")
def radius_along(line: Line, radius: Real) -> Line:
    """The line on which the centre of a wheel moves that rolls to the left of its track."""
    return Line(line.point + 1j * line.along * (radius / abs(line.along)), line.along)


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


@action("rack-at")
def rack_at(
    centre: Point, axis: Point, here: Point, there: Point, point: Point, radius: Real, way: Real
) -> Point:
    """A point of a rack from the wheel that has rolled a way along its track (here to there)."""
    line = there - here
    along = axis * (line / abs(line))
    return centre - along * at(way, radius) + axis * (point - here)


@action("opposite")
def opposite(number: Real) -> Real:
    """A number with the other sign."""
    return -number


@action("counted-near")
def counted_near(axis: Point, heading: Point, angle: Real) -> Real:
    """The angle in radians of an axis, within half a turn of that of a heading.

    An axis turned just half round from it, but for rounding, has turned ahead and not back.
    """
    way = axis * heading.conjugate()
    size = abs(way)
    quarter = phase(at(size * 0.0, size))
    since = phase(way)
    return angle + pick(below(since, ROUND - 2 * quarter), since + 4 * quarter, since)


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


@action("axis")
def axis_turned(turn: Real) -> Point:
    """Axis of a link at an angle in radians."""
    return turn_by(turn)


@action("between-tracks")
def between_tracks(
    own: Line, other: Line, lean: Real, radius: Real, other_radius: Real, way: int
) -> Real:
    """Where between two parallel tracks a roller stands on the first, from how it turned.

    On both tracks the way rolled gives the same turning; ``lean`` is how much farther the one has
    the roller turned at its zero, way the sense of the second track against the first.
    """
    unit = own.along / abs(own.along)
    shift = dot(unit, own.point - other.point)
    return -(lean * other_radius + way * shift) / (way - other_radius / radius)


@action("speed-rolled")
def speed_rolled(rate: Real, radius: Real) -> Real:
    """The speed at which a wheel's centre moves along its track when it turns at a rate."""
    return -rate * radius
