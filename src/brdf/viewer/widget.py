"""The page's viewer in a notebook: the same script, held by anywidget."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

from ..errors import MissingExtraError
from ..reflectance import Reflectance
from .linker import linked, sources
from .minified import minified
from .payload import View, payload


def widget(shown: Sequence[Reflectance], start: View | None = None) -> Any:
    """A widget of the reflectances. Its `state` (plain data) follows what is done in it and sets what it shows.

    Raises MissingExtraError without anywidget; else as `payload`.
    """
    return _widget_class()(payload=payload(shown, start))


@cache
def _widget_class() -> Any:
    try:
        import anywidget
        import traitlets
    except ImportError:
        raise MissingExtraError("a widget", "notebook") from None

    class Viewer(anywidget.AnyWidget):
        """Turns, lights and compares reflectances within a notebook."""

        _esm = linked("widget.js")
        _css = minified(sources()["style.css"], "text/css")
        payload = traitlets.Bytes(b"").tag(sync=True)
        state = traitlets.Dict().tag(sync=True)
        height = traitlets.Int(480, min=120, help="pixels").tag(sync=True)

    return Viewer
