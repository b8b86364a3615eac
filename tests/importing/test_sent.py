"""What goes out to Linkage and pylinkage comes back the same, and pylinkage moves it as we do."""

from __future__ import annotations

import json
from math import pi

import pytest
from click.testing import CliRunner

from graphkin.cli.main import app
from graphkin.documents.program_files import PROGRAMS, linkage_file, pylinkage_file
from graphkin.importing.formats import imported
from graphkin.importing.scene_text import scene_text
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import PageError

EVERYWHERE = (
    "pump",
    "crank-rocker",
    "slider-crank",
    "watt-2",
    "six-bar",
    "stephenson-1",
    "five-bar",
)
LINKAGE_ONLY = ("shaper", "crank-slot", "geneva-wheel")
CASES = [(name, program) for name in EVERYWHERE for program in ("linkage", "pylinkage")]
CASES += [(name, "linkage") for name in LINKAGE_ONLY]
STEP = 1e-5
MM = 0.001


def of(name: str) -> Mechanism:
    path = scene_files.examples().get(name)
    return Mechanism(read_text(path.read_text("utf-8"), name)) if path else load(name)


@pytest.mark.parametrize(("name", "program"), CASES)
def test_what_goes_out_comes_back_the_same(name, program):
    sent = of(name)
    text = PROGRAMS[program](sent).decode()
    back = Mechanism(read_text(scene_text(imported(text)).text, name))
    one, other = sent.solve(), back.solve()
    fastest = max(abs(complex(p.velocity)) for p in one.points.values() if p.velocity)
    compared = 0
    for point in (point for point in one.points if point in other.points and "@" not in point):
        there, here = one.points[point], other.points[point]
        assert abs(complex(there.position) - complex(here.position)) < 1e-8, point
        if there.velocity is not None and here.velocity is not None:
            assert abs(complex(there.velocity) - complex(here.velocity)) < 1e-6 * fastest, point
            compared += 1
    assert compared > 2


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "pump"])
def test_pylinkage_moves_what_is_sent_as_the_scene_moves(name):
    pylinkage = pytest.importorskip("pylinkage.mechanism")
    sent = of(name)
    data = json.loads(pylinkage_file(sent))
    solved = sent.solve()
    for link in data["links"]:
        if link["type"] == "driver":
            rate = link["angular_velocity"]
            link["angular_velocity"] = STEP
    mechanism = pylinkage.mechanism_from_dict(data)
    names = [joint.id for joint in mechanism.joints]
    steps = [dict(zip(names, places, strict=True)) for places in mechanism.step(iterations=2)]
    start = {joint["id"]: complex(*joint["position"]) for joint in data["joints"]}
    moving = 0
    for own in names:
        at = [start[own], *(complex(*step[own]) for step in steps)]
        found = solved.points[own]
        velocity = complex(found.velocity) / MM / rate if found.velocity else 0j
        assert (-3 * at[0] + 4 * at[1] - at[2]) / (2 * STEP) == pytest.approx(velocity, abs=1e-3)
        moving += bool(found.velocity)
    assert moving > 1


def test_a_file_of_linkage_counts_in_96ths_of_an_inch_and_turns_per_minute():
    text = linkage_file(of("slider-crank")).decode()
    scene = of("slider-crank").scene
    pin = of("slider-crank").solve().points[scene.link(scene.drivers[0].link).points[1]].position
    assert f'x="{complex(pin).real / 0.0254 * 96:.9f}"' in text
    speed = of("slider-crank").solve().links[scene.drivers[0].link].omega * 30 / pi
    assert f'rpm="{float(speed):.9f}"' in text


@pytest.mark.parametrize(
    ("name", "program", "words"),
    [
        ("gears-ring", "linkage", "Linkage has no wheels"),
        ("shaper", "pylinkage", "pylinkage has no guide that moves"),
        ("oldham", "linkage", "Linkage has no block with more than one point"),
        ("excavator-relative", "pylinkage", "drivers.2 turns no crank"),
    ],
)
def test_what_a_program_does_not_have_is_refused(name, program, words):
    with pytest.raises(PageError, match=words):
        PROGRAMS[program](of(name))


def test_the_command_writes_a_file_for_a_program(tmp_path):
    file, back = tmp_path / "pump.linkage2", tmp_path / "back.toml"
    run = CliRunner().invoke
    done = run(app, ["export", "pump", "--set", "n=7", "--to", "linkage", "-o", str(file)])
    assert done.exit_code == 0, done.output
    done = run(app, ["import", str(file), "-o", str(back)])
    assert done.exit_code == 0, done.output
    assert run(app, ["solve", str(back)]).exit_code == 0


def test_masses_and_loads_that_stay_behind_are_named(tmp_path):
    path = scene_files.examples()["slider-crank"]
    scene = tmp_path / "loaded.toml"
    load = '\n[[loads]]\nat = "B"\nforce = [10, 0]\n'
    scene.write_text(path.read_text("utf-8") + load, encoding="utf-8")
    done = CliRunner().invoke(app, ["export", str(scene), "--to", "linkage"])
    assert done.exit_code == 0
    assert "masses and loads are left out" in done.stderr
    assert "left out" not in CliRunner().invoke(app, ["export", str(path), "--to", "pmks"]).stderr
