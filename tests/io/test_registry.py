"""Formats are recognised by content; every mistake is one line that says what to do."""

from __future__ import annotations

import os

import numpy as np
import pytest

import brdf
from brdf import io
from brdf.errors import CorruptFileError, FileError, UnknownFormatError


def test_formats_are_listed():
    listed = {f.name: f for f in io.formats()}
    assert {"MERL", "RGL", "goniometer text", "safetensors"} <= set(listed)
    assert listed["MERL"][1:4] == ((".binary",), True, True)
    assert not listed["goniometer text"].writes
    assert all("\n" not in f.doc and f.doc for f in listed.values())


def test_own_file_is_recognised_whatever_its_name(tmp_path):
    model = brdf.models.GGX(alpha=0.3)
    io.write(model, tmp_path / "m.safetensors")
    (tmp_path / "m.safetensors").rename(tmp_path / "m.binary")
    read = io.read(tmp_path / "m.binary")
    assert type(read) is type(model)
    assert read.alpha == 0.3


def test_missing_file(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        io.read(tmp_path / "nothing.binary")


def test_folder(tmp_path):
    with pytest.raises(FileError, match="is a folder"):
        io.read(tmp_path)


def test_device():
    with pytest.raises(FileError, match="not a regular file"):
        io.read(os.devnull)


def test_empty_file(tmp_path):
    (tmp_path / "m.bsdf").touch()
    with pytest.raises(CorruptFileError, match="is empty"):
        io.read(tmp_path / "m.bsdf")


@pytest.mark.parametrize("name", ["m.bsdf", "m.brdf", "m.txt", "m"])
def test_unknown_content_lists_what_is_read(tmp_path, name):
    (tmp_path / name).write_text("made up\n::begin parameters\n")
    with pytest.raises(UnknownFormatError, match=r"no known format; read: .*MERL.*RGL.*safetensors") as caught:
        io.read(tmp_path / name)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("name", "given"), [("m.xyz", "'.xyz'"), ("m", "no extension"), ("m.brdf", "'.brdf'")])
def test_unknown_extension_lists_what_is_written(tmp_path, name, given):
    with pytest.raises(UnknownFormatError, match=rf"{given}.*written: .*\.binary \(MERL\)"):
        io.write(brdf.models.Lambertian(), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_folder_that_does_not_exist(tmp_path):
    with pytest.raises(FileError, match="cannot be written"):
        io.write(brdf.models.Lambertian(), tmp_path / "no" / "m.safetensors")


@pytest.mark.parametrize("kept", [9, 40, 0.5, 0.99])
def test_truncated_own_file(tmp_path, kept):
    path = tmp_path / "m.safetensors"
    io.write(brdf.models.GGX(), path)
    data = path.read_bytes()
    path.write_bytes(data[: kept if kept > 1 else int(kept * len(data))])
    with pytest.raises(CorruptFileError, match="safetensors"):
        io.read(path)


def test_random_bytes_never_give_a_traceback(tmp_path):
    rng = np.random.default_rng(3)
    starts = [
        b"",
        b"tensor_file\0\1\0",
        np.array([90, 90, 180], "<i4").tobytes(),
        b"# x\n31\n",
        b"\x10" + b"\0" * 7 + b"{",
    ]
    for index, start in enumerate(starts * 20):
        path = tmp_path / f"{index}{('.bsdf', '.binary', '.brdf', '.safetensors', '')[index % 5]}"
        path.write_bytes(start + rng.integers(0, 256, rng.integers(1, 300), np.uint8).tobytes())
        with pytest.raises(FileError) as caught:
            io.read(path)
        assert "\n" not in str(caught.value)


def test_own_file_with_a_choice_that_does_not_exist(tmp_path):
    path = tmp_path / "m.safetensors"
    io.write(brdf.models.Microfacet(masking="smith"), path)
    path.write_bytes(path.read_bytes().replace(b"smith", b"skith"))
    with pytest.raises(CorruptFileError, match=r"does not describe a reflectance \(unknown masking 'skith'"):
        io.read(path)
