"""Any expression ends in a finite value or in one sentence: plain, nested, huge, tiny, hostile."""

from __future__ import annotations

import math
import random
import re
from concurrent.futures import ThreadPoolExecutor

import pytest

from graphkin.scene.expression import parse
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError

SCENE = """
graphkin = 1
time = {time}
units = {{ length = "cm", angle = "deg", speed = "rev/min" }}
[parameters]
n = 7
[frame]
O = [0, 0]
[links.1]
O-A = "{length}"
[links.2]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[drivers]]
turn = 1
angle = "{angle}"
{speed}
"""
TIMES = ("0", "1", "-1", "2.25", '"1/3"', "1e-30", "1e30", "90")
WHOLE = ("0", "1", "2", "3", "30", "45", "60", "90", "180", "270", "360", "-1", "0.5", "1.5", "1/3")
POWERS = ("0.5", "1.5", "(1/3)", "2", "-1", "-0.5", "3", "64", "-64", "65", "(n/2)", "pi")
CASES = 100
"""Expressions of each kind."""


def number(chance: random.Random, time: bool) -> str:
    """A number, plain or log-scaled, a parameter, or the time."""
    kind = chance.random()
    if kind < 0.3:
        return chance.choice(WHOLE)
    if kind < 0.5:
        return f"{10 ** chance.uniform(-3, 3):.6g}"
    if kind < 0.6:
        return f"{10 ** chance.uniform(-60, 60):.6e}"
    return chance.choice(("pi", "n", "t" if time else "n", "t" if time else "2"))


def expression(chance: random.Random, time: bool, depth: int) -> str:
    """An expression nested as deep."""
    if depth <= 0:
        return number(chance, time)
    one, other = (expression(chance, time, depth - chance.choice((1, 1, 2))) for _ in range(2))
    kind = chance.random()
    if kind < 0.45:
        return f"({one}{chance.choice('+-*/')}{other})"
    if kind < 0.65:
        return f"({one})**{chance.choice((*POWERS, f'({other})'))}"
    if kind < 0.95:
        return f"{chance.choice(('sqrt', 'sin', 'cos', 'tan'))}({one})"
    return f"-({one})"


def scene_of(chance: random.Random, time: bool) -> str:
    """A crank of which one number is an expression; a law of time if time is to come in."""
    text = expression(chance, time, chance.randrange(6))
    law = time and "t" in re.sub("sqrt|tan", "", text)
    where = "angle" if law else chance.choice(("length", "angle", "speed"))
    values = {"length": "30", "angle": "0", "speed": "1"} | {where: text}
    values["speed"] = "" if law else f'speed = "{values["speed"]}"'
    return SCENE.format(time=chance.choice(TIMES), **values)


@pytest.mark.parametrize("time", [False, True], ids=["parameters", "laws of time"])
def test_an_expression_ends_in_a_value_or_in_one_sentence(time: bool) -> None:
    chance = random.Random(4)
    told = valued = 0
    for _ in range(CASES):
        text = scene_of(chance, time)
        try:
            scene = read_text(text, "random")
        except GraphkinError as error:
            told += 1
            for problem in error.problems:
                assert problem.place
                assert "\n" not in str(problem)
                assert "'" not in problem.found, "a sentence of our own, not Python's"
        else:
            valued += 1
            for driver in scene.drivers:
                numbers = (driver.position, driver.speed, driver.acceleration)
                assert all(math.isfinite(each.si(scene.values)) for each in numbers), text
    assert min(told, valued) > CASES / 10


def test_expressions_are_read_by_many_threads_at_once():
    """As the requests to the studio come."""
    text = "+".join(f"({j}*(a-{j}))" for j in range(30))
    with ThreadPoolExecutor(8) as pool:
        assert len({repr(tree) for tree in pool.map(parse, [text] * 400)}) == 1
