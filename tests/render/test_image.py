"""Pictures: files, metadata, tone curves, captions."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image as Pictures

from brdf.color import srgb_encode
from brdf.errors import FileError, SceneError, UnknownFormatError, UnknownNameError
from brdf.render import Image, captioned
from brdf.render.image import read_exr
from brdf.render.tone import CURVES, MIDDLE_GREY, developed

PIXELS = np.random.default_rng(0).random((5, 7, 3)).astype(np.float32) * 2


def test_exr_keeps_every_bit(tmp_path):
    path = tmp_path / "a.exr"
    Image(PIXELS * 1000, metadata={"Material": "gold"}).save(path)
    np.testing.assert_array_equal(read_exr(path), PIXELS * 1000)
    import OpenEXR

    header = OpenEXR.File(str(path)).header()
    assert header["material"] == "gold"
    assert header["software"].startswith("brdf ")


def test_exr_with_alpha(tmp_path):
    alpha = np.linspace(0, 1, 35, dtype=np.float32).reshape(5, 7)
    Image(PIXELS, alpha).save(tmp_path / "a.exr")
    import OpenEXR

    pixels = OpenEXR.File(str(tmp_path / "a.exr")).channels()["RGBA"].pixels
    np.testing.assert_array_equal(pixels[..., 3], alpha)
    np.testing.assert_array_equal(pixels[..., :3], PIXELS)


def test_png_is_srgb_and_says_what_it_shows(tmp_path):
    values = np.array([0, 0.0031308, 0.18, 0.5, 1, 3], np.float32)
    image = Image(np.repeat(values[None, :, None], 3, -1), metadata={"Material": "oro α"})
    image.save(tmp_path / "a.png", tone="clip")
    picture = Pictures.open(tmp_path / "a.png")
    np.testing.assert_array_equal(np.asarray(picture)[0, :, 0], [0, 10, 118, 188, 255, 255])
    assert picture.text["Material"] == "oro α"
    assert picture.text["Tone curve"] == "clip"
    image.save(tmp_path / "b.png", tone="clip", exposure=-1)
    assert np.asarray(Pictures.open(tmp_path / "b.png"))[0, 4, 0] == 188


def test_png_with_alpha_has_its_colours_undivided(tmp_path):
    alpha = np.full((5, 7), 0.5, np.float32)
    Image(np.full((5, 7, 3), 0.25), alpha).save(tmp_path / "a.png", tone="clip")
    np.testing.assert_array_equal(np.asarray(Pictures.open(tmp_path / "a.png"))[0, 0], [188, 188, 188, 128])


@pytest.mark.parametrize("tone", ["clip", "reinhard", "filmic"])
def test_tone_curves_keep_middle_grey(tone):
    assert developed(np.array([MIDDLE_GREY]), tone)[0] == pytest.approx(0.4613561, abs=1e-5)  # sRGB of 0.18


@pytest.mark.parametrize("tone", CURVES)
def test_tone_curves_keep_order(tone):
    grey = np.concatenate([np.linspace(0, 20, 4000), [1e30, np.inf]])
    ramp = developed(np.repeat(grey[:, None], 3, -1), tone)
    assert (ramp == ramp[:, :1]).all()
    assert (np.diff(ramp[:, 0]) >= 0).all()
    assert ramp[0, 0] == 0
    assert 0.98 < ramp[-1, 0] <= 1


def test_the_neutral_curve_is_the_published_one():
    """By hand from the published definition: fractions without rounding."""
    colours = [(0.5, 0.3, 0.2), (0.5, 0.3, 0.04), (2.0, 0.5, 0.1), (1.0, 1.0, 1.0)]
    peak, scaled, kept = 1 - 0.0576 / 1.44, 0.46 / 1.96, 1 / 1.15
    expected = [(0.46, 0.26, 0.16), (0.47, 0.27, 0.01),
                (peak, peak * (scaled * kept + 1 - kept), peak * (0.06 / 1.96 * kept + 1 - kept)),
                3 * (1 - 0.0576 / 0.44,)]  # fmt: skip
    np.testing.assert_allclose(developed(np.array(colours), "neutral"), srgb_encode(np.array(expected)), atol=1e-9)


def test_linear_is_not_encoded():
    np.testing.assert_array_equal(developed(np.array([0.0, 0.2, 3.0]), "linear"), [0, 0.2, 1])
    np.testing.assert_array_equal(developed(np.array([0.1]), "linear", exposure=1), [0.2])


def test_nothing_is_left_behind_when_writing_fails(tmp_path):
    with pytest.raises(UnknownFormatError, match=r"written as \.png or \.exr"):
        Image(PIXELS).save(tmp_path / "a.jpg")
    with pytest.raises(UnknownNameError, match="did you mean 'filmic'"):
        Image(PIXELS).save(tmp_path / "a.png", tone="filmik")
    with pytest.raises(FileError, match="cannot be written"):
        Image(PIXELS).save(tmp_path / "none" / "a.png")
    assert list(tmp_path.iterdir()) == []


def test_shapes_are_checked():
    with pytest.raises(SceneError, match="shape"):
        Image(np.zeros((4, 4)))
    with pytest.raises(SceneError, match="alpha"):
        Image(PIXELS, np.zeros((2, 2)))


def test_caption_is_a_strip_below_with_the_words_in_it():
    image = Image(np.full((240, 320, 3), 0.1, np.float32))
    made = captioned(image, "a caption\nof two lines", ("left", "right"))
    assert made.width == 320
    assert made.height > 270
    strip = made.pixels[240:]
    assert strip.max() > 0.5
    assert np.median(strip) < 0.05
    ink = np.flatnonzero(strip.max((0, 2)) > 0.3)
    assert abs((ink[0] + ink[-1]) / 2 - 160) < 4
    feet = made.pixels[200:240].max((0, 2)) > 0.3
    assert feet[:80].any()
    assert feet[240:].any()
    assert not feet[120:200].any()
    assert made.metadata["Description"] == "a caption\nof two lines"


@pytest.mark.parametrize("ground", [0.0, 0.1, 0.17, 0.4, 1.0])
def test_labels_stand_out(ground):
    image = Image(np.full((240, 320, 3), ground, np.float32), np.zeros((240, 320), np.float32))
    made = captioned(image, "", ("left", "right"))
    feet = made.pixels[200:240, :, 0]
    darker, brighter = np.sort([ground, feet.flat[np.abs(feet - ground).argmax()]])
    assert (brighter + 0.05) / (darker + 0.05) > 3
    assert made.alpha[200:240].max() > 0.9  # letters are there where nothing else is


def test_long_captions_are_broken():
    made = captioned(Image(np.zeros((120, 200, 3), np.float32)), "many words " * 8)
    assert made.height > 120 + 2 * 9 * 1.45
    strip = made.pixels[120:].max((0, 2)) > 0.2
    assert strip.any()
    assert not strip[:2].any()
    assert not strip[-2:].any()
