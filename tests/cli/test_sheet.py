"""Sheet writes whole files under clear names, and never over another file unasked."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

import graphkin.documents.sheet_documents
from graphkin.drawing.marks import Page
from graphkin.text.errors import PageError, Problem, WitnessError
from tests.chosen import FOLDER
from tests.running import Run


@dataclass(frozen=True)
class Part:
    """A sheet as hand_out gives it."""

    kind: str
    pages: tuple[Page, ...]
    unread: tuple[str, ...] = ()


@pytest.fixture
def blank(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, object]]:
    """Blank sheets in place of drawn ones, and what was asked of them."""
    asked: list[dict[str, object]] = []
    a3, a4 = Page(420, 297, (), "Blank"), Page(210, 297, (), "Blank")

    def hand_out(mechanism: object, view: str = "key", language: str | None = None) -> list[Part]:
        asked.append({"view": view, "language": language})
        return [
            Part("velocity", (a3,)),
            Part("acceleration", (a3,)),
            Part("calculation", (a4, a4)),
        ]

    monkeypatch.setattr(graphkin.documents.sheet_documents, "hand_out", hand_out)
    return asked


def names(folder: Path) -> list[str]:
    """The names in a folder, in order."""
    return sorted(path.name for path in folder.iterdir())


def test_files_are_named_after_scene_setting_kind_and_view(
    run: Run, tmp_path: Path, blank: object
) -> None:
    out = tmp_path / "new" / "sheets"
    result = run("sheet", "pump", "--set", "n=7", "-o", out)
    assert result.exit_code == 0, result.stderr
    assert names(out) == [
        "pump-n7-acceleration-key.pdf",
        "pump-n7-acceleration-key.svg",
        "pump-n7-calculation-key.pdf",
        "pump-n7-velocity-key.pdf",
        "pump-n7-velocity-key.svg",
    ]
    assert sorted(Path(line).name for line in result.stdout.splitlines()) == names(out)
    assert (out / "pump-n7-velocity-key.svg").read_text(encoding="utf-8").startswith("<?xml")
    assert (out / "pump-n7-calculation-key.pdf").read_bytes().startswith(b"%PDF")


def test_several_views_are_written_at_once(run: Run, tmp_path: Path, blank: object) -> None:
    result = run("sheet", "pump", "-o", tmp_path, "--view", "key,task", "--format", "pdf")
    assert result.exit_code == 0, result.stderr
    kinds = ("acceleration", "calculation", "velocity")
    assert names(tmp_path) == [
        f"pump-{kind}-{view}.pdf" for kind in kinds for view in ("key", "task")
    ]


def test_existing_files_are_kept_unless_forced(run: Run, tmp_path: Path, blank: object) -> None:
    old = tmp_path / "pump-velocity-key.pdf"
    old.write_text("mine")
    result = run("sheet", "pump", "-o", tmp_path)
    assert result.exit_code == 2
    assert "exists already" in result.stderr
    assert "--force" in result.stderr
    assert old.read_text() == "mine"
    assert names(tmp_path) == [old.name]
    assert run("sheet", "pump", "-o", tmp_path, "--force").exit_code == 0
    assert old.read_bytes().startswith(b"%PDF")
    assert len(names(tmp_path)) == 5


@pytest.mark.parametrize(
    ("error", "status", "words"),
    [
        (PageError(Problem("labels", "does not fit", "room")), 2, "pump: labels: does not fit; "),
        (WitnessError(Problem("points.D", "differ")), 1, "points.D: differ"),
    ],
)
def test_what_cannot_be_handed_out_is_not_written(
    run: Run,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    error: Exception,
    status: int,
    words: str,
) -> None:
    def refuse(*args: object, **kwargs: object) -> None:
        raise error

    monkeypatch.setattr(graphkin.documents.sheet_documents, "hand_out", refuse)
    result = run("sheet", "pump", "-o", tmp_path / "out")
    assert result.exit_code == status
    assert result.stderr.startswith(f"graphkin: {words}")
    assert not (tmp_path / "out").exists()


def test_a_page_that_cannot_be_rendered_leaves_nothing(
    run: Run, tmp_path: Path, blank: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    import graphkin.writers.pdf

    def full(*args: object, **kwargs: object) -> bytes:
        raise MemoryError

    monkeypatch.setattr(graphkin.writers.pdf, "write_pdf", full)
    result = run("sheet", "pump", "-o", tmp_path / "out")
    assert result.exit_code == 2
    assert "Traceback" not in result.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("formats", ["png", "", "svg,png"])
def test_an_unknown_format_is_refused(run: Run, tmp_path: Path, formats: str) -> None:
    result = run("sheet", "pump", "-o", tmp_path, "--format", formats)
    assert result.exit_code == 2
    assert "svg,pdf" in result.stderr


@pytest.mark.parametrize("formats", ["html", "pdf,html", "html,pmks"])
def test_an_overlay_as_a_page_says_what_to_leave_out_and_writes_nothing(
    run: Run, tmp_path: Path, formats: str
) -> None:
    out = tmp_path / "out"
    result = run("sheet", "pump", "-o", out, "--format", formats, "--view", "overlay")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr == (
        "graphkin: pump: --view overlay: is laid over a drawing on paper, and html is a page for a "
        "screen; expected --format svg, pdf or dxf; leave html out of --format, or write another "
        "--view; nothing is written\n"
    )
    assert not out.exists()


@pytest.mark.parametrize(
    ("language", "told"),
    [
        ("en", "Velocity plan: zero, nothing to be read off: v_S, ω_2"),
        ("ro", "Planul vitezelor: zero, nimic de citit: v_S, ω_2"),
        ("it", "Poligono delle velocità: zero, nulla da leggere: v_S, ω_2"),
    ],
)
@pytest.mark.parametrize(
    ("formats", "view"), [("svg", "key"), ("html", "key"), ("html", "task"), ("html,svg", "key")]
)
def test_what_is_asked_and_stands_still_is_told_aside(
    run: Run, tmp_path: Path, language: str, told: str, formats: str, view: str
) -> None:
    """On paper and on a page for a browser alike, and once where both are written."""
    scene = FOLDER / "geneva-dwell.toml"
    how = ("--lang", language, "--format", formats, "--view", view)
    result = run("sheet", scene, "-o", tmp_path, *how)
    assert result.exit_code == 0
    assert result.stderr.count(f"graphkin: {told}\n") == 1
    assert told not in result.stdout


@pytest.mark.parametrize("formats", ["svg", "html"])
def test_a_vector_that_is_asked_and_drawn_shorter_than_two_millimetres_is_told(
    run: Run, tmp_path: Path, formats: str
) -> None:
    """A piston on the line of its crank has its dead point at 0°."""
    scene = tmp_path / "near.toml"
    text = (FOLDER / "slider-crank.toml").read_text(encoding="utf-8")
    text = text.replace('angle = "angle"', "angle = 0.2").replace(", offset = 30", "")
    scene.write_text(text, encoding="utf-8")
    result = run("sheet", scene, "-o", tmp_path, "--lang", "en", "--format", formats)
    assert result.exit_code == 0, result.stderr
    assert "Velocity plan: too short to be read off (less than 2 mm): v_B (" in result.stderr


@pytest.mark.parametrize("formats", ["svg", "html"])
def test_a_sheet_on_which_all_that_is_asked_can_be_read_off_says_nothing(
    run: Run, tmp_path: Path, formats: str
) -> None:
    result = run("sheet", "pump", "--set", "n=7", "-o", tmp_path, "--format", formats)
    assert (result.exit_code, result.stderr) == (0, "")
