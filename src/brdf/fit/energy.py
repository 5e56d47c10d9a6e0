"""Whether a fitted material gives back more light than it gets: data do not keep a model from it where they end."""

from __future__ import annotations

import numpy as np

from ..geometry.directions import from_spherical
from ..reflectance import Reflectance

ANGLES = (0.0, 30.0, 60.0, 75.0, 85.0)
"""Degrees from the normal at which it is looked for."""

SAMPLES = 1024
"""Of each albedo."""

STANDARD_ERRORS = 4
"""By which an albedo must exceed 1."""


def gains(m: Reflectance) -> tuple[str, ...]:
    """A warning with the largest directional albedo, where one is above 1."""
    azimuths = (0.0,) if m.isotropic else (0.0, 90.0)
    theta, phi = np.meshgrid(ANGLES, azimuths, indexing="ij")
    wo = from_spherical(np.radians(theta), np.radians(phi))
    # of the base class: a model may have a parameter called `albedo`
    albedo, error = (method(m, wo, SAMPLES).max(-1) for method in (Reflectance.albedo, Reflectance.albedo_error))
    if not np.max(albedo - STANDARD_ERRORS * error) > 1:
        return ()
    worst = np.unravel_index(np.argmax(albedo), albedo.shape)
    return (f"the fit reflects more than it receives, {albedo[worst]:.3g} times as much at {theta[worst]:g}°",)
