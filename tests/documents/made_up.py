"""Drawings of made-up traces: points and axes put down by the test, no construction behind them."""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import Drive, Given, Part, Plane, Program, Step
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import Verdict
from graphkin.construction.drivers import driver_symbols
from graphkin.construction.links import mechanism_symbols
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Mark
from graphkin.drawing.scale import Scales
from graphkin.scene.read_scene import read_text
from graphkin.text import words

RECT = (22.0, 38.0, 302.0, 238.0)
"""A field, in mm."""
HEAD = """graphkin = 1
title = "Made up"
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
DRIVER = """
[[drivers]]
turn = "{link}"
angle = 0
speed = 1
"""


def made_up(
    text: str, points: Mapping[str, complex], axes: Mapping[str, complex] | None = None
) -> Drawing:
    """A drawing at full size of a scene whose points (mm) and axes are known."""
    if "[[drivers]]" not in text:
        text += DRIVER.format(link=text.partition("[links.")[2].partition("]")[0])
    scene = read_text(HEAD + text, "made up", None, {})
    steps: list[Step] = []
    targets, values = {}, {}
    places = {name: place / 1000 for name, place in points.items()}
    for what, found in (("position", places), ("axis", axes or {})):
        for name, value in found.items():
            targets[what, name] = len(steps)
            values[len(steps)] = value
            plane = Plane.MECHANISM if what == "position" else Plane.NUMBERS
            steps.append(Step(None, (), Part.POSITION, plane, name, (), Given("point", ())))
    drives = []
    for n, driver in enumerate(scene.drivers, 1):
        speed = len(steps)
        steps.append(Step(None, (), Part.POSITION, Plane.NUMBERS, "", (), Given("number", ())))
        values[speed] = float(driver.speed.si(scene.values))
        drives.append(Drive(driver=n, position=speed, speed=speed, acceleration=speed))
    trace = Trace(Program(tuple(steps), targets, drives=tuple(drives)), values, {})
    verdict = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    return Drawing("velocity", scene, trace, Scales(1.0, 1.0), verdict, words("en"))


def field_of(drawing: Drawing) -> Field:
    """A field with a drawing at full size in its middle."""
    middle = ((RECT[0] + RECT[2]) / 2, (RECT[1] + RECT[3]) / 2)
    return Field(RECT, 1000.0, drawing.mechanism_extent().middle, middle)


def board_of(drawing: Drawing, *, drivers: bool = False) -> tuple[FieldContent, Field]:
    """The mechanism's marks with the field they stand in."""
    field = field_of(drawing)
    board = FieldContent(field.rect)
    mechanism_symbols.draw_plates(board, drawing, field)
    mechanism_symbols.draw_ground(board, drawing, field)
    mechanism_symbols.draw_bars(board, drawing, field)
    if drivers:
        driver_symbols.draw_drivers(board, drawing, field)
    mechanism_symbols.draw_pins(board, drawing, field)
    return board, field


def of_kind(board: FieldContent, kind: str, name: str | None = None) -> list[Mark]:
    """The marks of a class, of one name if it is given."""
    return [
        mark
        for mark in board.marks
        if mark.cls.split()[0] == kind and (name is None or mark.name == name)
    ]
