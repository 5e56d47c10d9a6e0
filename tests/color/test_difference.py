"""CIELAB and CIEDE2000 against published values, and against the formula written down in another way."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from brdf.color import ciede2000, rgb_to_lab, xyz_to_lab

# Sharma, Wu, Dalal 2005, table 1: L, a, b of both colours and their difference.
PUBLISHED = np.array([
    (50.0000, 2.6772, -79.7751, 50.0000, 0.0000, -82.7485, 2.0425),
    (50.0000, 3.1571, -77.2803, 50.0000, 0.0000, -82.7485, 2.8615),
    (50.0000, 2.8361, -74.0200, 50.0000, 0.0000, -82.7485, 3.4412),
    (50.0000, -1.3802, -84.2814, 50.0000, 0.0000, -82.7485, 1.0000),
    (50.0000, -1.1848, -84.8006, 50.0000, 0.0000, -82.7485, 1.0000),
    (50.0000, -0.9009, -85.5211, 50.0000, 0.0000, -82.7485, 1.0000),
    (50.0000, 0.0000, 0.0000, 50.0000, -1.0000, 2.0000, 2.3669),
    (50.0000, -1.0000, 2.0000, 50.0000, 0.0000, 0.0000, 2.3669),
    (50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0009, 7.1792),
    (50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0010, 7.1792),
    (50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0011, 7.2195),
    (50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0012, 7.2195),
    (50.0000, -0.0010, 2.4900, 50.0000, 0.0009, -2.4900, 4.8045),
    (50.0000, -0.0010, 2.4900, 50.0000, 0.0010, -2.4900, 4.8045),
    (50.0000, -0.0010, 2.4900, 50.0000, 0.0011, -2.4900, 4.7461),
    (50.0000, 2.5000, 0.0000, 50.0000, 0.0000, -2.5000, 4.3065),
    (50.0000, 2.5000, 0.0000, 73.0000, 25.0000, -18.0000, 27.1492),
    (50.0000, 2.5000, 0.0000, 61.0000, -5.0000, 29.0000, 22.8977),
    (50.0000, 2.5000, 0.0000, 56.0000, -27.0000, -3.0000, 31.9030),
    (50.0000, 2.5000, 0.0000, 58.0000, 24.0000, 15.0000, 19.4535),
    (50.0000, 2.5000, 0.0000, 50.0000, 3.1736, 0.5854, 1.0000),
    (50.0000, 2.5000, 0.0000, 50.0000, 3.2972, 0.0000, 1.0000),
    (50.0000, 2.5000, 0.0000, 50.0000, 1.8634, 0.5757, 1.0000),
    (50.0000, 2.5000, 0.0000, 50.0000, 3.2592, 0.3350, 1.0000),
    (60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644),
    (63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630),
    (61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731),
    (35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645),
    (22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373),
    (36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146),
    (90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441),
    (90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381),
    (6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377),
    (2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082),
])  # fmt: skip


def by_complex_numbers(first: np.ndarray, second: np.ndarray) -> float:
    """CIEDE2000 with colours as complex numbers a + ib: no case for hues beyond a full turn, no angle but in T.

    The mean hue is the direction of the sum of the unit numbers, 2 sqrt(C1 C2) sin(dh/2) comes from the half-angle
    formula with the sign of the cross product.
    """
    (l1, *ab1), (l2, *ab2) = first.tolist(), second.tolist()
    z1, z2 = complex(*ab1), complex(*ab2)
    vivid = ((abs(z1) + abs(z2)) / 2) ** 7
    stretch = 1 + (1 - math.sqrt(vivid / (vivid + 25**7))) / 2
    z1, z2 = complex(z1.real * stretch, z1.imag), complex(z2.real * stretch, z2.imag)
    c1, c2 = abs(z1), abs(z2)
    product = z1.conjugate() * z2
    d_hue = math.copysign(math.sqrt(max(0, 2 * (c1 * c2 - product.real))), product.imag)
    units = [z / abs(z) for z in (z1, z2) if z]
    hue = math.degrees(cmath.phase(sum(units)) % (2 * math.pi)) if units else 0.0
    chroma, lightness = (c1 + c2) / 2, (l1 + l2) / 2
    t = 1
    for weight, times, shift in ((-0.17, 1, -30), (0.24, 2, 0), (0.32, 3, 6), (-0.20, 4, -63)):
        t += weight * math.cos(math.radians(times * hue + shift))
    s_l = 1 + 0.015 * (lightness - 50) ** 2 / math.sqrt(20 + (lightness - 50) ** 2)
    s_c, s_h = 1 + 0.045 * chroma, 1 + 0.015 * chroma * t
    turn = math.radians(30 * math.exp(-(((hue - 275) / 25) ** 2)))
    r_t = -2 * math.sqrt(chroma**7 / (chroma**7 + 25**7)) * math.sin(2 * turn)
    parts = (l2 - l1) / s_l, (c2 - c1) / s_c, d_hue / s_h
    return math.sqrt(sum(p * p for p in parts) + r_t * parts[1] * parts[2])


def test_published_pairs() -> None:
    np.testing.assert_allclose(ciede2000(PUBLISHED[:, :3], PUBLISHED[:, 3:6]), PUBLISHED[:, 6], atol=5.1e-5)


def test_it_is_symmetric() -> None:
    np.testing.assert_allclose(ciede2000(PUBLISHED[:, 3:6], PUBLISHED[:, :3]), PUBLISHED[:, 6], atol=5.1e-5)


def test_agrees_with_the_formula_in_complex_numbers() -> None:
    rng = np.random.default_rng(5)
    colours = rng.uniform((0, -90, -90), (100, 90, 90), (2, 400, 3))
    expected = [by_complex_numbers(*pair) for pair in zip(*colours, strict=True)]
    np.testing.assert_allclose(ciede2000(*colours), expected, rtol=1e-9)
    # of the published pairs those whose hues are not opposite, where the mean hue is a matter of rounding
    clear = [*range(8), *range(15, 34)]
    found = [by_complex_numbers(row[:3], row[3:6]) for row in PUBLISHED[clear]]
    np.testing.assert_allclose(found, PUBLISHED[clear, 6], atol=5.1e-5)


def test_a_colour_does_not_differ_from_itself_and_greys_differ_by_lightness() -> None:
    rng = np.random.default_rng(6)
    colours = rng.uniform((0, -90, -90), (100, 90, 90), (50, 3))
    assert (ciede2000(colours, colours) == 0).all()
    # S_L of mean lightness 50 is 1
    assert ciede2000([48.0, 0, 0], [52.0, 0, 0]) == pytest.approx(4)
    assert ciede2000([0.0, 0, 0], [100.0, 0, 0]) == pytest.approx(100)


def test_float32_stays_float32_and_is_as_good() -> None:
    first, second = PUBLISHED[:, :3].astype(np.float32), PUBLISHED[:, 3:6].astype(np.float32)
    clear = [*range(8), *range(15, 34)]
    found = ciede2000(first, second)
    assert found.dtype == rgb_to_lab(first).dtype == np.float32
    np.testing.assert_allclose(found[clear], PUBLISHED[clear, 6], atol=2e-4)


@pytest.mark.parametrize(
    ("rgb", "lab"),
    [  # the primaries of sRGB, Lindbloom's calculator
        ((1, 1, 1), (100, 0, 0)),
        ((0, 0, 0), (0, 0, 0)),
        ((1, 0, 0), (53.2408, 80.0925, 67.2032)),
        ((0, 1, 0), (87.7347, -86.1827, 83.1793)),
        ((0, 0, 1), (32.2970, 79.1875, -107.8602)),
    ],
)
def test_lab_of_the_primaries(rgb: tuple[float, ...], lab: tuple[float, ...]) -> None:
    np.testing.assert_allclose(rgb_to_lab(np.array(rgb, float)), lab, atol=0.02)


def test_lab_is_smooth_at_its_knee() -> None:
    knee = (6 / 29) ** 3
    low, high = (xyz_to_lab([0, knee * (1 + shift), 0])[0] for shift in (-1e-7, 1e-7))
    assert low == pytest.approx(8, abs=1e-5)  # L = 116 * 6/29 - 16
    slope = (high - low) / (2e-7 * knee)
    assert slope == pytest.approx(24389 / 27, rel=1e-4)  # both pieces: 903.3 per unit of Y
