"""Mechanisms for seeds: which kinds of groups there are, and which of them a seed has."""

from __future__ import annotations

from random import Random

from tests.chance import cams, groups, ropes, trains
from tests.chance.maker import LooseError, Maker
from tests.chance.records import Standing

GROUPS = {
    "crank": groups.crank,
    "driven slide": groups.driven_slide,
    "RRR": groups.rrr,
    "RRP": groups.rrp,
    "RPR": groups.rpr,
    "PRP": groups.prp,
    "RPP": groups.rpp,
    "cylinder": groups.cylinder,
    "three legs": groups.three_legs,
    "two plates": groups.two_plates,
    "loop of four": groups.loop_of_four,
    "inner turn": groups.inner_turn,
    "inner slide": groups.inner_slide,
    "parallel cranks": groups.parallel_cranks,
    "rolled": groups.rolled,
    "RRW": groups.rrw,
    "rim pin": groups.rim_pin,
    "gear": groups.gear,
    "rack": groups.rack,
    "pinion": groups.pinion,
    "roller": groups.roller,
    "planet": groups.planet,
    "kept bar": groups.kept_bar,
    "cam": cams.cam,
    "belt": groups.belted,
    "series": groups.series,
    "twins": groups.twins,
    "plank": groups.plank,
    "coupled plates": groups.coupled_plates,
    "ring of plates": groups.ring_of_plates,
    "slid cam": cams.slid_cam,
    "swung cam": cams.swung_cam,
    "plate cam": cams.plate_cam,
    "plate lever": cams.plate_lever,
    "hoist": ropes.hoist,
    "differential": ropes.differential,
    "spool": ropes.spool,
    "frame drum": ropes.frame_drum,
    "rope": ropes.rope,
    "rope levers": ropes.rope_levers,
    "free wheel": ropes.free_wheel,
    "touching": ropes.touching,
    "platform": ropes.platform,
    "by time": ropes.by_time,
    "compound": trains.compound,
    "lever gear": trains.lever_gear,
    "simpson": trains.simpson,
}
STARTS = ("crank", "crank", "driven slide", "rolled", "parallel cranks", "gear")
TRIES = 60
ADDED = {
    "kept bar": (13, 5),
    "cam": (11, 7),
    "belt": (9, 7),
    "series": (13, 9),
    "twins": (17, 3),
    "plank": (17, 11),
    "coupled plates": (23, 4),
    "ring of plates": (23, 18),
    "slid cam": (41, 0),
    "swung cam": (41, 1),
    "plate cam": (41, 2),
    "plate lever": (41, 4),
    "hoist": (41, 13),
    "differential": (41, 14),
    "spool": (41, 17),
    "frame drum": (41, 18),
    "rope": (41, 20),
    "rope levers": (41, 22),
    "free wheel": (41, 23),
    "touching": (41, 25),
    "platform": (41, 26),
    "by time": (41, 29),
    "compound": (41, 32),
    "lever gear": (41, 36),
    "simpson": (41, 38),
}
"""Groups at the end of every so many seeds, those that leave such a rest.

Thus a new kind of group changes no other seed: tests name seeds for what is special in them.
"""

LATER = [name for name, (each, _) in ADDED.items() if each == 41]
"""Those on which at times another group is hung."""


def add(m: Maker, kind: str) -> bool:
    """Add a group of a kind; False where none was found that holds together."""
    for _ in range(TRIES):
        try:
            with m.group():
                GROUPS[kind](m)
        except (LooseError, IndexError):
            continue
        return True
    return False


def made(seed: int) -> tuple[Standing, tuple[str, ...]]:
    """A mechanism for a seed, and the kinds of its groups in the order made."""
    rng = Random(seed)
    spread = rng.choice((1.0, 1.0, 2.0, 3.0))
    m = Maker(rng, spread, 10 ** rng.uniform(-3, 3))
    kinds = [rng.choice(STARTS)]
    names = [name for name in GROUPS if name not in ADDED]
    last = names[seed % len(names)]
    kinds += [rng.choice(names[:8]) for _ in range(rng.randint(0, 2))]
    added = [name for name, (each, rest) in ADDED.items() if seed % each == rest]
    kinds += [last, *added]
    more = Random(f"more {seed}")
    if any(name in LATER for name in added) and more.random() < 0.5:
        kinds.append(more.choice(names[:8]))
    done = tuple(kind for kind in kinds if add(m, kind))
    return m.standing, done
