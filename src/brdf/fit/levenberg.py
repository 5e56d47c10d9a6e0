"""Levenberg-Marquardt within bounds, on normal equations; what the residuals are linear in is solved for.

Variable projection in the form of Ruhe and Wedin: the step of the others comes from the Schur complement of the linear
numbers, which are then put at their exact minimum within bounds. References: Golub2003, Ruhe1980, Marquardt1963.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .bounded import minimise_quadratic
from .equations import Normal
from .parameters import Component

Array = NDArray[np.float64]

FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-2, 1e-9, 1e9
LOWERED, RAISED = 0.2, 4.0
LONGEST = 2.0
"""Step of a coordinate at most: of a logarithm a factor of 7, of other numbers this share of their start range."""
NOISE = 3e-7
"""Relative rounding of a cost in single precision: changes below it say nothing."""


@dataclass(frozen=True)
class Problem:
    """What is searched: all numbers of a model, which of them are free, and which of those are linear."""

    components: list[Component]
    free: NDArray[np.bool_]
    linear: NDArray[np.bool_]
    """Those are free, too; none where the loss is not quadratic in f."""

    @property
    def searched(self) -> NDArray[np.intp]:
        """Numbers that are searched for by steps."""
        return np.flatnonzero(self.free & ~self.linear)

    def is_finite(self, normal: Normal) -> bool:
        """Whether a search can go on from there: derivatives overflow where values do not."""
        free = np.flatnonzero(self.free)
        derivatives = normal.gradient[free], normal.hessian[np.ix_(free, free)]
        return all(bool(np.isfinite(x).all()) for x in (normal.cost, *derivatives))

    @property
    def solved(self) -> NDArray[np.intp]:
        """Numbers that are solved for."""
        return np.flatnonzero(self.free & self.linear)


@dataclass(eq=False)
class Search:
    """One search: where it is, and how it goes on."""

    numbers: Array
    normal: Normal
    damping: float = FIRST_DAMPING
    steps: int = 0
    done: bool = False
    costs: list[float] = field(default_factory=list)

    @property
    def cost(self) -> float:
        return self.normal.cost


Evaluate = Callable[[Array], Normal]


def begin(problem: Problem, evaluate: Evaluate, numbers: Array) -> Search:
    """A search from these numbers, the linear ones put at their best."""
    numbers, normal = _projected(problem, evaluate, np.array(numbers, np.float64))
    return Search(numbers, normal, done=not problem.is_finite(normal) or not len(problem.searched))


def advance(problem: Problem, evaluate: Evaluate, search: Search, steps: int, tolerance: float = NOISE) -> Search:
    """Carry a search on, in place, until no step of those that are tried promises more than `tolerance` of the cost."""
    low, high = (np.array([c.bounds[side] for c in problem.components]) for side in (0, 1))
    longest = np.array([_longest(c) for c in problem.components])
    for _ in range(steps):
        if search.done:
            break
        search.steps += 1
        before = search.cost
        _step(problem, evaluate, search, (low, high, longest), tolerance)
        search.costs.append(search.cost)
        if search.cost >= before and search.damping > MOST_DAMPING:
            search.done = True
    return search


def _longest(c: Component) -> float:
    if c.is_log:
        return LONGEST
    low, high = c.start_range
    return max(high - low, 1e-3) / 2


def coordinates(problem: Problem, numbers: Array) -> Array:
    return np.array([c.to_coordinate(v) for c, v in zip(problem.components, numbers, strict=True)])


def _step(
    problem: Problem,
    evaluate: Evaluate,
    search: Search,
    limits: tuple[Array, Array, Array],
    tolerance: float,
) -> None:
    """Try one step; take it if it lowers the cost, else damp more."""
    low, high, longest = limits
    numbers, normal = search.numbers, search.normal
    q = coordinates(problem, numbers)
    slope = np.array([v if c.is_log else 1.0 for c, v in zip(problem.components, numbers, strict=True)])
    gradient, hessian = normal.gradient * slope, normal.hessian * np.outer(slope, slope)
    at_low, at_high = q <= low, q >= high
    held = (at_low & (gradient > 0)) | (at_high & (gradient < 0))
    moved = problem.searched[~held[problem.searched]]
    solved = problem.solved[~(at_low | at_high)[problem.solved]]
    S, coupling = hessian[np.ix_(moved, moved)], np.zeros((0, len(moved)))
    if len(solved) and len(moved):
        inner = hessian[np.ix_(solved, solved)]
        inner = inner + 1e-12 * np.diag(np.diag(inner) + 1e-300)
        coupling = np.linalg.lstsq(inner, hessian[np.ix_(solved, moved)], rcond=1e-12)[0]
        S = S - hessian[np.ix_(moved, solved)] @ coupling
    g = gradient[moved]
    if not len(moved):
        search.done = True
        return
    diagonal = np.maximum(np.diag(hessian)[moved], 1e-300)
    damped = S + search.damping * np.diag(np.maximum(np.diag(S), 1e-9 * diagonal))
    room_low, room_high = np.maximum(low - q, -longest)[moved], np.minimum(high - q, longest)[moved]
    step = minimise_quadratic(damped, g, room_low, room_high)
    promised = -float(g @ step + 0.5 * step @ S @ step)
    trial = q.copy()
    trial[moved] += step
    values = np.array([c.to_value(x) for c, x in zip(problem.components, trial, strict=True)])
    untouched = np.setdiff1d(np.arange(len(q)), moved)
    values[untouched] = numbers[untouched]
    if len(solved):
        values[solved] = np.clip(numbers[solved] - coupling @ step, low[solved], high[solved])
    new_numbers, new = _projected(problem, evaluate, values)
    last = promised <= tolerance * search.cost
    if problem.is_finite(new) and new.cost <= search.cost * (1 + (NOISE if last else 0)):
        search.numbers, search.normal = new_numbers, new
        search.damping = max(search.damping * LOWERED, LEAST_DAMPING)
        # Where damping or a bound kept the step short, a small promise does not mean that the minimum is near.
        search.done = last and (search.damping <= 1e-3)
    else:
        search.damping *= RAISED
        search.done = last


def _projected(problem: Problem, evaluate: Evaluate, numbers: Array) -> tuple[Array, Normal]:
    """The numbers with the linear ones at their best for the others, and the equations there."""
    normal = evaluate(numbers)
    solved = problem.solved
    if not len(solved) or not problem.is_finite(normal):
        return numbers, normal
    low = np.array([problem.components[k].low for k in solved])
    high = np.array([problem.components[k].high for k in solved])
    H, g = normal.hessian[np.ix_(solved, solved)], normal.gradient[solved]
    step = minimise_quadratic(H, g, low - numbers[solved], high - numbers[solved])
    gain = -float(g @ step + 0.5 * step @ H @ step)
    if gain <= NOISE * normal.cost:
        return numbers, normal
    moved = numbers.copy()
    moved[solved] = np.clip(numbers[solved] + step, low, high)
    return moved, evaluate(moved)
