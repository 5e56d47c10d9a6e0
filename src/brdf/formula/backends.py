"""What the formula functions mean for each array library.

A backend is a namespace of scalar functions. NumPy is always there; JAX, PyTorch and Dr.Jit are met only when the
caller passes their arrays: then they are imported already, and we never import them on our own account.
"""

from __future__ import annotations

import functools
import importlib
import math
from types import SimpleNamespace
from typing import Any

import numpy as np

_SAME_NAME_EVERYWHERE = (
    "sqrt",
    "exp",
    "log",
    "sin",
    "cos",
    "tan",
    "floor",
    "sign",
    "abs",
    "minimum",
    "maximum",
)
_TORCH_NAMES = ("asin", "acos", "atan", "atan2", "pow", "where", "erf")


@functools.cache
def _numpy() -> SimpleNamespace:
    return SimpleNamespace(
        **{name: getattr(np, name) for name in _SAME_NAME_EVERYWHERE},
        asin=np.arcsin,
        acos=np.arccos,
        atan=np.arctan,
        atan2=np.arctan2,
        pow=np.power,
        where=np.where,
        erf=_numpy_erf,
        integer=lambda a: np.asarray(a, np.intp),
        gather=lambda rows, index: np.moveaxis(rows[index], -1, 0),
        stack=lambda parts: np.stack(np.broadcast_arrays(*parts), axis=-1),
    )


def _numpy_erf(x: Any) -> Any:
    special: Any = importlib.import_module("scipy.special")
    return special.erf(x)


@functools.cache
def _jax() -> SimpleNamespace:
    jax: Any = importlib.import_module("jax")
    jnp: Any = importlib.import_module("jax.numpy")
    return SimpleNamespace(
        **{name: getattr(jnp, name) for name in _SAME_NAME_EVERYWHERE},
        asin=jnp.arcsin,
        acos=jnp.arccos,
        atan=jnp.arctan,
        atan2=jnp.arctan2,
        pow=jnp.power,
        where=jnp.where,
        erf=jax.scipy.special.erf,
        integer=lambda a: jnp.asarray(a, int),
        gather=lambda rows, index: jnp.moveaxis(jnp.asarray(rows)[index], -1, 0),
        stack=lambda parts: jnp.stack(jnp.broadcast_arrays(*parts), axis=-1),
    )


@functools.cache
def _torch() -> SimpleNamespace:
    torch: Any = importlib.import_module("torch")

    def lifted(function: Any) -> Any:
        """Torch functions want tensors throughout; formulas mix in plain numbers."""

        def call(*arguments: Any) -> Any:
            floats = (a.dtype for a in arguments if isinstance(a, torch.Tensor) and a.is_floating_point())
            dtype = next(floats, torch.float64)
            return function(*(a if isinstance(a, torch.Tensor) else torch.as_tensor(a, dtype=dtype) for a in arguments))

        return call

    return SimpleNamespace(
        **{name: lifted(getattr(torch, name)) for name in _SAME_NAME_EVERYWHERE + _TORCH_NAMES},
        integer=lambda a: a.long(),
        gather=lambda rows, index: torch.moveaxis(torch.as_tensor(rows)[index], -1, 0),
        stack=lambda parts: torch.stack(torch.broadcast_tensors(*parts), dim=-1),
    )


@functools.cache
def _drjit() -> SimpleNamespace:
    dr: Any = importlib.import_module("drjit")

    def gather(rows: Any, index: Any) -> list[Any]:
        number = dr.float32_array_t(index)
        return [dr.gather(number, number(np.ascontiguousarray(column, np.float32)), index) for column in rows.T]

    return SimpleNamespace(
        **{name: getattr(dr, name) for name in _SAME_NAME_EVERYWHERE},
        asin=dr.asin,
        acos=dr.acos,
        atan=dr.atan,
        atan2=dr.atan2,
        pow=dr.power,
        where=dr.select,
        erf=dr.erf,
        integer=lambda a: dr.uint32_array_t(a)(a),
        gather=gather,
    )


_BACKENDS = {"jax": _jax, "jaxlib": _jax, "torch": _torch, "drjit": _drjit, "mitsuba": _drjit}


def backend_of(*values: Any) -> SimpleNamespace:
    """The backend of the first value that belongs to one; plain numbers and NumPy arrays belong to NumPy."""
    for value in values:
        make = _BACKENDS.get(type(value).__module__.partition(".")[0])
        if make is not None:
            return make()
    return _numpy()


def is_foreign(value: Any) -> bool:
    """Whether the value is an array of a library other than NumPy."""
    return type(value).__module__.partition(".")[0] in _BACKENDS


pi = math.pi
