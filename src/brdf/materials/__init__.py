"""Named materials, as data with their source and licence: published fits to the MERL measurements, measured metals."""

from . import krivanek, metals
from .catalogue import Fit, published
from .comparison import agreement, metric
from .providers import fits, get, names

__all__ = ["Fit", "agreement", "fits", "get", "krivanek", "metals", "metric", "names", "published"]
