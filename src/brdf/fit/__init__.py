"""Models fitted to data: starts, bounds and derivatives follow from what the models declare."""

from ..callable_module import make_callable
from .batch import Batch, fit_many
from .data import Data, data_of
from .fitting import fit
from .losses import LOSSES
from .options import BUDGETS
from .result import IMAGE, Estimate, FitResult
from .samples import GRAZING, Samples, samples_of

__all__ = [
    "BUDGETS", "GRAZING", "IMAGE", "LOSSES", "Batch", "Data", "Estimate", "FitResult", "Samples", "data_of", "fit",
    "fit_many", "samples_of",
]  # fmt: skip

make_callable(__name__, fit)
