"""Principled parameters of any reflectance: what most renderers take, by a fit where need be."""

from __future__ import annotations

import math

from ..combinators.varying import SpatiallyVarying
from ..errors import ReflectanceError
from ..fit import fit
from ..models import get as model
from ..reflectance import Reflectance

HELD = ("subsurface", "specular_tint", "sheen", "sheen_tint", "clearcoat", "clearcoat_gloss")
"""Parameters of Disney's model that other principled models mean otherwise: left at their defaults."""


def principled(m: Reflectance) -> Reflectance:
    """A Disney model of colour, metalness, specular, roughness and anisotropy alone, nearest to `m`.

    Its masking is that of 2014, which renderers evaluate.
    Raises ReflectanceError for what transmits, mirrors or varies in space.
    """
    _require_fittable(m)
    kind = model("Disney")
    if isinstance(m, kind) and all(getattr(m, name) == getattr(kind(), name) for name in HELD):
        # A fit to the masking of 2012 is nearer in the squared difference and farther in pictures.
        return m if m.masking == "2014" else m.replaced(masking="2014")
    held = HELD if not m.isotropic else (*HELD, "anisotropic")
    return fit(m, kind(masking="2014"), fixed=held, budget="quick", diffuse=False).reflectance


def metallic_roughness(m: Reflectance) -> Reflectance:
    """The glTF material nearest to `m`. Raises ReflectanceError as `principled`."""
    _require_fittable(m)
    kind = model("GltfMetallicRoughness")
    return m if isinstance(m, kind) else fit(m, kind, budget="quick", diffuse=False).reflectance


def index_of(specular: float) -> float:
    """The refractive index whose reflectance at normal incidence is 0.08 specular."""
    root = math.sqrt(0.08 * specular)
    return (1 + root) / (1 - root)


def open_pbr(m: Reflectance) -> Reflectance:
    """The OpenPBR surface without coat and fuzz nearest to `m`; `m` itself where it is one.

    The fit starts from Disney's parameters. Raises ReflectanceError as `principled`.
    """
    _require_fittable(m)
    if isinstance(m, model("OpenPBR")):
        return m
    start = carried_over(principled(m))
    held = [name for name in start.values if name.startswith(("coat_", "fuzz_"))]
    if m.isotropic:
        held.append("specular_roughness_anisotropy")
    return fit(m, start, fixed=held, budget=1, diffuse=False).reflectance


def carried_over(disney: Reflectance) -> Reflectance:
    """Disney's parameters in OpenPBR's: the same widths, index, metalness and colour."""
    row = disney.values
    kept = 1 - 0.9 * float(row["anisotropic"])  # alpha_y / alpha_x in Disney's model
    alpha_x = float(row["roughness"]) ** 2 / math.sqrt(kept)
    return model("OpenPBR")(
        base_color=row["base_color"],
        base_metalness=row["metallic"],
        specular_roughness=min(math.sqrt(alpha_x / math.sqrt(2 / (1 + kept * kept))), 1.0),
        specular_roughness_anisotropy=1 - kept,
        specular_ior=index_of(float(row["specular"])),
    )


def _require_fittable(m: Reflectance) -> None:
    name = m.name or type(m).__name__
    if m.transmits or m.has_delta:
        raise ReflectanceError(f"{name} transmits or mirrors; set the renderer's own glass or mirror by hand")
    if m.varies or isinstance(m, SpatiallyVarying):
        raise ReflectanceError(f"{name} varies in space; give its value at one place, `.at(uv)`")
