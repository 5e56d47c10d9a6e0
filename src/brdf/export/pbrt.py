"""pbrt-v4: `.pbrt` with a measured material, and its spectral measurement beside it.

pbrt reads RGL's spectral files alone, so colours become the smoothest spectra of that colour.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import io
from ..color import rgb_weights
from ..container import replacing
from ..reflectance import Reflectance
from ..representations.adaptive import Adaptive
from ..representations.baking.adaptive_grid import bake_adaptive
from .target import Target, Written, identifier, title

WAVELENGTHS = np.linspace(380, 740, 19)
"""nm"""


def spectra_of_primaries(wavelengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """(W, 3): the smoothest spectra whose colours are red, green and blue; together they are 1 everywhere.

    They minimise the squared second differences. Parts of them are negative.
    """
    weights, count = rgb_weights(wavelengths), len(wavelengths)
    roughness = np.diff(np.eye(count), 2, axis=0)
    system = np.block([[roughness.T @ roughness, weights], [weights.T, np.zeros((3, 3))]])
    wanted = np.concatenate([np.zeros((count, 3)), np.eye(3)])
    return np.asarray(np.linalg.solve(system, wanted)[:count])


def spectral(m: Adaptive) -> Adaptive:
    """An RGB measurement with the smoothest spectra of its colours; what would be negative is zero."""
    if m.wavelengths is not None:
        return m
    tensors = dict(m.tensors)
    rgb = tensors.pop("rgb")
    basis = spectra_of_primaries(WAVELENGTHS).astype(np.float32)
    spectra = np.maximum(np.einsum("wc,ptcyx->ptwyx", basis, rgb), 0)
    tensors |= {"spectra": np.ascontiguousarray(spectra), "wavelengths": WAVELENGTHS.astype(np.float32)}
    return Adaptive(tensors, m.description)


def write(m: Reflectance, path: Path) -> Written:
    """A named material to `Include`. Raises ReflectanceError for what transmits or mirrors."""
    beside = path.with_name(f"{path.name}.bsdf")  # never the measurement that it may have come from
    measured = spectral(m if isinstance(m, Adaptive) else bake_adaptive(m))
    io.write(measured, beside, "RGL")
    name, quoted = identifier(m), re.sub(r'(["\\])', r"\\\1", beside.name)
    with replacing(path) as temporary:
        temporary.write_text(
            f'# {title(m)}; use it by: NamedMaterial "{name}"\n'
            f'MakeNamedMaterial "{name}" "string type" "measured" "string filename" "{quoted}"\n',
            "utf-8",
        )
    return Written((path, beside), measured.named(m.name, f"spectral measurement {beside.name}"))


TARGET = Target("pbrt-v4", ".pbrt", "a measured material with spectra", write)
