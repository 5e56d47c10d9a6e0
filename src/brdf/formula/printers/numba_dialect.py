"""How expressions are spelt in a generated kernel: what varies from pair to pair, and what is the same for all."""

from __future__ import annotations

from .statements import Dialect


def _constant(value: float | bool) -> str:
    if isinstance(value, bool):
        return str(value)
    text = repr(value)
    return f"np.{text}" if text in ("inf", "nan") else text


_RESERVED = frozenset({
    "wi", "wo", "uv", "parameters", "out", "start", "stop", "clamp", "work", "bad", "first", "count", "i", "off",
    "lit", "value", "texels", "base", "number", "real", "types", "np", "njit", "uniform", "array", "kernel",
    "min", "max", "int", "ZERO", "ONE", "TOLERANCE", "ROWS", "BLOCK",
})  # fmt: skip

VARYING = Dialect(
    constant=lambda value: _constant(value) if isinstance(value, bool) else f"real({_constant(value)})",
    call=lambda op, arguments: f"{op}({', '.join(arguments)})",
    negation=lambda text: f"(not {text})",
    reserved=_RESERVED,
)
UNIFORM = Dialect(
    constant=_constant,
    call=lambda op, arguments: f"uniform.{op}({', '.join(arguments)})",
    negation=lambda text: f"(not {text})",
    reserved=_RESERVED,
)
