"""Residuals of a model against samples, their exact derivatives, and the normal equations of both.

Residual of a channel: root * (T(f cos(theta_i)) - target), with the loss's scale T. From its graph come the derivatives
with respect to all numbers of the model; a generated kernel adds up their products. Graphs too large to compile in
reasonable time are evaluated with NumPy, block by block.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..formula.derivative import derivative
from ..formula.evaluation import evaluate
from ..formula.graph import Expr, reachable
from ..formula.trace import Program, component_names, trace
from ..reflectance import Reflectance
from ..threads import map_threads
from .losses import Loss
from .parameters import components, grouped, with_values
from .samples import Samples

Array = NDArray[np.float64]

LARGEST_COMPILED = 5000
"""Nodes of a graph that is compiled: the 1,700 of SGD and the 3,900 of He-Torrance take 12 s each, once a machine."""

PER_TASK = 1 << 16
"""Samples a thread takes at a time."""

PER_BLOCK = 1 << 12
"""Samples evaluated at once with NumPy."""

_INPUTS = [f"{w}_{axis}" for w in ("wi", "wo") for axis in "xyz"] + [
    f"{what}_{c}" for what in ("target", "root") for c in "rgb"
]


class Normal(NamedTuple):
    """Half the sum of squared residuals, and its derivatives with respect to all numbers of the model."""

    cost: float
    gradient: Array
    hessian: Array
    """J^T J"""


@dataclass(frozen=True, eq=False)
class Rows:
    """The graph of a model's residuals: for each channel the derivatives that are not zero, then the residual."""

    program: Program
    channels: tuple[tuple[Expr, ...], ...]
    active: tuple[tuple[int, ...], ...]
    """For each channel the numbers of the parameters that its derivatives are with respect to."""
    inputs: tuple[Expr, ...]
    parameters: tuple[Expr, ...]

    @property
    def is_compiled(self) -> bool:
        size = len(reachable([row for rows in self.channels for row in rows]))
        return size <= LARGEST_COMPILED


_rows: dict[tuple[Any, ...], Rows] = {}
_kernels: dict[tuple[Any, ...], Callable[..., Any]] = {}
_compiling = threading.Lock()


def rows_of(m: Reflectance, loss: Loss) -> Rows:
    """Traced and differentiated once for each structure and loss."""
    key = (m.structure, loss.name)
    if key not in _rows:
        _rows[key] = _make_rows(m, loss)
    return _rows[key]


def _make_rows(m: Reflectance, loss: Loss) -> Rows:
    program = trace(m)
    graph = program.graph
    inputs = {name: graph.symbol(name) for name in _INPUTS}
    names = [name for full, size in program.parameters for name in component_names(full, size)]
    symbols = [graph.symbol(name) for name in names]
    residuals = [
        inputs[f"root_{c}"] * (loss.scale(output * inputs["wi_z"]) - inputs[f"target_{c}"])
        for c, output in zip("rgb", program.outputs, strict=True)
    ]
    derivatives = [derivative(residuals, symbol) for symbol in symbols]
    zero = graph.constant(0.0)
    active = [tuple(k for k, d in enumerate(derivatives) if d[c] is not zero) for c in range(3)]
    channels = [(*(derivatives[k][c] for k in active[c]), residuals[c]) for c in range(3)]
    return Rows(program, tuple(channels), tuple(active), tuple(inputs.values()), tuple(symbols))


class Equations:
    """The normal equations of one model, loss and set of samples, as a function of the model's numbers."""

    def __init__(self, m: Reflectance, samples: Samples, loss: Loss, real: str = "float32") -> None:
        self._model, self._rows, self._components = m, rows_of(m, loss), components(m)
        self._real = real if self._rows.is_compiled else "float64"
        self._data = np.empty((len(_INPUTS), len(samples)), self._real)
        self._data[:3], self._data[3:6] = samples.wi.T, samples.wo.T
        self._data[6:9] = loss.scale(samples.values * samples.wi[:, 2:]).T
        self._data[9:] = np.sqrt(samples.weight).T
        self.size = 3 * len(samples.wi)

    def __call__(self, numbers: Array) -> Normal:
        """The equations at the model's numbers (P,)."""
        grams = self._compiled(numbers) if self._rows.is_compiled else self._evaluated(numbers)
        total = len(self._components)
        hessian, gradient, cost = np.zeros((total, total)), np.zeros(total), 0.0
        for ids, gram in zip(self._rows.active, grams, strict=True):
            n = len(ids)
            lower = np.tril(gram[:n, :n])
            hessian[np.ix_(ids, ids)] += lower + np.tril(lower, -1).T
            gradient[list(ids)] += gram[n, :n]
            cost += 0.5 * gram[n, n]
        return Normal(float(cost), gradient, hessian)

    def _compiled(self, numbers: Array) -> list[Array]:
        kernel = _kernel(self._rows, self._real)
        most = max(map(len, self._rows.channels))
        count = self._data.shape[1]
        parameters = np.ascontiguousarray(numbers, np.float64)
        textures = [np.ascontiguousarray(texels, np.float32) for texels in self._textures(numbers).values()]

        def run(start: int) -> Array:
            grams = np.zeros((3, most, most))
            kernel(self._data, parameters, *textures, grams, start, min(start + PER_TASK, count))
            return grams

        return list(np.sum(map_threads(run, range(0, count, PER_TASK)), axis=0))

    def _evaluated(self, numbers: Array) -> list[Array]:
        totals = [np.zeros((len(rows), len(rows))) for rows in self._rows.channels]
        for start in range(0, self._data.shape[1], PER_BLOCK):
            for total, rows in zip(totals, self.rows_at(numbers, slice(start, start + PER_BLOCK)), strict=True):
                total += rows @ rows.T
        return totals

    def scores(self, numbers: Array) -> Array:
        """(P, P) products of the samples' gradients, those of a sample's channels taken together."""
        total = len(self._components)
        products = np.zeros((total, total))
        for start in range(0, self._data.shape[1], PER_BLOCK):
            channels = self.rows_at(numbers, slice(start, start + PER_BLOCK))
            gradients = np.zeros((total, channels[0].shape[1]))
            for channel, rows in enumerate(channels):
                gradients[list(self.active(channel))] += rows[:-1] * rows[-1]
            products += gradients @ gradients.T
        return products

    def rows_at(self, numbers: Array, part: slice = slice(None)) -> list[Array]:
        """Each channel's derivatives and, last, its residuals, (n + 1, N), evaluated with NumPy."""
        block = self._data[:, part].astype(np.float64)
        symbols: dict[str, Any] = dict(zip(_INPUTS, block, strict=True))
        symbols |= {c.name: value for c, value in zip(self._components, numbers, strict=True)}
        outputs = [row for rows in self._rows.channels for row in rows]
        flat = iter(evaluate(outputs, symbols, self._textures(numbers)))
        return [np.array([np.broadcast_to(next(flat), block.shape[1:]) for _ in rows]) for rows in self._rows.channels]

    def _textures(self, numbers: Array) -> dict[str, Any]:
        """Those of the model at its numbers, in the order of its program."""
        if not self._rows.program.textures:
            return {}
        made = with_values(self._model, grouped(numbers, self._components)).textures
        return {texture.name: made[texture.name] for texture in self._rows.program.textures}

    def active(self, channel: int) -> Sequence[int]:
        """Which numbers the derivatives of a channel are with respect to, in the order of `rows_at`."""
        return self._rows.active[channel]


def _kernel(rows: Rows, real: str) -> Callable[..., Any]:
    from ..formula.kernels import loaded, stored
    from ..formula.printers.normal_equations import print_normal_equations

    key = (rows, real)
    with _compiling:
        if key not in _kernels:
            source = print_normal_equations(
                rows.program.title, rows.channels, rows.inputs, rows.parameters, rows.program.textures, real
            )
            _kernels[key] = loaded(stored(source))
    return _kernels[key]
