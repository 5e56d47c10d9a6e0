"""Profiles: their integrals over the plane in closed form, and values worked out elsewhere."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from brdf import profiles
from brdf.errors import ParameterError, UnknownNameError
from brdf.models.terms.fresnel import dielectric
from brdf.profiles import Profile
from brdf.profiles.burley import SCALINGS, Burley
from brdf.profiles.dipole import Dipole

CASES = [
    Burley(A=(0.2, 0.8, 1.0), length=(0.1, 1.0, 20.0)),
    Burley(A=(0.0, 0.33, 0.9), scaling="diffuse"),
    Burley(A=(0.1, 0.5, 0.95), scaling="diffuse-mean-free-path", length=3.0),
    Dipole(),
    Dipole(sigma_s=(2.19, 2.62, 3.0), sigma_a=(0.0021, 0.0041, 0.0071), eta=1.5),  # marble of Jensen2001, Figure 5
    Dipole(sigma_s=1.0, sigma_a=(0.5, 5.0, 100.0), eta=1.0),
]


@pytest.mark.parametrize("profile", CASES, ids=repr)
def test_integral_over_the_plane_is_the_albedo(profile: Profile) -> None:
    x, weight = np.polynomial.legendre.leggauss(400)
    for channel in range(3):
        # Gauss-Legendre in ln r, since a profile spans many decades
        low, high = np.log(profile.reach()[channel]) + np.array([-25, 9])
        r = np.exp((low + high) / 2 + (high - low) / 2 * x)
        integral = float((2 * np.pi * r * r * profile(r)[:, channel] * weight).sum() * (high - low) / 2)
        assert integral == pytest.approx(profile.total()[channel], rel=1e-6, abs=1e-12)


def test_burley_within_is_the_integral_up_to_there() -> None:
    m = Burley(A=0.8, length=2.0)
    inside = quad(lambda r: 2 * np.pi * r * m(r)[0], 0, 1.5)[0] / 0.8
    assert m.within(1.5)[0] == pytest.approx(inside, rel=1e-9)
    assert m.d[0] == pytest.approx(2 / 1.05)  # s(0.8) = 1.85 - 0.8


@pytest.mark.parametrize(
    ("scaling", "A", "by_hand"),
    [("searchlight", 0.3, 2.425), ("diffuse", 0.5, 1.715), ("diffuse-mean-free-path", 0.53, 3.66)],
)
def test_scalings(scaling: str, A: float, by_hand: float) -> None:
    assert SCALINGS[scaling](np.float64(A)) == pytest.approx(by_hand)


def test_dipole_of_marble() -> None:
    """F_dr is the diffuse reflectance of the boundary from inside; marble's albedo in their table is as below."""
    marble = CASES[4]
    assert isinstance(marble, Dipole)
    from_inside = quad(lambda c: 2 * c * dielectric(c, 1 / 1.5), 0, 1, points=[np.sqrt(1 - 1 / 2.25)])[0]
    F_dr = (marble.A - 1) / (marble.A + 1)
    assert F_dr == pytest.approx(from_inside, abs=2e-3)
    np.testing.assert_allclose(marble.total(), (0.83, 0.79, 0.75), atol=0.006)


def test_profiles_fall_and_spread_with_the_mean_free_path() -> None:
    """Both fall without a bump, and a wider mean free path spreads the same light farther."""
    r = np.geomspace(0.01, 30, 200)
    for profile in CASES:
        value = profile(r)
        assert (np.diff(value, axis=0) <= 0).all()
        assert (value >= 0).all()
    assert (Burley(A=0.8, length=2.0)(10.0) > Burley(A=0.8, length=1.0)(10.0)).all()


def test_names_and_bad_input() -> None:
    assert profiles.names() == ["burley", "dipole"]
    assert profiles.get("Burley") is Burley
    with pytest.raises(UnknownNameError, match="unknown profile 'burly': did you mean 'burley'"):
        profiles.get("burly")
    with pytest.raises(ParameterError, match=r"A must lie in \[0, 1\], got 2"):
        Burley(A=2)
    with pytest.raises(ParameterError, match="distances must be above 0 mm"):
        Dipole()([0.0, 1.0])
