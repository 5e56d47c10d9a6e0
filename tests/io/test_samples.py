"""Every reader reads its sample, by content; truncated and torn samples are one line."""

from __future__ import annotations

import numpy as np
import pytest
from tests.io.samples import SAMPLES

from brdf import io
from brdf.errors import FileError

UNSAMPLED = {"MERL", "sphere images"}
"""MERL has a size of 35 MB and tests of its own; a folder of pictures is no file."""


MAY_END_ANYWHERE = {"ALTA text", "ASTM E1392 text", "BSDF benchmark fits", "Disney BRDF Explorer", "goniometer text"}
"""Formats whose files do not say how long they are."""


def test_every_reader_has_a_sample():
    assert {f.name for f in io.formats() if f.reads} - UNSAMPLED == set(SAMPLES)


@pytest.mark.parametrize("name", SAMPLES)
def test_sample_is_recognised_without_its_extension_and_read(name, tmp_path):
    path = tmp_path / "sample"
    path.write_bytes(SAMPLES[name][1]())
    assert io.registry.format_of(path).name == name
    members = io.members(path)
    m = io.read(path, members[0] if members else None)
    io.write(m, tmp_path / "kept.safetensors")
    kept = io.read(tmp_path / "kept.safetensors")
    values = m([[0, 0, 1.0], [0, 0.6, 0.8]], [[0.6, 0, 0.8], [0.1, -0.6, np.sqrt(0.63)]])
    assert np.isfinite(values).all()
    assert values.max() > 0
    np.testing.assert_array_equal(kept([0, 0.6, 0.8], [0.6, 0, 0.8]), m([0, 0.6, 0.8], [0.6, 0, 0.8]))


@pytest.mark.parametrize("kept", [1, 40, 0.5, 0.97])
@pytest.mark.parametrize("name", SAMPLES)
def test_torn_sample(name, kept, tmp_path):
    """Read by its extension, a torn file is refused in one line, or it is whole up to the tear."""
    extension, content = SAMPLES[name]
    data = content()
    path = tmp_path / f"torn{extension}"
    path.write_bytes(data[: kept if kept >= 1 else int(kept * len(data))])
    problem = _problem(path)
    if problem is None:
        assert name in MAY_END_ANYWHERE
    else:
        assert "\n" not in problem
        assert problem.startswith(str(path))


def _problem(path):
    try:
        members = io.members(path)
        io.read(path, members[-1] if members else None)
    except FileError as error:
        return str(error)
    return None
