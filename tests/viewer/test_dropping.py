"""Files dropped onto the page are shown, and what is none is said."""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from tests.viewer.pages import Opened, address, opened

import brdf
from brdf.models import GGX

if TYPE_CHECKING:
    from playwright.sync_api import Browser

DROP = """([name, text]) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes].flat(), name));
    for (const type of ["dragover", "drop"]) {
        viewer.canvas.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer }));
    }
}"""

MERL = (
    "Uint8Array.from(atob(fill), (c) => c.charCodeAt(0))",
    "[new Int32Array([90, 90, 180]), new Float64Array(3 * 90 * 90 * 180).fill(fill * 1500)]",
)
"""A file of one value everywhere, made in the page: it has 33 MB."""


@pytest.fixture(scope="module")
def viewer(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Opened]:
    path = tmp_path_factory.mktemp("page") / "ball.html"
    brdf.export(GGX(alpha=0.2).named("ball"), path, mesh="sphere", lights="directional:theta=40,phi=20")
    with opened(browser) as page:
        yield page.open(address(path))


def dropped(viewer: Opened, name: str, data: bytes) -> str:
    """What the page says when it is done."""
    viewer.page.evaluate(DROP, [name, base64.b64encode(data).decode()])
    viewer.until("!/^$|^Reading/.test(document.querySelector('.message').textContent)")
    return viewer.page.locator(".message").inner_text()


def test_files_of_three_formats_are_shown(viewer: Opened, tmp_path: Path, data: Path) -> None:
    GGX(alpha=0.4, F0=(0.1, 0.5, 0.9)).save(tmp_path / "model.safetensors")
    said = dropped(viewer, "model.safetensors", (tmp_path / "model.safetensors").read_bytes())
    assert said == "GGX is shown as A."
    shiny = viewer.picture()
    red, _, blue = shiny.reshape(-1, 3).astype(float).mean(0)
    assert blue > red
    viewer.page.evaluate(DROP.replace("text", "fill").replace(*MERL), ["measured.binary", 0.3])
    viewer.until("viewer.state.materials[0] === 2")
    matte = viewer.picture()
    assert viewer.page.get_by_role("complementary").get_by_role("slider", name="low").count() == 0
    red, green, blue = matte.reshape(-1, 3).astype(float).mean(0)
    assert blue > green > red  # of which the format keeps 1.66, 1.15 and 1 times as much
    assert (matte != shiny).any()
    measured = min((data / "rgl").glob("*.bsdf"), key=lambda path: path.stat().st_size)
    assert dropped(viewer, measured.name, measured.read_bytes()).endswith("is shown as A.")
    assert viewer.state["materials"][0] == 3
    assert viewer.page.evaluate("viewer.gl.getError()") == 0


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("notes.txt", b"nothing of all that, but long enough", "notes.txt is no MERL .binary, no RGL .bsdf and no"),
        ("cut.binary", bytes([90, 0, 0, 0, 90, 0, 0, 0, 180, 0, 0, 0]) + bytes(100), "cut.binary"),
        ("empty.bsdf", b"", "empty.bsdf has 0 bytes, too few"),
        ("evil.safetensors", (1 << 40).to_bytes(8, "little") + b"{" * 20, "evil.safetensors"),
    ],
)
def test_what_cannot_be_read_is_said_and_nothing_changes(
    viewer: Opened, name: str, content: bytes, message: str
) -> None:
    before = viewer.state
    assert message in dropped(viewer, name, content)
    assert viewer.page.locator(".message.wrong").is_visible()
    assert viewer.state == before


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (lambda shader: shader["text"].replace(";", "; nonsense", 1), "does not compile"),
        (lambda shader: shader["description"]["parameters"].append(None) or shader["text"], ""),
    ],
    ids=["shader", "parameter"],
)
def test_what_cannot_be_drawn_is_not_taken(viewer: Opened, tmp_path: Path, changed: Any, message: str) -> None:
    GGX(alpha=0.4).save(tmp_path / "whole.safetensors")
    data = (tmp_path / "whole.safetensors").read_bytes()
    size = int.from_bytes(data[:8], "little")
    header = json.loads(data[8 : 8 + size])
    about = json.loads(header["__metadata__"]["brdf"])
    shader = json.loads(gzip.decompress(base64.b64decode(about["shader"])))
    shader["text"] = changed(shader)
    about["shader"] = base64.b64encode(gzip.compress(json.dumps(shader).encode())).decode()
    header["__metadata__"]["brdf"] = json.dumps(about)
    text = json.dumps(header).encode()
    viewer.finished()
    before = viewer.state, viewer.page.evaluate("viewer.slots.sources.length")
    said = dropped(viewer, "broken.safetensors", len(text).to_bytes(8, "little") + text + data[8 + size :])
    assert said.startswith("broken.safetensors cannot be shown: ")
    assert message in said
    assert (viewer.state, viewer.page.evaluate("viewer.slots.sources.length")) == before
    viewer.finished()


TWO = """([first, second]) => viewer.frame.drop.open([first, second].map((text, number) =>
    new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], `${number}.safetensors`)))"""


@pytest.mark.parametrize("compare", ["first", "split", "side"])
def test_two_files_become_a_and_b(viewer: Opened, tmp_path: Path, compare: str) -> None:
    viewer.set(compare=compare)
    files = []
    for name in ("one", "two"):
        GGX(alpha=0.3).named(name).save(tmp_path / name)
        files.append(base64.b64encode((tmp_path / name).read_bytes()).decode())
    viewer.page.evaluate(TWO, files)
    assert viewer.page.evaluate("viewer.materials().map((m) => m.name)") == ["one", "two"]
    assert viewer.state["compare"] == ("split" if compare == "first" else compare)
