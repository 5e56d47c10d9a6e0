"""How much is measured, and on what."""

from __future__ import annotations

from dataclasses import dataclass

from ..images import settings as images
from ..images.settings import FIT

__all__ = ["FIT", "FIXED", "SETTINGS", "Settings", "chosen"]

FIXED = (0.65, 0.2)
"""The alphas that serve most reflectances best."""


@dataclass(frozen=True)
class Settings:
    """The full run's values are the defaults."""

    materials: int | None = None
    """How many of the shipped materials; all of them."""
    budgets: tuple[int, ...] = (4, 16, 64, 256)
    """KB of the tables whose errors are measured."""
    pairs: int = 16384
    """Pairs of directions at which they are."""
    searched: int = 24
    """How many of the materials have the best table of 64 KB searched for."""
    files: int | None = None
    """How many of the measured files, where there are any; all of them."""
    converted: int = 16
    """N of the tables that are converted."""
    resolution: int = 64
    """N of the tables of figure 4; the paper's."""
    resolutions: tuple[int, ...] = (8, 16, 32, 64, 128)
    """N of figure 6."""
    azimuths: int = 24
    """N of the anisotropic tables of figure 5."""
    shown: int = 6
    """How many materials figure 4 shows."""
    frame: tuple[int, int] = (400, 300)
    """Pixels of the pictures of meshes."""
    samples: int = 32
    """Directions to the environment a pixel, of each of two kinds, in figures 4 and 5."""
    timed: tuple[int, int] = (640, 480)
    """Pixels of the frames of figure 6."""
    repeats: int = 5
    """Timed frames of which the fastest counts."""


SETTINGS = {
    "full": Settings(),
    "quick": Settings(
        materials=8, budgets=(16, 64), pairs=8192, searched=1, files=1, converted=8, resolution=32,
        resolutions=(8, 16, 32), azimuths=12, shown=2, frame=(240, 180), samples=16, timed=(240, 180), repeats=3,
    ),
}  # fmt: skip


def chosen(settings: Settings) -> list[str]:
    """The names of the materials that errors are measured on."""
    return images.chosen(images.Settings(materials=settings.materials))
