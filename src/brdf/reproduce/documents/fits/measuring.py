"""The stand-ins for the measurements, and the errors of published and of our own fits."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .... import materials
from ....fit import Samples, fit
from ....fit.losses import LOSSES
from ....fit.multistart import stratified
from ....fit.parameters import with_defaults
from ....geometry.directions import to_half_difference
from ....metrics import METRICS, direction_pairs
from ....reflectance import Reflectance
from ....render.progress import Progress
from .settings import Settings

GRAZING = 80.0
"""Degrees from the normal, as in the paper."""

METRIC = "cosine-weighted L2"
"""The paper's."""

WEIGHTS = "merl/merl_nbrdf_weights.npz"
"""Below the folder that BRDF_DATA names."""

SEED = 3

Array = NDArray[Any]


@dataclass(frozen=True)
class Score:
    """One published row on one material, and our fit of the same model."""

    material: str
    fit: str
    published: dict[str, float]
    """By metric."""
    ours: dict[str, float] | None
    """None where it was not fitted."""


def network_weights() -> Mapping[str, Array] | None:
    """The weights of the networks by MATERIAL/LAYER, where they are at hand."""
    folder = os.environ.get("BRDF_DATA")
    if not folder or not (Path(folder) / WEIGHTS).is_file():
        return None
    with np.load(Path(folder) / WEIGHTS, allow_pickle=False) as file:
        return dict(file)


def network(weights: Mapping[str, Array], name: str, wi: Array, wo: Array) -> Array:
    """(N, 3) values [1/sr] of a material's network, whose inputs are half and difference vector at phi_h = 0.

    Reference: Sztrajman2021.
    """
    angles = to_half_difference(wi, wo)
    phi_d = np.mod(angles.phi_d, math.pi)  # trained on MERL's half turn
    sine = np.sin(angles.theta_d)
    half = [np.sin(angles.theta_h), np.zeros(len(wi)), np.cos(angles.theta_h)]
    x = np.stack([*half, sine * np.cos(phi_d), sine * np.sin(phi_d), np.cos(angles.theta_d)], -1)
    for layer in (1, 2):
        x = np.maximum(x @ weights[f"{name}/fc{layer}"] + weights[f"{name}/b{layer}"], 0)
    return np.asarray(np.maximum(np.expm1(x @ weights[f"{name}/fc3"] + weights[f"{name}/b3"]), 0))


def chosen(weights: Mapping[str, Array], count: int | None) -> list[str]:
    """Names of materials that have a network, spread over the alphabet."""
    return _spread(sorted({key.partition("/")[0] for key in weights} & set(materials.names())), count)


def _spread(names: list[str], count: int | None) -> list[str]:
    if count is None or count >= len(names):
        return names
    return [names[i * len(names) // count] for i in range(count)]


def samples(weights: Mapping[str, Array], name: str, settings: Settings) -> Samples:
    """A material's stand-in at stratified pairs."""
    wi, wo, weight = direction_pairs(polar=64, difference=32, azimuth=48)
    everything = Samples.of(wi, wo, network(weights, name, wi, wo), weight, GRAZING, name, "NBRDF network")
    return stratified(everything, LOSSES["l2"], settings.pairs, SEED)


def measured(weights: Mapping[str, Array], settings: Settings) -> list[Score]:
    """Every published row of the chosen materials; ours for as many as the settings say."""
    names = chosen(weights, settings.materials)
    fitted = set(_spread(names, settings.fitted))
    scores = []
    with Progress("published fits and ours", len(names), None) as bar:
        for name in names:
            some = samples(weights, name, settings)
            for published in materials.fits(name):
                m = materials.get(name, published)
                ours = None
                if name in fitted:
                    ours = _errors(some, fit(some, with_defaults(m), budget=settings.starts).reflectance)
                scores.append(Score(name, published, _errors(some, m), ours))
            bar.step()
    return scores


def _errors(some: Samples, m: Reflectance) -> dict[str, float]:
    cosine = some.wi[:, 2:].astype(np.float64)
    weight = some.weight.mean(1)
    values = some.values * cosine, np.asarray(m(some.wi, some.wo), np.float64) * cosine
    return {name: metric(*values, weight / weight.sum()) for name, metric in METRICS.items()}
