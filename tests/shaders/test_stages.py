"""The stages around a material compile for every kind of reflectance, under both headers."""

from __future__ import annotations

from itertools import product

import pytest

from brdf.shaders import shader_of, stages
from cards import HEADERS, GLCard
from every_kind import MODELS, TABLES


def test_no_parameter_of_a_model_is_called_like_something_of_the_stages(gl: GLCard) -> None:
    with gl.context:
        for make in MODELS.values():
            if (m := make()).has_delta:
                continue
            vertex, fragment = stages.shading(shader_of(m, function="brdf_material"), "mesh")
            header = HEADERS["330 core"]
            gl.context.program(header + vertex, fragment_shader=header + fragment).release()


@pytest.mark.parametrize("name", ["GGX", "two-sided", "varying", "slice stack", "sphere images, separated"])
def test_the_stages_compile_around_every_kind(name: str, gl: GLCard) -> None:
    shader = shader_of((MODELS | TABLES)[name]())
    evaluation = stages.evaluation().replace(stages.MATERIAL, stages.material(shader))
    sources = [stages.shading(shader, shape) for shape in stages.SURFACES] + [(stages.vertex("screen"), evaluation)]
    with gl.context:
        for header, (vertex, fragment) in product(HEADERS.values(), sources):
            gl.context.program(header + vertex, fragment_shader=header + fragment).release()
