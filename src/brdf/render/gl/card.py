"""OpenGL: the driver, and what is kept in its memory for a while."""

from __future__ import annotations

import functools
import sys
import threading
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import DriverError, SceneError
from ...shaders.texels import LARGEST

Floats = NDArray[np.float32]

HEADER = "#version 330 core\n"

LIST_WIDTH = 2048
"""Texels in a row of a texture that holds a list."""

FIRST_UNIT = 1
"""Unit 0 stays with the samplers that nothing is bound to: two kinds of samplers on one unit draw nothing."""

TYPES = {"UNSIGNED_BYTE": "f1", "HALF_FLOAT": "f2", "FLOAT": "f4"}
"""moderngl's names of the types of texels."""


class Card:
    """A driver. `with card:` makes it this thread's alone; what is made within is released at the end."""

    def __init__(self) -> None:
        """Raises DriverError."""
        try:
            import moderngl
        except ImportError:
            raise DriverError("drawing with OpenGL needs an optional dependency: pip install 'brdf[gl]'") from None
        backend: dict[str, Any] = {"backend": "egl"} if sys.platform.startswith("linux") else {}
        try:
            self.context: Any = moderngl.create_context(330, True, **backend)
        except Exception as error:  # moderngl raises plain exceptions
            advice = "; Debian has a software driver in libegl1 libgl1-mesa-dri libgl1" if backend else ""
            raise DriverError(f"no OpenGL here ({str(error).splitlines()[0]}){advice}") from None
        self._gl, self._lock, self._made = moderngl, threading.RLock(), list[Any]()
        self._idle = self.context.simple_framebuffer((1, 1))

    @property
    def name(self) -> str:
        """What draws, in the driver's words."""
        return str(self.context.info["GL_RENDERER"])

    @property
    def is_software(self) -> bool:
        """Whether it is the processor that draws."""
        return any(word in self.name.lower() for word in ("llvmpipe", "softpipe", "swiftshader", "swrast"))

    def __enter__(self) -> Self:
        self._lock.acquire()
        self.context.__enter__()  # a context of another library may be the current one
        self.context.enable_only(self.context.NOTHING)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._idle.use()  # what is released must not be in use
        for thing in reversed(self._made):
            thing.release()
        self._made.clear()
        self.context.__exit__(kind, error, trace)
        self._lock.release()

    def _own(self, thing: Any) -> Any:
        self._made.append(thing)
        return thing

    def program(self, vertex: str, fragment: str) -> Program:
        """Raises DriverError where the driver refuses the text."""
        try:
            made = self._own(self.context.program(HEADER + vertex, fragment_shader=HEADER + fragment))
        except self._gl.Error as error:
            reason = " ".join(str(error).split())[:300]
            raise DriverError(f"{self.name} refuses a shader: {reason}") from None
        units = int(self.context.info["GL_MAX_TEXTURE_IMAGE_UNITS"])
        return Program(made, self._own(self.context.vertex_array(made, [])), units)

    def texture(self, texels: NDArray[Any]) -> Any:
        """A texture of float32 (rows, columns, channels), read texel by texel."""
        rows, columns, channels = texels.shape
        return self._texture((columns, rows), channels, np.ascontiguousarray(texels, np.float32).tobytes(), "f4")

    def texel_list(self, texels: Floats) -> Any:
        """A texture that holds a list (N, channels), row by row; one texel of zeros where it is empty."""
        count, channels = max(1, len(texels)), texels.shape[1]
        width = min(count, LIST_WIDTH)
        rows = -(-count // width)
        if rows > LARGEST[2]:
            raise SceneError(f"a list of {count:,} texels does not fit graphics cards")
        padded = np.zeros((rows * width, channels), np.float32)
        padded[: len(texels)] = texels
        return self.texture(padded.reshape(rows, width, channels))

    def described(self, texture: dict[str, Any], data: bytes, filtered: bool = False) -> Any:
        """A texture as the description of a shader has it; `data` are the texels of all; `filtered`: linearly."""
        part = data[texture["offset"] : texture["offset"] + texture["bytes"]]
        channels = {"RED": 1, "RG": 2, "RGBA": 4}[texture["format"]]
        if texture["type"] not in TYPES:  # 10-10-10-2, which moderngl has no name for
            words = np.frombuffer(part, "<u4")
            tens = np.stack([(words >> shift & 1023) / np.float32(1023) for shift in (0, 10, 20)], -1)
            part = np.concatenate([tens, np.ones_like(tens[:, :1])], -1).astype(np.float32).tobytes()
        made = self._texture(tuple(texture["size"]), channels, part, TYPES.get(texture["type"], "f4"))
        if filtered:
            made.filter = self._gl.LINEAR, self._gl.LINEAR
        return made

    def _texture(self, size: tuple[int, ...], channels: int, data: bytes | None, kind: str) -> Any:
        """Raises DriverError for more texels along an axis than the driver takes."""
        limit = int(self.context.info["GL_MAX_TEXTURE_SIZE" if len(size) == 2 else "GL_MAX_3D_TEXTURE_SIZE"])
        if max(size) > limit:
            raise DriverError(f"{self.name} takes {limit} texels along an axis, not {' x '.join(map(str, size))}")
        make = self.context.texture if len(size) == 2 else self.context.texture3d
        texture = self._own(make(size, channels, data, dtype=kind))
        texture.filter = self._gl.NEAREST, self._gl.NEAREST
        texture.repeat_x = texture.repeat_y = False
        if len(size) == 3:
            texture.repeat_z = False
        return texture

    def target(self, width: int, height: int, depth: bool, channels: int = 4) -> Target:
        """Something to draw float32 numbers into."""
        texture = self._texture((width, height), channels, None, "f4")
        below = self._own(self.context.depth_renderbuffer((width, height))) if depth else None
        return Target(texture, self._own(self.context.framebuffer([texture], below)))

    def finish(self) -> None:
        """Wait until everything is drawn."""
        self.context.finish()


class Program:
    """Shaders that draw vertices without attributes."""

    def __init__(self, program: Any, vertices: Any, units: int) -> None:
        self._program, self._vertices, self._units = program, vertices, units
        self._bound: list[Any] = []

    def __setitem__(self, name: str, value: ArrayLike) -> None:
        """Set a uniform; drivers drop those without effect."""
        if name in self._program:
            uniform = self._program[name]
            numbers = np.asarray(value)
            data = numbers.astype("i4" if numbers.dtype.kind in "biu" else "f4").tobytes()
            uniform.write(data[: uniform.array_length * uniform.element_size])  # what is not read of an array is cut

    def bind(self, name: str, texture: Any) -> None:
        """Have the sampler `name` read a texture, on a unit of its own. Raises DriverError for more than it has."""
        if name in self._program:
            if len(self._bound) == self._units - FIRST_UNIT:
                raise DriverError(f"the driver reads no more than {self._units - FIRST_UNIT} textures at a time")
            self._program[name].value = FIRST_UNIT + len(self._bound)
            self._bound.append(texture)

    def draw(self, count: int) -> None:
        """Draw triangles of `count` vertices."""
        for unit, texture in enumerate(self._bound, FIRST_UNIT):
            texture.use(unit)
        self._vertices.render(vertices=count)


class Target:
    """A picture of four float32 a pixel in the card's memory."""

    def __init__(self, texture: Any, framebuffer: Any) -> None:
        self.texture, self.framebuffer = texture, framebuffer

    def read(self) -> Floats:
        """(height, width, 4), the top row first."""
        width, height = self.texture.size
        numbers = np.frombuffer(self.framebuffer.read(components=4, dtype="f4"), np.float32)
        return numbers.reshape(height, width, 4)[::-1]


@functools.cache
def card() -> Card:
    """The driver, opened when it is first asked for. Raises DriverError."""
    return Card()
