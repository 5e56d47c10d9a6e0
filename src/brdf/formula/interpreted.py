"""A traced formula run node by node on the arrays of a library whose scalars do not mix with our vectors (Dr.Jit).

The graph holds scalar operations alone. What depends on parameters only is computed in NumPy's float64, once.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from .backends import backend_of, is_foreign
from .graph import Expr, reachable
from .textures import lookup
from .trace import AXES, Program, component_names, parameter_values, trace
from .vec import Vec

_OPERATORS: dict[str, Callable[..., Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": operator.truediv,
    "neg": operator.neg,
    "lt": operator.lt,
    "le": operator.le,
    "and": operator.and_,
    "or": operator.or_,
    "not": operator.invert,
}
_programs: dict[tuple[Any, ...], Program] = {}
"""Traced formulas by structure."""


def run(reflectance: Any, wi: Vec, wo: Vec, clamp: bool, uv: Vec | None = None) -> Vec:
    """As `engine.run`: the guarded formula, on components of another library."""
    key = reflectance.structure
    if key not in _programs:
        _programs[key] = trace(reflectance)
    program = _programs[key]
    symbols = {
        f"{name}_{axis}": value for name, w in (("wi", wi), ("wo", wo)) for axis, value in zip(AXES, w, strict=True)
    }
    if uv is not None:
        symbols |= {f"uv_{axis}": value for axis, value in zip(AXES[:2], uv, strict=True)}
    names = [n for name, size in program.parameters for n in component_names(name, size)]
    symbols |= dict(zip(names, parameter_values(reflectance.values), strict=True))
    rgb = Vec(*_evaluated(program, symbols, reflectance.textures))
    backend = backend_of(*wi)
    zero = 0.0 * wi.z
    if not reflectance.transmits:
        lit = (wi.z > 0) & (wo.z > 0)
        rgb = Vec(*(backend.where(lit, component + zero, zero) for component in rgb))
    return Vec(*(backend.maximum(component, zero) for component in rgb)) if clamp else rgb


def _evaluated(program: Program, symbols: Mapping[str, Any], textures: Mapping[str, Any]) -> list[Any]:
    found: dict[Expr, Any] = {}
    with np.errstate(all="ignore"):
        for node in reachable(program.outputs):
            found[node] = _value(node, [found[argument] for argument in node.args], symbols, textures)
    return [found[output] for output in program.outputs]


def _value(node: Expr, arguments: list[Any], symbols: Mapping[str, Any], textures: Mapping[str, Any]) -> Any:
    if node.op == "constant":
        return node.value
    if node.op == "symbol":
        return symbols[node.value]
    if node.op == "channel":
        return arguments[0][node.value]
    backend = backend_of(*arguments)
    if node.op == "texture":
        read = lookup(textures[node.value.name], tuple(arguments), backend, node.value.filter)
        return read if any(map(is_foreign, arguments)) else [float(channel) for channel in read]
    if any(map(is_foreign, arguments)):
        if node.op in _OPERATORS:
            return _OPERATORS[node.op](*arguments)
        return getattr(backend, node.op)(*arguments)
    numbers = [np.bool_(a) if isinstance(a, bool) else np.float64(a) for a in arguments]
    result = _OPERATORS[node.op](*numbers) if node.op in _OPERATORS else getattr(backend, node.op)(*numbers)
    return bool(result) if isinstance(result, np.bool_) else float(result)
