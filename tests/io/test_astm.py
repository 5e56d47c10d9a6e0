"""ASTM E1392 text: columns by name, angles in radians or degrees, faults by line."""

from __future__ import annotations

import numpy as np
import pytest

from brdf import io
from brdf.errors import CorruptFileError
from brdf.io import astm

HEAD = "TITLE paint\nNUM_POINTS 2\nVARS theta_i,phi_i,theta_s,phi_s,"


def rows(tmp_path, text):
    (tmp_path / "m.txt").write_text(text)
    return astm.read_rows(tmp_path / "m.txt")


def test_spectra(tmp_path):
    nm, angles, values = rows(tmp_path, HEAD + "450.5nm,600nm\n0.1,0.2,0.3,-3,1,2\n0.2, 0, 0.4, 3.1, 3, 4\r\n")
    np.testing.assert_array_equal(nm, [450.5, 600])
    np.testing.assert_array_equal(angles, [[0.1, 0.2, 0.3, -3], [0.2, 0, 0.4, 3.1]])
    np.testing.assert_array_equal(values, [[1, 2], [3, 4]])


@pytest.mark.parametrize("zenith", [3.2, 80])
def test_degrees_are_told_by_a_zenith_angle_beyond_a_right_one(tmp_path, zenith):
    _, angles, _ = rows(tmp_path, HEAD + f"R,G,B\n1,0,{zenith},180,1,2,3\n")
    np.testing.assert_allclose(angles, np.radians([[1, 0, zenith, 180]]))


def test_a_right_angle_may_be_rounded_up(tmp_path):
    _, angles, _ = rows(tmp_path, HEAD + "R,G,B\n0.1,0,1.571,3,1,2,3\n")
    np.testing.assert_array_equal(angles, [[0.1, 0, 1.571, 3]])


def test_a_tab_may_separate_the_names_from_vars(tmp_path):
    (tmp_path / "m.txt").write_text((HEAD + "R,G,B\n0.1,0,0.2,3,1,2,3\n").replace("VARS ", "VARS\t"))
    np.testing.assert_allclose(io.read(tmp_path / "m.txt")([0, 0, 1.0], [0, 0, 1.0]), [1, 2, 3], rtol=1e-6)


def test_columns(tmp_path):
    nm, angles, values = rows(tmp_path, "VARS theta_i,theta_s,phi_s,Integrated 400-700\n0.1,0.2,3,5\n")
    assert nm is None
    np.testing.assert_array_equal(angles, [[0.1, 0, 0.2, 3]])
    np.testing.assert_array_equal(values, [[5, 5, 5]])
    _, _, white = rows(tmp_path, HEAD + "X,Y,Z\n0.1,0,0.2,3,.9504559,1,1.0890578\n")
    np.testing.assert_allclose(white, 1, atol=2e-4)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (HEAD + "R,G,B\n0.1,0,0.2,3,1,2\n", "line 4 holds 6 numbers, not the 7 that VARS names"),
        (HEAD + "R,G,B\n", "holds no measurement"),
        (HEAD + "red,blue\n0.1,0,0.2,3,1,2\n", "its values 'red,blue' are neither R,G,B nor X,Y,Z"),
        (HEAD + "R,G,B\n-0.1,0,0.2,3,1,2,3\n", "its zenith angles must lie in 0 to pi/2 radians"),
        (HEAD + "R,G,B\n0.1,0,95,3,1,2,3\n", "its zenith angles must lie in 0 to pi/2 radians"),
        (HEAD + "R,G,B\n0.1,0,1.58,3,1,2,3\n1.5,0,1.5,3,1,2,3\n", "has a zenith angle of 1.58, beyond pi/2 in radians"),
        (HEAD + "R,G,B\n0.1,0,3.19,3,1,2,3\n", "has a zenith angle of 3.19, beyond pi/2 in radians"),
        (HEAD + "600nm,500nm\n0.1,0,0.2,3,1,2\n", "wavelengths must be a list of positive numbers"),
        (HEAD + "R,G,B\n0.1,0,0.2,3,1,2,nan\n", "line 4 holds NaN or infinity"),
        ("VARS theta_i,phi_i,R,G,B\n1,2,3,4,5\n", "VARS must start with theta_i,phi_i,theta_s,phi_s"),
    ],
)
def test_faults(tmp_path, text, said):
    (tmp_path / "m.txt").write_text(text)
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.txt")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
