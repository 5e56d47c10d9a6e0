"""Compressed stacks: a few numbers of 8 bits a texel, from which a formula makes every picture."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from itertools import pairwise
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...color import LUMINANCE
from ...formula import Scalar, Vec, maximum, pow, texture2d
from ...threads import in_ranges, map_threads
from .stack import Picture, Place, Stack, with_rim

LEVELS = 255
"""Steps of an 8-bit number."""


TEXELS_AT_ONCE = 16384


class Planes(Stack):
    """Base of the compressed stacks: C numbers a texel, each spread over the range of its plane."""

    def __init__(
        self, codes: NDArray[np.uint8], low: ArrayLike, span: ArrayLike, nodes: ArrayLike, wraps: bool = False
    ) -> None:
        """`codes` (rows, columns, C); a number is low + span · code / 255, `low` and `span` (C,)."""
        super().__init__(codes, nodes, wraps)
        self.low, self.span = (np.asarray(a, np.float64) for a in (low, span))

    @staticmethod
    def quantised(planes: NDArray[np.float32]) -> tuple[NDArray[np.uint8], NDArray[np.float64], NDArray[np.float64]]:
        """Codes, low and span of (rows, columns, C) numbers."""
        flat = planes.reshape(-1, planes.shape[-1])
        starts = range(0, len(flat), TEXELS_AT_ONCE)
        ends = map_threads(lambda start: _range(flat[start : start + TEXELS_AT_ONCE]), starts)
        low, high = np.min([least for least, _ in ends], 0), np.max([most for _, most in ends], 0)
        scale = np.float32(LEVELS) / np.where(high > low, high - low, np.float32(1))
        codes = np.empty(flat.shape, np.uint8)

        def fill(start: int, stop: int) -> None:
            codes[start:stop] = (flat[start:stop] - low) * scale + np.float32(0.5)

        in_ranges(fill, len(flat), TEXELS_AT_ONCE)
        return codes.reshape(planes.shape), low.astype(np.float64), (high - low).astype(np.float64)

    @cached_property
    def planes(self) -> NDArray[np.float32]:
        """(rows, columns, C) numbers that the codes stand for."""
        return self._texels * (self.span / LEVELS).astype(np.float32) + self.low.astype(np.float32)

    @cached_property
    def textures(self) -> dict[str, NDArray[np.float32]]:
        return {"planes": with_rim(self.planes, self.wraps)}

    def features(self) -> NDArray[np.float32]:
        return self.planes

    def gathered(self, texels: NDArray[np.intp], wraps: bool) -> Self:
        codes = self._texels.reshape(-1, self._texels.shape[-1])[texels]
        return self._replaced(codes, wraps)

    def _replaced(self, codes: NDArray[np.uint8], wraps: bool) -> Self:
        return type(self)(codes, self.low, self.span, self.nodes, wraps)

    def state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        header = {"wraps": self.wraps, "nodes": self.nodes.tolist(), "low": self.low.tolist(),
                  "span": self.span.tolist()}  # fmt: skip
        return header, {"codes": self._texels}

    @classmethod
    def restored(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> Self:
        return cls(*_checked(header, arrays), header["nodes"], header["wraps"])


def _range(numbers: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Least and greatest of each column of (N, C); rows of the transpose are quick to go through."""
    columns = np.ascontiguousarray(numbers.T)
    return columns.min(1), columns.max(1)


def _checked(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> tuple[NDArray[np.uint8], Any, Any]:
    codes, low, span = arrays["codes"], np.asarray(header["low"], float), np.asarray(header["span"], float)
    if codes.ndim != 3 or codes.dtype != np.uint8 or not codes.size or not low.shape == span.shape == codes.shape[2:]:
        raise ValueError(f"codes {codes.shape} {codes.dtype} do not fit ranges {low.shape} and {span.shape}")
    if not np.isfinite([low, span]).all():
        raise ValueError("a range is not finite")
    return codes, low, span


class PrincipalPictures(Planes):
    """S(r) = M(r) + sum_c n_c B_c(r): coordinates n_c of a texel among principal components of all its pictures.

    The mean M and the components B are known at the nodes and linear in between. M carries the mean of the rounded
    coordinates, so that each picture keeps its average.
    """

    def __init__(
        self, codes: NDArray[np.uint8], low: ArrayLike, span: ArrayLike, mean: ArrayLike, basis: ArrayLike,
        wraps: bool = False,
    ) -> None:  # fmt: skip
        """`mean` (N, 3) and `basis` (C, N, 3). Raises ParameterError when the pictures' averages do not increase."""
        self.mean, self.basis = np.asarray(mean, np.float64), np.asarray(basis, np.float64)
        shares = codes.reshape(-1, codes.shape[-1]).mean(0, dtype=np.float64) / LEVELS
        typical = self.mean + np.einsum("c,cnk->nk", np.asarray(low) + np.asarray(span) * shares, self.basis)
        super().__init__(codes, low, span, typical @ LUMINANCE, wraps)

    @cached_property
    def values(self) -> dict[str, Any]:
        """The nodes, and M and B there: numbers and not a texture, so that kernels need no lookup for them."""
        rows = np.concatenate([self.mean[None], self.basis])
        return super().values | {
            _row_name(row, node): rows[row, node] for row in range(len(rows)) for node in range(len(self.nodes))
        }

    @property
    def nbytes(self) -> int:
        return super().nbytes + 4 * (self.mean.size + self.basis.size)

    def value(self, bound: Any, place: Place, level: Scalar) -> Vec:
        rises = self.rises(bound, level)

        def at_level(row: int) -> Vec:
            ends = [getattr(bound, _row_name(row, node)) for node in range(len(self.nodes))]
            total: Vec = ends[0]
            for rise, (low, high) in zip(rises, pairwise(ends), strict=True):
                total = total + (high - low) * rise
            return total

        rgb = at_level(0)
        for index, number in enumerate(texture2d(bound.planes, *place)):
            rgb = rgb + at_level(index + 1) * number
        positive: Vec = maximum(rgb, 0.0)
        return positive

    def picture(self, level: float) -> Picture:
        rows = np.concatenate([self.mean[None], self.basis]).reshape(len(self.basis) + 1, len(self.nodes), 3)
        at = np.stack([[np.interp(level, self.nodes, row[:, k]) for k in range(3)] for row in rows])
        return np.asarray(np.maximum(self.planes.astype(np.float64) @ at[1:] + at[0], 0))

    def _replaced(self, codes: NDArray[np.uint8], wraps: bool) -> Self:
        return type(self)(codes, self.low, self.span, self.mean, self.basis, wraps)

    def state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        header, arrays = super().state()
        del header["nodes"]
        return header, arrays | {"mean": self.mean, "basis": self.basis}

    @classmethod
    def restored(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> Self:
        codes, low, span = _checked(header, arrays)
        mean, basis = arrays["mean"], arrays["basis"]
        if mean.ndim != 2 or mean.shape[1] != 3 or basis.shape != (codes.shape[2], *mean.shape):
            raise ValueError(f"a basis {basis.shape} and a mean {mean.shape} do not fit {codes.shape[2]} numbers")
        if not (np.isfinite(mean).all() and np.isfinite(basis).all()):
            raise ValueError("the basis holds NaN or infinity")
        return cls(codes, low, span, mean, basis, header["wraps"])


def _row_name(row: int, node: int) -> str:
    return f"basis_{row}_{node + 1}" if row else f"mean_{node + 1}"


class _Curves(Planes):
    """Two numbers a channel, p and q, that shape a curve over x = r / a_max."""

    bottomless = True
    curve: ClassVar[Any]
    """The formula: the value at x of (p, q)."""

    def value(self, bound: Any, place: Place, level: Scalar) -> Vec:
        p_r, p_g, p_b, q_r, q_g, q_b = texture2d(bound.planes, *place)
        x = level * (1.0 / self.ends(bound)[1])
        return Vec(*(type(self).curve(x, p, q) for p, q in ((p_r, q_r), (p_g, q_g), (p_b, q_b))))

    def picture(self, level: float) -> Picture:
        planes = self.planes.astype(np.float64)
        x = np.float64(level / self.highest)
        return np.asarray(type(self).curve(x, planes[..., :3], planes[..., 3:]))


class Powers(_Curves):
    """S(r) = k (r / a_max)^K in each texel and channel.

    Reference: Kautz2004, equation 4, with r as a share of the brightest picture's.
    """

    @staticmethod
    def curve(x: Any, k: Any, K: Any) -> Any:
        return k * pow(x, K)


class Quadratics(_Curves):
    """S(r) = max(0, p x + q x²) with x = r / a_max, in each texel and channel."""

    @staticmethod
    def curve(x: Any, p: Any, q: Any) -> Any:
        return maximum(x * (p + q * x), 0.0)
