"""A small valid file of every format that is read, made here by the layout that its module describes.

Files of UTIA, MIT CSAIL, WINDOW and Disney could not be had: theirs are written by other code than that under test.
"""

from __future__ import annotations

import io as memory
import struct
from collections.abc import Callable

import numpy as np
from tests.representations.synthetic_rgl import tensors

import brdf
from brdf import io
from brdf.io import rgl
from brdf.representations.neural import SHAPES


def alta() -> bytes:
    rng = np.random.default_rng(1)
    rows = np.concatenate(
        [rng.uniform(0.1, 1.3, (40, 1)), rng.uniform(-0.8, 0.8, (40, 2)), rng.uniform(1, 2, (40, 1))], 1
    )
    header = "#SAMPLE made up\n#DIM 3 1\n#VS 0\n#PARAM_IN ISOTROPIC_TL_TV_PROJ_DPHI\n#PARAM_OUT INV_STERADIAN\n"
    return (header + "\n".join(" ".join(f"{x:.5f}" for x in row) for row in rows) + "\n").encode()


def astm() -> bytes:
    rng = np.random.default_rng(2)
    rows = np.concatenate([rng.uniform(0, 1.3, (40, 4)), rng.uniform(0.1, 2, (40, 3))], 1)
    header = "TITLE made up\nNUM_POINTS 40\nVARS theta_i,phi_i,theta_s,phi_s,450nm,550nm,650nm\n"
    return (header + "\n".join(",".join(f"{x:.5f}" for x in row) for row in rows) + "\n").encode()


def cornell() -> bytes:
    rng = np.random.default_rng(3)
    rows = np.concatenate([rng.uniform(0, 1.3, (40, 4)), rng.uniform(0.1, 2, (40, 3))], 1)
    return ("# paint\n3\n450 550 650\n" + "\n".join(" ".join(f"{x:.5f}" for x in row) for row in rows) + "\n").encode()


def fits() -> bytes:
    diffuse = "Lambertian(albedo = [0.1, 0.2, 0.3])"
    return f"""# made up
red = Aggregate({diffuse}, NganWard(albedo = [0.01, 0.02, 0.03], roughness = 0.1))
blue = Aggregate({diffuse}, LowSmooth(A = [1.5, 1.4, 1.3], B = 100.0, C = 0.8, eta = 1.5))
grey = {diffuse}
""".encode()


def disney() -> bytes:
    return b"""analytic

# variables
::begin parameters
color baseColor .82 .67 .16
float metallic 0 1 .3
float subsurface 0 1 0
float specular 0 1 .5
float roughness 0 1 .4
float specularTint 0 1 0
float anisotropic 0 1 0
float sheen 0 1 0
float sheenTint 0 1 .5
float clearcoat 0 1 0
float clearcoatGloss 0 1 1
::end parameters

::begin shader
vec3 BRDF( vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y ) { return baseColor; }
::end shader
"""


def zemax() -> bytes:
    rng = np.random.default_rng(4)
    blocks = [
        "TIS\t0.5\n" + "\n".join("\t".join(f"{x:.3e}" for x in row) for row in rng.uniform(0.1, 1, (5, 4)))
        for _ in range(3)
    ]
    angles = (
        "AngleOfIncidence\t3\n10\t30\t60\nScatterAzimuth\t5\n0\t45\t90\t135\t180\nScatterRadial\t4\n0\t10\t30\t90\n"
    )
    head = "# made up\nSource\tMeasured\nSymmetry\tPlaneSymmetrical\nSpectralContent\tMonochrome\nScatterType\tBRDF\n"
    data = "\n\nMonochrome\nDataBegin\n" + "\n".join(blocks) + "\nDataEnd\n"
    return (head + "SampleRotation\t1\n0\n" + angles + data).encode()


def klems(direction: str = "Reflection Front", seed: int = 5) -> bytes:
    """Of 41 patches; rows of the matrix are outgoing."""
    values = np.random.default_rng(seed).uniform(0, 1, (41, 41))
    data = "\n".join(",".join(f"{x:.4f}" for x in row) for row in values)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<WindowElement xmlns="http://windows.lbl.gov"><Optical><Layer>
<DataDefinition><IncidentDataStructure>Columns</IncidentDataStructure></DataDefinition>
<WavelengthData><Wavelength unit="Integral">Visible</Wavelength><WavelengthDataBlock>
<WavelengthDataDirection>{direction}</WavelengthDataDirection>
<ColumnAngleBasis>LBNL/Klems Quarter</ColumnAngleBasis><RowAngleBasis>LBNL/Klems Quarter</RowAngleBasis>
<ScatteringDataType>BRDF</ScatteringDataType><ScatteringData>{data}</ScatteringData>
</WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>
""".encode()


def weights(seed: int = 6) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    return {name: rng.normal(0, 0.3, shape).astype(np.float32) for name, shape in SHAPES.items()}


def nbrdf() -> bytes:
    file = memory.BytesIO()
    np.savez_compressed(file, **{f"{name}/{key}": array for name in ("one", "two") for key, array in weights().items()})
    return file.getvalue()


def utia() -> bytes:
    """The values tell the direction: red theta_i, green phi_i, blue theta_v plus phi_v / 1000, in degrees."""
    planes = []
    for channel in range(3):
        for i in range(288):
            for v in range(288):
                theta_i, phi_i, theta_v, phi_v = i // 48 * 15, i % 48 * 7.5, v // 48 * 15, v % 48 * 7.5
                planes.append((1 + theta_i, 1 + phi_i, 1 + theta_v + phi_v / 1000)[channel])
    return struct.pack(f"<{len(planes)}d", *planes)


def csail(bins: tuple[int, int, int, int] = (4, 5, 8, 6), is_half: bool = False) -> bytes:
    """Red is 1 + the bin of theta_in, green 1 + that of theta_out, blue 1 + that of phi_diff + that of phi_in / 100."""
    header = [*bins, 0, 0, 1, 0, 0, int(is_half), 3, 0, 0, 0, 0, 0]
    a, b, c, d = bins
    values = []
    for channel in range(3):
        for i in range(a):
            for j in range(b):
                for k in range(c):
                    for n in range(d):
                        values.append((1 + i, 1 + j, 1 + k + n / 100)[channel])
    return struct.pack("<16i", *header) + struct.pack(f"<{len(values)}f", *values)


def _written(extension: str, write: Callable) -> bytes:
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"sample{extension}"
        write(path)
        return path.read_bytes()


def rgl_tensors() -> bytes:
    return _written(".bsdf", lambda path: rgl.write_tensors(tensors(), path))


def own() -> bytes:
    return _written(".safetensors", lambda path: io.write(brdf.models.GGX(alpha=0.3), path))


SAMPLES: dict[str, tuple[str, Callable[[], bytes]]] = {
    "ALTA text": (".alta", alta),
    "ASTM E1392 text": (".astm", astm),
    "BSDF benchmark fits": (".fit", fits),
    "Disney BRDF Explorer": (".brdf", disney),
    "MIT CSAIL": (".csail", csail),
    "NBRDF weights": (".npz", nbrdf),
    "RGL": (".bsdf", rgl_tensors),
    "UTIA": (".bin", utia),
    "WINDOW XML": (".xml", klems),
    "Zemax text": (".bsdf", zemax),
    "goniometer text": (".brdf", cornell),
    "safetensors": (".safetensors", own),
}
"""Extension and content by the name of the format."""
