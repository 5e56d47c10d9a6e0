"""The renderer on a graphics card against the one on the processor: two programs, one picture."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brdf
from brdf.errors import DriverError, ReflectanceError, SceneError, UnknownNameError
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.render import Camera, Directional, Image, Mesh, mesh, render, render_halves
from brdf.render.gl import Renderer, card, stages_of
from brdf.render.task import checked
from brdf.render.tone import developed
from cards import GLCard

RNG = np.random.default_rng(7)
METAL = GGX(alpha=0.2, F0=(1, 0.78, 0.34)) + Lambertian(albedo=(0.2, 0.1, 0.3))
BRUSHED = GGX(alpha_x=0.1, alpha_y=0.4, F0=0.6)
LIGHTS = ["directional:theta=40,phi=60,power=2", "point:2/3/3,power=8/6/4"]
SIZE = (112, 84)

pytestmark = pytest.mark.usefixtures("gl")


def material(name: str) -> Reflectance:
    match name:
        case "metal":
            return METAL
        case "stack":
            return brdf.SliceStack.bake(METAL, method="points")
        case "brushed":
            return BRUSHED
        case "sheet":
            return brdf.TwoSided(METAL, BRUSHED)
    alpha, colour = RNG.uniform(0.1, 0.8, (4, 5)), RNG.uniform(0, 1, (3, 2, 3))
    return brdf.SpatiallyVarying(0.5 * Lambertian() + GGX(), lobe2_alpha=alpha, lobe1_base_albedo=colour)


def assert_alike(drawn: Image, expected: Image, share: float = 1e-3) -> None:
    """All but a `share` of the pixels are the same to 1/255 on a screen, and there is something to see."""
    shown, wanted = (developed(image.pixels, "clip") for image in (drawn, expected))
    wrong = (np.abs(shown - wanted) > 1 / 255).any(-1)
    assert wrong.mean() <= share
    assert wanted.std() > 0.02


@pytest.mark.parametrize(("name", "what"), [
    ("teapot", "metal"), ("teapot", "varying"), ("sphere", "metal"), ("sphere", "varying"), ("sphere", "stack"),
    ("sphere", "brushed"), ("plane", "sheet"), ("plane", "varying"), ("plane", "brushed"),
    ("bunny_lowres.ply", "stack"), ("bunny_lowres.ply", "brushed"), ("shaderball.glb", "metal"),
])  # fmt: skip
def test_both_renderers_draw_the_same(name: str, what: str, request: pytest.FixtureRequest) -> None:
    path = request.getfixturevalue("data") / "mesh" / name if "." in name else name
    scene: dict[str, Any] = {"mesh": path, "lights": LIGHTS, "size": SIZE}
    m = material(what)
    assert_alike(render(m, **scene, backend="gl"), render(m, **scene))


def test_without_shadows_both_draw_the_same() -> None:
    scene: dict[str, Any] = {"lights": "directional:theta=70,phi=-50,power=3", "size": SIZE, "shadows": False}
    lit = render(METAL, **scene, backend="gl")
    assert_alike(lit, render(METAL, **scene))
    shadowed = render(METAL, **scene | {"shadows": True}, backend="gl")
    assert (lit.pixels - shadowed.pixels).max() > 0.1
    assert (shadowed.pixels <= lit.pixels + 1e-6).all()


@pytest.mark.parametrize("camera", [
    Camera((3, 2, 5), (0.2, 0.6, 0), height=2.0), Camera((0.3, 0.9, 0.8), (0, 0.5, 0), fov=75),
])  # fmt: skip
def test_cameras(camera: Camera) -> None:
    """Parallel rays, and a camera so near that triangles lie behind it."""
    scene: dict[str, Any] = {"lights": LIGHTS, "camera": camera, "size": SIZE}
    for shape in ("teapot", "sphere"):
        assert_alike(render(METAL, shape, **scene, backend="gl"), render(METAL, shape, **scene))


def test_eight_lights_are_the_sum_of_each() -> None:
    lights = [Directional(theta, phi, (0.2, 0.3, 0.4)) for theta in (20, 60) for phi in (-120, -30, 30, 120)]
    scene: dict[str, Any] = {"size": (64, 48), "background": (0, 0, 0), "backend": "gl", "supersampling": 1}
    together = render(METAL, lights=lights, **scene).pixels
    np.testing.assert_allclose(together, sum(render(METAL, lights=x, **scene).pixels for x in lights), atol=1e-5)


def test_halves_and_coverage() -> None:
    scene: dict[str, Any] = {"lights": LIGHTS, "size": (91, 64), "background": "transparent"}
    drawn, expected = (render_halves(METAL, BRUSHED, **scene, backend=backend) for backend in ("gl", "cpu"))
    assert_alike(drawn, expected, 2e-3)
    assert drawn.alpha is not None
    assert expected.alpha is not None
    assert (drawn.alpha != expected.alpha).mean() < 2e-3
    assert drawn.metadata == expected.metadata


def test_a_mesh_without_normals_and_texture_coordinates(tmp_path: Path) -> None:
    """A tetrahedron as the barest of formats has it."""
    corners = np.array([(1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)])
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + ["f 1 3 2", "f 1 2 4", "f 1 4 3", "f 2 3 4"]
    path = tmp_path / "bare.obj"
    path.write_text("\n".join(lines))
    assert mesh.load(path).uvs is None
    scene: dict[str, Any] = {"mesh": path, "lights": LIGHTS, "size": SIZE}
    assert_alike(render(BRUSHED, **scene, backend="gl"), render(BRUSHED, **scene))


def test_a_shape_behind_the_camera_leaves_the_background() -> None:
    scene: dict[str, Any] = {"lights": LIGHTS, "size": (32, 24), "camera": Camera((0, 0, 5), (0, 0, 10))}
    np.testing.assert_array_equal(render(METAL, **scene, backend="gl").pixels, render(METAL, **scene).pixels)


def test_what_is_refused() -> None:
    small: dict[str, Any] = {"size": (8, 8), "backend": "gl"}
    with pytest.raises(SceneError, match="up to 8 lights, got 9; use 'cpu'"):
        render(METAL, lights=[Directional()] * 9, **small)
    with pytest.raises(ReflectanceError, match="mirrors, which has no values to draw"):
        render(brdf.models.Mirror(), lights=LIGHTS, **small)
    with pytest.raises(UnknownNameError, match="unknown backend 'vulkan': known: cpu, gl"):
        render(METAL, **small | {"backend": "vulkan"})
    many = Mesh("large", np.zeros((3, 3), "f4"), np.zeros((5_000_001, 3), "i4"), np.zeros((1, 3, 3), "f4"))
    with pytest.raises(SceneError, match="large has 5,000,001 triangles"):
        render(METAL, many, LIGHTS, camera=Camera((0, 0, 5)), **small)


def test_without_a_driver_the_processor_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    import moderngl

    def absent(*_: Any, **__: Any) -> None:
        raise Exception("libGL.so not loaded")

    monkeypatch.setattr(moderngl, "create_context", absent)
    card.cache_clear()
    scene: dict[str, Any] = {"lights": LIGHTS, "size": (16, 12)}
    with pytest.warns(RuntimeWarning, match=r"no OpenGL here \(libGL.so not loaded\); .*; the CPU draws instead"):
        drawn = render(METAL, **scene, backend="gl")
    np.testing.assert_array_equal(drawn.pixels, render(METAL, **scene).pixels)


def test_without_the_extra_the_processor_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "moderngl", None)
    card.cache_clear()
    with pytest.warns(RuntimeWarning, match=r"pip install 'brdf\[gl\]'; the CPU draws instead"):
        render(METAL, lights=LIGHTS, size=(8, 8), backend="gl")


def test_the_driver_filters_nearly_as_the_shader_does() -> None:
    """Its own linear lookups, which most cards do with fewer bits."""
    m = brdf.SliceStack.bake(METAL, method="points")
    what = checked([m], "sphere", LIGHTS, None, None, SIZE, 1, 1, True, (0, 0, 0), 0)
    found = []
    for filtered in (False, True):
        with card() as opened:
            renderer = Renderer(opened, what, stages_of(what), filtered)
            list(renderer.draw_sample((0.5, 0.5)))
            found.append(renderer.read()[0])
    assert found[0].max() > 1
    assert 0 < np.abs(found[0] - found[1]).max() < 5e-3 * found[0].max()


def test_a_shader_that_the_driver_refuses(gl: GLCard) -> None:
    with card() as opened, pytest.raises(DriverError, match="refuses a shader"):
        opened.program("void main() { gl_Position = vec4(0.0); }", "void main() { nonsense; }")


def test_what_is_too_large_for_the_driver_is_left_to_the_processor() -> None:
    with card() as opened, pytest.raises(DriverError, match=r"takes \d+ texels along an axis, not 1000000 x 1"):
        opened.target(1000000, 1, depth=False)


def test_any_thread_may_draw() -> None:
    with ThreadPoolExecutor(2) as pool:
        drawn = list(pool.map(lambda _: render(METAL, lights=LIGHTS, size=(16, 12), backend="gl").pixels, range(4)))
    for pixels in drawn:
        np.testing.assert_array_equal(pixels, drawn[0])
    np.testing.assert_array_equal(render(METAL, lights=LIGHTS, size=(16, 12), backend="gl").pixels, drawn[0])


def test_nothing_stays_on_the_card() -> None:
    import moderngl

    with card() as opened:
        texture = opened.texture(np.zeros((2, 2, 4), "f4"))
        target = opened.target(2, 2, depth=True)
    assert isinstance(texture.mglo, moderngl.InvalidObject)
    assert isinstance(target.framebuffer.mglo, moderngl.InvalidObject)
    for _ in range(2):
        render(METAL, lights=LIGHTS, size=(16, 12), backend="gl")
    with card() as opened:
        assert opened.context.error == "GL_NO_ERROR"
