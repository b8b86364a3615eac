"""The names of known causes, and how grave each is unless a lab says otherwise."""

from collections.abc import Mapping

from graphkin.construction.registry import SLIPS

SHARES = {"slight": 0.1, "moderate": 0.15, "serious": 0.2}
"""The share of all points that a cause costs, by its grade."""
ANOTHER = "data_of_another"
"""The cause that another student's data were drawn."""
GRADES: Mapping[str, str] = {
    "angle_clockwise": "slight",
    "other_scale_of_protractor": "slight",
    "driver_reversed": "slight",
    "diameter_for_radius": "slight",
    "radius_for_diameter": "slight",
    "plate_flipped": "slight",
    "letters_exchanged": "slight",
    "other_side": "slight",
    "rpm_as_rad": "moderate",
    "turns_as_rad": "moderate",
    "rad_as_rpm": "moderate",
    "degrees_as_radians": "moderate",
    "driver_acceleration_missing": "moderate",
    "parallel_for_perpendicular": "serious",
    **{name: slip.grade for name, slip in SLIPS.items()},
    "sense_reversed": "slight",
    "ruler_scale": "slight",
    "ruler_from_ten": "slight",
    "wrong_scale": "moderate",
    "own_scale": "slight",
    "scale_missing": "moderate",
    "drawn_in_full": "slight",
    "length_not_scaled": "moderate",
    "power_of_ten": "slight",
    "decimal_point_lost": "slight",
    "rate_in_degrees": "slight",
    "rate_in_turns": "slight",
    "swapped": "moderate",
    "normal_for_tangential": "serious",
    "whole_for_tangential": "moderate",
    "absolute_for_relative": "moderate",
    "axes_swapped": "slight",
    "opposite": "slight",
    "answers_exchanged": "slight",
    ANOTHER: "serious",
}
"""The grade of each cause. Of equally good explanations, the first in this order is named."""
NAMES = tuple(GRADES)
"""All causes."""
