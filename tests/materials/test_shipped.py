"""Every published row is finite and not negative; those of SGD in detail: precision, energy, likeness."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from brdf import materials
from brdf.laws.probes import adversarial
from brdf.materials import catalogue
from brdf.reflectance import Reflectance
from lobes import direction, lobe_albedo, random_pairs
from networks import nbrdf

SGD = [f"{name}@bagher_sgd" for name in catalogue.names()]
ROWS: dict[str, list[str]] = {}
for _name in catalogue.names():
    for _fit in catalogue.fits(_name):
        ROWS.setdefault(_fit, []).append(f"{_name}@{_fit}")


@pytest.fixture(scope="module")
def pairs() -> tuple[np.ndarray, np.ndarray]:
    """Single-precision pairs: random, near-mirror to 1e-5 rad, exact mirror, retro, and down to 1e-4 of a degree."""
    rng = np.random.default_rng(11)
    n = 3000
    cosine, phi = rng.uniform(0, 1, (2, n)), rng.uniform(0, 2 * np.pi, (2, n))
    cosine[:, ::3] **= 4
    cosine = np.maximum(cosine, 2e-6)
    sine = np.sqrt(1 - cosine**2)
    wi, wo = np.stack([sine * np.cos(phi), sine * np.sin(phi), cosine], -1)
    mirror = wi[: n // 2] * [-1, -1, 1] + rng.normal(size=(n // 2, 3)) * 10 ** rng.uniform(-6, -0.5, (n // 2, 1))
    mirror[:100] = wi[:100] * [-1, -1, 1]
    mirror[100:200] = wi[100:200]
    mirror[:, 2] = np.maximum(np.abs(mirror[:, 2]), 2e-6)
    wo[: n // 2] = mirror / np.linalg.norm(mirror, axis=-1, keepdims=True)
    wi[-1] = wo[-1] = (0, 0, 1)
    return wi.astype(np.float32), wo.astype(np.float32)


def test_all_1302_rows_are_there() -> None:
    assert sum(map(len, ROWS.values())) == 1302
    assert sorted(map(len, ROWS.values())) == [86] * 7 + [100] * 7


@pytest.mark.parametrize("fit", ROWS)
def test_finite_and_not_negative(fit: str, pairs: tuple[np.ndarray, np.ndarray]) -> None:
    """In 300 of the pairs and all delicate ones: cosines to 1e-6, the exact normal, wi = wo, mirrored."""
    wi, wo = (np.concatenate([a[::10], b]) for a, b in zip(pairs, adversarial(), strict=True))
    for row in ROWS[fit]:
        m = materials.get(row)
        for dtype in (np.float32, np.float64):
            value = m.raw(wi.astype(dtype), wo.astype(dtype))
            assert value.dtype == dtype
            assert np.isfinite(value).all(), row
            assert (value >= 0).all(), row


@pytest.mark.parametrize("fit", ROWS)
def test_reciprocal_and_isotropic(fit: str) -> None:
    """Also after both directions turn together by a radian."""
    wi, wo = random_pairs(120)
    turn = np.array([[np.cos(1), -np.sin(1), 0], [np.sin(1), np.cos(1), 0], [0, 0, 1]])
    for row in ROWS[fit]:
        m = materials.get(row)
        value = m(wi, wo)
        np.testing.assert_allclose(m(wo, wi), value, rtol=1e-6, atol=1e-9, err_msg=row)
        np.testing.assert_allclose(m(wi @ turn, wo @ turn), value, rtol=1e-6, atol=1e-9, err_msg=row)


def precision_loss(m: Reflectance, pairs: tuple[np.ndarray, np.ndarray], angle: float) -> float:
    """Largest difference of single from double precision up to `angle` degrees, relative to f + 1e-3/sr."""
    least = np.cos(np.radians(angle))
    use = (pairs[0][:, 2] > least) & (pairs[1][:, 2] > least)
    wi, wo = (w[use] for w in pairs)
    double = m(wi.astype(np.float64), wo.astype(np.float64))
    return float((np.abs(m(wi, wo) - double) / (double + 1e-3)).max())


@pytest.mark.parametrize(("angle", "bound"), [(85.0, 2e-5), (89.0, 2e-4)])
def test_single_precision(angle: float, bound: float, pairs: tuple[np.ndarray, np.ndarray]) -> None:
    """Measured: 5e-6 up to 85 degrees, 4e-5 up to 89.

    Nearer the horizon the fitted G1 goes to 0 as a difference from 1, over a cosine that goes to 0, too: single
    precision loses digits there whatever the order of the operations.
    """
    loss = {name: precision_loss(materials.get(name), pairs, angle) for name in SGD}
    assert max(loss.values()) < bound, sorted(loss.items(), key=lambda item: -item[1])[:5]


@pytest.mark.parametrize("theta", [5.0, 45.0, 60.0])
def test_energy(theta: float) -> None:
    for name in SGD:
        m = materials.get(name)
        albedo = m.kd + lobe_albedo(m.replaced(kd=0.0), direction(theta), 120, 32)
        assert (albedo > 0).all(), name
        assert (albedo < 1).all(), name


@pytest.fixture(scope="module")
def weights(data: Path) -> dict[str, np.ndarray]:
    with np.load(data / "merl" / "merl_nbrdf_weights.npz", allow_pickle=False) as file:
        return {key: file[key].astype(float) for key in file.files}


def inner_pairs() -> tuple[np.ndarray, np.ndarray]:
    """Pairs within 60 degrees, half of them with half vectors within 20 degrees of the normal."""
    rng = np.random.default_rng(5)
    cosine, phi = rng.uniform(0.5, 1, (2, 3000)), rng.uniform(0, 2 * np.pi, (2, 3000))
    sine = np.sqrt(1 - cosine**2)
    wi, wo = np.stack([sine * np.cos(phi), sine * np.sin(phi), cosine], -1)
    mirror = wi[:1500] * [-1, -1, 1] + rng.normal(size=(1500, 3)) * 0.15
    wo[:1500] = mirror / np.linalg.norm(mirror, axis=-1, keepdims=True)
    use = wo[:, 2] > 0.5
    return wi[use], wo[use]


def test_against_networks_fitted_to_the_same_measurements(weights: dict[str, np.ndarray]) -> None:
    wi, wo = inner_pairs()
    difference = {}
    for name in sorted({key.partition("/")[0] for key in weights} & set(catalogue.names())):
        ours, theirs = materials.get(name, "bagher_sgd")(wi, wo), nbrdf(weights, name, wi, wo)
        use = theirs > 1e-4
        difference[name] = np.median(np.abs(np.log(ours[use] / theirs[use])))
    values = np.array(list(difference.values()))
    # Measured: 80 materials, median 0.106, 76 % below 0.3. The sharpest metals are misfitted by the model itself.
    assert len(values) == 80
    assert np.median(values) < 0.15
    assert np.mean(values < 0.3) > 0.7


def test_units_of_the_highlight(weights: dict[str, np.ndarray]) -> None:
    """Broad lobes (alpha > 0.05) that outshine the diffuse part: with 4 in place of pi in the denominator the logarithm
    of the ratio would be 0.24 lower. Measured: 13 materials, median 0.020, from -0.064 to 0.092."""
    wi, wo = inner_pairs()
    h = wi + wo
    near = h[:, 2] > np.cos(np.radians(10)) * np.linalg.norm(h, axis=-1)
    ratios = []
    for name in sorted({key.partition("/")[0] for key in weights} & set(catalogue.names())):
        m = materials.get(name, "bagher_sgd")
        theirs = nbrdf(weights, name, wi[near], wo[near])
        lobe = theirs > 4 * m.kd / np.pi
        if m.alpha.min() > 0.05 and lobe.mean() > 0.2:
            ratios.append(np.median(np.log(m(wi[near], wo[near])[lobe] / theirs[lobe])))
    assert len(ratios) >= 10
    assert abs(np.median(ratios)) < 0.05
    assert np.max(np.abs(ratios)) < 0.12


@pytest.mark.parametrize("theta", [75.0, 85.0])
def test_energy_near_grazing(theta: float) -> None:
    """Extrapolated beyond the angles of the fits, some rows reflect more than they receive; these and no others."""
    found = {}
    for name in SGD:
        m = materials.get(name)
        albedo = float((m.kd + lobe_albedo(m.replaced(kd=0.0), direction(theta), 160, 64)).max())
        if albedo > 1:
            found[name.partition("@")[0]] = round(albedo, 2)
    expected = {
        75.0: {"white-paint": 1.42},
        85.0: {
            "color-changing-paint1": 1.08,
            "gold-metallic-paint2": 1.17,
            "two-layer-silver": 1.12,
            "white-paint": 2.29,
            "yellow-matte-plastic": 1.2,
        },
    }[theta]
    assert found == pytest.approx(expected, abs=0.02)
