"""How reactions and balances change when loads, the scene or the observer change.

Mechanisms, masses and loads are made at random.
"""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from graphkin.mechanism import Mechanism
from graphkin.scene.forces import Components, Forces
from graphkin.scene.model import FRAME, Polar
from graphkin.scene.quantity import Quantity, exact
from tests.laws.force_routes import loaded
from tests.mechanisms import LAW, Made, angles, log_scaled, mechanism_of, mechanisms, signs

CLOSE = 1e-8
"""The share of the largest force by which two scenes of the same forces may differ."""
SEEDS = st.integers(0, 10**6)

Change = Callable[[complex], complex]


def same(force: complex) -> complex:
    return force


class Solved:
    """The forces in all pairs, and those or the moments of drivers, of a mechanism with loads."""

    def __init__(self, mechanism: Mechanism, forces: Forces | None = None) -> None:
        scene = mechanism.scene if forces is None else replace(mechanism.scene, forces=forces)
        found, verdict = Mechanism(scene).forces()
        assert verdict.agrees
        self.pairs = {(each.name, each.link): each.force for each in found.reactions}
        self.moments = {each.link: each.moment for each in found.balance if each.force is None}

    @property
    def largest(self) -> float:
        return max((abs(force) for force in self.pairs.values()), default=0.0)

    def is_like(self, other: Solved, change: Change = same, moment: float = 1.0) -> None:
        """These forces are those of another scene, changed; moments are multiplied."""
        assert self.pairs.keys() == other.pairs.keys()
        for key, force in other.pairs.items():
            assert abs(self.pairs[key] - change(force)) <= CLOSE * self.largest, key
        arm = 1.0  # metres, about the size of the mechanisms
        most = max(*map(abs, self.moments.values()), arm * self.largest, 0.0)
        for link, value in other.moments.items():
            assert abs(self.moments[link] - moment * value) <= CLOSE * most, link


def vector(force: complex, unit: str) -> Components:
    return number(force.real, unit), number(force.imag, unit)


def number(value: float, unit: str) -> Quantity:
    return exact(repr(value), unit)


def as_complex(given: Components) -> complex:
    return complex(*(float(each.si({})) for each in given))


def given_at_random(mechanism: Mechanism, seed: int) -> Forces:
    """Masses, gravity and loads at random."""
    forces = loaded(mechanism, random.Random(seed)).scene.forces
    assert forces is not None
    return forces


def changed(forces: Forces, change: Change, moment: float = 1.0) -> Forces:
    """Loads and gravity changed, and moments multiplied."""
    loads = tuple(
        replace(
            each,
            force=None if each.force is None else vector(change(as_complex(each.force)), "N"),
            moment=None
            if each.moment is None
            else number(moment * float(each.moment.si({})), "N·m"),
        )
        for each in forces.loads
    )
    gravity = forces.gravity
    falls = None if gravity is None else vector(change(as_complex(gravity)), "m/s²")
    return replace(forces, loads=loads, gravity=falls)


def loads_alone(forces: Forces) -> Forces:
    return replace(forces, masses={}, gravity=None)


@LAW
@given(mechanisms(), SEEDS, log_scaled(1e-3, 1e3), signs())
def test_reactions_grow_with_the_loads(made: Made, seed, size, sign):
    mechanism, k = made.mechanism(), size * sign
    forces = loads_alone(given_at_random(mechanism, seed))
    once, more = Solved(mechanism, forces), Solved(mechanism, changed(forces, lambda f: k * f, k))
    more.is_like(once, lambda force: k * force, k)


@LAW
@given(mechanisms(), SEEDS)
def test_reactions_of_loads_and_masses_add_up(made: Made, seed):
    """Each load alone, gravity alone and inertia alone, one after the other."""
    mechanism = made.mechanism()
    forces = given_at_random(mechanism, seed)
    nothing = replace(forces, masses={}, gravity=None, loads=())
    parts = [replace(nothing, loads=(load,)) for load in forces.loads]
    still = replace(forces, loads=(), gravity=None)
    parts.append(still)
    whole = Solved(mechanism, forces)
    falling = Solved(mechanism, replace(forces, loads=()))
    moving = Solved(mechanism, still)
    some = [Solved(mechanism, part) for part in parts]
    for key, force in whole.pairs.items():
        weight = falling.pairs[key] - moving.pairs[key]
        total = weight + sum(each.pairs[key] for each in some)
        assert abs(force - total) <= CLOSE * max(whole.largest, *(e.largest for e in some))


@LAW
@given(mechanisms(), SEEDS, angles(-180, 180))
def test_reactions_turn_with_the_scene_and_gravity(made: Made, seed, angle):
    turn = cmath.rect(1, angle)
    mechanism = made.mechanism()
    forces = given_at_random(mechanism, seed)
    there = made.turned(turn).mechanism()
    turned = changed(forces, lambda force: turn * force)
    Solved(there, turned).is_like(Solved(mechanism, forces), lambda force: turn * force)


@LAW
@given(mechanisms(), SEEDS)
def test_reactions_are_mirrored_with_the_scene(made: Made, seed):
    mechanism = made.mechanism()
    forces = given_at_random(mechanism, seed)
    mirrored = changed(forces, complex.conjugate, -1)
    Solved(made.mirrored().mechanism(), mirrored).is_like(
        Solved(mechanism, forces), complex.conjugate, -1
    )


@LAW
@given(mechanisms(), SEEDS, st.sampled_from((3 + 0j, -2j, 5 - 7j)))
def test_reactions_stay_when_the_scene_is_shifted(made: Made, seed, by):
    mechanism = made.mechanism()
    forces = given_at_random(mechanism, seed)
    size = max(map(abs, made.places.values()))
    Solved(made.shifted(size * by).mechanism(), forces).is_like(Solved(mechanism, forces))


@LAW
@given(mechanisms(), SEEDS, st.sampled_from((0.5, 2.0, 1024.0)))
def test_forces_of_loads_stay_when_the_scene_is_larger_and_moments_grow(made: Made, seed, size):
    mechanism = made.mechanism()
    forces = loads_alone(given_at_random(mechanism, seed))
    larger = changed(forces, same, size)
    Solved(made.scaled(size).mechanism(), larger).is_like(Solved(mechanism, forces), same, size)


@LAW
@given(mechanisms(), SEEDS, log_scaled(0.1, 10), signs())
def test_inertia_forces_grow_with_the_square_of_the_speed(made: Made, seed, size, sign):
    mechanism, k = made.mechanism(), size * sign
    forces = replace(given_at_random(mechanism, seed), loads=(), gravity=None)
    slow, fast = Solved(mechanism, forces), Solved(made.sped(k).mechanism(), forces)
    fast.is_like(slow, lambda force: k * k * force, k * k)


@LAW
@given(mechanisms(), SEEDS, log_scaled(0.1, 10), signs())
def test_a_load_may_act_anywhere_on_its_line(made: Made, seed, size, sign):
    """The force at another point of the link, on the line of the force through its own point."""
    mechanism = made.mechanism()
    forces = loads_alone(given_at_random(mechanism, seed))
    load = forces.loads[0]
    assert load.force is not None
    force, solved = as_complex(load.force), mechanism.solve()
    motion = mechanism.check.examine(solved, numbered=0).solved.motion
    axis = complex(motion.heading[0, motion.index[load.link]])
    way = math.degrees(cmath.phase(sign * force / axis))
    length = size * max(map(abs, made.places.values()))
    beside = Polar("T", load.at, number(length, "m"), number(way, "deg"))
    link = mechanism.scene.links[load.link]
    link = replace(link, points=(*link.points, "T"), placings=(*link.placings, beside))
    scene = replace(mechanism.scene, links={**mechanism.scene.links, load.link: link})
    moved = replace(forces, loads=(replace(load, at="T"), *forces.loads[1:]))
    Solved(Mechanism(scene), moved).is_like(Solved(mechanism, forces))


def on_a_carriage(made: Made, speed: float, acceleration: float) -> Mechanism:
    """The mechanism on a carriage that slides along x instead of on the frame."""
    words = made.text().splitlines()
    start = words.index("[frame]")
    end = next(k for k, line in enumerate(words) if line.startswith("[links."))
    first = made.places[made.frame[0]]
    rail = ["[frame]", "R = [0, 0]"]
    guide = f'slides = {{ on = 0, through = "R", angle = 0, offset = {first.imag!r} }}'
    carriage = ["[links.carriage]", *words[start + 1 : end], guide]
    rest = [line.replace("on = 0,", "on = carriage,") for line in words[end:]]
    driver = ["[[drivers]]", "slide = carriage", f"position = {first.real!r}"]
    driver += [f"speed = {speed!r}", f"acceleration = {acceleration!r}"]
    split = rest.index("[[drivers]]")
    text = [*words[:start], *rail, *carriage, *rest[:split], *driver, *rest[split:]]
    joined = "\n".join(text).replace("on = carriage", 'on = "carriage"')
    return mechanism_of(joined.replace("slide = carriage", 'slide = "carriage"'))


def without_carriage(solved: Solved) -> Solved:
    """The forces with the carriage called frame, and without those of its own guide and driver."""
    solved.pairs = {
        (name.replace("-carriage", f"-{FRAME}"), FRAME if link == "carriage" else link): force
        for (name, link), force in solved.pairs.items()
        if name != f"carriage-{FRAME}"
    }
    return solved


@LAW
@given(mechanisms(), SEEDS, st.sampled_from((0.0, 1.0, -40.0)))
def test_a_carriage_of_constant_speed_changes_no_force(made: Made, seed, speed):
    """Galileo: no experiment on board shows the speed."""
    mechanism = made.mechanism()
    forces = given_at_random(mechanism, seed)
    on_board = without_carriage(Solved(on_a_carriage(made, speed, 0.0), forces))
    on_board.is_like(Solved(mechanism, forces))


@pytest.mark.parametrize("push", [2.5, -30.0])
@LAW
@given(made=mechanisms(), seed=SEEDS)
def test_a_carriage_that_speeds_up_is_as_gravity_leaning_back(made: Made, seed, push):
    """Einstein's lift: forces on board are those with g - a."""
    mechanism = made.mechanism()
    forces = given_at_random(mechanism, seed)
    assert forces.gravity is not None
    leaning = replace(forces, gravity=vector(as_complex(forces.gravity) - push, "m/s²"))
    on_board = without_carriage(Solved(on_a_carriage(made, 1.0, push), forces))
    on_board.is_like(Solved(mechanism, leaning))
