"""How much is measured, and on what."""

from __future__ import annotations

from dataclasses import dataclass

from .... import materials
from ....metrics import SPHERE_SIZE

FIT = "bagher_sgd"
"""The published fits that have all 100 materials."""

PLASTIC = (0.0, 45.0, 90.0, 135.0)
METAL = (0.0, 30.0, 60.0, 90.0, 120.0, 150.0)
"""The paper's angles of the light [degrees]; the pictures N = 4 and N = 6 of the sweep over i 180/N."""

COUNTS = (2, 3, 4, 6, 8, 12, 16)
"""Numbers of pictures."""

ALWAYS = ("yellow-plastic", "color-changing-paint1", "red-specular-plastic", "alum-bronze")
"""Materials of every run: the paper's claims are on plastics, and on metals and shifting colours."""

VISIBLE = 40.0
"""dB: an RMS error of 1 % of full scale, 2.5 of 255 levels, at which pictures side by side look alike."""


@dataclass(frozen=True)
class Settings:
    """The full run's values are the defaults."""

    materials: int | None = None
    """How many of the shipped materials, spread over the alphabet; all of them."""
    sphere: int = SPHERE_SIZE
    """Pixels across the sphere on which errors are measured."""
    texture: int = 256
    """Texels across the pictures of the sweep over their number."""
    largest: int = 512
    """Texels across the pictures of the paper's own size."""
    budgets: tuple[int, ...] = (4, 16, 64, 256, 1024)
    """KB"""
    fitted: tuple[int, ...] = (4, 16)
    """KB of the slice stacks that are baked by least squares; all are baked at the nodes."""
    picture: int = 400
    """Pixels across the spheres of the figures."""
    frame: tuple[int, int] = (640, 480)
    """Pixels of the pictures of meshes, and of the timed frames."""
    repeats: int = 5
    """Timed frames of which the fastest counts."""


SETTINGS = {
    "full": Settings(),
    "quick": Settings(
        materials=8, sphere=36, texture=128, largest=256, fitted=(4,), picture=240, frame=(320, 240), repeats=3
    ),
}


def chosen(settings: Settings) -> list[str]:
    """The names of the materials that errors are measured on."""
    found = [name for name in materials.names() if FIT in materials.fits(name)]
    if settings.materials is None:
        return found
    others = [name for name in found if name not in ALWAYS]
    step = len(others) / max(1, settings.materials - len(ALWAYS))
    spread = [others[int(i * step)] for i in range(settings.materials - len(ALWAYS))]
    return sorted([*ALWAYS[: settings.materials], *spread])
