"""The best table of so many bytes for one reflectance, found by trying many.

Tried are the paper's tables (identity, uniform, Bezier), the half-vector table, the slice stack, and tables adapted to
the reflectance in three bases, each with several encodings, storages and filters. Their errors are measured at pairs of
directions that took no part in the adaptation. Only those count that are, in both errors, no worse than the best of the
paper's; of them the one with the least product of the errors is taken.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ...errors import ParameterError, UnknownNameError
from ...metrics.importance import Errors, ErrorsAgainst, importance_pairs, relative_rms
from ...metrics.pairs import Pairs
from ...reflectance import Reflectance
from ..storage import storage
from ..tables.encoding import Encoding, Log, Plain, Root
from ..tables.filters import texture_filter
from ..tables.layout import Layout
from ..tables.layouts import named_layout
from ..tables.table import Table
from .adaptive_layout import KNOTS, STARTS, Adapted, adapt
from .alpha_search import with_alpha
from .bake import bake_points, require_isotropic, validity
from .slice_stack import MEASURED_FLOOR, SliceStack, is_measured, parse_budget

LEAST_BYTES = 1 << 10
"""Below this not even `LEAST_NODES` an axis make a table worth searching for."""

DEFAULT_BYTES = 64 << 10

OVERHEAD = 36 + 3 * 4 * KNOTS
"""Bytes that are not texels: constants, and the weights of three spline warps."""

ADAPTING_PAIRS, CHOOSING_PAIRS = 8192, 16384

MARGIN = 0.9
"""What errors must be below, in parts of the best paper table's, to be sure to be below on other pairs, too."""

ASYMMETRY = 1e-3
"""Relative RMS of what exchanging the directions changes, from which a basis is tried that tells them apart."""

PAPER_TABLES = ("identity", "uniform", "bezier")

LOGARITHM = Encoding(Log(1e-3))
FLOOR_LOGARITHM = Encoding(Log(1e-3), cosine_power=1.5, scale=math.pi)
"""With the diffuse floor removed: the slice stack's."""

VARIANTS: tuple[tuple[str, Encoding, str], ...] = (
    ("log", LOGARITHM, "half"),
    ("plain", Encoding(Plain()), "half"),
    ("cube root", Encoding(Root(3)), "half"),
    ("floor log", FLOOR_LOGARITHM, "half"),
    ("floor log", FLOOR_LOGARITHM, "10-10-10"),
)
"""Encoding by name, itself, and storage of the adapted tables."""

FILTERS_TRIED = ("linear", "catmull-rom")

QUALITIES = ("search", "adaptive")


@dataclass(frozen=True)
class Candidate:
    """One table that was tried. `errors` are those at the pairs that the choice is made at."""

    name: str
    nbytes: int
    errors: Errors
    bake: Callable[[], Table]

    @property
    def score(self) -> float:
        """The logarithm of the errors' product."""
        return sum(math.log(max(e, 1e-12)) for e in self.errors)

    @property
    def family(self) -> str:
        """The first word of the name: identity, uniform, bezier, half, stack, adaptive."""
        return self.name.replace(",", " ").split()[0]


@dataclass(frozen=True)
class Search:
    """What `search` found: every candidate, best first, and the best one's table."""

    material: str
    budget: int
    candidates: tuple[Candidate, ...]
    best: Table

    def pareto(self) -> list[Candidate]:
        """The candidates that no other one beats in bytes and in both errors."""
        return pareto(self.candidates)


def search(
    m: Reflectance,
    budget: str | int = DEFAULT_BYTES,
    quality: str = "search",
    filters: Sequence[str] = FILTERS_TRIED,
) -> Search:
    """Tables of `m` of at most `budget` bytes (a number, or a text such as "64K"), and the best of them.

    `quality` "adaptive" tries the adapted tables alone, which is quicker; `filters` are those adapted tables may use.
    Deterministic. Raises ParameterError for an impossible budget, ReflectanceError when `m` is anisotropic,
    UnknownNameError for a quality or a filter.
    """
    size = parse_budget(budget, "searched table", LEAST_BYTES)
    if quality not in QUALITIES:
        raise UnknownNameError("quality", quality, QUALITIES)
    for name in filters:
        texture_filter(name)
    require_isotropic(m)
    trial = _Trial(m, size)
    found = [] if quality == "adaptive" else [*trial.paper(), *trial.half_vector(), *trial.stack()]
    found += trial.adaptive(filters)
    ranked = ranking(found)
    return Search(m.name or type(m).__name__, size, tuple(ranked), ranked[0].bake())


def bake_budget(
    m: Reflectance, budget: str | int | None, quality: str | None, filter: str | None, fixed: Mapping[str, Any]
) -> Table:
    """`Table.bake` within a budget. `fixed` are its options that are searched for here: they must be left as they are.

    Raises ParameterError, and as `search`.
    """
    defaults = inspect.signature(Table.bake).parameters
    for option, value in fixed.items():
        if value != defaults[option].default:
            raise ParameterError(f"{option!r} is searched for within a budget: leave it out, or give no budget")
    filters = FILTERS_TRIED if filter is None else (filter,)
    return search(m, DEFAULT_BYTES if budget is None else budget, quality or "search", filters).best


def ranking(found: Sequence[Candidate]) -> list[Candidate]:
    """Best first: those better than every paper table in both errors, by product; then the others, by the worse of the
    two ratios."""
    papers = [c.errors for c in found if c.family in PAPER_TABLES]
    limits = [min((e[k] for e in papers), default=math.inf) for k in (0, 1)]

    def key(candidate: Candidate) -> tuple[int, float]:
        worst = max(e / max(limit, 1e-12) for e, limit in zip(candidate.errors, limits, strict=True))
        return (0, candidate.score) if worst <= MARGIN else (1, worst)

    return sorted(found, key=key)


def pareto(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Those that no other one beats or equals in bytes and both errors, fewest bytes first."""

    def beats(a: Candidate, b: Candidate) -> bool:
        ours, theirs = (a.nbytes, *a.errors), (b.nbytes, *b.errors)
        return ours != theirs and all(x <= y for x, y in zip(ours, theirs, strict=True))

    kept = [c for c in candidates if not any(beats(other, c) for other in candidates)]
    return sorted(kept, key=lambda c: c.nbytes)


class _Trial:
    """Candidates for one reflectance and budget."""

    def __init__(self, m: Reflectance, size: int) -> None:
        self._m, self._size = m, size
        self._measured = is_measured(m)
        self._adapting = ErrorsAgainst(m, _valid(m, importance_pairs(ADAPTING_PAIRS, 0)))
        self._choosing = ErrorsAgainst(m, _valid(m, importance_pairs(CHOOSING_PAIRS, 1)))

    def paper(self) -> Iterator[Candidate]:
        """Mallett's tables N x N x 2N: three warps, alpha by hand, by his metric, and measured, in 4 or 6 bytes."""
        for warp in PAPER_TABLES:
            alphas = (None, "total-intensity", "measured") if warp == "bezier" else (None,)
            for alpha in alphas:
                layout = named_layout("normal", warp, self._cubic(1, 2, "rgb9e5"), "rgb9e5")
                if alpha:
                    layout = with_alpha(self._m, layout, alpha)
                for texel in ("rgb9e5", "half"):
                    sized = replace(layout, shape=self._cubic(1, 2, texel), storage=texel)
                    yield self._candidate(f"{warp}{f' {alpha}' if alpha else ''}, {texel}", sized)

    def half_vector(self) -> Iterator[Candidate]:
        """The half-vector table with its fixed warps, 2N x 2N x N / 2."""
        for texel in ("half", "10-10-10"):
            yield self._candidate(
                f"half log, {texel}", named_layout("half", "bezier", self._cubic(2, 0.5, texel), texel)
            )

    def stack(self) -> Iterator[Candidate]:
        """The slice stack."""
        bake = partial(SliceStack.bake, self._m, self._size)
        yield self._baked("stack", bake)

    def adaptive(self, filters: Sequence[str]) -> Iterator[Candidate]:
        """Tables whose warps and numbers of nodes are made for the reflectance."""
        for basis in STARTS:
            if basis == "irreciprocal" and self._is_reciprocal():
                continue
            fits: dict[Encoding, Adapted] = {}
            for name, encoding, texel in VARIANTS:
                fitted = LOGARITHM if encoding.scale == 1.0 else FLOOR_LOGARITHM
                if fitted not in fits:
                    fits[fitted] = adapt(self._m, self._adapting, self._entries(texel), basis, fitted, self._error)
                for how in filters:
                    layout = fits[fitted].sized(self._entries(texel), encoding=encoding, storage=texel, filter=how)
                    yield self._candidate(f"adaptive {basis} {name}, {texel}, {how}", layout)

    def _is_reciprocal(self) -> bool:
        wi, wo, weight = self._adapting.pairs
        exchanged = self._m(wo, wi) * wi[:, 2:]
        return relative_rms(self._adapting.f_cos, exchanged, weight) < ASYMMETRY

    def _candidate(self, name: str, layout: Layout) -> Candidate:
        return self._baked(name, partial(self._bake, layout))

    def _baked(self, name: str, bake: Callable[[], Table]) -> Candidate:
        table = bake()
        return Candidate(name, table.nbytes, self._choosing(table), bake)

    def _bake(self, layout: Layout) -> Table:
        quantile = None if layout.encoding.scale == 1.0 else MEASURED_FLOOR if self._measured else 0.0
        return bake_points(self._m, layout, quantile, symmetrise=self._measured)

    def _error(self, layout: Layout) -> float:
        """What the rounds of an adaptation are compared by."""
        return float(np.sum(np.log(np.maximum(self._adapting(self._bake(layout)), 1e-12))))

    def _entries(self, texel: str) -> int:
        """How many nodes fit."""
        return (self._size - OVERHEAD) // _texel_bytes(texel)

    def _cubic(self, first: float, third: float, texel: str) -> tuple[int, int, int]:
        """(a N, a N, c N) nodes that fit."""
        n = ((self._size - 36) / _texel_bytes(texel) / (first * first * third)) ** (1 / 3)
        a = max(2, math.floor(first * n))
        return a, a, max(2, min(math.ceil(third * n), (self._size - 36) // _texel_bytes(texel) // (a * a)))


def _texel_bytes(name: str) -> int:
    return storage(name).pack(np.ones((1, 3)))[0].nbytes


def _valid(m: Reflectance, pairs: Pairs) -> Pairs:
    """The pairs at which `m` is known."""
    known = validity(m, pairs.wi, pairs.wo)
    if known.all():
        return pairs
    wi, wo, weight = (part[known] for part in pairs)
    return Pairs(wi, wo, weight / weight.sum())
