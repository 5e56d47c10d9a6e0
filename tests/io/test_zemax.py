"""Zemax's tables: the numbers of published files come back at their angles; zeros lie where nothing can be seen."""

from __future__ import annotations

import numpy as np
import pytest
from tests.io.samples import zemax as sample

from brdf import io
from brdf.errors import CorruptFileError
from brdf.io import zemax

COATING = "gonio/ua_rt300s/AnoBlackEC1onAlum.bsdf"
SENSOR = "gonio/ua_rt300s/IMX455.bsdf"


def rotated(axis, degrees):
    """Rodrigues' matrix."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    a = np.radians(degrees)
    return np.eye(3) + np.sin(a) * k + (1 - np.cos(a)) * k @ k


def directions(incidence, azimuth, radial, rotation=0.0):
    """`wi` and `wo` by turning vectors: the mirror direction towards the normal, then about the mirror direction."""
    turn = rotated((0, 0, 1), -rotation)
    a = np.radians(incidence)
    wi, mirror = np.array([np.sin(a), 0, np.cos(a)]), np.array([-np.sin(a), 0, np.cos(a)])
    towards_normal = rotated((0, 1, 0), radial) @ mirror
    wo = rotated(mirror, azimuth) @ towards_normal
    return turn @ wi, turn @ wo


@pytest.mark.parametrize(("file", "turns"), [(COATING, [0]), (SENSOR, [5])])
def test_values_come_back_at_the_angles_of_the_file(data, file, turns):
    contents = zemax.read_values(data / file)
    m = io.read(data / file)
    rotation, incidence, azimuth, radial = (contents.angles[name] for name in zemax.AXES)
    checked = 0
    for t in turns:
        for i, j, k in np.ndindex(len(incidence), len(azimuth), len(radial)):
            wi, wo = directions(incidence[i], azimuth[j], radial[k], rotation[t])
            value = contents.values[0, t, i, j, k]
            if value > 0 and wo[2] > 1e-6 and 0 < radial[k] < 180:
                np.testing.assert_allclose(m(wi, wo), value, rtol=2e-4)
                checked += 1
    assert checked > 500 * len(turns)


@pytest.mark.parametrize("file", [COATING, SENSOR])
def test_only_directions_above_the_horizon_were_measured(data, file):
    """The instrument looked up to 80 degrees from the normal, but not along the light, which it would have shaded."""
    contents = zemax.read_values(data / file)
    _, incidence, azimuth, radial = (contents.angles[name] for name in zemax.AXES)
    elevation, measured, shaded = [], [], []
    for i, j, k in np.ndindex(len(incidence), len(azimuth), len(radial)):
        wi, wo = directions(incidence[i], azimuth[j], radial[k])
        elevation.append(np.degrees(np.arccos(np.clip(wo[2], -1, 1))))
        shaded.append(wi @ wo > np.cos(np.radians(30)))
        measured.append(contents.values[0, 0, i, j, k] > 0)
    elevation, measured = np.array(elevation), np.array(measured)
    assert measured[(elevation < 79) & ~np.array(shaded)].all()
    assert not measured[elevation > 90.5].any()


def test_symmetries(data):
    assert io.read(data / COATING).isotropic
    assert not io.read(data / SENSOR).isotropic


def test_unmeasured_nodes_are_filled_and_told_apart(data):
    m = io.read(data / COATING)
    wi, wo = directions(70, 180, 30)
    assert wo[2] < 0
    grazing = np.array([np.sin(1.56), 0, np.cos(1.56)])
    assert m(wi, grazing).min() > 0
    assert m.has_holes
    assert m.measured.mean() < 0.9


def test_colours_are_tristimulus_values(tmp_path):
    text = sample().decode()
    head, _, body = text.partition("\nMonochrome\n")
    head = head.replace("Monochrome", "XYZ")
    scaled = []
    for name, factor in (("TristimulusX", 0.9504559), ("TristimulusY", 1.0), ("TristimulusZ", 1.0890578)):
        lines = [line if line[:1] not in "0123456789" else "\t".join(f"{float(x) * factor:.9e}" for x in line.split())
                 for line in body.splitlines()]  # fmt: skip
        scaled.append(f"\n{name}\n" + "\n".join(lines))
    (tmp_path / "grey.bsdf").write_text(text)
    (tmp_path / "xyz.bsdf").write_text(head + "".join(scaled))
    grey, colour = io.read(tmp_path / "grey.bsdf"), io.read(tmp_path / "xyz.bsdf")
    wi, wo = directions(20, 60, 12)
    np.testing.assert_allclose(colour(wi, wo), grey(wi, wo), rtol=3e-4)


def changed(old, new):
    return sample().decode().replace(old, new, 1)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (changed("PlaneSymmetrical", "Round"), "its Symmetry is 'round'; read are planesymmetrical"),
        (changed("BRDF", "BTDF"), "its ScatterType is 'BTDF'; only BRDF is read"),
        (changed("SpectralContent\tMonochrome", "SpectralContent\tUV"), "its SpectralContent is 'UV'"),
        (changed("10\t30\t60", "10\t60\t30"), "AngleOfIncidence must increase within 0 to 90 degrees"),
        (changed("10\t30\t60", "10\t30\t95"), "AngleOfIncidence must increase within 0 to 90 degrees"),
        (changed("AngleOfIncidence\t3", "AngleOfIncidence\t4"), "line 10 must hold numbers, got 'ScatterAzimuth 5'"),
        (changed("AngleOfIncidence\t3", "AngleOfIncidence\t99999"), "AngleOfIncidence must be followed by a number"),
        (changed("SampleRotation\t1\n0\n", ""), "its list of angles SampleRotation is missing"),
        (changed("SampleRotation\t1\n0\n", "SampleRotation\t2\n0 9\n"), "turns the sample, which only Asymmetrical4D"),
        (changed("DataBegin", "Data"), "ends before DataBegin"),
        (changed("TIS\t0.5\n", ""), "is not one of the 5 lines of 4 values after a line TIS"),
        (sample().decode().rsplit("\n", 3)[0], "ends before all of its values"),
        (changed("0\t45\t90\t135\t180", "10\t45\t90\t135\t180"), "its azimuths must be two or more from 0"),
    ],
)
def test_faults(tmp_path, text, said):
    (tmp_path / "m.bsdf").write_text(text)
    with pytest.raises(CorruptFileError) as caught:
        io.read(tmp_path / "m.bsdf")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_sizes_are_checked_before_memory_is_taken(tmp_path):
    lists = "".join(f"{name}\t2000\n" + " ".join(f"{i * zemax.AXES[name] / 2000:.5f}" for i in range(2000)) + "\n"
                    for name in zemax.AXES)  # fmt: skip
    head = "Source\tMeasured\nSymmetry\tASymmetrical4D\nSpectralContent\tXYZ\nScatterType\tBRDF\n"
    (tmp_path / "m.bsdf").write_text(head + lists + "TristimulusX\nDataBegin\nTIS 1\n1\n")
    with pytest.raises(CorruptFileError, match="claims 3 x 2000 x 2000 x 2000 x 2000 values"):
        io.read(tmp_path / "m.bsdf")


def test_rotations_a_hair_apart_make_no_huge_table(tmp_path):
    text = changed("PlaneSymmetrical", "ASymmetrical4D").replace(
        "SampleRotation\t1\n0\n", "SampleRotation\t2\n0 1e-4\n"
    )
    head, _, body = text.partition("DataBegin\n")
    blocks = body.replace("DataEnd\n", "")
    (tmp_path / "m.bsdf").write_text(f"{head}DataBegin\n{blocks}{blocks}DataEnd\n")
    assert io.read(tmp_path / "m.bsdf").layout.shape[0] == 8
