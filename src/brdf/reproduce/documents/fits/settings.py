"""How much is measured."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """The full run's values are the defaults."""

    materials: int | None = None
    """How many of those that have a network, spread over the alphabet; all 80."""
    fitted: int | None = None
    """How many of them our fits are made for; all."""
    pairs: int = 20_000
    """Pairs of directions, stratified."""
    starts: int = 16
    pixels: int = 28
    """Across the picture of a sphere lit from all around."""


SETTINGS = {"full": Settings(), "quick": Settings(materials=12, fitted=1, pairs=3000, starts=2, pixels=16)}
