"""A drawing of GeoGebra or DXF becomes the drawn mechanism, once its fixed points are named.

Places are those of the file; speeds are differences of closures found here.
"""

from __future__ import annotations

import io
import zipfile
from cmath import phase, pi, rect, sqrt

import pytest
from click.testing import CliRunner

from graphkin.cli.main import app
from graphkin.importing.formats import imported, text_of
from graphkin.importing.record import Completion
from graphkin.importing.scene_text import scene_text
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError

AT = {"A": 0j, "B": 20 + 30j, "C": 90 + 60j, "D": 100 + 0j, "P": 40 + 80j}
OMEGA = 2 * pi
STEP = 1e-6
FOUR_BAR = Completion(fixed=("A", "D"), drive=("A", "B"))


def point(name: str, place: complex, **show: str) -> str:
    return (
        f'<element type="point" label="{name}"><show object="{show.get("show", "true")}"/>'
        f'<coords x="{place.real * 2}" y="{place.imag * 2}" z="2.0"/></element>'
    )


def command(kind: str, out: str, *given: str, shown: str = "true") -> str:
    held = " ".join(f'a{number}="{each}"' for number, each in enumerate(given))
    return (
        f'<command name="{kind}"><input {held}/><output a0="{out}"/></command>'
        f'<element type="{kind.lower()}" label="{out}"><show object="{shown}"/></element>'
    )


def geogebra(*parts: str) -> bytes:
    text = (
        f'<?xml version="1.0"?><geogebra><construction>{"".join(parts)}</construction></geogebra>'
    )
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("geogebra_thumbnail.png", b"")
        archive.writestr("geogebra.xml", text)
    return stream.getvalue()


POINTS = tuple(point(name, place) for name, place in AT.items())
BARS = (
    command("Segment", "f", "A", "B"),
    command("Segment", "g", "C", "D"),
    command("Polygon", "t", "B", "C", "P"),
    command("Segment", "ground", "A", "D"),
)


def dxf(*lines: tuple[complex, complex], names: bool = True, unit: int = 4) -> str:
    parts = ["0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n", f"{unit}\n0\nENDSEC\n"]
    parts.append("0\nSECTION\n2\nENTITIES\n")
    for one, other in lines:
        parts.append(
            f"0\nLINE\n8\n0\n10\n{one.real}\n20\n{one.imag}\n11\n{other.real}\n21\n{other.imag}\n"
        )
    for name, place in AT.items() if names else ():
        parts.append(
            f"0\nTEXT\n8\n0\n10\n{place.real + 1}\n20\n{place.imag + 1}\n40\n3\n1\n{name}\n"
        )
    return "".join([*parts, "0\nENDSEC\n0\nEOF\n"])


LINES = tuple((AT[one], AT[other]) for one, other in ("AB", "BC", "CP", "PB", "CD"))


def opened(data: bytes | str, tracing: Completion) -> Mechanism:
    data = data.encode() if isinstance(data, str) else data
    return Mechanism(read_text(scene_text(imported(text_of(data), tracing)).text, "imported"))


def crossing(one: complex, a: float, other: complex, b: float, near: complex) -> complex:
    way = other - one
    along = (a * a - b * b + abs(way) ** 2) / (2 * abs(way))
    height = sqrt(a * a - along * along)
    both = [one + way / abs(way) * (along + sign * 1j * height) for sign in (1, -1)]
    return min(both, key=lambda place: abs(place - near))


def coupler_point(time: float) -> complex:
    """P of the four-bar, its crank turned by OMEGA times the time."""
    pin = AT["B"] * rect(1, OMEGA * time)
    end = crossing(pin, abs(AT["C"] - AT["B"]), AT["D"], abs(AT["C"] - AT["D"]), AT["C"])
    return pin + (AT["P"] - AT["B"]) * (end - pin) / (AT["C"] - AT["B"])


@pytest.mark.parametrize("data", [geogebra(*POINTS, *BARS), dxf(*LINES)], ids=["ggb", "dxf"])
def test_a_drawn_four_bar_moves_as_its_circles_cross(data):
    solved = opened(data, FOUR_BAR).solve()
    for name, place in AT.items():
        assert complex(solved.points[name].position) == pytest.approx(place / 1000, abs=1e-9)
    rate = (coupler_point(STEP) - coupler_point(-STEP)) / (2 * STEP)
    assert complex(solved.points["P"].velocity) == pytest.approx(rate / 1000, rel=1e-6)


def test_a_drawn_slider_crank_has_its_guide_from_the_words():
    """The guide is drawn too; it is a bar between a fixed point and one that slides."""
    at = {"O": 0j, "A": 30 + 40j, "B": 150 - 10j}
    parts = [point(name, place) for name, place in at.items()]
    parts += [command("Segment", name.lower(), *name) for name in ("OA", "AB", "OB")]
    tracing = Completion(("O",), ("O", "A"), {"B": "0"}, "cm")
    solved = opened(geogebra(*parts), tracing).solve()

    def slider(time: float) -> float:
        pin = at["A"] * rect(1, OMEGA * time)
        return (pin.real + sqrt(abs(120 - 50j) ** 2 - (pin.imag + 10) ** 2)).real / 100

    rate = (slider(STEP) - slider(-STEP)) / (2 * STEP)
    assert complex(solved.points["B"].velocity) == pytest.approx(rate, rel=1e-6)


def test_a_point_between_the_ends_of_a_bar_belongs_to_it():
    middle = (AT["B"] + AT["C"]) / 2
    lines = ((AT["A"], AT["B"]), (AT["B"], AT["C"]), (AT["C"], AT["D"]), (middle, middle + 40j))
    found = imported(dxf(*lines), FOUR_BAR)
    assert sorted(len(body.joints) for body in found.bodies.values()) == [2, 2, 2, 3]


def test_a_chain_of_segments_is_a_bar_for_each() -> None:
    chain = geogebra(*POINTS, command("PolyLine", "chain", "A", "B", "C", "D"))
    found = imported(text_of(chain), FOUR_BAR)
    assert sorted(body.joints for body in found.bodies.values()) == [
        ("A", "B"),
        ("B", "C"),
        ("C", "D"),
    ]


def test_a_point_without_a_place_is_none() -> None:
    lost = POINTS[0].replace('label="A"', 'label="Z"').replace('x="0.0"', 'x="Infinity"')
    assert "Infinity" in lost
    apart = POINTS[1].replace('label="B"', 'label="Y"').replace('z="2.0"', 'z="0.0"')
    assert imported(text_of(geogebra(lost, apart, *POINTS, *BARS)), FOUR_BAR).bodies


def test_a_title_block_is_left_out():
    frame = [(500 + 10j * n, 900 + 10j * n) for n in range(400)]
    found = imported(dxf(*LINES, *frame), FOUR_BAR)
    assert len(found.bodies) == 3
    assert any("not connected, and left out: points P" in note for note in found.notes)
    with pytest.raises(GraphkinError, match="more than 1000 lines"):
        imported(dxf(*frame, *frame, *frame), FOUR_BAR)


def test_the_unit_of_a_drawing_is_that_of_the_file():
    assert imported(dxf(*LINES, unit=1), FOUR_BAR).unit == "in"
    unknown = imported(dxf(*LINES, unit=0), FOUR_BAR)
    assert unknown.unit == "mm"
    assert any("no unit" in note for note in unknown.notes)


def test_what_is_hidden_is_no_bar_and_what_is_none_is_named():
    hidden = command("Segment", "h", "A", "C", shown="false")
    ends = command("Segment", "e", "(0,0)", "B")
    lone = point("Q", 5 + 5j)
    circle = command("Circle", "c", "A", "B").replace('type="circle"', 'type="conic"')
    found = imported(text_of(geogebra(*POINTS, lone, *BARS, hidden, ends, circle)), FOUR_BAR)
    assert len([body for body in found.bodies.values() if len(body.joints) == 2]) == 2
    said = " ".join(found.notes)
    for words in ("1 conic", "e has no points", "left out: points Q"):
        assert words in said, words


@pytest.mark.parametrize(
    ("tracing", "words"),
    [
        (Completion(), "does not say which points are fixed.*A .0, 0., B .20, 30."),
        (Completion(("A", "Z")), "no bar has a point Z"),
        (Completion(("A", "D"), ("B", "C")), "B-C is no bar with a fixed end"),
        (Completion(("A", "D"), slides={"A": "0"}), "both be fixed and slide"),
    ],
)
def test_what_a_drawing_lacks_is_asked_for(tracing, words):
    with pytest.raises(GraphkinError, match=words):
        imported(text_of(geogebra(*POINTS, *BARS)), tracing)


def test_archives_that_are_none_or_too_large_are_refused():
    other = io.BytesIO()
    with zipfile.ZipFile(other, "w") as archive:
        archive.writestr("else.xml", "<a/>")
    bomb = io.BytesIO()
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("geogebra.xml", b" " * (4 << 20))
    for data, words in (
        (other.getvalue(), "no geogebra.xml"),
        (bomb.getvalue(), "more than 2097152 bytes"),
        (b"PK\x03\x04broken", "no geogebra.xml"),
        (geogebra(*POINTS)[:200], "no geogebra.xml"),
        (b"AutoCAD Binary DXF\r\n\x1a\0", "binary DXF"),
    ):
        with pytest.raises(GraphkinError, match=words):
            imported(text_of(data), FOUR_BAR)
    many = geogebra(
        *(point(f"P{number}", number + 0j) for number in range(202)),
        *(command("Segment", f"s{n}", f"P{n}", f"P{n + 1}") for n in range(201)),
    )
    with pytest.raises(GraphkinError, match="200"):
        imported(text_of(many), Completion(("P0",)))


@pytest.mark.parametrize("cut", range(60, len(dxf(*LINES)), 97))
def test_a_dxf_file_that_breaks_off_is_refused_in_words_or_read(cut):
    try:
        scene_text(imported(dxf(*LINES)[:cut], FOUR_BAR))
    except GraphkinError as error:
        assert str(error)


def test_the_command_takes_the_words(tmp_path):
    drawing, scene = tmp_path / "four.ggb", tmp_path / "four.toml"
    drawing.write_bytes(geogebra(*POINTS, *BARS))
    words = ["--fixed", "A, D", "--drive", "A-B", "-o", str(scene)]
    done = CliRunner().invoke(app, ["import", str(drawing), *words])
    assert done.exit_code == 0, done.output
    assert CliRunner().invoke(app, ["solve", str(scene)]).exit_code == 0
    asked = CliRunner().invoke(app, ["import", str(drawing)])
    assert asked.exit_code == 2
    assert "--fixed with some of A (0, 0)" in asked.stderr
    wrong = CliRunner().invoke(app, ["import", str(drawing), "--slide", "C"])
    assert "write POINT=ANGLE" in wrong.stderr


def test_phase_of_the_crank_is_the_drawn_one():
    found = scene_text(imported(text_of(geogebra(*POINTS, *BARS)), FOUR_BAR)).text
    angle = next(line for line in found.splitlines() if line.startswith("angle = "))
    assert float(angle[8:]) == pytest.approx(phase(AT["B"]) * 180 / pi, abs=1e-6)
