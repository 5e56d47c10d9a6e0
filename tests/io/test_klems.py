"""Daylighting matrices: patches by Radiance's rule, rows and columns, sides and colours, hostile XML."""

from __future__ import annotations

import itertools
import math
import re

import numpy as np
import pytest
from tests.io.samples import klems

import brdf
from brdf import io
from brdf.errors import CorruptFileError
from helpers import random_directions

QUARTER = ((0, 1), (9, 8), (27, 12), (45, 12), (63, 8), (90, 0))


def number(w):
    """The patch of an outgoing direction, counted band by band."""
    polar, azimuth = math.degrees(math.acos(min(w[2], 1))), math.degrees(math.atan2(w[1], w[0])) % 360
    before = 0
    for (_, count), (end, _) in itertools.pairwise(QUARTER):
        if polar < end:
            place = int(azimuth / 360 * count + 0.5)
            return before + (0 if place >= count else place)
        before += count
    raise AssertionError


def values(text):
    body = re.search(r"<ScatteringData>(.*?)</ScatteringData>", text, re.S)[1]
    return np.array([float(x) for x in body.replace("\n", ",").split(",") if x]).reshape(41, 41)


@pytest.mark.parametrize("structure", ["Columns", "Rows"])
def test_values_by_patches(tmp_path, structure):
    text = klems().decode().replace("Columns", structure)
    (tmp_path / "m.xml").write_text(text)
    m, matrix = io.read(tmp_path / "m.xml"), values(text)
    for wi, wo in zip(random_directions(300, 1), random_directions(300, 2), strict=True):
        i, o = number(wi * [-1, -1, 1]), number(wo)
        np.testing.assert_allclose(m(wi, wo), matrix[o, i] if structure == "Columns" else matrix[i, o], rtol=1e-6)


def test_a_mirror_lies_on_the_diagonal(tmp_path):
    text = klems().decode()
    body = "\n".join(",".join(map(str, row)) for row in np.eye(41))
    (tmp_path / "m.xml").write_text(re.sub(r"(<ScatteringData>).*?(</Scat)", rf"\g<1>{body}\2", text, flags=re.S))
    m = io.read(tmp_path / "m.xml")
    w = random_directions(200, 3)
    np.testing.assert_array_equal(m(w, w * [-1, -1, 1]), 1)


def test_all_patches_reflect_what_the_matrix_says(tmp_path):
    """The albedo is the sum of values times projected solid angles."""
    (tmp_path / "m.xml").write_bytes(klems())
    m, matrix = io.read(tmp_path / "m.xml"), values(klems().decode())
    sines = [math.sin(math.radians(limit)) ** 2 for limit, _ in QUARTER]
    bands = zip(QUARTER[:-1], itertools.pairwise(sines), strict=True)
    omega = np.concatenate([np.full(n, math.pi * (b - a) / n) for (_, n), (a, b) in bands])
    wo = np.array([0.3, 0.2, math.sqrt(1 - 0.13)])
    np.testing.assert_allclose(m.albedo(wo, samples=1 << 16), [omega @ matrix[number(wo)]] * 3, rtol=0.01)


def test_front_is_preferred_to_back_and_transmission(tmp_path):
    sides = ("Transmission Front", "Reflection Back", "Reflection Front")
    texts = (klems(side, seed).decode() for seed, side in enumerate(sides, start=1))
    blocks = [re.search(r"<WavelengthData>.*</WavelengthData>", text, re.S)[0] for text in texts]
    text = re.sub(r"<WavelengthData>.*</WavelengthData>", "".join(blocks), klems().decode(), flags=re.S)
    (tmp_path / "m.xml").write_text(text)
    m = io.read(tmp_path / "m.xml")
    up = [0, 0, 1.0]
    np.testing.assert_allclose(m(up, up), values(klems(seed=3).decode())[0, 0], rtol=1e-6)
    assert "reflection front" in m.source


def coloured(factors):
    block = re.search(r"<WavelengthData>.*</WavelengthData>", klems().decode(), re.S)[0]
    parts = []
    for name, factor in zip(("CIE-X", "Visible", "CIE-Z"), factors, strict=True):
        body = "\n".join(",".join(f"{factor * x:.7f}" for x in row) for row in values(block))
        part = block.replace("Visible", name)
        parts.append(re.sub(r"(<ScatteringData>).*?(</Scat)", rf"\g<1>{body}\2", part, flags=re.S))
    return re.sub(r"<WavelengthData>.*</WavelengthData>", "".join(parts), klems().decode(), flags=re.S)


@pytest.mark.parametrize(
    ("xyz", "rgb"),
    # white is (1, 1, 1) and not the (.9505, 1, 1.0891) of D65, the white of the RGB space
    [((1, 1, 1), (1, 1, 1)), ((0.4124 / 0.9505, 0.2126, 0.0193 / 1.0891), (1, 0, 0))],
)
def test_colours(tmp_path, xyz, rgb):
    (tmp_path / "m.xml").write_text(coloured(xyz))
    m, first = io.read(tmp_path / "m.xml"), values(klems().decode())[0, 0]
    np.testing.assert_allclose(m([0, 0, 1.0], [0, 0, 1.0]), first * np.array(rgb), atol=1e-3 * first)


def test_an_angle_basis_of_the_file(tmp_path):
    basis = """<AngleBasis><AngleBasisName>Mine</AngleBasisName>
<AngleBasisBlock><Theta>0</Theta><nPhis>1</nPhis><ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>30</UpperTheta>
</ThetaBounds></AngleBasisBlock><AngleBasisBlock><nPhis>2</nPhis><ThetaBounds><LowerTheta>30</LowerTheta>
<UpperTheta>90</UpperTheta></ThetaBounds></AngleBasisBlock></AngleBasis>"""
    text = klems().decode().replace("LBNL/Klems Quarter", "Mine")
    text = text.replace("</DataDefinition>", f"{basis}</DataDefinition>")
    text = re.sub(r"(<ScatteringData>).*?(</Scat)", r"\g<1>1 2 3 4 5 6 7 8 9\2", text, flags=re.S)
    (tmp_path / "m.xml").write_text(text)
    m = io.read(tmp_path / "m.xml")
    assert m([0, 0, 1.0], [0.8, 0, 0.6])[0] == 4
    assert m([-0.8, 0, 0.6], [-0.8, 0, 0.6])[0] == 8


def test_saved_and_loaded(tmp_path):
    (tmp_path / "m.xml").write_bytes(klems())
    m = io.read(tmp_path / "m.xml")
    m.save(tmp_path / "m.safetensors")
    wi, wo = random_directions(100, 4), random_directions(100, 5)
    np.testing.assert_array_equal(brdf.load(str(tmp_path / "m.safetensors"))(wi, wo), m(wi, wo))


BOMB = '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t.replace("<WindowElement", BOMB + "<WindowElement", 1), "declares entities"),
        (lambda t: t.replace("</Layer>", ""), "is not whole XML"),
        (lambda t: t.replace("Reflection Front", "Transmission Front"), "holds transmission front, no reflection"),
        (lambda t: t.replace("Klems Quarter</Row", "Klems Full</Row"), "must be one that is known"),
        (lambda t: t.replace("Klems Quarter", "Klems Full"), "expected 145 x 145 values, found 1681"),
        (lambda t: re.sub(r"(<ScatteringData>)", r"\1red ", t), "something else than numbers"),
        (lambda t: re.sub(r"(<ScatteringData>)[\d.]+", r"\1nan", t), "holds NaN or infinity"),
    ],
)
def test_faults(tmp_path, change, said):
    (tmp_path / "m.xml").write_text(change(klems().decode()))
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.xml")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
