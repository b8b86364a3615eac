"""A hand that has the printed pages alone lands on the key: every step, in millimetres of paper.

The pages are written as ``graphkin sheet`` writes them; ``tests.documents.reader`` follows their
sentences with ruler and compass. What a page does not carry is a defect of that page, listed here.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.cli.main import app
from tests.chosen import FOLDER
from tests.documents import reader
from tests.documents.reader import Followed, follow

CLOSE = 0.3
"""How near to the key, in mm, the hand must land."""
LABS = ("pump", "pump-collinear", "offset-slider-crank", "slotted-lever")
SCENES = (
    "centrodes-knee",
    "crank-fixed-slot",
    "crank-rocker",
    "crank-slot",
    "eight-link-1",
    "engine",
    "excavator-absolute",
    "excavator-relative",
    "five-bar",
    "four-bar-change-point",
    "four-bar-crank-rocker-crossed",
    "gears-pair",
    "gears-planet",
    "gears-profiles",
    "gears-ring",
    "jumper",
    "lifter",
    "mobility-five-bar",
    "mobility-parallel-cranks",
    "mobility-watt",
    "oscillating-slide",
    "roller",
    "six-bar",
    "slider-crank-slider",
    "stephenson-1",
    "stephenson-3",
    "toggle-press",
    "trammel",
    "two-loops",
    "watt-1",
    "watt-1-ternary",
    "watt-2",
    "watt-2-centre",
)
"""Not among them: what needs trials or a locus, Klein's construction, Kennedy's theorem."""
DEFECTS: dict[tuple[str, str], str] = {}
"""What a page does not carry, by scene and sheet."""


@cache
def followed(folder: Path, name: str) -> dict[str, Followed]:
    """What came of the sheets of a scene, written into a folder."""
    scene = name if name in LABS else str(FOLDER / f"{name}.toml")
    for view in ("key", "task"):
        options = ["-o", str(folder), "--lang", "en", "--format", "svg", "--view", view]
        result = CliRunner().invoke(app, ["sheet", scene, *options])
        assert result.exit_code == 0, result.output
    return dict(follow(folder, name))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("sheets")


def cases() -> list[object]:
    """Each sheet of each scene, with its defect where it has one."""
    return [
        pytest.param(
            name,
            sheet,
            id=f"{name}-{sheet}",
            marks=[pytest.mark.xfail(strict=True, reason=DEFECTS[name, sheet])]
            if (name, sheet) in DEFECTS
            else [],
        )
        for name in (*LABS, *SCENES)
        for sheet in ("velocity", "acceleration")
        if not (name.startswith("centrodes") and sheet == "acceleration")
    ]


@pytest.mark.parametrize(("name", "sheet"), cases())
def test_the_printed_sentences_lead_to_the_points_of_the_key(folder, name, sheet):
    done = followed(folder, name)[sheet]
    assert done.defect == "", f"step {done.step}"
    far = {point: away for point, away in done.deviations().items() if away > CLOSE}
    assert not far


def test_a_wrong_number_on_the_page_is_seen(folder):
    """2 mm more in one sentence, and the hand lands beside the key."""
    followed(folder, "engine")
    key, task = reader.sheets(folder, "engine", "velocity")
    right, wrong = (reader.Reader(key.data, key.scale, task.links, dict(task.marks)) for _ in "12")
    for sentence in key.sentences:
        right.follow(sentence)
        wrong.follow(sentence.replace("58.90 mm", "60.90 mm"))
    assert abs(right.place["b"] - wrong.place["b"]) == pytest.approx(2)
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


def test_the_reader_imports_nothing_of_graphkin():
    source = Path(reader.__file__).read_text(encoding="utf-8")
    assert "import graphkin" not in source
    assert "from graphkin" not in source
