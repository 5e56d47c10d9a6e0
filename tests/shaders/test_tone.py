"""Tone curves in shaders are those of Python."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.render.gl import card
from brdf.render.tone import CURVES, developed
from brdf.shaders import stages

MAIN = """
uniform sampler2D radiance;
out vec4 shown;
void main() { shown = vec4(developed(texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
"""


@pytest.mark.usefixtures("gl")
def test_shaders_show_what_python_shows() -> None:
    radiance = np.random.default_rng(2).gamma(0.5, 1.0, (64, 64, 3)).astype(np.float32)
    with card() as opened:
        program = opened.program(
            stages.vertex("screen"), "\n".join([stages.part("precision"), stages.part("tone"), MAIN])
        )
        target = opened.target(64, 64, depth=False)
        program.bind("radiance", opened.texture(radiance[::-1]))
        program["exposure"] = 2.0**0.5
        target.framebuffer.use()
        for number, name in enumerate(CURVES):
            program["tone_curve"] = number
            program.draw(3)
            np.testing.assert_allclose(target.read()[..., :3], developed(radiance, name, 0.5), atol=2e-5)
