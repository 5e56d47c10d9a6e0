"""Law: the derivatives that fitting uses are those of the formula."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..formula.derivative import derivative
from ..formula.evaluation import evaluate
from ..formula.trace import component_names, parameter_values, trace
from ..geometry.arguments import MIDDLE
from ..reflectance import Reflectance
from .probes import pairs, place
from .result import LawResult, law

PAIRS = 300

STEP = 1e-6
"""Of the differences, relative to the parameter."""

LIMIT = 1e-3
"""Rounding of the differences, which lose half of the digits."""

SHARE = 0.95
"""Share of the pairs that has to agree: within a step the others may cross a kink (a clip, a texel)."""


@law("gradients")
def gradients(reflectance: Reflectance) -> LawResult:
    """The exact derivatives of the formula with respect to its parameters equal differences: central ones, or at a kink
    (the darkest texel of a table lies where negative values are cut off) those of one side.

    `value` is, of the worst parameter, the error below which 95 % of the pairs lie, relative to the derivative (and to
    1e-4 of f over the parameter, where that is more). At a bound, where a formula may have its kink or its root, no
    derivative is promised. Without a formula there is nothing to differentiate.
    """
    if not reflectance.has_formula:
        return LawResult("gradients", True, 0.0, LIMIT, "", "no formula")
    program = trace(reflectance)
    names = [name for full, size in program.parameters for name in component_names(full, size)]
    values = dict(zip(names, parameter_values(reflectance.values), strict=True))
    inputs = {node.value: node for node in program.graph.nodes if node.op == "symbol"}
    wi, wo = pairs(PAIRS)
    symbols: dict[str, Any] = {
        f"{w}_{axis}": d[:, i] for w, d in (("wi", wi), ("wo", wo)) for i, axis in enumerate("xyz")
    }
    symbols |= {f"uv_{axis}": np.full(len(wi), at) for axis, at in zip("xy", MIDDLE, strict=True)} | values
    middle = evaluate(program.outputs, symbols, reflectance.textures)
    worst, note, where = 0.0, "no parameters", ""
    for name in names:
        if name not in inputs:
            continue
        exact, step = derivative(program.outputs, inputs[name]), STEP * max(1e-2, abs(values[name]))
        slopes = evaluate(exact, symbols, reflectance.textures)
        high, low = (
            evaluate(program.outputs, symbols | {name: values[name] + sign * step}, reflectance.textures)
            for sign in (1, -1)
        )
        for slope, above, at_it, below in zip(slopes, high, middle, low, strict=True):
            differences = ((above - below) / 2, above - at_it, at_it - below)
            numeric = np.stack([np.broadcast_to(d / step, len(wi)) for d in differences])
            scale = np.abs(numeric) + 1e-4 * np.abs(above) / max(abs(values[name]), 1e-2) + 1e-7
            error = np.nan_to_num(np.abs(slope - numeric) / scale, nan=np.inf).min(0)
            value = float(np.quantile(error, SHARE, method="lower"))
            if value >= worst:
                worst, note = value, f"worst of {len(inputs)} inputs: {name}"
                at = int(np.argsort(error)[int(SHARE * (len(error) - 1))])
                where = place(wi=wi[at], wo=wo[at])
    return LawResult("gradients", worst <= LIMIT, worst, LIMIT, where, note)
