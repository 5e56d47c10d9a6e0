"""Compiled evaluation: trace, print, compile once, run on all cores.

A generated module is stored under its content's hash in the user's cache folder (`BRDF_CACHE` overrides it), where
numba keeps the machine code beside it: a second process compiles nothing. Threads share the kernel, which runs without
the interpreter lock.
"""

from __future__ import annotations

import functools
import hashlib
import importlib.util
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numba
import numpy as np

from ..threads import cores, map_threads
from . import math32, math64
from .engine import check_lengths
from .machine_code import cache_folder
from .printers.numba import print_kernel
from .printers.numba_blocks import BLOCK
from .trace import parameter_values, trace

_PER_TASK = 64 * BLOCK
"""Pairs a thread takes at a time."""

_kernels: dict[tuple[Any, ...], Callable[..., int]] = {}
_modules: dict[tuple[Any, ...], Path] = {}
_compilers: dict[Path, subprocess.Popen[bytes]] = {}
"""Processes that are compiling a module ahead of its use."""


def evaluate(reflectance: Any, wi: Any, wo: Any, clamp: bool, uv: Any = None) -> Any:
    """As `engine.evaluate`, compiled. Raises DirectionError."""
    kernel = kernel_for(reflectance, wi.dtype.name)
    parameters = np.array(parameter_values(reflectance.values), np.float64)
    textures = [np.ascontiguousarray(data, np.float32) for data in reflectance.textures.values()]
    out = np.empty(wi.shape, wi.dtype)
    places = [] if uv is None else [uv]

    def run(start: int) -> int:
        return kernel(wi, wo, *places, parameters, *textures, out, start, min(start + _PER_TASK, len(wi)), clamp)

    starts = range(0, len(wi), _PER_TASK)
    for bad in map_threads(run, starts):
        if bad >= 0:
            check_lengths(wi=wi[bad : bad + BLOCK], wo=wo[bad : bad + BLOCK])
    return out


def kernel_for(reflectance: Any, real: str) -> Callable[..., int]:
    """The compiled kernel of a reflectance for `real` = "float32" | "float64"."""
    key = (real, reflectance.structure)
    if key not in _kernels:
        module = _module_of(reflectance, real)
        compiler = _compilers.get(module)
        while compiler is not None and compiler.poll() is None and not _is_compiled(module):
            time.sleep(0.02)
        if compiler is not None and compiler.poll() is not None:
            del _compilers[module]
        _kernels[key] = loaded(module)
    return _kernels[key]


def is_ready(reflectance: Any, real: str) -> bool:
    """Whether the kernel runs at once: it is loaded, or its machine code lies on disk."""
    return (real, reflectance.structure) in _kernels or _is_compiled(_module_of(reflectance, real))


def compile_ahead(reflectances: Sequence[Any], real: str = "float32") -> None:
    """Have a process of its own compile the kernels that are not ready, while this one goes on with other things."""
    formulas = [m for m in reflectances if m.has_formula and not is_ready(m, real)]
    if not formulas or cores() == 1:
        return
    modules = [_module_of(m, real) for m in formulas]
    program = f"import sys, {__name__} as kernels\nfor path in sys.argv[1:]: kernels.loaded(kernels.Path(path))"
    compiler = subprocess.Popen(
        [sys.executable, "-c", program, *map(str, modules)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    _compilers.update(dict.fromkeys(modules, compiler))


def _is_compiled(module: Path) -> bool:
    # The machine code is what numba writes last; the index beside it (.nbi) comes before.
    elsewhere = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    folder, pattern = (Path(elsewhere), "*/") if elsewhere else (module.parent, "__pycache__/")
    return any(folder.glob(f"{pattern}{module.stem}.*.nbc"))


def _module_of(reflectance: Any, real: str) -> Path:
    """The generated module on disk, written if it is not there; a structure is traced and printed once."""
    key = (real, reflectance.structure, cache_folder())
    if key not in _modules or not _modules[key].exists():
        _modules[key] = _written(reflectance, real)
    return _modules[key]


def _written(reflectance: Any, real: str) -> Path:
    return stored(
        print_kernel(trace(reflectance), real, has_horizon=not reflectance.transmits, varies=reflectance.varies)
    )


def stored(source: str) -> Path:
    """The generated module of that source on disk, under its content's hash."""
    digest = hashlib.sha256((source + _environment()).encode()).hexdigest()[:24]
    path = cache_folder() / f"brdf_kernel_{digest}.py"
    if not path.exists():
        handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        with os.fdopen(handle, "w") as file:
            file.write(source)
        os.replace(temporary, path)
    return path


def loaded(path: Path) -> Callable[..., int]:
    """The kernel of a generated module: compiled, or loaded from numba's cache beside it."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    kernel: Callable[..., int] = module.kernel
    return kernel


@functools.cache
def _environment() -> str:
    """What the machine code depends on beside the source."""
    parts = [Path(str(module.__file__)).read_text() for module in (math32, math64)]
    return "".join([numba.__version__, sys.version, *parts])
