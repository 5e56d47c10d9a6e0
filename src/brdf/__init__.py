"""Reflectance: read it, evaluate it, make it small, check it, look at it.

Names are handed on lazily, so that `import brdf` loads numpy and nothing heavier.
"""

from __future__ import annotations

import importlib
from typing import Any

__version__ = "0.1.0"

_NAMES = {
    "Reflectance": "reflectance",
    "mix": "combinators",
    "models": "models",
}


def __getattr__(name: str) -> Any:
    if name not in _NAMES:
        raise AttributeError(f"module 'brdf' has no attribute {name!r}")
    module = importlib.import_module(f".{_NAMES[name]}", __name__)
    return module if _NAMES[name] == name else getattr(module, name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_NAMES])
