"""How much is measured, on what, and the constants that several figures share."""

from __future__ import annotations

from dataclasses import dataclass

from ....capture.simulation import names

BETWEEN = (5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 84.0)
"""Angles of the lamp from the normal [degrees] between those photographed, of which maps know nothing."""

SLICES = 8
"""Of the paper's shading maps, the black one included."""

SHOWN = "suede"
"""What figures 1 to 3 and 5 show."""

COMPARED = "wool"
"""What figure 4 shows."""

DIFFUSE = 0.5

PHONG: dict[str, tuple[float, float]] = {
    "jeans": (0.1, 5), "suede": (0.1, 5), "leather": (0.25, 20), "pressed wood": (0.2, 20), "wax": (0.3, 30),
    "nylon": (0.3, 20), "cloth": (0.15, 10), "wool": (0.1, 5), "plastic": (0.4, 60), "stone": (0.1, 10),
}  # fmt: skip
"""Albedo of the highlight (of the diffuser: `DIFFUSE`) and its exponent, of the paper's kind of BRDF, freely chosen;
the first eight in the order of its figure 7."""


@dataclass(frozen=True)
class Settings:
    """The full run's values are the defaults."""

    materials: tuple[str, ...] | None = None
    """Of the simulated ones; all of them."""
    size: int = 256
    """Pixels across the simulated photographs."""
    btf: int = 128
    """Pixels across the BTFs that techniques are compared with, and across the photographs for that."""
    full_btf: int = 96
    """Pixels across figure 4's BTF."""
    rings: tuple[tuple[float, int], ...] = ((0.0, 1), (20.0, 6), (40.0, 8), (60.0, 10), (75.0, 12))
    """Directions of figure 4's BTF: angle from the normal [degrees] and how many around it."""
    picture: tuple[int, int] = (360, 270)
    """Pixels of the pictures of meshes; figure 1 has twice as many along each side."""
    timed: int = 512
    """Texels across the map that is fitted against the clock."""
    photograph: int = 1024
    """Pixels across the photographs that are captured against the clock."""
    repeats: int = 5
    """Timed runs of which the fastest counts."""


SETTINGS = {
    "full": Settings(),
    "quick": Settings(
        size=96,
        btf=40,
        full_btf=40,
        rings=((0.0, 1), (40.0, 6), (75.0, 8)),
        picture=(200, 150),
        photograph=512,
        repeats=3,
    ),
}  # fmt: skip


def chosen(settings: Settings) -> list[str]:
    """The simulated materials, in the paper's order."""
    known = [*PHONG, *(name for name in names() if name not in PHONG)]
    return [name for name in known if settings.materials is None or name in settings.materials]
