"""Tensor files: the table of contents is checked against the file before memory is taken."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from tests.representations.synthetic_rgl import tensors

from brdf import io
from brdf.errors import CorruptFileError
from brdf.io import rgl


@pytest.fixture
def path(tmp_path):
    rgl.write_tensors(tensors(), tmp_path / "m.bsdf")
    return tmp_path / "m.bsdf"


def test_tensors_round_trip(tmp_path):
    rng = np.random.default_rng(1)
    types = ("u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f2", "f4", "f8")
    fields = {f"field {t}": rng.integers(0, 9, (2, 3, 1)).astype(t) for t in types}
    rgl.write_tensors(fields, tmp_path / "m.bsdf")
    read = rgl.read_tensors(tmp_path / "m.bsdf")
    assert list(read) == list(fields)
    for name, array in fields.items():
        assert read[name].dtype == array.dtype
        np.testing.assert_array_equal(read[name], array)


def test_published_file_survives(data, tmp_path):
    source = data / "rgl" / "irid_flake_paint1_fine_rgb.bsdf"
    io.write(io.read(source), tmp_path / "m.bsdf")
    before, after = rgl.read_tensors(source), rgl.read_tensors(tmp_path / "m.bsdf")
    for name in after:
        if name != "description":
            np.testing.assert_array_equal(after[name].ravel(), before[name].ravel().astype(after[name].dtype))


@pytest.mark.parametrize("kept", [13, 17, 30, 100, 400, 0.3, 0.999])
def test_truncated(path, kept):
    data = path.read_bytes()
    path.write_bytes(data[: kept if kept > 1 else int(kept * len(data))])
    with pytest.raises(CorruptFileError, match=r"ends at byte|claims bytes"):
        io.read(path)


def entry(name, code=10, offset=0, shape=(1,)):
    return struct.pack("<H", len(name)) + name + struct.pack(f"<HBQ{len(shape)}Q", len(shape), code, offset, *shape)


@pytest.mark.parametrize(
    ("contents", "said"),
    [
        (struct.pack("<BBI", 1, 0, 2**32 - 1), "claims 4294967295 fields"),
        (struct.pack("<BBI", 7, 0, 1), "not a tensor file of version 1.0"),
        (struct.pack("<BBI", 1, 0, 1) + entry(b"rgb", 12), "'rgb' is of the unknown type 12"),
        (struct.pack("<BBI", 1, 0, 1) + entry(b"rgb", 0), "'rgb' is of the unknown type 0"),
        (struct.pack("<BBI", 1, 0, 1) + entry(b"rgb", shape=(1,) * 9), "'rgb' claims 9 axes"),
        (struct.pack("<BBI", 1, 0, 1) + entry(b"rgb", offset=100, shape=(2**40, 2**40)), "'rgb' claims bytes"),
        (struct.pack("<BBI", 1, 0, 1) + entry(b"rgb", offset=2**63, shape=(1,)), "'rgb' claims bytes"),
        (struct.pack("<BBI", 1, 0, 1) + entry(b"rgb", offset=4, shape=(1,)), "'rgb' claims bytes 4 to 8"),
    ],
)
def test_broken_contents(tmp_path, contents, said):
    (tmp_path / "m.bsdf").write_bytes(rgl.SIGNATURE + contents + bytes(64))
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.bsdf")
    assert said in str(caught.value)


def changed(name, array):
    return lambda fields: fields | {name: array(fields[name])}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda fields: {k: v for k, v in fields.items() if k != "vndf"}, "field 'vndf' is missing"),
        (lambda fields: {k: v for k, v in fields.items() if k != "rgb"}, "field 'rgb' is missing"),
        (changed("rgb", lambda a: a * np.float32(np.nan)), "'rgb' holds NaN or infinity"),
        (changed("vndf", lambda a: -a), "'vndf' holds negative values"),
        (changed("vndf", lambda a: 0 * a), "'vndf' is zero everywhere for one of the incident directions"),
        (changed("sigma", lambda a: 0 * a), "'sigma' must be above zero"),
        (changed("ndf", lambda a: a[:1]), "'ndf' must be float32 n x n"),
        (changed("luminance", lambda a: a[..., :4]), "grids of different sizes"),
        (
            changed("luminance", lambda a: a.astype(np.float64)),
            "'luminance' must be float32 1 x 4 x n x n with n >= 2, got float64",
        ),
        (changed("rgb", lambda a: a[:, :, :2]), "'rgb' must be float32 1 x 4 x 3 x n x n"),
        (changed("theta_i", lambda a: a[::-1]), "'theta_i' must be a list of numbers that increase"),
    ],
)
def test_broken_fields(tmp_path, change, said):
    rgl.write_tensors(change(tensors()), tmp_path / "m.bsdf")
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.bsdf")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_odd_range_of_azimuths(tmp_path):
    rgl.write_tensors(tensors(azimuths=5, share=0.3), tmp_path / "m.bsdf")
    with pytest.raises(CorruptFileError, match="'phi_i' must span the whole circle, a half or a quarter"):
        io.read(tmp_path / "m.bsdf")
