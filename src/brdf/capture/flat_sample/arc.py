"""Lamps all over a dome: those that lie on one arc from the zenith to the horizon."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...geometry.directions import angle_between, from_spherical, to_spherical

Floats = NDArray[np.floating[Any]]

STEP = 10.0
"""Degrees between the lamps chosen from a dome, as in Kautz2004."""
PLANE = 7.5
"""Degrees from one plane within which all lamps count as an arc already."""
FARTHEST = 7.5
"""Degrees that a lamp chosen from a dome may be from its place on the arc."""
CLOSEST = 1.0
"""Degrees of elevation by which lamps on an arc must differ to say something new."""
GRAZING = 89.0
"""Degrees from the normal from which a lamp shows nothing but the relief's highest points."""


class Arc(NamedTuple):
    """Lamps near a half plane through the normal."""

    chosen: list[int]
    """their numbers, from the highest to the lowest"""
    azimuth: float
    """of the half plane [degrees]"""
    deviation: float
    """largest angle between a chosen lamp and the plane [degrees]"""


def choose_arc(directions: Floats) -> Arc:
    """The arc in unit directions (L, 3): all of them if they lie on one, else one about every `STEP` degrees.

    From a dome that azimuth is taken at which lamps are nearest to the places of an arc on the average. Lamps below
    the horizon are left out.
    """
    usable = np.flatnonzero(to_spherical(directions)[0] < math.radians(GRAZING))
    if not len(usable):
        return Arc([], 0.0, 0.0)
    w = directions[usable]
    theta = to_spherical(w)[0]
    azimuths = np.radians(np.arange(0.0, 360.0))
    normals = np.stack([-np.sin(azimuths), np.cos(azimuths), 0 * azimuths], -1)
    along = np.stack([np.cos(azimuths), np.sin(azimuths), 0 * azimuths], -1)
    off = np.degrees(np.arcsin(np.clip(np.abs(w @ normals.T), 0, 1)))
    off[(w @ along.T < 0) & (theta > math.radians(PLANE))[:, None]] = 180.0
    spread = off.max(0)
    if spread.min() <= PLANE:
        best = int(np.argmin(spread))
        chosen = np.arange(len(w))
    else:
        places = np.radians(np.arange(0.0, 90.0, STEP))
        # (azimuth, place, lamp)
        wanted = from_spherical(places[None], azimuths[:, None])
        apart = np.degrees(angle_between(wanted[:, :, None], w[None, None]))
        best = int(np.argmin(np.minimum(apart.min(2), 2 * FARTHEST).mean(1)))
        nearest = apart[best].argmin(1)
        chosen = np.unique(nearest[apart[best].min(1) <= FARTHEST])
    chosen = chosen[np.argsort(theta[chosen], kind="stable")]
    apart_enough = np.diff(np.degrees(theta[chosen]), prepend=-STEP) > CLOSEST
    chosen = chosen[apart_enough]
    deviation = float(off[chosen, best].clip(0, 90).max(initial=0.0))
    return Arc([int(usable[k]) for k in chosen], float(np.degrees(azimuths[best])), deviation)
