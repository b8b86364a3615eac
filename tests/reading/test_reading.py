"""Photographs of simulated students: whose, where, what is right; and what is refused."""

from __future__ import annotations

import csv
import io
import itertools
import json
import re
import secrets
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import cast
from wsgiref.util import setup_testing_defaults

import cv2
import msgspec
import numpy as np
import pypdfium2
import pytest
from click.testing import CliRunner, Result
from msgspec.structs import replace
from PIL import Image
from pypdf import PdfWriter

from graphkin.accuracy.pencil import Pencil
from graphkin.classroom.grading.probes import Probe, probes
from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.personal import modules
from graphkin.classroom.roster.students import Taker
from graphkin.cli.main import app
from graphkin.construction.core.program import Plane
from graphkin.drawing.field import A3
from graphkin.reading import read_run, registration
from graphkin.reading.codes import code_among, codes_in
from graphkin.reading.desk_app import DeskSession, DrawingDesk, desk_application, desk_page
from graphkin.reading.drawn_answers import drawn_items, is_followed
from graphkin.reading.drawn_ink import DENSITY as INK
from graphkin.reading.drawn_ink import DrawnInk, fitted, offsets, refined
from graphkin.reading.lettered_points import LetteredSheet
from graphkin.reading.marked_drawing import (
    GREEN,
    RED,
    MarkedSheet,
    as_page,
    as_pdf,
    drawings_of_class,
    sentence,
)
from graphkin.reading.pictures import Photograph, Unreadable, grey_of, photographs
from graphkin.reading.point_reader import PointReader
from graphkin.reading.point_reading import PointReading
from graphkin.reading.point_search import (
    DRAWINGS,
    ExpectedPlace,
    LinesCrossing,
    PointSearch,
    along_way,
    expected,
)
from graphkin.reading.read_run import ReadOutcome, read_order
from graphkin.reading.read_sheet import (
    Grid,
    SheetRecord,
    code_of_halves,
    known_code,
    last_drawn,
    read_one,
)
from graphkin.reading.read_sheet import sheets_of as sheets_read
from graphkin.reading.settled_points import (
    READING,
    SETTLED,
    PointDecision,
    SettledPoints,
    kept,
    records_in,
    settled_points,
)
from graphkin.studio.guard import Guard
from graphkin.studio.session import PageRequestError
from graphkin.text import words
from graphkin.text.errors import PageError, Refusals
from tests.bench.reading import lab_of
from tests.chosen import EVERY
from tests.reading.camera import Picture, Shot, photograph, scan
from tests.reading.hand import DrawnSheet, Habits, drawn_sheet, printed, sheets_of

ROSTER = "Nr.;Matricol;Nume;Grupa\n7;0042;Ana Pop;A\n12;0043;Dan Ion;A\n"
XS, YS = [20.0, 120.0, 215.0, 310.0, 410.0], [10.0, 80.0, 150.0, 220.0, 287.0]
SHOTS = {
    "plain": Shot(size=(3000, 2250)),
    "hard": Shot(
        size=(3000, 2250), tilt=22, k1=-0.06, bow=4, turn=93, light=0.4, shadow=True, blur=0.9
    ),
}


def call(*words: object) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)


@pytest.fixture(scope="module", autouse=True)
def salt() -> Iterator[None]:
    """One seed, one picture: the codes of classes, which are printed, hang on no chance."""
    count = itertools.count()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(secrets, "token_hex", lambda size: f"{next(count):02x}" * size)
        yield


@pytest.fixture(scope="module")
def a_class(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("class")
    (folder / "class.csv").write_text(ROSTER, encoding="utf-8")
    call("variants", "pump", folder / "class.csv", "-o", folder / "class")
    return folder / "class"


@pytest.fixture(scope="module")
def code(a_class: Path) -> str:
    manifest = json.loads((a_class / "manifest.json").read_text(encoding="utf-8"))
    return str(manifest["students"][0]["code"])


@pytest.fixture(scope="module")
def taken(a_class: Path, code: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Photographs of one student's sheets, right and wrong, with their readings."""
    folder = tmp_path_factory.mktemp("photos")
    drawings = {
        "plain": drawn_sheet(a_class, code, "velocity", Habits(point=0.3, line=0.3), 13),
        "hard": drawn_sheet(a_class, code, "acceleration", Habits(point=0.4, mistake=True), 5),
    }
    for name, drawing in drawings.items():
        taken = photograph(drawing.image, SHOTS[name], 7)
        (folder / f"{name}.jpg").write_bytes(with_place(taken.data))
        truth = {"map": taken.where(grid_places()).tolist(), "points": points_of(drawing)}
        (folder / f"{name}.json").write_text(json.dumps(truth), encoding="utf-8")
    (folder / "grid").write_text(json.dumps({"x": XS, "y": YS}), encoding="utf-8")
    found = call(
        "read", a_class, folder / "plain.jpg", folder / "hard.jpg", "-o", folder / "read",
        "--json", "--grid", folder / "grid", "--jobs", "1",
    )  # fmt: skip
    assert found.exit_code == 0, found.output
    return folder


def with_place(data: bytes) -> bytes:
    """A JPEG as a telephone writes it: with the place where it was taken."""
    exif = Image.Exif()
    exif[0x010F] = "Telephone of Ana"
    exif.get_ifd(0x8825)[1] = "N"
    out = io.BytesIO()
    Image.open(io.BytesIO(data)).save(out, "JPEG", quality=90, exif=exif.tobytes())
    return out.getvalue()


def grid_places() -> np.ndarray:
    return np.stack(np.meshgrid(XS, YS), axis=-1).reshape(-1, 2)


def points_of(drawing: DrawnSheet) -> list[object]:
    return [[p.name, p.step, p.at, p.verdict] for p in drawing.points]


def read_and_true(taken: Path, name: str) -> tuple[dict, dict]:
    found = json.loads((taken / f"{name}.points.json").read_text(encoding="utf-8"))
    return found, json.loads((taken / f"{name}.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", SHOTS)
def test_a_sheet_is_found_by_its_frame(taken: Path, code: str, name: str) -> None:
    found, true = read_and_true(taken, name)
    assert (found["format"], found["code"], found["refused"]) == (1, code, None)
    off = np.hypot(*(np.array(found["map"]) - np.array(true["map"])).T)
    assert np.median(off) < 0.5  # pixels, of about 7 a mm
    assert np.percentile(off, 95) < 1.0


@pytest.mark.parametrize("name", SHOTS)
def test_points_are_read_where_they_were_drawn(taken: Path, name: str) -> None:
    found, true = read_and_true(taken, name)
    by_step = {point["step"]: point for point in found["points"]}
    placed = []
    for letter, step, at, verdict in true["points"]:
        point = by_step[step]
        assert point["name"] == letter
        assert point["ask"] or point["verdict"] == verdict, letter
        close = point["at"] is not None and np.hypot(*(np.array(point["at"]) - at)) < 1.0
        assert close or point["ask"], letter
        placed.append(close)
    assert np.mean(placed) >= (1.0 if name == "plain" else 0.6)


def test_nobody_is_asked_of_a_right_sheet_and_of_every_mistake_somebody_is(taken: Path) -> None:
    right, _ = read_and_true(taken, "plain")
    assert not any(point["ask"] for point in right["points"] if point["name"] != "I3")
    hard, true = read_and_true(taken, "hard")
    wrong = {step for _, step, _, verdict in true["points"] if verdict == "wrong"}
    assert wrong
    assert all(point["ask"] for point in hard["points"] if point["step"] in wrong)


def test_pictures_are_read_alike_in_any_order(a_class: Path, taken: Path) -> None:
    order = read_order(read_edition(a_class), Grid())
    last_drawn.cache_clear()
    for name in ("hard", "plain", "hard"):
        again = read_one(order, Photograph(name, taken / f"{name}.jpg"), "").record
        before = kept(taken / "read", name)
        assert before is not None
        assert (again.points, again.corners) == (before.points, before.corners)


def test_a_lab_that_was_changed_gives_new_sheets(a_class: Path, code: str) -> None:
    order = read_order(read_edition(a_class), Grid())
    taker, lab = order.takers[code], order.order.lab
    before = sheets_read(order.order, taker, "en")
    rubric = replace(lab.rubric, point=2 * lab.rubric.point)
    changed = replace(order.order, lab=replace(lab, rubric=rubric))
    assert sheets_read(changed, taker, "en").lab.rubric == rubric
    renamed = replace(taker, student=replace(taker.student, name="Ana"))
    assert sheets_read(order.order, renamed, "en").taker.student.name == "Ana"
    assert sheets_read(order.order, taker, "en").lab == before.lab


def test_lengths_on_the_drawing_are_the_answers(a_class: Path, taken: Path, code: str) -> None:
    drawing = sheets_of(a_class, code).drawings[0]
    _, true = read_and_true(taken, "plain")
    d = next(np.array(at) for name, _, at, _ in true["points"] if name == "d")
    from graphkin.construction.core.layout import lay_out

    length = np.hypot(*(d - np.array(lay_out(drawing).plan(0j))))
    head, row = (taken / "read" / "answers.csv").read_text().splitlines()[:2]
    told = dict(zip(head.split(","), row.split(","), strict=True))
    assert told["id"] == "0042"
    assert abs(float(told["v_D_mm"]) - length) < 0.6


def test_grade_marks_what_was_read(a_class: Path, taken: Path, tmp_path: Path) -> None:
    found = call("grade", a_class, taken / "read", "-o", tmp_path / "report", "--format", "html")
    assert found.exit_code in (0, 1), found.output
    marks = (tmp_path / "report" / "marks.csv").read_text(encoding="utf-8-sig").splitlines()
    assert any("0042" in line for line in marks), marks


def a_probe(a_class: Path, name: str) -> Probe:
    opened = read_edition(a_class)
    every = probes(opened.book.mechanism({"n": "7"}), drawn_items(opened))
    return next(each for each in every if each.item.field == name)


@pytest.mark.parametrize(
    ("tail", "tip", "follows"),
    [
        (None, "follows", True),
        ("right", "follows", True),
        ("follows", "follows", True),
        ("wrong", "follows", False),
        ("follows", "right", False),
        (None, "wrong", False),
    ],
)
def test_a_length_follows_whose_tip_does_and_whose_tail_is_not_wrong(
    a_class: Path, tail: str | None, tip: str, follows: bool
) -> None:
    probe = a_probe(a_class, "v_D_mm")
    first, last = probe.steps[0], probe.steps[-1]
    verdicts = {last: tip} if tail is None else {first: tail, last: tip}
    assert is_followed(probe, verdicts) is follows


def test_what_is_decided_to_follow_earns_follow(a_class: Path, taken: Path, tmp_path: Path) -> None:
    """The lecturer moves d by 12 mm and says that it follows; the mark is not that of the key."""
    out = shutil.copytree(taken / "read", tmp_path / "read")
    session = DeskSession(out, words("en"))
    assert session.drawings is not None
    d = next(point for point in session.drawings.records["plain"].points if point.name == "d")
    assert d.at is not None
    earned = {}
    for verdict in ("wrong", "follows"):
        said = {"sheet": "plain", "step": d.step, "verdict": verdict, "at": [d.at[0] + 12, d.at[1]]}
        session.decide(json.dumps(said).encode())
        report = tmp_path / verdict
        found = call("grade", a_class, out, "-o", report, "--format", "html")
        assert found.exit_code in (0, 1), found.output
        with (report / "marks.csv").open(encoding="utf-8-sig", newline="") as stream:
            row = next(row for row in csv.DictReader(stream) if row["id"] == "0042")
        earned[verdict] = float(row["v_D_mm"]), row["v_D_mm why"]
    assert earned["wrong"][0] == 0
    assert earned["follows"] == (1.6, "follows")


def test_nothing_that_a_camera_writes_is_kept(taken: Path) -> None:
    for path in (taken / "read").iterdir():
        data = path.read_bytes()
        assert b"Telephone" not in data
        assert b"Exif" not in data


def test_a_second_run_keeps_what_stands(a_class: Path, taken: Path) -> None:
    before = {p.name: p.read_bytes() for p in (taken / "read").glob(f"*{READING}")}
    again = call(
        "read", a_class, taken / "plain.jpg", taken / "hard.jpg", "-o", taken / "read",
        "--grid", taken / "grid", "--jobs", "1",
    )  # fmt: skip
    assert "2 stood already" in again.output
    assert before == {p.name: p.read_bytes() for p in (taken / "read").glob(f"*{READING}")}


def sheet_jpeg(image: np.ndarray) -> bytes:
    return cv2.imencode(".jpg", image)[1].tobytes()


def png_head(width: int, height: int) -> bytes:
    """A PNG file that says it is so large, and holds nothing."""
    import struct
    import zlib

    head = b"IHDR" + struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, 0)
    chunk = struct.pack(">I", 13) + head + struct.pack(">I", zlib.crc32(head))
    data = struct.pack(">I", 0) + b"IDAT" + struct.pack(">I", zlib.crc32(b"IDAT"))
    return b"\x89PNG\r\n\x1a\n" + chunk + data


def empty_pdf() -> bytes:
    out, writer = io.BytesIO(), PdfWriter()
    writer.add_blank_page(1190, 842)
    writer.write(out)
    return out.getvalue()


def heic(image: np.ndarray) -> bytes:
    """A picture as telephones save it."""
    import pillow_heif

    out = io.BytesIO()
    pillow_heif.from_pillow(Image.fromarray(image).convert("RGB")).save(
        out, quality=90, enc_params={"preset": "ultrafast"}
    )
    return out.getvalue()


def test_a_picture_as_telephones_save_it_is_opened(tmp_path: Path) -> None:
    image = np.tile(np.linspace(0, 255, 1200).astype(np.uint8), (900, 1))
    (tmp_path / "one.heic").write_bytes(heic(image))
    (found,) = photographs([tmp_path])
    assert abs(grey_of(found).astype(int) - image).max() < 8


def hostile() -> dict[str, tuple[bytes, str]]:
    """Pictures that cannot be read, each with what is said of it."""
    return {
        "large.png": (png_head(20_000, 10_000), "120 million pixels"),
        "half.heic": (heic(np.full((1500, 2000), 90, np.uint8))[:900], "cut short"),
        "blank.jpg": (sheet_jpeg(np.full((1500, 2000), 230, np.uint8)), "no code is found"),
        "bomb.png": (png_head(60_000, 60_000), "million pixels"),
        "cut.jpg": (sheet_jpeg(np.zeros((1500, 2000), np.uint8))[:2000], "cut short"),
        "text.jpg": (b"no picture at all", "is no picture"),
        "tiny.png": (png_head(400, 300), "too few"),
        "empty.jpg": (b"", "is no picture"),
        "drawn.pdf": (empty_pdf(), "no scanned picture"),
        "broken.pdf": (b"%PDF-1.7\n", "no PDF file"),
    }


def test_hostile_pictures_get_one_line_each(a_class: Path, tmp_path: Path) -> None:
    photos, wrong = tmp_path / "photos", hostile()
    photos.mkdir()
    for name, (data, _) in wrong.items():
        (photos / name).write_bytes(data)
    found = call("read", a_class, photos, "-o", tmp_path / "read", "--jobs", "1", "--json")
    assert found.exit_code == 1, found.output
    assert "Traceback" not in found.output
    for name, (_, why) in wrong.items():
        stem = Path(name).stem
        (line,) = [line for line in found.output.splitlines() if line.startswith(f"{stem}: ")]
        assert why in line
        told = json.loads((photos / f"{stem}.points.json").read_text(encoding="utf-8"))
        assert why in told["refused"]
        assert told["points"] == []


@pytest.mark.parametrize(
    "shot",
    [
        pytest.param(Shot(size=(3000, 2250), tilt=8, fold=10.0), id="folded"),
        pytest.param(Shot(size=(3000, 2250), tilt=8, cut=20.0), id="cut"),
        pytest.param(Shot(size=(3000, 2250), tilt=45), id="tilted"),
    ][: 3 if EVERY else 2],
)
def test_a_hard_sheet_is_read_by_its_lines_and_crosses(
    a_class: Path, code: str, shot: Shot, tmp_path: Path
) -> None:
    """Folded in four, from 45 degrees, or without its upper edge."""
    drawing = drawn_sheet(a_class, code, "velocity", Habits(point=0.3, line=0.3), 3)
    taken = photograph(drawing.image, shot, 11)
    (tmp_path / "hard.jpg").write_bytes(taken.data)
    inside = [(x, y) for x in XS for y in (60.0, 120.0, 180.0, 240.0)]
    grid = Grid(tuple(XS), (60.0, 120.0, 180.0, 240.0))
    read = read_one(read_order(read_edition(a_class), grid), *photographs_with_keys(tmp_path))
    assert read.record.refused is None
    true = np.sort(taken.where(np.array(inside)), axis=0)
    assert np.median(np.hypot(*(np.sort(read.record.map, axis=0) - true).T)) < 0.6  # pixels
    at = {each.step: each.at for each in read.record.points}
    off = [np.hypot(*np.subtract(at[p.step], p.at)) for p in drawing.points if p.at and at[p.step]]
    assert len(off) >= len(drawing.points) - 1
    assert np.median(off) < 0.3


def photographs_with_keys(folder: Path) -> tuple[Photograph, str]:
    """The only photograph of a folder, with an empty key."""
    (one,) = photographs([folder])
    return one, ""


def test_another_class_and_a_cut_sheet_are_refused(
    a_class: Path, code: str, tmp_path: Path
) -> None:
    image = cv2.resize(printed(a_class, code, "velocity"), None, fx=0.5, fy=0.5)
    half = image[:, int(image.shape[1] * 0.42) :]
    (tmp_path / "half.png").write_bytes(cv2.imencode(".png", half)[1].tobytes())
    found = call("read", a_class, tmp_path / "half.png", "-o", tmp_path / "read", "--jobs", "1")
    assert "left side" in found.output
    (tmp_path / "class.csv").write_text(ROSTER, encoding="utf-8")
    call("variants", "pump", tmp_path / "class.csv", "-o", tmp_path / "other")
    found = call(
        "read", tmp_path / "other", tmp_path / "half.png", "-o", tmp_path / "read2", "--jobs", "1"
    )
    assert "of no student of this class" in found.output


def test_photographs_of_one_sheet_are_named_together(a_class: Path, taken: Path) -> None:
    (record,) = (each for each in records_in(taken / "read") if each.name == "plain")
    again = msgspec.structs.replace(record, name="plain again")
    found = list(read_run.said(read_edition(a_class), ReadOutcome([record, again], 0)))
    assert [line for line in found if line.startswith("plain, plain again: the same sheet")]
    assert not any(
        "same sheet" in each
        for each in read_run.said(read_edition(a_class), ReadOutcome([record], 0))
    )


def test_a_scan_is_read_from_a_pdf(a_class: Path, code: str, tmp_path: Path) -> None:
    drawing = drawn_sheet(a_class, code, "velocity", Habits(point=0.3, line=0.3), 3)
    scan = Image.fromarray(cv2.resize(drawing.image, None, fx=0.8, fy=0.8))
    scan.save(tmp_path / "scan.pdf", resolution=203)
    out = tmp_path / "of two" / "read"  # neither is there yet
    found = call("read", a_class, tmp_path / "scan.pdf", "-o", out, "--jobs", "1")
    assert found.exit_code == 0, found.output
    (record,) = records_in(out)
    assert record.kind == "velocity"
    d = next(point for point in record.points if point.name == "d")
    true = next(point for point in drawing.points if point.name == "d")
    assert d.at is not None
    assert true.at is not None
    assert np.hypot(d.at[0] - true.at[0], d.at[1] - true.at[1]) < 0.5


@pytest.fixture(scope="module")
def rack(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class whose lab is a rack and its pinion."""
    folder = tmp_path_factory.mktemp("rack")
    (folder / "class.csv").write_text("Nr.;Matricol;Nume\n2;0042;Ana Pop\n", encoding="utf-8")
    lab = lab_of(Path("examples/scenes/gears-rack.toml"), folder)
    call("variants", lab, folder / "class.csv", "-o", folder / "class")
    return folder / "class"


def test_what_leads_to_points_of_a_rack(rack: Path) -> None:
    """Both points lie on the printed guide, by whatever way a hand finds them; the tip of the
    velocity of contact needs its vector, and no side of a similar triangle.
    """
    (code,) = read_order(read_edition(rack), Grid()).takers
    sheets = sheets_of(rack, code)
    drawing = next(each for each in sheets.drawings if each.kind == "velocity")
    page = next(each for each in sheets.of("task") if each.kind == "velocity").pages[0]
    sheet = LetteredSheet(drawing, page)
    by_name = {sheet.exact.program.steps[n].name: n for n in sheet.points}
    names = {n: name for name, n in by_name.items()}
    for name in ("B", "T"):
        assert any(each.given for each in sheet.leading[by_name[name]]), name
    assert not any(each.given for each in sheet.leading[by_name["A"]])
    sides = {names.get(each.far, "o"): each.light for each in sheet.leading[by_name["t"]]}
    assert sides == {"o": False, "a": True}


def test_a_sheet_whose_lines_another_has_as_well_is_not_taken_for_it(
    rack: Path, tmp_path: Path
) -> None:
    folder = rack
    (code,) = read_order(read_edition(folder), Grid()).takers
    for kind in ("velocity", "acceleration"):
        taken = scan(printed(folder, code, kind), 150, 0.0, 1)
        (tmp_path / f"{kind} 1.jpg").write_bytes(taken.data)
    pictures = [tmp_path / f"{kind} 1.jpg" for kind in ("velocity", "acceleration")]
    found = call("read", folder, *pictures, "-o", tmp_path / "read", "--json", "--jobs", "1")
    assert found.exit_code == 0, found.output
    kinds = {record.file: record.kind for record in records_in(tmp_path / "read")}
    assert kinds == {"velocity 1.jpg": "velocity", "acceleration 1.jpg": "acceleration"}
    for path in pictures:  # beside each picture, by its own name
        told = json.loads(path.with_suffix(".points.json").read_text(encoding="utf-8"))
        assert told["code"] == code


HALVED = [(90.5, -0.8, 150, 3), (0.6, 181.0, 200, 0)]
"""How the halves of a sheet lie on a scanner, its dots to an inch, and by how much they lap."""


@pytest.mark.parametrize(("first", "second", "dpi", "lap"), HALVED if EVERY else HALVED[:1])
def test_two_scans_of_the_halves_are_one_sheet(
    a_class: Path, code: str, tmp_path: Path, first: float, second: float, dpi: float, lap: float
) -> None:
    drawing = drawn_sheet(a_class, code, "velocity", Habits(point=0.3, line=0.3), 3)
    photos = tmp_path / "photos"
    photos.mkdir()
    left = scan(drawing.image, dpi, first, 1, (0.0, 210.0 + lap))
    right = scan(drawing.image, dpi, second, 2, (210.0 - lap, 420.0))
    (photos / "one-left.jpg").write_bytes(left.data)
    (photos / "one-right.jpg").write_bytes(right.data)
    found = call("read", a_class, photos, "-o", tmp_path / "read", "--jobs", "1")
    assert found.exit_code == 0, found.output
    (record,) = records_in(tmp_path / "read")
    assert (record.name, record.kind) == ("one", "velocity")
    true = {point.step: point for point in drawing.points}
    for point in record.points:
        if point.step in true:
            assert point.verdict == "right"
            assert abs(complex(*point.at) - complex(*true[point.step].at)) < 0.6


def test_the_code_is_told_where_the_halves_lack_some_of_it(a_class: Path, code: str) -> None:
    """It stands where they meet: of the codes of the class there is one that fits the rest."""
    image = printed(a_class, code, "velocity").copy()
    image[:, 2100:2126] = image[:, 2126:2127]  # 2.6 mm that neither picture holds
    assert not codes_in(image)
    variants = read_order(read_edition(a_class), Grid()).takers
    found = code_among(image, 10.0, tuple(variants))
    assert found is not None
    assert found.text == code
    page = next(each for each in sheets_of(a_class, code).of("task") if each.kind == "velocity")
    square = registration.square_of(page.pages[0]) * 10 - 0.5
    assert found.corners == pytest.approx(square, abs=0.1)
    assert code_among(image, 10.0, ["ABCDEFGHJK", "234567ABCD"]) is None
    sheet = cv2.resize(image, None, fx=0.9, fy=0.9, interpolation=cv2.INTER_AREA)
    assert code_of_halves(sheet, variants)[0] == code
    with pytest.raises(Unreadable):
        code_of_halves(np.full_like(sheet, 255), variants)


def test_halves_that_are_no_sheet_are_refused(a_class: Path, code: str, tmp_path: Path) -> None:
    drawing = drawn_sheet(a_class, code, "velocity", Habits(), 3)
    for name in ("one-left", "one-right"):
        left = scan(drawing.image, 150, 0.0, 1, (0.0, 210.0))
        (tmp_path / f"{name}.jpg").write_bytes(left.data)
    found = call("read", a_class, tmp_path, "-o", tmp_path / "read", "--jobs", "1")
    assert "one: refused: the frame of the right half is not found" in found.output
    if not EVERY:
        return  # the other way round it takes as long again
    right = scan(drawing.image, 150, 0.0, 1, (210.0, 420.0))
    for name in ("two-left", "two-right"):
        (tmp_path / f"{name}.jpg").write_bytes(right.data)
    found = call("read", a_class, tmp_path, "-o", tmp_path / "read", "--jobs", "1")
    assert "two: refused: " in found.output


def ink_of(*lines: tuple[complex, complex]) -> DrawnInk:
    """Lines between places of the paper, and nothing printed."""
    width, height = (round((A3.fields[i + 2] - A3.fields[i]) * INK) for i in (0, 1))
    dark = np.zeros((height, width), np.float32)
    for start, end in lines:
        a, b = (
            (round((p.real - A3.fields[0]) * INK * 16), round((p.imag - A3.fields[1]) * INK * 16))
            for p in (start, end)
        )
        cv2.line(dark, a, b, 1.0, 2, cv2.LINE_8, 4)
    return DrawnInk(dark, np.ones_like(dark))


def test_a_line_ends_where_its_ink_does_and_one_that_does_not_come_so_far_is_none() -> None:
    ink = ink_of((200 + 100j, 260 + 100j))
    end = ink.stroke(258.5 + 100j, 1 + 0j, 4.0)
    assert end is not None
    assert end.end == pytest.approx(1.5, abs=0.5)
    on = ink.stroke(230 + 100j, 1 + 0j, 4.0)
    assert on is not None
    assert on.end is None
    assert ink.stroke(280 + 100j, 1 + 0j, 4.0) is None


def test_a_letter_beside_the_end_of_a_line_does_not_hide_it() -> None:
    ink = ink_of((200 + 100j, 260 + 100j), (261.6 + 98j, 261.6 + 102j))
    end = ink.stroke(259.5 + 100j, 1 + 0j, 3.0)
    assert end is not None
    assert end.end == pytest.approx(0.5, abs=0.5)


def ring_of(place: complex, radius: float) -> list[tuple[complex, complex]]:
    """A ring as short lines."""
    turns = place + radius * np.exp(1j * np.linspace(0, 2 * np.pi, 13))
    return list(itertools.pairwise(turns.tolist()))


MARKS = {
    "ring": ring_of(230 + 100j, 0.9),
    "dot": ring_of(230 + 100j, 0.4),
    "cross": [(230 + 98.8j, 230 + 101.2j)],
}


@pytest.mark.parametrize("mark", MARKS)
def test_a_point_is_seen_by_its_mark_on_a_line(mark: str) -> None:
    line = (200 + 100j, 260 + 100j)
    places = np.arange(226, 234, 0.2) + 100j
    found = ink_of(line, *MARKS[mark]).spot(places, 1 + 0j)
    assert found is not None
    assert abs(found - (230 + 100j)) < 0.4
    assert ink_of(line).spot(places, 1 + 0j) is None
    through = ink_of(line, (230 + 90j, 230 + 110j))  # a line that crosses it marks nothing
    assert through.spot(places, 1 + 0j) is None


@pytest.mark.parametrize("mark", MARKS)
def test_a_mark_beside_a_line_is_none_of_a_point_on_it(mark: str) -> None:
    """As where somebody put a point of a link beside its line by mistake."""
    line = (200 + 100j, 260 + 100j)
    assert not ink_of(line, *MARKS[mark]).is_marked_beside(230 + 100j, 1 + 0j)
    aside = ring_of(230 + 101.2j, 0.9)
    assert ink_of(line, *aside).is_marked_beside(230 + 100j, 1 + 0j)


@pytest.mark.parametrize("shift", [0.3, 0.6, 0.9])
def test_a_letter_written_over_a_dot_on_a_line_is_no_mark_beside_it(shift: float) -> None:
    line = (200 + 100j, 260 + 100j)
    letter = ring_of(230 + (100 + shift) * 1j, 1.1)[2:11]
    assert not ink_of(line, *MARKS["dot"], *letter).is_marked_beside(230 + 100j, 1 + 0j)


@pytest.mark.parametrize("off", [0.0, 0.1, 0.2])
def test_the_arms_of_a_cross_on_a_printed_line_are_no_mark_beside_it(off: float) -> None:
    """Print hides the middle of the cross."""
    middle = 230 + (100 + off) * 1j
    cross = [(middle - way, middle + way) for way in (1.4 + 1.4j, 1.4 - 1.4j)]
    ink = ink_of((200 + 100j, 260 + 100j), *cross)
    known = np.ones_like(ink.known)
    row = round((100 - ink.paper.fields[1]) * INK)
    known[row - round(0.45 * INK) : row + round(0.45 * INK) + 1] = 0
    printed = DrawnInk(ink.dark, known, ink.sway, ink.paper)
    assert printed.spot(np.arange(226, 234, 0.2) + 100j, 1 + 0j) is not None
    assert not printed.is_marked_beside(230 + 100j, 1 + 0j)


def test_a_line_that_leaves_the_window_it_was_seen_in_is_another() -> None:
    """By 3 degrees, as after a mistake: it passes where it begins, not where it should end."""
    ink = ink_of((200 + 100.2j, 255.9 + 97.2j))
    assert not ink.lines(200 + 100j, 255.9 + 98.8j, 1.6, 0.5)
    found = ink.lines(200 + 100j, 255.9 + 97.5j, 1.6, 0.5)
    assert found and all(abs(line.off(255.9 + 97.2j)) < 0.15 for line in found)


def test_two_sheets_in_one_picture_are_told_also_of_one_student() -> None:
    """A picture shows as many sheets as there are squares in it."""
    whose = {"TZHG6MXPZY": cast(Taker, None), "HCZRNFKJ4X": cast(Taker, None)}
    first, second = (255 - 255 * np.kron(modules(code), np.ones((8, 8))) for code in whose)
    for pair in ((first, first), (first, second)):
        picture = np.hstack([np.pad(each, 80, constant_values=255) for each in pair])
        with pytest.raises(Unreadable, match=r"several sheets: .*, "):
            known_code(picture.astype(np.uint8), whose)
        half = np.ascontiguousarray(picture[:, : picture.shape[1] // 2].astype(np.uint8))
        assert known_code(half, whose)[0] == "TZHG6MXPZY"


def test_a_mark_over_a_printed_line_is_seen_on_both_its_sides() -> None:
    dashes = [(x + 100j, x + 5 + 100j) for x in (200, 207, 214, 221, 228, 235, 242, 249)]
    along = ink_of(*dashes, *MARKS["dot"]).on_print(228 + 100j, 1 + 0j, 4.0)
    assert along == pytest.approx(2, abs=0.3)
    across = ink_of(*dashes, (230 + 98.8j, 230 + 101.2j)).on_print(228 + 100j, 1 + 0j, 4.0)
    assert across == pytest.approx(2, abs=0.3)
    beside = ink_of(*dashes, (230 + 98.8j, 230 + 99.7j)).on_print(228 + 100j, 1 + 0j, 4.0)
    assert beside is None
    assert ink_of(*dashes).on_print(228 + 100j, 1 + 0j, 4.0) is None


def test_a_line_that_ends_before_a_place_does_not_arrive_there() -> None:
    ink = ink_of((200 + 100j, 260 + 100j))
    assert ink.cover(200 + 100j, 260 + 100j, arrives=True) == pytest.approx(1)
    assert ink.cover(200 + 100j, 270 + 100j) > 0.8
    assert ink.cover(200 + 100j, 270 + 100j, arrives=True) < 0.5
    assert ink.cover(200 + 100j, 266 + 100j, hidden=1.0, arrives=True) < 0.8


def velocity_of(folder: Path, code: str, kind: str = "velocity") -> LetteredSheet:
    """A student's sheet of velocities, or of another kind, as it should be drawn."""
    sheets = sheets_of(folder, code)
    drawing = next(each for each in sheets.drawings if each.kind == kind)
    page = next(each for each in sheets.of("task") if each.kind == kind).pages[0]
    return LetteredSheet(drawing, page)


@pytest.fixture(scope="module")
def levers(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class whose lab is a rapid return of class III, drawn with two trial plans."""
    folder = tmp_path_factory.mktemp("levers")
    (folder / "class.csv").write_text("Nr.;Matricol;Nume\n2;0042;Ana Pop\n", encoding="utf-8")
    scene = Path("examples/scenes/rapid-return.toml").read_text(encoding="utf-8")
    turned = "n = { value = 7, min = 1, max = 30, step = 1 }"
    scene = scene.replace("[frame]", f"[parameters]\n{turned}\n\n[frame]", 1)
    (folder / "rapid-return.toml").write_text(
        scene.replace("angle = 35\n", 'angle = "25 + n"\n'), encoding="utf-8"
    )
    lab = lab_of(folder / "rapid-return.toml", folder)
    call("variants", lab, folder / "class.csv", "-o", folder / "class")
    return folder / "class"


def alone(drawn: object) -> complex:
    """The value of a single drawing."""
    return complex(np.ravel(drawn)[0])


def lever_sheet(
    levers: Path, kind: str
) -> tuple[LetteredSheet, dict[str, int], dict[str, complex]]:
    """A sheet of the rapid return, the steps of its letters in the plan and on the mechanism, and
    where they lie.
    """
    (code,) = read_order(read_edition(levers), Grid()).takers
    sheet = velocity_of(levers, code, kind)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    planes = Plane.MECHANISM, sheet.drawing.plane
    numbers = {
        str(steps[n].name): n
        for n, value in values.items()
        if steps[n].name and isinstance(value, complex) and steps[n].plane in planes
    }
    return sheet, numbers, {name: complex(sheet.place(n, values[n])) for name, n in numbers.items()}


@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
def test_what_is_expected_where_nothing_is_read_is_the_key(levers: Path, kind: str) -> None:
    """The rates of trial plans are chosen and printed: they do not follow from what is drawn."""
    sheet, numbers, places = lever_sheet(levers, kind)
    expects = PointSearch(sheet, ink_of(), Pencil(0.4, 0.4)).ahead()
    for name, number in numbers.items():
        assert abs(alone(sheet.place(number, expects[number])) - places[name]) < 0.01, name


@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
def test_one_more_point_changes_what_follows_from_it_alone(levers: Path, kind: str) -> None:
    """What is computed from the point alone is what all steps give when drawn again."""
    sheet, numbers, places = lever_sheet(levers, kind)
    search = PointSearch(sheet, ink_of(), Pencil(0.4, 0.4))
    for name, place in places.items():
        number = numbers[name]
        if number not in sheet.points:
            continue
        search.next = search.ahead()
        found = search.after(number, place + 2 - 1j)
        search.own[number] = place + 2 - 1j
        for other, value in search.ahead().items():
            np.testing.assert_equal(alone(sheet_value(found[other])), alone(sheet_value(value)))


def sheet_value(value: object) -> object:
    """A number of a step: where a line, circle or vector begins."""
    for part in ("point", "centre", "tip", "start"):
        value = getattr(value, part, value)
    return value[0] if isinstance(value, tuple) else value


def test_a_point_is_read_when_a_hand_finds_it(levers: Path) -> None:
    """Of a divided plan q is found first, and the share by which the others follow."""
    sheet, numbers, _ = lever_sheet(levers, "acceleration")
    q, others = numbers["q′"], [numbers["p′"], numbers["p′_2"]]
    assert sheet.found_by[sheet.exact.program.steps[q].by_hand] == q
    assert all(sheet.order.index(q) < sheet.order.index(each) for each in others)
    reader = PointReader(sheet, ink_of(), Pencil(0.4, 0.4))
    assert all(q in reader.behind(each) for each in others)
    assert q not in reader.behind(q)
    assert [each.step for each in reader.read()] == [*sheet.points]


@pytest.mark.parametrize("joined", [True, False])
def test_a_point_found_by_hand_is_asked_where_its_vectors_go_elsewhere(
    levers: Path, *, joined: bool
) -> None:
    """The crossing that gives q is drawn before p is, to which a vector joins it."""
    sheet, numbers, places = lever_sheet(levers, "velocity")
    p, q = places["p"], places["q"]
    reader = PointReader(sheet, ink_of((p, q if joined else q + 12j)), Pencil(0.4, 0.4))
    reader.own = {numbers["p"]: p, numbers["q"]: q}
    reader.next = reader.drawings = reader.ahead()
    assert reader.is_joined(numbers["q"]) is joined


def test_a_drawn_line_runs_through_the_point_that_was_read_on_it(levers: Path) -> None:
    sheet, numbers, places = lever_sheet(levers, "acceleration")
    a, p = numbers["A"], numbers["P"]
    reader = PointReader(sheet, ink_of(), Pencil(0.4, 0.4))
    for shift, turned in ((1 + 2j, True), (0.8 * (places["A"] - places["P"]), False)):
        reader.own = {a: places["A"], p: places["P"] + shift}
        found = reader.ahead()
        lines = reader.lines_through(p, found)
        assert bool(lines) is turned  # from near by nobody tells a direction
        for number, line in lines.items():
            way, along = alone(found[p]) - alone(found[a]), alone(line.along)
            assert abs((along * way.conjugate()).imag) < 1e-9 * abs(along) * abs(way)
            assert (along * alone(found[number].along).conjugate()).real > 0


def test_where_known_points_and_those_of_trial_plans_lie_is_no_place_of_another(
    levers: Path, a_class: Path, code: str
) -> None:
    """The vectors that come to the pole end there: they are no point's that was misplaced."""
    sheet, numbers, places = lever_sheet(levers, "velocity")
    o, a, p, tried = (places[name] for name in ("o", "a", "p", "p¹"))
    search = PointSearch(sheet, ink_of((o, tried), (a, tried), (p, tried)), Pencil(0.4, 0.4))
    search.own = {numbers[name]: places[name] for name in ("a", "p")}
    search.next = search.drawings = search.ahead()
    tried_points = search.tried_points(Plane.VELOCITIES).values()
    assert any(abs(place - tried) < 0.01 for place in tried_points)
    found = search.best_far(numbers["a_3"], ExpectedPlace(places["a_3"], np.eye(2) * 0.2))
    assert found is None or abs(found.place - tried) > 3

    sheet = velocity_of(a_class, code)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    steps_of = {name: next(n for n in values if steps[n].name == name) for name in "oabc"}
    at = {name: complex(sheet.place(n, values[n])) for name, n in steps_of.items()}
    search = PointSearch(
        sheet, ink_of((at["o"], at["a"]), (at["o"], at["b"]), (at["a"], at["b"])), Pencil(0.4, 0.4)
    )
    search.own = {steps_of[name]: at[name] for name in "ab"}
    search.next = search.drawings = search.ahead()
    found = search.best_far(steps_of["c"], ExpectedPlace(at["c"], np.eye(2) * 0.2))
    assert found is None or abs(found.place - at["o"]) > 3


@pytest.mark.parametrize(("short", "reached"), [(0.0, True), (4.0, False)])
def test_a_line_that_ends_before_a_point_does_not_lead_to_it(
    tmp_path: Path, short: float, *, reached: bool
) -> None:
    """A bar may point to where a point is expected on another, and begin at the student's own."""
    (tmp_path / "class.csv").write_text("Nr.;Matricol;Nume\n2;0042;Ana Pop\n", encoding="utf-8")
    call("variants", "pump-collinear", tmp_path / "class.csv", "-o", tmp_path / "class")
    (code,) = read_order(read_edition(tmp_path / "class"), Grid()).takers
    sheet = velocity_of(tmp_path / "class", code)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    named = {name: next(n for n in values if steps[n].name == name) for name in "ACD"}
    at = {name: complex(sheet.place(n, values[n])) for name, n in named.items()}
    begins = at["C"] + short * (at["D"] - at["C"]) / abs(at["D"] - at["C"])
    bar = at["A"], at["C"] + 20 * (at["C"] - at["A"]) / abs(at["C"] - at["A"])
    reader = PointReader(sheet, ink_of(bar, (begins, at["D"])), Pencil(0.4, 0.4))
    reader.own = {named["A"]: at["A"]}
    reader.next = reader.drawings = reader.ahead()
    assert reader.is_reached(named["C"], at["C"]) is reached
    there = ExpectedPlace(at["C"], np.eye(2) * 0.05)
    told = reader.verdict_on(
        named["C"], there, there, LinesCrossing(at["C"], np.eye(2) * 0.01, 2, 1.0)
    )
    assert told.verdict == "right"
    assert told.ask is not reached


@pytest.mark.parametrize(("away", "off", "asked"), [(9, 0.5, 0), (9, 1.5, 1), (12, 0.5, 1)])
def test_a_point_near_its_expected_place_is_not_off(away: float, off: float, asked: int) -> None:
    """The pencil explains it at 9 squared deviations and not at 12."""
    reader = object.__new__(PointReader)
    reader.ink = ink_of()
    assert reader.is_off(away, off) == bool(asked)


def test_what_fits_and_lies_far_from_the_key_is_asked(a_class: Path, code: str) -> None:
    """Right and what follows from an unseen mistake are both possible there."""
    sheets = sheets_of(a_class, code)
    drawing = next(each for each in sheets.drawings if each.kind == "velocity")
    page = next(each for each in sheets.of("task") if each.kind == "velocity").pages[0]
    sheet = LetteredSheet(drawing, page)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    number, pole = (next(n for n in values if steps[n].name == name) for name in "ao")
    o = complex(sheet.place(pole, values[pole]))
    reader = PointReader(sheet, ink_of((o, 300 + 100j)), Pencil(0.4, 0.4))
    reader.next = reader.ahead()
    read = LinesCrossing(300 + 100j, np.eye(2) * 0.01, 3, 1.0)
    own = ExpectedPlace(300.2 + 100j, np.eye(2) * 0.2)
    for off, asked in ((1.0, False), (3.2, True)):
        key = ExpectedPlace(300 + off + 100j, np.eye(2) * 4.0)
        told = reader.verdict_on(number, key, own, read)
        assert (told.verdict, told.ask, told.off) == ("right", asked, 0.2)
    behind = reader.behind(number)
    for n in behind & {*sheet.points}:  # where all behind it is read and settled, none is unseen
        reader.readings[n] = msgspec.structs.replace(point(n, ask=False), verdict="right")
    for n in behind & {*sheet.corners}:
        reader.own[n] = 0j
    assert not reader.verdict_on(number, key, own, read).ask
    beyond = ExpectedPlace(305.2 + 100j, np.eye(2) * 4.0)  # 1.06 of what the pencil explains
    assert reader.verdict_on(number, beyond, own, read).ask
    some = next(iter(behind & {*sheet.points}))
    reader.readings[some] = point(some)
    assert reader.verdict_on(number, key, own, read).ask


@pytest.mark.parametrize(
    ("begins", "runs_on", "asked"), [("ao", 0, False), ("o", 0, True), ("ao", 20, True)]
)
def test_what_hangs_on_a_doubtful_mistake_waits_for_its_own_lines(
    a_class: Path,
    code: str,
    monkeypatch: pytest.MonkeyPatch,
    begins: str,
    runs_on: float,
    *,
    asked: bool,
) -> None:
    """A single way from a place that may be none tells nothing of what follows from it."""
    sheet = velocity_of(a_class, code)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    a, b, o = (next(n for n in values if steps[n].name == name) for name in "abo")
    at = {name: complex(sheet.place(n, values[n])) for name, n in (("a", a), ("o", o))}
    ways = {each: (300 + 100j - at[each]) / abs(300 + 100j - at[each]) for each in begins}
    lines = [(at[each], 300 + 100j + runs_on * way) for each, way in ways.items()]
    reader = PointReader(sheet, ink_of(*lines), Pencil(0.4, 0.4))
    reader.own = {a: at["a"]}
    reader.next = reader.drawings = reader.ahead()
    reader.bad, reader.doubted, reader.readings = {a}, {a}, {a: point(a)}
    monkeypatch.setattr(reader, "agreement", lambda *_, **__: 1.0)
    own = ExpectedPlace(300 + 100j, np.eye(2) * 0.2)
    key = ExpectedPlace(330 + 100j, np.eye(2) * 0.2)
    told = reader.verdict_on(b, key, own, LinesCrossing(300 + 100j, np.eye(2) * 0.01, 3, 1.0))
    assert (told.verdict, told.ask) == ("follows", asked)


def test_a_vector_apart_from_the_point_with_which_its_own_is_one_is_asked(rack: Path) -> None:
    (code,) = read_order(read_edition(rack), Grid()).takers
    sheet = velocity_of(rack, code)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    a, b, t, o = (next(n for n in values if steps[n].name == name) for name in "abto")
    places = {n: complex(sheet.place(n, values[n])) for n in (a, b, t, o)}
    assert abs(places[b] - places[t]) < 0.01
    whole = [(places[o], places[a]), (places[a], places[t]), (places[o], places[t])]
    apart = places[o], places[o] + (places[t] - places[o]) * np.exp(1j * np.radians(6))
    for lines, rival in ((whole, False), ([*whole, apart], True)):
        reader = PointReader(sheet, ink_of(*lines), Pencil(0.4, 0.4))
        reader.own = {n: places[n] for n in (a, t)}
        reader.readings = {n: point(n, ask=False) for n in (a, t)}
        reader.next = reader.drawings = reader.ahead()
        own = ExpectedPlace(places[b], np.eye(2) * 0.05)
        found = reader.rival(b, places[b], own)
        assert (found is not None) is rival
        told = reader.read_point(b, own, own)
        assert told.ask is rival
        assert told.at is not None
        assert abs(complex(*told.at) - (apart[1] if rival else places[b])) < 3


def reader_of_b(folder: Path, code: str) -> tuple[int, PointReader]:
    """What reads an empty sheet of velocities, and the step of its point b."""
    sheet = velocity_of(folder, code)
    (number,) = (n for n in sheet.points if sheet.exact.program.steps[n].name == "b")
    return number, PointReader(sheet, ink_of(), Pencil(0.4, 0.4))


@pytest.mark.parametrize(("back", "another"), [(0.9, False), (8.0, True)])
def test_a_rival_of_a_place_is_another_place(
    a_class: Path, code: str, monkeypatch: pytest.MonkeyPatch, back: float, *, another: bool
) -> None:
    """What is found some way off may be settled by its lines where the point itself lies."""
    number, reader = reader_of_b(a_class, code)
    reader.next = reader.drawings = reader.ahead()
    here = 320 + 120j
    settled = LinesCrossing(here + back, np.eye(2) * 0.01, 2, 1.0)
    monkeypatch.setattr(reader, "candidates", lambda *_: [here + 9])
    monkeypatch.setattr(reader, "settled", lambda *_: settled)
    for name in ("led_to", "follows", "agreement"):
        monkeypatch.setattr(reader, name, lambda *_, **__: 1.0)
    found = reader.best_far(number, ExpectedPlace(here, np.eye(2) * 0.05), here)
    assert (found is settled) is another


@pytest.mark.parametrize("off", [0.2, 5.0])
def test_what_follows_from_a_point_is_known_no_better_than_the_point(
    a_class: Path, code: str, off: float
) -> None:
    """Where it fits, as lines and expectation together tell; where it does not, as its lines."""
    number, reader = reader_of_b(a_class, code)
    rng = np.random.default_rng(4)
    cloud = 320 + 120j + 0.5 * (rng.standard_normal(DRAWINGS) + 1j * rng.standard_normal(DRAWINGS))
    own = expected(cloud)
    best = LinesCrossing(own.middle + off, np.diag([0.09, 0.01]), 2, 1.0)
    reader.own = {number: own.weighed(best) if off < 1 else best.place}
    places = reader.places(number, cloud, own, best)
    spread = np.cov(np.stack([places.real, places.imag]))
    together = np.linalg.inv(np.linalg.inv(own.spread) + np.linalg.inv(best.error))
    assert spread == pytest.approx(together if off < 1 else best.error, abs=0.02, rel=0.2)
    assert abs(np.mean(places) - reader.own[number]) < 0.06


@pytest.mark.parametrize(("drawn_there", "taken"), [(1.0, True), (0.8, False)])
def test_a_place_to_which_all_ways_are_drawn_needs_no_more_than_one_to_which_they_are_not(
    a_class: Path, code: str, monkeypatch: pytest.MonkeyPatch, drawn_there: float, *, taken: bool
) -> None:
    """What is expected has else something in advance of what is a little likelier."""
    number, reader = reader_of_b(a_class, code)
    reader.next = reader.drawings = reader.ahead()
    here, there = 300 + 100j, 312 + 100j
    found = {each: LinesCrossing(each, np.eye(2) * 0.01, 2, 1.0) for each in (here, there)}
    monkeypatch.setattr(reader, "best_near", lambda *_: found[here])
    monkeypatch.setattr(reader, "best_far", lambda *_: found[there])
    monkeypatch.setattr(reader, "likely", lambda _, place, *__: {here: 3.0, there: 3.2}[place])
    drawn = {here: 0.55, there: drawn_there}
    monkeypatch.setattr(reader, "agreement", lambda _, place, **__: drawn[place])
    own = ExpectedPlace(here, np.eye(2) * 0.2)
    told = reader.read_point(number, own, own)
    assert told.ask
    assert told.at == ((312.0, 100.0) if taken else (300.0, 100.0))


def test_a_single_way_leads_where_it_ends(a_class: Path, code: str) -> None:
    sheet = velocity_of(a_class, code)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    number, pole = (next(n for n in values if steps[n].name == name) for name in "ao")
    a, o = (complex(sheet.place(n, values[n])) for n in (number, pole))
    search = PointSearch(sheet, ink_of((o, a)), Pencil(0.4, 0.4))
    search.next = search.drawings = search.ahead()
    short = a - 6 * (a - o) / abs(a - o)  # as a ray that runs a little aslant leaves the line
    assert abs(search.settled(number, short).place - a) < 0.6


def test_rays_end_where_the_field_does(a_class: Path, code: str) -> None:
    sheets = sheets_of(a_class, code)
    drawing = next(each for each in sheets.drawings if each.kind == "velocity")
    page = next(each for each in sheets.of("task") if each.kind == "velocity").pages[0]
    ink = ink_of((300 + 100j, 330 + 100j))
    search = PointSearch(LetteredSheet(drawing, page), ink, Pencil(0.4, 0.4))
    (first, *more) = search.rays(300 + 100j)
    assert first[0] == pytest.approx(1, abs=0.01)
    assert first[1] == pytest.approx(30, abs=6)
    assert all(abs(np.angle(way)) < np.radians(12) for way, _ in more)


def test_a_vector_that_runs_on_beyond_a_place_is_seen(a_class: Path, code: str) -> None:
    sheets = sheets_of(a_class, code)
    drawing = next(each for each in sheets.drawings if each.kind == "velocity")
    page = next(each for each in sheets.of("task") if each.kind == "velocity").pages[0]
    sheet = LetteredSheet(drawing, page)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    (number,) = (n for n in values if steps[n].name == "a")
    (pole,) = (n for n in values if steps[n].name == "o")
    o, a = (complex(sheet.place(n, values[n])) for n in (pole, number))
    for long, beyond in ((1.0, 0.0), (1.3, 1.0)):
        search = PointSearch(sheet, ink_of((o, o + long * (a - o))), Pencil(0.4, 0.4))
        search.next = search.ahead()
        assert search.beyond(number, a) == [pytest.approx(beyond, abs=0.1)]
        far = search.best_far(number, expected(np.array([a])), a)
        assert far is None or abs(far.place - a) > 2


def test_a_place_where_vectors_end_fits_better_than_one_that_they_pass(
    a_class: Path, code: str
) -> None:
    sheets = sheets_of(a_class, code)
    drawing = next(each for each in sheets.drawings if each.kind == "velocity")
    page = next(each for each in sheets.of("task") if each.kind == "velocity").pages[0]
    sheet, fits = LetteredSheet(drawing, page), list[float]()
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    number, pole = (next(n for n in values if steps[n].name == name) for name in "ao")
    o, a = (complex(sheet.place(n, values[n])) for n in (pole, number))
    for long in (1.0, 1.3):
        search = PointSearch(sheet, ink_of((o, o + long * (a - o))), Pencil(0.4, 0.4))
        search.next = search.ahead()
        fits.append(search.stopped(number, a))
    assert fits[0] > fits[1] + 0.2
    search.own = {number: 340 + 120j}
    assert search.goes_on(300 + 100j, 320 + 110j)
    assert not search.goes_on(300 + 100j, 340 + 120j)
    assert not search.goes_on(300 + 100j, 310 + 120j)
    assert not search.goes_on(300 + 100j, 280 + 90j)


@pytest.mark.parametrize(("rows", "dark", "count"), [(40, 1.0, 1), (20, 2.0, 0)])
def test_ink_that_is_twice_as_dark_makes_a_line_no_longer(
    rows: int, dark: float, count: int
) -> None:
    """Less than three tenths of a way drawn are no line, however dark they are."""
    part, across = np.linspace(0, 1, 100), offsets(3.0)
    strip = np.zeros((len(part), len(across)))
    strip[:rows, abs(across) < 0.3] = dark
    assert len(fitted(strip, np.ones_like(strip), across, part, (1.0, 1.0), 1)) == count


def test_others_leave_a_line_at_its_node() -> None:
    ink = ink_of((200 + 100j, 260 + 100j), (232 + 100j, 245 + 120j))
    assert ink.node(230.5 + 100j, 1 + 0j, 4.0) == pytest.approx(1.5, abs=0.4)
    assert ink.node(215 + 100j, 1 + 0j, 4.0) is None
    (first, *_) = ink.nodes(200 + 100j, 1 + 0j, 60.0)
    assert abs(first - (232 + 100j)) < 1.5
    lines = (200 + 100j, 260 + 100j), (225 + 100j, 230 + 120j), (228.2 + 100j, 223.2 + 80j)
    found = ink_of(*lines).nodes(200 + 100j, 1 + 0j, 60.0)
    assert sorted(each.real for each in found) == pytest.approx([225, 228.2], abs=0.5)


def test_a_square_far_from_all_lines_begins_where_the_first_are(
    a_class: Path, code: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(registration, "RINGS", (1.0, *registration.RINGS))
    image = cv2.resize(printed(a_class, code, "velocity"), None, fx=0.5, fy=0.5)
    page = sheets_of(a_class, code).of("task")[0].pages[0]
    corners = registration.square_of(page) * 5 - 0.5
    over = registration.SheetSearch(image, corners).frame(page, registration.BENT_FROM)
    assert over is not None
    assert over(grid_places()) == pytest.approx(grid_places() * 5 - 0.5, abs=1.0)


def test_the_frame_is_not_taken_for_the_border(a_class: Path, code: str) -> None:
    image = drawn_sheet(a_class, code, "velocity", Habits(), 3).image
    found = next(each for each in sheets_of(a_class, code).of("task") if each.kind == "velocity")
    page = found.pages[0]
    lines = registration.printed_lines(page)
    height, width = image.shape
    corners = registration.square_of(page) * 10 - 0.5
    corners[:, 1] += 48  # as if all lay 4.8 mm lower, where the border is the frame's neighbour
    over = registration.start(width, height, registration.square_of(page), corners, A3)
    nothing = np.zeros(len(lines.places))
    none = registration.MeasuredLines(lines, nothing, nothing > 0, nothing == 0)
    about = registration.sides_off(image, over, none)
    _, y = lines.places.T
    level = abs(lines.normals[:, 1]) > 0.5
    shift = lines.normals[:, 1] * about
    assert shift[level & (y < 14)] == pytest.approx(-4.8, abs=0.9)  # the fit does the rest
    assert not about[level & (y > 20) & (y < 270)].any()
    right = registration.start(width, height, registration.square_of(page), corners - [0, 48], A3)
    assert not registration.sides_off(image, right, none).any()


def test_a_corner_that_lies_off_is_sought_where_its_side_does_not(a_class: Path, code: str) -> None:
    """A bow may take the end of a side 4 mm off, and leave its middle where it is."""
    image = drawn_sheet(a_class, code, "velocity", Habits(), 3).image
    found = next(each for each in sheets_of(a_class, code).of("task") if each.kind == "velocity")
    lines = registration.printed_lines(found.pages[0])
    height, width = image.shape
    xs, ys = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
    fallen = 40 * np.clip((1500 - xs) / 600, 0, 1) * np.clip((1000 - ys) / 600, 0, 1)
    image = cv2.remap(image, xs, ys - fallen, cv2.INTER_LINEAR, borderValue=255)
    square = registration.square_of(found.pages[0])
    over = registration.start(width, height, square, square * 10 - 0.5, A3)
    measured = registration.measure(image, over, lines, registration.REACH)
    about = registration.sides_off(image, over, measured) * lines.normals[:, 1]
    x, y = lines.places.T
    level = abs(lines.normals[:, 1]) > 0.5
    assert about[level & (y < 14) & (x > 25) & (x < 85)] == pytest.approx(4.0, abs=0.9)
    assert not about[level & ((y > 14) | (x > 210))].any()
    whole = msgspec.structs.replace(measured, found=measured.seen)
    assert not registration.sides_off(image, over, whole).any()


def test_a_side_whose_ticks_are_not_where_they_should_be_lies_5_mm_off(
    a_class: Path, code: str
) -> None:
    image = drawn_sheet(a_class, code, "velocity", Habits(), 3).image
    image = cv2.copyMakeBorder(image, 90, 90, 90, 90, cv2.BORDER_CONSTANT, value=255)
    found = next(each for each in sheets_of(a_class, code).of("task") if each.kind == "velocity")
    lines = registration.printed_lines(found.pages[0])
    square = registration.square_of(found.pages[0])
    search = registration.SheetSearch(image, square * 10 + 89.5)
    right = search.frame(found.pages[0], registration.BENT_FROM)
    assert right is not None
    measured = registration.measure(image, right, lines, registration.NEAR)
    upper = registration.edges(lines)[2][0]
    fit = registration.MapFit(right, square, search.corners)
    off = measured.off - np.where(upper, 5.0 * lines.normals[:, 1], 0.0)  # frame where border is
    some = measured.found & (upper | (abs(lines.normals[:, 1]) < 0.5))
    told = msgspec.structs.replace(measured, off=off, found=some)
    fit.to(told, 5.0, lens=True, bent=True)
    wrong = fit.map
    top = np.array([[x, 10.0] for x in (30.0, 210.0, 390.0)])
    assert abs(wrong(top) - right(top)).max() > 30  # pixels of 0.1 mm
    frame = lines.some(lines.shared)
    mended = registration.held_by_ticks(image, wrong, frame, square, search.corners)
    assert mended(top) == pytest.approx(top * 10 + 89.5, abs=1.0)
    ticks = registration.edges(lines)[2][1]
    without = msgspec.structs.replace(measured, found=measured.found & ~ticks)
    assert (
        "border on the upper side"
        in registration.judged(right, without, lines, search.sides).refused
    )


def test_the_frame_is_followed_once_for_all_sheets_and_each_is_told(
    a_class: Path, code: str
) -> None:
    """The sheet whose own lines are on the picture is likelier than the other, by one map."""
    pages = {each.kind: each.pages[0] for each in sheets_of(a_class, code).of("task")[:2]}
    assert len(pages) == 2
    for kind, page in pages.items():
        image = cv2.resize(printed(a_class, code, kind), None, fx=0.5, fy=0.5)
        corners = registration.square_of(page) * 5 - 0.5
        search = registration.SheetSearch(image, corners)
        likely = {
            name: search.likeness(each, [other for other in pages.values() if other is not each])
            for name, each in pages.items()
        }
        assert max(likely, key=lambda name: likely[name]) == kind
        found = search.registered(page)
        assert found is not None
        assert not found.refused
        assert len(search.frames) == 1
        off = found.map(grid_places()) - (grid_places() * 5 - 0.5)
        assert np.hypot(*off.T).max() < 1  # pixels, of five a mm


PENCILS = {"red": (0.15, 0.9, 0.9), "green": (0.85, 0.2, 0.8), "blue": (0.9, 0.7, 0.1)}
"""How much of red, green and blue light a coloured pencil takes."""


@pytest.mark.parametrize("colour", PENCILS if EVERY else ["green"])
def test_a_coloured_pencil_is_read_like_a_grey_one(
    a_class: Path, code: str, tmp_path: Path, colour: str
) -> None:
    blank = printed(a_class, code, "velocity").astype(np.float32)
    drawing = drawn_sheet(a_class, code, "velocity", Habits(point=0.3, line=0.3), 3)
    taken = (blank - drawing.image)[..., None] * np.array(PENCILS[colour])
    image = np.clip(blank[..., None] - taken, 0, 255).astype(np.uint8)
    picture = Image.fromarray(image).resize((3150, 2228), Image.Resampling.BOX)
    picture.save(tmp_path / "one.png", compress_level=1)
    found = call(
        "read", a_class, tmp_path / "one.png", "-o", tmp_path / "read", "--json", "--jobs", "1"
    )
    assert found.exit_code == 0, found.output
    read = json.loads((tmp_path / "one.points.json").read_text(encoding="utf-8"))
    by_step = {point["step"]: point for point in read["points"]}
    for point in drawing.points:
        told = by_step[point.step]
        assert told["verdict"] == "right", point.name
        assert np.hypot(*(np.array(told["at"]) - point.at)) < 1, point.name
    kept = np.asarray(Image.open(tmp_path / "read" / "one.jpg")).astype(int)
    ink = (kept.max(axis=2) - kept.min(axis=2)) > 40
    assert ink.mean() > 0.001  # the kept picture shows the pencil's colour
    assert kept[ink].mean(axis=0).argmax() == int(np.argmin(PENCILS[colour]))


def test_a_single_line_leaves_a_cloud_open_along_itself() -> None:
    rng = np.random.default_rng(3)
    cloud = rng.normal(0, 2, 4000) + 1j * rng.normal(0, 2, 4000)
    line = LinesCrossing(1 + 0.5j, along_way(1 + 0j, 50.0, 0.1), 1, 1.0)
    place = expected(cloud)
    narrow = place.narrowed(cloud, line, rng.standard_normal((4000, 2)))
    assert np.std(narrow.real) == pytest.approx(2, rel=0.1)
    assert np.std(narrow.imag) < 0.2
    assert np.mean(narrow.imag) == pytest.approx(0.5, abs=0.05)


def test_by_hand_the_points_that_marks_need_are_asked(
    a_class: Path, taken: Path, code: str, tmp_path: Path
) -> None:
    out = tmp_path / "read"
    call("read", a_class, taken / "plain.jpg", "-o", out, "--by-hand", "--jobs", "1")
    record, by_camera = kept(out, "plain"), kept(taken / "read", "plain")
    assert record is not None
    assert by_camera is not None
    assert (record.code, record.kind) == (code, by_camera.kind)
    assert {point.verdict for point in record.points} == {"unread"}
    needed = {"velocity": {"d", "I3"}, "acceleration": {"d′", "J3", "J4"}}[record.kind]
    assert {point.name for point in record.points if point.ask} == needed


# --- decisions -------------------------------------------------------------------------------


def point(step: int, *, ask: bool = True) -> PointReading:
    return PointReading("b", step, (1.0, 2.0), "wrong", ask, (0.0, 0.0), (0.0, 0.0))


def test_the_last_decision_stands_and_undo_takes_it_back(tmp_path: Path) -> None:
    record = SheetRecord("p", "p.jpg", "", points=(point(4), point(5)))
    settled = SettledPoints(tmp_path)
    settled.add(PointDecision("p", 4, "follows", (3.0, 4.0)))
    settled.add(PointDecision("p", 4, "right", (3.5, 4.0), "his own b"))
    settled.add(PointDecision("p", 5, "missing"))
    settled.add(PointDecision(undo=True))
    again = SettledPoints(tmp_path)
    first, second = settled_points(record, again.standing)
    assert (first.verdict, first.at, first.ask) == ("right", (3.5, 4.0), False)
    assert second == point(5)
    again.add(PointDecision(undo=True))
    first, _ = settled_points(record, SettledPoints(tmp_path).standing)
    assert first.verdict == "follows"


def test_a_line_that_was_cut_short_costs_no_other(tmp_path: Path) -> None:
    settled = SettledPoints(tmp_path)
    settled.add(PointDecision("p", 4, "right", (1.0, 1.0)))
    with (tmp_path / SETTLED).open("ab") as stream:
        stream.write(b'{"sheet":"p","step":9,"ver')
    SettledPoints(tmp_path).add(PointDecision("p", 5, "wrong", (2.0, 2.0)))
    lines = (tmp_path / SETTLED).read_bytes().splitlines()
    assert [msgspec.json.decode(line)["step"] for line in lines] == [4, 5]


def test_a_file_of_decisions_is_read_up_to_a_size(tmp_path):
    path = tmp_path / SETTLED
    with path.open("wb") as stream:
        stream.truncate(1 << 27)
    with pytest.raises(PageError, match=f"{path}: {1 << 27} bytes; expected at most"):
        SettledPoints(tmp_path)


def test_one_seed_is_one_picture(a_class: Path, code: str) -> None:
    def made() -> Picture:
        drawing = drawn_sheet.__wrapped__(a_class, code, "velocity", Habits(stray=1), 2)
        return photograph(drawing.image, Shot(size=(1000, 750)), 2)

    assert made().data == made().data


# --- the desk and what goes back -------------------------------------------------------------


def asking(taken: Path) -> DrawingDesk:
    return DrawingDesk(taken / "read", words("en"))


def test_the_desk_writes_a_decision_at_once_and_takes_it_back(taken: Path) -> None:
    session = asking(taken)
    record = session.records["hard"]
    asked = next(point for point in record.points if point.ask)
    said = {"sheet": "hard", "step": asked.step, "verdict": "wrong", "at": [200.0, 100.0]}
    told = session.decide(json.dumps(said).encode())
    (point,) = [each for each in told["points"] if each["step"] == asked.step]
    assert (point["verdict"], point["ask"], point["decided"]) == ("wrong", False, True)
    again = asking(taken)  # the page was closed, or the desk was killed
    (sheet,) = [each for each in again.sheets() if each["name"] == "hard"]
    assert told == sheet
    assert again.undo()["step"] == asked.step
    points = again.shown_sheet(record)["points"]
    (point,) = [each for each in points if each["step"] == asked.step]
    assert point["ask"]


@pytest.mark.parametrize(
    "said",
    [
        b"nothing",
        b'{"sheet":"nobody","step":1,"verdict":"missing"}',
        b'{"sheet":"hard","step":-1,"verdict":"missing"}',
        b'{"sheet":"hard","step":STEP,"verdict":"right"}',
        b'{"sheet":"hard","step":STEP,"verdict":"right","at":[1e9,0]}',
        b'{"sheet":"hard","step":STEP,"verdict":"perhaps","at":[1,1]}',
        b'{"sheet":"hard","step":STEP,"undo":true}',
        b'{"sheet":"../hard","step":STEP,"verdict":"missing"}',
    ],
)
def test_the_desk_refuses_what_its_page_does_not_ask(taken: Path, said: bytes) -> None:
    session = asking(taken)
    step = str(session.records["hard"].points[0].step).encode()
    with pytest.raises(PageRequestError):
        session.decide(said.replace(b"STEP", step))


def test_only_the_page_with_its_token_gets_pictures(taken: Path) -> None:
    session = DeskSession(taken / "read", words("en"))
    guard = Guard(desk_application(session), "secret", ("127.0.0.1:1",), lambda: None)
    answers = []

    def get(path: str, host: str = "127.0.0.1:1") -> str:
        environ = {"REQUEST_METHOD": "GET", "PATH_INFO": path, "HTTP_HOST": host}
        setup_testing_defaults(environ)
        environ["HTTP_HOST"] = host
        list(guard(environ, lambda status, *_: answers.append(status)))
        return str(answers[-1])

    assert get("/secret/picture/hard.jpg").startswith("200")
    assert get("/secret/").startswith("200")
    assert get("/secret/picture/..%2Fclass.jpg").startswith("404")
    assert get("/guess/picture/hard.jpg").startswith("403")
    assert get("/secret/picture/hard.jpg", "evil.example:1").startswith("403")


@pytest.mark.parametrize("language", ["en", "it", "ro"])
def test_the_desk_speaks_each_language(taken: Path, language: str) -> None:
    session = DeskSession(taken / "read", words(language))
    page = desk_page(session).decode()
    assert words(language)("desk.title") in page
    (sheet,) = [each for each in session.everything()["sheets"] if each["name"] == "hard"]
    assert sheet["kind"] == words(language)("sheet.acceleration")
    assert sheet["who"].startswith("0042 ")
    assert "<built-in" not in page


def test_the_drawing_goes_back_with_green_and_red(a_class: Path, taken: Path) -> None:
    from graphkin.classroom.printing.edition import read_edition

    opened, kinds, refusals = read_edition(a_class), ("html", "pdf"), Refusals()
    found = drawings_of_class(opened, taken / "read", words("en"), kinds, refusals)
    assert not refusals.found
    page = found["0042-drawing.html"].decode()
    assert "<svg" in page
    assert "data:image/jpeg;base64," in page
    assert GREEN in page
    assert found["0042-drawing.pdf"].startswith(b"%PDF")
    again = drawings_of_class(opened, taken / "read", words("en"), kinds, refusals)
    assert found == again


def test_a_wrong_point_is_said_by_direction_and_length() -> None:
    wrong = PointReading(
        "b", 1, (110.0, 110.0), "wrong", False, (110.0, 100.0), (110.0, 100.0), 10.0, 0.5,
        (100.0, 100.0), "a",
    )  # fmt: skip
    said = sentence(wrong, words("en"))
    assert "10.0 mm" in said
    assert "45.0°" in said
    assert "4.1 mm" in said


def test_the_ring_about_a_point_lies_on_the_printed_page_where_the_point_was_read() -> None:
    """At (150, 90) mm of a sheet of A3, 420 mm wide."""
    right = PointReading("b", 1, (150.0, 90.0), "right", False, (150.0, 90.0), (150.0, 90.0))
    paper = io.BytesIO()
    Image.new("RGB", (840, 594), "white").save(paper, "JPEG")
    data = as_pdf([MarkedSheet("", paper.getvalue(), (right,), ())], words("en"))
    page = pypdfium2.PdfDocument(data)[0].render(scale=1).to_numpy()
    mm = page.shape[1] / 420
    rows, columns = np.nonzero(page[: round(297 * mm)].min(axis=2) < 200)
    ring = abs(rows / mm - 90) < 4
    assert np.median(columns[ring]) / mm == pytest.approx(150, abs=1)
    assert rows.min() / mm > 80
    assert rows.max() / mm < 95


def test_a_point_outside_the_paper_is_pointed_at_from_its_edge_with_its_typeset_letter() -> None:
    """At (-20, 90) mm: its mark is 5 mm inside the left edge, with an arrow to the left."""
    beyond = PointReading("b_2", 1, (-20.0, 90.0), "wrong", False, (60.0, 90.0), (60.0, 90.0), 80.0)
    paper = io.BytesIO()
    Image.new("RGB", (840, 594), "white").save(paper, "JPEG")
    sheet = MarkedSheet("", paper.getvalue(), (beyond,), ((sentence(beyond, words("en")), RED),))
    page = as_page([sheet], words("en")).decode()
    assert 'cx="5.0" cy="90.0"' in page
    assert '<line x1="5.00" y1="90.00" x2="0.00" y2="90.00"' in page
    assert "<i>b</i><sub>2</sub>: 80.0 mm" in page
    assert "b_2" not in page
    assert re.search(r"<tspan[^>]*italic[^>]*>b</tspan><tspan[^>]*>2</tspan>", page)


@pytest.mark.parametrize("drawn", [0.4, 0.6, 1.0])
def test_of_a_line_that_is_drawn_in_part_that_part_and_both_its_ends_are_told(drawn: float) -> None:
    """A line 0.4 mm wide from 0.3 mm on one side to 0.2 mm on the other, and nothing behind."""
    across, part = np.arange(-20, 21) * 0.05, np.linspace(0, 1, 101)
    middle = 0.3 * (1 - part) - 0.2 * part
    strip = (abs(across - middle[:, None]) < 0.2) * (part <= drawn + 1e-9)[:, None]
    found = refined(strip.astype(float), np.ones(strip.shape), across, part, 0.25, -0.15)
    assert found is not None
    near, distant, cover, _ = found
    assert (near, distant) == pytest.approx((0.3, -0.2), abs=0.03)
    assert cover == pytest.approx(drawn, abs=0.01)
