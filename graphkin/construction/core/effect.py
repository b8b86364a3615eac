"""The effects of a motion, for one of which each step is drawn; those that are out cost nothing."""

from __future__ import annotations

from enum import Enum


class Effect(Enum):
    """What of a motion a step is drawn for, in the order of the work; its value is its name."""

    TIME = "laws of time"
    SHAPE = "data and shapes"
    POSITION = "position"
    ROLLING = "rolling"
    GEARS = "gears"
    VELOCITY = "velocity"
    RESULT = "rates of links and slides"
    ACCELERATION = "acceleration"
    DRIVER = "driver acceleration"
    NORMAL = "normal components"
    TANGENTIAL = "tangential components"
    CORIOLIS = "Coriolis"
    CENTRE = "instantaneous centres"
    CENTRODE = "centrodes"
    POLE = "acceleration poles"
