"""Exported pages in a browser, as a person uses them."""

from __future__ import annotations

import base64
import io
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pictures

if TYPE_CHECKING:
    from playwright.sync_api import Browser, CDPSession, Locator, Page

LIMIT = 60_000
"""Milliseconds after which what should happen did not: software drivers on busy machines take their time."""

SIZE = {"width": 700, "height": 400}

DONE = "document.querySelector('#viewer').dataset.state === 'done'"


class Opened:
    """A page, its viewer's state, and what went wrong in it."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.wrong: list[str] = []
        page.set_default_timeout(LIMIT)
        page.on("console", lambda message: self._note(message.type in ("error", "warning"), message.text))
        page.on("pageerror", lambda error: self._note(True, str(error)))
        page.on("requestfailed", lambda request: self._note(True, f"request failed: {request.url[:100]}"))
        page.on("request", lambda request: self._note(not request.url.startswith(OWN), f"asked for {request.url}"))

    def _note(self, counts: bool, text: str) -> None:
        if counts and "GPU stall due to ReadPixels" not in text:  # Chromium's remark on reading pixels at all
            self.wrong.append(text)

    def open(self, address: str) -> Opened:
        self.page.goto(address)
        self.until("Boolean(globalThis.viewer)")
        self.page.locator("#picture").wait_for(state="detached")
        return self

    def until(self, expression: str) -> None:
        """Waits for a JavaScript expression to be true; Playwright's own way needs `eval`, which pages forbid."""
        end = time.monotonic() + LIMIT / 1000
        while not self.page.evaluate(expression):
            assert time.monotonic() < end, expression
            time.sleep(0.03)

    @property
    def state(self) -> dict[str, Any]:
        return dict(self.page.evaluate("viewer.state"))

    def set(self, **patch: Any) -> None:
        self.page.evaluate("patch => viewer.setState(patch)", patch)

    def home(self) -> None:
        """As it was opened."""
        self.page.evaluate("viewer.setState(viewer.home); viewer.lighting = false; viewer.select(0)")

    @property
    def canvas(self) -> Locator:
        return self.page.get_by_role("img", name=" on a ")

    def middle(self) -> tuple[float, float]:
        """Of the canvas, in the window."""
        box = self.canvas.bounding_box()
        assert box is not None
        return box["x"] + box["width"] / 3, box["y"] + box["height"] / 2

    def drag(self, start: tuple[float, float], end: tuple[float, float], button: Any = "left") -> None:
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down(button=button)
        mouse.move(*((a + b) / 2 for a, b in zip(start, end, strict=True)))
        mouse.move(*end)
        mouse.up(button=button)
        self.settle()

    def settle(self) -> None:
        """Waits for events that browsers hold back until the next frame."""
        self.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def touch(self, kind: str, *points: tuple[float, float]) -> None:
        """ "touchStart", "touchMove" or "touchEnd" of fingers."""
        self._touches = getattr(self, "_touches", None) or self.page.context.new_cdp_session(self.page)
        fingers = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)]
        session: CDPSession = self._touches
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})
        self.settle()

    def finished(self) -> None:
        """Waits until the picture gets no better."""
        self.until(DONE)

    def picture(self) -> NDArray[np.uint8]:
        """(H, W, 3): the canvas's pixels, when it is finished."""
        self.finished()
        data = self.page.evaluate(
            """async () => {
                const bytes = new Uint8Array(await (await viewer.png()).arrayBuffer());
                return btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""));
            }"""
        )
        return np.asarray(Pictures.open(io.BytesIO(base64.b64decode(data))).convert("RGB"))


OWN = ("file:", "data:", "blob:", "http://127.0.0.1:")


@contextmanager
def opened(browser: Browser, **options: Any) -> Iterator[Opened]:
    """An empty page; what is written to its console, and what it asks of the network, fails the test."""
    context = browser.new_context(viewport=options.pop("viewport", SIZE), **options)
    found = Opened(context.new_page())
    yield found
    context.close()
    assert found.wrong == []


def address(path: Path, state: str = "") -> str:
    return path.as_uri() + (f"#{state}" if state else "")
