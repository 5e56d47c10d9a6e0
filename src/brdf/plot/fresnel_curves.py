"""Fresnel reflectance against angle: dielectrics from both sides, metals, and whatever term a material has."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ReflectanceError
from ..materials import metals
from ..models.smooth_conductor import SmoothConductor
from ..models.smooth_dielectric import SmoothDielectric
from ..models.terms import fresnel as terms
from ..reflectance import Reflectance
from .page import COLOURS, DASHES, LEGEND, Materials, degrees_axis, figure_of, name_of, several, titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEIGHT = 3.5
METALS = ("silver", "gold", "copper")
CHANNEL_DASHES = (("red", DASHES[1]), ("green", DASHES[0]), ("blue", DASHES[2]))

SAME = 1e-6
"""Difference between channels below which they are one curve."""

Curve = tuple[str, NDArray[Any]]
"""Label, and reflectance (N,) or (N, 3)."""


def fresnel(m: Materials | None = None, eta: float = 1.5, metal: Sequence[str] = METALS) -> Figure:
    """Reflectance of a smooth boundary over the angle of incidence; of `m`'s Fresnel term, or of well-known boundaries.

    Without `m`: glass of index `eta` from outside and from inside (beyond the critical angle all is reflected), and
    metals by their measured index. Colours that differ between the channels are drawn as three curves, dashed red, full
    green, dotted blue. Raises ReflectanceError for a material without a Fresnel term.
    """
    degrees = np.linspace(0, 90, 721)
    cosine = np.cos(np.radians(degrees)).clip(0, 1)
    given = [] if m is None else several(m)
    curves: list[Curve] = [curve for one in given for curve in _of_material(one, cosine)]
    if not given:
        curves = [*_of_dielectric(f"η = {eta:g}", eta, cosine)]
        for name in metal:
            curves += _of_material(metals.get(metals.PREFIX + name, "polished"), cosine)
    figure = figure_of(HEIGHT)
    axes: Any = figure.add_subplot()
    for number, (label, value) in enumerate(curves):
        colour = COLOURS[number % len(COLOURS)]
        if value.ndim == 1 or np.ptp(value, axis=-1).max() < SAME:
            dash = DASHES[number % len(DASHES)] if not given or len(curves) > 1 else "-"
            axes.plot(degrees, value if value.ndim == 1 else value[:, 0], color=colour, ls=dash, lw=1.8, label=label)
            continue
        for channel, (_, dash) in enumerate(CHANNEL_DASHES):
            full = channel == 1
            axes.plot(degrees, value[:, channel], color=colour, ls=dash, lw=1.8 if full else 1.2,
                      label=label if full else None)  # fmt: skip
    axes.set_ylim(0, 1.03)
    axes.set_ylabel("reflectance [1]")
    degrees_axis(axes, range(0, 91, 15), "angle of incidence")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), **LEGEND)
    coloured = any(value.ndim > 1 and np.ptp(value, axis=-1).max() >= SAME for _, value in curves)
    note = "\nred dashed, green full, blue dotted" if coloured else ""
    titled(figure, f"Fresnel reflectance, unpolarised{note}")
    return figure


def _of_dielectric(label: str, eta: float, cosine: NDArray[Any]) -> list[Curve]:
    return [
        (f"{label}, outside", np.asarray(terms.dielectric(cosine, eta))),
        (f"{label}, inside", np.asarray(terms.dielectric(cosine, 1 / eta))),
    ]


def _of_material(m: Reflectance, cosine: NDArray[Any]) -> list[Curve]:
    label = name_of(m, 28)
    if isinstance(m, SmoothDielectric):
        return _of_dielectric(label, float(m.values["eta"]), cosine)
    if isinstance(m, SmoothConductor):
        n, k = (np.asarray(m.values[key]) for key in ("eta", "k"))
        return [(label, np.stack([terms.conductor(cosine, n[c], k[c]) for c in range(3)], -1))]
    for part in getattr(m, "_parts", {}).values():
        if isinstance(part, terms.Dielectric):
            return _of_dielectric(label, float(part.values["eta"]), cosine)
        if isinstance(part, terms.Conductor):
            n, k = (np.asarray(part.values[key]) for key in ("eta", "k"))
            return [(label, np.stack([terms.conductor(cosine, n[c], k[c]) for c in range(3)], -1))]
        if isinstance(part, terms.Fresnel):
            from ..formula.bound import Bound, bound_value

            bound = Bound(part, lambda name, part=part: _value(part, name, bound_value))
            F = bound.F(cosine)
            return [(label, np.stack(np.broadcast_arrays(*(np.asarray(c, float) for c in F), cosine)[:3], -1))]
    for child in m.children.values():
        try:
            return _of_material(child, cosine)
        except ReflectanceError:
            continue
    raise ReflectanceError(f"{label} has no Fresnel term to draw")


def _value(part: Any, name: str, bound_value: Any) -> Any:
    return bound_value(part.values[name], np.float64) if name in part.values else part.textures[name]
