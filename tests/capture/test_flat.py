"""Photographs of a flat sample: what a known camera does to known pictures is undone, mistakes are named."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from brdf import container, load, models
from brdf.capture import FlatSample, flat, simulate
from brdf.capture.flat_sample import sample
from brdf.capture.flat_sample.arc import choose_arc
from brdf.capture.flat_sample.checks import checks_of, warnings_of
from brdf.capture.flat_sample.exposures import recover_response
from brdf.capture.flat_sample.rectify import Cutter, area_averaged, homography
from brdf.cli import run
from brdf.color import luminance, srgb_encode
from brdf.errors import CorruptFileError, FileError, MissingExtraError, ParameterError
from brdf.geometry.directions import from_spherical

ANGLES = (5.0, 30.0, 55.0, 75.0)
TRUTH = simulate("leather", ANGLES, size=48)
EXPOSURE = 0.85 / float(np.quantile(TRUTH.images, 0.9995))
"""Brings the brightest picture just below saturation."""
Camera = Callable[[np.ndarray], np.ndarray]


def photograph(path: Path, light: np.ndarray, camera: Camera = srgb_encode, seconds: float | None = None) -> None:
    """Write linear `light` (H, W, 3) as 8 bits, with the exposure in the file's EXIF."""
    exif = Image.Exif()
    if seconds is not None:
        exif[0x8769] = {0x829A: seconds}
    numbers = np.asarray(np.rint(camera(np.clip(light, 0, 1)) * 255), np.uint8)
    Image.fromarray(numbers).save(path, exif=exif)


def folder_of(tmp_path: Path, images: np.ndarray = EXPOSURE * TRUTH.images, angles: Any = ANGLES) -> Path:
    folder = tmp_path / "photographs"
    folder.mkdir()
    for number, image in enumerate(images):
        photograph(folder / f"{number + 1}.png", image)
    (folder / "angles.txt").write_text("# degrees\n" + "".join(f"{angle}\n" for angle in angles))
    return folder


def relative(found: np.ndarray, truth: np.ndarray) -> float:
    """RMS of the difference over the RMS of the truth."""
    return float(np.sqrt(np.mean((found - truth) ** 2) / np.mean(truth**2)))


def scaled_to(found: np.ndarray, truth: np.ndarray) -> np.ndarray:
    return found * (float((found * truth).sum()) / float((found * found).sum()))


# ---- the camera is undone ------------------------------------------------------------------------------------------


def test_pictures_come_back_within_the_steps_of_8_bits(tmp_path: Path) -> None:
    found = flat(folder_of(tmp_path))
    np.testing.assert_allclose(found.elevations, ANGLES)
    assert relative(scaled_to(found.images, TRUTH.images), TRUTH.images) < 0.008
    assert found.averages[0] == pytest.approx(0.5 * math.cos(math.radians(5)) / math.pi)  # albedo 0.5
    assert not found.scale_known
    doubled = flat(tmp_path / "photographs", albedo=1.0, size=24)
    np.testing.assert_allclose(doubled.images, 2 * found.images.reshape(4, 24, 2, 24, 2, 3).mean((2, 4)), rtol=1e-4)


def test_angles_may_come_in_any_order_with_names_and_exposures(tmp_path: Path) -> None:
    folder = folder_of(tmp_path)
    photograph(folder / "long.png", 2 * EXPOSURE * TRUTH.images[3])
    lines = ["long.png, 75, 0.5", "1.png 5 .25", "3.png 55 0.25  # grazing", "2.png 30 0.25"]
    (folder / "list.txt").write_text("\n".join(lines))
    found = flat(folder, angles=folder / "list.txt")
    assert list(found.elevations) == sorted(ANGLES)
    assert relative(scaled_to(found.images, TRUTH.images), TRUTH.images) < 0.008


def curved(light: np.ndarray) -> np.ndarray:
    """A camera with a toe and a shoulder, unlike any standard."""
    return np.asarray(0.6 * light**0.45 + 0.4 * np.sin(light * math.pi / 2) ** 0.9)


def bracketed(folder: Path, camera: Camera, noise: float = 0.0, stray: float = 0.0) -> None:
    """Four exposures a lamp, each four times the one before, from far too dark to far too bright."""
    rng = np.random.default_rng(3)
    folder.mkdir()
    lines = []
    for number, image in enumerate(TRUTH.images):
        for step in range(4):
            light = (EXPOSURE / 4 * image + stray) * 4.0**step + noise * rng.standard_normal(image.shape)
            photograph(folder / f"{number}-{step}.png", light, camera, seconds=4.0**step / 1000)
            lines.append(f"{number}-{step}.png {ANGLES[number]}")
    (folder / "angles.txt").write_text("\n".join(lines))


def test_brackets_are_merged_beyond_the_range_of_one(tmp_path: Path) -> None:
    bracketed(tmp_path / "b", srgb_encode)
    found = flat(tmp_path / "b")
    assert relative(scaled_to(found.images, TRUTH.images), TRUTH.images) < 0.004
    dark = TRUTH.images[3] < 0.05 * TRUTH.images[0].mean()
    merged, single = (scaled_to(s.images, TRUTH.images)[3][dark] for s in (found, flat(folder_of(tmp_path))))
    truth = TRUTH.images[3][dark]
    assert relative(merged, truth) < 0.6 * relative(single, truth)  # shadows gain most
    assert found.checks.clipped.max() == 0


def test_stray_light_grows_with_the_exposure(tmp_path: Path) -> None:
    folder = tmp_path / "b"
    bracketed(folder, srgb_encode, stray=0.03)
    photograph(folder / "dark.png", np.full((48, 48, 3), 0.03 * 2.0), seconds=2.0 / 1000)
    white = np.full((48, 48, 3), 0.99 * math.cos(math.radians(5)) / math.pi)
    photograph(folder / "white.png", EXPOSURE * white / 16 + 0.03 / 4, seconds=0.25 / 1000)
    found = flat(folder)
    assert found.scale_known
    assert relative(found.images, TRUTH.images) < 0.02
    (folder / "dark.png").unlink()
    assert relative(flat(folder).images, TRUTH.images) > 0.1  # the test can tell


def test_an_unknown_response_is_recovered_from_brackets(tmp_path: Path) -> None:
    pytest.importorskip("cv2")
    bracketed(tmp_path / "b", curved, noise=0.002)
    shots = [[(tmp_path / "b" / f"{k}-{step}.png", 4.0**step / 1000) for step in range(4)] for k in range(4)]
    light = np.linspace(0.02, 0.95, 60)
    recovered = recover_response(shots).linear(np.repeat(curved(light)[:, None], 3, 1))[:, 1] / light
    assert np.abs(recovered / np.median(recovered) - 1).max() < 0.05
    found = flat(tmp_path / "b", response="brackets")
    assert relative(scaled_to(found.images, TRUTH.images), TRUTH.images) < 0.025
    wrong = flat(tmp_path / "b", response="srgb")
    assert relative(scaled_to(wrong.images, TRUTH.images), TRUTH.images) > 0.04  # the test can tell


def test_dark_frame_and_white_reference_undo_stray_light_vignetting_and_fall_off(tmp_path: Path) -> None:
    x, y = np.meshgrid(np.linspace(-1, 1, 48), np.linspace(-1, 1, 48))
    lens = ((1 - 0.25 * (x**2 + y**2)) * (1 + 0.2 * x))[..., None].astype(np.float32)
    stray = (0.02 + 0.01 * y)[..., None] * np.ones(3, np.float32)
    folder = folder_of(tmp_path, 0.6 * EXPOSURE * TRUTH.images * lens + stray)
    white = np.full((48, 48, 3), 0.99 * math.cos(math.radians(5)) / math.pi, np.float32)
    exposure = 0.6 * EXPOSURE
    while (exposure * white).max() > 0.9:  # the white reference may be as bright as it takes: all are taken alike
        exposure /= 2
    for number, image in enumerate(TRUTH.images):
        photograph(folder / f"{number + 1}.png", exposure * image * lens + stray)
    photograph(folder / "dark.png", stray)
    photograph(folder / "White reference.png", exposure * white * lens + stray)
    found = flat(folder)
    assert found.scale_known
    assert relative(found.images, TRUTH.images) < 0.02  # no factor is fitted: the scale is absolute
    (folder / "White reference.png").unlink()
    assert relative(scaled_to((bare := flat(folder)).images, TRUTH.images), TRUTH.images) > 0.08
    assert any("brightness changes by" in text for text in bare.warnings)


def test_perspective_is_undone_to_the_mark(tmp_path: Path) -> None:
    corners = np.array([[22.0, 14.0], [170.0, 30.0], [150.0, 130.0], [10.0, 118.0]])
    to_square = np.linalg.inv(homography(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]), corners))
    column, row = np.meshgrid(np.arange(192), np.arange(150))
    seen = np.stack([column, row, np.ones_like(row)], -1) @ to_square.T
    picture = pattern(seen[..., 0] / seen[..., 2], seen[..., 1] / seen[..., 2]).astype(np.float32)
    cut = Cutter((150, 192), corners, crop=96, size=48).cut(picture)
    centre = (np.arange(48) + 0.5) / 48
    expected = pattern(*np.meshgrid(centre, centre))
    assert np.abs(cut - expected).max() < 0.008


def pattern(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    wave = 0.5 + 0.2 * np.sin(9 * u + 2) * np.cos(7 * v) + 0.1 * np.sin(4 * u - 6 * v)
    return np.stack([wave, wave**2, 0.3 + 0 * wave], -1)


def test_averaging_down_keeps_every_mean() -> None:
    picture = np.random.default_rng(0).random((30, 45, 3)).astype(np.float32)
    np.testing.assert_allclose(
        area_averaged(picture, (10, 15)), picture.reshape(10, 3, 15, 3, 3).mean((1, 3)), rtol=1e-5
    )
    np.testing.assert_allclose(area_averaged(picture, (7, 11)).mean((0, 1)), picture.mean((0, 1)), rtol=1e-5)
    ramp = np.repeat(np.arange(10.0)[None, :, None], 3, 2)  # the mean of a ramp over [10/4 k, 10/4 (k + 1)]
    steps = [(0 + 1 + 2 * 0.5) / 2.5, (2 * 0.5 + 3 + 4) / 2.5, (5 + 6 + 7 * 0.5) / 2.5, (7 * 0.5 + 8 + 9) / 2.5]
    np.testing.assert_allclose(area_averaged(ramp, (1, 4))[0, :, 0], steps, rtol=1e-6)


def test_without_marks_the_middle_is_kept(tmp_path: Path) -> None:
    wide = np.zeros((40, 60, 3), np.float32)
    wide[10:30, 20:40] = 1
    cutter = Cutter((40, 60), None, crop=20, size=512)
    assert cutter.out == (20, 20)
    assert cutter.cut(wide).min() == 1
    assert Cutter((40, 60), None, crop=1024, size=30).out == (20, 30)


# ---- lamps ---------------------------------------------------------------------------------------------------------


def test_lamps_on_one_arc_are_all_taken_and_of_a_dome_the_best_arc() -> None:
    arc = choose_arc(np.asarray(from_spherical(np.radians([50, 10, 83, 30]), np.radians([118, 121, 121, 119]))))
    assert arc.chosen == [1, 3, 0, 2]
    assert arc.azimuth == pytest.approx(120, abs=2)
    rng = np.random.default_rng(1)
    z = rng.uniform(0.05, 1, 150)
    dome = from_spherical(np.arccos(z), rng.uniform(0, 2 * np.pi, 150))
    row = from_spherical(np.radians(np.arange(0, 90, 10.0)), np.radians(200))
    arc = choose_arc(np.concatenate([dome, row]))
    assert set(range(150, 159)) <= set(arc.chosen)
    assert arc.azimuth == pytest.approx(200, abs=3)
    behind = choose_arc(np.asarray(from_spherical(np.radians([10, 40, 100, 89.5]), 0.0)))
    assert behind.chosen == [0, 1]


def test_a_list_of_directions_may_name_files_as_another_machine_did(tmp_path: Path) -> None:
    folder = folder_of(tmp_path)
    (folder / "angles.txt").unlink()
    w = from_spherical(np.radians(ANGLES), np.radians(40))
    names = ["C:\\captures\\1.png", "jpg/2.png", "sub\\3.png", "4.png"]
    rows = "".join(f"{name} {x} {y} {z}\n" for name, (x, y, z) in zip(names, 2 * w, strict=True))
    (folder / "lights.lp").write_text(f"4\n{rows}")
    found = flat(folder)
    np.testing.assert_allclose(found.elevations, ANGLES, atol=1e-6)
    assert relative(scaled_to(found.images, TRUTH.images), TRUTH.images) < 0.008
    assert any("azimuth 40°" in fact for fact in found.facts)


# ---- figures -------------------------------------------------------------------------------------------------------


def test_figures_of_pictures_with_known_faults() -> None:
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, 64), np.linspace(0.5, -0.5, 64))
    rng = np.random.default_rng(0)
    even = 1 + 0.05 * rng.standard_normal((64, 64))
    lit = np.stack([even * (1 + 0.3 * x), 0.5 * even * (1 - 0.2 * y)])[..., None] * np.ones(3)
    checks = checks_of(lit, np.array([0.0, 0.02]))
    np.testing.assert_allclose(checks.averages, [luminance(image).mean() for image in lit])
    np.testing.assert_allclose(checks.gradients, [(0.3, 0), (0, -0.2)], atol=0.02)
    said = warnings_of(checks, np.array([10.0, 50.0]))
    assert [text[:21] for text in said] == ["brightness changes by", "2.0% of the picture a"]
    stripes = np.sin(40 * x)[None, ..., None] * np.ones(3) + 2
    assert checks_of(stripes).anisotropy > 0.99
    assert checks_of(even[None, ..., None] * np.ones(3)).anisotropy < 0.1
    rising = checks_of(np.array([0.1, 0.3, 0.8])[:, None, None, None] * np.ones((3, 8, 8, 3)))
    assert not rising.monotone
    assert "are the angles measured from the surface?" in warnings_of(rising, np.array([5.0, 45.0, 85.0]))[0]
    glowing = checks_of(np.array([0.3, 0.32, 0.2])[:, None, None, None] * np.ones((3, 8, 8, 3)))
    assert "the picture at 45° is brighter than the one at 5°" in warnings_of(glowing, np.array([5.0, 45.0, 85.0]))[0]


def test_the_real_relief_under_240_lamps_runs_to_a_material(data: Path, tmp_path: Path) -> None:
    found = flat(data / "flat" / "loewenkopf")
    assert found.images.shape[1:] == (43, 64, 3)
    assert 7 <= len(found.images) <= 10
    assert np.diff(found.elevations).max() < 20
    assert (np.diff(found.averages) < 0).all()
    found.save(tmp_path / "lion")
    material = load(tmp_path / "lion" / sample.MATERIAL)
    wi = from_spherical(np.radians(found.elevations), np.zeros(len(found.images)))
    seen = material.f_cos(wi[:, None], (0, 0, 1), [((20 + 0.5) / 64, 1 - (10 + 0.5) / 43)])
    np.testing.assert_allclose(seen[:, 0], found.images[:, 10, 20], rtol=0.05, atol=2e-3)


# ---- results -------------------------------------------------------------------------------------------------------


def test_a_result_is_a_folder_and_comes_back(tmp_path: Path) -> None:
    found = flat(folder_of(tmp_path))
    place = found.save(tmp_path / "leather")
    assert {path.name for path in place.iterdir()} == {
        "pictures.safetensors", "shading-map.safetensors", "contact-sheet.png", "report.txt", "report.json"
    }  # fmt: skip
    back = FlatSample.load(place)
    np.testing.assert_array_equal(back.images, found.images)
    assert (back.name, back.source, back.report) == (found.name, found.source, found.report)
    numbers = json.loads((place / "report.json").read_text())
    np.testing.assert_allclose(numbers["averages"], found.averages)
    assert "averages fall steadily" in found.report
    with pytest.raises(FileError, match="exists; choose another folder"):
        found.save(place)
    found.save(place, found.shading_map(models.GGX(alpha=0.3)), overwrite=True)
    assert load(place / "shading-map.safetensors").children["brdf"].alpha == pytest.approx(0.3)
    with pytest.raises(FileError, match="is no result of a capture"):
        found.save(tmp_path / "photographs", overwrite=True)


def test_another_process_reads_the_material(tmp_path: Path) -> None:
    place = flat(folder_of(tmp_path)).save(tmp_path / "leather")
    code = f"import brdf; print(brdf.load({str(place / 'shading-map.safetensors')!r}).stack.shape)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout == "(48, 48)\n"


def test_pictures_without_their_angles_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="pictures must be \\(M, H, W, 3\\) with M elevations"):
        FlatSample(TRUTH.images, TRUTH.elevations[:2])
    container.save(tmp_path / "pictures.safetensors", {"name": "", "source": ""}, {"images": TRUTH.images})
    with pytest.raises(CorruptFileError, match="holds no pictures of a flat sample"):
        FlatSample.load(tmp_path)


def test_nothing_is_left_of_a_result_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = flat(folder_of(tmp_path))

    def full(*arguments: Any) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr(sample, "save_sheet", full)
    with pytest.raises(OSError, match="no space"):
        found.save(tmp_path / "leather")
    assert {path.name for path in tmp_path.iterdir()} == {"photographs"}


def test_the_material_under_its_own_average_shows_the_photographs(tmp_path: Path) -> None:
    found = flat(folder_of(tmp_path))
    material = found.shading_map()
    wi = from_spherical(np.radians(ANGLES), np.zeros(4))
    uv = np.stack(np.meshgrid((np.arange(48) + 0.5) / 48, 1 - (np.arange(48) + 0.5) / 48), -1).reshape(-1, 2)
    shown = material.f_cos(wi[:, None], (0, 0, 1), uv).reshape(found.images.shape)
    assert relative(shown, found.images) < 0.01


# ---- mistakes ------------------------------------------------------------------------------------------------------


def overwrite(name: str, content: bytes) -> Callable[[Path], None]:
    return lambda folder: (folder / name).write_bytes(content) and None


def smaller(folder: Path) -> None:
    photograph(folder / "3.png", TRUTH.images[2][:40])


def black(name: str) -> Callable[[Path], None]:
    return lambda folder: photograph(folder / name, 0 * TRUTH.images[0])


def all_black(folder: Path) -> None:
    for number in range(1, 5):
        black(f"{number}.png")(folder)


MISTAKES: list[tuple[Callable[[Path], Any], str]] = [
    (smaller, r"3\.png: is 48 x 40, but the first photograph 48 x 48"),
    (overwrite("angles.txt", b"1.png 20\n"), r"angles\.txt: has one lamp alone \(1 photograph"),
    (black("2.png"), r"2\.png: is black; take it again"),
    (all_black, r"1\.png: is black, and so are all others"),
    (overwrite("angles.txt", b"5 30\n55\n"), r"angles\.txt: has 2 angles for the 4 photographs in .*photographs;"),
    (overwrite("3.png", b"\x89PNG\r\n\x1a\nrubbish"), r"3\.png: cannot be read as a picture"),
    (overwrite("2.png", b""), r"2\.png: is empty \(0 bytes\)"),
    (overwrite("angles.txt", b"5\n30\nfifty five\n75\n"), r"angles\.txt: line 3 names a file|line 1 names no file"),
    (
        overwrite("angles.txt", b"5\n30\n55\n95\n"),
        r"angles\.txt: line 4: the angle from the normal must lie in \[0, 90\)",
    ),
    (overwrite("angles.txt", b"5 1 1\n30\n55\n75\n"), r"angles\.txt: line 1 must be \[FILE\] ANGLE \[SECONDS\]"),
    (overwrite("angles.txt", b"5 0\n30\n55\n75\n"), r"angles\.txt: line 1: the exposure must be above 0 seconds"),
    (overwrite("angles.txt", b"7.png 3\n1.png 5\n"), r"angles\.txt: line 1 names 7\.png, which is not there"),
    (overwrite("angles.txt", b"5\n5\n55\n75\n"), r"1\.png: is one of several photographs under the same lamp"),
    (overwrite("angles.txt", b"5 .1\n30 .2\n55\n75\n"), r"3\.png: tells no exposure, but others do"),
    (overwrite("lights.lp", b"4\n"), r"holds|has several lists of lamps \(angles\.txt, lights\.lp\)"),
    (lambda folder: (folder / "angles.txt").unlink(), r"has no angles\.txt and no \.lp file"),
    (black("white.png"), r"white\.png: the white reference is black in places"),
]


@pytest.mark.parametrize(("spoil", "message"), MISTAKES)
def test_mistakes_name_the_file(spoil: Callable[[Path], Any], message: str, tmp_path: Path) -> None:
    folder = folder_of(tmp_path)
    spoil(folder)
    with pytest.raises((FileError, ParameterError), match=message) as caught:
        flat(folder)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("5\n1.png 0 0 1\n", "promises 5 lamps in its first line but lists 1"),
        ("1\n1.png 0 0\n", "line 2 must be FILE x y z"),
        ("1\n1.png 0 0 zero\n", "line 2: 'zero' is not a number"),
        ("1\n1.png 0 0 0\n", "line 2 has no direction"),
        ("1\n9.png 0 0 1\n", "line 2 names 9.png, which is not there"),
        ("", "is empty"),
        ("1\n1.png 0 0 1\n", "has one lamp alone"),
    ],
)
def test_mistakes_in_a_list_of_directions_are_named(content: str, message: str, tmp_path: Path) -> None:
    folder = folder_of(tmp_path)
    (folder / "l.lp").write_text(content)
    with pytest.raises((CorruptFileError, FileError), match=message):
        flat(folder, angles=folder / "l.lp")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"corners": [(0, 0), (40, 0), (40, 40)]}, "corners must be four pixels x,y"),
        ({"corners": [(0, 0), (0, 40), (40, 40), (40, 0)]}, "corners must go around the sample: top left"),
        ({"corners": [(0, 0), (90, 0), (40, 40), (0, 40)]}, "must lie within the photographs of 48 x 48 pixels"),
        ({"corners": [(0, 0), (20, 20), (40, 40), (0, 40)]}, "no three on one line"),
        ({"crop": 0}, "crop must be at least 1 pixel, got 0"),
        ({"albedo": 1.5}, r"albedo must lie in \(0, 1\], got 1.5"),
        ({"response": "brackets"}, "at least two different exposures of one lamp"),
        ({"response": "log"}, "response must be linear, srgb, or a gamma"),
        ({"dark": "no.png"}, "no.png: no such file"),
    ],
)
def test_mistakes_in_arguments_are_named(arguments: dict[str, Any], message: str, tmp_path: Path) -> None:
    with pytest.raises((ParameterError, FileError), match=message):
        flat(folder_of(tmp_path), **arguments)


def test_without_opencv_the_message_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bracketed(tmp_path / "b", srgb_encode)
    monkeypatch.setitem(sys.modules, "cv2", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'brdf\[capture\]'"):
        flat(tmp_path / "b", response="brackets")


# ---- command line --------------------------------------------------------------------------------------------------


def test_the_command_line_makes_the_folder(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = folder_of(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert run(["capture", "flat", str(folder), "--size", "24", "--compress", "3", "--brdf", "GGX:alpha=0.4"]) == 0
    assert str(tmp_path / "photographs-captured") in capsys.readouterr().out
    material = load(tmp_path / "photographs-captured" / "shading-map.safetensors")
    assert material.stack.shape == (24, 24)
    assert material.stack.bytes_per_texel == 3
    assert run(["capture", "simulate", "wax", "--size", "24", "--json", "-o", "wax"]) == 0
    assert json.loads(capsys.readouterr().out)["scale_known"] is True
    assert run(["capture", "flat", str(folder), "--crop", "48", "--size", "96", "-o", "grown"]) == 0
    assert load("grown/shading-map.safetensors").stack.shape == (96, 96)
    assert FlatSample.load("grown").images.shape == (4, 48, 48, 3)
    marks = "2,2 44,3 45,44 1,45"
    assert run(["capture", "flat", str(folder), "--corners", marks, "-o", "cut"]) == 0
    assert FlatSample.load("cut").images.shape == (4, 44, 44, 3)  # no finer than the photographs


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["flat", "photographs", "--corners", "1,2 3,4"], "--corners must be four pixels"),
        (["flat", "photographs", "-o", "photographs"], "photographs: exists; choose another folder"),
        (["flat", "nowhere"], "nowhere: no such folder"),
        (["flat", "photographs", "--brdf", "GGZ"], "unknown material 'GGZ'"),
        (["flat", "photographs", "--compress", "9"], "9"),
        (["flat", "photographs", "--size", "5000"], "less than or equal to 4096"),
        (["simulate", "woool"], "unknown simulated material 'woool': did you mean 'wool'?"),
    ],
)
def test_the_command_line_ends_in_one_line_and_leaves_nothing(
    arguments: list[str], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    folder_of(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert run(["capture", *arguments]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["photographs"]
