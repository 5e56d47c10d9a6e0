"""Production models against Mitsuba where the definitions coincide, and against their own promises where not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from brdf.combinators import SpatiallyVarying
from brdf.geometry.directions import from_spherical
from brdf.geometry.quadrature import half_vector_rule, hemisphere_rule
from brdf.models import CharlieSheen, Disney, GltfMetallicRoughness, Microfacet, OpenPBR
from brdf.models.sheen import charlie_lambda
from brdf.models.terms.layer_albedo import dielectric_albedo
from brdf.reflectance import Reflectance
from lobes import direction, random_pairs

BLUE = ((0.1152 * 0.5 - 0.0278 * 0.8) / 0.0874, 0.5, 0.8)
"""A colour of one luminance by Disney's weights (0.3, 0.6, 0.1) and by Rec. 709's, which Mitsuba takes."""


def pairs(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Single-precision directions; nearer the horizon than 3 degrees, single precision costs Mitsuba a digit."""
    wi, wo = (w.astype(np.float32).astype(np.float64) for w in random_pairs(n))
    above = (wi[:, 2] > 0.05) & (wo[:, 2] > 0.05)
    return wi[above], wo[above]


def f_cos(mi: Any, description: dict[str, Any], wi: np.ndarray, wo: np.ndarray) -> np.ndarray:
    bsdf = mi.load_dict(description)
    interaction, context = mi.SurfaceInteraction3f(), mi.BSDFContext()
    values = np.empty_like(wi)
    for i in range(len(wi)):
        interaction.wi = wo[i].tolist()
        values[i] = np.array(bsdf.eval(context, interaction, wi[i].tolist()))
    return values


@pytest.mark.parametrize(
    "values",
    [
        {"metallic": 1.0, "roughness": 0.25},
        {"metallic": 0.3, "sheen": 0.7, "sheen_tint": 0.2},
        {"subsurface": 0.6, "sheen": 1.0, "sheen_tint": 1.0},
        {"anisotropic": 0.8, "roughness": 0.3, "metallic": 0.5},
        {"roughness": 0.9, "specular": 1.0},
    ],
    ids=repr,
)
def test_disney_equals_mitsuba_where_both_mean_the_same(mi: Any, values: dict[str, float]) -> None:
    # Mitsuba takes Schlick's curve for the tinted part alone, and its clearcoat lacks 1 / (4 cos cos)
    ours = Disney(base_color=BLUE, masking="2014", specular_tint=1.0, **values)
    theirs = {"roughness": 0.5, "sheen_tint": 0.5, "specular": 0.5, "spec_tint": 1.0, **values}
    theirs["flatness"] = theirs.pop("subsurface", 0.0)
    theirs |= {"type": "principled", "base_color": {"type": "rgb", "value": BLUE}}
    wi, wo = pairs(14_000)
    assert len(wi) > 9_900
    np.testing.assert_allclose(ours.f_cos(wi, wo), f_cos(mi, theirs, wi, wo), rtol=1e-4, atol=1e-6)


def albedo(m: Reflectance, theta: float) -> np.ndarray:
    wo = direction(theta, 20.0)
    rule = half_vector_rule(wo, 200, 72)
    return np.einsum("nc,n->c", m(rule.directions, wo), rule.directions[:, 2] * rule.weights)


def test_clearcoat_is_a_gtr1_lobe() -> None:
    plain, coated = (Disney(base_color=0.0, specular=0.0, clearcoat=c, clearcoat_gloss=0.5) for c in (0.0, 1.0))
    # alpha = 0.0505, G of width 0.25, F0 = 0.04, all times 1/4
    lobe = Microfacet(ndf="gtr", gamma=1.0, alpha=0.0505, masking="implicit", F0=0.04)
    wi, wo = random_pairs(500)
    G = 1.0
    for w in (wi, wo):
        G = G * 2 / (w[:, 2] + np.sqrt(w[:, 2] ** 2 + 0.0625 * (1 - w[:, 2] ** 2)))
    np.testing.assert_allclose(coated(wi, wo) - plain(wi, wo), 0.25 * lobe(wi, wo) * G[:, None], rtol=1e-7, atol=1e-12)


def test_the_masking_of_2012_is_wider() -> None:
    wi, wo = direction(80.0), direction(75.0, 180.0)
    assert Disney(metallic=1.0, masking="2012")(wi, wo)[0] < Disney(metallic=1.0, masking="2014")(wi, wo)[0]
    np.testing.assert_allclose(
        Disney(metallic=1.0, roughness=1.0, masking="2012")(wi, wo), Disney(metallic=1.0, roughness=1.0)(wi, wo)
    )


def test_gltf_metal_is_a_ggx_lobe_and_its_dielectric_a_mix() -> None:
    wi, wo = random_pairs(500)
    color = (0.9, 0.5, 0.2)
    metal = GltfMetallicRoughness(base_color=color, roughness=0.6)(wi, wo)
    np.testing.assert_allclose(metal, Microfacet(alpha=0.36, F0=color)(wi, wo), rtol=1e-12)
    F = 0.04 + 0.96 * (1 - np.linalg.norm(wi + wo, axis=1) / 2) ** 5
    expected = (1 - F[:, None]) * np.array(color) / np.pi + Microfacet(alpha=0.36, F0=0.04)(wi, wo)
    plastic = GltfMetallicRoughness(base_color=color, roughness=0.6, metallic=0.0)(wi, wo)
    np.testing.assert_allclose(plastic, expected, rtol=1e-9)


def test_a_smooth_white_gltf_dielectric_gains_light() -> None:
    assert albedo(GltfMetallicRoughness(metallic=0.0, roughness=0.3), 88.0)[0] > 1.2


@pytest.mark.parametrize("roughness", [0.1, 0.3, 0.7, 1.0])
def test_fitted_masking_of_sheen_follows_the_integral(roughness: float) -> None:
    rule = hemisphere_rule(200, 64)
    sine = np.sqrt(1 - rule.directions[:, 2] ** 2)
    D = (2 + 1 / roughness) * sine ** (1 / roughness) / (2 * np.pi)
    assert np.sum(D * rule.directions[:, 2] * rule.weights) == pytest.approx(1, rel=1e-6)
    for theta in (60.0, 80.0, 88.0):
        w = direction(theta)
        area = np.sum(D * np.maximum(rule.directions @ w, 0) * rule.weights)
        assert charlie_lambda(w[2], roughness) == pytest.approx(area / w[2] - 1, rel=0.17)


def test_sheen_glows_at_grazing_angles_and_never_beyond_what_arrives() -> None:
    for roughness in (0.1, 0.3, 1.0):
        m = CharlieSheen(color=1.0, roughness=roughness)
        assert albedo(m, 0.0)[0] < 0.5 * albedo(m, 80.0)[0]
        assert max(albedo(m, theta)[0] for theta in (60.0, 88.0, 89.5)) < 1


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"specular_roughness": 0.05, "base_diffuse_roughness": 1.0},
        {"coat_weight": 1.0},
        {"coat_weight": 0.5, "coat_roughness": 0.5, "fuzz_weight": 1.0},
    ],
    ids=repr,
)
def test_a_white_openpbr_surface_passes_the_furnace(values: dict[str, float]) -> None:
    m = OpenPBR(base_color=1.0, **values)
    for theta in (0.0, 60.0, 85.0):
        np.testing.assert_allclose(albedo(m, theta), 1, atol=2e-3)


@pytest.mark.parametrize("color", [0.1, 0.57, 0.95])
def test_the_f82_curve_of_a_black_tint_stays_above_zero(color: float) -> None:
    wi = from_spherical(
        np.radians(np.linspace(60, 89.9, 300)), np.array(0.0)
    )  # about 82 degrees, where the tint makes it touch zero
    metal = OpenPBR(base_metalness=1.0, base_color=color, specular_color=0.0)
    assert metal.raw(wi, wi * [-1, -1, 1]).min() >= 0


ALBEDOS = [(0.9, 0.03, 1.5), (0.3, 0.3, 1.3), (0.05, 0.8, 2.5), (0.6, 0.001, 1.05), (0.12, 0.1, 3.0)]
"""Cosine, alpha, index."""


@pytest.mark.parametrize(("cosine", "alpha", "eta"), ALBEDOS)
def test_openpbr_layers_by_the_albedos_of_its_lobes(cosine: float, alpha: float, eta: float) -> None:
    """Between the nodes of its table, against the same lobe as a model of its own."""
    lobe = Microfacet(alpha=alpha, fresnel="dielectric", eta=eta)
    expected = albedo(lobe, float(np.degrees(np.arccos(cosine))))[0]
    root = (eta - 1) / (eta + 1)
    table = dielectric_albedo()[..., 0]
    between_nodes = RegularGridInterpolator([np.linspace(0, 1, n) for n in table.shape], table)
    where = [np.sqrt(cosine), (np.sqrt(alpha) - np.sqrt(1e-3)) / (1 - np.sqrt(1e-3)), 2 * root]
    assert abs(between_nodes(where)[0] - expected) < 3e-3


def test_the_tables_of_openpbr_do_not_follow_its_numbers() -> None:
    """So that they stay right under a slider, and where a number varies over a surface."""
    image = np.array([[0.2, 0.8]])
    m = SpatiallyVarying(OpenPBR(coat_weight=0.4), specular_roughness=image, specular_ior=1 + image)
    wi, wo = random_pairs(50)
    place = np.broadcast_to([0.75, 0.5], (50, 2))
    right = OpenPBR(coat_weight=0.4, specular_roughness=0.8, specular_ior=1.8)
    np.testing.assert_allclose(m(wi, wo, uv=place), right(wi, wo), rtol=1e-6)


def test_openpbr_layers() -> None:
    wi, wo = random_pairs(300)
    metal = OpenPBR(base_metalness=1.0, base_color=(0.9, 0.6, 0.3), specular_roughness=0.5)
    np.testing.assert_allclose(metal(wi, wo), Microfacet(alpha=0.25, F0=(0.9, 0.6, 0.3))(wi, wo), rtol=1e-9)
    bare = OpenPBR(base_weight=0.0, specular_roughness=0.4, specular_ior=1.7)
    np.testing.assert_allclose(
        bare(wi, wo), Microfacet(alpha=0.16, fresnel="dielectric", eta=1.7)(wi, wo), rtol=1e-9, atol=1e-12
    )
    # F82: at 1 / 7 the tint multiplies Schlick's value
    h = np.arccos(1 / 7)
    pair = direction(np.degrees(h)), direction(np.degrees(h), 180.0)
    tinted = metal.replaced(specular_color=0.25)
    np.testing.assert_allclose(tinted(*pair), 0.25 * metal(*pair), rtol=1e-9)
    half = bare.replaced(specular_weight=0.5)
    np.testing.assert_allclose(half(direction(0), direction(0)), 0.5 * bare(direction(0), direction(0)), rtol=1e-9)
    dark, light = (OpenPBR(base_color=0.5, coat_weight=1.0, coat_darkening=d) for d in (1.0, 0.0))
    assert albedo(dark, 30.0)[0] < 0.8 * albedo(light, 30.0)[0]
    red = OpenPBR(base_color=1.0, coat_weight=1.0, coat_color=(1.0, 0.1, 0.1))
    assert albedo(red, 0.0)[1] < 0.2 < 0.9 < albedo(red, 0.0)[0]
