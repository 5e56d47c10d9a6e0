"""The exported page: one file, small, that asks the network for nothing."""

from __future__ import annotations

import base64
import gzip
import hashlib
import io
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image as Pictures

import brdf
import containers
from brdf.errors import ParameterError
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.viewer.linker import linked, sources
from brdf.viewer.minified import minified
from brdf.viewer.picture import LARGEST

GOLD = GGX(alpha=0.2, F0=(1, 0.78, 0.34)).named("gold <\"&'> </script>")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("page") / "gold.html"
    assert brdf.export(GOLD, path)[:2] == ("", (path,))
    return path.read_text("utf-8")


def between(text: str, before: str, after: str) -> str:
    (found,) = re.findall(re.escape(before) + "(.*?)" + re.escape(after), text, re.S)
    return str(found)


def test_the_data_in_the_page_is_the_payload(page: str) -> None:
    data = base64.b64decode(between(page, '<script type="text/plain" id="payload">', "</script>"))
    about, _ = containers.read(gzip.decompress(data))
    assert about["title"] == GOLD.name
    assert page.count("</script") == 3
    assert "<title>gold &lt;&quot;&amp;&#x27;&gt; &lt;/script&gt;</title>" in page


def test_the_policy_allows_the_scripts_that_came_and_no_network(page: str) -> None:
    policy = between(page, 'http-equiv="Content-Security-Policy" content="', '"')
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    code = between(page, '<script type="text/plain" id="code">', "</script>")
    scripts = between(page, "<script>", "</script>").encode(), gzip.decompress(base64.b64decode(code))
    digests = [base64.b64encode(hashlib.sha256(script).digest()).decode() for script in scripts]
    assert rules["default-src"] == "'none'"
    assert rules["connect-src"] == "'none'"
    assert rules["script-src"] == " ".join(f"'sha256-{digest}'" for digest in digests)
    assert "http" not in policy


def test_the_picture_is_small_and_shows_the_material(page: str) -> None:
    data = base64.b64decode(between(page, 'src="data:image/webp;base64,', '"'))
    assert len(data) <= LARGEST
    image = Pictures.open(io.BytesIO(data)).convert("RGB")
    assert image.size == (560, 420)
    red, green, blue = (channel for channel in image.resize((1, 1)).getpixel((0, 0)))  # type: ignore[misc]
    assert red > green > blue


SIZES = [
    ("GGX", lambda: GOLD, 250_000),
    ("16 KB", lambda: brdf.SliceStack.bake(GOLD, method="points"), 250_000),
]


@pytest.mark.parametrize(("make", "most"), [case[1:] for case in SIZES], ids=[case[0] for case in SIZES])
def test_pages_with_the_teapot_are_small(make: object, most: int, tmp_path: Path, page: str) -> None:
    assert callable(make)
    m = make()
    size = len(page) if m is GOLD else brdf.export(m, tmp_path / "p.html").files[0].stat().st_size
    assert size < most


def test_the_code_is_small() -> None:
    code = linked("main.js") + minified(sources()["style.css"], "text/css")
    assert len(gzip.compress(code.encode(), 9)) <= 40 * 1024


def test_several_materials_and_how_the_page_starts(tmp_path: Path) -> None:
    pair: list[Reflectance] = [GOLD, Lambertian(albedo=0.5)]
    options = {"mesh": "sphere", "lights": "directional:theta=40", "tone": "clip", "exposure": 1.0, "shadows": False}
    text = brdf.export(pair, tmp_path / "p.html", **options).files[0].read_text("utf-8")
    data = base64.b64decode(between(text, '<script type="text/plain" id="payload">', "</script>"))
    about, _ = containers.read(gzip.decompress(data))
    assert len(about["materials"]) == 2
    assert about["comparison"]["psnr"] == pytest.approx(brdf.metrics.psnr(*pair))
    state = about["state"]
    assert (state["mesh"], state["tone"], state["exposure"], state["shadows"]) == ("sphere", "clip", 1.0, False)
    assert state["lights"][0]["theta"] == 40


def test_the_same_page_twice_is_the_same_file(tmp_path: Path) -> None:
    texts = [brdf.export(GOLD, tmp_path / name, mesh="sphere").files[0].read_bytes() for name in ("a.html", "b.html")]
    assert texts[0] == texts[1]


def test_mistakes_leave_no_file(tmp_path: Path) -> None:
    for attempt, message in mistakes(tmp_path):
        with pytest.raises(ParameterError, match=message):
            attempt()
    assert list(tmp_path.iterdir()) == []


def mistakes(folder: Path) -> Iterator[tuple[object, str]]:
    yield lambda: brdf.export([], folder / "p.html"), "nothing to show"
    yield lambda: brdf.export(GOLD, folder / "p.html", "shade"), "a page has no function to name"
    yield lambda: brdf.export(GOLD, folder / "m.glsl", mesh="teapot"), "'mesh' is how a page starts and has no effect"
    yield lambda: brdf.export([GOLD, GOLD], folder / "m.glsl"), "a shader is written of one reflectance, got 2"
