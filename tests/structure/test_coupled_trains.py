"""Trains in a loop: planets in series on a free arm, coupled sets, against Willis by fractions."""

from __future__ import annotations

import cmath
import math
import random
import re
from fractions import Fraction

import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import CoupledTrain, Higher
from graphkin.text.errors import GraphkinError
from tests.examples.scenes import FILES, mechanism, place, proved
from tests.scene_files import scene_text

HEAD = """graphkin = 1
title = "Train"
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
CONTACTS = {
    "gears-double-planet": {
        "driven": "1",
        "teeth": [
            (("1", 30), ("2", 18), "4"),
            (("2", 18), ("3", 18), "4"),
            (("0", -84), ("3", 18), "4"),
        ],
    },
    "gears-ravigneaux": {
        "driven": "1",
        "teeth": [
            (("1", 30), ("2", 18), "4"),
            (("0", 36), ("3", 18), "4"),
            (("2", 18), ("3", 18), "4"),
            (("3", 18), ("5", -72), "4"),
        ],
    },
    "gears-simpson": {
        "driven": "1",
        "teeth": [
            (("1", -66), ("2", 18), "4"),
            (("2", 18), ("3", 30), "4"),
            (("5", 18), ("3", 30), "0"),
            (("4", -66), ("5", 18), "0"),
        ],
    },
}
"""Who meshes with whom, with how many teeth (a ring's negative), about which arm."""


def ratios(driven: str, teeth: list) -> dict[str, Fraction]:
    """Every rate over the driven one: at each mesh z·(ω - ω_arm) is opposite and equal (Willis)."""
    names = sorted({name for (a, _), (b, _), arm in teeth for name in (a, b, arm)} - {"0", driven})
    rows = []
    for (a, za), (b, zb), arm in teeth:
        row = dict.fromkeys((*names, "0", driven), Fraction(0))
        row[a] += Fraction(za)
        row[b] += Fraction(zb)
        row[arm] -= Fraction(za) + Fraction(zb)
        rows.append([row[name] for name in names] + [-row[driven]])
    for column in range(len(names)):  # Gauss and Jordan
        lead = next(row for row in rows[column:] if row[column])
        rows.remove(lead)
        rows.insert(column, [value / lead[column] for value in lead])
        for row in rows:
            if row is not rows[column]:
                factor = row[column]
                row[:] = [x - factor * y for x, y in zip(row, rows[column], strict=True)]
    return {name: row[-1] for name, row in zip(names, rows, strict=False)}


@pytest.mark.parametrize("name", CONTACTS)
def test_every_rate_is_that_of_willis(name):
    found = proved(mechanism(name))
    driver = found.links["1"]
    for link, ratio in ratios(**CONTACTS[name]).items():
        assert found.links[link].omega == pytest.approx(float(ratio) * driver.omega, rel=1e-11)
        assert found.links[link].epsilon == pytest.approx(
            float(ratio) * driver.epsilon, rel=1e-10, abs=1e-10
        )


@pytest.mark.parametrize("name", CONTACTS)
@pytest.mark.parametrize("sweep", [10, 300])
def test_every_link_turns_as_far_as_its_ratio_says(name, sweep):
    """From one position of the driver to another, whole turns left aside."""
    before, after = (proved(mechanism(name, angle=angle)) for angle in (20, 20 + sweep))
    scene = mechanism(name).scene
    for link, ratio in ratios(**CONTACTS[name]).items():
        start, end = scene.link(link).points[:2]
        first, second = (place(each, end) - place(each, start) for each in (before, after))
        turned = cmath.phase(second / first) - math.radians(sweep) * float(ratio)
        turned = math.remainder(turned, math.tau)
        assert turned == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("name", CONTACTS)
@pytest.mark.parametrize("seed", range(3))
def test_the_order_in_which_links_are_written_does_not_matter(name, seed):
    head, *rest = FILES[name].read_text(encoding="utf-8").split("[links.")
    last, tail = rest[-1].split("[[drivers]]")
    links = [*rest[:-1], last]
    random.Random(seed).shuffle(links)
    text = "[links.".join([head, *links]) + "[[drivers]]" + tail
    shuffled = Mechanism(read_text(text, name))
    assert any(isinstance(group, CoupledTrain) for group in shuffled.groups)
    one, other = proved(mechanism(name)), proved(shuffled)
    for link, motion in one.links.items():
        assert other.links[link].omega == pytest.approx(motion.omega, rel=1e-10)
    for point, motion in one.points.items():
        assert abs(other.points[point].acceleration - motion.acceleration) < 1e-9


def series(radii: list[float], turned: list[float], ring: bool) -> tuple[str, dict]:
    """Planets in series from a driven sun to a fixed wheel, as TOML, and who meshes with whom."""
    at, text, contacts = 0j, "", []
    for k, (before, radius, angle) in enumerate(zip(radii, radii[1:], turned, strict=False), 2):
        at += cmath.rect(before + radius, angle)
        lies = f'{{ from = "O", length = {abs(at)!r}, angle = {math.degrees(cmath.phase(at))!r} }}'
        text += f"P{k} = {lies}\n" if k > 2 else f"O-P2 = {abs(at)!r}\n"
        contacts.append(((str(k - 1), before), (str(k), radius), "arm"))
    last = len(radii)
    fixed = abs(at) + radii[-1] if ring else abs(at) - radii[-1]
    contacts.append((("0", -fixed if ring else fixed), (str(last), radii[-1]), "arm"))
    wheels = [f"[links.1]\nO-S = {radii[0]!r}\n" + wheel("O", radii[0])]
    for k, radius in enumerate(radii[1:], 2):
        on = f"{{ on = {k - 1} }}" + (", { on = 0 }" if k == last else "")
        wheels.append(
            f"[links.{k}]\nP{k}-Q{k} = {radius!r}\n{wheel(f'P{k}', radius)}rolls = [{on}]\n"
        )
    frame = "[frame]\nO = [0, 0]\n" + wheel("O", fixed, inside=ring)
    drivers = "[[drivers]]\nturn = 1\nangle = 25\nspeed = 3\nacceleration = 7\n"
    return HEAD + "\n".join([frame, *wheels, "[links.arm]\n" + text, drivers]), contacts


def wheel(centre: str, radius: float, *, inside: bool = False) -> str:
    """A wheel as TOML."""
    ring = ", inside = true" if inside else ""
    return f'wheel = {{ centre = "{centre}", radius = {radius!r}{ring} }}\n'


@pytest.mark.parametrize("planets", [2, 3, 4, 5])
@pytest.mark.parametrize("seed", range(4))
def test_planets_in_series_turn_as_willis_says(planets, seed):
    """Sizes spread over a decade; a chain between a sun that drives and a fixed sun or ring."""
    chance = random.Random(f"{planets} {seed}")
    radii = [round(10 ** chance.uniform(1, 2), 3) for _ in range(planets + 1)]
    turned = [0.0, *(chance.uniform(-0.6, 0.6) for _ in range(planets - 1))]
    text, contacts = series(radii, turned, ring=seed % 2 == 0)
    found = Mechanism(read_text(text, "train"))
    assert [group.last.links[1] for group in found.groups if isinstance(group, CoupledTrain)]
    motion = proved(found)
    for link, ratio in ratios("1", contacts).items():
        assert motion.links[link].omega == pytest.approx(3 * float(ratio), rel=1e-9)
        assert motion.links[link].epsilon == pytest.approx(7 * float(ratio), rel=1e-8, abs=1e-9)


def test_a_train_that_leaves_its_arm_free_is_told():
    """A sun as large as the fixed one: three planets between them let the arm turn as it likes."""
    peak = (43.30127018922193 + math.sqrt(975)) / math.sin(math.radians(90))
    text, _ = series([30.0, 20.0, 20.0, 20.0], [0.0, 0.0, 0.0], ring=False)
    arm = f"""[links.arm]
O-P2 = 50
P3 = {{ from = "O", length = {peak!r}, angle = 30 }}
P4 = {{ from = "O", length = 50, angle = 60 }}
"""
    first, rest = text.split("[links.arm]")[0], text[text.index("[[drivers]]") :]
    text = re.sub(r'(centre = "O", radius = )[\d.]+', r"\g<1>30.0", first) + arm + rest
    with pytest.raises(GraphkinError, match="let link arm turn as it likes"):
        Mechanism(read_text(text, "train")).solve()


RATIOS = {"3": 1, "4": -2, "5": -2, "6": 4}
"""Over the arm's rate, in a fixed ring three times as large as planets and sun (Willis)."""


def test_an_idle_contact_of_a_second_planet_is_passed_over():
    """Two planets between one sun and one ring close in every place of the arm: a rod tells it."""
    found = Mechanism(read_text(scene_text("structure/two-planets-and-a-rod"), "rod"))
    assert not any(isinstance(group, CoupledTrain) for group in found.groups)
    motion = proved(found)
    arm = motion.links["3"]
    for link, ratio in RATIOS.items():
        assert motion.links[link].omega == pytest.approx(ratio * arm.omega, rel=1e-12)
        assert motion.links[link].epsilon == pytest.approx(ratio * arm.epsilon, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_an_idle_contact_is_passed_over_in_any_order_of_links(seed):
    """The wheel that the rod moves hangs on the ring, not on the other planet by way of the sun."""
    head, *links = scene_text("structure/two-planets-and-a-rod").split("[links.")
    last, tail = links[-1].split("[[drivers]]")
    links[-1] = last
    random.Random(seed).shuffle(links)
    text = "[links.".join([head, *links]) + "[[drivers]]" + tail
    found = Mechanism(read_text(text, "rod"))
    (group,) = (each for each in found.groups if isinstance(each, Higher))
    assert {*group.links} == {"2", "3", "4"}
    motion = proved(found)
    for link, ratio in RATIOS.items():
        assert motion.links[link].omega == pytest.approx(ratio * motion.links["3"].omega, rel=1e-12)


def test_ratios_that_cancel_for_any_parameter_are_idle():
    """Teeth z of the sun and p of the planets, z + 2p of the ring: idle whatever z and p are."""
    text = scene_text("structure/two-planets-and-a-rod")
    text = text.replace("module = 4\n", "module = 4\n[parameters]\nz = 20\np = 20\n")
    text = text.replace("teeth = 60", 'teeth = "z + 2*p"').replace(
        "O-P1 = 80", 'O-P1 = "2*(z + p)"'
    )
    text = text.replace("O-P2 = 80", 'O-P2 = "2*(z + p)"')
    text = text.replace('centre = "O", teeth = 20', 'centre = "O", teeth = "z"')
    text = re.sub(r'(centre = "P\d", teeth = )20', r'\1"p"', text)
    for settings in ({}, {"z": 24}, {"p": 18}):
        found = Mechanism(read_text(text, "rod", None, settings))
        assert not any(isinstance(group, CoupledTrain) for group in found.groups)
