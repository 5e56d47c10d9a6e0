"""Readers given files broken at random: one line, or a reflectance; never anything else. `tools/fuzz_readers.py` runs
ten thousand of them and measures time and memory."""

from __future__ import annotations

import numpy as np
import pytest
from tests.io.mutations import mutated, refused
from tests.io.samples import SAMPLES

COUNTS = {"UTIA": 60, "safetensors": 150}
MOST = 300


@pytest.mark.parametrize("name", SAMPLES)
def test_broken_files(name, tmp_path):
    extension, content = SAMPLES[name]
    data, rng = content(), np.random.default_rng(len(name))
    path = tmp_path / f"m{extension}"
    messages = []
    for _ in range(COUNTS.get(name, MOST)):
        path.write_bytes(mutated(data, rng))
        messages.append(refused(name, path))
    said = [message for message in messages if message is not None]
    assert len(said) > 0.2 * len(messages)
    assert all("\n" not in message and message.startswith(str(tmp_path)) for message in said)
