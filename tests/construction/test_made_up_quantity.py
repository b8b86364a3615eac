"""A quantity added as CONTRIBUTING says, to a copy of the package, is found wherever any is.

The made-up turning point T of a link is its instantaneous centre under another name. Its record,
its key of [ask], its field, its construction and its independent route are all that is added.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import graphkin

PACKAGE = Path(graphkin.__file__).parent
ADDED = {
    "scene/model.py": [("    curves: PointNames = ()\n", "    turnings: LinkNames = ()\n")],
    "construction/core/quantities.py": [
        (
            '    centre("inflection centre",',
            '    centre("turning", "links", "turning_point", "velocity", "T", "turning point", '
            '"turnings"),\n',
        ),
        ("    inflection_pole: Ratio | None", "    turning_point: Ratio | None = None\n"),
    ],
    "construction/compile.py": [
        (
            "    for name in pen.scene.ask.curvature:\n",
            "    from graphkin.construction.centres import made_up\n\n"
            "    for base in bases:\n"
            "        if base.link in pen.scene.ask.turnings:\n"
            "            made_up.draw(pen, base)\n",
        )
    ],
    "loops/differences.py": [
        ('    "pole": of_centres', '    "turning": of_centres(left_at_centre),\n')
    ],
    **{
        f"text/{language}.toml": [
            ('centrodes = "', 'turnings = "T {list}"\nturnings_many = "T {list}"\n'),
            ('pole = "{legend}', 'turning = "what turns"\n'),
        ]
        for language in ("en", "ro", "it")
    },
}
"""What is written into each file, and the text before which it is written."""
LEGENDS = {"en": "acceleration pole:", "ro": "polul accelerațiilor:", "it": "polo delle"}
MADE_UP = """
from graphkin.construction.centres.instant_centre import two_points
from graphkin.construction.centres.instant_centre import InstantCentre


class TurningPoint(InstantCentre, frozen=True, kw_only=True):
    letter = "T"


def draw(pen, base):
    pen.want("turning", base.link, TurningPoint.draw(pen, base, two_points(pen, base)))
"""
SCENE = """graphkin = 1
title = "four-bar"
units = { length = "mm", angle = "deg", speed = "rev/min" }
[frame]
O1 = [0, 0]
O2 = [150, 0]
[links.1]
O1-A = 60
[links.2]
A-B = 130
[links.3]
O2-B = 110
[[drivers]]
turn = 1
angle = 70
speed = 60
[branches]
B = "left of A-O2"
[ask]
velocity = ["B"]
turnings = [2, 3]
"""
LOOK = """
import json, sys
import tomlkit
from graphkin.classroom.lab.items import asked_fields
from graphkin.classroom.lab.new_lab import meaning
from graphkin.cli.report.catalogue import ask_words
from graphkin.cli.report.cycle_report import cycle_table
from graphkin.cli.report.solution_record import motion_text
from graphkin.cli.report.solution_record import record
from graphkin.classroom.grading.probes import probes
from graphkin.documents.sheet import asked_words, sheet
from graphkin.documents.sheet_documents import drawings_of
from graphkin.loops.witness import examine
from graphkin.mechanism import load
from graphkin.motion.cycle import cycle
from graphkin.studio.building import Act, built
from graphkin.studio.panels import results
from graphkin.text import words
from graphkin.web.screen_sheets import screen_sheets
from graphkin.web.step_page import meanings

one = load(sys.argv[1])
solution = one.solve()
verdict = one.witness(solution)
found = record(one.scene, solution, verdict, None)
drawing = drawings_of(one, verdict, words("en"), None)[0]
items = asked_fields(one)
places = [item for item in items.values() if item.quantity == "turning"]
text = open(sys.argv[1]).read()
left = tomlkit.parse(built(text, Act("delete", ("3",), 0j, {}, words="link")).text)
print(json.dumps({
    "agrees": verdict.agrees,
    "json": found["links"]["2"]["turning_point"],
    "centre": found["links"]["2"]["instant_centre"],
    "only asked": [*record(one.scene, solution, verdict, None, asked=True)["links"]["2"]],
    "text": motion_text(one.scene, solution, found, verdict),
    "witnessed": [*examine(one.scene, solution, None).differences.names],
    "fields": [item.field for item in places],
    "probes": len(probes(one, places)),
    "meaning": meaning(items["T_2_x_mm"]),
    "list": ask_words(one.scene.ask),
    "asked": [*asked_words(drawing)],
    "marks": sorted({mark.name for mark in sheet(drawing, "key", "1/2")[0].marks if mark.name}),
    "panel": results([drawing], solution),
    "legend": [*meanings(words("en"), screen_sheets(one, "en"))],
    "cycle": cycle_table(cycle(one, steps=8)).partition("\\n")[0].split(","),
    "after deleting link 3": left["ask"]["turnings"].unwrap(),
}))
"""


def added(folder: Path, *, without: str = "") -> Path:
    """A copy of the package with the made-up quantity, but for what one file needs."""
    shutil.copytree(PACKAGE, folder / "graphkin", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "graphkin/construction/centres/made_up.py").write_text(MADE_UP, encoding="utf-8")
    for name, some in ADDED.items():
        path = folder / "graphkin" / name
        text = path.read_text(encoding="utf-8")
        for before, what in some if name != without else ():
            at = before.format(legend=LEGENDS.get(path.stem, "")) if "{" in before else before
            assert at in text, (name, at)
            text = text.replace(at, what + at, 1)
        path.write_text(text, encoding="utf-8")
    scene = folder / "made-up.toml"
    scene.write_text(SCENE, encoding="utf-8")
    return scene


def looked(folder: Path, scene: Path) -> subprocess.CompletedProcess[str]:
    """What the copy says of a scene."""
    own = {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-c", LOOK, str(scene)]
    return subprocess.run(
        command, cwd=folder, env=own, capture_output=True, encoding="utf-8", check=False
    )


def test_a_quantity_added_to_the_list_is_found_everywhere(tmp_path):
    ran = looked(tmp_path, added(tmp_path))
    assert ran.returncode == 0, ran.stderr
    seen = json.loads(ran.stdout)
    assert seen["agrees"]
    assert seen["json"] == pytest.approx(seen["centre"])
    assert seen["only asked"] == ["turning_point"]
    assert "turning point, m" in seen["text"]
    assert "links.2.turning_point" in seen["witnessed"]
    assert seen["fields"] == ["T_2_x_mm", "T_2_y_mm", "T_3_x_mm", "T_3_y_mm"]
    assert seen["probes"] == 4
    assert seen["meaning"].startswith("turning point of link 2:")
    assert "turning points of 2 and 3" in seen["list"]
    assert "T 2, 3" in seen["asked"]
    assert {"T2", "T3"} <= {*seen["marks"]}
    assert ">T</" in seen["panel"]
    assert ["*T*", "what turns"] in seen["legend"]
    assert {"Tx_2 [m]", "Ty_2 [m]"} <= {*seen["cycle"]}
    assert seen["after deleting link 3"] == [2]


def test_a_quantity_without_an_independent_route_is_refused(tmp_path):
    ran = looked(tmp_path, added(tmp_path, without="loops/differences.py"))
    assert ran.returncode != 0
    assert "no independent route gives this quantity" in ran.stderr
