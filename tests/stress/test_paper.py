"""Plans that leave the paper: a scale that fits, or a page that says that it does not."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import PageError, WitnessError
from tests.documents.sheet_tools import within
from tests.stress.cases import Case, DrivenSlide, FourBar, Lever, SliderCrank, commanded, statuses

ASK = "velocity = ['A', 'B']\nacceleration = ['A', 'B']"
WILD: list[Case] = [
    DrivenSlide(at="3999999/1000000"),
    DrivenSlide(at="399999999/100000000"),
    Lever(bars=("1", "1", "3"), at="1/10"),
    FourBar(bars=("2", "4", "2", "4"), at="1/50"),
    SliderCrank(bars=("1", "100001/100000", "0"), at="90"),
    SliderCrank(bars=("1", "1000000", "0")),
    FourBar(bars=("1/1000000", "3", "2", "3")),
    FourBar(speed="1000000000"),
    FourBar(speed="0"),
]
"""Vectors up to a million times those of the driver, bars a million times the crank."""


@pytest.mark.parametrize("case", WILD, ids=lambda case: f"{type(case).__name__}-{case.at}")
@pytest.mark.parametrize("view", ["key", "task"])
def test_the_plans_of_wild_motions_stay_on_the_paper(case, view):
    """Beside a dead point a plan is a thousand times as large: its scale makes room for it."""
    sheets = hand_out(replace(case, ask=ASK).mechanism(), view=view)
    assert [sheet.kind for sheet in sheets] == ["velocity", "acceleration", "calculation"]
    for sheet in sheets:
        for page in sheet.pages:
            assert all(within(mark, (0, 0, page.width, page.height)) for mark in page.marks)


@pytest.mark.parametrize(("scale", "status"), [("1", 2), ("10", 2), ("20", 0), ("200", 0)])
def test_a_scale_that_is_asked_fits_or_is_refused(scale, status, tmp_path):
    """Three metres at 1:10 would need a table: the least scale that fits is named."""

    class Scaled(FourBar):
        def text(self) -> str:
            return f"{super().text()}[sheet]\nscale = {scale}\n"

    said = commanded(Scaled(), tmp_path, ["sheet"])
    assert statuses(said) == {"sheet": status}
    if status:
        words = said["sheet"].stderr
        assert "sheet.scale: does not fit" in words
        assert "write scale = 20, or leave it out" in words
        with pytest.raises(PageError):
            hand_out(Mechanism(read_text(Scaled().text(), "hard", None, {})))


def test_what_no_pencil_can_draw_is_not_handed_out(tmp_path):
    """Below the fair sine there is no sheet, and the status is that of an unfair question."""
    flat = DrivenSlide(at="3999999999/1000000000")
    with pytest.raises(WitnessError, match="nearly singular"):
        hand_out(flat.mechanism())
    assert statuses(commanded(flat, tmp_path, ["sheet"])) == {"sheet": 1}
