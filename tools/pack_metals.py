"""Pack measured refractive indices of metals into src/brdf/materials/data/metals.json.

    python tools/pack_metals.py FOLDER

FOLDER is `database/data` of github.com/polyanskiy/refractiveindex.info-database (CC0 1.0; packed from commit ff11b58
of 2026-06-14). Kept are the visible wavelengths and one sample on either side. Each metal also gets the three-channel
index (eta, k) that stands in for its spectrum: the one whose Fresnel reflectance has, in each channel, the RGB of the
spectral reflectance both at normal incidence and averaged over the hemisphere (weighed with the cosine). Where RGB
exceeds 0.999, outside what any index reflects, it is taken for 0.999.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from brdf.color import spectrum_to_rgb
from brdf.materials.metals import mean_reflectance
from brdf.models.terms.fresnel import conductor

TARGET = Path(__file__).parents[1] / "src/brdf/materials/data/metals.json"
VISIBLE = (360.0, 830.0)
HIGHEST = 0.999
METALS = {
    "aluminium": ("main/Al/nk/Rakic-BB.yml", "Rakic1998"),
    "brass": ("other/alloys/Cu-Zn/nk/Querry-Cu70Zn30.yml", "Querry1985"),
    "chromium": ("main/Cr/nk/Johnson.yml", "Johnson1974"),
    "cobalt": ("main/Co/nk/Johnson.yml", "Johnson1974"),
    "copper": ("main/Cu/nk/Johnson.yml", "Johnson1972"),
    "gold": ("main/Au/nk/Johnson.yml", "Johnson1972"),
    "iron": ("main/Fe/nk/Johnson.yml", "Johnson1974"),
    "nickel": ("main/Ni/nk/Johnson.yml", "Johnson1974"),
    "palladium": ("main/Pd/nk/Johnson.yml", "Johnson1974"),
    "platinum": ("main/Pt/nk/Rakic-BB.yml", "Rakic1998"),
    "silver": ("main/Ag/nk/Johnson.yml", "Johnson1972"),
    "titanium": ("main/Ti/nk/Johnson.yml", "Johnson1974"),
    "tungsten": ("main/W/nk/Rakic-BB.yml", "Rakic1998"),
}


def table(file: Path) -> np.ndarray:
    """(W, 3) wavelength [nm], n, k in the visible range and one sample beyond."""
    rows = [line.split() for line in file.read_text("utf-8").splitlines() if line[:8].isspace() and line.strip()]
    values = np.array([row for row in rows if len(row) == 3], np.float64) * [1000, 1, 1]
    first = max(int(np.searchsorted(values[:, 0], VISIBLE[0], side="right")) - 1, 0)
    last = int(np.searchsorted(values[:, 0], VISIBLE[1])) + 1
    return values[first:last]


def rgb_index(nm: np.ndarray, n: np.ndarray, k: np.ndarray) -> tuple[list[float], list[float]]:
    """eta and k, three numbers each."""
    normal = spectrum_to_rgb(conductor(1.0, n, k), nm)
    mean = spectrum_to_rgb(mean_reflectance(n, k), nm)
    eta, extinction = [], []
    for channel in range(3):
        wanted = np.minimum([normal[channel], mean[channel]], HIGHEST)

        def missed(x: np.ndarray, wanted: np.ndarray = wanted) -> np.ndarray:
            a, b = np.exp(x)
            return np.array([float(conductor(1.0, a, b)), float(mean_reflectance(a, b))]) - wanted

        found = least_squares(missed, np.log([np.median(n), np.median(k)]), xtol=1e-14, ftol=1e-14, gtol=1e-14)
        print(
            f"    channel {channel}: F0 {wanted[0]:.5f}, mean {wanted[1]:.5f}, missed by {np.abs(found.fun).max():.1g}"
        )
        eta.append(float(f"{np.exp(found.x[0]):.6g}"))
        extinction.append(float(f"{np.exp(found.x[1]):.6g}"))
    return eta, extinction


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    packed: dict[str, Any] = {}
    for metal, (path, source) in METALS.items():
        print(metal)
        nm, n, k = table(Path(sys.argv[1]) / path).T
        eta, extinction = rgb_index(nm, n, k)
        packed[metal] = {
            "source": source, "file": path, "eta": eta, "k": extinction,
            "spectrum": {"nm": np.round(nm, 4).tolist(), "n": n.tolist(), "k": k.tolist()},
        }  # fmt: skip
    TARGET.write_text(json.dumps(packed, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
