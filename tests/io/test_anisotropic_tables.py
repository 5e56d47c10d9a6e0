"""UTIA's and MIT CSAIL's files: values that tell their own direction come back there; broken files."""

from __future__ import annotations

import numpy as np
import pytest
from tests.io.samples import csail, utia

from brdf import io
from brdf.errors import CorruptFileError
from brdf.geometry.directions import from_spherical

RNG = np.random.default_rng(1)


@pytest.fixture(scope="module")
def utia_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("utia") / "m.bin"
    path.write_bytes(utia())
    return path


def test_utia_directions(utia_file):
    m = io.read(utia_file)
    index = RNG.integers([1, 0, 1, 0], [6, 48, 6, 48], (200, 4))
    theta_i, phi_i, theta_v, phi_v = (index * [15, 7.5, 15, 7.5]).T
    value = m(from_spherical(*np.radians([theta_i, phi_i])), from_spherical(*np.radians([theta_v, phi_v])))
    np.testing.assert_allclose(value, np.stack([1 + theta_i, 1 + phi_i, 1 + theta_v + phi_v / 1000], -1), rtol=1e-5)


def test_utia_between_directions(utia_file):
    """Elevations in between, azimuths on nodes: linear."""
    value = io.read(utia_file)(from_spherical(*np.radians([22.5, 75])), from_spherical(*np.radians([50, 105])))
    np.testing.assert_allclose(value, [23.5, 76, 51.105], rtol=1e-5)


def test_utia_negative_values_are_no_measurement(tmp_path):
    data = np.frombuffer(utia()).copy()
    data.reshape(3, 288, 288)[1, 100, 50] = -0.2
    (tmp_path / "m.bin").write_bytes(data.tobytes())
    m = io.read(tmp_path / "m.bin")
    assert np.count_nonzero(~m.measured) == 1
    assert m.codes.min() > 0


@pytest.mark.parametrize(("value", "said"), [(np.nan, "NaN, infinity"), (1e9, "no BRDF"), (-1.0, "no value above")])
def test_utia_broken_values(tmp_path, value, said):
    planes = np.full(3 * 288 * 288, value)
    (tmp_path / "m.bin").write_bytes(planes.tobytes())
    with pytest.raises(CorruptFileError, match=said):
        io.read(tmp_path / "m.bin")


def test_utia_size(tmp_path):
    (tmp_path / "m.bin").write_bytes(utia()[:-8])
    with pytest.raises(CorruptFileError, match="has 1990648 bytes; a UTIA file has 1990656"):
        io.read(tmp_path / "m.bin")


@pytest.mark.parametrize("is_half", [False, True])
def test_csail_bins(tmp_path, is_half):
    bins = (4, 5, 8, 6)
    (tmp_path / "m.dat").write_bytes(csail(bins, is_half))
    m = io.read(tmp_path / "m.dat")
    for i, j, k, n in np.ndindex(bins):
        theta_i, theta_o = (i + 0.5) / 4 * np.pi / 2, (j + 0.5) / 5 * np.pi / 2
        difference = (k + 0.5) / 8 * (np.pi if is_half else 2 * np.pi)
        phi_i = n / 6 * 2 * np.pi
        value = m(from_spherical(theta_i, phi_i), from_spherical(theta_o, phi_i + difference))
        np.testing.assert_allclose(value, [1 + i, 1 + j, 1 + k + n / 100], rtol=1e-5)


def test_csail_missing_bins(tmp_path):
    data = bytearray(csail())
    data[64:68] = np.array(-1, "<f4").tobytes()
    (tmp_path / "m.dat").write_bytes(data)
    m = io.read(tmp_path / "m.dat")
    assert np.count_nonzero(~m.measured) == 1
    assert m.codes.min() > 0


def header(index, value):
    data = bytearray(csail())
    data[4 * index : 4 * index + 4] = int(value).to_bytes(4, "little", signed=True)
    return bytes(data)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (header(0, 2**31 - 1), "its header says 2147483647 x 5 x 8 x 6 bins"),
        (header(0, 4000), "expected 11520064 bytes, found"),
        (header(0, -4), "its header says -4 x"),
        (header(6, 0), "has another parameterisation"),
        (header(7, 1), "has another parameterisation"),
        (header(10, 1), "has another parameterisation"),
        (csail()[:-4], "expected 11584 bytes, found 11580"),
        (csail()[:40], "has 40 bytes, too few for a header"),
        (csail()[:-4] + np.array(np.nan, "<f4").tobytes(), "its blue plane holds NaN or infinity"),
        (csail()[:64] + np.full(3 * 960, -1, "<f4").tobytes(), "holds no measured bin"),
    ],
)
def test_csail_faults(tmp_path, data, said):
    (tmp_path / "m.csail").write_bytes(data)
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.csail")
    assert said in str(caught.value)
