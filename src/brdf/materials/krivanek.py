"""Diffuse albedos of things in a house and an office, measured by Jaroslav Křivánek: `krivanek/plate` and others.

The values are those of his table of 9 November 2009 [Krivanek2009], in percent. What is made of them:
  - The diffuse albedo becomes a Lambertian reflectance. One number is a gray; three are red, green and blue, taken as
    linear and of Rec. 709 primaries (the table does not name them).
  - A range "from … to …" is the spread over the thing: a bare name stands for its middle, `@low` and `@high` for its
    ends. The brushed switch cover has two numbers, for views along its scratches and across them: `@along`, `@across`.
  - The total reflectance, diffuse and glossy together, is "very approximate" in the table's own words, and no width of
    a lobe comes with it. It is kept as a figure and not made into a lobe: the shiny things are their diffuse part only.
  - The plastic cup stands in the table without a value and is left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import UnknownNameError
from ..models.lambertian import Lambertian
from ..reflectance import Reflectance
from . import providers

PREFIX = "krivanek/"

Percent = float | tuple[float, float, float]


@dataclass(frozen=True)
class Measured:
    """One row of the table, in percent."""

    name: str
    """As in the table."""
    albedo: tuple[Percent, ...]
    """Diffuse albedo: one value, or the two ends of a range."""
    total: float | None = None
    """Total reflectance, where it was estimated."""
    ends: tuple[str, str] = ("low", "high")
    """What the two ends are called."""


ROWS = {
    "espresso-maker": Measured("bialetti espresso maker (brand new)", (3.2,), 90),
    "aluminum-foil-top": Measured("aluminum foil top", (1.2,), 90),
    "aluminum-foil-bottom": Measured("aluminum foil bottom", (2.9,), 85),
    "knife-blade": Measured("knife blade", (1.4,), 60),
    "spatula": Measured("spatula (chrome)", (0.9,), 85),
    "pizza-spatula": Measured("pizza spatula (scratched)", (2.2,), 60),
    "light-switch-cover-top": Measured(
        "rhodes light switch cover - top (coarse finish - aniso)", (2.7, 9.3), 50, ("along", "across")
    ),
    "light-switch-cover-bottom": Measured("rhodes light switch cover - bottom (polished)", (1.0,), 70),
    "chair-upholstery": Measured("chair upholstery", ((6.5, 6, 5.5), (13, 12, 11))),
    "plant-leaf-green": Measured("plant leaf, green", ((6, 12, 5), (11, 18, 8))),
    "plant-leaf-yellow": Measured("plant leaf, yellow", ((27, 36, 19), (31, 42, 16))),
    "office-desk": Measured("rhodes office desk", ((35, 35, 34),)),
    "notebook-paper": Measured("notebook paper (yellowish)", ((89, 80, 71),)),
    "plate": Measured("plate", ((83, 81, 71),)),
    "paper-plate": Measured("paper plate", ((82, 80, 78),)),
    "wood": Measured("wood", ((50, 30, 19), (80, 53, 34))),
    "office-wall-paint": Measured("rhodes office wall paint", ((64, 60, 51),)),
    "office-door-paint": Measured("rhodes office door paint", ((24, 25, 22),)),
    "file-cabinet": Measured("file cabinet (gray paint)", ((6.6, 6.6, 6.4),)),
    "carpet": Measured("rhodes carpet", ((18, 15, 13),)),
    "dark-reddish-wood": Measured("dark reddish wood", ((18, 9, 4), (33, 17, 8))),
    "thesis-binding": Measured("milos's thesis binding", (2.8,)),
    "lens-cap": Measured("canon lens cap (black plastic)", (2.7,)),
    "recycle-bin": Measured("cornell recycle bin (blue plastic)", ((1, 5, 25),)),
}  # fmt: skip
"""Every row that has a value, in the order of the table."""


def names() -> list[str]:
    """The names of the materials, in the order of the table."""
    return [PREFIX + key for key in ROWS]


def variants(name: str) -> list[str]:
    """`measured`; of a range `mean` and its two ends. Raises UnknownNameError."""
    return list(_albedos(_row(name)))


def get(name: str, variant: str | None = None) -> Reflectance:
    """The Lambertian of a row, at one end of its range if so wanted. Raises UnknownNameError."""
    row = _row(name)
    albedos = _albedos(row)
    if variant is not None and variant not in albedos:
        raise UnknownNameError(f"variant of {name}", variant, albedos)
    chosen = variant or next(iter(albedos))
    total = f"; total reflectance about {row.total:g} %, its glossy part is left out" if row.total else ""
    source = f"{chosen}: diffuse albedo of {row.name} (Krivanek2009), as Lambertian{total}"
    return Lambertian(albedo=albedos[chosen] / 100).named(name, source)


def markdown() -> str:
    """The table as Markdown, for the documentation."""
    lines = ["| name | object / material | diffuse albedo (%) | total reflectance (%) |", "| --- | --- | --- | --- |"]
    for key, row in ROWS.items():
        albedo = " / ".join(_percent(a) for a in row.albedo) + (f" ({', '.join(row.ends)})" if row.albedo[1:] else "")
        lines.append(f"| `{PREFIX}{key}` | {row.name} | {albedo} | {'' if row.total is None else f'{row.total:g}'} |")
    return "\n".join(lines)


def _percent(value: Percent) -> str:
    return f"({', '.join(f'{v:g}' for v in value)})" if isinstance(value, tuple) else f"{value:g}"


def _albedos(row: Measured) -> dict[str, np.ndarray]:
    """Albedos in percent by variant, the preferred one first."""
    values = [np.asarray(a, np.float64) for a in row.albedo]
    if len(values) == 1:
        return {"measured": values[0]}
    return {"mean": (values[0] + values[1]) / 2, row.ends[0]: values[0], row.ends[1]: values[1]}


def _row(name: str) -> Measured:
    key = name.removeprefix(PREFIX)
    if key not in ROWS:
        raise UnknownNameError("material", name, names())
    return ROWS[key]


providers.register(names, variants, get)
