"""What a capture yields, and its folder."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...reflectance import Reflectance
from ...representations.spheres.sphere_images import SphereImages
from ...representations.tables.table import Table
from ..folders import new_folder
from .coverage import Coverage
from .hold_out import HeldOut, mean_psnr
from .outline import Ball

IMAGES, STACK, REPORT, NUMBERS = "sphere-images.safetensors", "slice-stack.safetensors", "report.txt", "report.json"
"""Files of the folder."""


@dataclass(frozen=True)
class Captured:
    """A material captured from photographs of a ball."""

    images: SphereImages
    """pictures of the ball at a few angles between light and camera"""
    stack: Table
    """the slice stack fitted to all pixels"""
    analytic: Reflectance
    """GGX + Lambert fitted to them, which the stack continues with where nothing was seen"""
    coverage: Coverage
    ball: Ball
    """in the photographs, averaged down and cropped as they were used"""
    photographed: tuple[bool, ...]
    """for each picture of `images` whether it rests on photographs; the others are the stack's"""
    scale: float
    """what the photographs' numbers (1 is the largest) were multiplied by"""
    facts: tuple[str, ...]
    warnings: tuple[str, ...]
    holdout: tuple[HeldOut, ...] = ()

    @property
    def report(self) -> str:
        """What was done and how good it is, as text."""
        angles = " ".join(
            f"{angle:g}{'' if real else '*'}" for angle, real in zip(self.images.angles, self.photographed, strict=True)
        )
        lines = [
            *self.facts,
            f"coverage: {self.coverage.share:.1%} of all (theta_h, theta_d, phi_d), theta_d up to "
            f"{self.coverage.largest_theta_d:g} degrees",
            f"sphere images: {angles} degrees, {self.images.size} texels, {self.images.nbytes:,} bytes",
            *(["  * no photograph is near: computed from the slice stack"] if not all(self.photographed) else []),
            f"slice stack: {self.stack.nbytes:,} bytes",
            f"GGX + Lambert: {self.analytic.source}",
            *(f"warning: {text}" for text in self.warnings),
        ]
        if self.holdout:
            lines += ["", *self._table()]
        return "\n".join(lines) + "\n"

    def _table(self) -> list[str]:
        methods = list(self.holdout[0].psnr)
        width = max(len(row.name) for row in self.holdout) + 2
        heads = "".join(f"{name:>{len(name) + 2}}" for name in methods)
        lines = ["photographs left out, PSNR [dB] of predicting them from the rest", f"{'':<{width}}light{heads}"]
        for row in self.holdout:
            cells = "".join(f"{row.psnr[name]:>{len(name) + 2}.2f}" for name in methods)
            lines.append(f"{row.name:<{width}}{row.angle:4.0f}°{cells}")
        means = mean_psnr(self.holdout)
        cells = "".join(f"{means[name]:>{len(name) + 2}.2f}" for name in methods)
        return [*lines, f"{'mean':<{width}}{'':5}{cells}"]

    def numbers(self) -> dict[str, Any]:
        """The report for scripts; plain JSON values."""
        return {
            "facts": list(self.facts),
            "warnings": list(self.warnings),
            "ball": {"x": self.ball.x, "y": self.ball.y, "radius": self.ball.radius},
            "scale": self.scale,
            "coverage": self.coverage.share,
            "angles": [float(angle) for angle in self.images.angles],
            "photographed": list(self.photographed),
            "bytes": {"images": self.images.nbytes, "stack": self.stack.nbytes},
            "holdout": [{"name": row.name, "angle": row.angle, "psnr": dict(row.psnr)} for row in self.holdout],
            "holdout_mean": mean_psnr(self.holdout),
        }

    def save(
        self, folder: str | os.PathLike[str], *, overwrite: bool = False, also: Callable[[Path], None] | None = None
    ) -> Path:
        """Write both representations and the report to a new folder, whole or not at all; returns its path.

        `also(folder)` may add files before the folder gets its name. Raises FileError when there is such a folder
        already, unless `overwrite`, or when it cannot be written.
        """
        with new_folder(folder, STACK, overwrite) as place:
            self.images.save(place / IMAGES)
            self.stack.save(place / STACK)
            (place / REPORT).write_text(self.report, "utf-8")
            (place / NUMBERS).write_text(json.dumps(self.numbers(), indent=2, allow_nan=False) + "\n", "utf-8")
            if also is not None:
                also(place)
        return Path(folder)
