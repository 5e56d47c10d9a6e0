"""Goniometer text: what is read, and that every fault names its line."""

from __future__ import annotations

import numpy as np
import pytest

from brdf import io
from brdf.errors import CorruptFileError
from brdf.io import gonio

HEAD = "# paint\n\n3  # wavelengths\n400 500\n600\n"
ROW = "0.5 0.0 0.5 3.1 0.1 0.2 0.3\n"


def test_rows(tmp_path):
    (tmp_path / "m.brdf").write_text(HEAD + ROW + "\n0.6 0.1 0.2 -3 1 2 3 # end\n")
    nm, angles, values = gonio.read_rows(tmp_path / "m.brdf")
    np.testing.assert_array_equal(nm, [400, 500, 600])
    np.testing.assert_array_equal(angles, [[0.5, 0, 0.5, 3.1], [0.6, 0.1, 0.2, -3]])
    np.testing.assert_array_equal(values, [[0.1, 0.2, 0.3], [1, 2, 3]])


def test_recognised_without_its_extension(tmp_path):
    (tmp_path / "m.txt").write_text(HEAD + ROW * 3)
    m = io.read(tmp_path / "m.txt")
    np.testing.assert_allclose(m.spectrum([0, 0, 1.0], [0, 0, 1.0]), [0.1, 0.2, 0.3], rtol=1e-5)


def test_published_file(data):
    m = io.read(data / "gonio" / "cornell" / "garnet_red.brdf")
    assert (m.name, len(m.wavelengths), m.wavelengths[0], m.wavelengths[-1]) == ("garnet_red", 31, 400, 700)
    red, green, blue = m.albedo([0, 0, 1.0], samples=1024)
    assert 1 > red > 3 * green > 0
    assert blue < red


@pytest.mark.parametrize("file", ["ua_rt300s/IMX455.bsdf", "alta_retro/retro-gray-tape.dat"])
def test_other_text_tables_are_not_taken_for_it(data, file):
    assert not gonio.recognises((data / "gonio" / file).read_bytes()[:8192], 10_000)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (HEAD + ROW + "0.5 0.0 0.5 3.1 0.1 0.2\n", "line 7 holds 6 numbers, not 4 angles and 3 values"),
        (HEAD + ROW + ROW[:20], "line 7 holds 5 numbers"),
        (HEAD + ROW + "0.5 0.0 0.5 3.1 0.1 nan 0.3\n", "line 7 holds NaN or infinity"),
        (HEAD + "0.5 0.0 0.5 3.1 0.1 1e999 0.3\n", "line 6 holds NaN or infinity"),
        (HEAD + ROW + "0.5 0.0 0.5 3.1 0.1 red 0.3\n", "line 7 must hold numbers, got '0.5 0.0"),
        (HEAD + "30 0.0 30 180 0.1 0.2 0.3\n", "line 6: zenith angles must lie in 0 to pi/2 radians"),
        (HEAD, "holds no measurement after line 5"),
        ("3\n400 500\n", "line 2: 2 of 3 wavelengths are there"),
        ("3\n400 500 600 700\n", "line 2: 4 of 3 wavelengths are there"),
        ("1000000000\n400\n", "line 1 must hold the number of wavelengths, 1 to 2000"),
        ("0\n400\n", "line 1 must hold the number of wavelengths"),
        ("3\n500 400 600\n" + ROW, "wavelengths must be a list of positive numbers"),
    ],
)
def test_faults(tmp_path, text, said):
    (tmp_path / "m.brdf").write_text(text)
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.brdf")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
