"""One table of many fits: a line a fit, in CSV or Parquet."""

from __future__ import annotations

import csv
import importlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..container import replacing
from ..errors import MissingExtraError, UnknownFormatError

FACTS = (
    "data", "path", "model", "lobes", "metric", "samples", "cost", "bic", "agreeing", "starts", "seed", "seconds",
    "file",
)  # fmt: skip
"""Columns before the errors and the parameters."""

KINDS = (".csv", ".parquet")


def require_kind(path: str | os.PathLike[str]) -> None:
    """Raises UnknownFormatError for an extension that no table is written with."""
    if Path(path).suffix.lower() not in KINDS:
        raise UnknownFormatError(path, f"tables are written as {' or '.join(KINDS)}; choose one.")


def lines(fits: Sequence[Mapping[str, Any]]) -> tuple[list[str], list[dict[str, Any]]]:
    """The columns and the lines: each metric, each parameter and its standard error has a column."""
    made = []
    for one in fits:
        line = {name: one[name] for name in FACTS}
        line |= {f"error {name}": value for name, value in one["errors"].items()}
        for name, estimate in one["parameters"].items():
            line |= {name: estimate["value"], f"{name} ±": estimate["error"]}
        made.append(line)
    columns = dict.fromkeys(name for line in made for name in line)
    first = [name for name in columns if name in FACTS or name.startswith("error ")]
    return [*first, *(name for name in columns if name not in first)], made


def write_table(fits: Sequence[Mapping[str, Any]], path: str | os.PathLike[str]) -> None:
    """Write the table; what a fit does not have is left empty. Raises UnknownFormatError, MissingExtraError."""
    require_kind(path)
    columns, made = lines(fits)
    with replacing(path) as temporary:
        if Path(path).suffix.lower() == ".csv":
            with temporary.open("w", encoding="utf-8", newline="") as file:
                writer = csv.DictWriter(file, columns, restval="")
                writer.writeheader()
                writer.writerows(made)
            return
        try:
            arrow: Any = importlib.import_module("pyarrow")
            parquet: Any = importlib.import_module("pyarrow.parquet")
        except ImportError:
            raise MissingExtraError("a Parquet table", "cluster") from None
        content = {name: [line.get(name) for line in made] for name in columns}
        parquet.write_table(arrow.table(content), temporary)
