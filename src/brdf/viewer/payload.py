"""What a page shows, as one container of bytes: materials, stages, meshes, environments, and how it starts."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import ParameterError, SceneError, UnknownNameError
from ..reflectance import Reflectance
from ..render import environment as environments_of
from ..render import lights as light_texts
from ..render import mesh as meshes_of
from ..render.environment import Environment
from ..render.lights import Directional, Light, Point
from ..render.mesh import Mesh
from ..render.tone import CURVES, require_exposure
from ..shaders import stages
from . import environments, materials, meshes
from .blob import Blob, container
from .library import library

VERSION = 1
"""Of the description."""

MOST_LIGHTS = 8

SHAPES = ("teapot", "sphere", "plane")
"""What every page has to choose from; the first is the default."""

UNIFORM = 1.0
"""Radiance of the environment that is the same everywhere, in every page beside the studio."""


@dataclass(frozen=True)
class View:
    """How a page starts: as `brdf.render` takes it. Raises SceneError, ParameterError, UnknownNameError, FileError."""

    mesh: str | os.PathLike[str] | Mesh = SHAPES[0]
    lights: Iterable[Light | str] | Light | str | None = None
    env: str | os.PathLike[str] | float | Environment | None = None
    exposure: float = 0.0
    tone: str = "filmic"
    shadows: bool = True
    chosen_mesh: Mesh = field(init=False, repr=False)
    chosen_lights: tuple[Light, ...] = field(init=False, repr=False)
    chosen_env: Environment | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        given = [self.lights] if isinstance(self.lights, (str, Directional, Point)) else self.lights
        lights = tuple(light_texts.parse(light) if isinstance(light, str) else light for light in given or ())
        if len(lights) > MOST_LIGHTS:
            raise SceneError(f"a page shows at most {MOST_LIGHTS} lights, got {len(lights)}")
        if self.tone not in CURVES:
            raise UnknownNameError("tone curve", self.tone, CURVES)
        require_exposure(self.exposure)
        env = "studio" if self.env is None and not lights else self.env
        object.__setattr__(self, "chosen_mesh", meshes_of.load(self.mesh))
        object.__setattr__(self, "chosen_lights", lights)
        object.__setattr__(self, "chosen_env", None if env is None else environments_of.load(env))

    @property
    def state(self) -> dict[str, Any]:
        """The same as plain data: what the page's script starts from."""
        cos, sin = (1.0, 0.0) if self.chosen_env is None else self.chosen_env.turn
        return {
            "mesh": self.chosen_mesh.name,
            "lights": [_light(light) for light in self.chosen_lights],
            "environment": None if self.chosen_env is None else self.chosen_env.name,
            "turn": float(np.degrees(np.arctan2(sin, cos))),
            "exposure": self.exposure,
            "tone": self.tone,
            "shadows": self.shadows,
        }


def payload(shown: Sequence[Reflectance], view: View | None = None, compare: bool = True) -> bytes:
    """The container for one or more reflectances.

    What has no formula is baked first, and its description says what that cost. With `compare`, how far the second is
    from the first is worked out here; without, the page does. Raises ParameterError without any reflectance;
    ReflectanceError as `shader_of`, or what baking raises.
    """
    if not shown:
        raise ParameterError("there is nothing to show; give at least one reflectance")
    view = view or View()
    blob = Blob()
    description = {
        "version": VERSION,
        "title": title_of(shown),
        "stages": stage_texts(),
        "materials": [materials.described(m, blob) for m in shown],
        "comparison": _comparison(shown) if compare and len(shown) > 1 else None,
        "meshes": [meshes.described(mesh, blob) for mesh in _meshes(view)],
        "environments": [environments.described(environment, blob) for environment in _environments(view)],
        "library": library(),
        "state": view.state,
    }
    return container(description, blob)


def title_of(shown: Sequence[Reflectance]) -> str:
    """The names, as they stand in the window's title."""
    return " · ".join(m.name or type(m).__name__ for m in shown)


def stage_texts() -> dict[str, Any]:
    """The shaders around a material, without `#version` lines."""
    shading = {shape: {"vertex": stages.vertex(shape), "fragment": stages.fragment(shape)} for shape in stages.SHAPES}
    evaluate = {"vertex": stages.vertex("screen"), "fragment": stages.evaluation()}
    depth = {"vertex": stages.vertex("mesh"), "fragment": stages.depth()}
    return shading | {"evaluate": evaluate, "depth": depth, "tone": stages.part("tone"), "material": stages.MATERIAL}


def _meshes(view: View) -> list[Mesh]:
    """The chosen one first."""
    others = [meshes_of.load(name) for name in SHAPES if name != view.chosen_mesh.name]
    return [view.chosen_mesh, *others]


def _environments(view: View) -> list[Environment]:
    others = [environments_of.load("studio"), environments_of.load(UNIFORM)]
    chosen = [] if view.chosen_env is None else [view.chosen_env]
    return chosen + [other for other in others if other.name not in {environment.name for environment in chosen}]


def _light(light: Light) -> dict[str, Any]:
    power = light.power.tolist()
    if isinstance(light, Directional):
        return {"kind": "directional", "theta": light.theta, "phi": light.phi, "power": power}
    return {"kind": "point", "position": light.position.tolist(), "power": power}


def _comparison(shown: Sequence[Reflectance]) -> dict[str, Any]:
    """How far the second is from the first, in numbers."""
    from ..metrics import compare

    reference, other = 0, 1
    return compare(shown[reference], shown[other]).numbers() | {"materials": [reference, other]}
