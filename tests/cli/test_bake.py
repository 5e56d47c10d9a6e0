"""`brdf bake` and `brdf convert`: representations, their options, and what they are said to cost."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brdf as package
from brdf.representations.spheres.sphere_images import SphereImages

Command = Callable[..., Any]


def test_the_budget_is_kept(brdf: Command, tmp_path: Path) -> None:
    sizes, quality = [], []
    for budget in ("16K", "64K"):
        done = json.loads(brdf("convert", "GGX:alpha=.2", "x.safetensors", "--budget", budget, "--json").out)
        assert done["file_bytes"] == (tmp_path / "x.safetensors").stat().st_size
        sizes.append(done["bytes"][1])
        quality.append(done["psnr"])
    assert 16_000 < sizes[0] < 17_000
    assert 64_000 < sizes[1] < 66_000
    assert quality[1] > quality[0] > 30


def test_bake_names_its_file_after_material_and_representation(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("bake", "gold-metallic-paint")
    path = tmp_path / "gold-metallic-paint-slice-stack.safetensors"
    assert outcome.out.splitlines()[0] == str(path)
    assert package.load(path).name == "gold-metallic-paint"


def test_bake_says_what_it_costs_and_loses(brdf: Command) -> None:
    outcome = brdf("bake", "GGX:alpha=.3", "-o", "small.safetensors")
    c = package.compare(package.load("GGX:alpha=.3"), package.load("small.safetensors"))
    printed = dict(line.split("  ", 1) for line in outcome.out.splitlines() if "  " in line)
    printed = {what.strip(): value.strip() for what, value in printed.items()}
    assert printed["PSNR [dB]"] == f"{c.psnr:.1f}"
    assert printed["PSNR of one light: mean"] == f"{c.psnr_mean:.1f}"
    assert printed["PSNR of one light: least"] == f"{c.psnr_min:.1f}"
    assert printed["ΔE2000: mean"] == f"{c.delta_e.mean:.3g}"
    assert printed["log relative"] == f"{c.metrics['log relative']:.3g}"
    assert printed["bytes"] == f"16 -> {package.load('small.safetensors').nbytes:,}"


def test_sphere_images_with_angles_size_storage_and_blend(brdf: Command) -> None:
    options = ("--angles", "0,40,100", "--size", "32", "--storage", "float32", "--blend", "paper", "--json")
    done = json.loads(
        brdf("bake", "GGX:alpha=.3", "--as", "sphere-images", *options, "-o", "s.safetensors", "--json").out
    )
    m = package.load("s.safetensors")
    assert isinstance(m, SphereImages)
    np.testing.assert_array_equal(m.angles, [0, 40, 100])
    assert m.size == 32
    assert m.blend == "paper"
    assert done["bytes"][1] == m.nbytes == 3 * 32 * 32 * 3 * 4 + 3 * 4  # the angles
    expected = SphereImages.bake(package.load("GGX:alpha=.3"), (0, 40, 100), 32, "float32", "paper")
    np.testing.assert_array_equal(m.images, expected.images)


@pytest.mark.parametrize(("preset", "angles"), [("plastic", range(0, 136, 45)), ("metal", range(0, 151, 30))])
def test_presets_of_angles_alone_ask_for_sphere_images(brdf: Command, preset: str, angles: range) -> None:
    assert brdf("bake", "Lambertian", "--angles", preset, "--size", "16").code == 0
    m = package.load("Lambertian-sphere-images.safetensors")
    np.testing.assert_array_equal(m.angles, angles)


@pytest.mark.parametrize("place", ["balls/", "ball.png", "ball.exr"])
def test_sphere_images_as_pictures(brdf: Command, tmp_path: Path, place: str) -> None:
    done = json.loads(brdf("bake", "Lambertian", "--as", "sphere-images", "--size", "24", "-o", place, "--json").out)
    path = tmp_path / place
    files = [f for f in path.iterdir() if f.is_file()] if path.is_dir() else [path]
    assert path.is_dir() == place.endswith("/")
    assert done["file"] == place
    assert done["file_bytes"] == sum(f.stat().st_size for f in files)
    assert done["psnr"] > 30
    assert brdf("convert", place, "again.safetensors").code == 0
    assert brdf("convert", place, "pictures/").code == 0
    assert package.load("pictures").size == 24


def test_a_table_in_a_storage(brdf: Command) -> None:
    assert brdf("bake", "Lambertian", "--as", "table", "--storage", "float32", "-o", "t.safetensors").code == 0
    assert package.load("t.safetensors").layout.storage == "float32"


def test_what_was_baked_can_be_shown_and_described(brdf: Command) -> None:
    assert brdf("bake", "GGX:alpha=.3", "--as", "sphere-images", "--size", "32", "-o", "s.safetensors").code == 0
    described = json.loads(brdf("info", "s.safetensors", "--json").out)
    assert described["kind"] == "SphereImages"
    assert described["pictures"] == {"angles": [0, 45, 90, 135], "size": 32, "storage": "half", "blend": "separated"}
    assert "32 x 32 for lights at 0°, 45°, 90°, 135° from the viewer" in brdf("info", "s.safetensors").out
    assert brdf("convert", "s.safetensors", "folder/").code == 0
    described = json.loads(brdf("info", "folder", "--json").out)["file"]
    assert described["bytes"] == sum(f.stat().st_size for f in Path("folder").iterdir())
    assert brdf("show", "s.safetensors", "--what", "slices").code == 0


def test_convert_and_bake_from_python(tmp_path: Path) -> None:
    done = package.convert("GGX:alpha=.3", tmp_path / "x.safetensors", "table", shape=(8, 8, 8))
    assert done.written.layout.shape == (8, 8, 8)
    assert done.file_bytes == (tmp_path / "x.safetensors").stat().st_size
    assert done.comparison.pair == (done.source, done.written)


def test_a_folder_called_like_a_material_is_not_described_in_its_place(brdf: Command) -> None:
    """`brdf bake chrome --as sphere-images -o chrome/` makes one; a name wins over it, ./chrome is the folder."""
    assert brdf("bake", "chrome", "--as", "sphere-images", "--size", "16", "-o", "chrome/").code == 0
    material, folder = (json.loads(brdf("info", name, "--json").out) for name in ("chrome", "./chrome"))
    assert (material["kind"], folder["kind"]) == ("SGD", "SphereImages")
    assert "file" not in material
    assert material["fits"]
    assert folder["file"]["format"] == "sphere images"
