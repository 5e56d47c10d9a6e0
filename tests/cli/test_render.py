"""`brdf render` on a graphics card, and where there is none."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as Pictures

import brdf as package
from brdf.combinators import SpatiallyVarying
from brdf.models import GGX
from brdf.render.gl import card

Command = Callable[..., Any]
SMALL = ("--no-compare", "--size", "24x18", "--light", "directional:theta=40")


@pytest.mark.usefixtures("gl")
def test_both_backends_write_the_same_picture(brdf: Command, tmp_path: Path) -> None:
    for backend in ("cpu", "gl"):
        outcome = brdf("render", "GGX", *SMALL, "--supersampling", 3, "--backend", backend, "-o", f"{backend}.png")
        assert outcome.code == 0, outcome
        assert outcome.err == ""
    first, second = (np.asarray(Pictures.open(tmp_path / f"{backend}.png"), int) for backend in ("cpu", "gl"))
    assert (np.abs(first - second) > 1).any(-1).mean() < 0.01
    assert first.std() > 5


def test_without_a_driver_a_note_says_what_to_install(brdf: Command, tmp_path: Path, monkeypatch: Any) -> None:
    moderngl = pytest.importorskip("moderngl")

    def absent(*_: Any, **__: Any) -> None:
        raise Exception("libEGL.so not loaded")

    monkeypatch.setattr(moderngl, "create_context", absent)
    card.cache_clear()
    outcome = brdf("render", "GGX", *SMALL, "--backend", "gl", "-o", "a.png")
    assert outcome.code == 0
    assert outcome.err.count("\n") == 1
    assert "no OpenGL here (libEGL.so not loaded)" in outcome.err
    assert "libegl1 libgl1-mesa-dri libgl1; the CPU draws instead" in outcome.err
    assert (tmp_path / "a.png").exists()


@pytest.mark.usefixtures("gl")
@pytest.mark.parametrize(("arguments", "said"), [
    (("GGX", "--backend", "vulkan"), "unknown backend 'vulkan': known: cpu, gl."),
    (("Mirror", "--backend", "gl"), "mirrors, which has no values to draw; use the backend 'cpu'"),
    (("GGX", "--backend", "gl", *["--light", "directional:"] * 8), "up to 8 lights, got 9; use 'cpu'"),
    (("GGX", "--supersampling", "99"), "supersampling must be a whole number in [1, 16], got 99"),
])  # fmt: skip
def test_what_is_refused(refused: Command, tmp_path: Path, arguments: tuple[str, ...], said: str) -> None:
    assert said in refused("render", *SMALL, *arguments, "-o", "a.png")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("gl")
def test_what_is_drawn_alone_is_said_once_it_is_drawn(brdf: Command, refused: Command) -> None:
    size = ("--size", "24x18", "--light", "directional:theta=40", "-o", "a.png")
    assert "use the backend 'cpu'" in refused("render", "mirror", *size, "--backend", "gl")
    outcome = brdf("render", "mirror", *size)
    assert outcome.code == 0
    assert "it is drawn alone" in outcome.err


def test_pictures_are_named_after_what_was_given(brdf: Command, tmp_path: Path) -> None:
    name, fit = "gold-metallic-paint", "gold-metallic-paint@ngan_ward"
    package.load(name).save(tmp_path / "süß.safetensors")
    for given in (name, fit, "süß.safetensors"):
        assert brdf("render", given, *SMALL).code == 0
    assert {path.name for path in tmp_path.glob("*.png")} == {f"{name}.png", f"{fit}.png", "süß.png"}


def test_what_varies_is_drawn_alone(brdf: Command, tmp_path: Path) -> None:
    spotted = SpatiallyVarying(GGX(alpha=0.3), alpha=np.array([[0.1, 0.5], [0.2, 0.3]]))
    spotted.save(tmp_path / "spotted.safetensors")
    outcome = brdf("render", "spotted.safetensors", *SMALL[1:])
    assert "varies over the surface, which a slice stack cannot hold; it is drawn alone" in outcome.err
    outcome = brdf("bake", "spotted.safetensors")
    assert "its middle, uv = (0.5, 0.5), is compared, and is what tables hold" in outcome.err
