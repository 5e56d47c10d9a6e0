"""`brdf show`: several materials, every figure, profiles, and what cannot be drawn."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Command = Callable[..., Any]


@pytest.mark.parametrize("what", ["cartesian", "fresnel", "spheres", "solid", "whiteout"])
def test_every_figure(brdf: Command, tmp_path: Path, what: str) -> None:
    outcome = brdf("show", "GGX:alpha=.3", "--what", what, "-o", "x.png")
    assert (outcome.code, outcome.out.strip()) == (0, str(tmp_path / "x.png"))


def test_several_materials_and_profiles(brdf: Command, tmp_path: Path) -> None:
    assert brdf("show", "GGX", "Lambertian", "--what", "albedo", "-o", "x.html").code == 0
    assert "GGX and Lambertian" in (tmp_path / "x.html").read_text("utf-8")
    assert brdf("show", "burley:A=.9/.6/.3,length=2", "dipole", "-o", "p.svg").code == 0
    assert (tmp_path / "p.svg").exists()


def test_two_fits_of_one_material_are_told_apart(brdf: Command, tmp_path: Path) -> None:
    assert brdf("show", "chrome", "chrome@ngan_ward", "--what", "albedo", "-o", "x.html").code == 0
    assert "chrome and chrome@ngan_ward" in (tmp_path / "x.html").read_text("utf-8")


def test_a_profile_is_no_reflectance_and_has_a_name_to_guess(brdf: Command) -> None:
    for verb in ("info", "check", "render"):
        outcome = brdf(verb, "burley:A=.5")
        assert outcome.code == 2
        assert "'burley:A=.5' is a profile of subsurface scattering, no reflectance" in outcome.err
    assert "unknown model 'burly': did you mean 'burley'?" in brdf("show", "burly:A=.5").err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("GGX", "Lambertian", "--what", "solid"), "--what solid shows one material, 2 were given"),
        (("GGX", "dipole"), "profiles of subsurface scattering have a figure of their own"),
        (("burley:A=3",), "A must lie in [0, 1], got 3"),
        (("Lambertian", "--what", "fresnel"), "Lambertian has no Fresnel term to draw"),
    ],
)
def test_what_cannot_be_drawn_together(brdf: Command, tmp_path: Path, arguments: tuple[str, ...], message: str) -> None:
    outcome = brdf("show", *arguments)
    assert outcome.code == 2
    assert message in outcome.err
    assert not list(tmp_path.iterdir())
