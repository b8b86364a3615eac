"""The gallery shows everything there is, as it is on paper, and the same at every run."""

import re
from pathlib import Path

import numpy as np
import pytest

from graphkin.scene.scene_files import names
from tests.gallery.__main__ import README, main
from tests.gallery.pages import SCENES, STUDENTS, Subject, pages_of, subjects
from tests.gallery.pixels import GUTTER, picture, side_by_side, stacked

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "graphkin" / "manual" / "pictures"
WHITE = 255


def test_every_lab_and_every_scene_is_shown_once():
    shown = [(subject.name, subject.n) for subject in subjects()]
    assert len(set(shown)) == len(shown)
    assert set(shown) == {(lab, n) for lab in names() for n in STUDENTS} | {
        (path.stem, None) for path in SCENES.glob("*.toml")
    }


def test_the_pictures_of_the_readme_are_those_that_the_command_makes():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    linked = re.findall(r"!\[[^]]*\]\(graphkin/manual/pictures/(\S+-key)\.png\)", text)
    assert sorted(linked) == sorted(README)
    assert all((PICTURES / f"{name}.png").is_file() for name in linked)
    guide = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert "python -m tests.gallery -o" in guide


@pytest.mark.parametrize("dpi", [30, 50])
def test_a_page_is_drawn_to_scale_with_its_frame(dpi):
    """The frame of ISO 5457: 20 mm from the left edge, 10 mm from the others."""
    (page,) = pages_of(Subject("pump", 7), "key", "en")["velocity"]
    pixels = picture(page, "black", dpi)
    assert pixels.shape[:2] == (int(297 * dpi / 25.4), int(420 * dpi / 25.4))
    dark = pixels.mean(axis=2) < WHITE / 2
    down = dark.sum(axis=0) > 0.7 * 277 * dpi / 25.4
    frame = np.flatnonzero(down) * 25.4 / dpi
    for edge in (20, 410):
        assert abs(frame - edge).min() < 25.4 / dpi


def test_contact_sheets_leave_white_between_pages():
    dark = np.zeros((4, 6, 3), dtype=np.uint8)
    row = side_by_side([dark, dark])
    assert row.shape == (4, 2 * (6 + GUTTER), 3)
    sheet = stacked([row, side_by_side([dark])])
    assert sheet.shape == (2 * (4 + GUTTER), row.shape[1], 3)
    assert (sheet == 0).sum() == 3 * dark.size


def test_the_same_pictures_come_out_of_every_run(tmp_path, capsys):
    for run in ("one", "other"):
        main(["-o", str(tmp_path / run), "--only", "gears-rack", "--jobs", "1"])
    (one,), (other,) = ((tmp_path / run).glob("*.png") for run in ("one", "other"))
    assert one.read_bytes() == other.read_bytes()
    assert "gears-rack" in capsys.readouterr().out
