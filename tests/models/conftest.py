"""Mitsuba, the peer that several files compare with."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest


@pytest.fixture(scope="module")
def mi() -> Iterator[Any]:
    """Mitsuba in its scalar variant; the variant before is set again afterwards."""
    mitsuba = pytest.importorskip("mitsuba")
    before = mitsuba.variant()
    mitsuba.set_variant("scalar_rgb")
    yield mitsuba
    if before is not None:
        mitsuba.set_variant(before)
