"""Where machine code is kept between processes."""

from __future__ import annotations

import functools
import os
import tempfile
from pathlib import Path

import numba

_PACKAGE = Path(__file__).parents[1]


@functools.cache
def cache_folder() -> Path:
    """The folder of generated kernels: `BRDF_CACHE`, the user's cache folder, or a temporary one."""
    roots = [os.environ.get("BRDF_CACHE"), os.environ.get("XDG_CACHE_HOME"), Path.home() / ".cache"]
    for root in roots:
        if root and _is_writable(folder := Path(root) / "brdf" / "kernels"):
            return folder
    return Path(tempfile.mkdtemp(prefix="brdf-kernels-"))


@functools.cache
def kept_on_disk() -> bool:
    """True: what numba's `cache` option must say; before that, sees to it that there is a place.

    Numba keeps the machine code of a function beside its source. Where the package may not be written to (installed by
    an administrator, a container's image) it is kept with the generated kernels: numba's own way out is a folder in the
    user's home, and an error where that is not writable either.
    """
    if not numba.config.CACHE_DIR and not _is_writable(_PACKAGE / "__pycache__"):  # type: ignore[attr-defined]
        numba.config.CACHE_DIR = str(cache_folder())  # type: ignore[attr-defined]
    return True


def _is_writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False
