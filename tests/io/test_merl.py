"""MERL files: layout, factors, invalid bins, broken files, time and memory."""

from __future__ import annotations

import subprocess
import sys
import time

import numpy as np
import pytest

import brdf
from brdf import io
from brdf.errors import CorruptFileError
from brdf.io import merl

BYTES = 12 + 3 * 8 * 90 * 90 * 180


def stored(red: float = 1500.0) -> np.ndarray:
    planes = np.empty((3, 90, 90, 180))
    planes[:] = np.array([red, 1500 / 1.15, 1500 / 1.66])[:, None, None, None]
    return planes


def written(path, planes, header=(90, 90, 180)):
    path.write_bytes(np.array(header, "<i4").tobytes() + planes.astype("<f8").tobytes())
    return path


@pytest.fixture(scope="module")
def ggx_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("merl") / "ggx.binary"
    io.write(brdf.models.GGX(alpha=0.3, F0=0.8), path)
    return path


def test_layout_and_factors(tmp_path):
    planes = stored()
    planes[1].flat[7 + 180 * (5 + 90 * 3)] *= 4
    planes[:, 80, 85, 60] = -1
    values = merl.read_values(written(tmp_path / "m.binary", planes))
    assert values.dtype == np.float32
    np.testing.assert_allclose(values[3, 5, 7], (1, 4, 1), rtol=1e-6)
    assert (values[80, 85, 60] < 0).all()
    values[3, 5, 7] = values[80, 85, 60] = 1
    np.testing.assert_allclose(values, 1, rtol=1e-6)


def test_file_has_the_published_size(ggx_file):
    assert ggx_file.stat().st_size == BYTES == 34_992_012


def test_written_file_reads_as_the_same_reflectance(ggx_file):
    read, model = io.read(ggx_file), brdf.models.GGX(alpha=0.3, F0=0.8)
    assert read.name == "ggx"
    theta_h, theta_d, phi_d = (20 / 90) ** 2 * np.pi / 2, np.radians(31), np.radians(40)
    d = [np.sin(theta_d) * np.cos(phi_d), np.sin(theta_d) * np.sin(phi_d), np.cos(theta_d)]
    c, s = np.cos(theta_h), np.sin(theta_h)
    wi = np.array([c * d[0] + s * d[2], d[1], c * d[2] - s * d[0]])
    wo = np.array([-c * d[0] + s * d[2], -d[1], c * d[2] + s * d[0]])
    np.testing.assert_allclose(read(wi, wo), model(wi, wo), rtol=1e-5)


def test_round_trip_keeps_every_bin(ggx_file, tmp_path):
    io.write(io.read(ggx_file), tmp_path / "again.binary")
    first, again = merl.read_values(ggx_file), merl.read_values(tmp_path / "again.binary")
    np.testing.assert_allclose(again, first, rtol=1e-6)


@pytest.mark.parametrize("header", [(1000, 1000, 1000), (90, 90, 360), (0, 0, 0), (-90, 90, 180), (2**31 - 1,) * 3])
def test_other_dimensions(tmp_path, header):
    path = written(tmp_path / "m.binary", np.zeros(10), header)
    with pytest.raises(CorruptFileError, match=f"says {header[0]} x .* only 90 x 90 x 180 is read"):
        io.read(path)


@pytest.mark.parametrize(("change", "said"), [(-8, "truncated"), (8, "appended")])
def test_wrong_size(tmp_path, change, said):
    path = tmp_path / "m.binary"
    with path.open("wb") as file:
        file.write(np.array([90, 90, 180], "<i4").tobytes())
        file.truncate(BYTES + change)
    with pytest.raises(CorruptFileError, match=f"expected {BYTES} bytes, found {BYTES + change}: .*{said}"):
        io.read(path)


def test_shorter_than_the_header(tmp_path):
    (tmp_path / "m.binary").write_bytes(b"\x5a\0\0\0")
    with pytest.raises(CorruptFileError, match="has 4 bytes, too few"):
        io.read(tmp_path / "m.binary")


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e300])
def test_values_that_are_not_numbers(tmp_path, value):
    planes = stored()
    planes[2, 4, 5, 6] = value
    with pytest.raises(CorruptFileError, match="blue plane holds NaN or infinity"):
        io.read(written(tmp_path / "m.binary", planes))


def test_nothing_measured(tmp_path):
    with pytest.raises(CorruptFileError, match="no measured bin"):
        io.read(written(tmp_path / "m.binary", -np.ones((3, 90, 90, 180))))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="peak memory is read from /proc")
def test_time_and_memory(ggx_file):
    """Reading takes at most 0.3 s once the file is cached; the whole process stays below 150 MB."""
    merl.read_values(ggx_file)
    times = []
    for _ in range(5):
        start = time.perf_counter()
        io.read(ggx_file)
        times.append(time.perf_counter() - start)
    # VmHWM, not ru_maxrss: the latter carries the peak of the test process over into its child
    script = "import sys; from brdf import io; io.read(sys.argv[1]); print(open('/proc/self/status').read())"
    run = subprocess.run([sys.executable, "-c", script, ggx_file], capture_output=True, text=True, check=True)
    peak = int(run.stdout.partition("VmHWM:")[2].split()[0]) / 1024
    assert peak <= 150, f"{peak:.0f} MB"
    assert min(times) <= 0.3, times
