"""Reflectance: read it, evaluate it, make it small, check it, look at it.

Names are handed on lazily, so that `import brdf` loads numpy and nothing heavier.
"""

from __future__ import annotations

import importlib
from typing import Any

__version__ = "0.1.0"

_NAMES = {
    "BTF": "representations.btf",
    "Reflectance": "reflectance",
    "ShadingMap": "representations.shading.shading_map",
    "SphereImages": "representations.spheres.sphere_images",
    "SpatiallyVarying": "combinators",
    "TwoSided": "combinators",
    "SliceStack": "representations.baking.slice_stack",
    "Table": "representations.tables.table",
    "capture": "capture",
    "check": "laws",
    "compare": "metrics",
    "convert": "conversion",
    "errors": "errors",
    "export": "export",
    "fit": "fit",
    "io": "io",
    "load": "loading",
    "lobes": "combinators",
    "materials": "materials",
    "metrics": "metrics",
    "mix": "combinators",
    "models": "models",
    "plot": "plot",
    "profiles": "profiles",
    "render": "render",
    "reproduce": "reproduce",
    "view": "viewer",
}
"""Public name: the module it lives in, or is."""

__all__ = sorted([*_NAMES, "__version__"])


def __getattr__(name: str) -> Any:
    if name not in _NAMES:
        raise AttributeError(f"module 'brdf' has no attribute {name!r}")
    module = importlib.import_module(f".{_NAMES[name]}", __name__)
    return module if _NAMES[name] == name else getattr(module, name)


def __dir__() -> list[str]:
    return __all__
