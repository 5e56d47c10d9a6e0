"""One reflectance of every kind that has a formula, by name: what the languages must agree on."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import brdf
from brdf import ShadingMap, SliceStack, SpatiallyVarying, SphereImages, Table, TwoSided, models
from brdf.combinators import QuarterTurned, Transposed
from brdf.geometry.warps import Circle, listed
from brdf.models import GGX, EnergyCompensated, Lambertian, Microfacet
from brdf.reflectance import Reflectance
from brdf.representations.baking.bake import bake_points
from brdf.representations.neural import SHAPES, NeuralBRDF
from brdf.representations.patches import Patches
from brdf.representations.shading.compression import METHODS
from brdf.representations.spheres.blends import BLENDS
from brdf.representations.storage import STORAGES
from brdf.representations.tables.encoding import Encoding
from brdf.representations.tables.layout import Layout
from brdf.representations.tables.specular import AnisotropicSpecularBasis, SpecularBasis
from mesostructures import ACQUIRED, photographs

RNG = np.random.default_rng(3)
PLASTIC = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha=0.25)
BRUSHED = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha_x=0.25, alpha_y=0.6)
POLAR = (listed(np.radians([0, 10, 30, 50, 80])), listed(np.radians([0, 2, 5, 10, 20, 90, 180])))
SPECULAR = Layout(SpecularBasis(), (*POLAR, listed(np.linspace(0, np.pi, 7))), (5, 7, 7), Encoding())
AROUND = (Circle(), *POLAR, listed(np.linspace(0, 2 * np.pi, 9)))
SPECULAR_TURNED = Layout(AnisotropicSpecularBasis(), AROUND, (6, 5, 7, 9), Encoding())
ALPHA, COLOUR = RNG.uniform(0.05, 0.8, (4, 5)), RNG.uniform(0, 1, (3, 2, 3))
SAMPLE = ShadingMap.from_images(photographs("stone", 24), ACQUIRED)

MODELS: dict[str, Callable[[], Reflectance]] = {
    **{name: models.get(name) for name in models.names()},
    "sharp": lambda: GGX(alpha=0.02),
    "anisotropic": lambda: GGX(alpha_x=0.08, alpha_y=0.4),
    "beckmann, dielectric": lambda: Microfacet(ndf="beckmann", masking="smith-separable", fresnel="dielectric"),
    "conductor": lambda: Microfacet(fresnel="conductor", alpha_x=0.1, alpha_y=0.4),
    "gold-metallic-paint": lambda: brdf.load("gold-metallic-paint"),
    "sum": lambda: 0.5 * Lambertian() + GGX(alpha=0.05),
    "two-sided": lambda: TwoSided(GGX(alpha=0.3), Lambertian(albedo=(0.1, 0.2, 0.3))),
    "turned": lambda: QuarterTurned(GGX(alpha_x=0.08, alpha_y=0.4)),
    "transposed": lambda: Transposed(models.OpenPBR(coat_weight=0.5)),
    "energy compensated": lambda: EnergyCompensated(Microfacet(alpha=0.5)),
    "energy compensated, anisotropic": lambda: EnergyCompensated(Microfacet(alpha_x=0.5, alpha_y=0.2)),
    "varying": lambda: SpatiallyVarying(0.5 * Lambertian() + GGX(), lobe2_alpha=ALPHA, lobe1_base_albedo=COLOUR),
}

TABLES: dict[str, Callable[[], Reflectance]] = {
    **{f"table, {store}": lambda store=store: Table.bake(PLASTIC, shape=(16, 12, 8), storage=store, encoding="sqrt")
       for store in STORAGES},
    **{f"table, {how}": lambda how=how: Table.bake(PLASTIC, shape=(16, 12, 8), filter=how)
       for how in ("nearest", "catmull-rom", "b-spline", "prefiltered-b-spline")},
    **{f"table, {basis}": lambda basis=basis: Table.bake(PLASTIC, basis, "uniform", (12, 12, 8))
       for basis in ("normal", "sheared", "marschner", "stark")},
    "table, half, four axes": lambda: Table.bake(BRUSHED, shape=(6, 10, 8, 6)),
    "table, normal, four axes": lambda: Table.bake(BRUSHED, "normal", "uniform", (6, 8, 8, 6)),
    "slice stack": lambda: SliceStack.bake(PLASTIC, method="points"),
    "slice stack, anisotropic": lambda: SliceStack.bake(BRUSHED, method="points", anisotropic=True),
    **{f"sphere images, {blend}": lambda blend=blend: SphereImages.bake(PLASTIC, size=32, blend=blend)
       for blend in BLENDS},
    "sphere images, bytes": lambda: SphereImages.bake(PLASTIC, size=32, storage="8-8-8", blend="paper"),
    "patches": lambda: Patches(RNG.uniform(0, 1, (9, 9, 3)), np.radians([0, 20, 90]), (1, 8)),
    "neural": lambda: NeuralBRDF({k: RNG.normal(0, 0.3, shape).astype(np.float32) for k, shape in SHAPES.items()}),
    "table, specular": lambda: bake_points(PLASTIC, SPECULAR),
    "table, specular, four axes": lambda: bake_points(BRUSHED, SPECULAR_TURNED),
    "shading map": lambda: SAMPLE,
    "shading map, pca": lambda: SAMPLE.compress(2),
    **{f"shading map, {method}": lambda method=method: SAMPLE.compress(method=method)
       for method in METHODS if method != "pca"},
}  # fmt: skip
