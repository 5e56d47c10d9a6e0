"""Files of renderers, read back by each one's own library where there is one."""

from __future__ import annotations

import json
import sys
import xml.etree.ElementTree as ET
from types import SimpleNamespace

import numpy as np
import pytest

import brdf
from brdf import io
from brdf.color import rgb_weights
from brdf.errors import ParameterError, ReflectanceError
from brdf.export import pbrt, principled
from brdf.export.mitsuba_scene import bsdf_dict
from brdf.export.target import targets
from brdf.models import GGX, Disney, GltfMetallicRoughness, Lambertian, Microfacet, OpenPBR
from helpers import random_directions

GLTF = GltfMetallicRoughness(base_color=(0.8, 0.4, 0.1), metallic=0.3, roughness=0.5).named("an orange")
DISNEY = Disney(base_color=(0.3, 0.2, 0.1), metallic=0.2, roughness=0.4, anisotropic=0.5, masking="2014").named(
    "1st wood"
)
WI, WO = random_directions(300, 1, 0.1), random_directions(300, 2, 0.1)


@pytest.fixture(scope="module")
def red():
    """What a fit has to find: not one of the principled models."""
    return (Lambertian(albedo=(0.3, 0.05, 0.03)) + Microfacet(alpha=0.2, F0=0.04)).named("red")


def test_targets_are_those_of_the_documentation():
    assert set(targets()) == {".gltf", ".mtlx", ".pbrt", ".py", ".xml"}


def test_materialx_is_valid_and_holds_the_parameters(tmp_path):
    mx = pytest.importorskip("MaterialX")
    for m in (DISNEY, OpenPBR(coat_weight=0.5)):
        done = brdf.export(m, tmp_path / "m.mtlx")
        document, library = mx.createDocument(), mx.createDocument()
        mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
        mx.readFromXmlFile(document, str(tmp_path / "m.mtlx"))
        document.setDataLibrary(library)
        valid, message = document.validate()
        assert valid, message
        (shader,) = document.getNodes("open_pbr_surface")
        assert shader.getNodeDef() is not None
        for name, value in done.stands_for.values.items():
            given = shader.getInputValue(name)
            found = given if isinstance(given, float) else [given[0], given[1], given[2]]
            np.testing.assert_allclose(found, value, rtol=1e-5, atol=1e-7)
        (material,) = document.getMaterialNodes()
        assert [node.getName() for node in mx.getShaderNodes(material)] == [shader.getName()]


ACROSS = GGX(alpha_x=0.15, alpha_y=0.4, F0=(0.9, 0.6, 0.2))
"""Wider along the bitangent, as no principled model is."""


def test_materialx_turns_the_tangent_of_what_is_wider_across(tmp_path):
    mx = pytest.importorskip("MaterialX")
    glsl = pytest.importorskip("MaterialX.PyMaterialXGenGlsl")
    shaders = pytest.importorskip("MaterialX.PyMaterialXGenShader")
    done = brdf.export(ACROSS, tmp_path / "m.mtlx")
    assert brdf.compare(ACROSS, done.stands_for).psnr_mean > 100
    document, library = mx.createDocument(), mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    mx.readFromXmlFile(document, str(tmp_path / "m.mtlx"))
    (shader,) = document.getNodes("open_pbr_surface")
    document.importLibrary(library)
    valid, message = document.validate()
    assert valid, message
    turned = shader.getConnectedNode("geometry_tangent")
    assert (turned.getCategory(), turned.getInputValue("amount")) == ("rotate3d", 90)
    assert [turned.getConnectedNode(name).getCategory() for name in ("in", "axis")] == ["tangent", "normal"]
    generator = glsl.GlslShaderGenerator.create()
    context = shaders.GenContext(generator)
    context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
    text = generator.generate("m", shaders.findRenderableElements(document)[0], context).getSourceCode("pixel")
    assert "mx_rotate_vector3(GGX_tangent_tangent_out, GGX_tangent_amount, GGX_tangent_normal_out" in text


def test_blender_turns_the_tangent_of_what_is_wider_across(tmp_path):
    done = brdf.export(ACROSS, tmp_path / "m.py")
    scope = {"__name__": "read"}
    exec((tmp_path / "m.py").read_text(), scope)
    assert scope["INPUTS"]["Anisotropic Rotation"] == 0.25
    assert scope["INPUTS"]["Anisotropic"] == pytest.approx(0.69, abs=0.01)
    assert brdf.compare(ACROSS, done.stands_for).psnr_mean > 40


@pytest.mark.parametrize("alpha", [0.01, 0.1, 0.3])
@pytest.mark.parametrize("ndf", ["ggx", "beckmann"])
def test_highlights_wider_across_are_found(alpha, ndf):
    across = Microfacet(ndf=ndf, alpha_x=alpha, alpha_y=1.2 * alpha, F0=0.04)
    along = Microfacet(ndf=ndf, alpha_x=1.2 * alpha, alpha_y=alpha, F0=0.04)
    base = Lambertian(albedo=0.5)
    assert principled.aligned(base + across).is_turned
    assert not principled.aligned(base + along).is_turned
    assert not principled.aligned(base + Microfacet(ndf=ndf, alpha=alpha)).is_turned


def test_openpbr_is_written_as_it_is(tmp_path):
    m = OpenPBR(coat_weight=0.5, fuzz_weight=0.2)
    written = brdf.export(m, tmp_path / "m.mtlx").stands_for
    assert isinstance(written, OpenPBR)
    assert dict(written.values) == dict(m.values)


def test_gltf_is_read_by_its_library(tmp_path, red):
    pygltflib = pytest.importorskip("pygltflib")
    brdf.export(GLTF, tmp_path / "m.gltf")
    (material,) = pygltflib.GLTF2().load(str(tmp_path / "m.gltf")).materials
    row = material.pbrMetallicRoughness
    assert material.name == "an orange"
    assert (row.baseColorFactor, row.metallicFactor, row.roughnessFactor) == ([0.8, 0.4, 0.1, 1.0], 0.3, 0.5)
    fitted = brdf.export(red, tmp_path / "red.gltf").stands_for
    assert brdf.compare(red, fitted).psnr_mean > 25
    saved = json.loads((tmp_path / "red.gltf").read_text())["materials"][0]["pbrMetallicRoughness"]
    np.testing.assert_allclose(saved["baseColorFactor"][:3], fitted.base_color, atol=1e-6)


def test_blender_gets_the_sockets_of_its_principled_node(tmp_path):
    """A stand-in for Blender's module, with the sockets that Principled has since 4.0."""
    brdf.export(DISNEY, tmp_path / "m.py")
    sockets = ("Base Color", "Metallic", "Roughness", "IOR", "Alpha", "Specular IOR Level", "Anisotropic")
    inputs = {name: SimpleNamespace(default_value=None) for name in sockets}
    node = SimpleNamespace(type="BSDF_PRINCIPLED", inputs=inputs, distribution="MULTI_GGX")
    material = SimpleNamespace(use_nodes=False, node_tree=SimpleNamespace(nodes=[SimpleNamespace(type="OUT"), node]))
    names = []
    bpy = SimpleNamespace(data=SimpleNamespace(materials=SimpleNamespace(new=lambda n: names.append(n) or material)))
    sys.modules["bpy"] = bpy
    try:
        scope = {"__name__": "__main__"}
        exec(compile((tmp_path / "m.py").read_text(), "m.py", "exec"), scope)
    finally:
        del sys.modules["bpy"]
    assert names == ["1st wood"]
    assert material.use_nodes
    assert node.distribution == "GGX"
    values = {name: socket.default_value for name, socket in inputs.items()}
    assert values["Base Color"] == (0.3, 0.2, 0.1, 1.0)
    assert (values["Metallic"], values["Roughness"], values["Anisotropic"]) == (0.2, 0.4, 0.5)
    assert values["IOR"] == pytest.approx(1.5, abs=1e-6)


@pytest.mark.parametrize(
    ("m", "error"),
    [(Disney(), 44.5), (Disney(metallic=1.0, roughness=0.3), 29.3)],  # dB: 2012 against 2014 with the same numbers
)
def test_blender_masks_facets_as_disney_since_2014(tmp_path, m, error):
    written = brdf.export(m, tmp_path / "m.py").stands_for
    assert (written.masking, written.roughness, written.metallic) == ("2014", m.roughness, m.metallic)
    assert brdf.compare(m, written).psnr_mean == pytest.approx(error, abs=0.1)


COATED = OpenPBR(base_color=(0.6, 0.3, 0.1), specular_roughness=0.5, coat_weight=0.5, coat_roughness=0.3)
"""Not reciprocal: light and viewer exchanged are 5 % apart."""


def eval_in_mitsuba(mi, bsdf):
    values = []
    for light, viewer in zip(WI, WO, strict=True):
        interaction = mi.SurfaceInteraction3f()
        interaction.wi = mi.Vector3f(*viewer.tolist())
        values.append(np.array(bsdf.eval(mi.BSDFContext(), interaction, mi.Vector3f(*light.tolist()))) / light[2])
    return np.array(values)


@pytest.mark.parametrize(
    ("m", "kind", "tolerance"),
    [
        (Lambertian(albedo=(0.1, 0.2, 0.3)), "diffuse", 1e-5),
        (
            Microfacet(
                ndf="beckmann", masking="smith-separable", fresnel="conductor", alpha_x=0.2, alpha_y=0.4,
                eta=(0.2, 0.9, 1.1), k=(3.9, 2.4, 2.1),
            ),
            "roughconductor",
            2e-3,
        ),
        (Lambertian(albedo=0.2) + Microfacet(alpha=0.3), "measured", 0.05),
        (COATED, "measured", 0.02),
    ],
)  # fmt: skip
def test_mitsuba_evaluates_what_was_written(tmp_path, m, kind, tolerance):
    mi = pytest.importorskip("mitsuba")
    before = mi.variant()
    mi.set_variant("scalar_rgb")
    try:
        done = brdf.export(m, tmp_path / "m.xml")
        mi.load_file(str(tmp_path / "m.xml"))
        node = ET.parse(tmp_path / "m.xml").getroot().find("bsdf")
        assert node.get("type") == kind
        for string in node.findall("string"):
            if string.get("name") == "filename":
                string.set("value", str(tmp_path / string.get("value")))
        node.set("version", "3.0.0")
        found = eval_in_mitsuba(mi, mi.load_string(ET.tostring(node, "unicode")))
        by_dict = eval_in_mitsuba(mi, mi.load_dict(bsdf_dict(m, tmp_path / "m.xml.bsdf")))
    finally:
        if before:
            mi.set_variant(before)
    np.testing.assert_allclose(by_dict, found, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(found, done.stands_for(WI, WO), rtol=2e-3, atol=1e-4)
    error = np.abs(found - m(WI, WO)).mean() / m(WI, WO).mean()
    assert error < tolerance


def test_pbrt_gets_a_spectral_measurement(tmp_path, red):
    done = brdf.export(red, tmp_path / "m.pbrt")
    assert (tmp_path / "m.pbrt").read_text().splitlines()[-1] == (
        'MakeNamedMaterial "red" "string type" "measured" "string filename" "m.pbrt.bsdf"'
    )
    fields = io.rgl.read_tensors(tmp_path / "m.pbrt.bsdf")
    read_by_pbrt = "theta_i phi_i ndf sigma vndf luminance spectra wavelengths description jacobian"
    assert set(fields) == set(read_by_pbrt.split())
    assert fields["spectra"].shape[2] == len(fields["wavelengths"])
    assert fields["spectra"].min() >= 0
    assert brdf.compare(red, io.read(tmp_path / "m.pbrt.bsdf")).psnr_mean > 40
    assert done.stands_for.wavelengths is not None


def test_pbrt_escapes_what_ends_its_strings(tmp_path, red):
    path = tmp_path / 'a "q\\.pbrt'
    brdf.export(red, path)
    assert path.read_text().endswith(r'"string filename" "a \"q\\.pbrt.bsdf"' + "\n")


@pytest.mark.parametrize("extension", [".xml", ".pbrt"])
def test_a_measurement_of_the_same_name_is_left_alone(tmp_path, data, extension):
    source = tmp_path / "m.bsdf"
    source.write_bytes((data / "rgl" / "aurora_white_rgb.bsdf").read_bytes())
    before = source.read_bytes()
    done = brdf.export(io.read(source), tmp_path / f"m{extension}")
    assert source.read_bytes() == before
    assert [path.name for path in done.files] == [f"m{extension}", f"m{extension}.bsdf"]


def test_spectra_of_primaries_have_their_colours():
    basis = pbrt.spectra_of_primaries(pbrt.WAVELENGTHS)
    np.testing.assert_allclose(rgb_weights(pbrt.WAVELENGTHS).T @ basis, np.eye(3), atol=1e-6)
    np.testing.assert_allclose(basis.sum(1), 1, atol=1e-6)
    assert basis.min() >= 0


def test_pbrt_gets_saturated_colours_as_they_are(tmp_path):
    m = Lambertian(albedo=(0.02, 0.9, 0.02)) + GGX(alpha=0.2)
    assert brdf.compare(m, brdf.export(m, tmp_path / "m.pbrt").stands_for).psnr_mean > 50


def test_pbrt_gets_a_diffuse_colour_as_numbers(tmp_path):
    m = Lambertian(albedo=(0.02, 0.9, 0.125)).named("grass")
    done = brdf.export(m, tmp_path / "m.pbrt")
    assert (done.files, done.stands_for) == ((tmp_path / "m.pbrt",), m)
    assert (tmp_path / "m.pbrt").read_text().splitlines()[1] == (
        'MakeNamedMaterial "grass" "string type" "diffuse" "rgb reflectance" [ 0.02 0.9 0.125 ]'
    )


def test_the_principled_fit_finds_itself():
    """A model that is one already is kept; an OpenPBR of the same parameters looks alike."""
    assert principled.principled(DISNEY) is DISNEY
    plain = Disney(base_color=(0.3, 0.2, 0.1), roughness=0.5, masking="2014")
    assert brdf.compare(plain, principled.carried_over(plain)).psnr_mean > 25


def test_openpbr_is_fitted_directly(red):
    """Its own fit is nearer than Disney's parameters carried over."""
    carried, fitted = principled.carried_over(principled.principled(red)), principled.open_pbr(red)
    errors = [brdf.compare(red, m).metrics["cosine-weighted L2"] for m in (carried, fitted)]
    assert errors[1] < 0.8 * errors[0]
    assert fitted.coat_weight == fitted.fuzz_weight == 0


@pytest.mark.parametrize("extension", [".gltf", ".mtlx", ".pbrt", ".py", ".xml"])
def test_what_cannot_be_written(tmp_path, extension):
    with pytest.raises(ReflectanceError, match="mirror"):
        brdf.export(brdf.models.SmoothConductor(), tmp_path / f"m{extension}")
    with pytest.raises(ParameterError, match="has no function to name"):
        brdf.export(GLTF, tmp_path / f"m{extension}", function="f")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("kind", "model"), [(".mtlx", "OpenPBR"), (".gltf", "GltfMetallicRoughness"), (".py", "Disney")]
)
def test_what_is_written_as_it_is_stays_what_it_was(tmp_path, kind, model):
    m = brdf.load(model).named("mine", "measured by hand")
    brdf.export(m, tmp_path / f"x{kind}")
    assert (m.name, m.source) == ("mine", "measured by hand")
