"""Every mistake a user can make ends in exit code 2 and one line that says what is wrong and what to do."""

from __future__ import annotations

import json
import os
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf import SphereImages, io, models
from brdf.errors import FileError

Refused = Callable[..., str]

MERL_BYTES = 12 + 3 * 8 * 90 * 90 * 180
DRAFT = ("--size", "32x24", "--samples", "1", "--mesh", "sphere", "--no-compare")


def merl_header(*dimensions: int) -> bytes:
    return struct.pack("<3i", *dimensions)


@pytest.fixture
def saved(tmp_path: Path) -> Path:
    """A good file of a reflectance."""
    path = tmp_path / "good.safetensors"
    models.GGX(alpha=0.3).save(path)
    return path


# ---- names and parameters ----------------------------------------------------------------------------------------


def test_an_unknown_name_is_answered_with_the_nearest(refused: Refused) -> None:
    assert "did you mean 'gold-metallic-paint'" in refused("info", "gold-metalic-paint")


def test_a_misspelt_model_is_answered_with_the_nearest(refused: Refused) -> None:
    assert "did you mean 'Lambertian'?" in refused("info", "Lambertain:albedo=.3")


def test_an_unknown_fit_lists_the_known_ones(refused: Refused) -> None:
    line = refused("render", "gold-metallic-paint@nobody_nothing", *DRAFT)
    assert "nobody_nothing" in line
    assert "known: " in line or "did you mean" in line


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("GGX:alpha=7", "GGX: alpha must lie in [0.0001, 1], got 7"),
        ("GGX:alpha=nan", "alpha must lie in [0.0001, 1], got nan"),
        ("GGX:alhpa=.2", "did you mean 'alpha'"),
        ("GGX:alpha", "'alpha' is not PARAMETER=VALUE"),
        ("GGX:alpha=", "'alpha=' is not PARAMETER=VALUE"),
        ("GGX:alpha=wide", "alpha must be a number, got 'wide'"),
        ("GGX:alpha=.1,alpha=.2", "alpha is given twice"),
        ("GGX:F0=1/2", "F0 must be a number or 3 numbers, got shape (2,)"),
        ("Microfacet:ndf=gxx", "did you mean 'ggx'?"),
        ("GGX:alpha=.2 +", "empty term"),
        ("-2*Lambertian", "scale must lie in [0, inf)"),
        ("1e999*Lambertian", "scale must lie in [0, inf), got inf"),
        ("1/2*GGX", "a factor is a number or three with slashes"),
        ("GGX:self=3", "unknown parameter of GGX 'self'"),
        ("GGX@bagher_sgd", "a model has no published fits"),
        ("gold-metallic-paint:alpha=.2", "takes no parameters"),
    ],
)
def test_a_wrong_parameter_is_named(refused: Refused, spec: str, said: str) -> None:
    assert said in refused("info", "--", spec)


def test_what_cannot_be_listed_names_what_can(refused: Refused) -> None:
    assert "'models', 'materials', 'meshes', 'formats'" in refused("list", "modells")


# ---- the command line itself -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["rendr"], "no such command 'rendr'. Did you mean 'render'?"),
        (["render"], "missing argument 'MATERIAL'"),
        (["render", "GGX", "--sice", "8x8"], "no such option: --sice"),
        (["render", "GGX", "--samples", "many"], "'--samples'"),
        (["render", "GGX", "GGX"], "unexpected extra argument"),
        (["render", "GGX", "--compare", "GGX", "--no-compare"], "exclude each other"),
        (["convert", "GGX"], "missing argument 'OUT'"),
    ],
)
def test_wrong_usage_points_to_the_help(refused: Refused, arguments: list[str], said: str) -> None:
    assert said in refused(*arguments)


@pytest.mark.parametrize("size", ["0x5", "5x0", "800", "8x-3", "axb", "", "1e3x4", "9999999x9999999"])
def test_a_size_that_is_none_is_refused(refused: Refused, size: str) -> None:
    assert "--size must be WIDTHxHEIGHT" in refused("render", "GGX", "--size", size)


def test_a_size_beyond_the_largest_is_refused(refused: Refused) -> None:
    assert "size must lie between" in refused("render", "GGX", "--size", "90000x90000", "--no-compare")


# ---- files to read -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["missing.binary", "missing.bsdf", "some/where.safetensors", "./nothing"])
def test_a_missing_file_is_named(refused: Refused, name: str) -> None:
    assert f"{name}: no such file" in refused("info", name)


def test_a_folder_is_no_file(refused: Refused, tmp_path: Path) -> None:
    assert f"{tmp_path}: is a folder" in refused("info", tmp_path)


@pytest.mark.parametrize("name", ["a.binary", "a.bsdf", "a.safetensors", "a.xyz"])
def test_an_empty_file_is_named(refused: Refused, tmp_path: Path, name: str) -> None:
    (tmp_path / name).touch()
    assert f"{name}: is empty" in refused("info", name)


def test_a_truncated_merl_file_says_how_long_it_should_be(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "cut.binary").write_bytes(merl_header(90, 90, 180) + bytes(1000))
    line = refused("render", "cut.binary", *DRAFT)
    assert "cut.binary: " in line
    assert str(MERL_BYTES) in line
    assert "1012" in line


@pytest.mark.parametrize("dimensions", [(1000, 1000, 1000), (-90, 90, 180), (0, 0, 0), (2**31 - 1, 2**31 - 1, 1)])
def test_an_absurd_merl_header_takes_no_memory(
    refused: Refused, tmp_path: Path, dimensions: tuple[int, int, int]
) -> None:
    import tracemalloc

    (tmp_path / "huge.binary").write_bytes(merl_header(*dimensions) + bytes(100))
    refused("info", "huge.binary")  # the first call imports the readers
    tracemalloc.start()
    try:
        line = refused("info", "huge.binary")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert "huge.binary: " in line
    assert peak < 20e6


def test_a_merl_table_with_nan_is_refused(refused: Refused, tmp_path: Path) -> None:
    values = np.zeros(3 * 90 * 90 * 180)
    values[12345] = np.nan
    (tmp_path / "nan.binary").write_bytes(merl_header(90, 90, 180) + values.tobytes())
    line = refused("info", "nan.binary")
    assert "nan.binary: " in line
    assert "NaN" in line


RGL_MAGIC = b"tensor_file\0"


@pytest.mark.parametrize(
    "body",
    [
        b"",
        bytes([1, 0]) + struct.pack("<I", 4_000_000_000),
        bytes([1, 0]) + struct.pack("<I", 1) + struct.pack("<H", 65535) + b"luminance",
        bytes([1, 0]) + struct.pack("<IH", 1, 3) + b"rgb" + struct.pack("<HBQ", 5, 10, 2**63) + bytes(40),
        bytes([9, 9]) + bytes(200),
    ],
    ids=["nothing", "four billion fields", "name beyond the end", "offset beyond the end", "version"],
)
def test_an_rgl_file_with_a_corrupt_table_of_contents_is_refused(refused: Refused, tmp_path: Path, body: bytes) -> None:
    (tmp_path / "broken.bsdf").write_bytes(RGL_MAGIC + body)
    assert "broken.bsdf: " in refused("info", "broken.bsdf")


def test_an_rgl_field_of_absurd_length_is_refused(refused: Refused, tmp_path: Path) -> None:
    """Its product of lengths is zero, so that the file seems large enough."""
    entry = struct.pack("<H", 3) + b"rgb" + struct.pack("<HBQ2Q", 2, 10, 60, 2**63, 0)
    (tmp_path / "vast.bsdf").write_bytes(RGL_MAGIC + bytes([1, 0]) + struct.pack("<I", 1) + entry + bytes(64))
    assert "vast.bsdf: field 'rgb' claims" in refused("info", "vast.bsdf")


def test_goniometer_values_beyond_float32_are_refused(refused: Refused, tmp_path: Path) -> None:
    rows = [f"{theta} 0 0.1 0 1e300" for theta in (0, 0.1, 0.2, 0.3, 0.4)]
    (tmp_path / "bright.brdf").write_text("\n".join(["1", "500", *rows]))
    line = refused("info", "bright.brdf")
    assert "bright.brdf: " in line
    assert "finite" in line


def test_a_saved_table_with_nan_is_refused(refused: Refused, tmp_path: Path) -> None:
    from safetensors.numpy import load_file, save_file

    from brdf import Table, container

    path = tmp_path / "nan.safetensors"
    Table.bake(models.GGX(), shape=(4, 4, 4), storage="float32").save(path)
    header, arrays = container.load(path)
    arrays["codes"][1, 2, 3] = np.nan
    save_file(arrays, path, {"brdf": json.dumps(header)})
    assert np.isnan(load_file(path)["codes"]).any()
    assert "nan.safetensors: its header does not describe a reflectance (the table holds NaN" in refused(
        "info", path.name
    )


@pytest.mark.parametrize(
    "header",
    ['{"schema": 1e999, "kind": "GGX"}', '{"schema": 1, "kind": "Sum"}', "[" * 100_000],
    ids=["schema", "empty sum", "nesting"],
)
def test_a_header_without_sense_is_refused(refused: Refused, tmp_path: Path, header: str) -> None:
    from safetensors.numpy import save_file

    save_file({"weights": np.zeros(4, np.float32)}, tmp_path / "odd.safetensors", {"brdf": header})
    assert "odd.safetensors: " in refused("info", "odd.safetensors")


def test_a_truncated_safetensors_file_is_refused(refused: Refused, saved: Path) -> None:
    saved.write_bytes(saved.read_bytes()[:40])
    assert "good.safetensors: not a whole safetensors file" in refused("info", saved.name)


def test_a_safetensors_file_of_something_else_is_refused(refused: Refused, tmp_path: Path) -> None:
    from safetensors.numpy import save_file

    save_file({"weights": np.zeros(4, np.float32)}, tmp_path / "net.safetensors")
    assert "net.safetensors: a safetensors file, but not one of brdf's" in refused("info", "net.safetensors")


def test_a_header_with_an_unknown_kind_is_refused(refused: Refused, tmp_path: Path) -> None:
    from safetensors.numpy import save_file

    header = {"brdf": json.dumps({"schema": 1, "kind": "os.system"})}
    save_file({"weights": np.zeros(4, np.float32)}, tmp_path / "odd.safetensors", header)
    assert "os.system" in refused("info", "odd.safetensors")


def test_content_of_no_known_format_lists_the_formats(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("nothing that reflects\n")
    line = refused("info", "notes.txt")
    assert "notes.txt: its content is of no known format" in line
    assert "MERL" in line


def test_a_known_extension_with_other_content_is_refused(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "picture.bsdf").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
    assert "picture.bsdf: " in refused("info", "picture.bsdf")


# ---- files to write ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "command",
    [
        ["render", "GGX", *DRAFT, "-o"],
        ["show", "GGX", "--what", "lobes", "-o"],
        ["bake", "GGX", "-o"],
        ["compare", "GGX", "Lambertian", "-o"],
        ["convert", "GGX"],
    ],
    ids=lambda command: command[0],
)
@pytest.mark.parametrize("place", ["no/such/folder/x", "a-file/x", "."])
def test_an_output_that_cannot_be_written_is_named(
    refused: Refused, tmp_path: Path, command: list[str], place: str
) -> None:
    (tmp_path / "a-file").write_text("in the way")
    extension = "" if place == "." else (".png" if command[0] in ("render", "show", "compare") else ".safetensors")
    line = refused(*command, place + extension)
    assert "cannot be written" in line or "is a folder" in line or "no extension" in line or "choose one" in line
    assert sorted(os.listdir(tmp_path)) == ["a-file"]


def test_an_output_whose_name_is_too_long_is_named(refused: Refused, tmp_path: Path) -> None:
    line = refused("render", "GGX", *DRAFT, "-o", "x" * 300 + ".png")
    assert "cannot be written (File name too long)" in line
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["render", "GGX", *DRAFT, "-o", "x.jpg"], "x.jpg: pictures are written as .png or .exr"),
        (["convert", "GGX", "x.tiff"], "no format is written with the extension '.tiff'"),
        (["convert", "GGX", "x"], "the name has no extension"),
        (["show", "GGX", "-o", "x.gif9"], "x.gif9: figures are written as"),
        (["bake", "GGX", "--as", "slicestack"], "did you mean 'slice-stack'?"),
        (["bake", "GGX", "--as", "sphere-images", "--budget", "16K"], "'budget' has no effect with sphere-images"),
        (
            ["bake", "GGX", "--budget", "16K", "--angles", "metal"],
            "'angles' has no effect with slice-stack; it belongs",
        ),
        (["bake", "GGX", "--storage", "half"], "'storage' has no effect with slice-stack; it belongs to sphere-images"),
        (["bake", "GGX", "--angles", "0,x"], "--angles must be plastic, metal or degrees with commas"),
        (["bake", "GGX", "--angles", "0,nan"], "--angles must be plastic, metal or degrees with commas"),
        (["bake", "GGX", "--angles", "wood"], "wood"),
        (["bake", "GGX", "--as", "sphere-images", "--size", "1"], "texels wide, got 1"),
        (["bake", "GGX", "--as", "sphere-images", "--blend", "papr"], "did you mean 'paper'"),
        (["bake", "Mirror"], "mirrors like a polished surface"),
        (["capture", "simulate", "leather", "--size", "8", "--seed", "-1"], "a seed is a whole number from 0 on"),
        (["capture", "simulate", "leather", "--size", "-8"], "size must lie between 1 and"),
        (["bake", "1e300*Lambertian"], "a table holds values below 1e+30 alone"),
        (["convert", "1e300*Lambertian", "x.binary"], "a table holds values below 1e+30 alone"),
        (["convert", "1e300*Lambertian", "x.bsdf"], "a table holds values below 1e+30 alone"),
        (["convert", "GGX", "x.safetensors", "--as", "tabel"], "did you mean 'table'?"),
        (["bake", "GGX", "-o", "balls/"], "balls/: is a folder; sphere-images alone are written as one"),
        (["compare", "GGX"], "missing argument 'MATERIAL'"),
        (["compare", "GGX", "Lambertain"], "did you mean 'Lambertian'"),
        (["compare", "GGX", "Lambertian", "-o", "x.gif9"], "x.gif9: figures are written as"),
        (["compare", "GGX", "Lambertian", "-o", "x.png", "--no-figure"], "exclude each other"),
        (["bake", "GGX:alpha_x=.1,alpha_y=.3"], "is anisotropic"),
    ],
)
def test_an_output_of_no_known_kind_lists_the_kinds(
    refused: Refused, tmp_path: Path, arguments: list[str], said: str
) -> None:
    assert said in refused(*arguments)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize(
    "arguments",
    [
        ["render", "GGX", "--mesh", "teapott", "--no-compare", "-o", "kept.png"],
        ["render", "GGX", *DRAFT, "--samples", "0", "-o", "kept.png"],
        ["render", "nothing-like-it", *DRAFT, "-o", "kept.png"],
        ["convert", "GGX:alpha_x=.1,alpha_y=.3", "kept.binary"],
        ["bake", "GGX:alpha_x=.1,alpha_y=.3", "-o", "kept.safetensors"],
    ],
    ids=lambda arguments: " ".join(arguments[:2]),
)
def test_an_existing_output_outlives_a_failed_run(refused: Refused, tmp_path: Path, arguments: list[str]) -> None:
    kept = tmp_path / arguments[-1]
    kept.write_text("the work of last week")
    refused(*arguments)
    assert kept.read_text() == "the work of last week"
    assert os.listdir(tmp_path) == [kept.name]


@pytest.mark.parametrize(
    ("written", "format", "arguments"),
    [
        ("x.safetensors", None, ["fit", "x.safetensors", "--model", "Ward", "-o", "x.safetensors"]),
        ("x.safetensors", None, ["fit", "x.safetensors", "--model", "Ward", "--report", "linked.png"]),
        ("x.safetensors", None, ["bake", "0.5*x.safetensors + GGX", "-o", "./x.safetensors"]),
        ("x.bsdf", "RGL", ["convert", "x.bsdf", "x.bsdf", "--as", "table"]),
        ("x.dat", None, ["convert", "x.dat", "linked.dat"]),
        ("x.xml.bsdf", "RGL", ["export", "x.xml.bsdf", "x.xml"]),
        ("x.pbrt", "RGL", ["export", "x.pbrt", "x.pbrt"]),
        ("x.glsl.json", "safetensors", ["export", "x.glsl.json", "x.glsl"]),
        ("x.png", "sphere images", ["render", "x.png", "--no-compare", "-o", "x.png"]),
    ],
    ids=lambda value: " ".join(value[:2]) if isinstance(value, list) else "",
)
def test_a_result_does_not_replace_its_input(
    refused: Refused, tmp_path: Path, written: str, format: str | None, arguments: list[str]
) -> None:
    m = models.Lambertian()
    io.write(SphereImages.bake(m, size=16) if format == "sphere images" else m, tmp_path / written, format)
    for name in arguments:
        if name.startswith("linked"):
            (tmp_path / name).symlink_to(tmp_path / written)
    files, content = sorted(os.listdir(tmp_path)), (tmp_path / written).read_bytes()
    assert "is the input itself; choose another place" in refused(*arguments)
    assert (tmp_path / written).read_bytes() == content
    assert sorted(os.listdir(tmp_path)) == files


def test_a_folder_of_results_does_not_replace_the_one_it_comes_from(refused: Refused, tmp_path: Path) -> None:
    io.write(SphereImages.bake(models.Lambertian(), size=16), f"{tmp_path}/balls/")
    files = sorted(os.listdir(tmp_path / "balls"))
    refused("bake", "balls", "--as", "sphere-images", "--size", "8", "-o", "balls/")
    assert "is the input itself" in refused("render", "balls", "--no-compare", "-o", f"balls/{files[0]}")
    assert sorted(os.listdir(tmp_path / "balls")) == files


def test_environments_and_meshes_are_inputs_too(refused: Refused, tmp_path: Path) -> None:
    from brdf.render import Image

    Image(np.ones((4, 8, 3), np.float32)).save(tmp_path / "sky.exr")
    content = (tmp_path / "sky.exr").read_bytes()
    line = refused("render", "Lambertian", *DRAFT, "--env", "sky.exr", "-o", "sky.exr")
    assert "sky.exr: is the input itself" in line
    assert (tmp_path / "sky.exr").read_bytes() == content


def test_in_python_too_a_conversion_does_not_replace_its_source(tmp_path: Path) -> None:
    io.write(models.Lambertian(), tmp_path / "x.dat")
    with pytest.raises(FileError, match="is the input itself"):
        brdf.convert(tmp_path / "x.dat", tmp_path / "x.dat")
    m = brdf.load(tmp_path / "x.dat")
    io.write(m, tmp_path / "x.dat")  # who reads and writes himself is asked nothing


# ---- scenes ------------------------------------------------------------------------------------------------------


def test_an_unknown_mesh_is_answered_with_the_nearest(refused: Refused) -> None:
    assert "did you mean 'teapot'?" in refused("render", "GGX", "--mesh", "teapott", "--no-compare")


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
        ("points.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n0 0 0\n"),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
    ],
)  # fmt: skip
def test_a_mesh_with_no_faces_is_refused(refused: Refused, tmp_path: Path, name: str, content: str) -> None:
    (tmp_path / name).write_text(content)
    line = refused("render", "GGX", "--mesh", name, "--no-compare")
    assert f"{name}: " in line
    assert "faces" in line


def test_a_mesh_file_of_no_known_format_is_refused(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "shape.txt").write_text("round")
    assert "shape.txt: " in refused("render", "GGX", "--mesh", "shape.txt", "--no-compare")


@pytest.mark.parametrize("extension", ["png", "jpg", "hdr", "exr"])
def test_an_ldr_picture_is_no_environment(refused: Refused, tmp_path: Path, extension: str) -> None:
    from PIL import Image

    name = f"room.{extension}"
    Image.new("RGB", (8, 4)).save(tmp_path / name, format="JPEG" if extension == "jpg" else "PNG")
    line = refused("render", "GGX", "--env", name, "--no-compare")
    assert f"{name}: " in line
    assert ".hdr" in line
    assert ".exr" in line


@pytest.mark.parametrize(
    ("light", "said"),
    [
        ("directionl:theta=3", "did you mean 'directional'?"),
        ("directional:tehta=3", "did you mean 'theta'"),
        ("directional:theta=up", "theta"),
        ("point", "a point light needs its position"),
        ("point:1/2", "position"),
        ("directional:power=-1", "power"),
    ],
)
def test_a_wrong_light_is_named(refused: Refused, light: str, said: str) -> None:
    assert said in refused("render", "GGX", "--light", light, "--no-compare")


@pytest.mark.parametrize(
    ("option", "value", "said"),
    [
        ("--tone", "flimic", "did you mean 'filmic'?"),
        ("--background", "gradiant", "did you mean 'gradient'?"),
        ("--samples", "0", "samples"),
        ("--seed", "-1", "seed"),
        ("--env", "studoi", "did you mean 'studio'?"),
        ("--env", "nan", "nan"),
        ("--env", "-1", "-1"),
        ("--env", "1e39", "not finite"),
        ("--exposure", "inf", "exposure"),
        ("--exposure", "5000", "exposure must lie in"),
    ],
)
def test_a_wrong_option_value_is_named(refused: Refused, tmp_path: Path, option: str, value: str, said: str) -> None:
    line = refused("render", "GGX", *DRAFT, f"{option}={value}")
    assert said in line
    assert os.listdir(tmp_path) == []
