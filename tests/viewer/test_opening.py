"""`brdf.view`: a server outside notebooks, a widget in them."""

from __future__ import annotations

import sys
import threading
import types
import urllib.request
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from tests.viewer.pages import opened

import brdf
import containers
from brdf.errors import MissingExtraError, ParameterError, UnknownNameError
from brdf.models import GGX, Lambertian
from brdf.viewer import opening
from brdf.viewer.payload import View
from brdf.viewer.widget import _widget_class

if TYPE_CHECKING:
    from playwright.sync_api import Browser

LIMIT = 60.0


def got(address: str) -> bytes:
    with urllib.request.urlopen(address, timeout=LIMIT) as answer:
        return bytes(answer.read())


def test_the_page_is_served_with_its_data_and_picture() -> None:
    server = opening.serve([GGX(alpha=0.2), "Lambertian:albedo=.5"], View(mesh="sphere"))
    try:
        page = got(server.address).decode()
        assert "<title>GGX · Lambertian:albedo=.5</title>" in page
        assert 'id="payload"' not in page
        assert '<img data-src="picture"' in page  # asked for where the viewer cannot run, for it takes seconds to draw
        assert "connect-src 'self'" in page
        about, _ = containers.read(got(f"{server.address}payload"))
        assert about["title"] == "GGX · Lambertian:albedo=.5"
        assert about["comparison"] is None
        assert got(f"{server.address}picture").startswith(b"RIFF")
    finally:
        server.stop()


def test_a_file_is_read_again_when_it_changes(tmp_path: Path) -> None:
    path = tmp_path / "m.safetensors"
    GGX(alpha=0.2).save(path)
    server = opening.serve([path], View(mesh="sphere"))
    try:
        assert parameters(got(f"{server.address}payload"))["alpha"] == 0.2
        GGX(alpha=0.7).save(path)
        while server.after(0) == 0:
            pass
        assert parameters(got(f"{server.address}payload"))["alpha"] == 0.7
    finally:
        server.stop()


def parameters(payload: bytes) -> dict[str, float]:
    about, _ = containers.read(payload)
    return {p["name"]: p["value"] for p in about["materials"][0]["shader"]["parameters"]}


def test_view_prints_the_address_opens_it_and_ends(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    opened: list[str] = []
    asked = threading.Event()

    def open_(address: str) -> bool:
        opened.append(address)
        asked.set()
        return True

    def interrupted(server: Any) -> None:
        assert asked.wait(LIMIT)
        assert b"<title>GGX" in got(server.address)
        raise KeyboardInterrupt

    monkeypatch.setattr(opening.webbrowser, "open", open_)
    monkeypatch.setattr(opening.Server, "wait", interrupted)
    assert brdf.view(GGX(), mesh="sphere") is None
    assert capsys.readouterr().out.split() == opened


def test_where_no_browser_is_found_that_is_said(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    said = threading.Event()

    class Told:
        def write(self, text: str) -> None:
            if "no browser was found" in text:
                said.set()

        def flush(self) -> None:
            pass

    def interrupted(server: Any) -> None:
        assert said.wait(LIMIT)
        raise KeyboardInterrupt

    monkeypatch.setattr(opening.webbrowser, "open", lambda address: False)
    monkeypatch.setattr(opening.Server, "wait", interrupted)
    monkeypatch.setattr(sys, "stderr", Told())
    brdf.view(GGX(), mesh="sphere")


def test_in_a_notebook_it_is_a_widget(monkeypatch: pytest.MonkeyPatch) -> None:
    ipython = pytest.importorskip("IPython")
    shell = types.SimpleNamespace(kernel=object())
    monkeypatch.setattr(ipython, "get_ipython", lambda: shell)
    shown = brdf.view(GGX(alpha=0.3), Lambertian(), mesh="plane", lights="directional:theta=20")
    about, _ = containers.read(shown.payload)
    assert about["title"] == "GGX · Lambertian"
    assert about["state"]["mesh"] == "plane"
    assert shown.state == {}
    shown.state = {"exposure": 1.0}
    assert shown.get_state(["state"]) == {"state": {"exposure": 1.0}}
    assert "export default" in shown._esm


@pytest.mark.parametrize("running", [True, False])
def test_marimo_says_whether_a_notebook_runs(running: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "marimo", types.SimpleNamespace(running_in_notebook=lambda: running))
    monkeypatch.delitem(sys.modules, "IPython", raising=False)
    assert opening.in_notebook() is running


def test_a_terminal_with_ipython_is_no_notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    for shell in (None, types.SimpleNamespace()):
        monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda shell=shell: shell))
        assert not opening.in_notebook()


def test_without_anywidget_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "anywidget", None)
    _widget_class.cache_clear()
    with pytest.raises(MissingExtraError, match=r"pip install 'brdf\[notebook\]'"):
        _widget_class()


def test_mistakes_are_found_before_anything_is_served() -> None:
    with pytest.raises(ParameterError, match="nothing to show"):
        brdf.view()
    with pytest.raises(UnknownNameError, match="did you mean 'GGX'"):
        brdf.view("GXG")
    with pytest.raises(UnknownNameError, match="unknown mesh 'teapott'"):
        brdf.view(GGX(), mesh="teapott")


def test_an_open_page_follows_the_file(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "m.safetensors"
    GGX(alpha=0.2, F0=(1, 0, 0)).save(path)
    server = opening.serve([path], View(mesh="sphere", lights="directional:theta=40"))
    try:
        with opened(browser) as page:
            page.open(server.address)
            page.set(exposure=1.0)
            page.until("location.hash.includes('exposure')")
            red = page.picture().reshape(-1, 3).astype(float).mean(0)
            GGX(alpha=0.2, F0=(0, 0, 1)).save(path)
            page.until("viewer.slots.at(0).values.F0[2] === 1")
            blue = page.picture().reshape(-1, 3).astype(float).mean(0)
            assert red[0] > red[2]
            assert blue[2] > blue[0]
            assert page.state["exposure"] == 1  # what was chosen stays
    finally:
        server.stop()
