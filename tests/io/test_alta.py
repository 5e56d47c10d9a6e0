"""ALTA text: its parameterisations stand for the right directions, a cosine is divided out, faults are named."""

from __future__ import annotations

import numpy as np
import pytest

from brdf import io
from brdf.errors import CorruptFileError
from brdf.geometry.directions import to_half_difference as half_difference
from brdf.geometry.directions import to_spherical
from brdf.io import alta
from helpers import random_directions

WI, WO = random_directions(50, 1, 0.1), random_directions(50, 2, 0.1)


def angles(w):
    return to_spherical(w)


def rows_of(kind):
    """What ALTA writes for the directions: theta_l is the light's, theta_v the viewer's angle."""
    (tl, pl), (tv, pv) = angles(WI), angles(WO)
    half = half_difference(WO, WI)  # ALTA's difference vector is the viewer's
    return {
        "CARTESIAN": [*WO.T, *WI.T],
        "COS_TH_TD": [np.cos(half.theta_h), np.cos(half.theta_d)],
        "ISOTROPIC_TL_TV_PROJ_DPHI": [tl, tv * np.cos(pl - pv), tv * np.sin(pl - pv)],
        "ISOTROPIC_TV_PROJ_DPHI": [tv * np.cos(pl - pv), tv * np.sin(pl - pv)],
        "ISOTROPIC_TV_TL_DPHI": [tv, tl, pl - pv],
        "RUSIN_TH_PH_TD_PD": [half.theta_h, half.phi_h, half.theta_d, half.phi_d],
        "RUSIN_TH_TD": [half.theta_h, half.theta_d],
        "RUSIN_TH_TD_PD": [half.theta_h, half.theta_d, half.phi_d],
        "SPHERICAL_TL_PL_TV_PV": [tl, pl, tv, pv],
    }[kind]


def written(path, kind, values, output="INV_STERADIAN", extra=""):
    columns = [*rows_of(kind), *np.atleast_2d(values)]
    header = f"#DIM {len(columns) - len(np.atleast_2d(values))} {len(np.atleast_2d(values))}\n#PARAM_IN {kind}\n"
    lines = [" ".join(f"{x:.17g}" for x in row) for row in np.transpose(columns)]
    path.write_text(header + f"#PARAM_OUT {output}\n" + extra + "\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("kind", alta.INPUTS)
def test_directions(kind, tmp_path):
    numbered = np.arange(50.0)
    wi, wo, values = alta.read_samples(written(tmp_path / "m.dat", kind, numbered))
    kept = values[:, 0].astype(int)
    half, expected = half_difference(wi, wo), half_difference(WI[kept], WO[kept])
    if kind == "ISOTROPIC_TV_PROJ_DPHI":  # without a light: along the normal
        np.testing.assert_allclose(wi, [[0, 0, 1]] * len(wi), atol=1e-12)
        np.testing.assert_allclose(wo[:, 2], WO[kept, 2], atol=1e-12)
        return
    assert len(kept) > 20 or kind in ("COS_TH_TD", "RUSIN_TH_TD")
    np.testing.assert_allclose(half.theta_h, expected.theta_h, atol=1e-7)
    np.testing.assert_allclose(half.theta_d, expected.theta_d, atol=1e-7)
    if len(rows_of(kind)) > 2:
        np.testing.assert_allclose(wi[:, 2], WI[kept, 2], atol=1e-9)
        np.testing.assert_allclose(wo[:, 2], WO[kept, 2], atol=1e-9)
    if kind in ("CARTESIAN", "RUSIN_TH_PH_TD_PD", "SPHERICAL_TL_PL_TV_PV"):
        np.testing.assert_allclose(wi, WI[kept], atol=1e-9)


def test_cosine_of_the_viewer_is_divided_out(tmp_path):
    path = written(tmp_path / "m.dat", "SPHERICAL_TL_PL_TV_PV", 2 * WO[:, 2], "INV_STERADIAN_COSINE_FACTOR")
    np.testing.assert_allclose(alta.read_samples(path)[2], 2, rtol=1e-12)


def test_colours_and_intervals(tmp_path):
    rgb = np.stack([0 * WO[:, 2] + k for k in (1, 2, 3)])
    path = written(tmp_path / "m.dat", "CARTESIAN", rgb, "RGB_COLOR")
    np.testing.assert_allclose(alta.read_samples(path)[2], [[1, 2, 3]] * 50)
    white = np.stack([0 * WO[:, 2] + k for k in (0.9504559, 1, 1.0890578)])
    path = written(tmp_path / "m.dat", "CARTESIAN", white, "XYZ_COLOR")
    np.testing.assert_allclose(alta.read_samples(path)[2], 1, atol=2e-4)
    path = written(tmp_path / "m.dat", "CARTESIAN", white * [[0.0], [1], [0]], "XYZ_COLOR")
    green = alta.read_samples(path)[2]  # out of gamut
    assert (green[:, [0, 2]] == 0).all()
    assert (green[:, 1] > 1).all()
    path.write_text("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n#VS 2\n0.1 0.2 5 4 6\n0.3 0.2 5 4 6\n")
    np.testing.assert_array_equal(alta.read_samples(path)[2], 5)


def test_published_retroreflector(data):
    """A yellow tape: it reflects most towards the light, and as a mirror does."""
    wi, wo, values = alta.read_samples(data / "gonio" / "alta_retro" / "retro-3M-jaune.dat")
    assert len(values) > 7000
    for degrees in (15, 30):
        at = np.abs(np.degrees(np.arccos(wi[:, 2])) - degrees) < 0.1
        apart = np.degrees(np.arccos(np.clip((wi * wo).sum(1), -1, 1)))
        assert values[at & (apart < 2), 0].max() > 8 * np.median(values[at & (apart > 30), 0])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "#DIM 3 1\n#PARAM_IN RUSIN_TH_TD\n0 0 1\n",
            "#DIM must be 2 1 or 3 for RUSIN_TH_TD and INV_STERADIAN, got",
        ),
        ("#DIM 2 1\n#PARAM_IN MADE_UP\n0 0 1\n", "its parameters are 'MADE_UP'; read are CARTESIAN"),
        ("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n#PARAM_OUT ENERGY\n0 0 1\n", "its values are 'ENERGY'"),
        ("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n#FORMAT binary\n", "is ALTA's binary data; convert it to text"),
        ("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n", "holds no measurement above the horizon"),
        ("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n0 0 1\n0 0 x\n", "line 4 must hold numbers, got '0 0 x'"),
        ("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n0 0\n", "line 3 holds 2 numbers, not 2 inputs and 1 values"),
        ("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n0 0 1 1 1 1\n", "line 3 holds 6 numbers"),
        ("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n0 inf 1\n", "line 3 holds NaN or infinity"),
    ],
)
def test_faults(tmp_path, text, said):
    (tmp_path / "m.dat").write_text(text)
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.dat")
    assert said in str(caught.value)
