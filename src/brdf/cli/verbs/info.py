"""`brdf info`: what a material, a model or a file is."""

from __future__ import annotations

import inspect
import math
import textwrap
from typing import TYPE_CHECKING, Any

from .. import arguments, output

if TYPE_CHECKING:
    from ...parameters import Parameter, Parameterised
    from ...reflectance import Reflectance


def command(material: arguments.Material, json: arguments.AsJson = False) -> None:
    """Describe a material, a model or a file.

    Equation, source, parameters with bounds and units, sizes, what was measured.

    \b
    Examples:
      brdf info GGX
      brdf info gold-metallic-paint
      brdf info measured.binary --json
    """
    m = arguments.load(material)
    described = describe(m) | _file(material) | _fits(material)
    if json:
        output.print_json(described)
    else:
        _print(described)


def describe(m: Reflectance) -> dict[str, Any]:
    """Everything there is to say of a reflectance, as plain data."""
    from ...representations.spheres.sphere_images import SphereImages
    from ...representations.tables.table import Table

    doc = inspect.getdoc(type(m)) or ""
    described: dict[str, Any] = {
        "name": m.name or type(m).__name__,
        "kind": type(m).__name__,
        "description": doc,
        "source": m.source,
        "bytes": m.nbytes,
        "isotropic": m.isotropic,
        "transmits": m.transmits,
        "breaks": dict(m.breaks),
        "choices": _choices(m),
        "parameters": _parameters(m),
        "arrays": _arrays(m),
        "textures": {name: [*texture.shape] for name, texture in m.textures.items()},
    }
    if m.children:
        described["lobes"] = {key: describe(child) for key, child in m.children.items()}
    wavelengths = getattr(m, "wavelengths", None)
    if wavelengths is not None:
        described["wavelengths"] = [float(w) for w in wavelengths]
    if isinstance(m, Table):
        described["grid"] = {
            "axes": list(m.layout.basis.axes), "shape": list(m.layout.shape), "storage": m.layout.storage,
            "invalid_share": 1 - float(m.measured.mean()),
        }  # fmt: skip
    if isinstance(m, SphereImages):
        described["pictures"] = {
            "angles": m.angles.tolist(), "size": m.size, "storage": m.storage, "blend": m.blend,
        }  # fmt: skip
    return described


def _file(spec: str) -> dict[str, Any]:
    from ... import io
    from ...conversion import bytes_on_disk
    from ...loading import is_file

    if not is_file(spec):
        return {}
    return {"file": {"path": spec, "format": io.format_of(spec).name, "bytes": bytes_on_disk(spec)}}


def _fits(spec: str) -> dict[str, Any]:
    """The published fits of a shipped material, with their errors where they are known."""
    from ... import materials
    from ...loading import is_file
    from ...materials import catalogue

    name = spec.partition("@")[0]
    if is_file(spec) or name not in catalogue.names():
        return {}
    errors = materials.agreement(name)
    ordered = errors or catalogue.fits(name)
    return {"fits": [{"fit": fit, "error": errors.get(fit)} for fit in ordered], "fit_metric": materials.metric()}


def _choices(m: Any) -> dict[str, dict[str, Any]]:
    from ...parameters import Parameterised

    if not isinstance(m, Parameterised):
        return {}
    found = {}
    for name, declared in m._choices.items():
        if len(declared.options) > 1:
            options = {option: _names(part) for option, part in declared.options.items()}
            found[name] = {"value": m.choices[name], "options": options, "doc": declared.doc}
    return found


def _names(part: Any) -> list[str]:
    """Parameters and arrays that come with an option of a choice."""
    from ...parameters import Parameterised

    is_part = isinstance(part, type) and issubclass(part, Parameterised)
    return [*part._declared, *part._declared_textures] if is_part else []


def _parameters(m: Any) -> list[dict[str, Any]]:
    from ...parameters import Parameterised

    return [_row(m, name, p) for name, p in m.declarations().items()] if isinstance(m, Parameterised) else []


def _arrays(m: Any) -> list[dict[str, Any]]:
    """The arrays that can be given; a bound of None is none."""
    from ...parameters import Parameterised

    def finite(bound: float) -> float | None:
        return bound if math.isfinite(bound) else None

    declared = m.declared_textures() if isinstance(m, Parameterised) else {}
    return [
        {
            "name": name, "shape": [*"n" * t.dimensions, t.channels], "low": finite(t.low), "high": finite(t.high),
            "unit": t.unit, "doc": t.doc,
        }
        for name, t in declared.items()
    ]  # fmt: skip


def _row(m: Parameterised, name: str, parameter: Parameter) -> dict[str, Any]:
    value = m.values.get(name)
    return {
        "name": name, "value": value if value is None or isinstance(value, float) else [*map(float, value)],
        "default": parameter.default, "follows": parameter.follows,
        "low": parameter.low, "high": parameter.high, "unit": parameter.unit, "doc": parameter.doc,
    }  # fmt: skip


# ---- for people --------------------------------------------------------------------------------------------------


def _print(d: dict[str, Any], indent: str = "") -> None:
    def line(key: str, value: str) -> None:
        print(f"{indent}{key:<12} {value}")

    print(f"{indent}{d['name']}  ({d['kind']})")
    if "file" in d:
        line("file", f"{d['file']['path']}, {d['file']['format']}, {output.format_bytes(d['file']['bytes'])}")
    if d["source"]:
        line("source", d["source"])
    line("memory", output.format_bytes(d["bytes"]))
    line("symmetry", "isotropic" if d["isotropic"] else "anisotropic")
    if "grid" in d:
        grid = d["grid"]
        sizes = " x ".join(f"{n} {axis}" for n, axis in zip(grid["shape"], grid["axes"], strict=True))
        line("grid", f"{sizes}, {grid['storage']}")
        line("invalid", f"{grid['invalid_share']:.1%} of the nodes")
    if "pictures" in d:
        pictures = d["pictures"]
        angles = ", ".join(f"{angle:g}°" for angle in pictures["angles"])
        line("pictures", f"{pictures['size']} x {pictures['size']} for lights at {angles} from the viewer")
        line("stored as", f"{pictures['storage']}, blend {pictures['blend']}")
    if "wavelengths" in d:
        w = d["wavelengths"]
        line("wavelengths", f"{len(w)}, {w[0]:g} to {w[-1]:g} nm")
    for name, shape in d["textures"].items():
        line("array", f"{name}, {' x '.join(map(str, shape))}")
    for law, reason in d["breaks"].items():
        line("breaks", f"{law}: {reason}")
    print("\n" + "\n".join(f"{indent}{text}".rstrip() for text in d["description"].splitlines()))
    for name, choice in d["choices"].items():
        print(f"\n{indent}{name} = {choice['value']}: {choice['doc']}")
        for option, names in choice["options"].items():
            print(f"{indent}  {option:<16} {', '.join(names)}".rstrip())
    if d["parameters"]:
        print()
        rows = [_cells(p) for p in d["parameters"]]
        output.print_table(("parameter", "value", "bounds", "unit", "meaning"), rows, indent)
    if d["arrays"]:
        print()
        shown = [(a["name"], " x ".join(map(str, a["shape"])), _bounds(a), a["unit"], a["doc"]) for a in d["arrays"]]
        output.print_table(("array", "shape", "bounds", "unit", "meaning"), shown, indent)
    for key, lobe in d.get("lobes", {}).items():
        print(f"\n{indent}{key}:")
        _print(lobe, indent + "  ")
    if "fits" in d:
        _print_fits(d)


def _print_fits(d: dict[str, Any]) -> None:
    """All fits of the material, the best agreeing one first."""
    known = [fit for fit in d["fits"] if fit["error"] is not None]
    errors = [f"{fit['error']:.3f}" if fit in known else "" for fit in d["fits"]]
    print(f"\npublished fits, as {d['name']}@FIT:")
    output.print_table(("fit", "error"), [(f["fit"], e) for f, e in zip(d["fits"], errors, strict=True)], "  ")
    if not known:
        print("  No network of this material is known to compare them with.")
        return
    share = math.expm1(known[0]["error"])
    text = (
        f"{known[0]['fit']} agrees best: half of its values are within {share:.0%} of a network fitted to the "
        f"measurement. error = {d['fit_metric']}."
    )
    print(textwrap.fill(text, 100, initial_indent="  ", subsequent_indent="  "))


def _cells(p: dict[str, Any]) -> tuple[str, ...]:
    value = p["value"]
    if value is None:
        shown = f"as {p['follows']}" if p["follows"] else "not in force"
    else:
        shown = " ".join(f"{v:.4g}" for v in (value if isinstance(value, list) else [value]))
    return p["name"], shown, _bounds(p), p["unit"], p["doc"]


def _bounds(p: dict[str, Any]) -> str:
    low, high = p["low"], p["high"]
    left = "(-∞" if low is None or math.isinf(low) else f"[{low:g}"
    right = "∞)" if high is None or math.isinf(high) else f"{high:g}]"
    return f"{left}, {right}"
