"""What tables of the literature's layouts cost in accuracy, against figures of an independent prototype."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from brdf.formula import Vec, dot, maximum, sqrt, texture3d
from brdf.geometry.warps import Bezier, Chord, identity, uniform
from brdf.models import Lambertian
from brdf.reflectance import Reflectance
from brdf.representations.baking.bake import bake_points
from brdf.representations.tables.bases import HalfBasis, NormalBasis
from brdf.representations.tables.encoding import Encoding, Log
from brdf.representations.tables.filters import b_spline_by_linear_lookups
from brdf.representations.tables.layout import Layout
from brdf.representations.tables.table import Table
from helpers import random_directions


class Reference(Reflectance):
    """The reflectances of the figures: GGX with height-correlated masking over a diffuse part, and a Phong lobe.

    Cosines count as at least 0.02 in the masking, or rows of nodes at the horizon would be infinite.
    """

    def __init__(self, kd: float, F0: float, alpha: float, exponent: int = 0) -> None:
        self.kd, self.F0, self.alpha, self.exponent = kd, F0, alpha, exponent

    @property
    def structure(self):
        return (Reference, self.kd, self.F0, self.alpha, self.exponent)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        if self.exponent:
            mirrored = maximum(wi.z * wo.z - wi.x * wo.x - wi.y * wo.y, 0.0)
            lobe = self.F0 * (self.exponent + 2) / (2 * math.pi) * mirrored**self.exponent
        else:
            h = wi + wo
            squared, a2 = dot(h, h), self.alpha**2
            D = a2 / (math.pi * ((h.z * h.z * a2 + h.x * h.x + h.y * h.y) / squared) ** 2)
            F = self.F0 + (1 - self.F0) * (1.0 - 0.5 * sqrt(squared)) ** 5
            i, o = maximum(wi.z, 0.02), maximum(wo.z, 0.02)
            lobe = D * F * 0.5 / (i * sqrt(a2 + (1 - a2) * o * o) + o * sqrt(a2 + (1 - a2) * i * i))
        value = self.kd / math.pi + lobe
        return Vec(value, value, value)

    def _state(self):
        raise NotImplementedError


METAL, PLASTIC, PHONG = Reference(0, 0.9, 0.2), Reference(0.5, 0.04, 0.2), Reference(0.3, 0.5, 0, 50)


def grid(theta):
    """Pairs at these polar angles and azimuths 2.5, 7.5 … 177.5 degrees, and weights sin_i sin_o cos_o."""
    i, o, phi = np.meshgrid(theta, theta, np.radians(np.arange(2.5, 180, 5)), indexing="ij")
    wi = np.stack([np.sin(i), 0 * i, np.cos(i)], -1)
    wo = np.stack([np.sin(o) * np.cos(phi), np.sin(o) * np.sin(phi), np.cos(o)], -1)
    return wi, wo, np.sin(i) * np.sin(o) * np.cos(o)


PAIRS = grid(np.radians(np.arange(2.5, 85, 5)))
GRAZING = grid(np.radians([10, 30, 50, 70, 80, 84, 86, 88]))


def error(m, table, pairs=PAIRS):
    wi, wo, weight = pairs
    exact, found = m.f_cos(wi, wo)[..., 0], table.f_cos(wi, wo)[..., 0]
    return math.sqrt(np.sum(weight * (found - exact) ** 2) / np.sum(weight * exact**2))


def normal_layout(n, polar, azimuth):
    return Layout(NormalBasis(), (polar, polar, azimuth), (n, n, 2 * n), Encoding())


def half_layout(n, encoding, filter="linear"):
    warps = (Chord(), Bezier(alpha=0.65), Bezier(alpha=0.75))
    return Layout(HalfBasis("quarter-turn"), warps, (2 * n, 2 * n, n // 2), encoding, "float32", filter)


LAYOUTS = {
    "identity": lambda n: normal_layout(n, identity(), identity(math.pi)),
    "uniform": lambda n: normal_layout(n, uniform(), uniform(math.pi)),
    "bezier 0, 0": lambda n: normal_layout(n, Bezier(alpha=0.0), Bezier(math.pi, 0.0)),
    "bezier .65, .2": lambda n: normal_layout(n, Bezier(alpha=0.65), Bezier(math.pi, 0.2)),
    "half": lambda n: half_layout(n, Encoding()),
    "half, log": lambda n: half_layout(n, Encoding(Log(1e-3))),
}

PROTOTYPE = {
    (METAL, 16): (0.5876, 0.0680, 0.0927, 0.0325, 0.00906, 0.00300),
    (METAL, 32): (0.3787, 0.01443, 0.1316, 0.00949, 0.00181, 0.00069),
    (METAL, 64): (None, None, None, 0.00146, 0.00045, 0.00016),
    (PLASTIC, 16): (0.6547, 0.0915, 0.7618, 0.0218, 0.01964, 0.00262),
    (PLASTIC, 32): (0.4583, 0.01129, 0.1688, 0.01123, 0.00365, 0.00060),
    (PHONG, 16): (0.3230, 0.0770, 0.1018, 0.0759, 0.01089, 0.00966),
    (PHONG, 32): (0.1462, 0.01909, 0.0439, 0.01915, 0.00257, 0.00230),
}
"""Errors of trilinear tables, measured with the prototype, in the order of `LAYOUTS`; None: not repeated here."""


@pytest.mark.parametrize(("m", "n"), PROTOTYPE, ids=lambda v: str(v) if isinstance(v, int) else str(v.structure[1:]))
def test_errors_are_the_prototypes(m, n):
    for layout, figure in zip(LAYOUTS.values(), PROTOTYPE[m, n], strict=True):
        if figure is not None:
            assert error(m, bake_points(m, layout(n))) == pytest.approx(figure, rel=0.05)


def test_the_reflectance_of_the_figures():
    m = Reference(0.5, 0.04, 0.1)
    for theta_i, theta_o, phi, value in ((45, 45, 180, 0.8253853545), (30, 60, 90, 0.1597332511)):
        i, o, p = np.radians([theta_i, theta_o, phi])
        wo = [math.sin(o) * math.cos(p), math.sin(o) * math.sin(p), math.cos(o)]
        assert m([math.sin(i), 0, math.cos(i)], wo)[0] == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize(
    ("m", "encoding", "expected"),
    [
        (METAL, Encoding(Log(1e-3)), (0.00756, 0.00164)),
        (METAL, Encoding(), (0.0214, 0.0047)),
        (PLASTIC, Encoding(Log(1e-3)), (0.0123, 0.0024)),
        (PLASTIC, Encoding(), (0.0492, 0.0109)),
    ],
    ids=["metal, log", "metal", "plastic, log", "plastic"],
)
def test_nodes_below_the_horizon_hold_the_value_above_it(m, encoding, expected):
    """Near the horizon, where cells have nodes below it: as the prototype, and zeros there would cost much."""
    for n, figure in zip((16, 32), expected, strict=True):
        table = bake_points(m, half_layout(n, encoding))
        assert error(m, table, GRAZING) == pytest.approx(figure, rel=0.12)
        if encoding != Encoding():
            nodes = table.layout.nodes()
            wi, wo = table.layout.basis.directions(*nodes)
            below = (wi[..., 2] <= 0) | (wo[..., 2] <= 0)
            zeros = np.where(below[..., None], np.float32(math.log(1e-3)), table.codes)
            assert error(m, table, GRAZING) < error(m, Table(table.layout, zeros), GRAZING) / 5


def test_cubic_filters_are_better_once_a_lobe_is_resolved():
    """Through the nodes: better by far than linear; a spline that misses them is worse than linear, if smoother."""
    for m in (METAL, PLASTIC, PHONG):
        errors = {
            name: error(m, bake_points(m, half_layout(32, Encoding(Log(1e-3)), name)))
            for name in ("linear", "catmull-rom", "prefiltered-b-spline", "b-spline", "nearest")
        }
        assert errors["catmull-rom"] < errors["linear"] / 3
        assert errors["prefiltered-b-spline"] < errors["linear"] / 3
        assert errors["linear"] < errors["b-spline"] < 2.2 * errors["linear"]
        assert errors["nearest"] > 5 * errors["linear"]


def test_cubic_filters_have_no_creases():
    """The second difference along theta_h of a table with few nodes: spikes at the nodes, or none."""
    theta = np.radians(np.linspace(2, 40, 4001))
    w = np.stack([np.sin(theta), 0 * theta, np.cos(theta)], -1)

    def roughness(name):
        layout = dataclasses.replace(half_layout(8, Encoding(), name), shape=(12, 8, 4))
        values = bake_points(METAL, layout)(w, w)[:, 0]
        return np.abs(np.diff(values, 2)).max() / np.median(np.abs(np.diff(values, 2)))

    assert roughness("linear") > 5 * max(roughness("b-spline"), roughness("prefiltered-b-spline"))


def test_cubic_tables_of_constants_and_nodes():
    wi, wo = random_directions(200, 1), random_directions(200, 2)
    for name in ("catmull-rom", "prefiltered-b-spline", "b-spline"):
        table = bake_points(Lambertian(albedo=0.5), half_layout(8, Encoding(), name))
        np.testing.assert_allclose(table(wi, wo), 0.5 / math.pi, rtol=1e-6)
        if name != "b-spline":
            table = bake_points(METAL, half_layout(8, Encoding(), name))
            at = [w.reshape(-1, 3) for w in table.layout.basis.directions(*table.layout.nodes())]
            clear = (at[0][:, 2] > 0.05) & (at[1][:, 2] > 0.05)
            exact = METAL(at[0][clear], at[1][clear])
            np.testing.assert_allclose(table(at[0][clear], at[1][clear]), exact, rtol=1e-4, atol=1e-4)


def test_identity_table_is_exact_for_what_is_multilinear():
    """In mu_i, mu_o and cos phi, with one value where there is no phi."""

    class Multilinear(Reference):
        def f(self, wi, wo):
            sines = maximum(wi.x * wi.x + wi.y * wi.y, 1e-24) * maximum(wo.x * wo.x + wo.y * wo.y, 1e-24)
            cosine = (wi.x * wo.x + wi.y * wo.y) / sqrt(sines)
            value = (1.0 + 2.0 * wi.z) * (3.0 - wo.z) + 0.4 * (1.0 - wi.z) * (1.0 - wo.z) * cosine
            return Vec(value, value, value)

    m = Multilinear(0, 0, 0)
    wi, wo, _ = PAIRS
    np.testing.assert_allclose(bake_points(m, LAYOUTS["identity"](9))(wi, wo), m(wi, wo), rtol=1e-6)


def test_b_spline_by_eight_linear_lookups():
    """The form for graphics hardware is the sum over 64 nodes, ends included."""
    shape, rng = (5, 4, 6), np.random.default_rng(2)
    data = rng.normal(size=(*shape, 3))
    positions = [np.append(rng.uniform(0, n - 1, 300), [0.0, n - 1.0]) for n in shape]
    coordinates = [(p + 0.5) / n for p, n in zip(positions, shape, strict=True)]
    expected = texture3d(data, *coordinates, filter="b-spline")
    for a, b in zip(b_spline_by_linear_lookups(data, positions, shape), expected, strict=True):
        np.testing.assert_allclose(a, b, atol=1e-12)
