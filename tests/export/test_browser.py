"""Exported shaders in Chromium, on the same software driver as in Python: the same bits."""

from __future__ import annotations

import base64
import html
import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brdf
from cards import GLCard, described
from every_kind import MODELS, TABLES
from helpers import random_directions, relative_error

COUNT = 500
PAGE = Path(__file__).with_name("chromium.html")

ON_MESA = ("--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist")
OFFLINE = ("--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-component-update",
           "--disable-sync", "--disable-quic")  # fmt: skip


def text64(data: bytes) -> str:
    return base64.b64encode(data).decode()


def in_chromium(page: Path) -> dict[str, Any]:
    """What the page wrote when all was done."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("no Chromium; Debian has it in the package chromium")
    command = [chromium, "--headless", *ON_MESA, *OFFLINE, f"--user-data-dir={page.parent / 'profile'}",
               "--virtual-time-budget=600000", "--dump-dom", page.as_uri()]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    found: dict[str, Any] = json.loads(html.unescape(re.search("<pre[^>]*>(.*?)</pre>", done.stdout, re.S)[1]))
    return found


def test_a_browser_gives_the_bits_that_python_gives(gl: GLCard, tmp_path: Path) -> None:
    wi, wo = (random_directions(COUNT, seed).astype("f4") for seed in (1, 2))
    uv = np.random.default_rng(3).random((COUNT, 2)).astype("f4")
    shaders, values, rounded, loader = [], {}, set(), ""
    for name, make in (MODELS | TABLES).items():
        shader = brdf.export(make(), tmp_path / "m.glsl").files[0]
        text, (description, data) = shader.read_text("utf-8"), described(shader)
        shaders.append({"name": name, "text": text, "description": description, "bin": text64(data)})
        values[name] = gl.evaluate(shader, wi, wo, uv, "300 es")
        if any(texture["type"].startswith("UNSIGNED") for texture in description["textures"]):
            rounded.add(name)  # whole numbers become fractions here in Python, there on the card
        loader = re.sub("^//     ", "", re.search(r"^//     for \(.*?^//     }\);$", text, re.M | re.S)[0], flags=re.M)
    given = {"count": COUNT, "wi": text64(wi.tobytes()), "wo": text64(wo.tobytes()), "uv": text64(uv.tobytes())}
    page = tmp_path / "page.html"
    literal = json.dumps(given | {"shaders": shaders}).replace("</", "<\\/")
    page.write_text(PAGE.read_text("utf-8").replace("LOADER", loader).replace("GIVEN", literal), "utf-8")
    found = in_chromium(page)
    assert found["errors"] == {}
    assert gl.context.info["GL_RENDERER"].replace(",", "") in found["renderer"]
    assert found["values"].keys() == values.keys()
    for name, value in values.items():
        other = np.frombuffer(base64.b64decode(found["values"][name]), "f4").reshape(-1, 3)
        if name in rounded:
            assert relative_error(other, value, 1e-6).max() < 3e-6, name
        else:
            np.testing.assert_array_equal(other, value, name)
