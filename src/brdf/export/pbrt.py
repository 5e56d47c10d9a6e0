"""pbrt-v4: `.pbrt` with a diffuse material, or a measured one and its spectral measurement beside it.

Of RGL's files pbrt reads the spectral ones alone, so colours become smooth spectra of that colour.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import io
from ..color import rgb_weights
from ..container import replacing
from ..models import get as model
from ..reflectance import Reflectance
from ..representations.adaptive import Adaptive
from ..representations.baking.adaptive_grid import bake_adaptive
from .target import Target, Written, identifier, stand_in, title

WAVELENGTHS = np.linspace(380, 740, 19)
"""nm"""
EXACTNESS = 1e4
"""How much more an error of a colour counts than a bend of a spectrum: it stays below 1e-6."""


def spectra_of_primaries(wavelengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """(W, 3): spectra whose colours are red, green and blue; none is negative, and together they are 1 everywhere.

    Of all such they have the least squared second differences. Sums of them are colours in gamut without negative
    parts, which would have to be cut off and change saturated colours. Reference: Mallett2019.
    """
    from scipy.optimize import nnls

    weights, count = rgb_weights(wavelengths), len(wavelengths)
    bends, primaries = np.diff(np.eye(count), 2, axis=0), np.eye(3)
    exactly = [np.kron(weights.T, primaries), np.kron(np.eye(count), np.ones((1, 3)))]  # colours; sums
    system = np.concatenate([np.kron(bends, primaries), *(EXACTNESS * part for part in exactly)])
    wanted = np.concatenate([np.zeros(bends.shape[0] * 3), EXACTNESS * primaries.ravel(), np.full(count, EXACTNESS)])
    found, _ = nnls(system, wanted)
    return np.asarray(found.reshape(count, 3))


def spectral(m: Adaptive) -> Adaptive:
    """An RGB measurement with smooth spectra of its colours; of colours out of gamut what would be negative is zero."""
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
    if isinstance(m, model("Lambertian")):
        colour = " ".join(f"{x:.9g}" for x in np.broadcast_to(m.values["albedo"], 3))
        _write_material(m, path, f'"string type" "diffuse" "rgb reflectance" [ {colour} ]')
        return Written((path,), m)
    beside = path.with_name(f"{path.name}.bsdf")  # never the measurement that it may have come from
    measured = spectral(m if isinstance(m, Adaptive) else bake_adaptive(m))
    io.write(measured, beside, "RGL")
    quoted = re.sub(r'(["\\])', r"\\\1", beside.name)
    _write_material(m, path, f'"string type" "measured" "string filename" "{quoted}"')
    return Written((path, beside), stand_in(measured, m, f"spectral measurement {beside.name}"))


def _write_material(m: Reflectance, path: Path, parameters: str) -> None:
    name = identifier(m)
    comment = f'# {title(m)}; use it by: NamedMaterial "{name}"'
    with replacing(path) as temporary:
        temporary.write_text(f'{comment}\nMakeNamedMaterial "{name}" {parameters}\n', "utf-8")


TARGET = Target("pbrt-v4", ".pbrt", "a diffuse material, else a measured one with spectra", write)
