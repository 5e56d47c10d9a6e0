"""The shaders that a page has for files without one."""

from __future__ import annotations

import gzip
import json

import numpy as np

from brdf.representations.tables import merl
from brdf.representations.tables.table import Table
from brdf.shaders import shader_of, stages
from brdf.viewer.library import RESAMPLED, library


def test_templates_are_what_a_full_table_prints() -> None:
    rng = np.random.default_rng(1)
    for name, layout in {"merl": merl.LAYOUT, "table": RESAMPLED}.items():
        table = Table(layout, rng.random((*layout.shape, 3), np.float32))
        printed = shader_of(table, function="brdf_table")
        template = json.loads(json.dumps(library()[name]))
        assert template["text"] == stages.material(printed)
        (given,), (expected,) = template["shader"]["textures"], printed.description["textures"]
        assert given == {key: expected[key] for key in given}


def test_nodes_are_those_of_the_layout() -> None:
    for given, axis in zip(library()["table"]["nodes"], RESAMPLED.nodes(), strict=True):
        np.testing.assert_allclose(given, axis.ravel(), atol=1e-9)


def test_takes_little_of_a_page() -> None:
    assert len(gzip.compress(json.dumps(library(), separators=(",", ":")).encode())) < 4096
