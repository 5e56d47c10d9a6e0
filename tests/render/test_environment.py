"""Environments: orientation, sampling, files."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.errors import CorruptFileError, FileError, SceneError, UnknownNameError
from brdf.render.environment import Environment, load, reduced
from brdf.render.image import Image


def spot(row, column, height=32):
    pixels = np.full((height, 2 * height, 3), 1e-3)
    pixels[row, column] = 100
    return Environment(pixels)


@pytest.mark.parametrize(
    ("row", "column", "direction"),
    [(16, 32, (0, 0, -1)), (16, 48, (1, 0, 0)), (16, 16, (-1, 0, 0)), (16, 0, (0, 0, 1)), (0, 5, (0, 1, 0)),
     (31, 5, (0, -1, 0))],
)  # fmt: skip
def test_orientation(row, column, direction):
    """The middle column is -z, three quarters +x, the outer ones +z; row 0 is up."""
    environment = spot(row, column)
    drawn, radiance, _ = environment.sample(np.random.default_rng(0).random((2000, 2), np.float32))
    mean = (drawn * radiance.sum(-1, keepdims=True)).sum(0)
    mean /= np.linalg.norm(mean)
    assert mean @ direction > np.cos(np.radians(6))
    assert np.argmax([environment.irradiance(axis)[0] for axis in (direction, np.negative(direction))]) == 0


def test_rotation_carries_light_from_plus_z_to_plus_x():
    pixels = spot(16, 0).pixels
    turned = Environment(pixels, rotation=90)
    assert turned.irradiance((1, 0, 0))[0] == pytest.approx(Environment(pixels).irradiance((0, 0, 1))[0], rel=1e-4)
    assert turned.blurred().irradiance((1, 0, 0))[0] > 10 * turned.blurred().irradiance((-1, 0, 0))[0]


def test_density_is_the_share_of_samples_and_integrates_to_one():
    rng = np.random.default_rng(1)
    environment = Environment(rng.random((8, 16, 3)) ** 4)
    drawn, radiance, density = environment.sample(rng.random((200_000, 2), np.float32))
    np.testing.assert_allclose(np.linalg.norm(drawn, axis=-1), 1, atol=1e-5)
    uniform = rng.normal(size=(200_000, 3))
    uniform = (uniform / np.linalg.norm(uniform, axis=-1, keepdims=True)).astype(np.float32)
    radiance_uniform, density_uniform = environment.radiance(uniform)
    assert density_uniform.mean() * 4 * np.pi == pytest.approx(1, abs=0.01)
    np.testing.assert_allclose((radiance / density[:, None]).mean(0), radiance_uniform.mean(0) * 4 * np.pi, rtol=0.02)
    for axis in range(3):  # first moments: the samples really lie where the density says
        assert drawn[:, axis].mean() == pytest.approx((uniform[:, axis] * density_uniform).mean() * 4 * np.pi, abs=0.01)


def test_irradiance_of_a_constant():
    np.testing.assert_allclose(load(2.0).irradiance((0.6, 0.0, 0.8)), 2 * np.pi, rtol=5e-3)


def test_reduction_keeps_the_light():
    pixels = np.random.default_rng(2).random((64, 128, 3)).astype(np.float32)
    before, after = (Environment(p).irradiance((0, 1, 0)) for p in (pixels, reduced(pixels, 4)))
    np.testing.assert_allclose(before, after, rtol=5e-3)


def test_studio_is_shipped_and_neutral():
    studio = load("studio")
    assert studio.pixels.shape == (64, 128, 3)
    assert studio.pixels.max() < 100


@pytest.mark.parametrize("name", ["venice_sunset_1k", "quarry_01_1k", "pedestrian_overpass_1k"])
def test_radiance_files_are_read(data, name):
    """Sizes and brightest values as another reader found them (the last one rounded to five digits)."""
    brightest = {"venice_sunset_1k": 6496, "quarry_01_1k": 86528, "pedestrian_overpass_1k": 118270}
    pixels = load(data / "env" / f"{name}.hdr").pixels
    assert pixels.shape == (512, 1024, 3)
    assert pixels.max() == pytest.approx(brightest[name], rel=2e-5)


def coded_hdr(rgbe):
    """A run-length coded Radiance file, written here without the package."""
    height, width = rgbe.shape[:2]
    body = bytearray()
    for row in rgbe:
        body += bytes([2, 2, width >> 8, width & 255])
        for channel in row.T:
            at = 0
            while at < width:
                run = 1
                while at + run < width and run < 127 and channel[at + run] == channel[at]:
                    run += 1
                body += bytes([128 + run, channel[at]]) if run > 2 else bytes([1, channel[at]])
                at += run if run > 2 else 1
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + bytes(body)


def test_run_lengths_decode_to_what_was_coded(tmp_path):
    rgbe = np.random.default_rng(5).integers(1, 255, (6, 40, 4), np.uint8)
    rgbe[2:4, 5:30] = (10, 20, 30, 130)
    rgbe[5, :, 3] = 0
    path = tmp_path / "a.hdr"
    path.write_bytes(coded_hdr(rgbe))
    from brdf.render import radiance_file

    expected = np.where(rgbe[..., 3:] > 0, rgbe[..., :3] * 2.0 ** (rgbe[..., 3:].astype(int) - 136), 0)
    np.testing.assert_allclose(radiance_file.read(path), expected, rtol=1e-6)
    whole = path.read_bytes()
    for cut in range(0, len(whole), 7):
        path.write_bytes(whole[:cut])
        with pytest.raises(CorruptFileError):
            radiance_file.read(path)
    path.write_bytes(whole.replace(b"-Y 6 +X 40", b"-Y 60000 +X 40000"))
    with pytest.raises(CorruptFileError, match="more than the file can hold"):
        radiance_file.read(path)


def test_exr_is_read(tmp_path):
    pixels = np.random.default_rng(6).random((8, 16, 3)).astype(np.float32)
    Image(pixels).save(tmp_path / "a.exr")
    np.testing.assert_array_equal(load(tmp_path / "a.exr").pixels, pixels)


def test_eight_bit_pictures_are_refused(tmp_path):
    Image(np.ones((4, 8, 3))).save(tmp_path / "a.png")
    with pytest.raises(FileError, match=r"a\.png: is an 8-bit picture"):
        load(tmp_path / "a.png")


@pytest.mark.parametrize(
    ("pixels", "words"),
    [
        (np.full((4, 8, 3), np.nan), "not finite"),
        (np.full((4, 8, 3), -1.0), "below zero"),
        (np.zeros((4, 8, 3)), "all black"),
        (np.ones((4, 8)), "shape"),
    ],
)
def test_what_is_no_light_is_refused(pixels, words):
    with pytest.raises(SceneError, match=words):
        Environment(pixels)


def test_missing_files_and_names(tmp_path):
    with pytest.raises(UnknownNameError, match="did you mean 'studio'"):
        load("studo")
    with pytest.raises(FileError, match="no such file"):
        load(tmp_path / "none.hdr")
    (tmp_path / "text.hdr").write_text("hello")
    with pytest.raises(CorruptFileError, match="neither"):
        load(tmp_path / "text.hdr")
    (tmp_path / "broken.exr").write_bytes(b"\x76\x2f\x31\x01rubbish")
    with pytest.raises(CorruptFileError, match="cannot be read as OpenEXR"):
        load(tmp_path / "broken.exr")
