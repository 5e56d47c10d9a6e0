"""One file or material into another format or representation, and what that costs."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from . import inputs, io, metrics
from .errors import ParameterError, UnknownNameError
from .loading import load
from .reflectance import Reflectance
from .representations.baking.slice_stack import SliceStack
from .representations.spheres.sphere_images import SphereImages
from .representations.tables.table import Table

REPRESENTATIONS: dict[str, Callable[..., Reflectance]] = {
    "slice-stack": SliceStack.bake,
    "sphere-images": SphereImages.bake,
    "table": Table.bake,
}
"""What a reflectance can be baked to, by name: functions of it and of their own options; the first is the default."""

DEFAULT = next(iter(REPRESENTATIONS))


class Conversion(NamedTuple):
    """What `convert` did."""

    source: Reflectance
    written: Reflectance
    """as read back from the file"""
    comparison: metrics.Comparison
    """how far `written` is from `source`"""
    file_bytes: int
    """size of the file, or of all files of the folder"""


def options_of(representation: str) -> frozenset[str]:
    """The names of the options that baking to a representation takes. Raises UnknownNameError."""
    if representation not in REPRESENTATIONS:
        raise UnknownNameError("representation", representation, REPRESENTATIONS)
    return frozenset([*inspect.signature(REPRESENTATIONS[representation]).parameters][1:])


def representation_for(options: Mapping[str, Any]) -> str:
    """The default representation, or the only one that takes all these options."""
    taking = [name for name in REPRESENTATIONS if options.keys() <= options_of(name)]
    return taking[0] if len(taking) == 1 else DEFAULT


def bake(m: Reflectance, representation: str | None = None, **options: Any) -> Reflectance:
    """`m` as a "slice-stack", as "sphere-images" or as a "table", with the options of `SliceStack.bake`,
    `SphereImages.bake` or `Table.bake`. Without a name as `representation_for` says.

    Raises UnknownNameError; ParameterError for an option of another representation; whatever the representation's
    `bake` raises.
    """
    chosen = representation or representation_for(options)
    taken = options_of(chosen)
    for option in options:
        if option not in taken:
            takers = [name for name in REPRESENTATIONS if option in options_of(name)]
            belongs = f"it belongs to {' and '.join(takers)}" if takers else f"known: {', '.join(sorted(taken))}"
            raise ParameterError(f"{option!r} has no effect with {chosen}; {belongs}")
    baked = REPRESENTATIONS[chosen](m, **options)
    return baked.named(m.name, f"{chosen} of {m.source or m.name}")


def convert(
    source: str | os.PathLike[str] | Reflectance,
    target: str | os.PathLike[str],
    representation: str | None = None,
    format: str | None = None,
    **options: Any,
) -> Conversion:
    """Write `source` (whatever `brdf.load` takes) to `target`, in the format of its extension or the one named.

    With a representation or options it is first baked (see `bake`). What was written is read back and compared with the
    source. Raises as `load`, `bake` and `io.write`; FileError where `target` is the source.
    """
    with inputs.kept():
        m = source if isinstance(source, Reflectance) else load(source)
        io.write(bake(m, representation, **options) if representation or options else m, target, format)
        written = io.read(target)
    return Conversion(m, written, metrics.compare(m, written), bytes_on_disk(target))


def bytes_on_disk(path: str | os.PathLike[str]) -> int:
    """The size of a file, or of all files of a folder."""
    place = Path(path)
    files = place.rglob("*") if place.is_dir() else [place]
    return sum(file.stat().st_size for file in files if file.is_file())
