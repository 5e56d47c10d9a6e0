"""Fixtures shared by all tests."""

from __future__ import annotations

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of reference measurements, named by BRDF_DATA; without it the test is skipped."""
    folder = os.environ.get("BRDF_DATA")
    if not folder:
        pytest.skip("BRDF_DATA does not name a folder of reference measurements")
    path = Path(folder)
    assert path.is_dir(), f"BRDF_DATA={folder} is not a folder"
    return path
