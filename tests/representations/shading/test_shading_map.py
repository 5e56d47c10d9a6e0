"""Shading maps: pictures looked up by their average."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.representations.synthetic_rgl import tensors

import brdf
from brdf import ShadingMap, laws
from brdf.color import luminance
from brdf.errors import ParameterError, ReflectanceError, UnknownNameError
from brdf.formula import engine
from brdf.models import GGX, Lambertian, Mirror, OrenNayar
from brdf.reflectance import Reflectance
from brdf.representations.adaptive import Adaptive
from lobes import direction, random_pairs
from mesostructures import ACQUIRED, BETWEEN, HEIGHTS, photographs

SIZE = 48
PHOTOS = {name: photographs(name, SIZE) for name in HEIGHTS}
RNG = np.random.default_rng(5)
CENTRES = np.stack(np.meshgrid((np.arange(SIZE) + 0.5) / SIZE, 1 - (np.arange(SIZE) + 0.5) / SIZE), -1)
"""(rows, columns, 2): uv of the texels."""
NORMAL = np.array([0.0, 0.0, 1.0])


def sample(name: str = "stone", **options) -> ShadingMap:
    return ShadingMap.from_images(PHOTOS[name], ACQUIRED, **options)


def mean_luminance(picture: np.ndarray) -> float:
    return float(luminance(picture.astype(np.float64)).mean())


@pytest.mark.parametrize("mode", ["native", "paper"])
@pytest.mark.parametrize("name", HEIGHTS)
def test_the_average_of_the_picture_looked_up_is_r(name: str, mode: str) -> None:
    h = sample(name, mode=mode)
    highest = h.stack.highest
    for r in (0, 1e-6, 0.003, *np.linspace(0.01, 3, 17) * highest):
        assert mean_luminance(h.picture(r)) == pytest.approx(r, rel=1e-12)
        assert mean_luminance(h.lookup(r, CENTRES)) == pytest.approx(r, rel=1e-12)
    clamped = sample(name, mode=mode, above="clamp")
    for r in (highest, 2 * highest):
        assert mean_luminance(clamped.lookup(r, CENTRES)) == pytest.approx(highest, rel=1e-12)
        np.testing.assert_allclose(clamped.lookup(r, CENTRES), clamped.picture(r), rtol=1e-9)


def test_native_pictures_are_the_photographs() -> None:
    h = sample()
    for photo, average in zip(PHOTOS["stone"], luminance(PHOTOS["stone"].astype("f8")).mean((1, 2)), strict=True):
        np.testing.assert_allclose(h.picture(average), photo, rtol=2e-6, atol=1e-9)
    np.testing.assert_array_equal(h.elevations, ACQUIRED[::-1])
    assert h.dropped == ()


def test_paper_slices_rise_evenly_and_lie_between_the_photographs_that_bracket_them() -> None:
    h, photos = sample(mode="paper", slices=8), PHOTOS["stone"][::-1]
    averages = luminance(photos.astype("f8")).mean((1, 2))
    np.testing.assert_allclose(h.stack.nodes, averages[-1] * np.arange(1, 8) / 7, rtol=1e-6)
    np.testing.assert_array_equal(h.picture(averages[-1]), photos[-1])
    np.testing.assert_array_equal(h.picture(0), 0 * photos[0])
    for k in range(1, 8):
        picture, above = h.picture(h.stack.nodes[k - 1]), np.searchsorted(averages, h.stack.nodes[k - 1] * (1 - 1e-6))
        low = photos[above - 1] if above else 0 * photos[0]
        assert (picture >= np.minimum(low, photos[above]) - 1e-6).all()
        assert (picture <= np.maximum(low, photos[above]) + 1e-6).all()


def test_where_averages_rise_towards_grazing_light_pictures_are_dropped() -> None:
    averages = np.array([0.306, 0.315, 0.341, 0.379, 0.422, 0.463, 0.492, 0.493, 0.268, 0.083]) / np.pi
    texture = 1 + 0.1 * RNG.standard_normal((10, 20, 20, 3))
    velvet = averages[:, None, None, None] * texture / luminance(texture).mean((1, 2))[:, None, None, None]
    h = ShadingMap.from_images(velvet, ACQUIRED)
    assert h.dropped == (0, 10, 20, 30, 40, 50, 60)
    np.testing.assert_array_equal(h.elevations, [87, 80, 70])
    every = ShadingMap.from_images(velvet, ACQUIRED, branch="all")
    assert every.dropped == ()
    for photo in velvet:
        np.testing.assert_allclose(every.picture(luminance(photo).mean()), photo, rtol=1e-5)
    dent = np.array([1.0, 0.8, 0.85, 0.7])[:, None, None, None] * np.ones((4, 2, 2, 3))
    assert ShadingMap.from_images(dent, [0, 20, 40, 60]).dropped == (40,)
    with pytest.raises(ParameterError, match="only grow brighter towards grazing light; use branch='all'"):
        ShadingMap.from_images(velvet[:7], ACQUIRED[:7])


@pytest.mark.parametrize("name", HEIGHTS)
def test_under_the_samples_own_brdf_the_photographs_are_predicted(name: str) -> None:
    h = sample(name)
    assert h.sigma == pytest.approx(1, rel=1e-6)
    for photo, angle in zip(PHOTOS[name], ACQUIRED, strict=True):
        predicted = h.f_cos(direction(angle), NORMAL, CENTRES)
        np.testing.assert_allclose(predicted, photo, rtol=2e-4, atol=1e-7)


def test_pictures_between_those_taken_are_predicted() -> None:
    squares = []
    for name in HEIGHTS:
        h, between = sample(name), photographs(name, SIZE, BETWEEN)
        white = np.quantile(PHOTOS[name][0], 0.995)
        predicted = np.stack([h.f_cos(direction(angle), NORMAL, CENTRES) for angle in BETWEEN])
        squares.append(np.mean(((predicted - between) / white) ** 2))
    assert -10 * np.mean(np.log10(squares)) > 35


def test_a_sample_that_only_dims_is_an_albedo_texture() -> None:
    colour = RNG.uniform(0.1, 0.9, (6, 5, 3)).astype("f4")
    angles = np.array([0, 30.0, 60])
    photos = colour / np.pi * np.cos(np.radians(angles))[:, None, None, None]
    h = ShadingMap.from_images(photos, angles, Lambertian(albedo=1))
    assert h.sigma == pytest.approx(luminance(colour.astype("f8")).mean(), rel=1e-6)
    wi, wo = random_pairs(300)
    uv = RNG.random((300, 2))
    texture = brdf.SpatiallyVarying(Lambertian(), albedo=colour)
    np.testing.assert_allclose(h(wi, wo, uv), texture(wi, wo, uv), rtol=2e-6)
    view = {"mesh": "plane", "lights": "directional:theta=20", "size": (40, 30), "background": (0, 0, 0)}
    np.testing.assert_allclose(brdf.render(h, **view).pixels, brdf.render(texture, **view).pixels, rtol=1e-4, atol=1e-6)


# ---- techniques --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("technique", ["shading", "lit-texture", "radiance", "angular"])
def test_every_technique_reflects_on_average_what_the_brdf_does(technique: str) -> None:
    m = GGX(alpha=0.4) + OrenNayar()
    h = sample("cloth", brdf=m, sigma=0.3).replaced(technique=technique, intensity=2.5)
    for wi, wo in zip(*random_pairs(6), strict=True):
        r = 0.3 * float(luminance(m.f_cos(wi, wo)))
        assert mean_luminance(h.f_cos(wi, wo, CENTRES)) == pytest.approx(r, rel=1e-9)


def test_techniques_show_the_picture_they_name() -> None:
    h = sample("plastic", brdf=Lambertian(albedo=0.4), sigma=1)
    wi = direction(50)
    r = 0.4 / np.pi * np.cos(np.radians(50))
    averages = luminance(PHOTOS["plastic"].astype("f8")).mean((1, 2))

    def shown(technique: str, **changes) -> np.ndarray:
        return h.replaced(technique=technique, **changes).f_cos(wi, direction(10, 70), CENTRES)

    np.testing.assert_allclose(shown("shading"), h.lookup(r, CENTRES), rtol=1e-9)
    np.testing.assert_allclose(shown("lit-texture"), PHOTOS["plastic"][0] * r / averages[0], rtol=1e-6)
    np.testing.assert_allclose(shown("angular"), PHOTOS["plastic"][5] * r / averages[5], rtol=1e-5, atol=1e-8)
    for intensity in (0.25, 4):
        dimmed = h.lookup(r * intensity, CENTRES) / intensity
        np.testing.assert_allclose(shown("radiance", intensity=intensity), dimmed, rtol=1e-9)


# ---- the contract ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_kernel_and_formula_agree(dtype: type) -> None:
    h = sample("plastic", brdf=GGX(alpha=0.3) + Lambertian()).synthesise(64)
    wi, wo = (w.astype(dtype) for w in random_pairs(engine.SMALL))
    uv = RNG.uniform(-1, 2, (len(wi), 2)).astype(dtype)
    compiled = h(wi, wo, uv)
    some = np.arange(0, len(wi), 97)
    tolerance = {"rtol": 1e-9} if dtype is np.float64 else {"rtol": 2e-3, "atol": 1e-5}
    np.testing.assert_allclose(h(wi[some], wo[some], uv[some]), compiled[some], **tolerance)


def test_a_measured_brdf_without_a_formula_works_too() -> None:
    m = Adaptive(tensors())
    assert not m.has_formula
    h = sample("suede", brdf=m)
    wi, wo = random_pairs(200)
    uv = RNG.random((200, 2))
    cosine = wi[:, 2]
    expected = h.lookup(h.sigma * luminance(m(wi, wo)) * cosine, uv) / cosine[:, None]
    np.testing.assert_allclose(h(wi, wo, uv), expected, rtol=1e-9)


def test_samples_integrate_to_what_is_reflected() -> None:
    h = sample("suede", brdf=GGX(alpha=0.3, F0=0.5) + Lambertian())
    wo = direction(40)
    count = 60_000
    uv = RNG.random((count, 2))
    drawn = h.sample(wo, RNG.random((count, 2)), uv)
    expected = h.sigma * float(luminance(h.children["brdf"].albedo(wo, 16384)))
    reflected = luminance(drawn.weight)
    assert abs(reflected.mean() - expected) < 5 * reflected.std() / np.sqrt(count)
    np.testing.assert_array_equal(drawn.pdf, h.pdf(drawn.wi, wo, uv))


@pytest.mark.parametrize("law", ["positivity", "sampling", "density", "weight", "isotropy", "gradients"])
def test_laws_hold(law: str) -> None:
    result = next(found for found in laws.ALL if found.name == law)(sample("cloth", brdf=GGX(alpha=0.4)))
    assert result.status == "holds", result


def test_saved_and_loaded(tmp_path: Path) -> None:
    wi, wo = random_pairs(30)
    uv = RNG.random((30, 2))
    for h in (sample("cloth", above="clamp").replaced(technique="angular"), sample("stone").synthesise(64)):
        h.save(tmp_path / "h.safetensors")
        back = brdf.load(tmp_path / "h.safetensors")
        assert isinstance(back, ShadingMap)
        np.testing.assert_array_equal(back(wi, wo, uv), h(wi, wo, uv))
        assert repr(back) == repr(h)
        np.testing.assert_array_equal(back.average_brdf()(wi, wo), h.average_brdf()(wi, wo))


def test_a_broken_file_is_refused(tmp_path: Path) -> None:
    from brdf import container
    from brdf.errors import CorruptFileError

    header, arrays = sample().state()
    broken = {"pictures": np.zeros_like(arrays["pictures"])} | {k: a for k, a in arrays.items() if k != "pictures"}
    container.save(tmp_path / "black.safetensors", header, broken)
    with pytest.raises(CorruptFileError, match="averages of a shading map's pictures must increase"):
        Reflectance.restore(tmp_path / "black.safetensors")


# ---- smaller pictures --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [(48, 48), (37, 20), (5, 1)])
def test_mip_levels_keep_averages_and_are_area_means(shape: tuple[int, int]) -> None:
    rows, columns = shape
    h = ShadingMap.from_images(PHOTOS["stone"][:, :rows, :columns], ACQUIRED)
    levels = h.mipmaps()
    assert levels[-1].stack.shape == (1, 1)
    for level in levels:
        np.testing.assert_allclose(level.stack.nodes, h.stack.nodes, rtol=1e-6)
        assert mean_luminance(level.picture(0.05)) == pytest.approx(0.05, rel=1e-12)
    if shape == (48, 48):
        for r in (0.001, 0.03, 0.2):
            blocks = h.picture(r).reshape(24, 2, 24, 2, 3).mean((1, 3))
            np.testing.assert_allclose(levels[0].picture(r), blocks, rtol=1e-6)


def test_averaging_levels_of_the_stack_too_would_shift_them() -> None:
    """What a three-dimensional mip chain does: pairs of slices are merged, and black is lost."""
    h = sample(mode="paper", slices=8)
    black_too = np.concatenate([np.zeros((SIZE, SIZE, 1, 3)), h.stack.pictures], 2)
    merged = black_too.reshape(SIZE, SIZE, 4, 2, 3).mean(3)
    r = h.stack.highest / 7  # the second slice: 1/7 of the way, between the centres of the first two merged ones
    position = (r / h.stack.highest * 7 + 0.5) / 2 - 0.5
    shown = (1 - position) * merged[:, :, 0] + position * merged[:, :, 1]
    assert mean_luminance(shown) == pytest.approx(r, rel=1e-6)  # linear in between: it is the ends that shift
    assert mean_luminance(merged[:, :, 0]) == pytest.approx(r / 2, rel=1e-6)  # black is lost: clamped there below r / 2


# ---- what is refused ---------------------------------------------------------------------------------------------


def test_bad_input() -> None:
    photos = PHOTOS["stone"]
    with pytest.raises(ParameterError, match="10 photographs need as many elevations, got shape \\(9,\\)"):
        ShadingMap.from_images(photos, ACQUIRED[:9])
    with pytest.raises(ParameterError, match="needs at least 2 photographs, got 1"):
        ShadingMap.from_images(photos[:1], [0])
    with pytest.raises(ParameterError, match="the photograph at 10 degrees is all black"):
        ShadingMap.from_images([photos[0], 0 * photos[0]], [0, 10])
    with pytest.raises(ParameterError, match=r"photograph 2 is \(48, 47\), the first \(48, 48\)"):
        ShadingMap.from_images([photos[0], photos[1][:, 1:]], [0, 10])
    with pytest.raises(ParameterError, match=r"photograph 1 must be \(rows, columns, 3\), got \(48, 48\)"):
        ShadingMap.from_images(photos[..., 0], ACQUIRED)
    with pytest.raises(ParameterError, match="photograph 2 holds NaN"):
        ShadingMap.from_images([photos[0], photos[1] * np.nan], [0, 10])
    with pytest.raises(ParameterError, match=r"in \[0, 90\) degrees"):
        ShadingMap.from_images(photos[:2], [0, 90])
    with pytest.raises(ParameterError, match="the same elevation"):
        ShadingMap.from_images(photos[:2], [10, 10])
    with pytest.raises(ParameterError, match="must be arrays of numbers"):
        ShadingMap.from_images([photos[0], "picture"], [0, 10])
    with pytest.raises(UnknownNameError, match="unknown shading map mode 'papre': did you mean 'paper'"):
        sample(mode="papre")
    with pytest.raises(UnknownNameError, match="unknown technique 'radianse': did you mean 'radiance'"):
        sample().replaced(technique="radianse")
    with pytest.raises(UnknownNameError, match="unknown above 'cut'"):
        sample(above="cut")
    with pytest.raises(ParameterError, match=r"slices must be a whole number in \[2, 17\], got 1"):
        sample(mode="paper", slices=1)
    with pytest.raises(ReflectanceError, match="delta events"):
        sample(brdf=Mirror(), sigma=1)
    with pytest.raises(ParameterError, match="only a map that tiles can be repeated"):
        sample().replaced(tiles=2)
    with pytest.raises(ParameterError, match="shows the camera no light"):
        sample(brdf=Lambertian(albedo=0))
    with pytest.raises(ParameterError, match="r must be at least 0"):
        sample().picture(-1)
    with pytest.raises(ParameterError, match="do not broadcast"):
        sample().lookup(np.zeros(3), np.zeros((4, 2)))
