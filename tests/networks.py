"""The published networks of the MERL materials, which stand in for the measurements."""

from __future__ import annotations

import numpy as np


def nbrdf(weights: dict[str, np.ndarray], name: str, wi: np.ndarray, wo: np.ndarray) -> np.ndarray:
    """The published network of a MERL material (its inputs: half vector and difference vector at phi_h = 0) [1/sr]."""
    h = wi + wo
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    sin_h = np.hypot(h[:, 0], h[:, 1])
    along = np.stack([h[:, 2] * h[:, 0] / sin_h, h[:, 2] * h[:, 1] / sin_h, -sin_h], -1)
    d = np.stack([(wi * v).sum(-1) for v in (along, np.cross(h, along), h)], -1)
    d[d[:, 1] < 0] *= [-1, -1, 1]
    x = np.concatenate([np.stack([sin_h, 0 * sin_h, h[:, 2]], -1), d], -1)
    for layer in (1, 2):
        x = np.maximum(x @ weights[f"{name}/fc{layer}"] + weights[f"{name}/b{layer}"], 0)
    return np.maximum(np.exp(x @ weights[f"{name}/fc3"] + weights[f"{name}/b3"]) - 1, 0)
