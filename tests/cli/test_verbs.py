"""What the verbs do when all is well: what they print, write and return."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import brdf as package
from brdf import io, materials, models

Command = Callable[..., Any]

DRAFT = ("--size", "48x32", "--samples", "1")


def pixels(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path).convert("RGB"), float)


# ---- list, info --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "names"),
    [
        ("models", lambda: sorted([*models.names(), "EnergyCompensated"])),
        ("materials", materials.names),
        ("formats", lambda: [f.name for f in io.formats()]),
    ],
)
def test_list_json_is_a_plain_list_of_names(brdf: Command, kind: str, names: object) -> None:
    outcome = brdf("list", kind, "--json")
    assert outcome.code == 0
    assert json.loads(outcome.out) == names()


def test_listed_meshes_can_be_rendered(brdf: Command, tmp_path: Path) -> None:
    for name in json.loads(brdf("list", "meshes", "--json").out):
        assert brdf("render", "GGX", "--mesh", name, *DRAFT, "--no-compare", "-o", f"{name}.png").code == 0
        assert (tmp_path / f"{name}.png").exists()


def test_list_for_people_has_a_line_a_model(brdf: Command) -> None:
    lines = brdf("list", "models").out.splitlines()
    assert [line.split()[0] for line in lines] == sorted([*models.names(), "EnergyCompensated"])
    assert all(len(line.split()) > 1 for line in lines)


def test_info_shows_equation_bounds_and_units(brdf: Command) -> None:
    out = brdf("info", "GGX:alpha=0.125").out
    assert "f(wi, wo) =" in out
    assert "0.125" in out
    assert "[0.0001, 1]" in out
    assert "as alpha" in out


def test_info_json_has_the_parameters_in_force(brdf: Command) -> None:
    described = json.loads(brdf("info", "Microfacet:fresnel=conductor,alpha=.3", "--json").out)
    values = {p["name"]: p["value"] for p in described["parameters"]}
    assert values["alpha"] == 0.3
    assert len(values["eta"]) == 3
    assert described["choices"]["fresnel"]["value"] == "conductor"
    assert described["choices"]["fresnel"]["options"]["conductor"] == ["eta", "k"]


def test_info_names_the_arrays_that_choices_take(brdf: Command) -> None:
    described = json.loads(brdf("info", "Microfacet:ndf=map", "--json").out)
    assert described["choices"]["ndf"]["options"]["map"] == ["facets"]
    assert described["choices"]["fresnel"]["options"]["table"] == ["table"]
    (declared,) = described["arrays"]
    assert declared == {
        "name": "facets", "shape": ["n", "n", 1], "low": 0.0, "high": None, "unit": "1",
        "doc": "relative D over (h.x, h.y) in [-1, 1]^2",
    }  # fmt: skip
    out = brdf("info", "Microfacet:ndf=map").out
    assert "relative D over (h.x, h.y) in [-1, 1]^2" in out
    assert "n x n x 1" in out


def test_every_listed_model_has_a_description(brdf: Command) -> None:
    for name in json.loads(brdf("list", "models", "--json").out):
        outcome = brdf("info", name)
        assert outcome.code == 0, name
        assert "Reference" in outcome.out, name


def test_energy_compensation_goes_around_microfacets_of_any_kind(brdf: Command) -> None:
    described = json.loads(brdf("info", "energycompensated:ndf=beckmann,alpha=.5,F0=1", "--json").out)
    assert described["kind"] == "EnergyCompensated"
    assert described["lobes"]["base"]["choices"]["ndf"]["value"] == "beckmann"
    assert brdf("check", "EnergyCompensated:alpha=.5,F0=1").code == 0
    outcome = brdf("info", "EnergyCompensated:alpha=7")
    assert outcome.code == 2
    assert "EnergyCompensated: alpha must lie in [0.0001, 1], got 7" in outcome.err


def test_info_of_a_sum_describes_its_lobes(brdf: Command) -> None:
    described = json.loads(brdf("info", "Lambertian:albedo=.2+0.5*GGX", "--json").out)
    assert [lobe["kind"] for lobe in described["lobes"].values()] == ["Lambertian", "Scaled"]


def test_info_of_a_material_names_its_source(brdf: Command) -> None:
    described = json.loads(brdf("info", "gold-metallic-paint", "--json").out)
    assert described["name"] == "gold-metallic-paint"
    assert described["source"]


def test_info_of_a_material_lists_its_fits_with_errors_and_the_best(brdf: Command) -> None:
    out = brdf("info", "gold-metallic-paint@ngan_ward").out
    rows = [line.split() for line in out.splitlines()]
    fits = [row for row in rows if row and row[0].startswith(("bagher_", "low_", "ngan_")) and len(row) == 2]
    errors = [float(error) for _, error in fits]
    assert len(fits) == 14
    assert errors == sorted(errors)
    assert f"{fits[0][0]} agrees best" in out
    described = json.loads(brdf("info", "white-fabric2", "--json").out)
    assert described["fits"][0] == {"fit": "bagher_sgd", "error": None}
    assert "fits" not in json.loads(brdf("info", "GGX", "--json").out)


def test_info_of_a_merl_file_gives_format_grid_and_invalid_share(brdf: Command) -> None:
    assert brdf("convert", "Lambertian:albedo=.3", "plain.binary").code == 0
    described = json.loads(brdf("info", "plain.binary", "--json").out)
    assert described["file"]["format"] == "MERL"
    assert described["file"]["bytes"] == 12 + 3 * 8 * 90 * 90 * 180
    assert described["grid"]["shape"] == [90, 90, 181]  # the last repeats the first: phi_d is periodic
    assert 0 < described["grid"]["invalid_share"] < 0.5  # the bins below the horizon
    assert "of the nodes" in brdf("info", "plain.binary").out


def test_info_of_a_spectral_or_rgb_measurement(brdf: Command, data: Path) -> None:
    described = json.loads(brdf("info", data / "rgl" / "chm_orange_rgb.bsdf", "--json").out)
    assert described["file"]["format"] == "RGL"
    assert described["textures"] or described["bytes"] > 1000


# ---- render ------------------------------------------------------------------------------------------------------


def test_the_default_picture_compares_with_the_16_kb_stack(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("render", "gold-metallic-paint", *DRAFT)
    assert outcome.code == 0
    assert "16 KB slice stack" in outcome.out
    assert "dB" in outcome.out
    assert outcome.out.splitlines()[-1] == str(tmp_path / "gold-metallic-paint.png")
    picture = pixels(tmp_path / "gold-metallic-paint.png")
    assert picture.shape[1] == 48
    assert picture.shape[0] > 32  # the caption


def test_the_printed_numbers_are_those_of_compare(brdf: Command) -> None:
    numbers = json.loads(brdf("render", "gold-metallic-paint", *DRAFT, "--json").out)
    m = package.load("gold-metallic-paint")
    expected = package.compare(m, package.SliceStack.bake(m))
    assert numbers["psnr"] == pytest.approx(expected.psnr)
    assert numbers["bytes"] == list(expected.bytes)
    assert numbers["albedo_difference"] == pytest.approx(expected.albedo_difference)
    # the albedo of a 45 degree view, against the sampling estimator
    wo = [np.sqrt(0.5), 0, np.sqrt(0.5)]
    assert np.allclose(numbers["albedo"][0], m.albedo(wo), atol=5 * m.albedo_error(wo).max() + 1e-3)


def test_both_halves_show_their_own_material(brdf: Command, tmp_path: Path) -> None:
    red, blue = "Lambertian:albedo=.8/0/0", "Lambertian:albedo=0/0/.8"
    outcome = brdf("render", red, "--compare", blue, "--mesh", "sphere", *DRAFT, "-o", "two.png")
    assert outcome.code == 0
    left, right = pixels(tmp_path / "two.png")[:32].reshape(32, 2, 24, 3).transpose(1, 0, 2, 3)
    assert left[10:22, 16:22, 0].mean() > 2 * left[10:22, 16:22, 2].mean()
    assert right[10:22, 2:8, 2].mean() > 2 * right[10:22, 2:8, 0].mean()


def test_no_compare_gives_a_picture_of_the_size_asked_for(brdf: Command, tmp_path: Path) -> None:
    assert brdf("render", "GGX", *DRAFT, "--no-compare", "-o", "x.png").code == 0
    assert pixels(tmp_path / "x.png").shape == (32, 48, 3)


def test_an_anisotropic_material_is_drawn_alone_with_a_note(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("render", "GGX:alpha_x=.1,alpha_y=.4", *DRAFT, "-o", "x.png")
    assert outcome.code == 0
    assert "is anisotropic" in outcome.err
    assert pixels(tmp_path / "x.png").shape == (32, 48, 3)


def test_a_mirror_is_drawn_alone_with_a_note(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("render", "Mirror", *DRAFT, "-o", "x.png")
    assert outcome.code == 0
    assert "Mirror mirrors, which a slice stack cannot hold" in outcome.err
    assert pixels(tmp_path / "x.png").shape == (32, 48, 3)


def test_a_baked_stack_is_not_compared_with_itself(brdf: Command, tmp_path: Path) -> None:
    assert brdf("bake", "GGX:alpha=.3", "-o", "small.safetensors").code == 0
    assert brdf("render", "small.safetensors", *DRAFT, "-o", "x.png").code == 0
    assert pixels(tmp_path / "x.png").shape == (32, 48, 3)


def test_scene_options_change_the_picture_and_the_seed_fixes_it(brdf: Command, tmp_path: Path) -> None:
    base = ("render", "GGX:alpha=.3", "--no-compare", *DRAFT)
    variants = {
        "base": (),
        "again": (),
        "seed": ("--seed", "3"),
        "light": ("--light", "directional:theta=20,phi=40", "--light", "point:0/3/3,power=4"),
        "env": ("--env", "0.5"),
        "bright": ("--exposure", "1"),
        "clip": ("--tone", "clip"),
        "back": ("--background", ".1/.5/.1"),
        "lit-through": ("--light", "directional:theta=70,phi=-80", "--no-shadows"),
        "shadowed": ("--light", "directional:theta=70,phi=-80"),
    }
    pictures = {}
    for name, options in variants.items():
        assert brdf(*base, *options, "-o", f"{name}.png").code == 0
        pictures[name] = pixels(tmp_path / f"{name}.png")
    assert np.array_equal(pictures.pop("base"), pictures["again"])
    names = list(pictures)
    for i, one in enumerate(names):
        for other in names[i + 1 :]:
            assert not np.array_equal(pictures[one], pictures[other]), (one, other)
    assert pictures["bright"].mean() > pictures["again"].mean()
    assert pictures["lit-through"].mean() > pictures["shadowed"].mean()


def test_an_exr_holds_the_linear_picture(brdf: Command, tmp_path: Path) -> None:
    from brdf.render.image import read_exr

    assert brdf("render", "Lambertian", "--mesh", "plane", *DRAFT, "--no-compare", "-o", "x.exr").code == 0
    assert read_exr(tmp_path / "x.exr").shape == (32, 48, 3)


# ---- convert, bake, check, show ----------------------------------------------------------------------------------


def test_merl_to_safetensors_and_back_loses_nothing(brdf: Command) -> None:
    assert brdf("convert", "gold-metallic-paint", "a.binary").code == 0
    first = json.loads(brdf("convert", "a.binary", "b.safetensors", "--json").out)
    assert first["psnr"] is None or first["psnr"] > 90  # null: identical
    second = json.loads(brdf("convert", "b.safetensors", "c.binary", "--json").out)
    assert second["relative_rmse"] < 1e-6


def test_rgl_to_merl(brdf: Command, data: Path) -> None:
    done = json.loads(brdf("convert", data / "rgl" / "chm_orange_rgb.bsdf", "orange.binary", "--json").out)
    assert done["psnr"] > 25


def test_check_of_a_sound_model_passes(brdf: Command) -> None:
    outcome = brdf("check", "Lambertian:albedo=.5", "--json")
    report = json.loads(outcome.out)
    assert outcome.code == 0
    assert report["passed"]
    assert {"positivity", "reciprocity", "energy"} <= {r["law"] for r in report["results"]}


def test_check_of_a_material_that_gains_energy_fails(brdf: Command) -> None:
    outcome = brdf("check", "2*Lambertian:albedo=.9")
    assert outcome.code == 1
    assert "breaks" in outcome.out
    assert outcome.err == ""


@pytest.mark.parametrize("what", ["all", "lobes", "slices", "albedo"])
def test_show_writes_a_figure_600_pixels_wide(brdf: Command, tmp_path: Path, what: str) -> None:
    outcome = brdf("show", "GGX:alpha=.2", "--what", what, "-o", "x.png")
    assert outcome.code == 0
    assert outcome.out.strip() == str(tmp_path / "x.png")
    assert pixels(tmp_path / "x.png").shape[1] == 600


def test_show_writes_vector_graphics(brdf: Command, tmp_path: Path) -> None:
    assert brdf("show", "GGX", "--what", "albedo", "-o", "x.svg").code == 0
    assert (tmp_path / "x.svg").read_text().startswith("<?xml")
