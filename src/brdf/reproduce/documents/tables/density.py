"""Figure 2: where the warps put the nodes; and which share of a grid stands for no directions at all."""

from __future__ import annotations

import math

import numpy as np

from ....geometry.warps import Bezier, Chord, Spline, Warp, identity, uniform
from ....loading import load
from ....metrics.importance import ErrorsAgainst, importance_pairs
from ....representations.baking.adaptive_layout import adapt
from ....representations.tables.encoding import Encoding, Log
from ....representations.tables.layouts import BASES, named_layout, shape_of
from ...charts import curves
from ...report import Column, Report
from .settings import FIT, FIXED

NODES = 17
"""Of the axis whose nodes are drawn."""

ADAPTED_TO = "nickel"

EVEN = 0.5841
"""The paper's alpha for nearly even angles."""

PAPER_WASTE = 0.38
"""The share of the half-vector grid that the paper says is wasted, at the least."""

OURS = "ours: chord, θh"


def present(report: Report) -> dict[str, float]:
    """Figure 2 and the table of wasted nodes, whose shares it returns by layout."""
    warps: dict[str, Warp] = {
        "identity": identity(),
        "uniform": uniform(),
        "Bézier, α 0": Bezier(alpha=0.0),
        f"Bézier, α {FIXED[0]:g}": Bezier(alpha=FIXED[0]),
        OURS: Chord(),
        f"ours: fitted to {ADAPTED_TO}, θh": _fitted(),
    }
    angles = np.radians(np.linspace(2, 90, 177))
    places = np.linspace(0, 1, NODES)
    degrees = np.degrees(angles)
    report.figure(
        "figure-2",
        "Figure 2. Nodes a degree along a polar axis, in parts of the even spacing's, by the angle. Where a curve "
        "touches 0 there are no nodes.",
        curves(
            {name: (degrees.tolist(), (w.density(angles) * w.extent).tolist()) for name, w in warps.items()},
            "angle [degrees]", "density of nodes, even spacing 1", marker="",
        ),
    )  # fmt: skip
    report.figure(
        "figure-2-nodes",
        f"Where {NODES} nodes lie.",
        curves({name: (np.degrees(w.angle(places)).tolist(), places.tolist()) for name, w in warps.items()},
               "angle of the node [degrees]", "place on the axis"),
    )  # fmt: skip
    report.table(
        "nodes",
        "Nodes of a polar axis",
        ["warp", *(Column(title, "degrees", ".2f", "ours") for title in ("first gap", "middle node", "last gap")),
         Column("density at 1°", "1", ".2f", "ours"), Column("density at 89°", "1", ".2f", "ours")],
        [
            [name, *_gaps(w), *(float(w.density(math.radians(angle)) * w.extent) for angle in (1, 89))]
            for name, w in warps.items()
        ],
        "64 nodes over 0 to 90°. Densities in parts of the even spacing's.",
        f"Bézier with α {EVEN:g} differs from even angles by at most {from_even():.4f} of the axis.",
    )  # fmt: skip
    return _waste(report)


def _gaps(warp: Warp) -> list[float]:
    nodes = np.degrees(warp.nodes(64))
    return [float(nodes[1] - nodes[0]), float(nodes[32]), float(nodes[-1] - nodes[-2])]


def _fitted() -> Warp:
    """The spline over theta_h of a table fitted to one material."""
    m = load(f"{ADAPTED_TO}@{FIT}")
    fitted = adapt(m, ErrorsAgainst(m, importance_pairs(4096)), 16384, "half", Encoding(Log(1e-3)))
    warp = fitted.layout.warps[0]
    assert isinstance(warp, Spline)
    return warp


def from_even() -> float:
    """The largest difference of coordinate between `EVEN` and even angles."""
    places = np.linspace(0, 1, 4001)
    angles = Bezier(alpha=EVEN).angle(places)
    return float(np.abs(angles / (math.pi / 2) - places).max())


def _waste(report: Report) -> dict[str, float]:
    """The share of the nodes of each layout below the horizon."""
    shares = {
        "half vector, even angles": named_layout("half", "uniform", shape_of("half", 32)).wasted,
        "half vector, MERL's axes": named_layout("half", "merl", shape_of("half", 32)).wasted,
        "half vector, ours": named_layout("half", "bezier", shape_of("half", 32)).wasted,
        **{basis: named_layout(basis, "uniform", shape_of(basis, 32)).wasted for basis in BASES if basis != "half"},
    }
    report.table(
        "wasted",
        "The share of a table below the horizon",
        ["basis", Column("at least", "%", ".0f", "paper"), Column("share", "%", ".2f", "ours")],
        [
            [name, 100 * PAPER_WASTE if name == "half vector, even angles" else None, max(0.0, 100 * share)]
            for name, share in shares.items()
        ],
        "The volume of the axes' coordinates where light or viewer are below the horizon, by quadrature.",
    )
    return shares
