"""Pages opened in the system's own browser; a test fails on any console error and any request."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import pytest

MUST = "GRAPHKIN_BROWSER"
"""The variable that makes a missing browser a failure."""
ARGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]
ARGS += ["--disable-background-networking", "--disable-component-update", "--disable-sync"]
ARGS += ["--disable-site-isolation-trials", "--renderer-process-limit=1"]
"""All pages are drawn in one process: a new one for each studio's port costs more than the page."""
OFF = ("WebUIOmniboxPopup", "WebUIOmniboxAimPopup", "AimEnabled", "PaintHolding", "HttpsUpgrades")
OFF += ("MediaRouter", "OptimizationHints", "LensOverlay", "DestroyProfileOnBrowserClose")
ARGS += [f"--disable-features={','.join(OFF)}"]
"""Suggestions below the address take longer in each new window than a page in it. Only the last
list counts: the others are of Playwright's own."""

Opened = Callable[..., Any]
LONG = 300_000
"""Milliseconds after which nothing more is waited for, on however slow a machine."""
HOUR = 3600
"""Seconds after which the clock of a page stands still, for every page that a tab opens."""


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """Debian's chromium, driven by Playwright; it is started once, which takes seconds."""
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


@pytest.fixture(scope="module")
def page(chromium: Any) -> Iterator[Any]:
    """An empty page."""
    found = chromium.new_page()
    yield found
    found.close()


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
    found = Axe().run(page, options={"resultTypes": ["violations"]}).response["violations"]
    return [(rule["id"], [node["html"][:120] for node in rule["nodes"]]) for rule in found]


LOOK = {
    "viewport": {"width": 1280, "height": 720},
    "color_scheme": "light",
    "reduced_motion": "no-preference",
    "forced_colors": "none",
}
"""What a tab may be opened with in another way than before; Playwright's own values."""


@contextmanager
def heard(page: Any, event: str) -> Iterator[list[Any]]:
    """What a page tells of an event meanwhile; the tab, which others use later, forgets it then."""
    found: list[Any] = []

    def keep(told: Any) -> None:
        found.append(told)

    page.on(event, keep)
    yield found
    page.remove_listener(event, keep)


class Watch:
    """What a page tells on its console at some levels, and asks for beyond some addresses."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.begin((), ())
        page.set_default_timeout(LONG)
        page.on("console", self.told)
        page.on("pageerror", self.failed)
        page.on("request", self.asked)

    def begin(self, own: tuple[str, ...], levels: tuple[str, ...]) -> None:
        """Forget what was before."""
        self.own, self.levels = own, levels
        self.wrong: list[str] = []

    def told(self, said: Any) -> None:
        if said.type in self.levels:
            at = f"{said.location.get('url', '')[-60:]}:{said.location.get('lineNumber')}"
            self.wrong.append(f"console {said.type}: {said.text} ({at}; page {self.page.url})")

    def asked(self, request: Any) -> None:
        if not request.url.startswith(self.own):
            self.wrong.append(f"request: {request.method} {request.url} (page {self.page.url})")

    def failed(self, error: Any) -> None:
        self.wrong.append(f"uncaught: {error} {error.stack or ''} (page {self.page.url})")


class Tab:
    """A page of a context of its own, which opens one address after another as if it were new."""

    def __init__(self, chromium: Any, stopped: bool, **options: Any) -> None:
        self.page = chromium.new_context(**options).new_page()
        self.stopped, self.hours = stopped, 0
        self.watch = Watch(self.page)
        if stopped:
            self.page.clock.install(time=0)

    def open(self, address: str, **look: Any) -> Any:
        """Open an address; a page's clock that is stopped stands still once it is there."""
        self.hours += 1
        self.page.set_viewport_size(look.pop("viewport"))
        self.page.emulate_media(media="null", **look)
        self.page.goto(address)
        if self.stopped:
            self.page.clock.pause_at(HOUR * self.hours)
        return self.page

    def forget(self) -> None:
        """Leave the page, and what a test kept and pressed."""
        page = self.page
        page.evaluate("localStorage.clear(); sessionStorage.clear()")
        page.mouse.up()
        page.mouse.move(0, 0)
        if self.stopped:
            page.clock.resume()
        page.goto("about:blank")


@pytest.fixture(scope="session")
def tabs(chromium: Any) -> Iterator[dict[str, Tab]]:
    """The tabs, by what they were opened with: a new one costs more than a page."""
    found: dict[str, Tab] = {}
    yield found
    for tab in found.values():
        tab.page.context.close()


@contextmanager
def watched(
    chromium: Any, tabs: dict[str, Tab], own: tuple[str, ...], levels: tuple[str, ...]
) -> Iterator[Opened]:
    """Addresses opened in tabs, each in another: page(address, color_scheme="dark").

    Fails at the end for what any of them told on the console at one of the levels,
    for its uncaught errors, and for what it asked for but addresses that begin with one of own.
    """
    taken: dict[str, Tab] = {}

    def page(address: str, *, stopped: bool = False, **options: Any) -> Any:
        look = {name: options.pop(name, usual) for name, usual in LOOK.items()}
        key = repr((stopped, sorted(options.items())))
        while key in taken:
            key += "'"
        taken[key] = tab = tabs.pop(key, None) or Tab(chromium, stopped, **options)
        tab.watch.begin(own, levels)
        return tab.open(address, **look)

    yield page
    wrong = [line for tab in taken.values() for line in tab.watch.wrong]
    for tab in taken.values():
        tab.forget()
    tabs |= taken
    if wrong:
        pytest.fail("told or asked for by a page:\n" + "\n".join(wrong), pytrace=False)


ANEW = """() => {
  const part = name => document.getElementById(name), seen = name => part(name)?.checkVisibility();
  if (seen("turn-panel")) {
    if (seen("score")) part("turn-score").click();
    part("turn-end").click();
  }
  if (seen("back")) part("back").click();
  document.activeElement.blur();
}"""
"""Leave a turn, and put the driver back."""
LED = """async place => {
  if (location.hash === place) return;
  const there = new Promise(done => addEventListener("hashchange", done, { once: true }));
  location.hash = place;
  await there;
}"""
"""Go to a place of the same page."""
PAINTED = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
"""What is led is drawn in the next picture."""


@pytest.fixture(scope="module")
def kept(chromium: Any, tabs: dict[str, Tab]) -> Iterator[Opened]:
    """Open a page once for all tests of a module: kept(path, "#step=3"), where each begins anew."""
    there: dict[str, Any] = {}
    with watched(chromium, tabs, ("file:", "blob:", "data:"), ("error",)) as page:

        def led(path: Path, place: str = "#step=0", **options: Any) -> Any:
            key = repr((path, options))
            if key not in there:
                there[key] = page(path.as_uri() + place, **options)
                return there[key]
            shown = there[key]
            shown.emulate_media(media="null")
            shown.mouse.move(0, 0)
            for script, told in ((ANEW, None), (LED, place)):
                shown.evaluate(script, told)
                shown.clock.run_for(100) if options.get("stopped") else shown.evaluate(PAINTED)
            return shown

        yield led


@pytest.fixture
def opened(chromium: Any, tabs: dict[str, Tab]) -> Iterator[Opened]:
    """Open a page: opened(path, "#step=3", color_scheme="dark").

    Where it is stopped its clock stands still but for page.clock.run_for(milliseconds), so that
    what it does after a while comes then, however slow the machine is.
    """
    with watched(chromium, tabs, ("file:", "blob:", "data:"), ("error",)) as page:
        yield lambda path, place="", **options: page(path.as_uri() + place, **options)
