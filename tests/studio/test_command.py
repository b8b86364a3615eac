"""The command: it prints an address that answers, and says what is wrong with what it is given."""

from __future__ import annotations

import os
import signal
import stat
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest
from click.testing import CliRunner

from graphkin.cli import page_commands
from graphkin.cli.main import app
from graphkin.studio.server import Redirect, Served, serve
from graphkin.studio.session import Session
from graphkin.text.errors import PageError
from tests.studio.pump import PUMP, desk_in, running

ROOT = Path(__file__).resolve().parents[2]
STOPPED_BY_KEYS = """
import runpy, signal
signal.signal(signal.SIGINT, signal.default_int_handler)
runpy.run_module("graphkin", run_name="__main__", alter_sys=True)
"""
"""The command as a terminal starts it: what runs in the background is told to ignore Ctrl+C."""


@contextmanager
def started(folder: Path, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    """The command in a folder."""
    command = [sys.executable, "-c", STOPPED_BY_KEYS, "studio", *arguments]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "BROWSER": "true"}
    with subprocess.Popen(
        command,
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


@pytest.mark.parametrize("arguments", [("--no-browser", "one.toml"), ("pump", "--lang", "it")])
def test_the_address_that_is_printed_answers_until_it_is_stopped(tmp_path, arguments):
    (tmp_path / "one.toml").write_text(PUMP, encoding="utf-8")
    with started(tmp_path, *arguments) as process:
        assert process.stdout is not None
        address = urlsplit(process.stdout.readline().strip())
        assert address.hostname == "127.0.0.1"
        assert address.query in ("scene=one.toml", "lab=pump&rules=yes")
        line = HTTPConnection("127.0.0.1", address.port or 0)
        line.request("GET", f"{address.path}?{address.query}")
        page = line.getresponse().read().decode()
        assert ('<html lang="it"' in page) == ("it" in arguments)
        line.close()
        process.send_signal(signal.SIGINT)
        _, wrong = process.communicate()
        assert process.returncode in (0, 130)
        assert "Traceback" not in wrong
    assert [path.name for path in tmp_path.iterdir()] == ["one.toml"]


@pytest.mark.parametrize(
    ("name", "said"),
    [("nothing.toml", "neither a file nor a shipped lab"), ("../out.toml", "lies outside")],
)
def test_a_scene_that_cannot_be_opened_is_told(tmp_path, monkeypatch, name, said):
    inner = tmp_path / "inner"
    inner.mkdir()
    (tmp_path / "out.toml").write_text(PUMP, encoding="utf-8")
    monkeypatch.chdir(inner)
    result = CliRunner().invoke(app, ["studio", name, "--no-browser"])
    assert result.exit_code != 0
    assert said in result.output + str(result.exception)


def test_without_its_libraries_it_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "waitress", None)
    with pytest.raises(PageError, match=r"graphkin\[studio\]"):
        serve(desk_in(tmp_path))


def test_without_its_packages_it_says_what_to_install(monkeypatch):
    monkeypatch.setattr(page_commands, "find_spec", lambda name: None if name == "bottle" else name)
    result = CliRunner().invoke(page_commands.studio, ["--no-browser"])
    assert result.exit_code == 2
    assert "the studio needs bottle: pip install '.[studio]'" in result.output


def test_the_browser_is_led_by_a_file_of_this_user_alone_and_never_given_the_token(
    tmp_path, monkeypatch
):
    """Everybody on a computer can read the command lines that run on it."""
    (tmp_path / "one.toml").write_text(PUMP, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    opened, found = [], []

    class Server:
        def run(self) -> None:
            path = Path(url2pathname(urlsplit(opened[0]).path))
            found.append((path, path.read_text(encoding="utf-8"), path.parent.stat().st_mode))

    def serving(session: Session, port: int, first: object, known: Callable[[], None]) -> Served:
        found.append(known)
        return Served("http://127.0.0.1:1/secret/?scene=one.toml&lang=it", 1, Server())

    monkeypatch.setattr("graphkin.studio.server.serve", serving)
    monkeypatch.setattr("webbrowser.open", opened.append)
    result = CliRunner().invoke(page_commands.studio, ["one.toml"])
    assert result.exit_code == 0, result.output
    assert "secret" not in opened[0]
    _, (path, text, mode) = found
    assert 'url=http://127.0.0.1:1/secret/?scene=one.toml&amp;lang=it"' in text
    assert not stat.S_IMODE(mode) & 0o077
    assert not path.parent.exists()


def test_the_file_that_leads_to_the_page_is_gone_once_the_page_is_asked_for(tmp_path):
    redirect = Redirect()
    with running(serve(desk_in(tmp_path), known=redirect.remove)) as served:
        path = Path(url2pathname(urlsplit(redirect.write(served.address)).path))
        parts = urlsplit(served.address)
        for asked, left in (("/wrong/", True), (parts.path, False)):
            line = HTTPConnection("127.0.0.1", served.port)
            line.request("GET", asked)
            line.getresponse().read()
            line.close()
            assert path.exists() is left
