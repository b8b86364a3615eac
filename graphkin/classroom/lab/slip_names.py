"""The names of known slips, which rubrics use to give them shares of the points."""

from graphkin.construction.registry import SLIPPING

NAMES = (
    "rpm_as_rad",
    "turns_as_rad",
    "rad_as_rpm",
    "degrees_as_radians",
    "angle_clockwise",
    "driver_reversed",
    "driver_acceleration_missing",
    "diameter_for_radius",
    "radius_for_diameter",
    "other_side",
    *(name for kind in reversed(SLIPPING) for name in kind.slips),
    "sense_reversed",
    "wrong_scale",
    "scale_missing",
    "length_not_scaled",
    "power_of_ten",
    "drawn_in_full",
    "swapped",
    "normal_for_tangential",
    "whole_for_tangential",
    "absolute_for_relative",
    "rate_in_degrees",
    "rate_in_turns",
    "axes_swapped",
    "opposite",
)
"""All slips. Of equally good explanations, the first in this order is named."""
