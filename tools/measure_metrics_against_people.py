"""How well each metric of `brdf compare` agrees with what people see: Spearman's correlation with published judgements.

    python tools/measure_metrics_against_people.py PerceptualDistances.csv FOLDER

The judgements are Lavoué et al. 2021 (github.com/nbonneel/PerceptualBRDF, Data/PerceptualDistances.csv: METHOD; BRDF;
DISTANCE); FOLDER holds the measured materials as `NAME.binary`. Used are the methods whose published fits ship with the
package. Prints correlations over all pairs and within each material, with 95 % of resampled sets of materials.
"""

from __future__ import annotations

import csv
import math
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
from scipy.stats import spearmanr

import brdf
from brdf.errors import BrdfError
from brdf.metrics import Comparison

FITS = {
    "SGD": "bagher_sgd", "ABC": "low_lowmicrofacet_E2", "BLINN-PHONG": "ngan_blinnphong",
    "LAFORTUNE": "ngan_lafortune", "WARD": "ngan_ward",
}  # fmt: skip
RESAMPLED = 400


def distances(c: Comparison) -> dict[str, float]:
    """Every metric, larger for what is farther apart."""
    return {
        "relative RMSE, lit all around": c.surroundings_rmse, "PSNR": -c.psnr, "PSNR, mean of lights": -c.psnr_mean,
        "PSNR, least of lights": -c.psnr_min, "CIEDE2000, mean": c.delta_e.mean, "CIEDE2000, 95 %": c.delta_e.p95,
        "relative RMSE": c.relative_rmse, "albedo": c.albedo_difference, **c.metrics,
    }  # fmt: skip


def main(judgements: Path, folder: Path) -> None:
    with judgements.open(encoding="utf-8") as file:
        rows = [(m, name, float(d)) for m, name, d in list(csv.reader(file, delimiter=";"))[1:] if m in FITS]
    people, metrics, of = [], [], defaultdict(list)
    for path in sorted(folder.glob("*.binary")):
        measured = brdf.load(str(path))
        for method, _, distance in (row for row in rows if row[1] == path.stem):
            try:
                fit = brdf.load(f"{path.stem}@{FITS[method]}")
            except BrdfError:
                continue
            of[path.stem].append(len(people))
            people.append(distance)
            metrics.append(distances(brdf.compare(measured, fit, size=64)))
    seen, rng = np.array(people), np.random.default_rng(0)
    print(f"{len(seen)} judgements of {len(of)} materials")
    for name in metrics[0]:
        value = np.array([m[name] for m in metrics])
        within = [spearmanr(value[i], seen[i]).statistic for i in of.values() if len(i) > 3]
        sets = [np.concatenate([of[m] for m in rng.choice(list(of), len(of))]) for _ in range(RESAMPLED)]
        low, high = np.percentile([spearmanr(value[i], seen[i]).statistic for i in sets], [2.5, 97.5])
        inside = float(np.mean([r for r in within if not math.isnan(r)]))
        print(f"{name:32s} {spearmanr(value, seen).statistic:6.3f}  [{low:.3f}, {high:.3f}]  within {inside:.3f}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]))
