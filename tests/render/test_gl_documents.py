"""What two documents draw on graphics cards: r at vertices or pixels, and two pictures of a sphere or all of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import brdf
from brdf.errors import UnknownNameError
from brdf.models import GGX, Lambertian
from brdf.render import Camera, Directional, render, render_per_vertex
from brdf.render.tone import developed
from mesostructures import ACQUIRED, photographs

GLOSSY = GGX(alpha=0.12, F0=0.5) + Lambertian(albedo=0.2)
MAP = brdf.ShadingMap.from_images(photographs("plastic", 64), ACQUIRED, GLOSSY)
VIEW: dict[str, Any] = {"size": (96, 72), "background": (0, 0, 0)}

pytestmark = pytest.mark.usefixtures("gl")


def assert_alike(drawn: Any, expected: Any) -> None:
    wrong = np.abs(developed(drawn.pixels, "clip") - developed(expected.pixels, "clip")) > 1 / 255
    assert wrong.any(-1).mean() <= 1e-3
    assert expected.pixels.std() > 0.02


@pytest.mark.parametrize("light", ["directional:theta=45,phi=30,power=2", "point:1.5/2/2"])
@pytest.mark.parametrize(("name", "shape"), [("raw", "teapot"), ("raw", "sphere"), ("4 bytes", "sphere")])
def test_maps_at_vertices_are_those_of_the_processor(light: str, name: str, shape: str) -> None:
    m = MAP if name == "raw" else MAP.compress(4)
    assert_alike(render_per_vertex(m, shape, light, **VIEW, backend="gl"), render_per_vertex(m, shape, light, **VIEW))


@pytest.mark.parametrize("m", [MAP, MAP.compress(6), MAP.compress(method="quadratic")], ids=["raw", "pca", "quadratic"])
def test_maps_at_pixels_are_those_of_the_processor(m: brdf.ShadingMap) -> None:
    scene: dict[str, Any] = VIEW | {"lights": ["directional:theta=45,phi=30,power=2", "point:1.5/2/2"]}
    assert_alike(render(m, **scene, backend="gl"), render(m, **scene))


def test_vertices_without_shadows_and_with_parallel_rays() -> None:
    scene: dict[str, Any] = VIEW | {"shadows": False, "camera": Camera((2, 2, 4), (0, 0.5, 0), height=1.6)}
    drawn, expected = (
        render_per_vertex(MAP, "teapot", Directional(30, 20), **scene, backend=how) for how in ("gl", "cpu")
    )
    assert_alike(drawn, expected)


def test_an_unknown_backend_is_named() -> None:
    with pytest.raises(UnknownNameError, match="unknown backend 'metal': known: cpu, gl"):
        render_per_vertex(MAP, "teapot", Directional(), **VIEW, backend="metal")


@pytest.mark.parametrize("blend", ["paper", "monotone", "separated"])
@pytest.mark.parametrize("angle", [20, 70, 160])
def test_for_one_distant_light_two_pictures_are_enough(blend: str, angle: float) -> None:
    """Seen by parallel rays, light and viewer are as far apart everywhere; on the CPU with all pictures."""
    images = brdf.SphereImages.bake(GLOSSY, size=64, blend=blend)
    light = Directional(theta=90, phi=angle)
    scene: dict[str, Any] = VIEW | {"mesh": "sphere", "lights": light, "camera": Camera((0, 0, 5), height=2.2)}
    pair = images.beside(angle)
    assert len(pair.angles) == 2
    drawn, expected = render(pair, **scene, backend="gl").pixels, render(images, **scene).pixels
    np.testing.assert_allclose(drawn, expected, atol=2e-3 * expected.max())
    assert expected.max() > 0.01
