"""One context of each kind a session, for all tests of shaders."""

from __future__ import annotations

import pytest

from cards import GLCard, WebCard


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
