"""Small measurements on adaptive grids, made up: smooth positive grids, any azimuths, RGB or spectral."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def tensors(azimuths: int = 1, share: float = 1.0, wavelengths: int = 0, seed: int = 0) -> dict[str, NDArray[Any]]:
    """Fields of an RGL file with `azimuths` incident azimuths over `share` of the circle, starting at -pi."""
    rng = np.random.default_rng(seed)
    theta_i = np.array([0.0, 0.4, 0.9, 1.4], np.float32)
    phi_i = np.linspace(-np.pi, -np.pi + 2 * np.pi * share, azimuths) if azimuths > 1 else np.zeros(1)
    incident = (azimuths, len(theta_i))

    def smooth(*shape: int) -> NDArray[np.float32]:
        """Positive, with the first and last row equal: azimuth is periodic."""
        y = np.linspace(0, 2 * np.pi, shape[-2])[:, None]
        x = np.linspace(0, 1, shape[-1])
        a, b, c = (rng.uniform(0.2, 0.4, (*shape[:-2], 1, 1)) for _ in range(3))
        return (1 + a * np.cos(y + 3 * a) + b * np.sin(3 * x + c) + c * np.cos(2 * y) * x).astype(np.float32)

    # the density over the unit square of a broad lobe vanishes at the pole and at the horizon
    lobe = (np.linspace(0, 1, 24) * (1 - np.linspace(0, 1, 24) ** 4)).astype(np.float32)
    fields = {
        "description": np.frombuffer(b"made up", np.uint8),
        "theta_i": theta_i,
        "phi_i": phi_i.astype(np.float32),
        "ndf": smooth(12, 20),
        "sigma": smooth(10, 20),
        "vndf": smooth(*incident, 32, 24) * lobe,
        "luminance": smooth(*incident, 9, 9),
        "jacobian": np.ones(1, np.uint8),
    }
    if azimuths == 1:  # the projected area of an isotropic surface does not depend on the azimuth
        fields["sigma"][:] = fields["sigma"][:1]
    if wavelengths:
        fields["wavelengths"] = np.linspace(400, 700, wavelengths, dtype=np.float32)
        fields["spectra"] = smooth(*incident, wavelengths, 9, 9)
    else:
        fields["rgb"] = smooth(*incident, 3, 9, 9)
    return fields
