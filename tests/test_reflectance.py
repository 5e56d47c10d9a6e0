"""The contract's own guards: what is no direction, no set of numbers, no number of samples."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.errors import DirectionError, ParameterError
from brdf.models import GGX, Lambertian

UP = [0.0, 0.0, 1.0]


@pytest.mark.parametrize(
    ("wi", "said"),
    [
        ([0, 0, 2], "wi must hold unit vectors; the one at flat index 0 has length 2"),
        ([0, 0, np.nan], "length nan"),
        ([0, 1], r"wi must have shape \(..., 3\), got \(2,\)"),
        ("up", "wi must hold numbers"),
        ([0, 0, 1 + 1j], "wi must hold real numbers, got complex128"),
    ],
)
def test_what_is_no_direction_is_refused_by_values_and_densities(wi: object, said: str) -> None:
    for quantity in (GGX().__call__, GGX().raw, GGX().pdf):
        with pytest.raises(DirectionError, match=said):
            quantity(wi, UP)


@pytest.mark.parametrize(
    ("wo", "u", "error", "said"),
    [
        ([0, 0, 3], [0.1, 0.5], DirectionError, "wo must hold unit vectors; the one at flat index 0 has length 3"),
        (UP, [0.1, 0.5, 0.3], ParameterError, r"u must have shape \(..., 2\), got \(3,\)"),
        (UP, 0.5, ParameterError, r"u must have shape \(..., 2\), got \(\)"),
        ([UP] * 3, [[0.1, 0.5]] * 4, ParameterError, r"wo \(3, 3\) and u \(4, 2\) do not broadcast"),
    ],
)
def test_sampling_names_what_does_not_fit(wo: object, u: object, error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        Lambertian().sample(wo, u)


@pytest.mark.parametrize("samples", [0, -1, float("nan")])
def test_an_albedo_needs_samples(samples: float) -> None:
    with pytest.raises(ParameterError, match="samples must be at least 1"):
        GGX().albedo(UP, samples=samples)


def test_nothing_in_gives_nothing_out() -> None:
    none = np.zeros((0, 3))
    assert GGX()(none, UP).shape == (0, 3)
    assert GGX().albedo(none).shape == (0, 3)
    assert GGX().sample(none, np.zeros((0, 2))).wi.shape == (0, 3)
