"""`brdf.view`: reflectances in a browser, or beside the code in a notebook."""

from __future__ import annotations

import os
import sys
import threading
import webbrowser
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from ..errors import BrdfError, ParameterError
from ..loading import files_of, load
from ..reflectance import Reflectance
from .page import document
from .payload import View, payload, title_of
from .server import Contents, Server

if TYPE_CHECKING:
    from ..render import Environment, Mesh
    from ..render.lights import Light

Shown = Reflectance | str | os.PathLike[str]


def view(
    *shown: Shown,
    mesh: str | os.PathLike[str] | Mesh = "teapot",
    lights: Iterable[Light | str] | Light | str | None = None,
    env: str | os.PathLike[str] | float | Environment | None = None,
    exposure: float = 0.0,
    tone: str = "filmic",
    shadows: bool = True,
    port: int = 0,
    browser: bool = True,
) -> Any:
    """Show one reflectance, or several to compare, each a reflectance or whatever `brdf.load` takes.

    In a notebook: a widget, whose `state` reads and sets what is shown. Else a page on this machine, opened in the
    browser (unless `browser` is False) at an address that is printed, until Ctrl-C; files are read again whenever they
    change. `mesh`, `lights`, `env`, `exposure`, `tone` and `shadows`: how it starts, as in `brdf.render`. `port`: 0
    for any free one. Raises ParameterError, ReflectanceError, SceneError, UnknownNameError, FileError.
    """
    start = View(mesh, lights, env, exposure, tone, shadows)
    if in_notebook():
        from .widget import widget

        return widget([_loaded(m) for m in shown], start)
    server = serve(shown, start, port)
    print(server.address, flush=True)
    run(server, browser)
    return None


def serve(shown: Sequence[Shown], start: View, port: int = 0) -> Server:
    """A running server of the page. Raises as `load`, and ParameterError for a port that cannot be used."""
    if not shown:
        raise ParameterError("there is nothing to show; give at least one reflectance")
    watched = followed(shown, start)
    first: Contents | None = _contents([_loaded(m) for m in shown], start)

    def make() -> Contents:
        nonlocal first
        made, first = first, None
        return made or _read_again(shown, start)

    return Server(make, watched, port)


def _contents(shown: Sequence[Reflectance], start: View) -> Contents:
    data, image = Once(lambda: payload(shown, start, compare=False)), Once(lambda: picture_of(shown, start))
    return Contents(document(title_of(shown), "picture"), data, image)


def _read_again(shown: Sequence[Shown], start: View) -> Contents:
    try:
        # Lights may have come from what can be gone through once; the mesh and the environment are read anew.
        return _contents([_loaded(m) for m in shown], replace(start, lights=start.chosen_lights))
    except BrdfError as error:
        problem = error

    def fail() -> NoReturn:
        raise problem

    title = " · ".join(m.name or type(m).__name__ if isinstance(m, Reflectance) else os.fspath(m) for m in shown)
    return Contents(document(title, "picture"), fail, fail)


def followed(shown: Sequence[Shown], start: View) -> list[Path]:
    """The files whose changes a page shows: of the reflectances, the mesh and the environment."""
    found = [path for m in shown if not isinstance(m, Reflectance) for path in files_of(m)]
    for given in (start.mesh, start.env):
        if isinstance(given, (str, os.PathLike)) and os.path.isfile(given):
            found.append(Path(given))
    return found


def run(server: Server, browser: bool) -> None:
    """Open the page, have its data ready by the time the browser asks, and serve it until Ctrl-C.

    Raises BrdfError where the data cannot be made.
    """
    try:
        if browser:
            threading.Thread(target=_open, args=(server.address,), daemon=True).start()
        server.contents.payload()
        server.wait()
    except KeyboardInterrupt:
        pass
    finally:
        server.stop()


def _open(address: str) -> None:
    if not webbrowser.open(address):
        print("no browser was found; open the address above in one", file=sys.stderr, flush=True)


class Once:
    """A function without arguments that is called at most once, whoever asks."""

    def __init__(self, make: Callable[[], bytes]) -> None:
        self._make = make
        self._lock = threading.Lock()
        self._made: bytes | None = None

    def __call__(self) -> bytes:
        with self._lock:
            if self._made is None:
                self._made = self._make()
            return self._made


def picture_of(shown: Sequence[Reflectance], start: View) -> bytes:
    """The picture for browsers that cannot run the viewer, which seldom is asked for."""
    from .picture import picture

    return picture(shown, start)


def in_notebook() -> bool:
    """Whether what an expression gives is shown by a notebook: Jupyter's or marimo's."""
    marimo = sys.modules.get("marimo")
    if marimo is not None and marimo.running_in_notebook():
        return True
    if "IPython" not in sys.modules:
        return False
    from IPython import get_ipython

    shell = get_ipython()
    return shell is not None and hasattr(shell, "kernel")


def _loaded(m: Shown) -> Reflectance:
    return m if isinstance(m, Reflectance) else load(m)
