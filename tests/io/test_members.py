"""Files of several materials: networks' weights, published fits; and Disney's parameters."""

from __future__ import annotations

import io as memory
import zipfile

import numpy as np
import pytest
from tests.io.samples import disney, fits, weights
from tests.io.samples import nbrdf as archive

import brdf
from brdf import io
from brdf.errors import CorruptFileError, FileError, UnknownNameError
from brdf.io import bbm
from brdf.materials import catalogue
from helpers import random_directions
from networks import nbrdf

WI, WO = random_directions(500, 1), random_directions(500, 2)


def test_a_member_is_named(tmp_path):
    (tmp_path / "m.fit").write_bytes(fits())
    assert io.members(tmp_path / "m.fit") == ["red", "blue", "grey"]
    m = brdf.load(f"{tmp_path / 'm.fit'}@grey")
    assert (m.name, m.source) == ("grey", "m.fit, line 4")
    np.testing.assert_allclose(m.albedo, [0.1, 0.2, 0.3])
    with pytest.raises(FileError, match=r"holds 3 materials, red to grey; choose one as in m.fit@red"):
        brdf.load(str(tmp_path / "m.fit"))
    with pytest.raises(UnknownNameError, match=r"unknown material in .*m.fit 'gray': did you mean 'grey'"):
        brdf.load(f"{tmp_path / 'm.fit'}@gray")


def test_a_file_of_one_material_has_no_members(tmp_path):
    (tmp_path / "m.brdf").write_bytes(disney())
    assert io.members(tmp_path / "m.brdf") == []
    with pytest.raises(FileError, match="holds one material, none called 'x'"):
        io.read(tmp_path / "m.brdf", "x")


def test_published_networks(data):
    """The published network by independent code, at the materials of all three sets."""
    for file in ("merl", "rgl", "nielsen"):
        path = data / "merl" / f"{file}_nbrdf_weights.npz"
        raw = dict(np.load(path))
        names = io.members(path)
        assert set(names) == {key.partition("/")[0] for key in raw}
        for name in names[::20]:
            m = io.read(path, name)
            np.testing.assert_allclose(m(WI, WO), nbrdf(raw, name, WI, WO), rtol=1e-9, atol=1e-9)
            np.testing.assert_allclose(m(WI, WO), m(WO, WI), rtol=1e-9, atol=1e-9)


def test_six_arrays_stand_for_one_network(tmp_path):
    for name, array in weights().items():
        np.save(tmp_path / f"gold-paint_{name}.npy", np.asfortranarray(array) if name == "fc2" else array)
    (tmp_path / "m.npz").write_bytes(archive())
    m = io.read(tmp_path / "gold-paint_b2.npy")
    assert m.name == "gold-paint"
    np.testing.assert_array_equal(m(WI, WO), io.read(tmp_path / "m.npz", "two")(WI, WO))
    (tmp_path / "gold-paint_fc3.npy").unlink()
    with pytest.raises(CorruptFileError, match=r"of which gold-paint_fc3\.npy is missing"):
        io.read(tmp_path / "gold-paint_b2.npy")


def test_networks_are_saved_and_loaded(tmp_path):
    (tmp_path / "m.npz").write_bytes(archive())
    m = io.read(tmp_path / "m.npz", "one")
    m.save(tmp_path / "m.safetensors")
    np.testing.assert_array_equal(io.read(tmp_path / "m.safetensors")(WI, WO), m(WI, WO))


def npz(**changed):
    file = memory.BytesIO()
    np.savez(file, **(weights() | changed))
    return file.getvalue()


def bomb():
    file = memory.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as z:
        z.writestr("fc1.npy", b"\x93NUMPY\1\0" + bytes(10_000_000))
    return file.getvalue()


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (npz(fc1=np.array([{"a": 1}] * 6, object)), "has a header that is not one of plain numbers"),
        (npz(fc2=np.zeros((21, 20), np.float32)), r"fc2.npy must be \(21, 21\) numbers, got \(21, 20\) of <f4"),
        (npz(b3=np.full(3, np.nan)), r"weights 'b3' must be \(3,\) finite numbers"),
        (npz(b3=np.zeros(3, int)), r"b3.npy must be \(3,\) numbers, got \(3,\) of <i8"),
        (bomb(), "fc1.npy claims 10000008 bytes"),
        (archive()[:-30], "is not a whole archive"),
    ],
)
def test_broken_weights(tmp_path, data, said):
    (tmp_path / "m.npz").write_bytes(data)
    with pytest.raises(CorruptFileError, match=said):
        io.read(tmp_path / "m.npz")


@pytest.mark.parametrize("fit", catalogue._FITS)
def test_published_fits_are_the_shipped_materials(data, fit):
    path = data / "merl" / "fits" / f"{fit}.fit"
    names = io.members(path)
    assert set(names) == {name for name in catalogue.names() if fit in catalogue.fits(name)}
    for name in names[::17]:
        np.testing.assert_array_equal(io.read(path, name)(WI, WO), catalogue.get(name, fit)(WI, WO))


DIFFUSE = "Lambertian(albedo = [0.1, 0.2, 0.3])"


@pytest.mark.parametrize(
    ("row", "said"),
    [
        (f"Aggregate({DIFFUSE}, Phong(n = 3))", "the model Phong is not read; read are Bagher"),
        (f"Aggregate({DIFFUSE}, NganWard(albedo = [1, 1, 1]))", "parameter 'roughness' is missing"),
        (f"Aggregate({DIFFUSE}, NganWard(albedo = [1, 1, 1], roughness = -1))", "roughness|alpha"),
        (f"Aggregate({DIFFUSE}, NganWard(albedo = [1, 1, 1], roughness = 0.1)", "is not closed"),
        (f"Aggregate({DIFFUSE})", "a row must be Aggregate"),
        (f"{DIFFUSE} 3", "something follows the last bracket"),
        ("Lambertian(albedo = [0.1, 0.2)", "a list is not closed"),
        ("Lambertian(albedo = [[[[[[1]]]]]])", "nested more than 4 deep"),
        ("Lambertian(albedo = __import__('os'))", "is not understood"),
        ("Lambertian()", "must hold parameters and models"),
    ],
)
def test_broken_rows(tmp_path, row, said):
    (tmp_path / "m.fit").write_text(f"# c\nname = {row}\n")
    with pytest.raises(CorruptFileError, match=f"line 2: .*(?:{said})"):
        io.read(tmp_path / "m.fit", "name")


def test_numbers_lists_and_models_are_parsed():
    assert bbm.parsed("A(x = -1.5e-3, y = [[1, 2], [3., .4]], B(z = 1))") == (
        "A", {"x": -0.0015, "y": [[1, 2], [3.0, 0.4]]}, [("B", {"z": 1}, [])]
    )  # fmt: skip


def test_disney_parameters(tmp_path):
    (tmp_path / "gold.brdf").write_bytes(disney())
    m = io.read(tmp_path / "gold.brdf")
    assert (m.name, m.metallic, m.roughness, m.masking) == ("gold", 0.3, 0.4, "2014")
    np.testing.assert_allclose(m.base_color, np.array([0.82, 0.67, 0.16]) ** 2.2)


def block(text):
    return f"analytic\n::begin parameters\n{text}\n::end parameters\n::begin shader\n"


@pytest.mark.parametrize(
    ("text", "wi", "expected"),
    [
        ("float reflectance 0 1 .8", WI[0], 0.8 / np.pi),
        ("float k 0.5 1 1", WI[0], 1 / np.pi),
        ("float rho 0 1 .9\nfloat sigma 0 90 0", WI[0], 0.9 / np.pi),
        ("float Kd 0 1 .1\nfloat Ks 0 1 .5\nfloat alphaG .001 1 .2\nfloat ior 1.3 3 2\nbool useFresnel 0",
         np.array([0, 0, 1.0]), 0.1 / np.pi + 0.5 / (4 * np.pi * 0.04)),
        ("float Kd 0 1 .1\nfloat Ks 0 1 .5\nfloat alphaG .001 1 .2\nfloat ior 1.3 3 2\nbool useFresnel 1",
         np.array([0, 0, 1.0]), 0.1 / np.pi + 0.5 / (4 * np.pi * 0.04) / 9),
    ],
)  # fmt: skip
def test_other_models(tmp_path, text, wi, expected):
    """At normal incidence, where the shaders have closed forms: D = 1 / (pi alpha^2), F = ((n - 1) / (n + 1))^2."""
    (tmp_path / "m.brdf").write_text(block(text))
    np.testing.assert_allclose(io.read(tmp_path / "m.brdf")(wi, wi), expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (block("float mine 0 1 .5"), "is a model of its own, with mine; known are baseColor"),
        (block("float reflectance 0 1"), "line 3 is no parameter: 'float reflectance 0 1'"),
        (block("vec4 reflectance 0 1 2"), "line 3 is no parameter"),
        (block("float reflectance 0 1 x"), "line 3 must hold numbers"),
        (block("float reflectance 0 9 9"), "albedo"),
        ("analytic\n::begin parameters\nfloat k 0 1 1\n", "its block of parameters does not end"),
    ],
)
def test_broken_parameters(tmp_path, text, said):
    (tmp_path / "m.brdf").write_text(text)
    with pytest.raises(CorruptFileError, match=said):
        io.read(tmp_path / "m.brdf")
