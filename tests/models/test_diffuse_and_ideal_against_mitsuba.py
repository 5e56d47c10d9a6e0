"""Diffuse models, smooth conductors and dielectrics against Mitsuba's: 10,000 random directions each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from brdf.geometry.directions import uniform_hemisphere
from brdf.models import DisneyDiffuse, Lambertian, SmoothConductor, SmoothDielectric

COUNT = 10_000


def directions(seed: int) -> np.ndarray:
    w = uniform_hemisphere(np.random.default_rng(seed).random((COUNT, 2)))
    return w.astype(np.float32).astype(np.float64)  # Mitsuba computes in single precision


def rgb(*values: float) -> dict[str, Any]:
    return {"type": "rgb", "value": list(values)}


def evaluated(mi: Any, scene: dict[str, Any], wi: np.ndarray, wo: np.ndarray) -> np.ndarray:
    """f cos of a Mitsuba material; its incident direction is the viewer's."""
    bsdf, interaction, context = mi.load_dict(scene), mi.SurfaceInteraction3f(), mi.BSDFContext()
    values = np.empty_like(wi)
    for i in range(len(wi)):
        interaction.wi = wo[i].tolist()
        values[i] = np.array(bsdf.eval(context, interaction, wi[i].tolist()))
    return values


def test_lambertian(mi: Any) -> None:
    wi, wo = directions(1), directions(2)
    theirs = evaluated(mi, {"type": "diffuse", "reflectance": rgb(0.2, 0.5, 0.8)}, wi, wo)
    np.testing.assert_allclose(Lambertian(albedo=(0.2, 0.5, 0.8)).f_cos(wi, wo), theirs, rtol=1e-5, atol=1e-7)


@pytest.mark.parametrize("roughness", [0.1, 0.5, 1.0])
def test_disney_diffuse_is_that_of_the_principled_material(mi: Any, roughness: float) -> None:
    wi, wo = directions(3), directions(4)
    scene = {"type": "principled", "base_color": rgb(0.2, 0.5, 0.8), "roughness": roughness, "specular": 0.0}
    ours = DisneyDiffuse(albedo=(0.2, 0.5, 0.8), roughness=roughness).f_cos(wi, wo)
    np.testing.assert_allclose(ours, evaluated(mi, scene, wi, wo), rtol=1e-4, atol=1e-6)


def sampled(mi: Any, scene: dict[str, Any], wo: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, ...]:
    """Directions, weights and probabilities of a Mitsuba material's samples."""
    bsdf, interaction, context = mi.load_dict(scene), mi.SurfaceInteraction3f(), mi.BSDFContext()
    wi, weight, probability = np.empty_like(wo), np.empty_like(wo), np.empty(len(wo))
    for i in range(len(wo)):
        interaction.wi = wo[i].tolist()
        drawn, value = bsdf.sample(context, interaction, float(u[i]), [0.5, 0.5])
        wi[i], weight[i], probability[i] = np.array(drawn.wo), np.array(value), drawn.pdf
    return wi, weight, probability


def test_smooth_conductor(mi: Any) -> None:
    eta, k = (0.2, 0.92, 1.1), (3.91, 2.45, 2.14)
    wo, u = directions(5), np.random.default_rng(6).random((COUNT, 2))
    wi, weight, probability = sampled(mi, {"type": "conductor", "eta": rgb(*eta), "k": rgb(*k)}, wo, u[:, 0])
    ours = SmoothConductor(eta=eta, k=k).sample(wo, u)
    np.testing.assert_allclose(ours.wi, wi, atol=1e-6)
    np.testing.assert_allclose(ours.weight, weight, rtol=1e-4)
    np.testing.assert_allclose(ours.pdf, probability)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("eta", [1.33, 1.5, 0.75])
def test_smooth_dielectric(mi: Any, eta: float, side: int) -> None:
    wo, u = side * directions(7), np.random.default_rng(8).random((COUNT, 2))
    wi, weight, probability = sampled(mi, {"type": "dielectric", "int_ior": eta, "ext_ior": 1.0}, wo, u[:, 0])
    ours = SmoothDielectric(eta=eta).sample(wo, u)
    # near the critical angle single precision loses digits, and it may choose the other event where the number falls on
    # the reflectance
    sine_beyond = np.hypot(wo[:, 0], wo[:, 1]) * (eta if side < 0 else 1 / eta)
    same = (ours.wi[:, 2] * wi[:, 2] > 0) & (np.abs(sine_beyond - 1) > 1e-3)
    assert same.mean() > 0.98
    assert (ours.wi[same, 2] * wo[same, 2] < 0).mean() > 0.1
    np.testing.assert_allclose(ours.wi[same], wi[same], atol=1e-5)
    np.testing.assert_allclose(ours.weight[same], weight[same], rtol=1e-5)
    np.testing.assert_allclose(ours.pdf[same], probability[same], rtol=1e-4, atol=1e-7)
