"""`brdf.fit`: a model and data in, a `FitResult` out."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, ReflectanceError, UnknownNameError
from ..metrics import direction_pairs
from ..reflectance import Reflectance
from .covariance import certainty, sandwich
from .data import Data, data_of
from .energy import gains
from .equations import Equations, Normal, rows_of
from .levenberg import Problem, Search, advance, begin
from .losses import LOSSES, Loss, loss_named
from .multistart import FEW, distinct, energy_of, polish, run_rounds, same, start_points, stratified
from .options import Options
from .parameters import Component, components, grouped, with_values
from .pictures import PictureEquations, radiances
from .result import IMAGE, Estimate, FitResult, errors_of, residual_map
from .robust import MOST, refine
from .samples import GRAZING, Samples
from .template import most_lobes, template_of

Array = NDArray[Any]

MOST_STEPS = 200
"""Of the last search, on all samples."""


def fit(
    data: Any,
    model: Any,
    lobes: int | str = 1,
    metric: str = "l2",
    *,
    diffuse: bool | None = None,
    fixed: Sequence[str] = (),
    grazing: float = GRAZING,
    robust: str | None = None,
    budget: str | int = "normal",
    seed: int = 0,
    say: Callable[[str], None] = lambda text: None,
) -> FitResult:
    """The numbers of a model with which it is nearest to data.

    `data`: a reflectance, `Samples`, or a material as `brdf.load` takes it, a file for instance. `model`: a class of
    `brdf.models`, its name, or a reflectance made of models, whose numbers are one start. `lobes`: how many copies of
    it, 1 to 3, or "auto" for the number with the least BIC (Schwarz1978); a Lambertian part is added where the model
    has none, or as `diffuse` says. `metric`: what is made small, "l2", "log", "log-relative", "cube-root" or "image";
    all are reported. `fixed`: parameters that keep their values, by full name. `grazing`: degrees from the normal
    beyond which nothing is fitted. `robust`: "soft_l1", "huber" or "cauchy", to count outliers less. `budget`: "quick",
    "normal" or "thorough" (4, 16, 64 starts), or the number of starts. The same `seed` gives the same result. `say` is
    told what is under way.

    Raises ParameterError, UnknownNameError, ReflectanceError.
    """
    begun = time.perf_counter()
    options = Options(lobes, metric, diffuse, fixed, grazing, robust, budget, seed)
    samples, reflectance = data if isinstance(data, Data) else data_of(data, options.grazing)
    if metric == IMAGE and reflectance is None:
        raise ParameterError("the image metric needs a reflectance to make pictures of")
    isotropic = reflectance is None or reflectance.isotropic
    pictures = radiances(reflectance) if reflectance is not None else None
    results = []
    for count in range(1, most_lobes(model) + 1) if isinstance(options.lobes, str) else [options.lobes]:
        template = template_of(model, count, diffuse, isotropic)
        name = model if isinstance(model, str) else getattr(model, "__name__", "") or _label(model)
        say(f"{name}, {count} lobes" if count > 1 else name)
        one = _Fit(template, samples, pictures, options, say)
        results.append(one.result(name, count, begun))
    return min(results, key=lambda r: r.bic)


def _label(model: Any) -> str:
    return str(getattr(model, "name", "") or type(model).__name__)


class _Fit:
    """One template fitted to one set of samples."""

    def __init__(
        self, template: Reflectance, samples: Samples, pictures: Array | None, options: Options,
        say: Callable[[str], None],
    ) -> None:  # fmt: skip
        if not template.has_formula or template.transmits or template.has_delta:
            raise ReflectanceError(f"{template.name} has no formula of reflection, or mirrors: a fit needs values")
        self.template, self.samples, self.pictures = template, samples, pictures
        self.options, self.say = options, say
        self.image = PictureEquations(template, pictures) if options.metric == IMAGE and pictures is not None else None
        self.loss: Loss = loss_named("l2" if self.image else options.metric)
        self.components = components(template)
        self.free = _free(self.components, options.fixed)
        self.linear = np.array([c.is_linear for c in self.components])

    def result(self, name: str, lobes: int, begun: float) -> FitResult:
        few = stratified(self.samples, self.loss, FEW, self.options.seed)
        # Colours are solved for in a quadratic loss with the slope of the wanted one at the data.
        quadratic = few if self.loss.quadratic else _linearised(few, self.loss)
        equations = Equations(self.template, quadratic, LOSSES["l2"])
        self.free &= ~_interchangeable(self.template, self.linear, self.free, self.options.seed)
        problem = Problem(self.components, self.free, self.linear & self.free)
        points = start_points(self.components, self.free, self.options.starts, self.options.seed)
        self.say(f"{name}: {len(points)} starts")
        searches = run_rounds(problem, equations, points)
        if not searches:
            raise ParameterError(f"no start of {name} gives finite values; start from parameters that do")
        energy = energy_of(few)
        agreeing = sum(same(s.cost, searches[0].cost, energy) for s in searches)
        numbers = self._finished(problem, distinct(searches, energy), few)
        used, scale = self.samples, math.inf
        if self.options.robust is not None:
            used = stratified(self.samples, self.loss, MOST, self.options.seed)
            plain = Equations(self.template, used.reweighted(np.ones_like(used.weight)), self.loss)
            numbers, scale = refine(problem, plain, used.weight.astype(np.float64), numbers, self.options.robust)
        return self._described(name, lobes, numbers, agreeing, begun, used, scale)

    def _finished(self, problem: Problem, candidates: list[Search], few: Samples) -> Array:
        """The best numbers on all samples."""
        joint = problem
        if not self.loss.quadratic or self.image:
            joint = replace(problem, linear=np.zeros_like(problem.linear))
            evaluate: Callable[[Array], Normal] = self.image or Equations(self.template, few, self.loss)
            candidates = [begin(joint, evaluate, s.numbers) for s in candidates]
            for search in candidates:
                advance(joint, evaluate, search, MOST_STEPS)
            candidates.sort(key=lambda s: s.cost)
        if self.image:
            return candidates[0].numbers
        if len(few) < len(self.samples):
            self.say("polishing on all samples")
            everything = Equations(self.template, self.samples, self.loss)
            best = polish(joint, everything, candidates, MOST_STEPS)
        else:
            best = candidates[0]
            exact = Equations(self.template, few, self.loss, "float64")
            best = advance(joint, exact, begin(joint, exact, best.numbers), MOST_STEPS, 1e-12)
        return best.numbers

    def _described(
        self, name: str, lobes: int, numbers: Array, agreeing: int, begun: float, used: Samples, scale: float
    ) -> FitResult:
        """`used`: what determined the numbers; `scale`: where its robust loss begins to count less."""
        made = with_values(self.template, grouped(numbers, self.components))
        samples, loss = self.samples, self.loss
        made.named(f"{samples.name} by {name}" if samples.name else name, f"fitted to {samples.source or samples.name}")
        fitted = np.asarray(made(samples.wi, samples.wo))
        cost, count = self._cost(numbers, fitted)
        shared = max(int(self.free[list(active)].sum()) for active in rows_of(self.template, loss).active)
        residuals = self.image.size if self.image else 3 * len(used)
        both = (
            self.image.sandwich(numbers, samples.is_monochrome)
            if self.image
            else sandwich(made, used, loss, numbers, self.options.robust, scale)
        )
        sure = certainty(self.components, numbers, self.free, *both, residuals if residuals > 3 * shared else 0)
        states = [
            "held" if not free else "at bound" if np.isnan(error) else "free"
            for free, error in zip(self.free, sure.errors, strict=True)
        ]
        estimates = tuple(
            Estimate(c.name, float(v), float(e), state)
            for c, v, e, state in zip(self.components, numbers, sure.errors, states, strict=True)
        )
        copies = 3 if samples.is_monochrome else 1
        count, determined = count // copies, shared if copies == 3 else int(self.free.sum())
        bic = count * np.log(max(2 * cost / copies, 1e-300) / count) + determined * np.log(count)
        return FitResult(
            made, samples.name, name, lobes, self.options.metric, estimates, sure.correlation,
            sure.warnings + gains(made),
            errors_of(samples, fitted, self.pictures, made), residual_map(samples, fitted), cost, float(bic),
            len(samples), samples.left_out, samples.grazing, self.options.starts, agreeing, self.options.seed,
            time.perf_counter() - begun, self.options.robust or "",
        )  # fmt: skip

    def _cost(self, numbers: Array, fitted: Array) -> tuple[float, int]:
        """Half the weighted sum of squared residuals of what was made small, and how many there are."""
        if self.image:
            return self.image(numbers).cost, self.image.size
        cosine = self.samples.wi[:, 2:]
        residual = self.loss.scale(fitted * cosine) - self.loss.scale(self.samples.values * cosine)
        return 0.5 * float(np.sum(self.samples.weight * np.square(residual), dtype=np.float64)), residual.size


def _free(all_components: list[Component], fixed: Iterable[str]) -> NDArray[np.bool_]:
    known = {c.parameter for c in all_components}
    for name in fixed:
        if name not in known:
            raise UnknownNameError("parameter", name, known)
    return np.array([c.parameter not in set(fixed) for c in all_components])


def _linearised(samples: Samples, loss: Loss) -> Samples:
    """With the weights that make a quadratic loss of f cos near the data what `loss` is."""
    cosine = samples.wi[:, 2:]
    slope = np.asarray(loss.slope(samples.values * cosine), np.float64)
    return samples.reweighted(samples.weight * slope**2)


def _interchangeable(
    m: Reflectance, linear: NDArray[np.bool_], free: NDArray[np.bool_], seed: int
) -> NDArray[np.bool_]:
    """(P,) free numbers that do nothing, in any channel, that others do not do as well, wherever one looks.

    They are held: first what is not linear (a normalisation beside a scale), then what acts on most channels (a weight
    beside a colour), then the later one.
    """
    wi, wo, weight = direction_pairs(polar=12, difference=8, azimuth=8)
    part = Samples.of(wi, wo, np.zeros(len(wi)), weight)
    equations = Equations(m, part, LOSSES["l2"])
    seen, alike = np.zeros((2, 3, len(free), len(free)), np.intp)
    for point in start_points(components(m), np.ones_like(free), 8, seed):
        for channel, rows in enumerate(equations.rows_at(point)):
            ids, J = np.array(equations.active(channel), np.intp), rows[:-1]
            length = np.linalg.norm(J, axis=1)
            told = free[ids] & np.isfinite(length) & (length > 0)
            ids, J = ids[told], J[told] / length[told, None]
            seen[(channel, *np.ix_(ids, ids))] += 1
            alike[(channel, *np.ix_(ids, ids))] += np.abs(J @ J.T) > 1 - 1e-12
    stands_for = (seen > 1) & (alike == seen) & ~np.eye(len(free), dtype=np.bool_)  # (channels, P, P)
    acts = np.diagonal(seen, axis1=1, axis2=2) > 1
    held = np.zeros_like(free)
    for k in sorted(range(len(free)), key=lambda k: (linear[k], -acts[:, k].sum(), -k)):
        others = (stands_for[:, k] & ~held).any(1)
        held[k] = acts[:, k].any() and others[acts[:, k]].all()
    return held
