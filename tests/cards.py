"""Exported shaders on a graphics card, or on a software driver: what their function gives for many directions."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

HEADERS = {"330 core": "#version 330 core\n", "300 es": "#version 300 es\n"}

MAIN = """
in vec3 given_wi, given_wo;
in vec2 given_uv;
out vec3 value;
void main() {{ value = {function}(given_wi, given_wo{uv}); }}
"""


def texels(description: dict[str, Any], data: bytes) -> tuple[NDArray[np.float32], int]:
    """(…, height, width, channels) numbers of a texture as the description beside a shader says, and its channels."""
    part = data[description["offset"] : description["offset"] + description["bytes"]]
    channels = {"RED": 1, "RG": 2, "RGBA": 4}[description["format"]]
    shape = (*reversed(description["size"]), channels)
    match description["type"]:
        case "UNSIGNED_BYTE":
            numbers = np.frombuffer(part, np.uint8) / np.float32(255)
        case "UNSIGNED_INT_2_10_10_10_REV":
            words = np.frombuffer(part, "<u4")
            numbers = np.stack([(words >> s & 1023) / np.float32(1023) for s in (0, 10, 20)] + [0 * words], -1)
        case "HALF_FLOAT":
            numbers = np.frombuffer(part, "<f2")
        case _:
            numbers = np.frombuffer(part, "<f4")
    return numbers.astype(np.float32).reshape(shape), channels


def described(shader: Path) -> tuple[dict[str, Any], bytes]:
    """The description beside a shader, and the texels."""
    description = json.loads(Path(f"{shader}.json").read_text("utf-8"))
    data = Path(f"{shader}.bin")
    return description, data.read_bytes() if data.exists() else b""


class GLCard:
    """OpenGL by moderngl."""

    def __init__(self) -> None:
        import moderngl

        self.context = moderngl.create_context(standalone=True, backend="egl")
        self.context.simple_framebuffer((1, 1)).use()  # without a surface there is none, which even transforms need

    def evaluate(
        self,
        shader: Path,
        wi: NDArray[Any],
        wo: NDArray[Any],
        uv: NDArray[Any],
        header: str = "330 core",
        linear: bool = False,
    ) -> NDArray[np.float32]:
        """(N, 3) values of an exported `.glsl` by transform feedback; `linear`: textures are filtered so."""
        with self.context:  # a context of another library may be the current one
            return self._evaluate(shader, {"given_wi": wi, "given_wo": wo, "given_uv": uv}, header, linear)

    def _evaluate(
        self, shader: Path, inputs: dict[str, NDArray[Any]], header: str, linear: bool
    ) -> NDArray[np.float32]:
        import moderngl

        description, data = described(shader)
        main = MAIN.format(function=description["function"], uv=", given_uv" if description["varies"] else "")
        text = HEADERS[header] + shader.read_text("utf-8")
        if header == "300 es":  # ES wants both stages
            fragment = HEADERS[header] + "precision highp float;\nout vec4 colour;\nvoid main() { colour = vec4(0.0); }"
            program = self.context.program(text + main, fragment_shader=fragment, varyings=["value"])
        else:
            program = self.context.program(text + main, varyings=["value"])
        for parameter in description["parameters"]:
            program[parameter["uniform"]].value = parameter["value"]
        used = []
        for unit, texture in enumerate(description["textures"]):
            numbers, channels = texels(texture, data)
            make = self.context.texture if texture["target"] == "TEXTURE_2D" else self.context.texture3d
            used.append(make(texture["size"], channels, numbers.tobytes(), dtype="f4"))
            used[-1].filter = (moderngl.LINEAR if linear else moderngl.NEAREST,) * 2
            used[-1].repeat_x = used[-1].repeat_y = False
            if texture["target"] == "TEXTURE_3D":
                used[-1].repeat_z = False
            used[-1].use(unit)
            program[texture["uniform"]].value = unit
        count = len(inputs["given_wi"])
        given = [(self.context.buffer(np.ascontiguousarray(array, "f4")), f"{array.shape[1]}f", name)
                 for name, array in inputs.items() if name in program]  # fmt: skip
        out = self.context.buffer(reserve=count * 12)
        array = self.context.vertex_array(program, given)
        array.transform(out, moderngl.POINTS, count)
        value = np.frombuffer(out.read(), np.float32).reshape(-1, 3)
        for thing in (array, out, program, *used, *(buffer for buffer, *_ in given)):
            thing.release()
        return value


COMPUTE = """
@group(1) @binding(0) var<storage, read> given: array<vec4f>;  // wi, wo, uv of each pair
@group(1) @binding(1) var<storage, read_write> values: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
    let i = id.x;
    if (i >= arrayLength(&values)) {{ return; }}
    let uv = given[3 * i + 2].xy;
    values[i] = vec4f({function}(given[3 * i].xyz, given[3 * i + 1].xyz{uv}), 0.0);
}}
"""


class WebCard:
    """WebGPU by wgpu-native, whose shader compiler is naga."""

    def __init__(self) -> None:
        import wgpu

        self.device = wgpu.gpu.request_adapter_sync().request_device_sync()

    def evaluate(self, shader: Path, wi: NDArray[Any], wo: NDArray[Any], uv: NDArray[Any]) -> NDArray[np.float32]:
        """(N, 3) values of an exported `.wgsl` by a compute shader."""
        import wgpu

        device, use = self.device, wgpu.BufferUsage
        description, data = described(shader)
        main = COMPUTE.format(function=description["function"], uv=", uv" if description["varies"] else "")
        module = device.create_shader_module(code=shader.read_text("utf-8") + main)
        pipeline = device.create_compute_pipeline(layout="auto", compute={"module": module, "entry_point": "main"})
        bound = []
        if description["parameters"]:
            block = np.zeros(description["uniform_bytes"] // 4, np.float32)
            for p in description["parameters"]:
                start = description["uniform_offsets"][p["uniform"]] // 4
                block[start : start + p["size"]] = p["value"]
            buffer = device.create_buffer_with_data(data=block, usage=use.UNIFORM)
            bound.append({"binding": 0, "resource": {"buffer": buffer}})
        for binding, t in enumerate(description["textures"], start=1):
            numbers, channels = texels(t, data)
            size = (*t["size"], 1)[:3]
            texture = device.create_texture(
                size=size,
                dimension=t["target"][-2:].lower(),
                format={1: "r", 2: "rg", 4: "rgba"}[channels] + "32float",
                usage=wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST,
            )
            layout = {"bytes_per_row": 4 * channels * size[0], "rows_per_image": size[1]}
            device.queue.write_texture({"texture": texture}, np.ascontiguousarray(numbers), layout, size)
            bound.append({"binding": binding, "resource": texture.create_view()})
        rows = np.zeros((len(wi), 3, 4), np.float32)
        rows[:, 0, :3], rows[:, 1, :3], rows[:, 2, :2] = wi, wo, uv
        given = device.create_buffer_with_data(data=rows, usage=use.STORAGE)
        out = device.create_buffer(size=len(wi) * 16, usage=use.STORAGE | use.COPY_SRC)
        buffers = [{"binding": i, "resource": {"buffer": b}} for i, b in enumerate((given, out))]
        encoder = device.create_command_encoder()
        work = encoder.begin_compute_pass()
        work.set_pipeline(pipeline)
        for group, entries in enumerate((bound, buffers)):
            if entries:
                work.set_bind_group(group, device.create_bind_group(
                    layout=pipeline.get_bind_group_layout(group), entries=entries))  # fmt: skip
        work.dispatch_workgroups(-(-len(wi) // 64))
        work.end()
        device.queue.submit([encoder.finish()])
        return np.frombuffer(device.queue.read_buffer(out), np.float32).reshape(-1, 4)[:, :3]
