"""Any reflectance as a BSDF of Mitsuba 3: its formula, called with Mitsuba's arrays.

    import mitsuba as mi
    from brdf.export import mitsuba

    mitsuba.set_variant("llvm_ad_rgb")           # finds LLVM first; "scalar_rgb" needs none and is slow
    bsdf = mitsuba.bsdf(brdf.load("chrome"))      # or, in a dictionary or XML file:
    mi.load_dict({"type": "brdf", "material": "chrome"})

The values are those of the reflectance, exactly. Directions are drawn from a mixture of a cosine and a GGX lobe that is
chosen for the reflectance, so that any of them renders without bias. One-sided; wrap it in `twosided` if need be.
"""

from __future__ import annotations

import itertools
from typing import Any, NamedTuple

import numpy as np

from ..color import LUMINANCE
from ..errors import MissingExtraError, ParameterError, ReflectanceError
from ..geometry.quadrature import replicated_points
from ..geometry.sampling import CosineSampler, GGXSampler
from ..loading import load
from ..reflectance import Reflectance
from .llvm import require_llvm

PLUGIN = "brdf"
"""The type by which scenes name it."""

ALPHAS = tuple(np.geomspace(0.005, 0.7, 12).tolist())
SHARES = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Of the GGX lobe in the mixture."""

_handed: dict[str, Reflectance] = {}
"""Reflectances that `bsdf` hands to its plug-in, by the name it gives them."""
_numbers = itertools.count()


def set_variant(variant: str) -> Any:
    """Set Mitsuba's variant and make the plug-in known in it; returns the module `mitsuba`.

    Variants of LLVM need its library, version 19 or newer: it is looked for first, since with an older one the process
    would end. Raises MissingExtraError, ParameterError for an unknown variant or where no LLVM is found.
    """
    try:
        import mitsuba as mi
    except ImportError:
        raise MissingExtraError("rendering with Mitsuba", "mitsuba") from None
    if variant not in mi.variants():
        raise ParameterError(f"Mitsuba has no variant {variant!r}; it has {', '.join(mi.variants())}")
    if variant.startswith("llvm"):
        require_llvm()
    mi.set_variant(variant)
    register()
    return mi


def register() -> None:
    """Make the plug-in known in Mitsuba's present variant, which must be one of RGB or luminance.

    Raises ParameterError for a spectral or polarised variant, or none.
    """
    import mitsuba as mi

    variant = mi.variant() or ""
    if not variant.endswith(("_rgb", "_mono")):
        raise ParameterError(
            f"the plug-in needs a variant of RGB or luminance, not {variant or 'none'!r}; set one first"
        )
    mi.register_bsdf(PLUGIN, _plugin_class(mi))


def bsdf(m: Reflectance) -> Any:
    """`m` as a BSDF of Mitsuba's present variant. Raises ReflectanceError for what the plug-in cannot be."""
    import mitsuba as mi

    register()
    name = f"#{next(_numbers)}"
    _handed[name] = m
    try:
        return mi.load_dict({"type": PLUGIN, "material": name})
    finally:
        del _handed[name]


class Proposal(NamedTuple):
    """A mixture to draw directions from."""

    alpha: float
    share: float
    """of the GGX lobe; the rest is a cosine"""


def proposal(m: Reflectance) -> Proposal:
    """The mixture with the least second moment of the weights, over three viewing angles.

    It is estimated from samples of the reflectance's own sampler, which misses no part of it.
    """
    points = replicated_points(2048).reshape(-1, 2)
    cosines = (0.98, 0.7, 0.25)
    totals = np.zeros((len(ALPHAS), len(SHARES)))
    for cosine in cosines:
        wo = np.broadcast_to([np.sqrt(1 - cosine**2), 0.0, cosine], (len(points), 3))
        drawn = m.sample(wo, points)
        used = drawn.pdf > 0
        wi, weight, density = drawn.wi[used], drawn.weight[used] @ np.asarray(LUMINANCE), drawn.pdf[used]
        if not weight.any():
            continue
        diffuse = CosineSampler().pdf(wi, wo[used])
        for i, alpha in enumerate(ALPHAS):
            lobe = GGXSampler(alpha, alpha).pdf(wi, wo[used])
            for j, share in enumerate(SHARES):
                mixed = share * lobe + (1 - share) * diffuse
                totals[i, j] += np.mean(weight**2 * density / np.maximum(mixed, 1e-12)) / weight.mean() ** 2
    alpha, share = divmod(int(np.argmin(totals)), len(SHARES))
    return Proposal(ALPHAS[alpha], SHARES[share])


def require_plain(m: Reflectance) -> None:
    """Raises ReflectanceError for what the plug-in cannot evaluate."""
    name = m.name or type(m).__name__
    if m.transmits or m.has_delta:
        raise ReflectanceError(f"{name} transmits or mirrors; take Mitsuba's own dielectric or conductor")
    if m.varies:
        raise ReflectanceError(f"{name} varies in space; give its value at one place, `.at(uv)`")
    if not m.has_formula:
        raise ReflectanceError(f"{name} has no formula; write it as an RGL file, which Mitsuba's `measured` reads")


def _plugin_class(mi: Any) -> Any:
    """The class for the present variant, whose types are its own."""
    import drjit as dr

    is_mono, is_scalar = mi.variant().endswith("_mono"), mi.variant().startswith("scalar")

    class BRDF(mi.BSDF):  # type: ignore[misc]
        """A reflectance of the package `brdf`."""

        def __init__(self, props: Any) -> None:
            mi.BSDF.__init__(self, props)
            given = str(props["material"])
            self.reflectance = _handed[given] if given in _handed else load(given)
            require_plain(self.reflectance)
            self.proposal = proposal(self.reflectance)
            flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
            if not self.reflectance.isotropic:
                flags |= mi.BSDFFlags.Anisotropic
            self.m_components, self.m_flags = [flags], flags

        def _lobe(self) -> Any:
            alpha = self.proposal.alpha
            return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, alpha, True)

        def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
            lobe, share = self._lobe(), self.proposal.share
            half, _ = lobe.sample(si.wi, sample2)
            glossy, diffuse = mi.reflect(si.wi, half), mi.warp.square_to_cosine_hemisphere(sample2)
            wo = dr.select(sample1 < share, glossy, diffuse)
            bs = mi.BSDFSample3f()
            bs.wo, bs.pdf, bs.eta = wo, self.pdf(ctx, si, wo, active), 1.0
            bs.sampled_type, bs.sampled_component = mi.UInt32(+mi.BSDFFlags.GlossyReflection), mi.UInt32(0)
            usable = bs.pdf > 0
            value = self.eval(ctx, si, wo, active)
            return bs, dr.select(usable, value / dr.select(usable, bs.pdf, 1.0), 0.0 * value)

        def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            wi = si.wi
            rgb = _scalar_rgb(self.reflectance, wo, wi) if is_scalar else self.reflectance(wo, wi)
            cosine = mi.Frame3f.cos_theta(wo)
            lit = active & (cosine > 0) & (mi.Frame3f.cos_theta(wi) > 0)
            r, g, b = rgb[0], rgb[1], rgb[2]
            value = mi.luminance(mi.Color3f(r, g, b)) if is_mono else mi.Spectrum(r, g, b)
            return dr.select(lit, value * cosine, 0.0 * value)

        def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            wi = si.wi
            above = active & (mi.Frame3f.cos_theta(wo) > 0) & (mi.Frame3f.cos_theta(wi) > 0)
            half = dr.normalize(wo + wi)
            glossy = self._lobe().pdf(wi, half) / (4 * dr.dot(wo, half))
            share = self.proposal.share
            mixed = share * glossy + (1 - share) * mi.warp.square_to_cosine_hemisphere_pdf(wo)
            return dr.select(above, mixed, 0.0 * mixed)

        def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

        def to_string(self) -> str:
            return f"BRDF[{self.reflectance.name or type(self.reflectance).__name__}]"

    return BRDF


def _scalar_rgb(m: Reflectance, wi: Any, wo: Any) -> list[float]:
    """One pair, in the scalar variants."""
    pair = [np.array([[w[0], w[1], w[2]]], np.float64) for w in (wi, wo)]
    return [float(x) for x in m(*pair)[0]]
