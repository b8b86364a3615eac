"""A whole class at once: the same construction on an array of student numbers.

The last column is the flattest crossing of the drawing: where two lines cross at a small angle, a
pencil finds their crossing badly. The lab is the pump with C at the middle of AB; in ``pump`` the
flattest crossing is the corner C of its plate, the same for everyone.
Run it with ``python examples/02_whole_class.py``.
"""

from __future__ import annotations

import numpy as np

import graphkin

FAIR = 20.0
"""Degrees; flatter crossings are unfair to ask for."""


def main() -> None:
    """Run all variants, print one row for each, and say which position is the hardest to draw."""
    pump = graphkin.load("pump-collinear")
    students = np.arange(1, 31)
    motion = pump.batch(n=students)

    speed = motion.points["D"].velocity.real
    acceleration = motion.points["D"].acceleration.real
    crossing = np.degrees(np.arcsin(motion.margin))

    print(f"{'n':>2} {'v_D, m/s':>9} {'a_D, m/s²':>10} {'flattest crossing':>18}")
    for row in zip(students, speed, acceleration, crossing, strict=True):
        print("{:2d} {:9.4f} {:10.3f} {:17.2f}°".format(*row))

    worst = int(crossing.argmin())
    print(f"\nflattest of all: {crossing[worst]:.2f}° for n = {students[worst]}")
    print(f"students with a crossing under {FAIR:g}°: {int((crossing < FAIR).sum())}")


if __name__ == "__main__":
    main()
