"""What importing loads, and that the public names are where they are promised."""

from __future__ import annotations

import json
import pkgutil
import subprocess
import sys
from importlib.metadata import packages_distributions

import pytest

import brdf
from brdf.cli import verbs

HEAVY = {
    "scipy", "numba", "llvmlite", "matplotlib", "trimesh", "embreex", "imageio", "PIL", "OpenEXR", "safetensors",
    "rich", "typer", "pygments", "pydantic", "jax", "mitsuba", "drjit", "torch",
}  # fmt: skip


def modules_after(code: str) -> set[str]:
    """Top-level modules, not of the standard library, loaded in a fresh interpreter after `code`."""
    script = f"{code}\nimport sys, json\nprint(json.dumps(sorted({{n.partition('.')[0] for n in sys.modules}})))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, timeout=120)
    loaded = set(json.loads(done.stdout.splitlines()[-1]))
    known = set(packages_distributions()) | HEAVY
    return {name for name in loaded if name in known and not name.startswith("_")}


def test_importing_the_package_loads_numpy_and_nothing_heavier() -> None:
    assert modules_after("import brdf") <= {"brdf", "numpy"}


def test_a_model_evaluates_on_numpy_alone() -> None:
    code = "import brdf; brdf.models.GGX(alpha=.2)([0, 0, 1], [0, 0, 1]); brdf.load('gold-metallic-paint')"
    assert modules_after(code) & HEAVY == set()


def test_starting_the_command_line_loads_no_mathematics() -> None:
    loaded = modules_after("from brdf.cli import run; assert run(['--help']) == 0")
    assert "typer" in loaded
    assert loaded & (HEAVY - {"typer"}) == set()
    assert "numpy" not in loaded


@pytest.mark.parametrize("verb", [module.name for module in pkgutil.iter_modules(verbs.__path__)])
def test_the_help_of_a_verb_loads_no_mathematics(verb: str) -> None:
    loaded = modules_after(f"from brdf.cli import run; assert run([{verb!r}, '--help']) == 0")
    assert loaded & (HEAVY - {"typer", "pydantic"}) == set()
    assert "numpy" not in loaded


@pytest.mark.parametrize("name", brdf.__all__)
def test_every_public_name_is_there(name: str) -> None:
    assert getattr(brdf, name) is not None
    assert name in dir(brdf)


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'brdf' has no attribute 'rendr'"):
        brdf.rendr  # noqa: B018


def test_render_stays_a_function_whatever_is_imported_first() -> None:
    code = (
        "import brdf, brdf.render.cpu, brdf.render\n"
        "from brdf.render import Camera, render\n"
        "import inspect\n"
        "assert callable(brdf.render) and callable(render)\n"
        "assert 'mesh' in inspect.signature(brdf.render).parameters\n"
        "image = brdf.render(brdf.models.Lambertian(), mesh='sphere', size=(16, 12), samples=1)\n"
        "assert image.pixels.shape == (12, 16, 3)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)


def test_shapes_and_lights_load_no_compiler() -> None:
    code = "from brdf.render import Camera, Directional, Environment, Mesh; from brdf.render.mesh import load"
    code += "\nfrom brdf.render.environment import load as light; load('teapot'); load('plane'); light('studio')"
    assert modules_after(code) & HEAVY == set()
