"""Mitsuba 3: `.xml` with one BSDF, and what it reads beside it; needs no plug-in."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np

from .. import io
from ..combinators import Transposed
from ..container import replacing
from ..models import get as model
from ..reflectance import Reflectance
from ..representations.adaptive import Adaptive
from ..representations.scattered import Scattered
from .target import Target, Written, identifier

VERSION = "3.0.0"


def bsdf_dict(m: Reflectance, measured: Path) -> dict[str, Any]:
    """What `mitsuba.load_dict` takes: one of Mitsuba's own models where `m` is the same, else `measured`, which reads
    the RGL file `measured` (not written here; of `stored(m)`). Colours are lists of three."""
    if isinstance(m, model("Lambertian")):
        return {"type": "diffuse", "reflectance": _rgb(m.values["albedo"])}
    if isinstance(m, model("Microfacet")) and _is_rough_conductor(m):
        row = m.values
        widths = {f"alpha_{u}": float(getattr(m, f"alpha_{x}")) for u, x in (("u", "x"), ("v", "y"))}
        optical = {"eta": _rgb(row["eta"]), "k": _rgb(row["k"])}
        return {"type": "roughconductor", "distribution": str(m.ndf), **widths, **optical}
    return {"type": "measured", "filename": str(measured)}


def stored(m: Reflectance) -> Reflectance:
    """What goes into the RGL file for Mitsuba to give the values of `m`: it takes the viewer as the incident direction.

    Measurements stay as they are: one on adaptive grids is not resampled, a scattered one is reciprocal.
    """
    return m if isinstance(m, (Adaptive, Scattered)) else Transposed(m)


def _is_rough_conductor(m: Any) -> bool:
    return m.ndf in ("ggx", "beckmann") and m.masking == "smith-separable" and m.fresnel == "conductor"


def _rgb(value: Any) -> dict[str, Any]:
    return {"type": "rgb", "value": [float(x) for x in np.broadcast_to(value, 3)]}


def write(m: Reflectance, path: Path) -> Written:
    """A scene with the BSDF alone, to `include` or copy from. Raises ReflectanceError for what transmits or mirrors."""
    beside = path.with_name(f"{path.name}.bsdf")  # never the measurement that it may have come from
    described = bsdf_dict(m, Path(beside.name))
    files: tuple[Path, ...] = (path,)
    stands_for = m
    if described["type"] == "measured":
        io.write(stored(m), beside, "RGL")
        files, stands_for = (path, beside), Transposed(io.read(beside))
    root = ET.Element("scene", version=VERSION)
    node = ET.SubElement(root, "bsdf", type=described.pop("type"), id=identifier(m))
    for name, value in described.items():
        kind = "rgb" if isinstance(value, dict) else "float" if isinstance(value, float) else "string"
        text = ", ".join(f"{x:.9g}" for x in value["value"]) if isinstance(value, dict) else str(value)
        ET.SubElement(node, kind, name=name, value=text)
    ET.indent(root)
    with replacing(path) as temporary:
        ET.ElementTree(root).write(temporary, encoding="utf-8", xml_declaration=True)
    return Written(files, stands_for)


TARGET = Target("Mitsuba 3", ".xml", "one BSDF: Mitsuba's own model where it is the same, else measured", write)
