"""Principled parameters of any reflectance: what most renderers take, by a fit where need be."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..color import LUMINANCE
from ..combinators import QuarterTurned, SpatiallyVarying
from ..errors import ReflectanceError
from ..fit import fit
from ..geometry.directions import from_spherical
from ..models import get as model
from ..reflectance import Reflectance

HELD = ("subsurface", "specular_tint", "sheen", "sheen_tint", "clearcoat", "clearcoat_gloss")
"""Parameters of Disney's model that other principled models mean otherwise: left at their defaults."""

NODES = 64
"""Angles of the half vector, along elevation and azimuth, at which the shape of a highlight is looked at."""

ROUNDING = 1e-9
"""Of sums over a highlight: a difference of less is none."""


class Aligned(NamedTuple):
    """A reflectance whose highlight is no narrower along the tangent than along the bitangent."""

    reflectance: Reflectance
    is_turned: bool
    """Whether it lies turned by 90 degrees."""

    def back(self, m: Reflectance) -> Reflectance:
        """What was fitted to the aligned reflectance, turned back to the given one."""
        return QuarterTurned(m).named(m.name, m.source) if self.is_turned else m


def aligned(m: Reflectance) -> Aligned:
    """`m`, or `m` turned by 90 degrees where its highlight is wider along the bitangent.

    Principled models stretch theirs along the tangent alone; a renderer turns the tangent.
    Raises ReflectanceError as `principled`.
    """
    _require_fittable(m)
    is_turned = not m.isotropic and _is_wider_across(m)
    return Aligned(QuarterTurned(m) if is_turned else m, is_turned)


def _is_wider_across(m: Reflectance) -> bool:
    """By the second moments of the facets, of which there are f(h, h) cos(h)^2 up to a factor: a diffuse part and
    whatever else is round adds as much to both."""
    theta = (math.pi / 2) * ((np.arange(NODES) + 0.5) / NODES)[:, None] ** 2  # highlights are narrow
    h = from_spherical(theta, np.arange(NODES) * (2 * math.pi / NODES))
    facets = np.maximum(m(h, h) @ np.asarray(LUMINANCE), 0) * h[..., 2] ** 2
    area = np.sqrt(theta) * np.sin(theta)
    along, across = (float(np.sum(area * facets * h[..., axis] ** 2)) for axis in (0, 1))
    return across > (1 + ROUNDING) * along


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
