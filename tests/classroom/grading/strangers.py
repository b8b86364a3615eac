"""Students who share nothing with the marking: closed positions, differentiated in time.

A student draws the mechanism with errors in its lengths and sets the crank with one error for the
whole sheet, so that all answers go wrong together. Every length that is measured has an error of
its own and is rounded; values are computed from it. Some write other units, some leave cells blank,
some misread one length by a centimetre. :class:`Habits` says how a class does all this.

Accelerations come from vector equations where a mistake changes one of their terms.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import pi, radians, sqrt

import numpy as np

Points = dict[str, complex]
Motion = dict[str, tuple[complex, complex, complex]]
"""The position, velocity and acceleration of each point, in mm and s."""
Row = dict[str, float]
LABS: Mapping[str, tuple[float, Callable[[float], tuple[float, float]]]] = {
    "offset-slider-crank": (60, lambda n: (128 + 1.2 * n, 100 + 5 * n)),
    "slotted-lever": (120, lambda n: (28 + 1.5 * n, 50 + 2 * n)),
    "pump": (300, lambda n: (30 + 2 * n, 300 + 10 * n)),
}
"""The crank in mm, and its angle in degrees and its speed in rev/min by the student's number."""
CAUSES: Mapping[str, tuple[str, ...]] = {
    "diameter": ("diameter_for_radius", "radius_for_diameter"),
    "clockwise": ("angle_clockwise",),
    "protractor": ("other_scale_of_protractor",),
    "reversed": ("driver_reversed",),
    "another number": ("data_of_another",),
    "other side": ("other_side",),
    "plate": ("plate_flipped", "letters_exchanged"),
    "ruler 1:2": ("ruler_scale",),
    "ruler from 10": ("ruler_from_ten",),
    "scales exchanged": ("wrong_scale",),
    "scale forgotten": ("scale_missing",),
    "own plans": ("own_scale",),
    "rev/min": ("rpm_as_rad",),
    "in mm": ("power_of_ten",),
    "rows exchanged": ("answers_exchanged",),
    "cm in mm": ("power_of_ten",),
    "point lost": ("decimal_point_lost", "power_of_ten"),
    "rates in degrees": ("rate_in_degrees",),
    "rates in turns": ("rate_in_turns",),
    "degrees as radians": ("degrees_as_radians",),
    "senses": ("sense_reversed", "driver_reversed"),
    "no normals": ("normal_missing",),
    "normals turned": ("normal_reversed",),
    "no Coriolis": ("coriolis_missing",),
    "Coriolis turned": ("coriolis_reversed",),
    "half Coriolis": ("coriolis_halved",),
    "parallel": ("parallel_for_perpendicular",),
}
"""The names that each mistake may have in a report."""
NORMALS: Mapping[str, float] = {"no normals": 0.0, "normals turned": -1.0}
CORIOLIS: Mapping[str, float] = {"no Coriolis": 0.0, "Coriolis turned": -1.0, "half Coriolis": 0.5}
"""By how much each mistake multiplies the component."""
WIDEST = 700.0
"""The longest vector that is drawn, in mm."""
ONLY: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys(CORIOLIS, ("slotted-lever",)),
    "parallel": ("slotted-lever",),
    "plate": ("offset-slider-crank", "pump"),
}
"""The labs in which a mistake can be made; the others in all."""


@dataclass(frozen=True)
class Habits:
    """How a class draws, reads and writes.

    ``sigma`` is the error of a reading in mm, normal or with long ``tails``, and ``step`` what it
    is rounded to. ``bars`` is the error of a length of the mechanism in mm, ``whole`` says that the
    crank is set to whole degrees, else ``set`` degrees off. ``digits`` are written of a value. Of
    all cells ``blank`` are empty and ``units`` in another unit; ``blunders`` misread a length by a
    centimetre. ``comma`` of the students write commas.
    """

    sigma: float = 0.3
    tails: bool = True
    step: float = 0.5
    bars: float = 0.0
    set: float = 0.5
    whole: bool = False
    digits: tuple[int, ...] = (3,)
    blank: float = 0.04
    units: float = 0.1
    blunders: float = 0.3
    comma: float = 0.5


USUAL = Habits()
KINDS: Mapping[str, Habits] = {
    "usual": USUAL,
    "set square": Habits(0.25, False, 0.5, 0.25, 0.25, blunders=0.1, units=0.0, digits=(3, 4)),
    "whole degrees": Habits(0.2, False, 0.5, 0.2, whole=True, blunders=0.0, comma=1.0),
    "whole mm": Habits(0.3, False, 1.0, 0.3, 0.3, digits=(2, 3), blunders=0.2, blank=0.08),
    "calculator": Habits(0.15, False, 0.1, 0.15, 0.2, digits=(5, 6), units=0.0, blank=0.0),
    "hurried": Habits(0.5, True, 0.5, 0.4, 0.5, blunders=0.5, blank=0.1),
}
"""Classes by name."""


@dataclass
class Student:
    """A student at a sheet of a lab, with the mistakes made and the errors of their drawing."""

    lab: str
    habits: Habits
    rng: np.random.Generator
    made: frozenset[str]
    scale: float
    lengths: dict[str, float] = field(default_factory=dict)

    def long(self, name: str, length: float) -> float:
        """A length of the mechanism as it is drawn, with the same error at every use."""
        if name not in self.lengths:
            self.lengths[name] = self.scale * self.habits.bars * float(self.rng.normal())
        return length + self.lengths[name]

    def normal(self) -> float:
        """The factor on normal components."""
        return next((NORMALS[each] for each in NORMALS if each in self.made), 1.0)

    # --- the mechanism ------------------------------------------------------------------------

    def reach(self, start: complex, rod: float, height: float, side: float) -> complex:
        """The end of a rod on a level guide."""
        return complex(start.real + side * sqrt(rod**2 - (height - start.imag) ** 2), height)

    def positions(self, way: complex, crank: float) -> Points:
        """All points for a direction of the crank. Raises ValueError where they do not close."""
        a, side = crank * way, -1.0 if "other side" in self.made else 1.0
        if self.lab == "offset-slider-crank":
            b = self.reach(a, self.long("AB", 200), self.long("guide", 30), side)
            part = self.long("AC", 90) / 200
            return {"A": a, "B": b, "C": a + (1 - part if "plate" in self.made else part) * (b - a)}
        if self.lab == "slotted-lever":
            pivot = -1j * self.long("OO", 300)
            arm = (a - pivot) / abs(a - pivot)
            b = pivot + self.long("OB", 620) * arm
            c = self.reach(b, self.long("BC", 200), self.long("guide", 340), side)
            return {"O": pivot, "A": a, "B": b, "C": c, "slot": abs(a - pivot) + 0j}
        pivot = -1j * self.long("OO", 300)
        rod, arm = self.long("AB", 400), self.long("OB", 300)
        span = pivot - a
        angle = (rod**2 - arm**2 + abs(span) ** 2) / (2 * rod * abs(span))
        if abs(angle) > 1:
            raise ValueError("does not close")
        b = a + rod * cmath.exp(-1j * np.arccos(angle)) * span / abs(span)
        part = (400**2 + 200**2 - 250**2) / (2 * 400**2)
        shape = complex(part, sqrt(0.25 - part**2))
        c = a + (shape.conjugate() if "plate" in self.made else shape) * (b - a)
        d = self.reach(c, self.long("CD", 200), 0, side)
        return {"O": pivot, "A": a, "B": b, "C": c, "D": d}

    def motion(self, phi: float, omega: float, crank: float) -> Motion:
        """Positions differentiated in time by a fourth-order stencil; mistakes of plans after."""
        step = 1e-3 / abs(omega)
        every = [
            self.positions(cmath.exp(1j * (phi + omega * k * step)), crank) for k in range(-2, 3)
        ]
        found: Motion = {}
        for name in every[0]:
            p = [each[name] for each in every]
            speed = (p[0] - 8 * p[1] + 8 * p[3] - p[4]) / (12 * step)
            rate = (-p[0] + 16 * p[1] - 30 * p[2] + 16 * p[3] - p[4]) / (12 * step**2)
            found[name] = p[2], speed, rate
        return self.mistaken(found)

    def mistaken(self, m: Motion) -> Motion:
        """The plans with mistakes in their components."""
        m, k = dict(m), self.normal()
        if "parallel" in self.made:
            m = along_the_rod(m)
        if k == 1 and not self.made & CORIOLIS.keys():
            return m
        if self.lab == "offset-slider-crank":
            m["B"] = (*m["B"][:2], on_level(m, "A", "B", k))
            part = (m["C"][0] - m["A"][0]) / (m["B"][0] - m["A"][0])
            m["C"] = (*m["C"][:2], m["A"][2] + part * (m["B"][2] - m["A"][2]))
        elif self.lab == "slotted-lever":
            m = self.lever(m, k)
        else:
            (o, _, _), (a, _, at), (b, _, _) = (m[name] for name in "OAB")
            z, y = b - a, b - o
            own = k * turning(m, "A", "B")[0] ** 2 * z - k * turning(m, "O", "B")[0] ** 2 * y
            rest = own - at  # jε₃·z − jε₂·y
            both = np.array([[(1j * z).real, (-1j * y).real], [(1j * z).imag, (-1j * y).imag]])
            turn, _ = np.linalg.solve(both, [rest.real, rest.imag])
            grow = complex(-k * turning(m, "A", "B")[0] ** 2, turn)
            for name in "BC":
                m[name] = (*m[name][:2], at + grow * (m[name][0] - a))
            m["D"] = (*m["D"][:2], on_level(m, "C", "D", k))
        return m

    def lever(self, m: Motion, k: float) -> Motion:
        """The lever and what it drives, with its normal and Coriolis components mistaken."""
        coriolis = next((CORIOLIS[each] for each in CORIOLIS if each in self.made), 1.0)
        (o, _, _), (b, _, _), (s, ds, _), a = m["O"], m["B"], m["slot"], m["A"][2]
        u, w = (b - o) / abs(b - o), turning(m, "O", "B")[0]
        s, ds = s.real, ds.real
        epsilon = ((a / u).imag - coriolis * 2 * w * ds) / s
        slid = (a / u).real + k * w**2 * s
        m["slot"] = m["slot"][0], m["slot"][1], complex(slid)
        m["B"] = (*m["B"][:2], complex(-k * w**2, epsilon) * (b - o))
        m["C"] = (*m["C"][:2], on_level(m, "B", "C", k))
        return m

    # --- reading and writing ------------------------------------------------------------------

    def error(self) -> float:
        """The error of a reading, in mm."""
        each = float(self.rng.standard_t(4)) / sqrt(2) if self.habits.tails else self.rng.normal()
        return self.habits.sigma * float(each)

    def rounded(self, mm: float) -> float:
        """A reading as the ruler shows it."""
        return round(mm / self.habits.step) * self.habits.step


def on_level(m: Motion, p: str, q: str, normal: float) -> complex:
    """The acceleration of a point on a level guide, with its normal component mistaken."""
    (x, _, a), (y, _, _) = m[p], m[q]
    z, w = y - x, turning(m, p, q)[0]
    start = a - normal * w**2 * z
    return start + 1j * z * (-start.imag / (1j * z).imag)


def along_the_rod(m: Motion) -> Motion:
    """The slotted lever's plans with parallels to the rod BC in place of perpendiculars."""
    (x, v, a), (y, _, _) = m["B"], m["C"]
    z = y - x
    senses = np.sign(turning(m, "B", "C")[:2])
    w = -v.imag / z.imag
    start = a - w**2 * z
    e = -start.imag / z.imag
    sizes = senses * [abs(w), abs(e)]
    turns = complex(sizes[0]), complex(sizes[1]), 0j
    return m | {"C": (y, v + w * z, start + e * z), "turns": turns}


def turning(m: Motion, p: str, q: str) -> tuple[float, float, float]:
    """The rate of a bar, its angular acceleration and its length; an empty name is at rest."""
    (x, v, a), (y, w, b) = m[p], m[q]
    if p == "O":
        v = a = 0j
    z, u, c = y - x, w - v, b - a
    return (u / z).imag, (c / z).imag, abs(z)


# --- what is handed in ----------------------------------------------------------------------------


def hand_in(
    lab: str,
    number: float,
    sheet: tuple[float, float, float],
    rng: np.random.Generator,
    made: str = "",
    other: float = 0.0,
    habits: Habits = USUAL,
) -> dict[str, str]:
    """What a student writes; two mistakes are joined by ``+``.

    Raises ValueError where the drawing does not close.
    """
    length, data = LABS[lab]
    mistakes = frozenset(filter(None, made.split("+")))
    student = Student(lab, habits, rng, mistakes, sheet[0])
    degrees, speed = data(other if "another number" in mistakes else number)
    off = round(degrees) - degrees if habits.whole else rng.uniform(-habits.set, habits.set)
    degrees = -degrees if "clockwise" in mistakes else degrees
    degrees = 180 - degrees if "protractor" in mistakes else degrees
    phi = (degrees if "degrees as radians" in mistakes else radians(degrees)) + radians(off)
    times = (0.5 if lab == "pump" else 2) if "diameter" in mistakes else 1
    crank = student.long("crank", length * times)
    omega = speed * pi / 30 * (-1 if "reversed" in mistakes else 1)
    m = student.motion(phi, omega, crank)
    found = Sheet(student, sheet, m).answers()
    if "rows exchanged" in mistakes:
        found = exchanged(lab, found)
    comma = rng.random() < habits.comma
    lost = rng.integers(1, 3)
    if any(f.endswith("_mm") and abs(v) > WIDEST for f, v in found.items() if f[0] in "va"):
        raise ValueError("does not fit on paper")
    row = {f: cell(f, v, student, "," if comma else ".", int(lost)) for f, v in found.items()}
    return {
        f: text for f, text in row.items() if rng.random() >= habits.blank and found[f] == found[f]
    }


def exchanged(lab: str, found: Row) -> Row:
    """The answers for two points or links in each other's rows."""
    swap = {"offset-slider-crank": ("B", "C"), "slotted-lever": ("C", "A3"), "pump": ("2", "4")}
    one, two = swap[lab]
    names = {f: f.replace(f"_{one}", f"_{two}", 1) for f in found if f"_{one}" in f"{f}_"}
    names = {f: o for f, o in names.items() if o in found and f != o and f[0] in "vaeo"}
    names |= {o: f for f, o in names.items()}
    return {f: found[names.get(f, f)] for f in found}


class Sheet:
    """The answers of a student from the plans of a mechanism."""

    def __init__(self, student: Student, sheet: tuple[float, float, float], m: Motion) -> None:
        self.student, self.m = student, m
        self.kL, kv, ka = sheet
        self.scale = {"v": kv, "a": ka}
        self.made, self.rng = student.made, student.rng
        blunders = self.rng.random() < student.habits.blunders
        self.blunder = int(self.rng.integers(12)) if blunders else -1
        self.read = 0
        self.found: Row = {}
        self.factor = dict(self.scale)
        if "scales exchanged" in self.made:
            self.factor = {"v": ka, "a": kv}
        if "scale forgotten" in self.made:
            self.factor = {"v": 1000.0, "a": 1000.0}
        if "rev/min" in self.made:
            self.factor["v"] *= 30 / pi
            self.factor["a"] *= (30 / pi) ** 2

    def measured(self, mm: float) -> float:
        """A length as it is read with the student's ruler."""
        told = self.student.rounded(abs(mm) + self.student.error())
        told += 10 if self.read == self.blunder else 0
        self.read += 1
        told = 2 * told if "ruler 1:2" in self.made else told
        least = self.student.habits.step
        return told + 10 if "ruler from 10" in self.made else max(told, least)

    def vector(self, name: str, size: float) -> None:
        """A vector of a plan: its length, and its size."""
        plan = name[0]
        mm = self.measured(size / self.scale[plan])
        self.found[f"{name}_mm"] = mm * 2 if "own plans" in self.made else mm
        self.found[name] = mm * self.factor[plan] / 1000

    def rate(self, name: str, value: float, bar: float, plan: str) -> None:
        """A rate of a link, and its sense."""
        mm = self.measured(value * bar / self.scale[plan])
        turns = 30 / pi if "rates in turns" in self.made else 1.0
        turns = 180 / pi if "rates in degrees" in self.made else turns
        self.found[name] = mm * self.factor[plan] / bar * turns
        self.found[f"{name}_sense"] = -value if "senses" in self.made else value

    def links(self, of: Mapping[str, tuple[str, str]]) -> None:
        """The rates of some bars."""
        for link, (p, q) in of.items():
            w, e, bar = turning(self.m, p, q)
            if "turns" in self.m:
                w, e = (each.real for each in self.m["turns"][:2])
            self.rate(f"omega_{link}", w, bar, "v")
            self.rate(f"epsilon_{link}", e, bar, "a")

    def points(self, names: str) -> None:
        """The velocities and accelerations of some points."""
        for name in names:
            self.vector(f"v_{name}", abs(self.m[name][1]))
            self.vector(f"a_{name}", abs(self.m[name][2]))

    def answers(self) -> Row:
        """All fields of the lab's form."""
        m, lab, ka = self.m, self.student.lab, self.scale["a"]
        if lab == "offset-slider-crank":
            self.points("BC")
            w, _, bar = turning(m, "A", "B")
            self.links({"2": ("A", "B")})
            mm = self.measured(w**2 * bar / ka) * (2 if "own plans" in self.made else 1)
            self.found["a_BA_nu_mm"] = np.nan if "no normals" in self.made else mm
        elif lab == "slotted-lever":
            self.points("C")
            (w, e, _), arm = turning(m, "O", "B"), abs(m["slot"][0])
            normal = self.student.normal() * w**2
            self.vector("v_A3", abs(w) * arm)
            self.vector("a_A3", abs(complex(normal, e)) * arm)
            self.rate("omega_3", w, arm, "v")
            self.rate("epsilon_3", e, arm, "a")
            self.links({"4": ("B", "C")})
            for plan, value in (("v", m["slot"][1].real), ("a", m["slot"][2].real)):
                mm = self.measured(value / self.scale[plan])
                self.found[f"{plan}_slide_2"] = mm * self.factor[plan] / 1000
                self.found[f"{plan}_slide_2_sense"] = -value if "senses" in self.made else value
        else:
            self.points("D")
            self.links({"2": ("O", "B"), "3": ("A", "B"), "4": ("C", "D")})
            k = self.student.normal()
            poles = {"I_3": centre(m, "A", "B")}
            poles |= {"J_3": pole(m, "A", "B", k), "J_4": pole(m, "C", "D", k)}
            for name, at in poles.items():
                for axis, value in (("x", at.real), ("y", at.imag)):
                    told = value / self.kL + 3 * self.student.error()
                    told = 2 * told if "ruler 1:2" in self.made else told
                    told += 10 * np.sign(told) if "ruler from 10" in self.made else 0
                    self.found[f"{name}_{axis}_mm"] = self.student.rounded(told)
        return self.found


def centre(m: Motion, p: str, q: str) -> complex:
    """The instant centre of a bar."""
    x, v, _ = m[p]
    return x + 1j * v / turning(m, p, q)[0]


def pole(m: Motion, p: str, q: str, normal: float) -> complex:
    """The pole of accelerations of a bar, by the images of its ends."""
    (x, _, a), (w, e, _) = m[p], turning(m, p, q)
    return x - a / complex(-normal * w**2, e)


def cell(field: str, value: float, student: Student, point: str, lost: int) -> str:
    """A number as it is written: mostly in the form's unit, at times in another with its name."""
    habits, rng, made = student.habits, student.rng, student.made
    if field.endswith("_sense"):
        return "+" if value > 0 else "-"
    if field.endswith("_mm"):
        mm = value / 10 if "cm in mm" in made else value
        in_mm = rng.random() >= habits.units or value <= 0 or "cm in mm" in made
        places = 1 if habits.step >= 0.5 or habits.step == 0.1 else 2
        places += "cm in mm" in made
        return (f"{mm:.{places}f}" if in_mm else f"{value / 10:.2f} cm").replace(".", point)
    size = abs(value) * (1000 if "in mm" in made and field[0] in "va" else 1)
    unit = ""
    if rng.random() < habits.units and not made & {"in mm", "rates in turns", "rates in degrees"}:
        unit, factor = {"v": ("cm/s", 100.0), "a": ("cm/s2", 100.0), "o": ("rot/min", 30 / pi)}.get(
            field[0], ("s^-2", 1.0)
        )
        size *= factor
    digits = int(rng.choice(habits.digits))
    text = np.format_float_positional(float(f"{size:.{digits}g}"), trim="-")
    if "point lost" in made and not unit:
        text = f"{size:.{lost}f}".replace(".", "")
    return f"{text.replace('.', point)} {unit}".strip()
