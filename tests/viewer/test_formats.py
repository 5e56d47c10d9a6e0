"""The page's readers of measurements: what Python reads from the same files."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brdf
from brdf import io
from brdf.geometry.directions import from_spherical
from brdf.io import rgl
from brdf.metrics import psnr
from brdf.representations.baking.bake import bake_points
from brdf.representations.tables.table import Table
from brdf.viewer.library import RESAMPLED, library
from javascript import node
from representations.synthetic_rgl import tensors

OPEN = """
import { readFileSync, writeFileSync } from "node:fs";
import { materialOf } from "WEB/formats/open.js";
const [library, ...files] = process.argv.slice(2);
const known = JSON.parse(readFileSync(library));
const found = {};
for (const path of files) {
    const file = new File([readFileSync(path)], path.split("/").pop());
    try {
        const { texels, mask, ...rest } = await materialOf(file, known);
        writeFileSync(path + ".texels", new Uint8Array(texels));
        if (mask) writeFileSync(path + ".mask", mask);
        found[file.name] = rest;
    } catch (error) {
        found[file.name] = { error: error.message };
    }
}
console.log(JSON.stringify(found));
"""

EVALUATE = """
import { readFileSync } from "node:fs";
import { Adaptive } from "WEB/formats/adaptive.js";
import { tensorsOf } from "WEB/formats/tensors.js";
const found = {};
for (const [path, pairs] of Object.entries(JSON.parse(readFileSync(process.argv[2])))) {
    const measured = new Adaptive(tensorsOf(new Uint8Array(readFileSync(path)).buffer, path));
    const values = new Float64Array(3);
    found[path] = pairs.map(([wi, wo]) => (measured.evaluate(...wi, ...wo, values), Array.from(values)));
}
console.log(JSON.stringify(found));
"""


def opened(folder: Path, *files: Path) -> dict[str, Any]:
    """What the page makes of files, by name."""
    (folder / "library.json").write_text(json.dumps(library()))
    return node(OPEN, folder / "library.json", *files, folder=folder)


def evaluated(folder: Path, pairs: dict[Path, Any]) -> dict[Path, np.ndarray[Any, Any]]:
    """f of the page's reader at (N, 2, 3) pairs of directions."""
    given = {str(path): np.asarray(each).tolist() for path, each in pairs.items()}
    (folder / "pairs.json").write_text(json.dumps(given))
    found = node(EVALUATE, folder / "pairs.json", folder=folder)
    return {Path(path): np.array(values) for path, values in found.items()}


# ---- RGL -------------------------------------------------------------------------------------------------------


def test_published_files_agree_with_mitsuba(data: Path, tmp_path: Path) -> None:
    """As Python's own test does, on the same rows; what is left is the rounding of the rows' angles."""
    with (data / "rgl" / "rgl_reference_eval.csv").open() as file:
        rows: dict[Path, list[list[float]]] = {}
        for row in csv.DictReader(file):
            path = data / "rgl" / row["file"]
            rows.setdefault(path, []).append([float(v) for k, v in row.items() if k != "file"])
    assert len(rows) == 10
    tables = {path: np.array(numbers) for path, numbers in rows.items()}
    pairs = {}
    for path, table in tables.items():
        angles = np.radians(table[:, :4])
        pairs[path] = np.stack([from_spherical(angles[:, k], angles[:, k + 1]) for k in (0, 2)], 1)
    found = evaluated(tmp_path, pairs)
    errors = []
    for path, table in tables.items():
        errors.append(np.abs(found[path] - table[:, 4:]).max(1) / np.abs(table[:, 4:]).max(1))
        expected = io.read(path).raw(pairs[path][:, 0], pairs[path][:, 1])
        np.testing.assert_allclose(found[path], expected, rtol=1e-6, atol=1e-9)
    assert np.median(np.concatenate(errors)) < 1e-5
    assert np.quantile(np.concatenate(errors), 0.99) < 1e-4


@pytest.mark.parametrize(("azimuths", "share"), [(1, 1.0), (2, 1.0), (9, 1.0), (6, 0.5), (5, 0.25)])
def test_every_kind_of_incident_azimuths_agrees_with_python(tmp_path: Path, azimuths: int, share: float) -> None:
    path = tmp_path / "m.bsdf"
    rgl.write_tensors(tensors(azimuths, share), path)
    rng = np.random.default_rng(2)
    theta, phi = np.arccos(rng.uniform(-0.2, 1, (300, 2))), rng.uniform(-np.pi, np.pi, (300, 2))
    pairs = from_spherical(theta, phi)
    m = io.read(path)
    expected = m.raw(pairs[:, 0], pairs[:, 1])
    assert (expected == 0).any()
    assert (expected > 0).any()
    np.testing.assert_allclose(evaluated(tmp_path, {path: pairs})[path], expected, rtol=1e-6, atol=1e-9)


def test_a_measurement_becomes_the_table_that_python_bakes(data: Path, tmp_path: Path) -> None:
    path = tmp_path / "measured.bsdf"
    path.write_bytes((data / "rgl" / "chm_orange_rgb.bsdf").read_bytes())
    m = io.read(path)
    found = opened(tmp_path, path)["measured.bsdf"]
    assert found["shader"]["name"] == "measured"
    assert found["kind"] == "Adaptive"
    texels = np.fromfile(f"{path}.texels", np.float32).reshape(*RESAMPLED.shape, 4)
    expected = bake_points(m, RESAMPLED)
    # in the plane of incidence rounding decides between the two ends of the grids, which differ in measured data
    assert np.quantile(np.abs(texels[..., :3] - expected.codes), 0.998) < 1e-4
    assert (texels[..., 3] == 1).all()
    shown = Table(RESAMPLED, np.ascontiguousarray(texels[..., :3]))
    assert psnr(expected, shown, 64) > 70
    assert psnr(m, shown, 64) > 39


# ---- MERL ------------------------------------------------------------------------------------------------------


def write_merl(path: Path, values: np.ndarray[Any, Any]) -> None:
    """(90, 90, 180, 3) stored values."""
    path.write_bytes(np.array([90, 90, 180], "<i4").tobytes() + np.moveaxis(values, -1, 0).astype("<f8").tobytes())


def test_merl_bins_become_the_texels_of_python(tmp_path: Path) -> None:
    rng = np.random.default_rng(4)
    values = rng.lognormal(3, 2, (90, 90, 180, 3))
    values[rng.random(values.shape[:3]) < 0.2] = -1
    values[3, :20, 7] = -1  # nothing of smaller theta_d
    values[5, :, 100:110] = values[5, :, :3] = -1  # whole columns
    values[40] = values[88:] = -1  # whole rows
    values[50, 2, 2, 1] = -0.3
    path = tmp_path / "made.binary"
    write_merl(path, values)
    m = io.read(path)
    found = opened(tmp_path, path)["made.binary"]
    assert found["nbytes"] == m.nbytes
    assert found["mask_shape"] == list(m.measured.shape)
    texels = np.fromfile(f"{path}.texels", np.float32).reshape(*m.layout.shape, 4)
    np.testing.assert_array_equal(texels[..., :3], m.codes)
    assert (texels[..., 3] == 1).all()
    bits = np.unpackbits(np.fromfile(f"{path}.mask", np.uint8), count=m.measured.size, bitorder="little")
    np.testing.assert_array_equal(bits.reshape(m.measured.shape), m.measured)


# ---- what is wrong ---------------------------------------------------------------------------------------------


def contents(fields: int, *entries: bytes) -> bytes:
    return rgl.SIGNATURE + bytes([1, 0]) + fields.to_bytes(4, "little") + b"".join(entries)


def entry(name: str, kind: int, offset: int, *shape: int) -> bytes:
    head = len(name).to_bytes(2, "little") + name.encode() + len(shape).to_bytes(2, "little") + bytes([kind])
    return head + offset.to_bytes(8, "little") + b"".join(n.to_bytes(8, "little") for n in shape)


def test_broken_files_are_refused_in_a_sentence(tmp_path: Path) -> None:
    whole = tmp_path / "whole.bsdf"
    rgl.write_tensors(tensors(), whole)
    changed = {
        "missing.bsdf": {"ndf": None},
        "dark.bsdf": {"sigma": np.zeros((10, 20), np.float32)},
        "nan.bsdf": {"rgb": np.full((1, 4, 3, 9, 9), np.nan, np.float32)},
        "order.bsdf": {"theta_i": np.array([0.0, 0.9, 0.4, 1.4], np.float32)},
        "type.bsdf": {"vndf": np.ones((1, 4, 8, 8))},
        "empty.bsdf": {"vndf": np.zeros((1, 4, 8, 8), np.float32)},
    }
    for name, fields in changed.items():
        given = {k: v for k, v in (tensors() | fields).items() if v is not None}
        rgl.write_tensors(given, tmp_path / name)
    rgl.write_tensors(tensors(wavelengths=5), tmp_path / "spectral.bsdf")
    rgl.write_tensors(tensors(9), tmp_path / "anisotropic.bsdf")
    dimensions = {name: np.array(bins, "<i4").tobytes() for name, bins in
                  {"merl": (90, 90, 180), "other": (90, 90, 360), "huge": (2**30, 2**30, 2**30)}.items()}  # fmt: skip
    for name, data in {
        "nothing.bsdf": b"",
        "cut.bsdf": whole.read_bytes()[:-8],
        "short.bsdf": whole.read_bytes()[:40],
        "version.bsdf": rgl.SIGNATURE + bytes([2, 0, 0, 0, 0, 0]),
        "magic.bsdf": b"x" * 64,
        "fields.bsdf": contents(1 << 31),
        "type code.bsdf": contents(1, entry("a", 99, 0, 1)),
        "axes.bsdf": contents(1, entry("a", 10, 0, *[1] * 9)),
        "claims.bsdf": contents(1, entry("a", 10, 64, 1 << 29), bytes(64)),
        "overflow.bsdf": contents(1, entry("a", 10, 64, 1 << 33, 1 << 33), bytes(64)),
        "cut.binary": dimensions["merl"] + bytes(800),
        "other.binary": dimensions["other"] + bytes(800),
        "huge.binary": dimensions["huge"] + bytes(800),
        "picture.png": b"\x89PNG\r\n\x1a\n" + bytes(40),
        "letter.safetensors": b"Dear reader, this is no material.",
    }.items():
        (tmp_path / name).write_bytes(data)
    values = np.full((90, 90, 180, 3), -1.0)
    write_merl(tmp_path / "holes.binary", values)
    values[0, 0, 0, 1] = np.inf
    write_merl(tmp_path / "infinite.binary", values)
    write_merl(tmp_path / "large.binary", np.full((90, 90, 180, 3), 1e300))
    expected = {
        "missing.bsdf": "field 'ndf' is missing",
        "dark.bsdf": "field 'sigma' must be above zero everywhere",
        "nan.bsdf": "field 'rgb' holds NaN or infinity",
        "order.bsdf": "field 'theta_i' must be a list of numbers that increase",
        "type.bsdf": "field 'vndf' must be float32 1 x 4 x n x n with n >= 2, got another type 1 x 4 x 8 x 8",
        "empty.bsdf": "field 'vndf' is zero everywhere for one of the incident directions",
        "spectral.bsdf": "it holds spectra, which only Python makes colours of: brdf export FILE page.html",
        "anisotropic.bsdf": "it is anisotropic, which only Python bakes: brdf export FILE page.html",
        "nothing.bsdf": "has 0 bytes, too few for any material.",
        "cut.bsdf": "; fetch it again.",
        "short.bsdf": "its table of contents ends at byte 40; fetch it again.",
        "version.bsdf": "is not a tensor file of version 1.0.",
        "magic.bsdf": "is not a tensor file of version 1.0.",
        "fields.bsdf": "claims 2147483648 fields; at most 64 are read.",
        "type code.bsdf": "its field 'a' is of the unknown type 99.",
        "axes.bsdf": "its field 'a' claims 9 axes; at most 8 are read.",
        "claims.bsdf": "its field 'a' claims bytes 64 to 2147483712 of a file of ",
        "overflow.bsdf": "its field 'a' claims bytes 64 to ",
        "cut.binary": "expected 34992012 bytes, found 812: it is truncated; fetch it again.",
        "other.binary": "its MERL header says 90 x 90 x 360 bins; only 90 x 90 x 180 is read.",
        "huge.binary": "its MERL header says 1073741824 x 1073741824 x 1073741824 bins; only",
        "holes.binary": "holds no measured bin; fetch it again.",
        "infinite.binary": "its green plane holds NaN or infinity; fetch it again.",
        "large.binary": "its red plane holds NaN or infinity; fetch it again.",
        "picture.png": "is no MERL .binary, no RGL .bsdf and no .safetensors; these are read.",
        "letter.safetensors": "it is truncated, or no safetensors file.",
    }
    found = opened(tmp_path, *(tmp_path / name for name in expected))
    for name, text in expected.items():
        assert text in found[name].get("error", ""), (name, found[name])
        assert "\n" not in found[name]["error"]
        assert name in found[name]["error"]


def test_a_file_larger_than_a_page_holds_is_not_read(tmp_path: Path) -> None:
    script = """
    import { materialOf } from "WEB/formats/open.js";
    const never = () => { throw new Error("read"); };
    const file = { name: "upload.bsdf", size: 2 ** 31, slice: never, arrayBuffer: never };
    const error = await materialOf(file, {}).catch((error) => error.message);
    console.log(JSON.stringify({ error }));
    """
    expected = "upload.bsdf has 2147483648 bytes; a page reads files of 268435456 at most."
    assert node(script, folder=tmp_path)["error"] == expected


def test_a_saved_file_is_recognised(tmp_path: Path) -> None:
    brdf.models.GGX(alpha=0.3).named("shiny").save(tmp_path / "m")
    assert opened(tmp_path, tmp_path / "m")["m"]["shader"]["name"] == "shiny"
