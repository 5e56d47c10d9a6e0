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


def make_callable(module_name: str, function: Callable[..., Any] | str) -> None:
    """Make the module of that name, already in `sys.modules`, answer calls as `function` does.

    A text names an attribute of the module, which is looked up when it is needed.
    """
    module = sys.modules[module_name]

    def called() -> Callable[..., Any]:
        found: Callable[..., Any] = getattr(module, function) if isinstance(function, str) else function
        return found

    members = {
        "__call__": lambda self, *arguments, **options: called()(*arguments, **options),
        "__signature__": property(lambda self: inspect.signature(called())),
    }
    module.__class__ = type("CallableModule", (ModuleType,), members)
