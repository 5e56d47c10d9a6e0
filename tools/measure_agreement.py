"""Measure how well each published fit agrees with networks fitted to the same MERL measurements.

    python tools/measure_agreement.py WEIGHTS

WEIGHTS is merl_nbrdf_weights.npz: the networks of github.com/asztr/Neural-BRDF at e229dda (80 materials), whose arrays
`<material>/fc1 b1 fc2 b2 fc3 b3` take half and difference vector to RGB [1/sr]. Writes
src/brdf/materials/data/agreement.json and prints, for every fit, the median error and the median logarithm of
fit over network inside the highlights, where a wrong factor (pi, 4, a reflectance) would show as its logarithm.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brdf import materials
from brdf.geometry.directions import from_spherical, reflected

TARGET = Path(__file__).parents[1] / "src/brdf/materials/data/agreement.json"
METRIC = (
    "median of |ln(f / f_network)| over RGB and 4000 pairs of directions within 70 degrees of the normal, "
    "half vectors log-uniform from 0.5 to 60 degrees, where f_network > 1e-4/sr"
)
FLOOR = 1e-4
"""Values below, in 1/sr, are not compared; a fit's are raised to a hundredth of it."""

Floats = NDArray[np.float64]


def directions(count: int = 4000) -> tuple[Floats, Floats]:
    """`count` pairs (N, 3), seeded."""
    rng = np.random.default_rng(0)
    half = from_spherical(np.exp(rng.uniform(*np.log(np.radians([0.5, 60])), 8 * count)), np.zeros(8 * count))
    wo = from_spherical(np.radians(rng.uniform(0, 70, 8 * count)), rng.uniform(-np.pi, np.pi, 8 * count))
    wi = reflected(wo, half)
    inside = np.flatnonzero((wi[:, 2] > np.cos(np.radians(70))) & (np.sum(wo * half, -1) > 0))[:count]
    return wi[inside], wo[inside]


def network(weights: dict[str, Floats], name: str, wi: Floats, wo: Floats) -> Floats:
    """The network's value (N, 3) [1/sr]; its inputs are in a frame where the half vector has azimuth 0."""
    half = (wi + wo) / np.linalg.norm(wi + wo, axis=-1, keepdims=True)
    sine = np.hypot(half[:, 0], half[:, 1])
    east = np.stack([half[:, 2] * half[:, 0] / sine, half[:, 2] * half[:, 1] / sine, -sine], -1)
    difference = np.stack([np.sum(wi * axis, -1) for axis in (east, np.cross(half, east), half)], -1)
    difference[:, :2] *= np.where(difference[:, 1:2] < 0, -1, 1)  # wi and wo are interchangeable
    layer = np.concatenate([np.stack([sine, 0 * sine, half[:, 2]], -1), difference], -1)
    for i in (1, 2):
        layer = np.maximum(layer @ weights[f"{name}/fc{i}"] + weights[f"{name}/b{i}"], 0)
    return np.maximum(np.exp(layer @ weights[f"{name}/fc3"] + weights[f"{name}/b3"]) - 1, 0)


def logarithm(fitted: Floats, measured: Floats) -> Floats:
    """ln(fit / network) (N, 3), not a number where the network is below the floor."""
    return np.log(np.maximum(fitted, 0.01 * FLOOR) / np.where(measured > FLOOR, measured, np.nan))


def measure(weights: dict[str, Floats]) -> tuple[dict[str, dict[str, float]], dict[str, dict[str, float]]]:
    """Errors by material and fit, and by fit and material the bias inside the highlight where there is one."""
    wi, wo = directions()
    errors: dict[str, dict[str, float]] = {}
    biases: dict[str, dict[str, float]] = {}
    for name in sorted({key.partition("/")[0] for key in weights} & set(materials.names())):
        measured = network(weights, name, wi, wo)
        errors[name] = {}
        for fit in materials.fits(name):
            fitted = materials.get(name, fit)(wi, wo)
            apart = logarithm(fitted, measured)
            errors[name][fit] = round(float(np.nanmedian(np.abs(apart))), 4)
            highlight = np.minimum(fitted, measured) > 4 * np.median(measured, 0)
            if highlight.sum() > 100:
                biases.setdefault(fit, {})[name] = float(np.nanmedian(apart[highlight]))
    return errors, biases


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with np.load(sys.argv[1], allow_pickle=False) as file:
        weights = {key: file[key].astype(np.float64) for key in file.files}
    errors, biases = measure(weights)
    table = {"metric": METRIC, "reference": "github.com/asztr/Neural-BRDF at e229dda", "errors": errors}
    TARGET.write_text(json.dumps(table, separators=(",", ":")) + "\n")
    print(f"{'fit':<26} materials  median error  highlights  median ln(fit / network)")
    for fit in materials.fits("gold-metallic-paint"):
        found = [by_fit[fit] for by_fit in errors.values() if fit in by_fit]
        bias = list(biases[fit].values())
        print(f"{fit:<26} {len(found):9}  {np.median(found):12.3f}  {len(bias):10}  {np.median(bias):24.3f}")


if __name__ == "__main__":
    main()
