"""A plate hides none of the wheels that it bears, nor those that roll in them."""

from __future__ import annotations

from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.documents.made_up import board_of, of_kind
from tests.scene_files import scene_text


def test_the_rotor_of_an_engine_shows_its_ring_and_the_wheel_in_it():
    rotor = Mechanism(read_text(scene_text("construction/wankel-rotor"), "made", None, {}))
    for drawing in drawings_of(rotor, proved(rotor, rotor.solve()), words("en")):
        board, _ = board_of(drawing)
        (plate,), wheels = of_kind(board, "plate"), of_kind(board, "wheel")
        assert {wheel.name for wheel in wheels} == {"0", "rotor"}
        assert min(map(board.marks.index, wheels)) > board.marks.index(plate)
