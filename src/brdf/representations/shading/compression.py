"""Ways to make a shading map's pictures small, and what they lose."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, UnknownNameError
from ...threads import in_ranges
from .planes import LEVELS, Planes, Powers, PrincipalPictures, Quadratics
from .principal import principal_components
from .slices import Slices
from .stack import Stack, average

MOST_BYTES = 6
"""Bytes a texel beyond which components are of no use: ten photographs are further from what lies between them."""
TEXELS_AT_ONCE = 16384
NEWTON_STEPS = 2
WHITE = 0.995
"""The quantile of the brightest picture's values that counts as white in error measures."""

Fit = Callable[[int, int, NDArray[np.float32], NDArray[np.float32]], None]


def principal(slices: Slices, count: int = MOST_BYTES) -> Stack:
    """Coordinates among the `count` principal components of all pictures."""
    vectors = slices.vectors()
    count = min(count, vectors.shape[1])
    found = principal_components(vectors, count)
    codes, low, span = Planes.quantised(found.coefficients.reshape(*slices.shape, count))
    rounded = low + span * (codes.reshape(-1, count).mean(0, dtype=np.float64) / LEVELS)
    mean = found.mean - rounded @ found.basis
    return PrincipalPictures(
        codes, low, span, mean.reshape(-1, 3), found.basis.reshape(count, -1, 3), slices.wraps
    )  # fmt: skip


def power_brute_force(slices: Slices) -> Stack:
    """k the brightest picture, K searched: Kautz2004."""
    return _searched(slices, joint=False)


def power_joint(slices: Slices) -> Stack:
    """k and K together, K searched, k the best for it."""
    return _searched(slices, joint=True)


def power(slices: Slices) -> Stack:
    """k the brightest picture, K from logarithms weighted by s², then two steps of Gauss and Newton."""
    from . import fits as shading_fits

    logarithms = np.log(_shares(slices)).astype(np.float32)
    return _fitted(Powers, slices, lambda start, stop, samples, out: shading_fits.solved(
        start, stop, samples, logarithms, NEWTON_STEPS, out))  # fmt: skip


def quadratic(slices: Slices) -> Stack:
    """p x + q x² by least squares."""
    from . import fits as shading_fits

    x = _shares(slices)
    operator = np.linalg.pinv(np.stack([x, x * x], -1)).astype(np.float32)
    return _fitted(Quadratics, slices, lambda start, stop, samples, out: shading_fits.projected(
        start, stop, samples, operator, out))  # fmt: skip


def _searched(slices: Slices, joint: bool) -> Stack:
    from . import fits as shading_fits

    table = shading_fits.powers_table(_shares(slices))
    return _fitted(Powers, slices, lambda start, stop, samples, out: shading_fits.searched(
        start, stop, samples, table, joint, out))  # fmt: skip


def _fitted(kind: type[Planes], slices: Slices, fit: Fit) -> Stack:
    samples = slices.pictures.reshape(-1, len(slices.nodes), 3)
    out = np.empty((len(samples), 6), np.float32)
    in_ranges(lambda start, stop: fit(start, stop, samples, out), len(samples), TEXELS_AT_ONCE)
    return kind(*Planes.quantised(out.reshape(*slices.shape, 6)), slices.nodes, slices.wraps)


def _shares(slices: Slices) -> NDArray[np.float64]:
    """The pictures' averages as shares of the brightest."""
    return slices.nodes / slices.highest


METHODS: dict[str, Callable[..., Stack]] = {
    "pca": principal,
    "quadratic": quadratic,
    "power-joint": power_joint,
    "power": power,
    "power-brute-force": power_brute_force,
}
"""By name, from least to largest error at 6 bytes a texel."""


def compressed(slices: Slices, bytes_per_texel: int = MOST_BYTES, method: str | None = None) -> Stack:
    """The pictures in `bytes_per_texel` bytes (1 to 6) by one of `METHODS`, by default "pca", the most exact at any
    size; the others take 6. Raises UnknownNameError, ParameterError.
    """
    method = "pca" if method is None else method
    if method not in METHODS:
        raise UnknownNameError("compression method", method, METHODS)
    whole = isinstance(bytes_per_texel, (int, np.integer)) and not isinstance(bytes_per_texel, bool)
    if not whole or not 1 <= bytes_per_texel <= MOST_BYTES:
        raise ParameterError(f"bytes_per_texel must be a whole number in [1, {MOST_BYTES}], got {bytes_per_texel!r}")
    if method == "pca":
        return principal(slices, int(bytes_per_texel))
    if bytes_per_texel < MOST_BYTES:
        raise ParameterError(f"{method} takes 6 bytes a texel, got {bytes_per_texel}; 'pca' goes down to 1")
    return METHODS[method](slices)


@dataclass(frozen=True)
class CompressionRow:
    """What one method costs and loses."""

    method: str
    bytes_per_texel: float
    rms: float
    """Root mean square error at the stored pictures, as a share of white."""
    held_out_rms: float | None
    """The same at other pictures of the sample, where some were given."""


def compression_table(slices: Slices, held_out: Iterable[NDArray[Any]] = ()) -> list[CompressionRow]:
    """Every method at every size it has, the pictures as they are first (at 8 bits a number)."""
    others = list(held_out)
    candidates = [("pictures", slices.bytes_per_texel / slices.pictures.itemsize, slices)]
    candidates += [("pca", size, principal(slices, size)) for size in range(MOST_BYTES, 0, -1)]  # type: ignore[misc]
    candidates += [(name, MOST_BYTES, make(slices)) for name, make in METHODS.items() if name != "pca"]  # type: ignore[misc]
    return [
        CompressionRow(name, size, rms(stack, slices), rms_at(stack, others, white(slices)) if others else None)
        for name, size, stack in candidates
    ]


def white(slices: Slices) -> float:
    """The value that error measures take as 1."""
    return float(np.quantile(slices.pictures[:, :, -1], WHITE))


def rms(stack: Stack, slices: Slices) -> float:
    """Root mean square error of a stack at the pictures it was made of, as a share of white."""
    squares = [np.mean((stack.picture(level) - slices.pictures[:, :, k]) ** 2) for k, level in enumerate(slices.nodes)]
    return float(np.sqrt(np.mean(squares))) / white(slices)


def rms_at(stack: Stack, pictures: Iterable[NDArray[Any]], white: float) -> float:
    """The same at other pictures (rows, columns, 3), each looked up by its own average; `white` as a value."""
    squares = [np.mean((stack.scaled_picture(float(average(np.asarray(p)))) - p) ** 2) for p in pictures]
    return float(np.sqrt(np.mean(squares))) / white
