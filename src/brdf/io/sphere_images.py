"""Pictures of spheres as ordinary pictures: a folder of them with a JSON file, or one contact sheet.

The folder holds `sphere-images.json` and one picture a light: linear OpenEXR, or PNG for storage "srgb8". A contact
sheet (.exr or .png) shows the pictures row by row, and carries the same JSON as its note. A PNG sheet is 8-bit sRGB of
[0, 1] whatever the storage was.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..container import replacing_folder
from ..errors import BrdfError, CorruptFileError, FileError, ReflectanceError
from ..reflectance import Reflectance
from ..representations.spheres.sphere_images import SphereImages
from . import sphere_pictures
from .registry import Format

FOLDER_FILE = "sphere-images.json"
KIND, VERSION = "brdf sphere images", 1
SHEET_TYPES = (".exr", ".png")
_SIGNATURES = (b"\x89PNG\r\n\x1a\n", b"\x76\x2f\x31\x01")
_LARGEST_JSON = 1 << 20


def recognises(head: bytes, size: int) -> bool:
    """A PNG or EXR with our note among its first bytes, or the JSON file of a folder."""
    is_sheet = head.startswith(_SIGNATURES) and sphere_pictures.NOTE.encode() in head
    return is_sheet or (head.lstrip().startswith(b"{") and f'"{KIND}"'.encode() in head)


def read(path: Path) -> SphereImages:
    """From a folder, its JSON file, or a contact sheet.

    Raises CorruptFileError (broken JSON, a missing picture, unequal sizes, angles that do not increase, fewer than two
    pictures), FileError.
    """
    if path.is_dir():
        return _read_folder(path / FOLDER_FILE)
    return _read_sheet(path) if path.suffix.lower() in SHEET_TYPES else _read_folder(path)


def write(reflectance: Reflectance, path: Path) -> None:
    """A contact sheet for .exr and .png, else a folder.

    Raises ReflectanceError for anything but `SphereImages`, FileError.
    """
    if not isinstance(reflectance, SphereImages):
        name = reflectance.name or type(reflectance).__name__
        raise ReflectanceError(
            f"{name} is no set of sphere pictures; make one first with `brdf bake --as sphere-images`"
        )
    as_sheet = path.suffix.lower() in SHEET_TYPES and not path.is_dir()
    (_write_sheet if as_sheet else _write_folder)(reflectance, path)


# ---- what the JSON says ------------------------------------------------------------------------------------------


def _description(images: SphereImages) -> dict[str, Any]:
    return {
        "format": KIND,
        "version": VERSION,
        "name": images.name,
        "source": images.source,
        "angles": images.angles.tolist(),
        "size": images.size,
        "storage": images.storage,
        "dilated": images.dilated,
        "blend": images.blend,
        "options": images.options,
    }


def _parsed(path: Path, text: str) -> dict[str, Any]:
    try:
        description = json.loads(text)
        version = description["version"]
        if description["format"] != KIND or not isinstance(description["angles"], list):
            raise ValueError
    except (ValueError, KeyError, TypeError, RecursionError):
        raise CorruptFileError(path, "its JSON does not describe pictures of spheres; write it anew.") from None
    if not isinstance(version, int) or version > VERSION:
        raise CorruptFileError(path, f"is of version {version!r}, known is {VERSION}; upgrade brdf.")
    return dict(description)


def _made(path: Path, description: Mapping[str, Any], pictures: NDArray[np.float32]) -> SphereImages:
    try:
        made = SphereImages(
            pictures, description["angles"], storage=description["storage"], dilated=description["dilated"]
        ).with_blend(description["blend"], **description["options"])
    except BrdfError as error:
        raise CorruptFileError(path, f"{error}.") from None
    except (KeyError, TypeError, ValueError) as error:
        raise CorruptFileError(path, f"its JSON does not describe pictures of spheres ({error!r}).") from None
    source = str(description.get("source", "")) or f"pictures {path.name}"
    return made.named(str(description.get("name", "")) or path.stem, source)


def _pixels(images: SphereImages) -> NDArray[Any]:
    """Half precision where it holds every value the storage can give."""
    exact = images.storage in ("half", "rgb9e5", "srgb8")
    return images.images.astype(np.float16 if exact else np.float32)


# ---- folder ------------------------------------------------------------------------------------------------------


def _write_folder(images: SphereImages, path: Path) -> None:
    extension = ".png" if images.storage == "srgb8" else ".exr"
    files = [f"{i:02d}-light-{angle:g}{extension}" for i, angle in enumerate(images.angles)]
    if path.exists() and not (path.is_dir() and ((path / FOLDER_FILE).is_file() or not any(path.iterdir()))):
        raise FileError(path, "exists and holds no pictures of spheres; choose another place.")
    with replacing_folder(path) as folder:
        for file, pixels in zip(files, _pixels(images), strict=True):
            sphere_pictures.write(folder / file, pixels)
        description = json.dumps(_description(images) | {"pictures": files}, indent=1)
        (folder / FOLDER_FILE).write_text(description + "\n", "utf-8")


def _read_folder(path: Path) -> SphereImages:
    """By its JSON file."""
    if path.stat().st_size > _LARGEST_JSON:
        raise CorruptFileError(path, "is too long for a description of pictures.")
    description = _parsed(path, path.read_text("utf-8", "replace"))
    files = description.get("pictures")
    if not isinstance(files, list) or len(files) != len(description["angles"]):
        raise CorruptFileError(path, "must name one picture an angle under 'pictures'.")
    if len(files) < 2:
        raise CorruptFileError(path, f"names {len(files)} picture; at least 2 are needed.")
    pictures = [_picture(path, file) for file in files]
    for file, picture in zip(files, pictures, strict=True):
        if picture.shape != pictures[0].shape or picture.shape[0] != picture.shape[1]:
            problem = f"is {_size(picture)}, and the first is {_size(pictures[0])}; make all square and of one size."
            raise CorruptFileError(path.parent / file, problem)
    name = path.parent.name or path.stem
    return _made(path, {"name": name, **description}, np.stack(pictures))


def _picture(description: Path, file: Any) -> NDArray[np.float32]:
    if not isinstance(file, str) or Path(file).name != file:
        raise CorruptFileError(description, f"names the picture {file!r}; name a file beside it.")
    path = description.parent / file
    if not path.is_file():
        raise CorruptFileError(description, f"names the picture {file!r}, which is not there; put it back.")
    return sphere_pictures.read(path)[0]


def _size(picture: NDArray[Any]) -> str:
    return f"{picture.shape[1]} x {picture.shape[0]}"


# ---- contact sheet -----------------------------------------------------------------------------------------------


def _write_sheet(images: SphereImages, path: Path) -> None:
    pixels = _pixels(images)
    count, size = len(pixels), images.size
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    sheet = np.zeros((rows, columns, size, size, 3), pixels.dtype)
    sheet.reshape(-1, size, size, 3)[:count] = pixels
    description = _description(images) | {"columns": columns}
    if path.suffix.lower() == ".png":
        description["storage"] = "srgb8"
    sphere_pictures.write(path, sheet.swapaxes(1, 2).reshape(rows * size, columns * size, 3), json.dumps(description))


def _read_sheet(path: Path) -> SphereImages:
    pixels, note = sphere_pictures.read(path)
    if note is None:
        raise CorruptFileError(path, f"carries no note {sphere_pictures.NOTE!r}; write the sheet anew.")
    description = _parsed(path, note)
    count = len(description["angles"])
    size, columns = (_whole_number(path, description, key) for key in ("size", "columns"))
    rows = math.ceil(count / columns)
    if pixels.shape[:2] != (rows * size, columns * size):
        promised = f"{rows} rows of {columns} pictures of {size}"
        raise CorruptFileError(path, f"is {_size(pixels)} pixels large, its note promises {promised}; write it anew.")
    cells = pixels.reshape(rows, size, columns, size, 3).swapaxes(1, 2).reshape(-1, size, size, 3)
    return _made(path, description, cells[:count])


def _whole_number(path: Path, description: Mapping[str, Any], key: str) -> int:
    value = description.get(key)
    if not isinstance(value, int) or not 1 <= value <= sphere_pictures.LARGEST:
        raise CorruptFileError(path, f"its note gives {key} as {value!r}; write the sheet anew.")
    return value


FORMAT = Format(
    "sphere images",
    SHEET_TYPES,
    "pictures of a sphere under lights: a folder with sphere-images.json, or a contact sheet",
    recognises,
    read,
    write,
    folder_file=FOLDER_FILE,
)
