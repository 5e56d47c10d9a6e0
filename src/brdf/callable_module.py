"""Packages that are also the function they are named after.

The public function `brdf.render(...)` lives in the package `brdf.render`, and importing the package binds its name in
`brdf` to the module, whatever was bound there before. So the module itself is made to answer the call.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any


def make_callable(module_name: str, function: Callable[..., Any]) -> None:
    """Make the module of that name, already in `sys.modules`, answer calls as `function` does."""
    module = sys.modules[module_name]
    module.__class__ = type("CallableModule", (ModuleType,), {"__call__": staticmethod(function)})
    vars(module)["__signature__"] = inspect.signature(function)
