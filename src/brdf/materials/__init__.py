"""Named materials: the published fits to the MERL measurements, as data with their source and licence."""

from .catalogue import Fit, fits, get, names, published

__all__ = ["Fit", "fits", "get", "names", "published"]
