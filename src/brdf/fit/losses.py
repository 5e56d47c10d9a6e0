"""What a fit makes small: squared differences of f cos(theta_i) on a scale of one's choice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..errors import UnknownNameError
from ..formula import exp, log, maximum
from ..metrics import LOG_OFFSET

DARKEST = 1e-9
"""Below this, f cos counts as this much on the cube-root scale, whose slope is infinite at 0 [1/sr]."""

LOSSES: dict[str, Loss] = {}
"""Every loss over pairs of directions by name; a loss enters by being defined."""


@dataclass(frozen=True)
class Loss:
    """The scale on which values are compared, and the metric of `brdf.metrics` that it makes small."""

    name: str
    metric: str
    """Key of `metrics.METRICS`."""
    scale: Callable[[Any], Any]
    """f cos -> compared value; a formula: for numbers, arrays and traced expressions."""
    slope: Callable[[Any], Any]
    """Derivative of `scale` with respect to f cos."""
    quadratic: bool = False
    """Whether the loss is quadratic in f: then colours are solved for, not searched."""

    def __post_init__(self) -> None:
        LOSSES[self.name] = self


Loss("l2", "cosine-weighted L2", lambda v: v, lambda v: 1.0 + 0.0 * v, quadratic=True)
Loss("log", "log", lambda v: log(1.0 + v), lambda v: 1.0 / (1.0 + v))
Loss(
    "log-relative",
    "log relative",
    lambda v: log(maximum(v, 0.0) + LOG_OFFSET),
    lambda v: 1.0 / (maximum(v, 0.0) + LOG_OFFSET),
)
Loss(
    "cube-root",
    "cube root",
    lambda v: exp(log(maximum(v, DARKEST)) / 3.0),
    lambda v: exp(log(maximum(v, DARKEST)) * (-2.0 / 3.0)) / 3.0,
)


def loss_named(name: str) -> Loss:
    """The loss of that name. Raises UnknownNameError."""
    if name not in LOSSES:
        raise UnknownNameError("metric", name, LOSSES)
    return LOSSES[name]
