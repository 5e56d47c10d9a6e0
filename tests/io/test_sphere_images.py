"""Pictures of spheres in folders and contact sheets: round trips, and what is wrong with broken ones."""

from __future__ import annotations

import json

import numpy as np
import pytest

import brdf
from brdf.errors import CorruptFileError, FileError, ReflectanceError
from brdf.io import sphere_pictures
from brdf.models import GGX
from brdf.representations.spheres.sphere_images import SphereImages


def made(storage="half", angles=(0, 22.5, 60, 100, 150)):
    images = SphereImages.bake(GGX(alpha=0.3, F0=(1.0, 0.78, 0.34)), angles, 16, storage)
    return images.with_blend("paper", shorten=0.99, guard=False).named("gold", "made up")


@pytest.fixture
def folder(tmp_path):
    brdf.io.write(made(), f"{tmp_path}/gold/")
    return tmp_path / "gold"


def edit(folder, **changes):
    path = folder / "sphere-images.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))


@pytest.mark.parametrize("storage", ["half", "float32", "rgb9e5", "srgb8", "10-10-10", "8-8-8"])
@pytest.mark.parametrize("target", ["gold/", "gold.exr", "gold.safetensors"])
def test_written_and_read_is_the_same(tmp_path, storage, target):
    images = made(storage)
    brdf.io.write(images, f"{tmp_path}/{target}")
    back = brdf.load(f"{tmp_path}/{target}")
    assert isinstance(back, SphereImages)
    assert (back.name, back.source, back.blend, back.storage) == ("gold", "made up", "paper", storage)
    assert (back.options, back.dilated, back.nbytes) == (images.options, images.dilated, images.nbytes)
    np.testing.assert_array_equal(back.angles, images.angles)
    np.testing.assert_allclose(back.images, images.images, rtol=1e-6, atol=1e-7)


def test_a_png_sheet_is_eight_bits_of_the_range_a_screen_shows(tmp_path):
    brdf.io.write(made(), tmp_path / "gold.png")
    back = brdf.load(tmp_path / "gold.png")
    assert back.storage == "srgb8"
    shown = [brdf.color.srgb_encode(images.images) for images in (back, made())]
    assert np.abs(shown[0] - shown[1]).max() <= 0.5 / 255 + 1e-6


def test_a_folder_holds_ordinary_pictures(folder):
    names = sorted(path.name for path in folder.iterdir())
    assert names == [
        "00-light-0.exr", "01-light-22.5.exr", "02-light-60.exr", "03-light-100.exr", "04-light-150.exr",
        "sphere-images.json",
    ]  # fmt: skip
    picture, note = sphere_pictures.read(folder / "02-light-60.exr")
    np.testing.assert_array_equal(picture, made().images[2])
    assert note is None
    assert brdf.io.format_of(folder).name == brdf.io.format_of(folder / "sphere-images.json").name == "sphere images"
    np.testing.assert_array_equal(brdf.load(folder / "sphere-images.json").images, made().images)


def test_a_sheet_shows_the_pictures_row_by_row(tmp_path):
    brdf.io.write(made(), tmp_path / "gold.exr")
    sheet, _ = sphere_pictures.read(tmp_path / "gold.exr")
    assert sheet.shape == (32, 48, 3)
    np.testing.assert_array_equal(sheet[:16, 16:32], made().images[1])
    np.testing.assert_array_equal(sheet[16:, :16], made().images[3])
    np.testing.assert_array_equal(sheet[16:, 32:], 0)


def test_a_folder_of_ours_is_replaced_and_another_is_not(folder, tmp_path):
    brdf.io.write(made("srgb8", (0, 90)), folder)
    assert sorted(path.name for path in folder.iterdir()) == ["00-light-0.png", "01-light-90.png", "sphere-images.json"]
    assert [path.name for path in tmp_path.iterdir()] == ["gold"], "nothing temporary is left"
    other = tmp_path / "photos"
    other.mkdir()
    (other / "holiday.jpg").write_text("precious")
    with pytest.raises(FileError, match="holds no pictures of spheres; choose another place"):
        brdf.io.write(made(), other)
    assert (other / "holiday.jpg").read_text() == "precious"


BROKEN = [
    ({"angles": [0, 22.5, 60, 150, 100]}, "angles must increase"),
    ({"angles": [0, 22.5, 60, 100, 190]}, "angles must increase"),
    ({"angles": [0], "pictures": ["00-light-0.exr"]}, "names 1 picture; at least 2"),
    ({"angles": [0, 45]}, "one picture an angle"),
    ({"angles": "many"}, "does not describe pictures of spheres"),
    ({"pictures": ["../x.exr"] * 5}, "name a file beside it"),
    ({"pictures": ["a.exr"] * 5}, "names the picture 'a.exr', which is not there; put it back"),
    ({"pictures": ["sphere-images.json"] * 5}, "pictures are .png or .exr"),
    ({"storage": "clay"}, "unknown storage 'clay'"),
    ({"blend": "monotne"}, "did you mean 'monotone'"),
    ({"options": {"sharpen": 2}}, "unknown option 'sharpen'"),
    ({"options": 3}, "does not describe"),
    ({"options": {"shorten": "a", "mask": True, "guard": True}}, "does not describe"),
    ({"version": 2}, "upgrade brdf"),
    ({"format": "something"}, "does not describe"),
]


@pytest.mark.parametrize(("changes", "message"), BROKEN)
def test_a_broken_description_says_what_is_wrong(folder, changes, message):
    edit(folder, **changes)
    with pytest.raises(CorruptFileError, match=message) as caught:
        brdf.load(folder)
    assert str(caught.value).startswith(str(folder))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["{", "[1]", "nonsense", "\x00\xff", "{}"])
def test_corrupt_json(folder, text):
    (folder / "sphere-images.json").write_text(text, "latin-1")
    with pytest.raises(CorruptFileError, match="JSON does not describe pictures of spheres"):
        brdf.load(folder)


def test_a_missing_picture(folder):
    (folder / "02-light-60.exr").unlink()
    with pytest.raises(CorruptFileError, match=r"'02-light-60.exr', which is not there"):
        brdf.load(folder)


def test_pictures_of_unequal_sizes(folder):
    sphere_pictures.write(folder / "02-light-60.exr", np.zeros((8, 8, 3), np.float32))
    with pytest.raises(CorruptFileError, match=r"60.exr: is 8 x 8, and the first is 16 x 16; make all square"):
        brdf.load(folder)
    for file in json.loads((folder / "sphere-images.json").read_text())["pictures"]:
        sphere_pictures.write(folder / file, np.zeros((8, 16, 3), np.float32))
    with pytest.raises(CorruptFileError, match="square"):
        brdf.load(folder)


@pytest.mark.parametrize("content", [b"", b"no picture", b"\x76\x2f\x31\x01\x02\x00\x00\x00"])
def test_a_broken_picture(folder, content):
    (folder / "02-light-60.exr").write_bytes(content)
    with pytest.raises(CorruptFileError, match=r"02-light-60.exr: is not a whole picture"):
        brdf.load(folder)


@pytest.mark.parametrize("keep", [0.3, 0.7, 0.95])
@pytest.mark.parametrize("extension", [".exr", ".png"])
def test_a_truncated_sheet(tmp_path, extension, keep):
    path = tmp_path / f"gold{extension}"
    brdf.io.write(made(), path)
    content = path.read_bytes()
    path.write_bytes(content[: int(len(content) * keep)])
    with pytest.raises(FileError):
        brdf.load(path)


def test_a_sheet_of_another_size_than_its_note_says(tmp_path):
    path = tmp_path / "gold.exr"
    brdf.io.write(made(), path)
    pixels, note = sphere_pictures.read(path)
    sphere_pictures.write(path, pixels[:, :40], note)
    with pytest.raises(CorruptFileError, match="is 40 x 32 pixels large, its note promises 2 rows of 3 pictures of 16"):
        brdf.load(path)
    sphere_pictures.write(path, pixels, note.replace('"columns": 3', '"columns": 0'))
    with pytest.raises(CorruptFileError, match="gives columns as 0"):
        brdf.load(path)


def test_an_ordinary_picture_is_of_no_known_format(tmp_path):
    sphere_pictures.write(tmp_path / "cat.png", np.zeros((8, 8, 3), np.float32))
    with pytest.raises(FileError, match="its content is of no known format"):
        brdf.load(tmp_path / "cat.png")


def test_a_folder_without_pictures_names_what_it_lacks(tmp_path):
    with pytest.raises(FileError, match=r"is a folder without .*sphere-images.json"):
        brdf.load(tmp_path)


def test_only_pictures_are_written_as_pictures(tmp_path):
    with pytest.raises(
        ReflectanceError, match=r"GGX is no set of sphere pictures; make one first with `brdf bake --as sphere-images`"
    ):
        brdf.io.write(GGX(), tmp_path / "x.exr")
    with pytest.raises(ReflectanceError, match="is no set of sphere pictures"):
        brdf.io.write(GGX(), f"{tmp_path}/folder/")


def test_a_torn_picture_is_one_line_and_the_library_says_nothing(folder, capfd):
    picture = sorted(folder.glob("*.exr"))[-1]
    picture.write_bytes(picture.read_bytes()[:-200])
    with pytest.raises(CorruptFileError, match="is not a whole picture"):
        brdf.load(folder)
    assert capfd.readouterr() == ("", "")
