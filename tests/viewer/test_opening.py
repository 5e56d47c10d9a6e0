"""`brdf.view`: a server outside notebooks, a widget in them."""

from __future__ import annotations

import contextlib
import sys
import threading
import types
import urllib.request
from collections.abc import Iterator
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
from brdf.viewer.server import Server
from brdf.viewer.widget import _widget_class

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

LIMIT = 60.0


@contextlib.contextmanager
def served(shown: list[Any], start: View | None = None) -> Iterator[Server]:
    """The page of materials, on a sphere, while it is needed."""
    server = opening.serve(shown, start or View(mesh="sphere"))
    try:
        yield server
    finally:
        server.stop()


def got(address: str) -> bytes:
    with urllib.request.urlopen(address, timeout=LIMIT) as answer:
        return bytes(answer.read())


def test_the_page_is_served_with_its_data_and_picture() -> None:
    with served([GGX(alpha=0.2), "Lambertian:albedo=.5"]) as server:
        page = got(server.address).decode()
        assert "<title>GGX · Lambertian:albedo=.5</title>" in page
        assert 'id="payload"' not in page
        assert '<noscript><img src="picture"' in page  # only where it is needed, for it takes seconds to draw
        assert "connect-src 'self'" in page
        about, _ = containers.read(got(f"{server.address}payload"))
        assert about["title"] == "GGX · Lambertian:albedo=.5"
        assert about["comparison"] is None
        assert got(f"{server.address}picture").startswith(b"RIFF")


def test_a_file_is_read_again_when_it_changes(tmp_path: Path) -> None:
    path = tmp_path / "m.safetensors"
    GGX(alpha=0.2).save(path)
    with served([path]) as server:
        assert parameters(got(f"{server.address}payload"))["alpha"] == 0.2
        GGX(alpha=0.7).save(path)
        while server.after(0) == 0:
            pass
        assert parameters(got(f"{server.address}payload"))["alpha"] == 0.7


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
    with served([path], View(mesh="sphere", lights="directional:theta=40")) as server, opened(browser) as page:
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
        GGX(alpha=0.2).named("another").save(path)
        page.until("document.title === 'another'")


def test_changes_in_quick_succession_leave_one_viewer(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "m.safetensors"
    GGX(alpha=0.2).save(path)
    with served([path]) as server, opened(browser) as page:
        page.open(server.address)
        for number in range(1, 5):
            GGX(alpha=number / 10).save(path)
            announce(server)
        page.until("viewer.slots.at(0).values.alpha === 0.4")
        page.page.locator("#picture").wait_for(state="detached")
        assert page.page.locator("#viewer canvas").count() == page.page.locator("#viewer > *").count() == 1


def announce(server: Any) -> None:
    """As if a changed file was seen."""
    with server._lock:
        server._made = None
    with server._news:
        server.version += 1
        server._news.notify_all()


def test_what_changes_before_the_page_listens_is_shown(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "m.safetensors"
    GGX(alpha=0.2).save(path)
    with served([path]) as server, opened(browser) as page:

        def late(route: Any) -> None:
            GGX(alpha=0.7).save(path)
            while server.after(0) == 0:
                pass
            route.continue_()

        page.page.route("**/events", late)
        page.open(server.address)
        page.until("viewer.slots.at(0).values.alpha === 0.7")


def test_a_page_of_a_broken_file_says_so_and_recovers(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "m.safetensors"
    GGX(alpha=0.2).save(path)
    with served([path]) as server:
        context = browser.new_context()
        page = context.new_page()
        page.goto(server.address)
        whole = path.read_bytes()
        path.write_bytes(whole[:-20])
        says(page, "m.safetensors: ")
        page.reload()
        says(page, "m.safetensors: ")
        assert page.locator("#picture img").count() == 0
        path.unlink()
        says(page, "m.safetensors: no such file")
        path.write_bytes(whole)
        page.locator("#viewer canvas").wait_for()
        page.locator("#picture").wait_for(state="detached")
        context.close()


def says(page: Page, text: str) -> None:
    page.locator("figcaption", has_text=text).wait_for(timeout=LIMIT * 1000)


def test_without_scripts_or_webgl_there_is_a_picture(browser: Browser) -> None:
    none = "HTMLCanvasElement.prototype.getContext = () => null"
    with served([GGX()]) as server:
        for options, script in (({"java_script_enabled": False}, ""), ({}, none)):
            context = browser.new_context(**options)  # type: ignore[arg-type]
            page = context.new_page()
            page.add_init_script(script)
            with page.expect_response("**/picture*", timeout=LIMIT * 1000) as answer:
                page.goto(server.address)
            assert answer.value.ok
            page.locator("#picture img").wait_for()
            context.close()


def test_what_is_followed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    GGX(alpha=0.2).save("m.safetensors")
    brdf.io.write(brdf.SphereImages.bake(Lambertian(), angles=(0, 90), size=16), "spheres/")
    mesh = tmp_path / "m.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "utf-8")

    def names(*shown: Any, **start: Any) -> list[str]:
        return [str(path) for path in opening.followed(shown, View(**start))]

    assert names(GGX(), "GGX", "gold-metallic-paint") == []
    assert names("m.safetensors + .5*Lambertian:albedo=.1") == ["m.safetensors"]
    assert names("m.safetensors@NAME") == ["m.safetensors"]
    assert names("spheres") == names("spheres/sphere-images.json") == ["spheres"]
    for name in ("fc1", "b3"):
        Path(f"paint_{name}.npy").touch()
    assert names("paint_b3.npy") == names("2*paint_b3.npy@paint") == ["paint_b3.npy", "paint_fc1.npy"]
    assert names(Path("m.safetensors"), "m.safetensors", mesh=mesh) == ["m.safetensors", "m.safetensors", str(mesh)]
    assert names("GGX", mesh="m.obj", env="studio") == ["m.obj"]


def test_the_mesh_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "m.obj"
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"
    path.write_text(corners, "utf-8")
    with served([GGX()], View(mesh=path, lights=iter(["directional:theta=40"]))) as server:
        assert faces(got(f"{server.address}payload")) == 1
        path.write_text(corners + "f 1 2 4\n", "utf-8")
        while server.after(0) == 0:
            pass
        assert faces(got(f"{server.address}payload")) == 2


def faces(payload: bytes) -> int:
    about, _ = containers.read(payload)
    return int(about["meshes"][0]["faces"])
