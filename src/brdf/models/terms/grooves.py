"""Masking of symmetric V-grooves, for models that are not mixed from parts."""

from __future__ import annotations

from ...formula import Scalar, Vec, dot, maximum, minimum


def v_groove_visibility(wi: Vec, wo: Vec) -> Scalar:
    """G / (cos_i cos_o), G = min(1, 2 cos_h cos_i / (h . wi), 2 cos_h cos_o / (h . wi)). Reference: Torrance1967."""
    h = wi + wo
    ratio = 4.0 * h.z / dot(h, h)  # 2 cos_h / (h . wi) for h = wi + wo
    return minimum(1.0 / minimum(wi.z, wo.z), ratio) / maximum(wi.z, wo.z)
