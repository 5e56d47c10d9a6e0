"""LLVM's library for Dr.Jit: found before Dr.Jit looks for one itself.

With LLVM 15 or 16 Dr.Jit loads, and the process ends at the first minimum or maximum (`Cannot select: fmaximum`): such
a library is refused here, in a message. Looked for are DRJIT_LIBLLVM_PATH, packages of PyPI that bring one, and the
system's libraries.
"""

from __future__ import annotations

import importlib.util
import os
import re
import sys
from pathlib import Path

from ..errors import ParameterError

VARIABLE = "DRJIT_LIBLLVM_PATH"
LEAST = 19
"""The oldest version that works."""

_PACKAGES = ("llvm_nanobind",)
"""Of PyPI, with a library inside; `karellen-llvm-core` puts one into the environment's folder lib."""
_FOLDERS = ("/usr/lib", "/usr/lib64", "/usr/local/lib", "/opt/homebrew/opt/llvm/lib", "/usr/local/opt/llvm/lib")
_NAME = re.compile(r"(?:lib)?LLVM(?:-C)?[-.]?(\d+)?[\w.-]*\.(?:so|dylib|dll)([\d.]*)")


def require_llvm() -> Path:
    """The library that Dr.Jit will load; the environment says so from then on. Raises ParameterError."""
    given = os.environ.get(VARIABLE)
    if given:
        version = version_of(Path(given))
        if version is not None and version < LEAST:
            raise ParameterError(f"{VARIABLE}={given} is LLVM {version}; Mitsuba needs {LEAST} or newer")
        return Path(given)
    found = {path: version for path in candidates() if (version := version_of(path)) is not None}
    usable = [path for path, version in found.items() if version >= LEAST]
    if not usable:
        seen = f"found only {', '.join(sorted({f'LLVM {v}' for v in found.values()}))}" if found else "found none"
        advice = f"install one (Debian: libllvm{LEAST}) or set {VARIABLE}, or take the variant scalar_rgb"
        raise ParameterError(f"Mitsuba's LLVM variants need LLVM {LEAST} or newer; {seen}: {advice}")
    best = max(usable, key=lambda path: found[path])
    os.environ[VARIABLE] = str(best)
    return best


def candidates() -> list[Path]:
    """Libraries of LLVM: those of packages first, then the system's."""
    found: list[Path] = []
    for package in _PACKAGES:
        spec = importlib.util.find_spec(package)
        for place in spec.submodule_search_locations or [] if spec else []:
            folder = Path(place)
            for root in (folder, folder.parent / f"{package}.libs"):
                found += root.rglob("*LLVM*") if root.is_dir() else []
    for name in (
        f"{sys.prefix}/lib",
        *_FOLDERS,
        *sorted(f"/usr/lib/{p.name}" for p in Path("/usr/lib").glob("*-linux-gnu")),
    ):
        folder = Path(name)
        found += folder.glob("*LLVM*") if folder.is_dir() else []
    if sys.platform == "linux":
        found += [path for root in Path("/usr/lib").glob("llvm-*") for path in (root / "lib").glob("libLLVM*")]
    return [path for path in found if path.is_file() and _NAME.fullmatch(path.name)]


def version_of(path: Path) -> int | None:
    """The major version that the name of a library, or of what it links to, tells."""
    for name in (path.name, Path(os.path.realpath(path)).name):
        match = _NAME.fullmatch(name)
        if match is not None:
            told = match[1] or match[2].strip(".").partition(".")[0]
            if told and int(told) > 1:
                return int(told)
    return None
