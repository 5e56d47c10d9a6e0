"""Pack published fits to the MERL materials into src/brdf/materials/data/fits.json.

    python tools/pack_fits.py FOLDER

FOLDER holds the `fits/*.fit` files of github.com/bsdfbenchmark/bbm (packed from commit 9807fb3): one
`material = Aggregate(Lambertian(albedo = [r, g, b]), Model(key = value, ...))` a line, after lines of comment. The
packed file keeps the numbers alone, a column a parameter, in the order of the materials.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

TARGET = Path(__file__).parents[1] / "src/brdf/materials/data/fits.json"
LINE = re.compile(r"(\S+) = Aggregate\(Lambertian\(albedo = (\[[^]]*\])\), \w+\((.*)\)\)")
PARAMETER = re.compile(r"(\w+) = (\[\[.*?\]\]|\[.*?\]|[^,]+)")


def columns(file: Path) -> dict[str, list[object]]:
    """The table of one file: materials, kd, and each parameter of the model."""
    table: dict[str, list[object]] = {"material": [], "kd": []}
    for line in file.read_text().splitlines():
        if line.startswith("#") or not line.strip():
            continue
        match = LINE.fullmatch(line.strip())
        if match is None:
            sys.exit(f"{file}: not a fit: {line[:80]}")
        table["material"].append(match[1])
        table["kd"].append(json.loads(match[2]))
        for name, value in PARAMETER.findall(match[3]):
            table.setdefault(name, []).append(json.loads(value))
    if len({len(column) for column in table.values()}) != 1:
        sys.exit(f"{file}: rows differ in their parameters")
    return table


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    tables = {file.stem: columns(file) for file in sorted(Path(sys.argv[1]).glob("*.fit"))}
    if not tables:
        sys.exit(f"{sys.argv[1]}: no *.fit files")
    TARGET.write_text(json.dumps(tables, separators=(",", ":"), allow_nan=False) + "\n")


if __name__ == "__main__":
    main()
