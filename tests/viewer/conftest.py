"""A browser for the tests of pages: Chromium on Mesa's software driver."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import brdf.viewer

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page, Route

WEB = Path(brdf.viewer.__file__).with_name("web")

ON_MESA = ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--no-sandbox"]

ON_ITSELF = ["--enable-unsafe-swiftshader", "--no-sandbox"]
"""By the software driver that Chromium brings along."""

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")

ADDRESS = "http://viewer.test/"
"""Where the modules are found by a page of these tests; nothing leaves the process."""


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Chromium (Debian: chromium libegl1 libgl1-mesa-dri libgles2)."""
    playwright = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None:
        pytest.skip("no Chromium; Debian has it in the package chromium")
    with playwright.sync_playwright() as engine:
        launched = engine.chromium.launch(executable_path=CHROMIUM, args=ON_MESA)
        yield launched
        launched.close()


@pytest.fixture
def modules(browser: Browser) -> Iterator[Page]:
    """An empty page that can import the viewer's modules; what it writes to the console as an error fails the test."""
    yield from module_page(browser)


@pytest.fixture
def modules_on_itself(browser: Browser) -> Iterator[Page]:
    """The same in a Chromium that draws by its own driver."""
    launched = browser.browser_type.launch(executable_path=CHROMIUM, args=ON_ITSELF)
    yield from module_page(launched)
    launched.close()


def module_page(browser: Browser) -> Iterator[Page]:
    page = browser.new_page(viewport={"width": 800, "height": 600})
    wrong: list[str] = []
    page.on("console", lambda message: wrong.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.route(f"{ADDRESS}**", _module)
    page.goto(ADDRESS)
    yield page
    page.close()
    assert wrong == []


def _module(route: Route) -> None:
    name = route.request.url.removeprefix(ADDRESS)
    kinds = {".js": "text/javascript", ".css": "text/css"}
    if not name:
        route.fulfill(body="<!doctype html><title>modules</title><link rel=icon href=data:,>", content_type="text/html")
    else:
        route.fulfill(body=(WEB / name).read_text("utf-8"), content_type=kinds[Path(name).suffix])
