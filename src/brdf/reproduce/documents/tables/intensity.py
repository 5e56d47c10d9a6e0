"""Figure 3: the total intensity of every material's tables, by parameterisation and by alpha."""

from __future__ import annotations

from collections import Counter

import numpy as np

from ...charts import curves
from ...report import Column, Report
from .measuring import INTENSITY_SHAPE, Measured
from .options import Alphas


def present(report: Report, found: Measured) -> Counter[Alphas]:
    """Figure 3; returns how often each pair of alphas wins."""
    materials = found.intensities
    ratios = {
        "Bézier, best α": [1.0] * len(materials),
        "uniform": [i.uniform / i.bezier[i.best] for i in materials.values()],
        "identity": [i.identity / i.bezier[i.best] for i in materials.values()],
    }
    places = list(range(1, len(materials) + 1))
    report.figure(
        "figure-3",
        "Figure 3. Total intensity of the tables, in parts of the Bézier table's, whose α are those of the largest; "
        "each curve with its materials in order.",
        curves({name: (places, sorted(values, reverse=True)) for name, values in ratios.items()},
               "material", "total intensity", marker=""),
    )  # fmt: skip
    wins = Counter(i.best for i in materials.values())
    size = " × ".join(map(str, INTENSITY_SHAPE))
    report.table(
        "figure-3",
        "Figure 3. The alphas of the largest total intensity",
        [Column("α of θ", "1", ".1f"), Column("α of φ", "1", ".1f"), Column("materials", "1", "d", "ours"),
         Column("uniform, median", "1", ".2f", "ours"), Column("identity, median", "1", ".2f", "ours")],
        [[*pair, count, *(float(np.median([values[k] for k, i in enumerate(materials.values()) if i.best == pair]))
                          for values in (ratios["uniform"], ratios["identity"]))]
         for pair, count in wins.most_common()],
        f"The mean texel of tables of {size} nodes, f without a cosine, at 11 × 11 pairs; intensities in parts of the "
        "Bézier table's.",
    )  # fmt: skip
    return wins
