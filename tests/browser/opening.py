"""Pages opened in the system's own browser; a test fails on any console error and any request."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NoReturn

import pytest

MUST = "GRAPHKIN_BROWSER"
"""The variable that makes a missing browser a failure."""
ARGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]
ARGS += ["--disable-background-networking", "--disable-component-update", "--disable-sync"]

Opened = Callable[..., Any]


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """Debian's chromium, driven by Playwright."""
    path = shutil.which("chromium") or shutil.which("chromium-browser")
    if not path:
        missing("no chromium is installed")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("playwright is not installed")
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=path, args=ARGS)
        yield browser
        browser.close()


def missing(reason: str) -> NoReturn:
    """Skip, or fail where browsers are a must."""
    if os.environ.get(MUST):
        pytest.fail(reason)
    pytest.skip(reason)


def barred(page: Any) -> list[tuple[str, list[str]]]:
    """What axe finds against a page: each rule, and what breaks it."""
    try:
        from axe_playwright_python.sync_playwright import Axe
    except ImportError:
        missing("axe-playwright-python is not installed")
    found = Axe().run(page).response["violations"]
    return [(rule["id"], [node["html"][:120] for node in rule["nodes"]]) for rule in found]


@pytest.fixture
def opened(chromium: Any) -> Iterator[Opened]:
    """Open a page: opened(path, "#step=3", color_scheme="dark")."""
    contexts, wrong = [], []

    def told(path: Path, place: str = "", **options: Any) -> Any:
        context = chromium.new_context(**options)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("request", lambda asked: None if local(asked.url) else wrong.append(asked.url))
        page.goto(path.as_uri() + place)
        return page

    yield told
    for context in contexts:
        context.close()
    assert not wrong


def local(url: str) -> bool:
    """Whether an address leads nowhere else."""
    return url.startswith(("file:", "blob:", "data:"))
