"""Shading maps with r at the vertices, drawn by OpenGL."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...combinators import Scaled
from ...formula.vec import Vec
from ...parameters import Parameterised
from ...reflectance import Reflectance
from ...representations.shading.shading_map import ShadingMap
from ...shaders import shader_of, stages
from ..progress import Report
from ..task import Task
from .renderer import FUNCTION, Stages, drawn

Floats = NDArray[np.float32]


class HandedOn(Parameterised, Reflectance):
    """f(wi, wo) = wo_x: a number that takes the place of a direction, where a formula is to be evaluated for it."""

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return Vec(wo.x, wo.x, wo.x)

    def _state(self) -> Any:
        raise NotImplementedError("it lives in a shader alone")

    @classmethod
    def _restore(cls, header: Any, arrays: Any, children: Any) -> Reflectance:
        raise NotImplementedError("it lives in a shader alone")


def draw_per_vertex(task: Task, progress: Report | bool | None = None) -> tuple[Floats, Floats]:
    """As `draw`, for a task of one shading map under one light. Raises as it does."""
    (shading_map,) = task.reflectances
    assert isinstance(shading_map, ShadingMap)
    # The factor's name keeps the reflectance's parameters apart from those of the pictures.
    brdf = shader_of(Scaled(shading_map.children["brdf"], shading_map.sigma), function=FUNCTION)
    picture = shader_of(shading_map.replaced(brdf=HandedOn(), sigma=1.0, technique="shading"), function=FUNCTION)
    return drawn(task, [Stages(*stages.per_vertex(brdf, picture), (brdf, picture), once_a_pixel=False)], progress)
