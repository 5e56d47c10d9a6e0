"""The laws a reflectance should obey, as public checks: `check(m)` for all, or one function a law.

One file a law; the folder is the list: every function in it marked with `@law` registers itself.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Sequence

from ..reflectance import Reflectance
from .result import REGISTRY, Law, LawResult, Report

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")

ALL: tuple[Law, ...] = tuple(REGISTRY[name] for name in sorted(REGISTRY))
"""Every law: callables that take a reflectance and return a `LawResult`; `law.name` is what `breaks` speaks of."""


def check(reflectance: Reflectance, laws: Sequence[Law] = ALL) -> Report:
    """Measure how well a reflectance obeys the laws.

    The report passes when every law holds or its breach is declared (`breaks`, its own or that of a part).
    """
    return Report(reflectance.name or type(reflectance).__name__, tuple(law(reflectance) for law in laws))


__all__ = ["ALL", "Law", "LawResult", "Report", "check"]
