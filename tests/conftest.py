"""Fixtures shared by all tests."""

from __future__ import annotations

import os
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest

from cards import GLCard, WebCard


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of reference measurements, named by BRDF_DATA; without it the test is skipped."""
    folder = os.environ.get("BRDF_DATA")
    if not folder:
        pytest.skip("BRDF_DATA does not name a folder of reference measurements")
    path = Path(folder)
    assert path.is_dir(), f"BRDF_DATA={folder} is not a folder"
    return path


@pytest.fixture(scope="session")
def gl() -> GLCard:
    """OpenGL; without a driver (Debian: libegl1 libgl1-mesa-dri libgl1) the test is skipped."""
    pytest.importorskip("moderngl")
    try:
        return GLCard()
    except Exception as error:  # moderngl raises plain exceptions
        pytest.skip(f"no OpenGL: {error}; Debian has a software driver in libegl1 libgl1-mesa-dri libgl1")


@pytest.fixture(scope="session")
def web() -> WebCard:
    """WebGPU; without a driver the test is skipped."""
    pytest.importorskip("wgpu")
    try:
        return WebCard()
    except RuntimeError as error:
        pytest.skip(f"no WebGPU: {error}; Debian has a software driver in libegl1 libgl1-mesa-dri libgl1")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, Any, Any]:
    """With BRDF_NO_SKIPS=1 a skipped test is a failure."""
    return _without_skips((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report() -> Generator[None, Any, Any]:
    """With BRDF_NO_SKIPS=1 a skipped module is a failure."""
    return _without_skips((yield))


TOO_LARGE = ("torch",)
"""Peers whose tests may be skipped even so: what PyPI gives for Linux is several gigabytes."""


def _without_skips(report: Any) -> Any:
    if report.skipped and not hasattr(report, "wasxfail") and os.environ.get("BRDF_NO_SKIPS") == "1":
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
        if not any(peer in reason for peer in TOO_LARGE):
            report.outcome, report.longrepr = "failed", f"{reason} (BRDF_NO_SKIPS=1 makes this a failure)"
    return report
