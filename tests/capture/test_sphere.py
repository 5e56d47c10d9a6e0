"""Photographs of a ball: what a known camera saw of a known material is found again; mistakes are named."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.capture.test_photographs import deep_png

import brdf
from brdf import capture, models
from brdf.capture.ball import analytic_fit, reading, stack_fit
from brdf.capture.ball.assembly import choose_angles
from brdf.capture.ball.captured import IMAGES, REPORT, STACK, Captured
from brdf.capture.ball.coverage import coverage_of
from brdf.capture.ball.hold_out import mean_psnr
from brdf.capture.ball.outline import Ball, ball_of_mask, ball_of_pictures
from brdf.capture.lights import read_directions
from brdf.cli import run
from brdf.color import luminance, srgb_encode
from brdf.errors import BrdfError, CorruptFileError, FileError, ParameterError
from brdf.geometry.directions import frame, from_spherical
from brdf.metrics import psnr_of
from brdf.reflectance import Reflectance

BALL = Ball(41.3, 36.8, 27.4)
SHAPE = (72, 80)
PLASTIC = models.Lambertian(albedo=(0.5, 0.3, 0.2)) + models.GGX(alpha=0.25, F0=0.05)
EXPOSURE = 0.6


def directions(count: int, seed: int = 3, widest: float = 70.0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return from_spherical(np.radians(np.linspace(6, widest, count)), rng.uniform(0, 2 * math.pi, count))


def picture(m: Reflectance, light: np.ndarray) -> np.ndarray:
    """(H, W, 3) radiance pi f cos of the ball, written down here apart from the package: 3 x 3 rays a pixel."""
    total = np.zeros((*SHAPE, 3))
    for dy in (-1 / 3, 0, 1 / 3):
        for dx in (-1 / 3, 0, 1 / 3):
            x = (np.arange(SHAPE[1]) + 0.5 + dx - BALL.x) / BALL.radius
            y = (BALL.y - np.arange(SHAPE[0]) - 0.5 - dy) / BALL.radius
            x, y = np.meshgrid(x, y)
            on = x * x + y * y < 1
            normal = np.stack([x[on], y[on], np.sqrt(1 - x[on] ** 2 - y[on] ** 2)], -1)
            local = np.stack([*frame(normal), normal], 1)
            total[on] += math.pi * m.f_cos(local @ light, local[:, :, 2]) / 9
    return total


@functools.lru_cache(maxsize=2)
def pictures(count: int) -> np.ndarray:
    return np.stack([picture(PLASTIC, light) for light in directions(count)])


def photograph(
    folder: Path, count: int = 24, bits: int = 16, noise: float = 0.002, encode: Callable[[Any], Any] = srgb_encode
) -> Path:
    """A folder of photographs with noise, clipped where too bright; 8 bits go through `encode`."""
    folder.mkdir(exist_ok=True)
    rng = np.random.default_rng(5)
    for i, radiance in enumerate(pictures(count)):
        light = np.clip(EXPOSURE * radiance + rng.normal(0, noise, radiance.shape), 0, 1)
        if bits == 16:
            (folder / f"{i}.png").write_bytes(deep_png(np.rint(light * 65535).astype(np.uint16)))
        else:
            Image.fromarray(np.rint(encode(light) * 255).astype(np.uint8)).save(folder / f"{i}.png")
    np.savetxt(folder / "light_directions.txt", directions(count))
    return folder


def error(m: Reflectance, degrees: float) -> float:
    """PSNR [dB] of a light that no photograph had, against the truth, over what is well seen."""
    light = from_spherical(math.radians(degrees), 2.0)
    normal, distance = BALL.normals(*SHAPE)
    local = np.stack([*frame(normal[distance < 0.95]), normal[distance < 0.95]], 1)
    pair = local @ light, local[:, :, 2]
    return psnr_of(math.pi * PLASTIC.f_cos(*pair), math.pi * m.f_cos(*pair))


@pytest.fixture(scope="module", autouse=True)
def lean() -> Iterator[None]:
    """Fewer pixels, samples and strengths to choose among: the same steps in a tenth of the time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reading, "MOST_PIXELS", 64)
        patch.setattr(analytic_fit, "MOST_SAMPLES", 1500)
        patch.setattr(stack_fit, "TRIED", (1e-3, 1e-2))
        yield


@pytest.fixture(scope="module")
def deep(tmp_path_factory: pytest.TempPathFactory) -> Captured:
    return capture.sphere(photograph(tmp_path_factory.mktemp("deep")), white=EXPOSURE, holdout=4, budget="4K")


# ---- the material comes back -------------------------------------------------------------------------------------


def test_the_material_comes_back(deep: Captured) -> None:
    for degrees in (15.0, 33.0, 55.0):
        assert error(deep.stack, degrees) > 38
        assert error(deep.images, degrees) > 34
    # beyond the last light (70 degrees) the fitted model leads on
    assert error(deep.stack, 110.0) > 30


def test_left_out_photographs_are_predicted_better_than_by_the_paper(deep: Captured) -> None:
    means = mean_psnr(deep.holdout)
    assert len(deep.holdout) == 6
    assert means["slice stack"] > means["paper's Eq. 4"] + 2
    assert means["sphere images"] > means["paper's Eq. 4"] + 1
    assert f"{means['slice stack']:.2f}" in deep.report


@pytest.mark.parametrize(("encode", "response"), [(srgb_encode, "srgb"), (np.asarray, "linear")])
def test_eight_bits_are_enough_for_a_start(tmp_path: Path, encode: Callable[[Any], Any], response: str) -> None:
    """Their response is found."""
    folder = photograph(tmp_path / "shallow", count=7, bits=8, noise=0.0, encode=encode)
    found = capture.sphere(folder, white=EXPOSURE, budget="4K", size=64)
    assert error(found.stack, 33.0) > 33
    assert f"response {response} (chosen: " in found.report


def test_the_ball_is_found_without_a_mask(deep: Captured) -> None:
    (line,) = [fact for fact in deep.facts if fact.startswith("ball (circle")]
    assert f"{deep.scale:.3f}" == f"{1 / EXPOSURE:.3f}"
    x, y, radius = (float(word.strip(",")) for word in np.array(line.replace(",", "").split())[[7, 8, 14]])
    assert abs(x - BALL.x) < 0.6
    assert abs(y - BALL.y) < 0.6
    assert abs(radius - BALL.radius) < 0.6


def test_the_scale_is_the_albedo_asked_for(tmp_path: Path) -> None:
    folder = photograph(tmp_path / "a", count=6)
    found = capture.sphere(folder, albedo=0.2, size=32, budget="4K")
    value = found.stack(from_spherical(0.7, 0.0), from_spherical(0.3, 1.5))
    assert abs(math.pi * float(luminance(value)) / 0.2 - 1) < 0.15


def test_intensities_a_dark_frame_and_a_mask_are_used(tmp_path: Path) -> None:
    plain = capture.sphere(photograph(tmp_path / "plain", count=6, noise=0), white=EXPOSURE, size=32, budget="4K")
    folder = tmp_path / "lit"
    folder.mkdir()
    strength = np.linspace(0.6, 1.1, 6)[:, None] * [1.0, 0.9, 0.8]
    for i, radiance in enumerate(pictures(6)):
        light = np.clip(EXPOSURE * radiance * strength[i] + 0.05, 0, 1)
        (folder / f"{i}.png").write_bytes(deep_png(np.rint(light * 65535).astype(np.uint16)))
    (folder / "dark.png").write_bytes(deep_png(np.full((*SHAPE, 3), round(0.05 * 65535), np.uint16)))
    Image.fromarray(np.uint8(255 * (BALL.normals(*SHAPE)[1] < 1))).save(folder / "mask.png")
    np.savetxt(folder / "lights.txt", directions(6), header="6", comments="")
    np.savetxt(folder / "light_intensities.txt", strength)
    found = capture.sphere(folder, white=EXPOSURE, size=32, budget="4K")
    assert "from mask.png" in found.report
    for degrees in (15.0, 40.0):
        assert error(found.stack, degrees) > error(plain.stack, degrees) - 3


def test_saturated_pixels_are_filled(tmp_path: Path) -> None:
    """Mirror-like highlights clip in every photograph: the warning says so, and no texel is left dark."""
    bright = tmp_path / "bright"
    bright.mkdir()
    for i, radiance in enumerate(pictures(6)):
        light = np.clip(1.9 * radiance, 0, 1)
        (bright / f"{i}.png").write_bytes(deep_png(np.rint(light * 65535).astype(np.uint16)))
    np.savetxt(bright / "lights.txt", directions(6))
    found = capture.sphere(bright, white=1.0, size=64, budget="4K")
    (warning,) = [text for text in found.warnings if "saturated" in text]
    assert "%" in warning
    assert "expose shorter" in warning
    first = found.images.images[0]
    assert first[32, 32].min() > 0.3 * first[28, 12].min()


def test_the_same_photographs_give_the_same_bits(tmp_path: Path) -> None:
    folder = photograph(tmp_path / "a", count=6)
    one, two = (capture.sphere(folder, size=32, budget="4K") for _ in range(2))
    np.testing.assert_array_equal(one.stack.codes, two.stack.codes)
    np.testing.assert_array_equal(one.images.images, two.images.images)


# ---- real photographs --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["diligent_ball", "uw_gray"])
def test_real_photographs_left_out_are_predicted_best_by_ours(data: Path, name: str) -> None:
    """Both are linear; of the second, which has 8 bits, that is found."""
    found = capture.sphere(data / "spheres" / name, holdout=4, budget="4K", size=64)
    assert "response linear" in found.report
    means = mean_psnr(found.holdout)
    for ours, margin in (("slice stack", 0.1), ("sphere images", 0.5)):
        assert means[ours] > means["paper's Eq. 4"] + margin, means
        assert means[ours] > means["GGX + Lambert"], means
    assert found.stack.nbytes <= 4 << 10
    assert found.images(from_spherical(0.3, 0.0), from_spherical(0.2, 1.0)).min() > 0


# ---- parts -------------------------------------------------------------------------------------------------------


def test_the_circle_is_found_beside_a_stand() -> None:
    brightest = pictures(24).max(0).mean(-1) + 0.002
    brightest[60:, 34:49] = 0.12  # the ball stands on something
    ball = ball_of_pictures(brightest)
    assert max(abs(ball.x - BALL.x), abs(ball.y - BALL.y), abs(ball.radius - BALL.radius)) < 0.8


def test_masks() -> None:
    disc = BALL.normals(*SHAPE)[1] < 1
    found = ball_of_mask(disc)
    assert max(abs(found.x - BALL.x), abs(found.y - BALL.y), abs(found.radius - BALL.radius)) < 0.1
    square = np.zeros(SHAPE, bool)
    square[10:60, 10:30] = True
    for mask, said in ((square, "no disc"), (np.zeros(SHAPE, bool), "too few"), (~disc, "no disc")):
        with pytest.raises(ParameterError, match=said):
            ball_of_mask(mask)


def test_angles_follow_the_lights() -> None:
    seen, beyond = choose_angles(np.array([5.0, 6.0, 7.0, 30.0, 31.0, 60.0]))
    assert seen == [5.0, 30.5, 60.0]
    assert beyond == [90.0, 120.0, 165.0]


def test_coverage_counts_what_is_possible() -> None:
    from tests.helpers import random_directions

    everything = coverage_of(random_directions(400_000, 1), random_directions(400_000, 2))
    assert everything.share > 0.9
    one = coverage_of(from_spherical([0.3], [0.0]), from_spherical([0.3], [math.pi]))
    assert one.seen.sum() == 1
    assert one.seen[0, 3].any()  # theta_h 0, theta_d 17 degrees
    assert one.largest_theta_d == 20
    assert np.isnan(one.map[17, 17])


# ---- the folder it makes -----------------------------------------------------------------------------------------


def test_the_folder_loads_back_and_is_not_overwritten(deep: Captured, tmp_path: Path) -> None:
    target = deep.save(tmp_path / "made")
    assert sorted(p.name for p in target.iterdir()) == [
        "report.json", "report.txt", "slice-stack.safetensors", "sphere-images.safetensors",
    ]  # fmt: skip
    wi, wo = from_spherical([0.4, 0.1], 0.0), from_spherical([0.2, 0.6], 2.0)
    for name, m in ((IMAGES, deep.images), (STACK, deep.stack)):
        np.testing.assert_array_equal(brdf.load(str(target / name))(wi, wo), m(wi, wo))
    with pytest.raises(FileError, match="exists; choose another folder with -o, or replace it with --overwrite"):
        deep.save(target)
    (target / REPORT).write_text("old")
    deep.save(target, overwrite=True)
    assert (target / REPORT).read_text("utf-8") == deep.report
    assert [p.name for p in tmp_path.iterdir()] == ["made"]


def test_a_failure_leaves_nothing_behind(deep: Captured, tmp_path: Path) -> None:
    def fails(place: Path) -> None:
        raise RuntimeError("no space")

    with pytest.raises(RuntimeError):
        deep.save(tmp_path / "made", also=fails)
    assert list(tmp_path.iterdir()) == []
    other = tmp_path / "precious"
    other.mkdir()
    (other / "thesis.txt").write_text("x")
    with pytest.raises(FileError, match="no result of a capture"):
        deep.save(other, overwrite=True)


def test_the_command_says_what_it_made(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = photograph(tmp_path / "photographs", count=6)
    command = ["capture", "sphere", str(folder), "-o", str(tmp_path / "made"), "--size", "32", "--angles", "10,30,60"]
    command += ["--budget", "4K"]
    assert run([*command, "--json"]) == 0
    numbers = json.loads(capsys.readouterr().out)
    assert numbers["angles"] == [10, 30, 60]
    assert (tmp_path / "made" / "coverage.png").stat().st_size > 1000
    assert json.loads((tmp_path / "made" / "report.json").read_text("utf-8"))["scale"] == numbers["scale"]
    for arguments, said in ((command, "exists"), ([*command[:3], "--angles", "a"], "degrees between commas")):
        assert run(arguments) == 2
        printed = capsys.readouterr()
        assert said in printed.err
        assert printed.err.count("\n") == 1


# ---- mistakes ----------------------------------------------------------------------------------------------------


def without_lights(folder: Path) -> None:
    (folder / "light_directions.txt").unlink()


def other_size(folder: Path) -> None:
    Image.new("RGB", (9, 9)).save(folder / "2.png")


def shallow(folder: Path) -> None:
    Image.new("RGB", SHAPE[::-1]).save(folder / "2.png")


def alone(folder: Path) -> None:
    for path in sorted(folder.glob("*.png"))[1:]:
        path.unlink()


def one_more(folder: Path) -> None:
    (folder / "6.png").write_bytes((folder / "5.png").read_bytes())


def below(folder: Path) -> None:
    lights = directions(6)
    lights[3, 2] = -0.2
    np.savetxt(folder / "light_directions.txt", lights)


def words(folder: Path) -> None:
    (folder / "light_directions.txt").write_text("0 0 1\nup\n")


def no_ball(folder: Path) -> None:
    Image.new("L", SHAPE[::-1]).save(folder / "mask.png")


def two_masks(folder: Path) -> None:
    no_ball(folder)
    Image.new("L", SHAPE[::-1]).save(folder / "mask2.png")


def empty(folder: Path) -> None:
    (folder / "3.png").write_bytes(b"")


def torn(folder: Path) -> None:
    content = (folder / "3.png").read_bytes()
    (folder / "3.png").write_bytes(content[: len(content) // 2])


def black(folder: Path) -> None:
    (folder / "4.png").write_bytes(deep_png(np.zeros((*SHAPE, 3), np.uint16)))


def all_black(folder: Path) -> None:
    for path in folder.glob("*.png"):
        path.write_bytes(deep_png(np.zeros((*SHAPE, 3), np.uint16)))


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (without_lights, "has no light_directions.txt or lights.txt; write a line x y z a photograph there"),
        (other_size, "2.png: is 9 x 9, but 0.png 80 x 72; all photographs must be of one size"),
        (shallow, "2.png: holds numbers up to 255, but 0.png up to 65535; save all with the same depth"),
        (alone, "holds 1 photograph(s)"),
        (one_more, "has 6 lights for 7 photographs; give one a photograph"),
        (below, "light 4 is behind the ball (z = "),
        (words, "line 2 is not made of numbers: 'up'"),
        (no_ball, "mask.png: the mask has 0 pixels, too few for a ball"),
        (two_masks, "holds 2 masks (mask.png, mask2.png); say which with --mask"),
        (empty, "3.png: is empty (0 bytes)"),
        (torn, "3.png: "),
        (black, "4.png: is black; take it again, or remove it and its line"),
        (all_black, "the photographs are black; expose longer"),
    ],
)
def test_mistakes_are_named(tmp_path: Path, spoil: Any, said: str) -> None:
    folder = photograph(tmp_path / "photographs", count=6)
    spoil(folder)
    with pytest.raises(BrdfError) as raised:
        capture.sphere(folder, size=64)
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"holdout": 99}, "--hold-out 99 does not go with 6 photographs"),
        ({"holdout": 1}, "--hold-out 1 does not go with"),
        ({"albedo": 0.0}, "albedo must lie in (0, 1]"),
        ({"albedo": 0.5, "white": 0.5}, "both set the scale"),
        ({"response": "film"}, "response must be linear, srgb, or a gamma"),
        ({"angles": [30, 20]}, "angles must increase"),
        ({"size": 1}, "a picture is 2 to"),
        ({"budget": "3"}, "budget"),
        ({"mask": "nowhere.png"}, "no such file"),
    ],
)
def test_wrong_arguments_are_named(tmp_path: Path, given: dict[str, Any], said: str) -> None:
    folder = photograph(tmp_path / "photographs", count=6)
    with pytest.raises(BrdfError) as raised:
        capture.sphere(folder, **{"size": 64, **given})
    assert said in str(raised.value)


def test_stray_light_is_noticed(tmp_path: Path) -> None:
    folder = tmp_path / "a"
    folder.mkdir()
    disc = (BALL.normals(*SHAPE)[1] < 1)[..., None]
    for i, radiance in enumerate(pictures(24)[-6:]):
        light = np.clip(EXPOSURE * radiance + 0.02 * disc, 0, 1)
        (folder / f"{i}.png").write_bytes(deep_png(np.rint(light * 65535).astype(np.uint16)))
    np.savetxt(folder / "lights.txt", directions(24)[-6:])
    warnings = capture.sphere(folder, size=32, budget="4K").warnings
    assert any("dark frame" in text for text in warnings)


def test_files_of_lights(tmp_path: Path) -> None:
    path = tmp_path / "l.txt"
    for text in ("2\n0 0 2\n0 1 1\n", "0 0 1\n0 1 1\n", "# x y z\n0,0,1\n\n0,1,1 # up\n"):
        path.write_text(text)
        expected = [[0, 0, 1], [0, math.sqrt(0.5), math.sqrt(0.5)]]
        np.testing.assert_allclose(read_directions(tmp_path, path, 2), expected)
    path.write_text("3\n0 0 1\n0 1 1\n")
    with pytest.raises(CorruptFileError, match="counts 3 lights in its first line but lists 2"):
        read_directions(tmp_path, path, 2)
