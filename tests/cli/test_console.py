"""The console: statuses, nearest names, encodings, pipes, and what is imported."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from graphkin.cli.options import BROKEN_PIPE
from tests.running import ROOT, Run, command


@pytest.mark.parametrize(
    ("args", "answer"),
    [
        (["sovle", "pump"], "did you mean solve?"),
        (["Check", "pump"], "did you mean check?"),
        (["zzz"], "commands are manual, help"),
        (["solve", "pmup"], "did you mean pump?"),
        (["solve", "pump", "--jsno"], "--json"),
        (["solve", "pump", "--set", "m=7"], "expected n"),
        (["solve", "pump", "--set", "n=31"], "n from 1 to 30"),
        (["solve", "pump", "--set", "n"], "NAME=VALUE"),
        (["solve", "pump", "--set", "=7"], "NAME=VALUE"),
        (["solve", "pump", "--set", "n=7", "--set", "n=8"], "set twice"),
        (["solve", "pump", "--set", "name=8"], "expected n"),
        (["solve"], "SCENE"),
        (["solve", "pump", "more"], "more"),
        (["sheet", "pump", "--view", "kye"], "did you mean key?"),
        (["sheet", "pump", "--view", "task,kye"], "did you mean key?"),
        (["solve", "missing.toml"], "neither a file nor a shipped lab"),
        (["solve", "a\0b"], "neither a file nor a shipped lab"),
        (["solve", "x" * 5000], ""),
        (["solve", ""], "graphkin: .: is a folder without scene.toml"),
        (["sheet", "pump", "-o", ""], "the name of the folder is empty"),
        (["check", "pump", "--set", "n=31"], "graphkin: pump: setting n: n = 31 is out of range"),
    ],
)
def test_mistakes_are_answered_with_status_2(run: Run, args: list[str], answer: str) -> None:
    result = run(*args)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith("graphkin: ")
    assert answer in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize(
    "data", [b"", b"\xff\xfe\0", b"graphkin = [", b"graphkin = 1", b"\0" * 100, b"x = " * 99]
)
def test_unreadable_scenes_are_told_in_lines(run: Run, tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "scene.toml"
    path.write_bytes(data)
    for name in ("solve", "check", "explain", "sheet"):
        result = run(name, path)
        assert result.exit_code == 2
        assert result.stderr
        assert all(line.startswith("graphkin: ") for line in result.stderr.splitlines())


def test_a_link_that_leads_nowhere_is_not_proposed_in_its_own_place(
    run: Run, tmp_path: Path
) -> None:
    loop = tmp_path / "scene.toml"
    loop.symlink_to(loop)
    result = run("solve", loop)
    assert result.exit_code == 2
    assert "is neither a file nor a shipped lab" in result.stderr
    assert "did you mean" not in result.stderr


def test_a_fault_of_our_own_is_one_line(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from graphkin.mechanism import Mechanism

    monkeypatch.delenv("GRAPHKIN_TRACEBACK", raising=False)
    monkeypatch.setattr(Mechanism, "trace", lambda self, targets: 1 / 0)
    result = run("solve", "pump")
    assert result.exit_code == 2
    assert result.stderr.startswith("graphkin: a fault in graphkin itself (ZeroDivisionError")
    assert len(result.stderr.splitlines()) == 1


def test_the_module_and_the_statuses_of_a_real_process() -> None:
    assert command("solve", "pump").returncode == 0
    assert command("solve", "pmup").returncode == 2
    found = json.loads(command("solve", "pump", "--json").stdout)
    assert found["points"]["D"]["velocity"][0] == pytest.approx(-3.826845090, rel=1e-9)


@pytest.mark.parametrize(
    "surroundings",
    [
        {"PYTHONIOENCODING": "ascii"},
        {"PYTHONIOENCODING": "cp1252"},
        {"PYTHONIOENCODING": "cp437"},
        {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    ],
)
def test_output_is_utf8_whatever_the_console(surroundings: dict[str, str]) -> None:
    result = command("solve", "pump", **surroundings)
    assert result.returncode == 0
    assert result.stderr == b""
    assert "ε, rad/s²" in result.stdout.decode("utf-8")
    wrong = command("solve", "Pompă–ω", **surroundings)
    assert wrong.returncode == 2
    assert b"Traceback" not in wrong.stderr
    wrong.stderr.decode("utf-8")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk_behind_a_redirection_is_one_line() -> None:
    with Path("/dev/full").open("wb") as full:
        result = subprocess.run(
            [sys.executable, "-m", "graphkin", "solve", "pump"],
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
        )
    assert result.returncode == 2
    assert result.stderr.startswith(b"graphkin: output: ")
    assert len(result.stderr.splitlines()) == 1


@pytest.mark.skipif(os.name == "nt", reason="pipes close otherwise there")
@pytest.mark.parametrize("args", [("solve", "pump"), ("check", "pump"), ("list",), ("--help",)])
def test_a_reader_that_stops_early_is_no_traceback(args: tuple[str, ...]) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "wb") as pipe:
        result = subprocess.run(
            [sys.executable, "-m", "graphkin", *args],
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdout=pipe,
            stderr=subprocess.PIPE,
            check=False,
        )
    assert result.returncode == BROKEN_PIPE
    assert result.stderr == b""


HOSTILE = "\x1b]0;owned\x07\x1b[31m\u202e\x9b1m"
SHOWN = r"\u001b]0;owned\u0007\u001b[31m\u202e\u009b1m"


@pytest.mark.skipif(sys.platform == "win32", reason="no such names there")
def test_nothing_that_a_terminal_obeys_is_printed_of_a_file_name(run: Run, tmp_path: Path) -> None:
    """Neither among what is found nor among what is wrong; JSON means the same name."""
    pump = (ROOT / "sheets/pump/scene.toml").read_text(encoding="utf-8")
    scene, answers = tmp_path / f"{HOSTILE}.toml", tmp_path / "answers"
    scene.write_text(pump, encoding="utf-8")
    answers.mkdir()
    (answers / f"{HOSTILE}.csv").write_text("field,value\nv_D,1\n", encoding="utf-8")
    roster = tmp_path / "roster.csv"
    roster.write_text("nr,id\n7,1\n", encoding="utf-8")
    run("variants", "pump", roster, "-o", tmp_path / "class")
    for args, channel in (
        (("check", scene), "stdout"),
        (("solve", scene, "--json"), "stdout"),
        (("check", f"{scene}.none"), "stderr"),
        (("sheet", scene, "-o", tmp_path / HOSTILE), "stdout"),
        (("grade", tmp_path / "class", answers), "stderr"),
    ):
        result = run(*args)
        assert SHOWN in getattr(result, channel)
        assert not set(HOSTILE) & set("\x1b\x07\u202e\x9b") & set(result.stdout + result.stderr)
    assert json.loads(run("solve", scene, "--json").stdout)["name"] == HOSTILE


ENDING = """
import atexit, sys
atexit.register(print, "registered")
sys.argv = ["graphkin", *{words!r}]
{before}
from graphkin.__main__ import main
try:
    main()
except SystemExit:
    print("taken apart")
"""


def ended(words: list[str], before: str = "") -> tuple[int, list[str]]:
    """The status of a command in a process of its own, and what it says, line by line."""
    return of_process(ENDING.format(words=words, before=before))


def of_process(code: str) -> tuple[int, list[str]]:
    """The status of a program, and what it says."""
    words = [sys.executable, "-c", code]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout.splitlines()


@pytest.mark.parametrize(("words", "status"), [(["list"], 0), (["solve", "pmup"], 2)])
def test_the_end_does_what_is_registered_and_keeps_the_status(words: list[str], status: int):
    found, lines = ended(words)
    assert found == status
    assert lines[-1] == "registered"
    assert len(lines) > 1 or status


@pytest.mark.parametrize(
    "before",
    [
        "sys.setprofile(lambda *_: None)",
        "import threading; threading.Thread(target=threading.Event().wait, daemon=True).start()",
    ],
)
def test_who_watches_or_works_beside_it_sees_the_usual_end(before: str):
    assert ended(["list"], before)[1][-2:] == ["taken apart", "registered"]


def test_solve_loads_nothing_that_only_other_mechanisms_or_pages_need():
    code = "import sys; sys.argv = ['graphkin', 'solve', 'pump']; " + (
        "from graphkin.cli.main import app\ntry: app()\nexcept SystemExit: print(*sys.modules)"
    )
    loaded = of_process(code)[1][-1].split()
    assert "graphkin.loops.witness" in loaded
    rooms = ("writers", "motion", "accuracy", "web", "classroom", "studio", "reading")
    kinds = ("rolling", "cams", "higher_class", "coriolis", "tape", "centres.kennedy")
    parts = tuple(f"graphkin.{each}" for each in rooms)
    parts += tuple(f"graphkin.construction.{each}" for each in kinds)
    parts += ("graphkin.scene.keepers", "graphkin.scene.read_cams", "graphkin.drawing.labels")
    assert [name for name in loaded if name.startswith(parts)] == []
