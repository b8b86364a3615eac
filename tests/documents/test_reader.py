"""A hand that has the printed pages alone lands on the key: every step, in millimetres of paper.

The pages are written as ``graphkin sheet`` writes them; ``tests.documents.reader`` follows their
sentences with ruler and compass, and a page that does not carry enough stops it at that step.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.cli.main import app
from tests.chosen import EVERY, FOLDER, SCENES
from tests.documents import printed_sheet, reader, ruler_and_compass
from tests.documents.reader import Followed, follow

CLOSE = 0.3
"""How near to the key, in mm, the hand must land."""
LABS = ("pump", "pump-collinear", "slotted-lever") if EVERY else ("pump", "pump-collinear")
APART = {
    "gears-kutzbach": "Kutzbach’s plan, which stands where the hand likes on its axis",
    **dict.fromkeys(("plank-axle", "plank-two-sizes"), "a wheel that slips while links move"),
    **dict.fromkeys(("plates-coupled", "plates-ring"), "a link tried while another is moved"),
}
"""What the reader has no rule for, by the scenes that need it."""
ALIKE = {name for name in SCENES if name.startswith("four-bar-")} - {
    "four-bar-change-point",
    "four-bar-crank-rocker-crossed",
}
KNOWN = tuple(name for name in SCENES if name not in {*APART, *ALIKE})
SOME = {
    *("bar-on-roller", "belts-arm", "cam-lever", "cam-roller", "centrodes-roller", "crank-slot"),
    *("engine", "excavator-relative", "gears-rack", "hoist-differential", "inflection-cardan"),
    *("instant-centres", "jumper", "klein-engine", "oldham", "platform-3rpr", "rapid-return"),
    *("roller-plates", "stephenson-2-binary", "stephenson-2-ternary", "watt-2", "wheel-in-ring"),
    *("mobility-watt", "platform-six", "trammel"),
}
"""Those that have every form of every sentence that any has."""
READ = tuple(name for name in KNOWN if EVERY or name in SOME)
"""Those of which the reader knows every sentence."""
VELOCITIES = {name for name in READ if name.startswith(("centrodes", "instant"))}
VELOCITIES |= {"gears-double-planet", "link-motion"}
"""Scenes that ask for no accelerations."""

LEFT_OUT = (
    "step {} leaves out a normal component of {} mm as too short to be drawn: {} falls {} mm off"
)
DEFECTS = {
    "watt-2": LEFT_OUT.format(4, 0.43, "d′", 0.69),
}
"""Why the accelerations of a page lead farther from the key than they should."""


@cache
def followed(folder: Path, name: str) -> dict[str, Followed]:
    """What came of the sheets of a scene, written into a folder, anew if the hand stopped there."""
    scene = name if name in LABS else str(FOLDER / f"{name}.toml")
    for view in ("key", "task"):
        options = ["-o", str(folder), "--lang", "en", "--format", "svg", "--view", view, "--force"]
        result = CliRunner().invoke(app, ["sheet", scene, *options])
        assert result.exit_code == 0, result.output
    return dict(follow(folder, name))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("sheets")


CASES = [
    pytest.param(
        name,
        sheet,
        marks=[pytest.mark.xfail(strict=True, reason=DEFECTS[name])]
        if sheet == "acceleration" and name in DEFECTS
        else [],
    )
    for name in (*LABS, *READ)
    for sheet in ("velocity", "acceleration")
    if sheet == "velocity" or name not in VELOCITIES
]


@pytest.mark.parametrize(("name", "sheet"), CASES)
def test_the_printed_sentences_lead_to_the_points_of_the_key(folder, name, sheet):
    done = followed(folder, name)[sheet]
    assert done.defect == "", f"step {done.step}"
    far = {point: away for point, away in done.deviations().items() if away > CLOSE}
    assert not {point for point in far if not (done.tried and point[0] in "nk" and "_" in point)}


def test_a_wrong_number_on_the_page_is_seen(folder):
    """A velocity laid off half as long, and the hand lands beside the key; so does one told so."""
    followed(folder, "engine")
    key, task = reader.sheets(folder, "engine", "velocity")
    right, wrong = (reader.Reader(key.data, key.scale, task.links, dict(task.marks)) for _ in "12")
    for sentence in key.sentences:
        right.follow(sentence)
        half = re.sub(
            r"([\d.]+) times as long as (\S+) is drawn: [\d.]+ mm",
            lambda found: f"{float(found[1]) / 2:g} times as long as {found[2]} is drawn",
            sentence,
        )
        wrong.follow(half)
    away = abs(right.place["b"] - right.place["o"])
    assert abs(wrong.place["b"] - wrong.place["o"]) == pytest.approx(away / 2)
    assert right.place["B"] == wrong.place["B"]


def test_a_side_that_is_not_told_is_a_defect(folder):
    followed(folder, "pump")
    key, task = reader.sheets(folder, "pump", "velocity")
    hand = reader.Reader(key.data, key.scale, task.links, dict(task.marks))
    hand.follow(key.sentences[0])
    with pytest.raises(reader.DefectError, match="2 crossings lie where B"):
        hand.follow(key.sentences[1].split(", right of")[0])
    with pytest.raises(reader.DefectError, match="C has no place yet"):
        hand.follow(key.sentences[3])


def test_a_bar_laid_off_along_the_other_tangent_of_a_roller_is_seen(folder):
    followed(folder, "bar-on-roller")
    key, task = reader.sheets(folder, "bar-on-roller", "velocity")
    for data in (
        key.data.replace("right-hand side", "left-hand side"),
        key.data.replace("the farther of", "the nearer of"),
    ):
        assert data != key.data
        hand = reader.Reader(data, key.scale, task.links, dict(task.marks))
        with pytest.raises(reader.DefectError, match=r"link 2 was found .* from where it is laid"):
            for sentence in key.sentences:
                hand.follow(sentence)


def test_a_wheel_in_a_ring_whose_radius_is_not_told_has_no_place(folder):
    followed(folder, "wheel-in-ring")
    key, task = reader.sheets(folder, "wheel-in-ring", "velocity")
    data = key.data.replace("wheel 1: centre P, r_{1} = 50 mm", "wheel 1: centre P")
    assert data != key.data
    hand = reader.Reader(data, key.scale, task.links, dict(task.marks))
    with pytest.raises(reader.DefectError, match="no radius is told of a wheel about P"):
        hand.follow(key.sentences[0])


def test_the_reader_imports_nothing_of_graphkin():
    for module in (reader, printed_sheet, ruler_and_compass):
        source = Path(module.__file__).read_text(encoding="utf-8")
        assert "import graphkin" not in source
        assert "from graphkin" not in source


@pytest.mark.parametrize("name", (*LABS, *READ))
def test_a_task_gives_the_hand_no_more_than_fixed_points_and_the_pole(folder, name):
    for sheet in followed(folder, name):
        key, task = reader.sheets(folder, name, sheet)
        hand = reader.Reader(key.data, key.scale, task.links, dict(task.marks))
        assert set(task.marks) - set(hand.frame) == {"o" if sheet == "velocity" else "o′"}
