"""From what a user asks for to the reflectance whose numbers are fitted."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import models
from ..combinators import add, lobes
from ..combinators.sums import Sum
from ..errors import ParameterError, UnknownNameError
from ..formula.derivative import derivative
from ..formula.evaluation import evaluate
from ..formula.graph import reachable
from ..formula.trace import component_names, parameter_values, trace
from ..loading import load
from ..metrics import direction_pairs
from ..models import Model
from ..models.lambertian import Lambertian
from ..reflectance import Reflectance
from .parameters import with_defaults

MOST_LOBES = 3

FLAT = 20.0
"""A part is diffuse when what it reflects varies by less than this factor."""


def template_of(model: Any, count: int = 1, diffuse: bool | None = None, isotropic: bool = True) -> Reflectance:
    """The reflectance to fit: `count` lobes of a model and a Lambertian part.

    `model` is a class of `brdf.models`, its name, or a reflectance made of models, whose numbers are where a search
    starts; as text also a sum, `Lambertian + GGX`. Each lobe has a scale of its own, unless a colour of the model is
    one. `diffuse`: whether to add the Lambertian part; by default where the model has none. A sum of several models is
    taken as it stands. Raises ParameterError, UnknownNameError.
    """
    base = _resolved(model)
    if count != int(count) or not 1 <= count <= MOST_LOBES:
        raise ParameterError(f"a fit has 1 to {MOST_LOBES} lobes, got {count}")
    if not base.values:
        raise ParameterError(f"{base.name or type(base).__name__} has no parameters to fit")
    if not isinstance(base, Model):
        if count > 1:
            raise ParameterError("lobes are of one model; a sum of several has its own")
        return base
    if not isotropic:
        base = _anisotropic(base)
    usual = with_defaults(base)  # what a model has does not depend on where the search starts
    has_diffuse = _has_diffuse(usual)
    if has_diffuse and count == 1:
        return base
    if has_diffuse and not _has_highlight(usual):
        raise ParameterError(f"{type(base).__name__} is no lobe but a whole or a diffuse material: fit one of it")
    parts = Sum([base] * int(count)) if _has_scale(usual) else lobes(base, int(count))
    wants = diffuse if diffuse is not None else not has_diffuse
    made = add(Lambertian(albedo=0.2), parts) if wants else parts
    children = list(made.children.values())
    return children[0] if len(children) == 1 else made


def most_lobes(model: Any) -> int:
    """How many lobes of a model can be fitted: 3, and 1 of a sum and of what is no lobe. Raises as `template_of`."""
    base = _resolved(model)
    if not isinstance(base, Model):
        return 1
    usual = with_defaults(base)
    return 1 if _has_diffuse(usual) and not _has_highlight(usual) else MOST_LOBES


def _resolved(model: Any) -> Reflectance:
    """The reflectance of what stands for a model."""
    if isinstance(model, type) and issubclass(model, Reflectance):
        made: Reflectance = model()
    elif isinstance(model, Reflectance):
        made = model
    elif isinstance(model, str):
        made = _named(model)
    else:
        raise ParameterError(f"a fit needs a model, its class or its name, got {type(model).__name__}")
    return made


def _named(model: str) -> Reflectance:
    """What `brdf.load` makes of it. Raises UnknownNameError, which offers models where one name alone is given."""
    try:
        return load(model)
    except UnknownNameError:
        if set(model) & set("+*:"):
            raise
        raise UnknownNameError("model", model, models.names(), "see `brdf list models`") from None


def _anisotropic(base: Model) -> Reflectance:
    """With the two followers of a width in the place of their leader, where it has them."""
    changes: dict[str, Any] = {}
    declared = base.declarations()
    for leader in {p.follows for p in declared.values() if p.follows}:
        if leader in base.values:
            changes |= {n: base.values[leader] for n, p in declared.items() if p.follows == leader}
    made: Reflectance = base.replaced(**changes) if changes else base
    return made


def _slopes(base: Reflectance) -> dict[str, tuple[bool, Any]]:
    """For each colour: whether f is a multiple of it, and the derivative (3, N) of each channel by its own number."""
    program = trace(base)
    wi, wo, _ = direction_pairs(8, 6, 8)
    upper = (wi[:, 2] > 0.3) & (wo[:, 2] > 0.3)
    symbols: dict[str, Any] = {
        f"{w}_{axis}": d[upper, i] for w, d in (("wi", wi), ("wo", wo)) for i, axis in enumerate("xyz")
    }
    names = [name for full, size in program.parameters for name in component_names(full, size)]
    symbols |= dict(zip(names, parameter_values(base.values), strict=True))
    found = {}
    for full, size in program.parameters:
        if size != 3:
            continue
        own = component_names(full, 3)
        inputs = [program.graph.symbol(name) for name in own]
        slopes = [derivative(program.outputs, symbol)[k] for k, symbol in enumerate(inputs)]
        is_linear = not set(reachable(slopes)) & set(inputs)
        at_zero = evaluate(program.outputs, symbols | dict.fromkeys(own, 0.0), base.textures)
        is_scale = is_linear and all(np.all(value == 0) for value in at_zero)
        values = [np.broadcast_to(v, upper.sum()) for v in evaluate(slopes, symbols, base.textures)]
        found[full] = (is_scale, np.array(values))
    return found


def _has_scale(base: Reflectance) -> bool:
    return any(is_scale for is_scale, _ in _slopes(base).values())


def _has_diffuse(base: Reflectance) -> bool:
    """Whether one of its colours is that of a part without a highlight."""
    return any(s.min() > 0 and s.max() < FLAT * s.min() for _, s in _slopes(base).values())


def _has_highlight(base: Reflectance) -> bool:
    """Whether its values span more than a diffuse part's."""
    wi, wo, _ = direction_pairs(8, 6, 8)
    values = np.asarray(base(wi, wo))[(wi[:, 2] > 0.3) & (wo[:, 2] > 0.3)]
    return bool(values.max() > FLAT * values.min())
