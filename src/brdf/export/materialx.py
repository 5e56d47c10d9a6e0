"""MaterialX with OpenPBR Surface: `.mtlx`, read by most tools of film and by many engines."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from ..container import replacing
from ..reflectance import Reflectance
from .principled import aligned, open_pbr
from .target import Target, Written, identifier, stand_in

VERSION = "1.39"


def write(m: Reflectance, path: Path) -> Written:
    """An `open_pbr_surface` and its material; `m` itself where it is OpenPBR, else by a fit."""
    along = aligned(m)
    surface = open_pbr(along.reflectance)
    name = identifier(m)
    root = ET.Element("materialx", version=VERSION, colorspace="lin_rec709")
    shader = ET.SubElement(root, "open_pbr_surface", name=f"{name}_surface", type="surfaceshader")
    for parameter, value in surface.values.items():
        kind, text = ("float", f"{value:.7g}") if isinstance(value, float) else ("color3", _list(value))
        ET.SubElement(shader, "input", name=parameter, type=kind, value=text)
    if along.is_turned:
        _turn_tangent(root, f"{name}_tangent")
        ET.SubElement(shader, "input", name="geometry_tangent", type="vector3", nodename=f"{name}_tangent")
    material = ET.SubElement(root, "surfacematerial", name=name, type="material")
    ET.SubElement(material, "input", name="surfaceshader", type="surfaceshader", nodename=f"{name}_surface")
    ET.indent(root)
    with replacing(path) as temporary:
        ET.ElementTree(root).write(temporary, encoding="utf-8", xml_declaration=True)
    return Written((path,), stand_in(along.back(surface), m, f"OpenPBR in {path.name}"))


def _turn_tangent(root: ET.Element, name: str) -> None:
    """A node `name`: the tangent, turned by 90 degrees about the normal."""
    parts = {"in": "tangent", "axis": "normal"}
    for kind in parts.values():
        node = ET.SubElement(root, kind, name=f"{name}_{kind}", type="vector3")
        ET.SubElement(node, "input", name="space", type="string", value="world")
    turned = ET.SubElement(root, "rotate3d", name=name, type="vector3")
    for given, kind in parts.items():
        ET.SubElement(turned, "input", name=given, type="vector3", nodename=f"{name}_{kind}")
    ET.SubElement(turned, "input", name="amount", type="float", value="90")


def _list(value: object) -> str:
    return ", ".join(f"{x:.7g}" for x in np.asarray(value, np.float64))


TARGET = Target("MaterialX", ".mtlx", "OpenPBR Surface, by a fit", write)
