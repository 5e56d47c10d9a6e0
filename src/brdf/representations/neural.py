"""A reflectance as a small neural network, whose weights are published for many measured materials."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..formula import Scalar, Vec, exp, length, maximum, sqrt, where
from ..reflectance import Reflectance

WIDTH = 21
"""Neurons of each hidden layer."""

SHAPES = {"fc1": (6, WIDTH), "b1": (WIDTH,), "fc2": (WIDTH, WIDTH), "b2": (WIDTH,), "fc3": (WIDTH, 3), "b3": (3,)}
"""The published arrays: weights by input and output, biases."""

_TINY = 1e-9
"""Keeps the azimuth about the half vector defined where half vector and normal coincide."""


class NeuralBRDF(Reflectance):
    """The half vector and the difference vector through two hidden layers.

        f(wi, wo) = max(0, exp(relu(relu(x W1 + b1) W2 + b2) W3 + b3) - 1)      [1/sr]
        x = (sin theta_h, 0, cos theta_h, d),   d = (sin theta_d cos phi_d, sin theta_d sin phi_d, cos theta_d)

    675 weights. phi_d is folded to half a turn, which makes it reciprocal. Reference: Sztrajman2021.
    """

    breaks: ClassVar[Mapping[str, str]] = {
        "energy": "the network is fitted to values, not to their integral [Sztrajman2021]"
    }

    def __init__(self, weights: Mapping[str, ArrayLike]) -> None:
        """`weights`: the arrays of `SHAPES` by name. Raises ValueError."""
        self.weights: dict[str, NDArray[np.float32]] = {}
        for name, shape in SHAPES.items():
            if name not in weights:
                raise ValueError(f"weights {name!r} are missing")
            array = np.asarray(weights[name])
            if array.shape != shape or array.dtype.kind != "f" or not np.isfinite(array).all():
                raise ValueError(f"weights {name!r} must be {shape} finite numbers, got {array.shape} {array.dtype}")
            self.weights[name] = array.astype(np.float32)
        if not np.isfinite(np.concatenate([a.ravel() for a in self.weights.values()])).all():
            raise ValueError("weights must fit single precision")
        packed = np.concatenate([self.weights[name].ravel() for name in SHAPES]).reshape(-1, 3)
        self._values = {f"w{i}": row.astype(np.float64) for i, row in enumerate(packed)}

    @property
    def structure(self) -> tuple[Any, ...]:
        return (NeuralBRDF,)

    @property
    def values(self) -> Mapping[str, Any]:
        """The weights in the order of `SHAPES`, three to a value."""
        return self._values

    def f(self, wi: Vec, wo: Vec) -> Vec:
        flat = [component for i in range(len(self._values)) for component in getattr(self, f"w{i}").components]
        inputs = half_and_difference(wi, wo)
        layer, start = inputs, 0
        for last, (rows, columns) in ((False, SHAPES["fc1"]), (False, SHAPES["fc2"]), (True, SHAPES["fc3"])):
            matrix, start = flat[start : start + rows * columns], start + rows * columns
            bias, start = flat[start : start + columns], start + columns
            layer = [_neuron(layer, matrix[column::columns], bias[column], last) for column in range(columns)]
        return Vec(*(maximum(exp(value) - 1.0, 0.0) for value in layer))

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {}, dict(self.weights)

    @classmethod
    def _restore(cls, header: Any, arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        return cls(arrays)

    def __repr__(self) -> str:
        return f"NeuralBRDF({self.name!r})"


def half_and_difference(wi: Vec, wo: Vec) -> list[Scalar]:
    """The formula: the six inputs. The difference vector is the light in the frame of the half vector, its y >= 0."""
    total = wi + wo
    norm = length(total)
    sine, cosine = sqrt(total.x * total.x + total.y * total.y) / norm, total.z / norm
    d = wi - wo
    tangential = maximum(sine * norm, _TINY)
    # half the difference in the frame (towards larger theta_h, across, half vector)
    along = -0.5 * d.z / maximum(sine, _TINY)
    across = 0.5 * (total.x * d.y - total.y * d.x) / tangential
    along = where(across < 0.0, -along, along)
    across = where(across < 0.0, -across, across)
    return [sine, 0.0, cosine, along, across, 0.5 * norm]


def _neuron(inputs: list[Scalar], weights: list[Scalar], bias: Scalar, is_last: bool) -> Scalar:
    total = bias
    for value, weight in zip(inputs, weights, strict=True):
        total = total + value * weight if not (isinstance(value, float) and value == 0.0) else total
    return total if is_last else maximum(total, 0.0)
