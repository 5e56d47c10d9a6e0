"""How two neighbouring pictures of a sphere become the one between them.

A blend turns the normal about the vertical axis by k (phi_i - phi) before it looks picture i up; its rule says what k
is. Normals are given by their azimuth a = atan2(n_x, n_z) in the plane of light and viewer, in which the light stands
at phi, the viewer at 0 and the half vector at phi / 2 [rad].
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from ...errors import ParameterError, UnknownNameError
from ...formula import Scalar, Vec, abs, clip, maximum, minimum, pi, sin, where

Rule = Callable[[Scalar, Scalar, Scalar], Scalar]
"""(a, phi, phi of the last picture) -> k."""

SHORTENING = 0.995
"""The paper's remedy for pictures on a black ground: normals are shortened, so that no lookup touches the ground."""

STEEPEST = 1.5
"""Largest factor between the last two pictures that is taken for a trend: more suits dark plastics, but makes light of
bright metals."""

FAINT = 1e-3
"""Radiance added to both when they are compared: shadows say nothing."""

NARROWEST = 1e-4
"""Least half width [rad] of the lit and visible range of azimuths: it closes when the light stands behind."""


def full(a: Scalar, phi: Scalar, last: float) -> Scalar:
    """k = 1: the light falls on the turned normal as on the given one. Right for diffuse light, doubles highlights."""
    return 0.0 * a + 1.0


def half(a: Scalar, phi: Scalar, last: float) -> Scalar:
    """k = 1/2: the half vector stays in place. Right for highlights, bends diffuse shades."""
    return 0.0 * a + 0.5


def paper(a: Scalar, phi: Scalar, last: float) -> Scalar:
    """k = (1 + sin alpha_h) / 2, alpha_h between the half vector and (n_x, 0, n_z); 3/4 beyond the last picture."""
    return where(phi > last, 0.75, 0.5 + 0.5 * abs(sin(a - 0.5 * phi)))


def monotone(a: Scalar, phi: Scalar, last: float) -> Scalar:
    """k = (1 - s^3) / 2, s from -1 at the shadow's edge over 0 at the half vector to 1 at the limb: each of the three
    lands on its like in either picture. No normal turns out of sight while phi_2 - phi <= (pi - phi) / 3."""
    s = clip((a - 0.5 * phi) / maximum(0.5 * pi - 0.5 * phi, NARROWEST), -1.0, 1.0)
    return 0.5 - 0.5 * s * s * s


BLENDS: dict[str, Rule] = {"full": full, "half": half, "paper": paper, "monotone": monotone, "separated": half}
"""Every rule by name; for what "separated" does beyond turning the normal see `separated`."""


def blend_rule(name: str) -> Rule:
    """The rule of that name. Raises UnknownNameError."""
    if name not in BLENDS:
        raise UnknownNameError("blend", name, BLENDS)
    return BLENDS[name]


def neighbours(phi: Scalar, nodes: tuple[float, ...]) -> tuple[Scalar, Scalar, Scalar, Scalar]:
    """The formula: the angles of the pictures next to `phi`, the number of the first, and the share of the second.

    Beyond the last picture the share is 1, before the first 0.
    """
    first, second, number = 0.0 * phi + nodes[0], 0.0 * phi + nodes[1], 0.0 * phi
    for i in range(1, len(nodes) - 1):
        reached = phi >= nodes[i]
        first = where(reached, nodes[i], first)
        second = where(reached, nodes[i + 1], second)
        number = where(reached, float(i), number)
    return first, second, number, clip((phi - first) / (second - first), 0.0, 1.0)


def trend(before: Vec, last: Vec, phi: Scalar, nodes: tuple[float, ...]) -> Vec:
    """The formula: the factor (1 + x (r - 1))^2 by which the last picture goes on to change, r the factor from the last
    but one to it, x from 0 at its angle up to at most 1 at 180 degrees. 1 up to the last picture.

    Towards grazing light radiance changes ever faster, so that it is squared; see docs/sphere-images.md.
    """
    x = maximum(phi - nodes[-1], 0.0) * (1 / max(nodes[-1] - nodes[-2], math.pi - nodes[-1]))
    r = minimum(maximum((last + FAINT) / (before + FAINT), 1 / STEEPEST), STEEPEST)
    factor: Vec = 1.0 + x * (r - 1.0)
    return factor * factor


def blend_options(given: Mapping[str, Any], dilated: bool) -> dict[str, Any]:
    """All options of a blend: those given, and what the others are by default. Raises ParameterError."""
    defaults = {"shorten": None, "mask": True, "guard": True, "trend": True}
    unknown = set(given) - set(defaults)
    if unknown:
        raise ParameterError(f"unknown option {sorted(unknown)[0]!r}; a blend takes {', '.join(defaults)}")
    options = defaults | dict(given)
    shorten = options.pop("shorten")
    if shorten is None:
        shorten = 1.0 if dilated else SHORTENING
    if not 0 < shorten <= 1:
        raise ParameterError(f"shorten must lie in (0, 1], got {shorten!r}")
    return {"shorten": float(shorten)} | {name: bool(value) for name, value in options.items()}
