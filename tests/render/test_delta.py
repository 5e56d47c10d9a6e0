"""Ideal reflection in pictures: a mirror shows the environment, pixel by pixel."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.models import Lambertian, Mirror, SmoothConductor, SmoothDielectric
from brdf.render import Camera, render
from brdf.render.background import rays
from brdf.render.environment import Environment
from brdf.render.mesh import load as load_mesh
from brdf.render.visibility import surface_of

SIZE = 48


@pytest.fixture(scope="module")
def environment() -> Environment:
    """Smooth but nowhere the same: every direction has a colour of its own."""
    theta, phi = np.meshgrid(np.linspace(0, np.pi, 64), np.linspace(-np.pi, np.pi, 129)[:-1], indexing="ij")
    x, y, z = np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi)
    return Environment(np.stack([1.2 + x, 1.2 + y, 1.2 + z], -1))


@pytest.fixture(scope="module")
def camera() -> Camera:
    return Camera.framing(load_mesh("sphere"), aspect=1.0)


def expected(environment: Environment, camera: Camera, mirrored: bool = True) -> tuple[np.ndarray, np.ndarray]:
    """The environment seen from each pixel's centre by way of the sphere, and where the sphere is."""
    origins, directions = rays(camera, np.arange(SIZE * SIZE, dtype=np.int32), 1, SIZE, SIZE)
    met = surface_of(load_mesh("sphere")).meet(origins, directions)
    normals = met.points / np.linalg.norm(met.points, axis=-1, keepdims=True)
    seen = directions[met.rays]
    along = np.einsum("ij,ij->i", seen, normals)[:, None]
    if mirrored:
        out = seen - 2 * along * normals
    else:  # refracted by index 1.5, in vector form
        ratio = 1 / 1.5
        cos_t = np.sqrt(1 - ratio**2 * (1 - along**2))
        out = ratio * seen + (-ratio * along - cos_t) * normals
    picture, inside = np.zeros((SIZE * SIZE, 3)), np.zeros(SIZE * SIZE, bool)
    picture[met.rays] = environment.radiance(np.ascontiguousarray(out, np.float32))[0]
    inside[met.rays] = along[:, 0] < -0.15  # the rim turns the reflection by degrees within one pixel
    return picture.reshape(SIZE, SIZE, 3), inside.reshape(SIZE, SIZE)


def test_mirror_sphere_shows_the_environment(environment: Environment, camera: Camera) -> None:
    image = render(Mirror(reflectance=(1.0, 0.5, 0.25)), "sphere", env=environment, camera=camera, size=(SIZE, SIZE),
                   samples=1, supersampling=1, background=0.0)  # fmt: skip
    picture, inside = expected(environment, camera)
    assert inside.sum() > 800
    np.testing.assert_allclose(image.pixels[inside], (picture * [1, 0.5, 0.25])[inside], atol=0.02)


def test_metal_sphere_is_tinted_by_fresnel(environment: Environment, camera: Camera) -> None:
    metal = SmoothConductor()
    image = render(metal, "sphere", env=environment, camera=camera, size=(SIZE, SIZE), samples=1, supersampling=1)
    picture, inside = expected(environment, camera)
    ratio = image.pixels[inside] / picture[inside]
    centre = SIZE // 2
    np.testing.assert_allclose(
        image.pixels[centre, centre] / picture[centre, centre], metal.albedo([0.0, 0.0, 1.0], 16), rtol=0.03
    )
    assert ratio.max() < 1.02


def test_glass_sphere_shows_both_directions(environment: Environment, camera: Camera) -> None:
    image = render(SmoothDielectric(eta=1.5), "sphere", env=environment, camera=camera, size=(SIZE, SIZE),
                   samples=256, supersampling=1)  # fmt: skip
    reflection, inside = expected(environment, camera)
    refraction, _ = expected(environment, camera, mirrored=False)
    disc = np.zeros((SIZE, SIZE), bool)
    disc[SIZE // 2 - 4 : SIZE // 2 + 4, SIZE // 2 - 4 : SIZE // 2 + 4] = True
    assert inside[disc].all()
    both = 0.04 * reflection + 0.96 / 1.5**2 * refraction
    np.testing.assert_allclose(image.pixels[disc].mean(0), both[disc].mean(0), rtol=0.02)


def test_mirror_under_a_matte_coat_adds_up(environment: Environment, camera: Camera) -> None:
    def picture(m: object) -> np.ndarray:
        return render(
            m, "sphere", env=environment, camera=camera, size=(SIZE, SIZE), samples=64, supersampling=2
        ).pixels

    both = picture(0.5 * Mirror() + Lambertian(albedo=0.4))
    apart = picture(0.5 * Mirror()) + picture(Lambertian(albedo=0.4))
    _, inside = expected(environment, camera)
    np.testing.assert_allclose(both[inside].mean(0), apart[inside].mean(0), rtol=0.01)
    assert np.abs(both - apart)[inside].mean() < 0.05


def test_mirror_is_black_under_a_light_without_extent(camera: Camera) -> None:
    image = render(
        Mirror(), "sphere", lights="directional:theta=30", camera=camera, size=(16, 16), samples=1, background=0.0
    )
    np.testing.assert_array_equal(image.pixels, 0)
