"""What a fit may be told, checked before anything is read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..errors import ParameterError, UnknownNameError
from .losses import LOSSES
from .result import IMAGE
from .robust import require_known
from .samples import GRAZING, require_grazing

BUDGETS = {"quick": 4, "normal": 16, "thorough": 64}
"""Searches that are begun."""


@dataclass(frozen=True)
class Options:
    """The options of `brdf.fit`, which tells their meaning; numbers of NumPy become Python's, which JSON can hold.

    Raises ParameterError, UnknownNameError.
    """

    lobes: int | str = 1
    metric: str = "l2"
    diffuse: bool | None = None
    fixed: Sequence[str] = ()
    grazing: float = GRAZING
    robust: str | None = None
    budget: str | int = "normal"
    seed: int = 0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, np.generic):
                object.__setattr__(self, field.name, value.item())
        if not isinstance(self.lobes, int) and self.lobes != "auto":
            raise ParameterError(f'lobes must be 1 to 3 or "auto", got {self.lobes!r}')
        if self.metric != IMAGE and self.metric not in LOSSES:
            raise UnknownNameError("metric", str(self.metric), [*LOSSES, IMAGE])
        if self.robust is not None:
            require_known(self.robust)
            if self.metric == IMAGE:
                raise ParameterError("the image metric has no robust form; choose another metric or leave the loss out")
        require_grazing(self.grazing)
        if isinstance(self.budget, str) and self.budget not in BUDGETS:
            raise UnknownNameError("budget", self.budget, BUDGETS)
        if not isinstance(self.starts, int) or not 1 <= self.starts <= 4096:
            raise ParameterError(f"a fit begins 1 to 4096 searches, got {self.starts}")
        if not isinstance(self.seed, int) or self.seed < 0:
            raise ParameterError(f"a seed is a whole number from 0 on, got {self.seed!r}")

    @property
    def starts(self) -> int:
        """How many searches the budget begins."""
        return BUDGETS[self.budget] if isinstance(self.budget, str) else self.budget
