"""Reading photographs: depth, channels, responses, folders, broken files."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from brdf.capture import png
from brdf.capture.photographs import natural, pictures_in, read_photograph, response_of
from brdf.color import srgb_decode
from brdf.errors import CorruptFileError, FileError, ParameterError, UnknownFormatError

DEEP = np.random.default_rng(1).integers(0, 65536, (7, 5, 3)).astype(np.uint16)


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def deep_png(pixels: np.ndarray, filters: list[int] | None = None) -> bytes:
    """A PNG of 16 bits; rows filtered by the definitions of the specification, written with NumPy."""
    height, width, channels = pixels.shape
    rows = pixels.astype(">u2").view(np.uint8).reshape(height, -1).astype(int)
    step, body = 2 * channels, b""
    for i, row in enumerate(rows):
        kind = 0 if filters is None else filters[i % len(filters)]
        up = rows[i - 1] if i else 0 * row
        left, corner = (np.concatenate([np.zeros(step, int), r[:-step]]) for r in (row, up))
        near = np.stack([left, up, corner])
        paeth = np.take_along_axis(near, np.abs(left + up - corner - near).argmin(0)[None], 0)[0]
        guess = [0 * row, left, up, (left + up) // 2, paeth][kind]
        body += bytes([kind]) + ((row - guess) % 256).astype(np.uint8).tobytes()
    header = struct.pack(">IIBBBBB", width, height, 16, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    packed = zlib.compress(body)
    parts = chunk(b"IDAT", packed[:20]) + chunk(b"IDAT", packed[20:])
    return png.SIGNATURE + chunk(b"IHDR", header) + parts + chunk(b"IEND", b"")


@pytest.mark.parametrize("filters", [[0], [1], [2], [3], [4], [4, 3, 2, 1, 0]])
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_every_bit_of_a_deep_png_arrives(tmp_path: Path, filters: list[int], channels: int) -> None:
    pixels = np.random.default_rng(channels).integers(0, 65536, (7, 5, channels)).astype(np.uint16)
    (tmp_path / "a.png").write_bytes(deep_png(pixels, filters))
    with Image.open(tmp_path / "a.png") as picture:  # the file itself is well formed
        picture.load()
    read = read_photograph(tmp_path / "a.png")
    assert read.deep
    expected = pixels[..., :3] if channels > 1 else np.repeat(pixels, 3, -1)
    np.testing.assert_array_equal(np.rint(read.pixels * 65535), expected)


def test_a_real_deep_png_has_pillows_upper_bytes(data: Path) -> None:
    path = data / "spheres" / "diligent_ball" / "001.png"
    with Image.open(path) as picture:
        np.testing.assert_array_equal(png.read_deep(path) >> 8, np.asarray(picture))


def test_tiff_and_exr_keep_their_depth(tmp_path: Path) -> None:
    import OpenEXR
    import tifffile

    tifffile.imwrite(tmp_path / "a.tif", DEEP, photometric="rgb")
    tifffile.imwrite(tmp_path / "planes.tif", np.moveaxis(DEEP, -1, 0), photometric="rgb", planarconfig="separate")
    for name in ("a.tif", "planes.tif"):
        np.testing.assert_array_equal(np.rint(read_photograph(tmp_path / name).pixels * 65535), DEEP)
    light = DEEP.astype(np.float32) / 1000
    OpenEXR.File({"type": OpenEXR.scanlineimage}, {"RGB": light}).write(str(tmp_path / "a.exr"))
    read = read_photograph(tmp_path / "a.exr")
    np.testing.assert_array_equal(read.pixels, light)
    assert not read.saturated().any()


def test_eight_bits_and_saturation(tmp_path: Path) -> None:
    pixels = np.array([[[0, 128, 255], [10, 20, 30]]], np.uint8)
    for name in ("a.png", "a.tga", "a.tif", "a.bmp", "a.ppm"):
        Image.fromarray(pixels).save(tmp_path / name)
        read = read_photograph(tmp_path / name)
        assert not read.deep
        np.testing.assert_allclose(read.pixels * 255, pixels, atol=1e-4)
        np.testing.assert_array_equal(read.saturated(), [[True, False]])


def test_responses() -> None:
    codes = np.linspace(0, 1, 11)
    np.testing.assert_array_equal(response_of(None, deep=True).linear(codes), codes)
    np.testing.assert_allclose(response_of(None, deep=False).linear(codes), srgb_decode(codes))
    np.testing.assert_allclose(response_of("2.2", deep=False).linear(codes), codes**2.2, rtol=1e-6)
    for wrong in ("log", "0", "-1", "nan"):
        with pytest.raises(ParameterError, match="linear, srgb, or a gamma"):
            response_of(wrong, deep=False)


def test_order_of_a_folder(tmp_path: Path) -> None:
    for name in ("b10.png", "b2.png", "the_mask.png", "dark.png", "b1.png", "lights.txt"):
        (tmp_path / name).write_bytes(b"x")
    photographs, masks = pictures_in(tmp_path)
    assert [p.name for p in photographs] == ["b1.png", "b2.png", "b10.png"]
    assert [p.name for p in masks] == ["the_mask.png"]
    (tmp_path / "filenames.txt").write_text("b10.png\nb1.png\n")
    assert [p.name for p in pictures_in(tmp_path)[0]] == ["b10.png", "b1.png"]
    (tmp_path / "filenames.txt").write_text("b10.png\nb7.png\n")
    with pytest.raises(FileError, match=r"names b7\.png, which is not in the folder"):
        pictures_in(tmp_path)
    assert sorted(["9", "10", "a"], key=natural) == ["9", "10", "a"]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "is empty"),
        (deep_png(DEEP)[:60], "more than the file can hold|ends in the middle|cannot be unpacked"),
        (deep_png(DEEP)[:90], "ends in the middle|cannot be unpacked"),
        (
            deep_png(DEEP)[:16] + struct.pack(">II", 1 << 30, 1 << 30) + deep_png(DEEP)[24:],
            "more than the file can hold",
        ),
        (b"\x89PNG\r\n\x1a\n not really", "cannot be read as a picture"),
        (b"nothing", "cannot be read as a picture"),
    ],
)
def test_broken_files_are_named(tmp_path: Path, content: bytes, said: str) -> None:
    (tmp_path / "broken.png").write_bytes(content)
    with pytest.raises(CorruptFileError, match=rf"broken\.png: .*({said})"):
        read_photograph(tmp_path / "broken.png")


def test_what_is_no_picture_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("x")
    with pytest.raises(UnknownFormatError, match="no picture by its extension"):
        read_photograph(tmp_path / "a.txt")
    with pytest.raises(FileError, match="no such file"):
        read_photograph(tmp_path / "b.png")
