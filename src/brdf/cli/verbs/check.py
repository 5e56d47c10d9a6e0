"""`brdf check`: does a material obey the laws?"""

from __future__ import annotations

import typer

from .. import arguments, output


def command(material: arguments.Material, json: arguments.AsJson = False) -> None:
    """Measure whether a material obeys the laws.

    Positivity, reciprocity, energy and the others; the exit code is 1 when one does not hold. A law that a material
    is known to break, and says so with its source, does not count as failed.

    \b
    Examples:
      brdf check GGX:alpha=0.3
      brdf check measured.binary --json
    """
    from ...laws import check

    m = arguments.load(material)
    with output.working("checking"):
        report = check(m)
    print(report.to_json() if json else report)
    if not report.passed:
        raise typer.Exit(1)
