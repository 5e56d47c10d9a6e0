"""The stand-ins for the measurements, and the errors of published and of our own fits."""

from __future__ import annotations

import functools
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
from ....metrics import METRICS, direction_pairs, relative_rmse_of
from ....metrics.surroundings import lit_from_all_around
from ....reflectance import Reflectance
from ....render.progress import Progress
from ....representations.neural import SHAPES, NeuralBRDF
from .settings import Settings

GRAZING = 80.0
"""Degrees from the normal, as in the paper."""

METRIC = "cosine-weighted L2"
"""The paper's."""

AROUND = "lit all around"
"""The one that `brdf compare` ranks by: relative RMSE of pictures of a sphere, `brdf.metrics.surroundings`."""

EVERY = (*METRICS, AROUND)

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
    """By metric, see `EVERY`."""
    ours: dict[str, float] | None
    """None where it was not fitted."""


def network_weights() -> Mapping[str, Array] | None:
    """The weights of the networks by MATERIAL/LAYER, where they are at hand."""
    folder = os.environ.get("BRDF_DATA")
    if not folder or not (Path(folder) / WEIGHTS).is_file():
        return None
    with np.load(Path(folder) / WEIGHTS, allow_pickle=False) as file:
        return dict(file)


def network(weights: Mapping[str, Array], name: str) -> NeuralBRDF:
    """A material's network."""
    made = NeuralBRDF({layer: weights[f"{name}/{layer}"] for layer in SHAPES})
    return made.named(name, "NBRDF network")


def chosen(weights: Mapping[str, Array], count: int | None) -> list[str]:
    """Names of materials that have a network, spread over the alphabet."""
    return _spread(sorted({key.partition("/")[0] for key in weights} & set(materials.names())), count)


def _spread(names: list[str], count: int | None) -> list[str]:
    if count is None or count >= len(names):
        return names
    return [names[i * len(names) // count] for i in range(count)]


def samples(m: Reflectance, settings: Settings) -> Samples:
    """A material's stand-in at stratified pairs."""
    wi, wo, weight = direction_pairs(polar=64, difference=32, azimuth=48)
    everything = Samples.of(wi, wo, m(wi, wo), weight, GRAZING, m.name, m.source)
    return stratified(everything, LOSSES["l2"], settings.pairs, SEED)


def measured(weights: Mapping[str, Array], settings: Settings) -> list[Score]:
    """Every published row of the chosen materials; ours for as many as the settings say."""
    names = chosen(weights, settings.materials)
    fitted = set(_spread(names, settings.fitted))
    scores = []
    with Progress("published fits and ours", len(names), None) as bar:
        for name in names:
            stand_in = network(weights, name)
            some = samples(stand_in, settings)
            picture = lit_from_all_around(stand_in, settings.pixels)
            for published in materials.fits(name):
                row = materials.get(name, published)
                own = fit(some, with_defaults(row), budget=settings.starts).reflectance if name in fitted else None
                errors = functools.partial(_errors, some, picture, settings.pixels)
                scores.append(Score(name, published, errors(row), None if own is None else errors(own)))
            bar.step()
    return scores


def _errors(some: Samples, picture: Array, pixels: int, m: Reflectance) -> dict[str, float]:
    """By metric; `picture` is the stand-in's, so many `pixels` across."""
    cosine = some.wi[:, 2:].astype(np.float64)
    weight = some.weight.mean(1)
    values = some.values * cosine, np.asarray(m(some.wi, some.wo), np.float64) * cosine
    errors = {name: metric(*values, weight / weight.sum()) for name, metric in METRICS.items()}
    return errors | {AROUND: relative_rmse_of(picture, lit_from_all_around(m, pixels))}
