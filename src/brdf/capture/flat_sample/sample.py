"""Pictures of a flat sample under a lamp on an arc: what a capture yields, what the simulator makes."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ... import container
from ...errors import CorruptFileError, ParameterError
from ...reflectance import Reflectance
from ...representations.shading.shading_map import ShadingMap
from ..folders import new_folder
from .checks import Checks, checks_of, warnings_of
from .sheet import save_sheet

Floats = NDArray[np.floating[Any]]

PICTURES, MATERIAL, SHEET = "pictures.safetensors", "shading-map.safetensors", "contact-sheet.png"
REPORT, NUMBERS = "report.txt", "report.json"
"""Files of the folder."""


@dataclass(frozen=True)
class FlatSample:
    """Linear pictures of one sample by a fixed camera straight above, ordered by the lamp's angle.

    Raises ParameterError for arrays that do not fit.
    """

    images: NDArray[np.float32]
    """(M, H, W, 3) radiance [1/sr] under irradiance 1 on a plane that faces the lamp"""
    elevations: Floats
    """(M,) the lamp's angle from the normal [degrees], rising"""
    name: str = "sample"
    source: str = ""
    scale_known: bool = False
    """whether the pictures' brightness is absolute; else the sample was taken to have a certain albedo"""
    clipped: Floats | None = None
    """(M,) share of saturated pixels"""
    facts: Sequence[str] = field(default_factory=tuple)

    def __post_init__(self) -> None:
        count = len(self.images) if self.images.ndim == 4 and self.images.shape[-1] == 3 and self.images.size else 0
        if not count or np.shape(self.elevations) != (count,):
            shapes = f"{self.images.shape} and {np.shape(self.elevations)}"
            raise ParameterError(f"pictures must be (M, H, W, 3) with M elevations, got {shapes}")
        order = np.argsort(self.elevations, kind="stable")
        if (np.diff(order) < 0).any():
            object.__setattr__(self, "images", self.images[order])
            object.__setattr__(self, "elevations", np.asarray(self.elevations)[order])
            object.__setattr__(self, "clipped", None if self.clipped is None else np.asarray(self.clipped)[order])

    @cached_property
    def checks(self) -> Checks:
        """Figures of the pictures."""
        return checks_of(self.images, self.clipped)

    @property
    def averages(self) -> Floats:
        """(M,) mean luminance of the pictures: a_i of Kautz2004."""
        return self.checks.averages

    @property
    def warnings(self) -> list[str]:
        """What is wrong or unusual about the pictures, one sentence each."""
        return warnings_of(self.checks, self.elevations)

    def shading_map(self, brdf: Reflectance | None = None, **options: Any) -> ShadingMap:
        """The sample under any reflectance, by default its own average: see `brdf.ShadingMap.from_images`."""
        made = ShadingMap.from_images(list(self.images), self.elevations, brdf, **options)
        return made.named(self.name, self.source)

    @property
    def report(self) -> str:
        """What was done and how the pictures are, as text."""
        checks, lines = self.checks, [*self.facts]
        lines.append(f"{len(self.images)} pictures of {self.images.shape[2]} x {self.images.shape[1]} pixels")
        lines += ["", "angle   average  pi a/cos  gradient x      y  clipped"]
        for k, angle in enumerate(self.elevations):
            level = math.pi * self.averages[k] / math.cos(math.radians(angle))
            right, up = checks.gradients[k]
            lost = checks.clipped[k]
            lines.append(f"{angle:5.1f}° {self.averages[k]:8.5f}  {level:8.4f}  {right:+10.1%} {up:+6.1%}  {lost:7.2%}")
        falls = "fall steadily" if checks.monotone else "do not fall steadily"
        lines += ["", f"averages {falls} towards grazing light; anisotropy of the relief {checks.anisotropy:.2f}"]
        lines += [f"warning: {text}" for text in self.warnings]
        return "\n".join(lines) + "\n"

    def numbers(self) -> dict[str, Any]:
        """The report for scripts; plain JSON values."""
        return {
            "facts": list(self.facts),
            "warnings": self.warnings,
            "elevations": self.elevations.tolist(),
            "averages": self.averages.tolist(),
            "gradients": self.checks.gradients.tolist(),
            "clipped": self.checks.clipped.tolist(),
            "anisotropy": self.checks.anisotropy,
            "monotone": self.checks.monotone,
            "scale_known": self.scale_known,
            "size": [int(extent) for extent in self.images.shape[1:3]],
        }

    def save(
        self, folder: str | os.PathLike[str], material: Reflectance | None = None, *, overwrite: bool = False
    ) -> Path:
        """Write pictures, contact sheet, report and shading map to a new folder, whole or not at all; returns its path.

        `material`: the shading map to save, by default `shading_map()`. Raises FileError when there is such a folder,
        unless `overwrite`, or when it cannot be written.
        """
        with new_folder(folder, PICTURES, overwrite) as place:
            header = {"kind": "pictures of a flat sample", "name": self.name, "source": self.source,
                      "scale_known": self.scale_known, "facts": list(self.facts)}  # fmt: skip
            arrays: dict[str, NDArray[Any]] = {"images": self.images, "clipped": self.checks.clipped}
            arrays["elevations"] = np.asarray(self.elevations, np.float64)
            container.save(place / PICTURES, header, arrays)
            (material or self.shading_map()).save(place / MATERIAL)
            save_sheet(place / SHEET, self.images, self.elevations, self.averages)
            (place / REPORT).write_text(self.report, "utf-8")
            (place / NUMBERS).write_text(json.dumps(self.numbers(), indent=2, allow_nan=False) + "\n", "utf-8")
        return Path(folder)

    @staticmethod
    def load(folder: str | os.PathLike[str]) -> FlatSample:
        """The pictures of a folder written by `save`. Raises CorruptFileError, FileError."""
        path = Path(folder) / PICTURES
        header, arrays = container.load(path)
        try:
            return FlatSample(
                arrays["images"], arrays["elevations"], str(header["name"]), str(header["source"]),
                bool(header["scale_known"]), arrays["clipped"], tuple(map(str, header["facts"])),
            )  # fmt: skip
        except (KeyError, TypeError, ParameterError) as error:
            raise CorruptFileError(path, f"holds no pictures of a flat sample ({error}).") from None
