"""Constructions of the plans are records: what is drawn, said and computed of them is theirs."""

from __future__ import annotations

from functools import cache

import pytest

from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Plane
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.velocity.crossed_image import CrossedImage
from graphkin.construction.velocity.image_of_link import ImageOfLink
from graphkin.construction.velocity.parallel_through import ParallelThrough
from graphkin.construction.velocity.perpendicular_through import PerpendicularThrough
from graphkin.construction.velocity.turning_of_link import TurningOfLink
from graphkin.mechanism import load
from tests.documents.sheet_tools import FOLDER

PLANS = (Plane.VELOCITIES, Plane.ACCELERATIONS)
NAMES = ("crank-slot", "engine", "excavator-relative", "gears-rack", "lifter", "oldham", "roller")
EVERY = pytest.mark.parametrize("name", NAMES)
NEAR = 1e-9


@cache
def solved(name):
    """The steps of a scene with their values, by the hand's way too."""
    mechanism = load(FOLDER / f"{name}.toml")
    return mechanism.trace(mechanism.asked(), by_hand=True)


def made(name, kind):
    """The constructions of a kind of which all steps were run, and the values of the steps."""
    trace = solved(name)
    for each in constructions(trace.program, kind):
        if all(number in trace.values for _, number in each.given()):
            yield each, trace.values


@EVERY
def test_every_step_of_a_plan_is_part_of_a_construction_or_a_vector(name):
    for step in solved(name).program.steps:
        if step.plane in PLANS:
            assert construction(step) is not None or plan_vector(step) is not None, step


@EVERY
def test_a_crossed_image_lies_on_both_of_its_lines(name):
    for each, values in made(name, CrossedImage):
        for line in (values[each.first], values[each.second]):
            way = (values[each.image] - line.point) * line.along.conjugate()
            assert abs(way.imag) <= NEAR * max(abs(way), abs(line.along)), each


@EVERY
def test_lines_begin_at_what_is_known_and_keep_their_direction(name):
    for each, values in (*made(name, PerpendicularThrough), *made(name, ParallelThrough)):
        assert values[each.line].point == values[each.start], each


@EVERY
def test_a_point_found_by_similarity_is_where_lines_cross_by_hand(name):
    for each, values in made(name, ImageOfLink):
        if each.hand in values:
            size = abs(values[each.first]) + abs(values[each.second])
            assert values[each.hand] == pytest.approx(values[each.image], abs=NEAR * size)


@EVERY
def test_a_link_turns_as_the_image_of_its_bar_shows(name):
    for each, values in made(name, TurningOfLink):
        (p, q), (tail, tip) = (map(values.get, ends) for ends in (each.places, each.images))
        across = (tip - tail) / (q - p)
        assert values[each.rate] == pytest.approx(across.imag, abs=NEAR * abs(across)), each


@EVERY
def test_a_slide_is_laid_off_as_long_as_its_speed_is(name):
    for each, values in made(name, DrivenSlide):
        length = abs(values[each.image] - values[each.start])
        assert length == pytest.approx(abs(values[each.speed]), rel=NEAR), each
