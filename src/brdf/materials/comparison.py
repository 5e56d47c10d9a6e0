"""How well the published fits agree with networks fitted to the same measurements, as measured by us.

The numbers are in `data/agreement.json`, made by `tools/measure_agreement.py` with the networks of Sztrajman2021, of
which 80 MERL materials exist. A network is itself a fit: it stands in for the measurement, which is not ours to ship.
"""

from __future__ import annotations

import functools
import json
from importlib import resources
from typing import Any

from .providers import fits


@functools.cache
def _table() -> dict[str, Any]:
    table: dict[str, Any] = json.loads(resources.files(__package__).joinpath("data/agreement.json").read_text("utf-8"))
    return table


def metric() -> str:
    """What the errors of `agreement` are."""
    return str(_table()["metric"])


def agreement(name: str) -> dict[str, float]:
    """Error by fit, smallest first: the median of |ln(f / f_network)|, see `metric`.

    0.1 means that half of the values are within 10 %. Empty where there is no network. Raises UnknownNameError.
    """
    fits(name)
    errors: dict[str, float] = _table()["errors"].get(name, {})
    return dict(sorted(errors.items(), key=lambda item: item[1]))
