"""PMKS+: the content of its links, new and old, of its ``.pmks`` files, and of its CSV files.

The new text has thousandths as numbers in base 64 and flags as bits (class StringTranscoder of
github.com/PMKS-Web/PMKSWeb); the old one has decimal numbers under ``j=``, ``l=``, ``f=``, ``s=``.
Until July 2023 PMKS+ saved CSV: a table each of joints, links, forces and settings.

PMKS, the program before PMKS+: the content of its links, ``mech=`` and ``set=``.

Each joint has the names of its links, its type, place, angle in degrees and four flags, the last of
them for the driver, with commas or blanks between them: ``ground,crank,R,0,0,tfft|``. A pin in a
slot (RP) does not say which of its links has the slot, and a gear (G) has no size.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator, Mapping
from itertools import takewhile
from math import pi, radians
from urllib.parse import parse_qs

from msgspec import Struct
from msgspec.structs import replace

from graphkin.documents.program_files import (
    ALPHABET,
    EXACT,
    GROUND,
    INPUT,
    LETTER_OF_LENGTH,
    PRISMATIC,
    PROGRAM,
    THOUSANDTH,
)
from graphkin.importing.record import (
    DrawnGuide,
    DrawnInput,
    DrawnJoint,
    DrawnLink,
    DrawnLoad,
    DrawnMass,
    Imported,
    damaged,
    few,
    letter_of,
    named,
    number,
    one_at_welds,
    refused,
    unknown_unit,
)
from graphkin.scene.quantity import METRES
from graphkin.text.errors import Message, message

UNITS = {"0": "in", "1": "cm", "2": "m"}
OLD_UNITS = {"cm": "cm", "m": "m", "in": "in", "inch": "in"}
USUAL = "cm"
UNITS_OF_FORCE = {"0": 4.4482216152605, "1": 1.0}
"""Newtons in one unit of force: pounds, newtons."""
POUND = 0.45359237
UNITS_OF_MASS = {"in": (POUND, POUND * 0.0254**2), "cm": (1e-3, 1e-4), "m": (1.0, 1.0)}
"""Kilograms and kg·m² in one unit of mass and of moment of inertia, by the unit of length: lb and
lb·in²; g, but kg·cm²; kg and kg·m² (the examples of github.com/PMKS-Web/PMKSWeb)."""
UNTOUCHED, UNSET = 1.0, "Null"
"""The mass of a link that nobody has changed, and that of a piston in an old text."""
LOCAL, OUTWARD = 1, 2
"""Flags of a force: it turns with its link; its arrow points away from the link."""
CLOCKWISE, GRAVITY = 1, 2
WELDED = 8
CLOSE = 1.5 / THOUSANDTH
"""The distance under which two joints are in one place."""
DIGITS = 12
"""The most digits of a number."""
NUMBER_OF_OLD_FIELDS = 8
TABLES = ("joints", "links", "forces", "settings")
"""The tables of a CSV file; a line of one cell begins each, and their heads follow."""


class PmksJoint(Struct, frozen=True):
    """A joint as the text has it; ``slot`` is the link of a moving guide and two of its joints."""

    joint: DrawnJoint
    driven: bool
    prismatic: bool
    angle: float
    slot: tuple[str, ...] = ()
    welded: bool = False


def new_text(text: str) -> Imported:
    """The mechanism of a new link, from what follows its question mark, or of a file."""
    said, last = text[:-1], text[-1:]
    if LETTER_OF_LENGTH[len(said) % len(LETTER_OF_LENGTH)] != last:
        raise refused(
            message("the last letter does not fit the length of the text"),
            message("the whole link, or the whole file"),
        )
    flags, _, speeds, units, rest = said.split(".", 4)
    parts = iter(rest.split("."))
    lines, links, forces = (list(takewhile(bool, parts)) for _ in range(3))
    few(len(lines))
    found = dict(map(new_joint, lines))
    bodies: dict[str, DrawnLink] = {}
    weights: dict[str, WrittenMass] = {}
    parts_of_links: dict[str, DrawnLink] = {}
    welded: set[str] = set()
    for line in links:
        own, name, *others = line[2:].split(",")
        held = others[5:]
        if line[0] == "Y":
            mass, inertia = (whole(text) / THOUSANDTH for text in others[:2])
            weights[own] = WrittenMass(mass, inertia, complex(*map(decimal, others[2:4])))
        end = held.index("")
        (bodies if line[0] == "Y" else parts_of_links)[own] = DrawnLink(name, tuple(held[:end]))
        welded |= {*held[end + 1 :]} if line[0] == "Y" else set()
    notes = list[Message]()
    loads = []
    for force in forces:
        if (load := add_load(force, units, found, bodies, notes)) is not None:
            loads.append(load)
    notes += [
        message("link {name} is a part of no other and is left out", name=named(part.name))
        for own, part in parts_of_links.items()
        if own not in welded
    ]
    settings = ALPHABET.index(flags[-1])
    unit = unit_of(units[:1], UNITS, notes)
    holders = one_at_welds([own for own, each in found.items() if each.welded], bodies)
    masses = tuple(place_masses(weights, holders, found, bodies, unit))
    speed = rpm(speeds) * (-1 if settings & CLOCKWISE else 1)
    mechanism = gathered(found, bodies, unit, speed, notes)
    return replace(
        mechanism,
        loads=tuple(replace(load, body=holders[load.body]) for load in loads),
        masses=masses,
        gravity=bool(masses and settings & GRAVITY),
    )


class WrittenMass(Struct, frozen=True):
    """The mass of a link as the text has it: mass, moment of inertia, centre."""

    mass: float
    inertia: float
    centre: complex


def place_masses(
    weights: Mapping[str, WrittenMass],
    holders: Mapping[str, str],
    found: dict[str, PmksJoint],
    bodies: dict[str, DrawnLink],
    unit: str,
) -> Iterator[DrawnMass]:
    """The masses of the links, where somebody has changed one.

    Welded links have one mass, at their common centre (Steiner's theorem).
    """
    if all(weight.mass == UNTOUCHED for weight in weights.values()):
        return
    kilograms, inertia_unit = UNITS_OF_MASS[unit]
    for body in bodies:
        held = [weight for own, weight in weights.items() if holders[own] == body]
        if mass := kilograms * sum(weight.mass for weight in held):
            centre = sum(kilograms * w.mass * w.centre for w in held) / mass
            own_inertia = inertia_unit * sum(weight.inertia for weight in held)
            moved = sum(kilograms * w.mass * abs(w.centre - centre) ** 2 for w in held)
            joint = joint_at(found, bodies, body, centre, "S")
            yield DrawnMass(body, joint, mass, own_inertia + moved * METRES[unit] ** 2)


def joint_at(
    found: dict[str, PmksJoint],
    bodies: dict[str, DrawnLink],
    own: str,
    at: complex,
    name: str,
) -> str:
    """The joint of a link at a place: its own, or a new one."""
    here = (joint for joint in bodies[own].joints if joint in found)
    near = next((joint for joint in here if abs(found[joint].joint.at - at) < CLOSE), "")
    if near:
        return near
    joint = f"{name} of {own}"
    found[joint] = PmksJoint(DrawnJoint(name, at), driven=False, prismatic=False, angle=0.0)
    bodies[own] = DrawnLink(bodies[own].name, (*bodies[own].joints, joint))
    return joint


def add_load(
    force: str,
    units: str,
    found: dict[str, PmksJoint],
    bodies: dict[str, DrawnLink],
    notes: list[Message],
) -> DrawnLoad | None:
    """A force on a link, at a new joint of the link where it has none; a note where it is lost.

    The force points from its first place to its second, or back where its arrow points inwards.
    """
    flags, (_, own, name, *numbers) = ALPHABET.index(force[0]), force[1:].split(",")
    x, y, to_x, to_y, size = map(decimal, numbers)
    at, way = complex(x, y), complex(to_x, to_y) - complex(x, y)
    unit = UNITS_OF_FORCE.get(units[2:3])
    if own not in bodies or not way or unit is None:
        notes.append(left_out(name))
        return None
    if flags & LOCAL:
        notes.append(message("force {name} keeps its direction, as now", name=named(name)))
    joint = joint_at(found, bodies, own, at, name)
    sense = 1 if flags & OUTWARD else -1
    return DrawnLoad(own, joint, sense * size * unit * way / abs(way))


def unit_of(name: str, known: Mapping[str, str], notes: list[Message]) -> str:
    """The unit of length of a text; where it is unknown that of PMKS+ itself, with a note."""
    if name not in known:
        notes.append(unknown_unit(name, USUAL))
    return known.get(name, USUAL)


def rpm(speeds: str) -> float:
    """The speed: whole, or exact where a third number says so and agrees with it."""
    rounded, *others = map(whole, speeds.split(","))
    exact = others[1] / EXACT if len(others) > 1 else rounded
    return exact if round(exact) == rounded else rounded


def new_joint(line: str) -> tuple[str, PmksJoint]:
    """A joint of the new text, after its id."""
    flags, (own, name, x, y, angle, *slot) = ALPHABET.index(line[0]), line[1:].split(",")
    place = complex(decimal(x), decimal(y))
    joint = DrawnJoint(name, place, bool(flags & GROUND))
    return own, PmksJoint(
        joint,
        bool(flags & INPUT),
        bool(flags & PRISMATIC),
        decimal(angle),
        tuple(slot),
        bool(flags & WELDED),
    )


def old_text(text: str) -> Imported:
    """The mechanism of an old link, from what follows its question mark."""
    fields = parse_qs(text, keep_blank_values=True, max_num_fields=NUMBER_OF_OLD_FIELDS)
    lines = [line.split(",") for line in fields["j"][0].splitlines() if line]
    few(len(lines))
    found: dict[str, PmksJoint] = {}
    for own, x, y, _, kind, fixed, angle, driven, *_ in lines:
        joint = DrawnJoint(own, complex(number(x), number(y)), fixed == "t")
        turned = number(angle) if kind == "P" else 0.0
        found[own] = PmksJoint(joint, driven == "t", kind == "P", turned)
    bodies = {}
    masses = []
    for line in filter(None, fields["l"][0].splitlines()):
        own, _, mass, _, _, _, held, *_ = line.split(",")
        masses.append(mass)
        bodies[own] = DrawnLink(own, tuple(held.split("|")))
    forces = fields.get("f", [""])[0].splitlines()
    notes = [left_out(force.split(",")[0]) for force in filter(None, forces)]
    notes += masses_left_out(masses)
    speed, clockwise, _, unit = fields["s"][0].strip().split(",")[:4]
    signed = number(speed, -1.0 if clockwise == "true" else 1.0)
    return gathered(found, bodies, unit_of(unit, OLD_UNITS, notes), signed, notes)


def csv_text(text: str) -> Imported:
    """The mechanism of a CSV file."""
    rows = tables(text)
    few(len(rows["joints"]))
    found: dict[str, PmksJoint] = {}
    for row in rows["joints"]:
        prismatic = row["type"] == "P"
        place = complex(number(row["x"]), number(row["y"]))
        joint = DrawnJoint(row["id"], place, row["ground"] == "true")
        angle = number(row["angle"]) if prismatic else 0.0
        found[row["id"]] = PmksJoint(joint, row["input"] == "true", prismatic, angle)
    bodies = {
        row["id"]: DrawnLink(row["id"], tuple(row["joints"].split(","))) for row in rows["links"]
    }
    notes = [left_out(row["id"]) for row in rows["forces"]]
    notes += masses_left_out(row.get("mass", UNSET) for row in rows["links"])
    settings = rows["settings"][0]
    speed = number(settings["input_speed_mag"], -1.0 if settings["clockwise"] == "true" else 1.0)
    return gathered(found, bodies, unit_of(settings["unit"], OLD_UNITS, notes), speed, notes)


def tables(text: str) -> dict[str, list[dict[str, str]]]:
    """The rows of each table of a CSV file, by their heads. Raises ValueError for broken quotes."""
    found: dict[str, list[dict[str, str]]] = {name: [] for name in TABLES}
    name, heads = "", list[str]()
    try:
        for row in csv.reader(text.splitlines(), strict=True):
            cells = [cell.strip() for cell in row]
            if len(cells) == 1 and cells[0] in TABLES:
                name, heads = cells[0], []
            elif name and not heads:
                heads = cells
            elif any(cells):
                found[name].append(dict(zip(heads, cells, strict=False)))
    except csv.Error:
        raise ValueError from None
    return found


def gathered(
    found: Mapping[str, PmksJoint],
    bodies: Mapping[str, DrawnLink],
    unit: str,
    speed: float,
    notes: Iterable[Message],
) -> Imported:
    """The mechanism of joints and links; a prismatic joint is the guide of the link that has it."""
    few(len(bodies))
    messages = list(notes)
    guides, inputs, held = [], [], {}
    for own, body in bodies.items():
        if not all(joint in found for joint in body.joints):
            raise damaged()
        sliding = [joint for joint in body.joints if found[joint].prismatic]
        others = tuple(joint for joint in body.joints if joint not in sliding)
        first = next((j for j in others if sliding and same(found, j, sliding[0])), None)
        kept = others if first else body.joints
        held[own] = DrawnLink(body.name, kept)
        for joint in sliding:
            drawn, start = found[joint], first or joint
            if drawn.slot:
                on, one, other = drawn.slot
                guides.append(DrawnGuide(own, start, on, (one, other)))
            else:
                guides.append(DrawnGuide(own, start, angle=drawn.angle))
            if drawn.driven:
                messages.append(
                    message(
                        "the speed {speed} is taken as {unit} per second along the guide",
                        speed=f"{speed:g}",
                        unit=unit,
                    )
                )
                inputs.append(DrawnInput(own, speed))
    for guide in guides:
        if guide.along and not {*guide.along} <= {*held[guide.on].joints}:
            raise damaged()
    for own, drawn in found.items():
        if drawn.driven and not drawn.prismatic:
            at = [name for name, body in held.items() if own in body.joints]
            if not at or (not drawn.joint.fixed and len(at) < 2):
                raise damaged()
            against = "" if drawn.joint.fixed else at[1]
            inputs.append(DrawnInput(at[0], speed, own, against))
    used = {joint for body in held.values() for joint in body.joints}
    joints = {
        own: DrawnJoint(drawn.joint.name, drawn.joint.at, drawn.joint.fixed and not drawn.prismatic)
        for own, drawn in found.items()
        if own in used
    }
    return Imported(
        PROGRAM, unit, 1 / THOUSANDTH, joints, held, tuple(guides), tuple(inputs), tuple(messages)
    )


def same(found: Mapping[str, PmksJoint], one: str, other: str) -> bool:
    """Whether two joints are drawn in one place."""
    return abs(found[one].joint.at - found[other].joint.at) < CLOSE


def left_out(force: str) -> Message:
    return message("force {name} is left out", name=named(force))


def masses_left_out(masses: Iterable[str]) -> Iterator[Message]:
    """A note where somebody has changed a mass in an old text or a CSV file."""
    if any(mass != UNSET and number(mass) != UNTOUCHED for mass in masses):
        yield message("the masses of the links are left out")


def decimal(text: str) -> float:
    """A number of thousandths."""
    return number(str(whole(text)), 1 / THOUSANDTH)


def whole(text: str) -> int:
    """A whole number in base 64; a zero before it makes it negative."""
    if not text or len(text) > DIGITS:
        raise damaged()
    value = 0
    for sign in text:
        value = len(ALPHABET) * value + ALPHABET.index(sign)
    return -value if text[0] == "0" else value


OLD_PROGRAM = "PMKS"
FRAME_NAME = "ground"
TYPES = ("R", "P", "RP", "G")
ROUNDING = 1e-3
MOST_FIELDS = 8


def mech_text(text: str) -> Imported:
    """The mechanism of a link, from what follows its question mark.

    Raises SceneError for a pin in a slot and for a gear, too.
    """
    fields = parse_qs(text, keep_blank_values=True, max_num_fields=MOST_FIELDS)
    said = fields["mech"][0].replace("\n", "|").split("|")
    lines = [line.replace(",", " ").split() for line in said]
    lines = [line for line in lines if line]
    few(len(lines))
    joints: dict[str, DrawnJoint] = {}
    held: dict[str, list[str]] = {}
    guides: list[DrawnGuide] = []
    inputs: list[DrawnInput] = []
    speed = next((s[1:] for s in fields.get("set", [""])[0].split("|") if s[:1] == "s"), "1")
    for place, line in enumerate(lines):
        own = letter_of(place)
        kind = next((each for each in line if each in TYPES), None)
        if kind is None:
            raise damaged()
        links, (x, y, *others) = line[: line.index(kind)], line[line.index(kind) + 1 :]
        if kind not in ("R", "P") or not links or (kind == "P" and len(links) != 2):
            raise refused(
                message(
                    "joint {name} is of kind {kind} between {count} links",
                    name=own,
                    kind=named(kind),
                    count=len(links),
                ),
                message("pins, and blocks between two links"),
            )
        *angles, flags = others
        driven = flags[3:4] in ("t", "+", "1")
        moving = [link for link in dict.fromkeys(links) if link != FRAME_NAME]
        few(len(lines) + len(held) + len(moving))
        fixed = FRAME_NAME in links
        joints[own] = DrawnJoint(own, complex(number(x), number(y)), fixed and kind == "R")
        if not moving or (driven and len(links) < 2):
            raise damaged()
        for link in moving if kind == "R" else moving[:1]:
            held.setdefault(link, []).append(own)
        against = "" if fixed else moving[-1]
        if kind == "P":
            angle = radians(number(angles[0] if angles else "0"))
            guides.append(DrawnGuide(moving[0], own, against, angle=angle))
        if driven:
            rate = number(speed)
            about = DrawnInput(moving[0], rate * 30 / pi, own, against)
            inputs.append(about if kind == "R" else DrawnInput(moving[0], rate))
    bodies = {link: DrawnLink(link, tuple(owns)) for link, owns in held.items()}
    notes = [message("lengths have no unit in the file; mm are written")]
    if inputs:
        notes.append(message("the speed {speed} is taken as radians per second", speed=speed))
    return Imported(
        OLD_PROGRAM, "mm", ROUNDING, joints, bodies, tuple(guides), tuple(inputs), tuple(notes)
    )
