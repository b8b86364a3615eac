"""Students whose marks are known: answers of many kinds, and what each field earns by the rules.

Nothing here is worked out by the marking. Drawings come from ``hand``, and what a student computes
is computed here again; of graphkin only what is printed is taken: scales, points, tolerances.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import log, pi

import numpy as np

from tests.classroom.grading import hand
from tests.classroom.grading.hand import Data, Hand

FOLLOW = 0.8
COSTS = {
    "angle_clockwise": 0.1,
    "driver_reversed": 0.1,
    "rpm_as_rad": 0.15,
    "wrong_scale": 0.15,
    "scale_missing": 0.15,
    "coriolis_missing": 0.2,
    "coriolis_reversed": 0.15,
    "normal_missing": 0.2,
    "normal_reversed": 0.15,
    "power_of_ten": 0.1,
}
"""The share of all points that each cause costs, once."""
MORE = {
    "offset-slider-crank": ("v_BA_mm", "v_BA", "a_BA_nu", "a_BA_tau_mm", "a_BA_tau"),
    "slotted-lever": ("v_CB_mm", "v_CB", "v_AA3_mm", "v_AA3", "a_AA3_cor_mm", "a_AA3_cor"),
    "pump": ("v_B_mm", "v_B", "v_BA_mm", "v_BA", "v_DC_mm", "v_DC", "a_BA_nu_mm", "a_BA_nu"),
}
"""Fields that are asked beside those of the labs."""
CROSSINGS = {
    "offset-slider-crank": ("v_B", "a_B"),
    "slotted-lever": ("v_A3", "v_C", "a_A3", "a_C"),
    "pump": ("v_B", "v_D", "a_B", "a_D", "I_3", "J_3", "J_4"),
}
"""What is found where two lines cross, in the order of the drawing."""
NORMALS = {
    "offset-slider-crank": ("BA",),
    "slotted-lever": ("A3", "CB"),
    "pump": ("B", "BA", "DC"),
}
"""The bars whose normal components are computed, in the same order."""
TANGENTIAL = {"BA": ("a_B", "epsilon_2"), "DC": ("a_D", "epsilon_4"), "CB": ("a_C", "epsilon_4")}


@dataclass
class Student(Hand):
    """A hand that finds some crossings too far from the pole, by a factor, and goes on from there.

    ``lab`` is what is drawn; ``off`` the factor by what is found; ``coriolis`` that of a Coriolis
    component that was computed wrong.
    """

    lab: str = ""
    off: Mapping[str, float] = field(default_factory=dict)
    coriolis: float = 1.0
    at: dict[str, complex] = field(default_factory=dict)
    bars: dict[str, float] = field(default_factory=dict)

    def crank(self, given: Data, length: float) -> tuple[complex, complex, complex]:
        """The crank, whose pin's images are kept."""
        pin, velocity, acceleration = super().crank(given, length)
        self.at |= {"v_A": velocity, "a_A": acceleration}
        return pin, velocity, acceleration

    def crossing(self, p: complex, way: complex, q: complex, other: complex) -> complex:
        """A crossing, perhaps at the wrong distance from the pole."""
        name = CROSSINGS[self.lab][sum(each in self.at for each in CROSSINGS[self.lab])]
        if name == "a_A3":
            self.at["laid back"] = q
            q = self.at["a_A"] + self.coriolis * (q - self.at["a_A"])
            self.at["k_3"] = q
        self.at[name] = super().crossing(p, way, q, other) * self.off.get(name, 1.0)
        return self.at[name]

    def relative_normal(self, arrow: complex, bar: complex) -> complex:
        """A normal component; its vectors and its bar are kept."""
        vector = super().relative_normal(arrow, bar)
        name = next(each for each in NORMALS[self.lab] if each not in self.bars)
        self.bars[name] = abs(bar)
        self.at |= {f"v_{name}": arrow, f"a_{name}_nu": vector}
        return vector

    def along(self, name: str, arrow: complex, way: complex, per_mm: float) -> None:
        """A vector along a direction; the block's acceleration from where Coriolis was laid off."""
        if name == "a_slide_2":
            arrow += self.at["k_3"] - self.at["laid back"]
        if name.startswith("epsilon"):
            self.at[name] = arrow
        super().along(name, arrow, way, per_mm)

    def hand_in(self) -> dict[str, float]:
        """Every field, those of MORE too."""
        for name in MORE[self.lab]:
            if name.endswith("_mm") and name not in self.found:
                arrow = self.arrow(name.removesuffix("_mm"))
                (self.velocity if name[0] == "v" else self.acceleration)(name[:-3], arrow)
        if "a_BA_nu" in MORE[self.lab] and "a_BA_nu" not in self.found:
            self.acceleration("a_BA_nu", self.at["a_BA_nu"])
        return self.found

    def arrow(self, name: str) -> complex:
        """A vector of the plans."""
        if name == "v_AA3":
            return self.at["v_A"] - self.at["v_A3"]
        if name == "a_AA3_cor":
            return self.at["a_A"] - self.at["k_3"]
        if name.endswith("_tau"):
            return self.at[TANGENTIAL[name[2:-4]][1]]
        return self.at[name]


@dataclass(frozen=True)
class Task:
    """What a student has before him: data, scales, and what the report prints of each field."""

    lab: str
    given: Data
    sheet: tuple[float, float, float]
    points: Mapping[str, float]
    tolerance: Mapping[str, float]

    @property
    def fields(self) -> tuple[str, ...]:
        """The fields in the order of the form."""
        return tuple(self.points)

    def drawn(self, rng: np.random.Generator | None = None, **how: object) -> dict[str, float]:
        """What is read off one drawing, by a pencil where there is ``rng``."""
        pencil = {"sigma": 0.1, "degrees": 0.1, "ruler": 0.05} if rng is not None else {}
        student = Student(*self.sheet, rng, **pencil, lab=self.lab, **how)
        hand.DRAW[self.lab](student, self.given)
        found = student.hand_in()
        return {name: found[name] for name in self.fields}

    @cached_property
    def key(self) -> dict[str, float]:
        """Every field as it is."""
        return self.drawn()

    def per_mm(self, field: str) -> float:
        """What a millimetre of the plan is worth."""
        _, kv, ka = self.sheet
        return (kv if field[0] == "v" else ka) / 1000

    def is_right(self, field: str, value: float) -> bool:
        """Whether an answer is right by the key; of what a drawing does not tell no sense is."""
        key = self.key
        if field.endswith("_sense"):
            sized = field.removesuffix("_sense")
            return value == key[field] or abs(key[sized]) <= self.tolerance[sized]
        if field.endswith(("_x_mm", "_y_mm")):
            return abs(value - key[field]) <= self.tolerance[field]
        return abs(abs(value) - abs(key[field])) <= self.tolerance[field]

    def is_easy(self, field: str, found: Mapping[str, float]) -> bool:
        """Whether a size is next to nothing, beside the key and what a drawing tells."""
        if field.endswith(("_x_mm", "_y_mm")):
            return False
        field = field.removesuffix("_sense")
        value, right = found[field], self.key[field]
        turned = f"{field}_sense" in self.points and value * right < 0
        least = 0.0 if turned else 0.1 * abs(right)
        return abs(value) <= max(least, 0.5 * self.tolerance[field])


@dataclass
class Set:
    """A set of answers as it is written, and the share that each field earns; what is left out
    can be told by nobody. ``cause`` is what explains it, which is paid once beside the fields.
    """

    texts: dict[str, str]
    earns: dict[str, float]
    cause: str = ""


Kind = Callable[[Task, np.random.Generator], Set | None]
KINDS: dict[str, Kind] = {}


def kind(made: Kind) -> Kind:
    """A kind of answers, by its name."""
    KINDS[made.__name__] = made
    return made


def written(found: Mapping[str, float], digits: int = 4) -> dict[str, str]:
    """Numbers as a student writes them: sizes without a sign, senses and places with it."""
    return {name: text_of(name, value, digits) for name, value in found.items()}


def text_of(name: str, value: float, digits: int = 4) -> str:
    """A number as it is written."""
    if name.endswith("_sense"):
        return "+" if value > 0 else "-"
    if name.endswith(("_x_mm", "_y_mm")):
        return f"{value:.{digits}g}"
    return f"{abs(value):.{digits}g}"


RATES = {
    "offset-slider-crank": {"omega_2": ("v_BA", 0.2)},
    "slotted-lever": {"omega_4": ("v_CB", 0.2), "omega_3": ("v_A3", 0.0)},
    "pump": {"omega_3": ("v_BA", 0.4), "omega_4": ("v_DC", 0.2), "omega_2": ("v_B", 0.3)},
}
"""Rates, each with its relative velocity and its bar in m; that of the slot is measured."""


def bar_of(task: Task, rate: str) -> tuple[str, float]:
    """The relative velocity of a rate, and its bar."""
    vector, bar = RATES[task.lab][rate]
    return vector, bar or task.key[vector] / abs(task.key[rate])


def as_written(text: str) -> float:
    """The number that is written; a sense as a sign."""
    return float(f"{text}1") if text in "+-" else float(text)


def follows_rightly(task: Task, rate: str, found: Mapping[str, float]) -> bool:
    """Whether a rate is the quotient of its own relative velocity, which is right, and its bar."""
    if rate not in RATES[task.lab]:
        return False
    vector, bar = bar_of(task, rate)
    quotient = found.get(vector, 0.0) / bar
    near = abs(abs(found[rate]) - quotient) <= 0.01 * quotient
    return near and task.is_right(vector, found[vector])


def marked(
    task: Task,
    found: Mapping[str, float],
    slip: str = "",
    lost: tuple[str, ...] = (),
    blank: tuple[str, ...] = (),
) -> Set:
    """What is right is right, what is ``lost`` earns nothing, nor does what is next to nothing; all
    else follows. What a slip gives is right, too, and what it leaves out may be blank.
    """
    texts = written(found)
    earns = {}
    for name in task.fields:
        if name in blank:
            texts[name], earns[name] = "", 1.0 if slip else 0.0
        elif task.is_right(name, as_written(texts[name])) or follows_rightly(task, name, found):
            earns[name] = 1.0
        elif name in lost or (not slip and task.is_easy(name, found)):
            earns[name] = 0.0
        elif not slip or abs(found[name]) > 0.5 * task.tolerance.get(name, 0.0):
            earns[name] = 1.0 if slip else FOLLOW
    missed = any(not task.is_right(n, as_written(t)) for n, t in texts.items() if t)
    return Set(texts, without_chance(task, earns), slip if missed else "")


def without_chance(task: Task, earns: Mapping[str, float]) -> dict[str, float]:
    """The shares, where a sense beside a size that earns nothing earns nothing."""
    found = dict(earns)
    for name in earns:
        sized = name.removesuffix("_sense")
        if name != sized and task.points[sized] and earns.get(sized) == 0.0:
            found[name] = 0.0
        elif name != sized and sized not in earns:
            del found[name]
    return found


def vectors(task: Task) -> list[str]:
    """Vectors of which segment and value are asked."""
    return [f for f in task.fields if f"{f}_mm" in task.fields]


def values(task: Task) -> list[str]:
    """The fields that are values."""
    return [f for f in task.fields if not f.endswith(("_mm", "_sense"))]


# --- right ---------------------------------------------------------------------------------------


@kind
def the_key(task: Task, rng: np.random.Generator) -> Set:
    """The key to three digits."""
    return Set(written(task.key, 3 + int(rng.integers(2))), dict.fromkeys(task.fields, 1.0))


@kind
def a_careful_drawing(task: Task, rng: np.random.Generator) -> Set:
    """A drawing of a quarter of a millimetre."""
    return marked(task, task.drawn(rng))


@kind
def commas_and_words(task: Task, rng: np.random.Generator) -> Set:
    """Decimal commas, and senses in three languages."""
    turning = {1: ("trigonometric", "antiorario", "ccw"), -1: ("în sens orar", "orario", "cw")}
    sliding = {1: ("înainte", "avanti", "forward"), -1: ("înapoi", "indietro", "backward")}
    texts = written(task.key)
    language = int(rng.integers(3))
    for name in texts:
        texts[name] = texts[name].replace(".", ",")
        if name.endswith("_sense"):
            words = sliding if "slide" in name else turning
            texts[name] = words[int(task.key[name])][language]
    return Set(texts, dict.fromkeys(task.fields, 1.0))


@kind
def other_units(task: Task, _: np.random.Generator) -> Set:
    """Centimetres, mm/s, cm/s², revolutions per minute, degrees."""
    texts = written(task.key)
    for name, value in task.key.items():
        if name.endswith("_sense"):
            continue
        if name.endswith("_mm"):
            texts[name] = f"{text_of(name, value / 10)} cm"
        elif name.startswith("omega"):
            texts[name] = f"{text_of(name, value * 30 / pi)} rot/min"
        elif name.startswith("epsilon"):
            texts[name] = f"{text_of(name, value * 180 / pi)} deg/s2"
        else:
            unit, times = ("mm/s", 1000) if name[0] == "v" else ("cm/s²", 100)
            texts[name] = f"{text_of(name, value * times)} {unit}"
    return Set(texts, dict.fromkeys(task.fields, 1.0))


@kind
def signs_for_senses(task: Task, _: np.random.Generator) -> Set:
    """A sign before the rate, the sense left blank."""
    texts = written(task.key)
    for name in task.fields:
        if name.endswith("_sense"):
            sized = name.removesuffix("_sense")
            texts[sized] = f"{task.key[sized]:+.4g}"
            texts[name] = ""
    return Set(texts, dict.fromkeys(task.fields, 1.0))


@kind
def half_filled(task: Task, rng: np.random.Generator) -> Set:
    """The accelerations are missing."""
    late = tuple(name for name in task.fields if name[0] in "aeJ")
    return marked(task, task.drawn(rng), blank=late)


@kind
def unreadable(task: Task, rng: np.random.Generator) -> Set:
    """Some cells are no numbers."""
    found = marked(task, task.drawn(rng))
    for name in rng.choice(values(task), 3, replace=False):
        found.texts[name], found.earns[name] = str(rng.choice(["12,3,4", "5o2", "3 or 4"])), 0.0
    return found


@kind
def signs_against_senses(task: Task, rng: np.random.Generator) -> Set:
    """A sign that contradicts the sense: the size counts, the sense earns nothing."""
    found = marked(task, task.drawn(rng))
    name = str(rng.choice([n for n in task.fields if n.endswith("_sense")]))
    sized = name.removesuffix("_sense")
    found.texts[sized] = f"{-task.key[sized]:+.4g}"
    if abs(task.key[sized]) > task.tolerance[sized]:
        found.earns[name] = 0.0
    return found


# --- slips ---------------------------------------------------------------------------------------


def slip_of(name: str, blank: tuple[str, ...] = ()) -> Kind:
    """Drawings in which something was understood wrongly all through."""

    def made(task: Task, rng: np.random.Generator) -> Set | None:
        if name.startswith("coriolis") and task.lab != "slotted-lever":
            return None
        try:
            found = task.drawn(rng, slips={name})
        except ValueError:  # the mechanism does not close
            return None
        missing = tuple(f for f in task.fields if f.startswith(blank)) if blank else ()
        return marked(task, found, name, (), missing)

    made.__name__ = name
    return kind(made)


NUS = ("a_BA_nu", "a_CB_nu")
for each in (
    "angle_clockwise",
    "driver_reversed",
    "rpm_as_rad",
    "wrong_scale",
    "normal_reversed",
    "coriolis_reversed",
):
    slip_of(each)
slip_of("normal_missing", blank=NUS)
slip_of("coriolis_missing", blank=("a_AA3_cor",))


@kind
def scale_missing(task: Task, rng: np.random.Generator) -> Set:
    """Velocities and accelerations are the millimetres that were measured."""
    found = task.drawn(rng)
    return marked(task, found | {v: found[f"{v}_mm"] for v in vectors(task)}, "scale_missing")


@kind
def normal_for_tangential(task: Task, rng: np.random.Generator) -> Set | None:
    """An angular acceleration from the normal component: one value, too little for a name; right
    with the cause paid, or wrong: the same mark.
    """
    bars = {"offset-slider-crank": ("epsilon_2", 0.2), "pump": ("epsilon_3", 0.4)}
    if task.lab not in bars:
        return None
    name, bar = bars[task.lab]
    found = task.drawn(rng)
    nu = found["a_BA_nu_mm"] * task.per_mm("a")
    made = marked(task, found | {name: nu / bar}, lost=(name,))
    for each in (name, f"{name}_sense"):
        made.earns.pop(each, None)
    return made


@kind
def power_of_ten(task: Task, rng: np.random.Generator) -> Set:
    """A comma in the wrong place."""
    name = str(rng.choice(vectors(task)))
    found = task.drawn(rng)
    return marked(task, found | {name: 10 * found[name]}, "power_of_ten")


@kind
def one_sense_reversed(task: Task, rng: np.random.Generator) -> Set:
    """One sense is wrong, for which the labs have no share."""
    name = str(rng.choice([n for n in task.fields if n.endswith("_sense")]))
    found = task.drawn(rng)
    return marked(task, found | {name: -task.key[name]}, lost=(name,))


@kind
def one_number_wrong(task: Task, rng: np.random.Generator) -> Set:
    """One value is wrong for no known reason, and nothing depends on it."""
    name = str(rng.choice(values(task)))
    found = task.drawn(rng)
    factor = float(rng.choice([0.43, 0.61, 1.41, 1.73, 2.6]))
    return marked(task, found | {name: factor * task.key[name]}, lost=(name,))


# --- what follows --------------------------------------------------------------------------------


@kind
def a_segment_misread(task: Task, rng: np.random.Generator) -> Set:
    """A value is right for the segment that was read."""
    name = str(rng.choice(vectors(task)))
    found = task.drawn(rng)
    length = found[f"{name}_mm"] * float(rng.choice([0.6, 1.4, 1.8]))
    own = {f"{name}_mm": length, name: length * task.per_mm(name)}
    return marked(task, found | own, lost=(f"{name}_mm",))


def from_own(plan: str) -> Kind:
    """Drawings in which a vector is too long or too short, and all after it is drawn from that."""

    def made(task: Task, rng: np.random.Generator) -> Set:
        names = [name for name in CROSSINGS[task.lab] if name[0] == plan]
        names = [name for name in names if f"{name}_mm" in task.fields]
        name = str(rng.choice(names))
        factor = float(rng.choice([0.6, 0.75, 1.3, 1.6]))
        return marked(task, task.drawn(rng, off={name: factor}), lost=(f"{name}_mm",))

    made.__name__ = f"from_own_{'velocity' if plan == 'v' else 'acceleration'}"
    return kind(made)


from_own("v")
from_own("a")


@kind
def a_rate_from_its_velocity(task: Task, rng: np.random.Generator) -> Set:
    """A relative velocity is misread; value and rate are right for it."""
    rate = str(rng.choice(list(RATES[task.lab])))
    vector, bar = bar_of(task, rate)
    found = task.drawn(rng)
    length = found[f"{vector}_mm"] * float(rng.choice([0.5, 1.5, 2.2]))
    speed = length * task.per_mm(vector)
    own = {f"{vector}_mm": length, vector: speed, rate: speed / bar}
    return marked(task, found | own, lost=(f"{vector}_mm",))


@kind
def a_rate_at_the_edge(task: Task, rng: np.random.Generator) -> Set:
    """A velocity is right, at 0.95 of its tolerance; the rate over a bar that is measured half a
    percent short is no longer, but follows from it: right.
    """
    rate = str(rng.choice(list(RATES[task.lab])))
    vector, bar = bar_of(task, rate)
    length = task.key[f"{vector}_mm"] + 0.95 * task.tolerance[f"{vector}_mm"]
    speed = length * task.per_mm(vector)
    own = {f"{vector}_mm": length, vector: speed, rate: speed / (0.995 * bar)}
    found = marked(task, task.key | own)
    found.earns |= dict.fromkeys((vector, rate), 1.0)
    return found


@kind
def a_rate_divided_wrong(task: Task, rng: np.random.Generator) -> Set:
    """A rate is wrong, and the normal component is computed from it as ω²·l and laid off."""
    rate, bar = {"offset-slider-crank": ("omega_2", 0.2), "pump": ("omega_3", 0.4)}.get(
        task.lab, ("omega_4", 0.0)
    )
    found = task.drawn(rng)
    own = {rate: found[rate] * float(rng.choice([0.7, 1.3, 1.5]))}
    if bar:
        own["a_BA_nu"] = own[rate] ** 2 * bar
        own["a_BA_nu_mm"] = own["a_BA_nu"] / task.per_mm("a")
    return marked(task, found | own, lost=(rate,))


@kind
def coriolis_of_own(task: Task, rng: np.random.Generator) -> Set | None:
    """ω or v is wrong, the Coriolis component 2·ω·v is right for it, and so is what is drawn."""
    if task.lab != "slotted-lever":
        return None
    name = str(rng.choice(["omega_3", "v_slide_2", "v_AA3"]))
    factor = float(rng.choice([0.6, 1.4, 1.7]))
    found = task.drawn(rng, coriolis=factor)
    found[name] *= factor
    if name == "v_slide_2":
        found["v_AA3"] *= factor  # from which the block's speed follows
        return marked(task, found, lost=("v_AA3",))
    return marked(task, found, lost=(name,))


@kind
def too_easy(task: Task, rng: np.random.Generator) -> Set:
    """A velocity next to nothing, and what follows from it: no marks for either."""
    rate = str(rng.choice(list(RATES[task.lab])))
    vector, bar = bar_of(task, rate)
    part = max((0.02, 0.05), key=lambda part: abs(log(part / task.per_mm("v"))))  # no slip's
    length = part * task.key[f"{vector}_mm"]
    speed = length * task.per_mm(vector)
    own = {f"{vector}_mm": length, vector: speed, rate: speed / bar}
    return marked(task, task.drawn(rng) | own, lost=tuple(own))


@kind
def turned_the_other_way(task: Task, _: np.random.Generator) -> Set | None:
    """An own acceleration from which an angular one of a tenth of its size turns the other way: it
    follows, and is no power of ten.
    """
    names = {
        "offset-slider-crank": ("a_B", "epsilon_2"),
        "slotted-lever": ("a_C", "epsilon_4"),
        "pump": ("a_D", "epsilon_4"),
    }
    vector, rate = names[task.lab]
    one, two = (task.drawn(off={vector: f})[rate] / task.key[rate] for f in (1.0, 1.1))
    factor = 1.0 + 0.1 * (-0.098 - one) / (two - one)
    if not 0.15 < factor < 10 or 0.06 * abs(task.key[rate]) < 0.55 * task.tolerance[rate]:
        return None
    found = task.drawn(off={vector: factor})
    return marked(task, found, lost=(f"{vector}_mm",))


def sets(task: Task, seed: int) -> Iterator[tuple[str, Set]]:
    """A set of each kind."""
    for number, (name, made) in enumerate(KINDS.items()):
        found = made(task, np.random.default_rng([seed, number]))
        if found is not None:
            yield name, found
