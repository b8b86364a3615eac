"""What every test in a browser opens its pages with."""

from tests.browser.opening import chromium, opened  # noqa: F401
