"""Ideal mirrors and boundaries: directions, weights, probabilities, sums with smooth lobes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from brdf import Reflectance, Table, laws, mix
from brdf.errors import ReflectanceError
from brdf.geometry.directions import refracted
from brdf.geometry.sampling import CosineSampler, Sampler
from brdf.models import GGX, Lambertian, Mirror, SmoothConductor, SmoothDielectric
from lobes import direction

LAWS = {law.name: law for law in laws.ALL}
GOLD = SmoothConductor(eta=(0.2, 0.92, 1.1), k=(3.91, 2.45, 2.14))


def uniform(n: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).random((n, 2))


def complex_fresnel(cosine: float, n: complex) -> float:
    """Reflectance of unpolarised light from the textbook's complex amplitudes."""
    cos_t = np.sqrt(1 - (1 - cosine**2) / n**2 + 0j)
    r_s = (cosine - n * cos_t) / (cosine + n * cos_t)
    r_p = (n * cosine - cos_t) / (n * cosine + cos_t)
    return float((abs(r_s) ** 2 + abs(r_p) ** 2) / 2)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_mirror(dtype: type) -> None:
    wo = direction(50, 20).astype(dtype)
    drawn = Mirror(reflectance=(0.9, 0.5, 0.1)).sample(wo, uniform(8))
    assert drawn.wi.dtype == drawn.weight.dtype == dtype
    np.testing.assert_array_equal(drawn.wi, np.tile(wo * [-1, -1, 1], (8, 1)))
    np.testing.assert_allclose(drawn.weight, np.tile([0.9, 0.5, 0.1], (8, 1)), rtol=1e-6)
    np.testing.assert_array_equal(drawn.pdf, 1)
    assert drawn.is_delta.all()


def test_mirror_has_neither_value_nor_density_and_no_back() -> None:
    wo = direction(50, 20)
    mirrored = wo * [-1, -1, 1]
    m = Mirror()
    assert m.pdf(mirrored, wo) == 0
    np.testing.assert_array_equal(m(mirrored, wo), 0)
    np.testing.assert_array_equal(m.delta(mirrored, wo), 1)
    np.testing.assert_array_equal(m.delta(direction(50.01, 200), wo), 0)
    np.testing.assert_array_equal(m.sample(-wo, uniform(3)).weight, 0)


@pytest.mark.parametrize("theta", [0, 30, 60, 80, 89.9])
def test_albedo_is_the_fresnel_reflectance(theta: float) -> None:
    wo = direction(theta, 70)
    cosine = float(np.cos(np.radians(theta)))
    expected = [complex_fresnel(cosine, complex(n, k)) for n, k in zip(GOLD.eta, GOLD.k, strict=True)]
    np.testing.assert_allclose(GOLD.albedo(wo), expected, rtol=1e-10)
    glass = SmoothDielectric(eta=1.5)
    np.testing.assert_allclose(glass.delta(wo * [-1, -1, 1], wo), complex_fresnel(cosine, 1.5), rtol=1e-10)


@pytest.mark.parametrize("eta", [1.0, 1.5, 0.7, 2.4])
@pytest.mark.parametrize("theta", [0, 20, 70, 110, 130, 160, 180])
def test_refraction_obeys_snell(eta: float, theta: float) -> None:
    wo = direction(theta, 33)
    wi = refracted(wo, eta)
    np.testing.assert_allclose(np.linalg.norm(wi), 1, rtol=1e-14)
    here, beyond = (1, eta) if theta < 90 else (eta, 1)
    sine = here * np.sin(np.radians(theta)) / beyond
    if sine > 1:
        np.testing.assert_array_equal(wi, wo * [-1, -1, 1])
    else:
        np.testing.assert_allclose(np.hypot(*wi[:2]), sine, atol=1e-14)
        assert np.sign(wi[2]) == -np.sign(wo[2])
        assert wi[0] * wo[1] == pytest.approx(wi[1] * wo[0], abs=1e-15)  # stays in the plane of incidence


@pytest.mark.parametrize("theta", [25, 155])
def test_dielectric_chooses_by_fresnel_and_scales_radiance(theta: float) -> None:
    m, wo = SmoothDielectric(eta=1.5), direction(theta)
    drawn = m.sample(wo, uniform(40_000))
    reflected = drawn.wi[:, 2] * wo[2] > 0
    here, beyond = (1.0, 1.5) if theta < 90 else (1.5, 1.0)
    F = complex_fresnel(abs(wo[2]), beyond / here)
    assert reflected.mean() == pytest.approx(F, abs=4 * np.sqrt(F / 40_000))
    np.testing.assert_allclose(drawn.pdf, np.where(reflected, F, 1 - F), rtol=1e-10)
    np.testing.assert_allclose(drawn.weight[reflected], 1, rtol=1e-12)
    np.testing.assert_allclose(drawn.weight[~reflected], (here / beyond) ** 2, rtol=1e-12)
    np.testing.assert_allclose(m.albedo(wo), 1, rtol=1e-12)


def test_total_internal_reflection_begins_at_the_critical_angle() -> None:
    m = SmoothDielectric(eta=1.33)
    critical = np.degrees(np.arcsin(1 / 1.33))
    u = uniform(4000)
    beyond = m.sample(direction(180 - critical - 0.01), u)
    assert (beyond.wi[:, 2] < 0).all()
    np.testing.assert_array_equal(beyond.weight, 1)
    assert (m.sample(direction(180 - critical + 0.01), u).wi[:, 2] > 0).any()


def test_equal_media_let_everything_pass() -> None:
    drawn = SmoothDielectric(eta=1.0).sample(direction(70, 10), uniform(100))
    np.testing.assert_allclose(drawn.wi, np.tile(-direction(70, 10), (100, 1)), atol=1e-14)
    np.testing.assert_allclose(drawn.weight, 1, rtol=1e-12)


SUMS = {
    "mirror, matte": (0.4 * Mirror() + 0.5 * Lambertian(albedo=0.8), 0.8),
    "mirror, mirror": (0.2 * Mirror() + Mirror(reflectance=0.3), 0.5),
    "mirror, matte, glossy": (mix(Mirror(), GGX(alpha=0.5, F0=0.9) + Lambertian(albedo=0.1), 0.25), None),
    "glass, mirror": (0.5 * SmoothDielectric() + 0.25 * Mirror(), 0.75),
    "glass, matte": (0.5 * SmoothDielectric() + 0.5 * Lambertian(albedo=0.6), 0.8),
}


@pytest.mark.parametrize("name", SUMS)
def test_sums_with_delta_lobes(name: str) -> None:
    m, expected = SUMS[name]
    wo = direction(35, 15)
    if expected is None:
        expected = sum(Reflectance.albedo(lobe, wo, 1 << 14)[0] for lobe in m.children.values())
    error = m.albedo_error(wo, 1 << 14)[0]
    if name == "glass, mirror":  # the mirror has no back; the two share the mirrored direction
        np.testing.assert_allclose(m.albedo(-wo), 0.5, atol=1 / 4096)
    assert m.albedo(wo, 1 << 14)[0] == pytest.approx(expected, abs=max(5 * error, 1e-9))


def test_matte_lobe_beside_glass_stays_above() -> None:
    m, _ = SUMS["glass, matte"]
    up, down = direction(20), direction(150)
    assert m.transmits
    assert (m(up, up) > 0).all()
    for wi, wo in ((up, down), (down, up), (down, down)):
        np.testing.assert_array_equal(m(wi, wo), 0)
    many = np.tile(down, (30_000, 1))  # the compiled kernel
    np.testing.assert_array_equal(m(many, np.tile(up, (30_000, 1))), 0)


@pytest.mark.parametrize("name", ["mirror, matte", "glass, mirror", "glass, matte", "mirror, matte, glossy"])
def test_sums_obey_every_law(name: str) -> None:
    report = laws.check(SUMS[name][0])
    assert report.passed, str(report)


def leaky() -> Reflectance:
    """The radiance is not scaled by the indices."""
    m = SmoothDielectric()
    m._delta_arrays = lambda wi, wo: np.repeat(m.sampler.event_probability(wi, wo)[:, None], 3, axis=1)
    return m


def unsure() -> Reflectance:
    """Draws with other probabilities than it states."""
    m = SmoothDielectric()
    right = m.sampler.event_probability
    m.sampler.event_probability = lambda wi, wo: right(wi, wo) ** 1.2
    return m


@pytest.mark.parametrize(("wrong", "law"), [(leaky, "energy"), (leaky, "reciprocity"), (unsure, "sampling")])
def test_laws_notice_wrong_delta_events(wrong: Callable[[], Reflectance], law: str) -> None:
    assert laws.check(wrong())[law].status == "breaks"


@pytest.mark.parametrize(("into_denser", "verdict"), [(0.25, "holds"), (0.5, "breaks")])
def test_smooth_transmission_is_defined_on_the_whole_sphere(into_denser: float, verdict: str) -> None:
    """A diffuse sheet on a medium of index 2: the radiance below is 4 times as large as what goes the other way."""
    m = Sheet(into_denser)
    np.testing.assert_allclose(m(direction(20), direction(140)), into_denser)
    report = laws.check(m, [LAWS["positivity"], LAWS["reciprocity"]])
    assert report["positivity"].status == "holds"
    assert report["reciprocity"].status == verdict, str(report)


class Sheet(Reflectance):
    """Light from above goes below by `into_denser`, light from below goes above by 1 / 16 [1/sr]."""

    has_formula = False
    transmits = True
    relative_index = 2.0
    structure = ()

    def __init__(self, into_denser: float) -> None:
        self._into_denser = into_denser

    def _evaluate_arrays(self, wi: np.ndarray, wo: np.ndarray, clamp: bool) -> np.ndarray:
        through = np.where(wi[:, 2] > 0, self._into_denser, 1 / 16)
        return np.repeat(np.where(wi[:, 2] * wo[:, 2] < 0, through, 0.1)[:, None], 3, axis=1)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()

    def _state(self) -> tuple[dict, dict]:
        raise NotImplementedError


def test_what_holds_values_alone_refuses_delta_lobes() -> None:
    assert (2.0 * (0.1 * Mirror() + Lambertian())).has_delta
    assert not (GGX() + Lambertian()).has_delta
    with pytest.raises(ReflectanceError, match=r"^Mirror \+ Lambertian mirrors like a polished surface"):
        Table.bake(0.1 * Mirror() + Lambertian(), shape=(4, 4, 8))


def test_saves_and_restores(tmp_path: object) -> None:
    for m in (Mirror(reflectance=0.3), GOLD, SmoothDielectric(eta=1.33)):
        m.save(f"{tmp_path}/m.safetensors")
        back = Reflectance.restore(f"{tmp_path}/m.safetensors")
        assert repr(back) == repr(m)
        assert back.transmits == m.transmits
